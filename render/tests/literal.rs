//! The thesis's tables to the letter (3.3.3), against which the tables of `render` are tested.
//!
//! Fig. 3.8 integrates one array in place, and fig. 3.9 gives the grid coefficients that read sums
//! from it. Widths and positions are whole numbers. The kernel is the discrete B-spline: `n` boxes
//! of `w` texels in succession.
//!
//! [`PrefilteredTable`] treats texels as squares instead of points. Its kernel is therefore the
//! discrete B-spline convolved with the B-spline of degree `n` of one texel. For n = 1 this changes
//! nothing. For whole widths it applies the weights (1, 6, 1)/8 for n = 2 and (1, 4, 1)/6 for n = 3
//! along each axis.
//!
//! [`IntegratedArray::naive`] is a first attempt at real widths, by linear interpolation of the
//! sums. It is exact for n = 1. For larger n its weights do not sum to one.

use glam::DVec2;
use proptest::prelude::*;
use render::filter::PrefilteredTable;
use render::texture::Texture;

/// Coefficients of the differences along one axis, by the number of integrations.
const DIFFERENCES: [&[i64]; 4] = [&[1], &[1, -1], &[1, -2, 1], &[1, -3, 3, -1]];

/// An array integrated in place.
#[derive(Debug, Clone)]
struct IntegratedArray {
    n: usize,
    size_x: usize,
    size_y: usize,
    t: Vec<i64>,
}

impl IntegratedArray {
    /// Integrates `texels`, given row by row with `size_x` in each, `n` times along both axes (fig.
    /// 3.8). `n` is 0 to 3.
    ///
    /// Sums wrap at 64 bits. For a `2^r x 2^r` array the thesis needs `2nr + b` bits, which fit for
    /// all but the largest arrays.
    fn new(texels: &[i64], size_x: usize, n: usize) -> Self {
        let size_y = texels.len() / size_x.max(1);
        let mut t = texels.to_vec();
        for _ in 0..n {
            for y in 0..size_y {
                for x in 1..size_x {
                    t[y * size_x + x] = t[y * size_x + x].wrapping_add(t[y * size_x + x - 1]);
                }
            }
            for x in 0..size_x {
                for y in 1..size_y {
                    t[y * size_x + x] = t[y * size_x + x].wrapping_add(t[(y - 1) * size_x + x]);
                }
            }
        }
        Self { n, size_x, size_y, t }
    }

    /// Returns the average whose grid of coefficients (fig. 3.9) has its last corner at column `x`
    /// and row `y` and steps of `w` columns and `h` rows. Its texels are the last `n (w - 1) + 1`
    /// columns up to `x`, and likewise down. Returns `None` if `x` or `y` is outside the array. All
    /// sums before the first column or row are 0.
    fn average(&self, x: usize, y: usize, w: usize, h: usize) -> Option<f64> {
        let mut sum = 0i64;
        for (j, &down) in DIFFERENCES[self.n].iter().enumerate() {
            for (i, &across) in DIFFERENCES[self.n].iter().enumerate() {
                let column = before(x, (self.n - i) * w, self.size_x)?;
                let row = before(y, (self.n - j) * h, self.size_y)?;
                if let (Some(column), Some(row)) = (column, row) {
                    let value = self.t[row * self.size_x + column];
                    sum = sum.wrapping_add(value.wrapping_mul(down * across));
                }
            }
        }
        Some(sum as f64 / ((w * h) as f64).powi(self.n as i32))
    }

    /// Returns the average for real positions and steps, with sums interpolated linearly between
    /// columns and rows.
    fn naive(&self, x: f64, y: f64, w: f64, h: f64) -> f64 {
        let mut sum = 0.0;
        for (j, &down) in DIFFERENCES[self.n].iter().enumerate() {
            for (i, &across) in DIFFERENCES[self.n].iter().enumerate() {
                let column = x - (self.n - i) as f64 * w;
                let row = y - (self.n - j) as f64 * h;
                sum += (down * across) as f64 * self.interpolated(column, row);
            }
        }
        sum / (w * h).powi(self.n as i32)
    }

    fn interpolated(&self, x: f64, y: f64) -> f64 {
        let (fx, fy) = (x - x.floor(), y - y.floor());
        let at = |x: f64, y: f64| {
            let stored = |v: f64, size: usize| {
                let inside = v >= 0.0 && v < size as f64;
                inside.then_some(v as usize)
            };
            match (stored(x, self.size_x), stored(y, self.size_y)) {
                (Some(x), Some(y)) => self.t[y * self.size_x + x] as f64,
                _ => 0.0,
            }
        };
        let row = |y: f64| at(x.floor(), y) * (1.0 - fx) + at(x.floor() + 1.0, y) * fx;
        row(y.floor()) * (1.0 - fy) + row(y.floor() + 1.0) * fy
    }
}

/// Returns the index `back` before `from`. The inner `None` means an index before the first entry,
/// the outer one a `from` outside the array.
fn before(from: usize, back: usize, size: usize) -> Option<Option<usize>> {
    (from < size).then(|| from.checked_sub(back))
}

#[test]
fn the_grid_coefficients_are_those_of_the_figure() {
    let figure: [&[i64]; 4] = [
        &[1],
        &[1, -1, -1, 1],
        &[1, -2, 1, -2, 4, -2, 1, -2, 1],
        &[1, -3, 3, -1, -3, 9, -9, 3, 3, -9, 9, -3, -1, 3, -3, 1],
    ];
    for (n, figure) in figure.into_iter().enumerate() {
        let c = DIFFERENCES[n];
        let grid: Vec<i64> = c.iter().flat_map(|down| c.iter().map(move |a| down * a)).collect();
        assert_eq!(grid, figure, "n = {n}");
    }
}

/// Returns the weights of `n` discrete boxes of `w` texels in succession. They sum to `w^n`.
fn discrete(n: usize, w: usize) -> Vec<i64> {
    let mut kernel = vec![1];
    for _ in 0..n {
        let mut next = vec![0; kernel.len() + w - 1];
        for (k, value) in kernel.iter().enumerate() {
            next[k..k + w].iter_mut().for_each(|sum| *sum += value);
        }
        kernel = next;
    }
    kernel
}

fn texels(seed: u64, count: usize) -> Vec<i64> {
    let code = |k: usize| (k as u64 + seed).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 56;
    (0..count).map(|k| code(k) as i64).collect()
}

proptest! {
    #[test]
    fn it_is_direct_convolution_with_the_discrete_b_spline(
        n in 0usize..=3, w in 1usize..7, h in 1usize..7, seed in any::<u64>(),
        x in 18usize..30, y in 18usize..25,
    ) {
        let (size_x, size_y) = (30, 25);
        let texels = texels(seed, size_x * size_y);
        let table = IntegratedArray::new(&texels, size_x, n);
        let mut sum = 0;
        for (j, down) in discrete(n, h).iter().enumerate() {
            for (i, across) in discrete(n, w).iter().enumerate() {
                sum += down * across * texels[(y - j) * size_x + x - i];
            }
        }
        let direct = sum as f64 / ((w * h) as f64).powi(n as i32);
        prop_assert_eq!(table.average(x, y, w, h), Some(direct));
    }

    /// With whole widths our average is the thesis's, smoothed by the B-spline of one texel.
    #[test]
    fn ours_at_whole_widths_is_the_thesis_smoothed_by_one_texel(
        n in 1usize..=3, w in 1usize..7, h in 1usize..7, seed in any::<u64>(),
        x in 20usize..29, y in 20usize..24,
    ) {
        let (width, height) = (30, 25);
        let codes = texels(seed, width * height);
        let literal = IntegratedArray::new(&codes, width, n);
        let texture = Texture {
            width, height, white: 255,
            texels: codes.iter().map(|&code| [code as u16; 3]).collect(),
            ..Texture::default()
        };
        let smooth: &[(usize, f64)] = match n {
            1 => &[(1, 1.0)],
            2 => &[(0, 1.0 / 8.0), (1, 6.0 / 8.0), (2, 1.0 / 8.0)],
            _ => &[(0, 1.0 / 6.0), (1, 4.0 / 6.0), (2, 1.0 / 6.0)],
        };
        let mut thesis = 0.0;
        for (j, down) in smooth {
            for (i, across) in smooth {
                thesis += down * across * literal.average(x + i - 1, y + j - 1, w, h).unwrap();
            }
        }
        // Middle of the texels under the discrete kernel, in texels.
        let middle = |last: usize, w: usize| last as f64 + 0.5 - 0.5 * (n * (w - 1)) as f64;
        let center = DVec2::new(
            middle(x, w) / width as f64,
            1.0 - middle(y, h) / height as f64,
        );
        let support = DVec2::new(w as f64 / width as f64, h as f64 / height as f64);
        let ours = PrefilteredTable::build(&texture, n)
            .average(&texture, center, 0.5 * n as f64 * support);
        prop_assert!((ours.x * 255.0 - thesis).abs() < 1e-9, "{} {thesis}", ours.x * 255.0);
    }
}

/// Returns the largest departure from 1 of the filtered texture of ones, over positions within
/// a texel.
fn ripple(steps: f64, two: bool, average: impl Fn(f64, f64, f64, f64) -> f64) -> f64 {
    let places = (0..40).map(|k| 30.0 + 0.025 * f64::from(k));
    let rows: Vec<f64> = if two { places.clone().collect() } else { vec![30.0] };
    let h = if two { steps } else { 2.0 };
    places
        .flat_map(|x| rows.iter().map(move |&y| (x, y)))
        .map(|(x, y)| (average(x, y, steps, h) - 1.0).abs())
        .fold(0.0, f64::max)
}

#[test]
fn interpolated_sums_ripple_at_real_widths_and_ours_do_not() {
    let ones = vec![1; 40 * 40];
    let literal = IntegratedArray::new(&ones, 40, 2);
    let naive = |x, y, w, h| literal.naive(x, y, w, h);
    let near = |found: f64, expected: f64| (found - expected).abs() < 0.01;
    // One axis at a step of 1.5: the weights sum to 8/9 and to 10/9.
    let one = ripple(1.5, false, naive);
    assert!((one - 1.0 / 9.0).abs() < 0.005, "{one}");
    let both = [(1.25, 0.25), (1.5, 0.24), (2.5, 0.08), (3.5, 0.04), (10.5, 0.005)];
    for (steps, expected) in both {
        let found = ripple(steps, true, naive);
        assert!(near(found, expected), "step {steps}: {found}, expected {expected}");
    }
    // Whole steps have no ripple, except for the rounding of sums up to 1e6.
    assert!(ripple(3.0, true, naive) < 1e-9);

    let texture = Texture {
        width: 40,
        height: 40,
        white: 255,
        texels: vec![[255; 3]; 1600],
        ..Texture::default()
    };
    for n in 1..=3 {
        let table = PrefilteredTable::build(&texture, n);
        let ours = |x: f64, y: f64, w: f64, h: f64| {
            let half = 0.5 * n as f64 * DVec2::new(w, h) / 40.0;
            table.average(&texture, DVec2::new(x, y) / 40.0, half).x
        };
        for steps in [1.25, 1.5, 2.5, 3.5, 10.5] {
            assert!(ripple(steps, true, ours) < 1e-12, "order {n}, step {steps}");
        }
    }
}
