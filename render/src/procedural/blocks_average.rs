//! Averages of checker, stripes and bricks over a patch.
//!
//! Averages are exact on patches of a few cells. Of a larger patch only a part around its center is
//! averaged, so that the work is bounded ([`FEW`], [`MANY`]). The remainder would change the
//! average by less than the errors that the tests allow.

use super::blocks::{BELOW, Brick, Checker, Stripes};
use super::convex::Convex;
use super::lattice::{mixed_at, share};
use super::patch::{Form, Patch};
use super::wave::{Wave, average};
use crate::color::Color;
use glam::{DVec2, DVec3};

/// Limits of the work for checkers.
const CHECKERS: Limits = Limits { parts: 96.0, cells: 196.0 };

/// Limits of the work for bricks. Joints are thin, so that the averages of bricks along two axes
/// are less correlated than those of checkers.
const BRICKS: Limits = Limits { parts: 24.0, cells: 64.0 };

/// Limits of the bricks that are counted one by one to find the mean of their tones. Tones of more
/// bricks are replaced by their expected mean. With smaller limits the tone of a distant wall
/// flickers.
const TONES: Limits = Limits { parts: 12.0, cells: 12.0 };

/// Share of a patch below which the part that may be averaged is ignored. A correlation of 0.1,
/// which is large, then changes the result by a quarter of a code of an 8-bit file. With a smaller
/// number distant surfaces cost more time. With a larger number the edge of their region shows.
const NEGLIGIBLE: f64 = 0.01;

/// Largest coordinate of a step, in cells. A longer patch is cut to it, as squares of large numbers
/// overflow. The average over a longer patch is the mean.
const LONGEST: f64 = 1e6;

/// Limits of the work for one average.
#[derive(Debug, Clone, Copy)]
struct Limits {
    /// Number of polygons into which a patch may be split. With a smaller number patches of medium
    /// size are less exact. The work grows in proportion.
    parts: f64,
    /// Area, in cells, up to which a patch is not cut. The average over more cells differs little
    /// from the mean. With a smaller number this difference shows. The work grows with the square
    /// root of the number.
    cells: f64,
}

/// The part of a patch that is averaged in place of the whole patch.
///
/// The average of a product of waves is estimated as the product of the averages of each wave over
/// the whole patch, plus a correlation. The correlation is that of the part times the part's share
/// of the area: over a large patch it comes from the rim alone, as correlations in the interior
/// cancel.
#[derive(Debug, Clone, Copy)]
struct Bounded {
    whole: Patch,
    part: Patch,
    share: f64,
}

impl Bounded {
    /// Cuts a patch, in units of cells, until it is within the limits. The two axes along which the
    /// fewest cells are crossed determine the number of polygons.
    fn new(patch: &Patch, Limits { parts, cells }: Limits) -> Self {
        let (whole, _) = patch.cut(LONGEST);
        let [a, b] = whole.steps;
        let mut crossed = [0, 1, 2].map(|axis| (a[axis].abs() + b[axis].abs(), axis));
        crossed.sort_by(|x, y| x.0.total_cmp(&y.0));
        let [(_, i), (_, j), _] = crossed;
        let longer = a.abs().max_element().max(b.abs().max_element()).max(1.0);
        let area = (a[i] * b[j] - a[j] * b[i]).abs();
        let of_parts = (parts / (2.0 + area / longer)).max((1.0 + parts).sqrt() - 1.0);
        let of_cells = (cells / whole.width().max(1e-9)).max(cells.sqrt());
        let (part, share) = whole.cut(of_parts.min(of_cells));
        Self { whole, part, share }
    }

    /// Returns the average over the whole patch of a product of waves. `factors` returns each wave
    /// with its argument on a patch.
    fn average(&self, factors: impl Fn(&Patch) -> [(Form, Wave); 3]) -> f64 {
        if self.share == 1.0 {
            return average(factors(&self.whole));
        }
        let separate = |factors: [(Form, Wave); 3]| -> f64 {
            factors.iter().map(|(form, wave)| wave.alone(form)).product()
        };
        let correlation = if self.share < NEGLIGIBLE {
            0.0
        } else {
            average(factors(&self.part)) - separate(factors(&self.part))
        };
        separate(factors(&self.whole)) + self.share * correlation
    }
}

impl Checker {
    /// Returns the average over a patch of texture space, linear RGB.
    #[must_use]
    pub fn average(&self, patch: &Patch) -> Color {
        let wave = Wave { width: 0.5, values: [1.0, -1.0] };
        let bounded = Bounded::new(patch, CHECKERS);
        let difference = bounded.average(|patch| {
            [DVec3::X, DVec3::Y, DVec3::Z]
                .map(|axis| (patch.form(axis, BELOW).scaled(0.0, 0.5), wave))
        });
        let part = (0.5 - 0.5 * difference).clamp(0.0, 1.0);
        self.colors[0].lerp(self.colors[1], part)
    }

    /// Returns the average over all space, linear RGB.
    #[must_use]
    pub fn mean(&self) -> Color {
        0.5 * (self.colors[0] + self.colors[1])
    }
}

impl Stripes {
    /// Returns the average over a patch of texture space, linear RGB.
    #[must_use]
    pub fn average(&self, patch: &Patch) -> Color {
        let form = patch.form(DVec3::X, BELOW);
        self.weighted(|start, thickness, period| {
            let mut of_layer = form.scaled(start, 1.0 / period);
            let longest = DVec2::splat(LONGEST);
            of_layer.slopes = of_layer.slopes.clamp(-longest, longest);
            average([(of_layer, Wave::pulse(thickness / period))]).clamp(0.0, 1.0)
        })
    }

    /// Returns the average over all space, linear RGB.
    #[must_use]
    pub fn mean(&self) -> Color {
        self.weighted(|_, thickness, period| thickness / period)
    }

    /// Returns the sum of the layers' colours with weights. The weight is a function of the layer's
    /// start, its thickness and the sum of all thicknesses. Weights are divided by their sum.
    fn weighted(&self, weight: impl Fn(f64, f64, f64) -> f64) -> Color {
        let period: f64 = self.layers.iter().map(|(thickness, _)| thickness).sum();
        let (mut start, mut sum, mut total) = (0.0, Color::ZERO, 0.0);
        for &(thickness, color) in &self.layers {
            let weight = weight(start, thickness, period);
            sum += weight * color;
            total += weight;
            start += thickness;
        }
        if total > 0.0 { sum / total } else { Color::ZERO }
    }
}

impl Brick {
    /// Returns the average over a patch of texture space, linear RGB.
    #[must_use]
    pub fn average(&self, patch: &Patch) -> Color {
        let cells = Patch {
            center: (patch.center + BELOW) / self.size,
            steps: patch.steps.map(|step| step / self.size),
        };
        if !cells.is_finite() {
            return self.mean();
        }
        let counted = Bounded::new(&cells, TONES);
        let (bricks, tone) = if counted.share == 1.0 {
            self.tones(&cells)
        } else if counted.share < NEGLIGIBLE {
            (self.inside(&cells), 0.0)
        } else {
            (self.inside(&cells), counted.share * self.tones(&counted.part).1)
        };
        let joints = 1.0 - bricks;
        self.colors[0] * (bricks + tone) + self.colors[1] * joints
    }

    /// Returns the average over all space, linear RGB.
    #[must_use]
    pub fn mean(&self) -> Color {
        self.colors[1].lerp(self.colors[0], self.filled().element_product())
    }

    /// Returns the part of a cell, along each axis, that is not joint.
    fn filled(&self) -> DVec3 {
        1.0 - self.joint / self.size
    }

    /// Returns the part of a patch, in units of cells, that lies in bricks: the sum of the parts in
    /// even rows and in odd rows.
    fn inside(&self, cells: &Patch) -> f64 {
        let filled = self.filled();
        let rows = Wave::pulse(0.5 * filled.y);
        let bounded = Bounded::new(cells, BRICKS);
        let in_rows = |odd: f64| {
            bounded.average(|cells| {
                [
                    (cells.form(DVec3::X, -0.5 * odd), Wave::pulse(filled.x)),
                    (cells.form(DVec3::Y, -odd).scaled(0.0, 0.5), rows),
                    (cells.form(DVec3::Z, 0.0), Wave::pulse(filled.z)),
                ]
            })
        };
        (in_rows(0.0) + in_rows(1.0)).clamp(0.0, 1.0)
    }

    /// Returns the part of a patch that lies in bricks, and this part weighted with the tone of
    /// each brick less 1.
    fn tones(&self, cells: &Patch) -> (f64, f64) {
        let filled = self.filled();
        let (mut inside, mut tone) = (0.0, 0.0);
        // Numbers of cells stay exact in the hash of a brick, and positions are small.
        let first = cells.center.floor();
        let form = |axis: DVec3, start: f64| cells.form(axis, -start);
        let y = form(DVec3::Y, first.y);
        let z = form(DVec3::Z, first.z);
        Wave::pulse(filled.y).strips(&y, &Convex::square(), &mut |row, _, j| {
            let j = first.y + j;
            let x = form(DVec3::X, first.x + 0.5 * j.rem_euclid(2.0));
            Wave::pulse(filled.x).strips(&x, row, &mut |part, _, i| {
                Wave::pulse(filled.z).strips(&z, part, &mut |part, _, k| {
                    let brick = [first.x + i, j, first.z + k].map(|x| x as i64);
                    let area = part.area();
                    inside += area;
                    tone += area * self.vary * (share(mixed_at(brick, 41)) - 0.5);
                });
            });
        });
        (inside.clamp(0.0, 1.0), tone)
    }
}
