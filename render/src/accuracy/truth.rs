//! The true colour of one pixel by brute force: many single rays without texture filters.
//!
//! Two independent sets of rays, A and B, are kept apart. For a picture's colour m, the mean of
//! `(m - A)(m - B)` is the squared error of m, whatever the noise of A and B is. Both sets are
//! jittered: one ray in each of k x k equal parts of the pixel's weight.

use super::chances::Draw;
use crate::film::pattern::{fraction, mixed};
use crate::film::{PointWork, Points, Settings, aperture};
use crate::prepared::Prepared;
use glam::DVec2;

/// Rays along each side of a first, third set. It is used only to find how many rays A and B need.
const FIRST: u32 = 3;

/// Least rays along each side of A and of B. The first set misses what covers a small part of a
/// pixel, and with fewer rays than these one such pixel spoils the audit.
const LEAST: u32 = 4;

/// Most rays along each side of A and of B.
const MOST: u32 = 64;

/// Largest variance of A and of B, in squares of the accuracy that is audited. A pixel drawn `n`
/// times adds `VARIANCE / sqrt(n)` squares to the deviation of the mean, times its share.
const VARIANCE: f64 = 20.0;

/// Most by which the weight of a draw lowers the variance.
const MOST_WEIGHT: f64 = 4.0;

/// Two independent estimates of the colour of one pixel, linear RGB.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Truth {
    /// The two estimates.
    pub sets: [[f64; 3]; 2],
    /// Rays from the eye, including those that found the number.
    pub rays: u64,
    /// Rays along each side of either set.
    pub side: u32,
}

impl Truth {
    /// Returns an unbiased estimate of the squared error of a colour, the mean of its channels. It may
    /// be negative.
    #[must_use]
    pub fn squared_error(&self, color: [f32; 3]) -> f64 {
        let [a, b] = self.sets;
        let product = |k: usize| {
            let own = f64::from(color[k]);
            (own - a[k]) * (own - b[k])
        };
        (0..3).map(product).sum::<f64>() / 3.0
    }

    /// Returns an unbiased estimate of the squared difference of two true colours, the mean of the
    /// channels, if the first sets of both are independent of the second ones.
    #[must_use]
    pub fn squared_distance(&self, other: &Self) -> f64 {
        let apart = |set: usize, k: usize| self.sets[set][k] - other.sets[set][k];
        (0..3).map(|k| apart(0, k) * apart(1, k)).sum::<f64>() / 3.0
    }

    /// Returns half of the squared difference of the two sets, the mean of the channels: an estimate of
    /// the variance of either.
    #[must_use]
    pub fn noise(&self) -> f64 {
        let [a, b] = self.sets;
        (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>() / 6.0
    }
}

/// Finds true colours of pixels.
#[derive(Debug)]
pub struct Judge<'a> {
    points: Points<'a>,
    /// Cells along one axis of a pixel: edges, and the weight up to each edge.
    edges: Vec<f64>,
    cumulative: Vec<f64>,
}

impl<'a> Judge<'a> {
    /// A judge of pictures with these settings, whose pixel filter the truth shares.
    #[must_use]
    pub fn new(prepared: &'a Prepared<'_>, settings: &'a Settings) -> Self {
        let (edges, weights) = aperture(settings.sampling);
        let mut cumulative = vec![0.0];
        let mut sum = 0.0;
        for weight in weights {
            sum += weight;
            cumulative.push(sum);
        }
        Self { points: Points::new(prepared, settings), edges, cumulative }
    }

    /// Returns the true colour of a drawn pixel, in column `x` and row `y` of the whole picture. Noisy
    /// pixels get more rays, up to 2 x 64 x 64, as an audit of errors near `accuracy` needs them.
    #[must_use]
    pub fn look(&self, pixel: (u32, u32), draw: &Draw, accuracy: f64) -> Truth {
        let mut work = PointWork::default();
        let mut first = Vec::with_capacity((FIRST * FIRST) as usize);
        self.jittered(pixel, FIRST, mixed(draw.seed), &mut work, |color| first.push(color));
        let variance = variance(&first);
        let wanted = VARIANCE * accuracy * accuracy / draw.weight.min(MOST_WEIGHT);
        // A variance that is not a number asks for the least.
        let side = (variance / wanted).sqrt().ceil() as u32;
        let side = side.clamp(LEAST, MOST);
        let sets = self.sets(pixel, draw, side, &mut work);
        Truth { sets, rays: work.rays(), side }
    }

    /// Returns the true colour of a drawn pixel by rays at the positions of another truth, which was
    /// found in a scene with other meshes. The difference of the two has little noise.
    #[must_use]
    pub fn look_again(&self, pixel: (u32, u32), draw: &Draw, other: &Truth) -> Truth {
        let mut work = PointWork::default();
        let sets = self.sets(pixel, draw, other.side, &mut work);
        Truth { sets, rays: work.rays(), side: other.side }
    }

    fn sets(
        &self,
        pixel: (u32, u32),
        draw: &Draw,
        side: u32,
        work: &mut PointWork,
    ) -> [[f64; 3]; 2] {
        [1, 2].map(|set| {
            let mut sum = [0.0; 3];
            self.jittered(pixel, side, mixed(draw.seed ^ set), work, |color| {
                sum.iter_mut().zip(color).for_each(|(sum, light)| *sum += light);
            });
            sum.map(|light| light / f64::from(side * side))
        })
    }

    /// Calls `take` with the light of `side` x `side` jittered rays of a pixel.
    fn jittered(
        &self,
        (x, y): (u32, u32),
        side: u32,
        seed: u64,
        work: &mut PointWork,
        mut take: impl FnMut([f64; 3]),
    ) {
        let corner = DVec2::new(f64::from(x), f64::from(y));
        let mut hash = seed;
        let mut random = || {
            hash = mixed(hash);
            fraction(hash)
        };
        for row in 0..side {
            for column in 0..side {
                let at = DVec2::new(
                    self.along((f64::from(column) + random()) / f64::from(side)),
                    self.along((f64::from(row) + random()) / f64::from(side)),
                );
                let color = self.points.color(corner + at, work).to_array();
                // As in a picture, light that is not finite is black.
                let finite = color.iter().all(|light| light.is_finite());
                take(if finite { color } else { [0.0; 3] });
            }
        }
    }

    /// Returns the distance from the left side of a pixel up to which it has this part of its weight.
    fn along(&self, part: f64) -> f64 {
        let cell = self.cumulative.partition_point(|&sum| sum <= part);
        let cell = cell.clamp(1, self.edges.len() - 1);
        let (before, after) = (self.cumulative[cell - 1], self.cumulative[cell]);
        let into = (part - before) / (after - before);
        self.edges[cell - 1] + into * (self.edges[cell] - self.edges[cell - 1])
    }
}

/// Returns the variance of colours, the mean of their channels.
fn variance(colors: &[[f64; 3]]) -> f64 {
    let count = colors.len() as f64;
    let of_channel = |k: usize| {
        let mean = colors.iter().map(|color| color[k]).sum::<f64>() / count;
        colors.iter().map(|color| (color[k] - mean).powi(2)).sum::<f64>() / (count - 1.0)
    };
    (0..3).map(of_channel).sum::<f64>() / 3.0
}
