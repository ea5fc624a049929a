//! Widths of columns and heights of rows that keep every load within 1 with the fewest cells.
//!
//! Let `x` be the square of a column's width and `y` the square of a row's height. The load of the cell where
//! they meet is measured as `a x` along one pair of sides and as `b y` along the other. The load of the whole
//! cell is
//!
//! ```text
//!     t = max(a x, b y, r (a x + b y)) + c sqrt(x y)
//! ```
//!
//! where `r` and `c` are chosen so that the measured load results. The number of cells is the product of two
//! integrals, over `x^-1/2` and `y^-1/2`. The number to minimize is this product times the largest load, to
//! which the number of cells is proportional if all sizes are scaled together. In the logarithms of `x` and
//! `y` this problem is convex, so any descent finds the only minimum. At the minimum, each column's share of
//! the number of columns equals its share of the pressure on columns. A cell exerts pressure if its load is
//! near the largest. The same holds for rows. Each step of the descent widens or narrows columns and rows by
//! the ratio of the two shares.

use super::measure::{Field, Load};

/// Largest number of cells considered. More cells are grouped in blocks, each with the largest of its cells'
/// needs.
const MOST_BLOCKS: usize = 1 << 15;

/// Steps of the descent. After 60 steps the number of cells is within a percent of its limit.
const STEPS: usize = 60;

/// Least load of a cell as large as a whole direction. This load keeps the cells of flat surfaces
/// finite, and is far too small to add a cell.
const LEAST_LOAD: f64 = 1e-4;

/// Largest number of cells in an interval. Sizes that overflow ask for infinitely many cells, and a
/// number that is not finite cannot be made smaller by a factor until it fits the allowed cells.
const MOST_CELLS: f64 = 1e12;

/// Numbers of whole cells up to this multiple of the numbers that are not whole need no other proportion of rows to
/// columns.
const WHOLE: f64 = 1.25;

/// Proportions of rows to columns that are tried on both sides, each the square root of 2 from the next.
const TILTS: i32 = 24;

/// Fraction of the cells that another proportion must save.
const WORTH: f64 = 0.02;

/// Costs that differ by less than this fraction are equal, and the earlier counts. So rounding, and with it
/// the unit of length, cannot decide.
pub const ALIKE: f64 = 1e-9;

/// Density of cells along one direction of the surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Density {
    /// Positions at which the density changes, rising from 0 to 1.
    pub positions: Vec<f64>,
    /// Number of cells in each interval between two `positions`, not whole, for a largest load of 1.
    pub cells: Vec<f64>,
}

impl Density {
    /// Returns the number of all cells, not whole.
    pub fn total(&self) -> f64 {
        self.cells.iter().sum()
    }
}

/// The coefficients `a`, `b`, `r` and `c` of the load of a block of cells.
#[derive(Debug, Clone, Copy, Default)]
struct Need {
    a: f64,
    b: f64,
    r: f64,
    c: f64,
}

struct Problem {
    needs: Vec<Need>,
    /// Extents of the blocks along the contour, as fractions of its length.
    widths: Vec<f64>,
    /// Extents of the blocks along the trajectory, as fractions of its length.
    heights: Vec<f64>,
}

/// Sizes of the blocks, and the largest load that these sizes cause.
#[derive(Debug, Clone)]
struct Sizes {
    /// Squared width of the cells in each column of blocks.
    x: Vec<f64>,
    /// Squared height of the cells in each row of blocks.
    y: Vec<f64>,
    /// The largest load of a block.
    worst: f64,
}

/// Returns the densities `[along the trajectory, along the contour]` that need the fewest cells. If `even`,
/// only densities with columns of equal width are considered.
///
/// `count` returns the number of cells of two densities, with at least one for each piece. Where rows and columns
/// can be exchanged for each other at no cost, as on a warped plate, this number decides.
pub fn fewest(field: &Field, even: bool, count: impl Fn(&[Density; 2]) -> usize) -> [Density; 2] {
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
    let density = |spans: &[[f64; 2]], sizes: &[f64], scale: f64| Density {
        positions: spans.iter().map(|span| span[0]).chain([1.0]).collect(),
        cells: spans
            .iter()
            .zip(sizes)
            // A NaN becomes the largest number too.
            .map(|([from, to], size)| ((to - from) * scale / size.sqrt()).min(MOST_CELLS))
            .collect(),
    };
    let densities = |sizes: &Sizes| {
        let scale = sizes.worst.sqrt();
        [density(&v, &sizes.y, scale), density(&u, &sizes.x, scale)]
    };
    let sizes = problem.solve(even);
    let mut best = densities(&sizes);
    let mut least = count(&best) as f64;
    if least <= WHOLE * best[0].total() * best[1].total() {
        return best;
    }
    // No column or row may grow beyond the size at which its own neediest cell has the largest load.
    let [most_x, most_y] = problem.needed().map(|sizes_for_1| {
        sizes_for_1.into_iter().map(|size| size * sizes.worst).collect::<Vec<_>>()
    });
    for tilt in -TILTS..=TILTS {
        let by = (0.5 * f64::from(tilt)).exp2();
        let x = sizes.x.iter().zip(&most_x).map(|(size, most)| (size * by).min(*most)).collect();
        let y = sizes.y.iter().zip(&most_y).map(|(size, most)| (size / by).min(*most)).collect();
        let mut tilted = Sizes { x, y, worst: 0.0 };
        tilted.worst = problem.worst(&tilted);
        let other = densities(&tilted);
        let cells = count(&other) as f64;
        if cells < least * (1.0 - WORTH) {
            (least, best) = (cells, other);
        }
    }
    best
}

/// Merges neighbouring spans, `by` at a time.
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

    /// Returns the load of a cell, and the share of it due to `x`: the derivative of its logarithm by that of
    /// `x`.
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
            // The maximum sharpens from soft to hard, by ever smaller steps.
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

    /// Returns the squared width of each column and height of each row at which the sides of its neediest cell have
    /// a load of 1.
    fn needed(&self) -> [Vec<f64>; 2] {
        let cols = self.widths.len();
        let mut x = vec![0.0_f64; cols];
        let mut y = Vec::with_capacity(self.heights.len());
        for needs in self.needs.chunks(cols) {
            needs.iter().zip(&mut x).for_each(|(need, x)| *x = x.max(need.a));
            y.push(1.0 / needs.iter().map(|need| need.b).fold(0.0, f64::max));
        }
        [x.into_iter().map(|need| 1.0 / need).collect(), y]
    }

    /// Returns the better of two guesses: even sizes, and sizes as the neediest cell of each column and row
    /// requires. Each guess is tried with several proportions of rows to columns.
    fn start(&self, even: bool) -> Sizes {
        let [x, y] = self.needed();
        let least = |all: &[f64]| all.iter().fold(f64::INFINITY, |least, &one| least.min(one));
        let evenly = (vec![least(&x); x.len()], vec![least(&y); y.len()]);
        let needed = (if even { evenly.0.clone() } else { x.clone() }, y.clone());
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

    /// Returns the number of cells, scaled to a largest load of 1.
    fn cost(&self, sizes: &Sizes) -> f64 {
        count(&self.widths, &sizes.x) * count(&self.heights, &sizes.y) * sizes.worst
    }

    /// Widens and narrows all columns and rows by one step.
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

/// Returns the number of cells of these squared sizes that fill the extents.
fn count(extents: &[f64], sizes: &[f64]) -> f64 {
    extents.iter().zip(sizes).map(|(extent, size)| extent / size.sqrt()).sum()
}
