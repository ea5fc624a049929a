//! How wide columns and how high rows may be, so that the fewest cells keep every load within 1.
//!
//! With `x` the square of a column's width and `y` that of a row's height, the load of the cell where
//! they meet is measured as `a x` along one pair of sides and `b y` along the other, and as a
//! whole it is
//!
//! ```text
//!     t = max(a x, b y, r (a x + b y)) + c sqrt(x y)
//! ```
//!
//! with `r` and `c` such that the measured load comes out. The number of cells is the product of two
//! integrals, over `x^-1/2` and `y^-1/2`. Times the largest load (to which it is proportional,
//! all sizes scaled together) it has to be least: in the logarithms of `x` and `y` that
//! is convex, so any descent finds the one minimum. There each column has as large a share of all
//! columns as of the pressure on columns, where a cell presses if its load is near the largest; and
//! so have rows. Columns and rows are widened or narrowed in that proportion until it holds.

use super::measure::{Field, Load};

/// Cells that are looked at, at most: more are gathered in blocks, each with the largest of its
/// cells' needs.
const MOST_BLOCKS: usize = 1 << 15;

/// Steps of descent. After 60 the number of cells is within a percent of where it ends.
const STEPS: usize = 60;

/// A cell as large as a whole direction has this load at least: it keeps flat surfaces finite, and
/// is far too little to be a cell more.
const LEAST_LOAD: f64 = 1e-4;

/// Costs that differ by less than this part are alike, and the earlier counts: rounding, and so the
/// unit of length, may not decide.
pub const ALIKE: f64 = 1e-9;

/// How densely a direction is to be cut.
#[derive(Debug, Clone, PartialEq)]
pub struct Density {
    /// Where it changes: from 0 to 1.
    pub places: Vec<f64>,
    /// The number of cells between two places, not whole, for a largest load of 1.
    pub cells: Vec<f64>,
}

impl Density {
    /// All cells.
    pub fn total(&self) -> f64 {
        self.cells.iter().sum()
    }
}

/// The need of a block of cells.
#[derive(Debug, Clone, Copy, Default)]
struct Need {
    a: f64,
    b: f64,
    r: f64,
    c: f64,
}

struct Problem {
    needs: Vec<Need>,
    /// Extents of the blocks along the contour and the trajectory.
    widths: Vec<f64>,
    heights: Vec<f64>,
}

/// Squared widths and heights, and the largest load that they give.
#[derive(Debug, Clone)]
struct Sizes {
    x: Vec<f64>,
    y: Vec<f64>,
    worst: f64,
}

/// The densities `[along the trajectory, along the contour]` that need the fewest cells; with
/// `even`, among those whose columns are evenly wide.
pub fn fewest(field: &Field, even: bool) -> [Density; 2] {
    let (cols, rows) = (field.u.len(), field.v.len());
    let (mut by_u, mut by_v) = (1, 1);
    while cols.div_ceil(by_u) * rows.div_ceil(by_v) > MOST_BLOCKS {
        if cols.div_ceil(by_u) > rows.div_ceil(by_v) { by_u += 1 } else { by_v += 1 }
    }
    let (u, v) = (gathered(&field.u, by_u), gathered(&field.v, by_v));
    let mut needs = vec![Need::default(); u.len() * v.len()];
    for (row, loads) in field.loads.chunks(cols).enumerate() {
        let height = field.v[row][1] - field.v[row][0];
        for (col, load) in loads.iter().enumerate() {
            let need = Need::of(*load, field.u[col][1] - field.u[col][0], height);
            let block = &mut needs[row / by_v * u.len() + col / by_u];
            *block = block.most(need);
        }
    }
    let extents = |spans: &[[f64; 2]]| spans.iter().map(|[from, to]| to - from).collect();
    let problem = Problem { needs, widths: extents(&u), heights: extents(&v) };
    let sizes = problem.solve(even);
    let scale = sizes.worst.sqrt();
    let density = |spans: &[[f64; 2]], sizes: &[f64]| Density {
        places: spans.iter().map(|span| span[0]).chain([1.0]).collect(),
        cells: spans
            .iter()
            .zip(sizes)
            .map(|([from, to], size)| (to - from) * scale / size.sqrt())
            .collect(),
    };
    [density(&v, &sizes.y), density(&u, &sizes.x)]
}

/// Neighbouring spans together, `by` of them at a time.
fn gathered(spans: &[[f64; 2]], by: usize) -> Vec<[f64; 2]> {
    spans.chunks(by).map(|chunk| [chunk[0][0], chunk[chunk.len() - 1][1]]).collect()
}

impl Need {
    fn of(load: Load, width: f64, height: f64) -> Self {
        let (x, y) = (width * width, height * height);
        let both = load.u + load.v;
        let (r, c) = if load.total < both {
            (load.total / both, 0.0)
        } else {
            (1.0, (load.total - both) / (width * height))
        };
        Self { a: load.u / x + LEAST_LOAD, b: load.v / y + LEAST_LOAD, r, c }
    }

    fn most(self, other: Self) -> Self {
        Self {
            a: self.a.max(other.a),
            b: self.b.max(other.b),
            r: self.r.max(other.r),
            c: self.c.max(other.c),
        }
    }

    /// The load of a cell, and the part of it that `x` is answerable for: the derivative of its
    /// logarithm.
    fn load(&self, x: f64, y: f64, xy: f64) -> (f64, f64) {
        let (u, v, cross) = (self.a * x, self.b * y, self.c * xy);
        let both = self.r * (u + v);
        let (most, share) = if u >= v {
            if u > both { (u, u) } else { (both, self.r * u) }
        } else if v > both {
            (v, 0.0)
        } else {
            (both, self.r * u)
        };
        let load = most + cross;
        (load, (share + 0.5 * cross) / load)
    }
}

impl Problem {
    fn solve(&self, even: bool) -> Sizes {
        let mut best = self.start(even);
        let mut least = self.cost(&best);
        let mut sizes = best.clone();
        for step in 0..STEPS {
            // From a soft maximum to a hard one, by ever smaller steps.
            let part = step as f64 / STEPS as f64;
            let (sharpness, pace) = (8 << (4 * step / STEPS), 0.5 * (1.0 - 0.8 * part));
            self.descend(&mut sizes, sharpness, pace, even);
            let cost = self.cost(&sizes);
            if cost < least * (1.0 - ALIKE) {
                (least, best) = (cost, sizes.clone());
            }
        }
        best
    }

    /// The better of two guesses, each with the best proportion of rows to columns: evenly cut, and
    /// cut as the neediest cell of each column and row asks for.
    fn start(&self, even: bool) -> Sizes {
        let cols = self.widths.len();
        let mut x = vec![0.0_f64; cols];
        let mut y = Vec::with_capacity(self.heights.len());
        for needs in self.needs.chunks(cols) {
            needs.iter().zip(&mut x).for_each(|(need, x)| *x = x.max(need.a));
            y.push(needs.iter().map(|need| need.b).fold(0.0, f64::max));
        }
        let most = |all: &[f64]| all.iter().fold(0.0_f64, |most, &one| most.max(one));
        let evenly = (vec![1.0 / most(&x); cols], vec![1.0 / most(&y); y.len()]);
        let inverse = |all: &[f64]| all.iter().map(|one| 1.0 / one).collect::<Vec<_>>();
        let needed = (if even { evenly.0.clone() } else { inverse(&x) }, inverse(&y));
        let guesses = [evenly, needed].into_iter().flat_map(|(x, y)| {
            (-8..=8).map(move |tilt| {
                let tilt = f64::from(tilt) * 0.25;
                let scaled = |all: &[f64], by: f64| all.iter().map(|one| one * by).collect();
                Sizes { x: scaled(&x, tilt.exp2()), y: scaled(&y, (-tilt).exp2()), worst: 0.0 }
            })
        });
        let measured = guesses.map(|mut guess| {
            guess.worst = self.worst(&guess);
            (self.cost(&guess), guess)
        });
        let better = measured
            .reduce(|best, other| if other.0 < best.0 * (1.0 - ALIKE) { other } else { best });
        better.map_or_else(|| Sizes { x, y, worst: 1.0 }, |(_, guess)| guess)
    }

    fn worst(&self, sizes: &Sizes) -> f64 {
        let roots = |all: &[f64]| all.iter().map(|one| one.sqrt()).collect::<Vec<_>>();
        let (root_x, root_y) = (roots(&sizes.x), roots(&sizes.y));
        let mut worst = 0.0_f64;
        for ((needs, &y), &ry) in self.needs.chunks(sizes.x.len()).zip(&sizes.y).zip(&root_y) {
            for ((need, &x), &rx) in needs.iter().zip(&sizes.x).zip(&root_x) {
                worst = worst.max(need.load(x, y, rx * ry).0);
            }
        }
        worst
    }

    /// The number of cells for a largest load of 1.
    fn cost(&self, sizes: &Sizes) -> f64 {
        count(&self.widths, &sizes.x) * count(&self.heights, &sizes.y) * sizes.worst
    }

    /// Widens and narrows all columns and rows once.
    fn descend(&self, sizes: &mut Sizes, sharpness: i32, pace: f64, even: bool) {
        let cols = sizes.x.len();
        let roots = |all: &[f64]| all.iter().map(|one| one.sqrt()).collect::<Vec<_>>();
        let (root_x, root_y) = (roots(&sizes.x), roots(&sizes.y));
        let mut on_x = vec![0.0; cols];
        let mut on_y = Vec::with_capacity(sizes.y.len());
        let (mut pressure, scale) = (0.0, 1.0 / sizes.worst);
        for ((needs, &y), &ry) in self.needs.chunks(cols).zip(&sizes.y).zip(&root_y) {
            let mut on_row = 0.0;
            for (((need, &x), &rx), on_x) in needs.iter().zip(&sizes.x).zip(&root_x).zip(&mut on_x)
            {
                let (load, share) = need.load(x, y, rx * ry);
                let press = (load * scale).powi(sharpness);
                *on_x += press * share;
                on_row += press * (1.0 - share);
                pressure += press;
            }
            on_y.push(on_row);
        }
        if even {
            let all: f64 = on_x.iter().sum();
            let whole: f64 = self.widths.iter().sum();
            on_x.iter_mut().zip(&self.widths).for_each(|(on, width)| *on = all * width / whole);
        }
        let move_by = |sizes: &mut [f64], extents: &[f64], on: &[f64]| {
            let all = count(extents, sizes);
            for ((size, extent), on) in sizes.iter_mut().zip(extents).zip(on) {
                let (has, bears) = (0.5 * extent / (size.sqrt() * all), on / pressure);
                *size *= (has / bears).clamp(0.25, 4.0).powf(pace);
            }
        };
        move_by(&mut sizes.x, &self.widths, &on_x);
        move_by(&mut sizes.y, &self.heights, &on_y);
        sizes.worst = self.worst(sizes);
    }
}

/// How many cells of these squared sizes fill the extents.
fn count(extents: &[f64], sizes: &[f64]) -> f64 {
    extents.iter().zip(sizes).map(|(extent, size)| extent / size.sqrt()).sum()
}
