//! `noise` (thesis 2.1, fig. 2.1): random values of a lattice, interpolated in each cell.
//!
//! The figure interpolates linearly. Values are then continuous from cell to cell, but slopes are
//! not: a bumped surface shows the faces of the cells as creases. The two other methods replace
//! each offset by a curve. With `3t^2 - 2t^3` slopes are continuous as well. With
//! `6t^5 - 15t^4 + 10t^3` curvatures are too (K. Perlin, "Improving Noise", 2002). Both make the
//! noise flat at the lattice points and keep its range.

use super::lattice::{Cell, NoiseLattice};
use glam::DVec3;
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::Arc;

/// Interpolation of lattice values in a cell.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Interpolation {
    /// Linear along each axis, as in the thesis: continuous, with creases at the faces of cells.
    Linear,
    /// Cubic: slopes are continuous.
    #[default]
    Smooth,
    /// Quintic: curvatures are continuous.
    Smoother,
}

impl Interpolation {
    /// Returns the weight of the upper corner at an offset `t` in `[0, 1]`. The weight is in
    /// `[0, 1]` too.
    #[must_use]
    pub fn fade(self, t: f64) -> f64 {
        match self {
            Self::Linear => t,
            Self::Smooth => t * t * (3.0 - 2.0 * t),
            Self::Smoother => t * t * t * (10.0 + t * (6.0 * t - 15.0)),
        }
    }

    /// Returns the derivative of [`Interpolation::fade`] at `t` in `[0, 1]`.
    #[must_use]
    pub fn slope(self, t: f64) -> f64 {
        match self {
            Self::Linear => 1.0,
            Self::Smooth => 6.0 * t * (1.0 - t),
            Self::Smoother => 30.0 * t * t * (1.0 - t) * (1.0 - t),
        }
    }
}

/// A noise: a lattice and its interpolation.
#[derive(Debug, Clone, PartialEq)]
pub struct Noise {
    /// The random values, which all noises of a scene share.
    pub lattice: Arc<NoiseLattice>,
    /// Interpolation between the values.
    pub interpolation: Interpolation,
}

impl Noise {
    /// Returns the noise at a point of texture space, in `[-1, 1]`.
    #[must_use]
    pub fn value(&self, point: DVec3) -> f64 {
        let cell = Cell::of(point);
        interpolated(self.corners(&cell), self.faded(&cell))
    }

    /// Returns the derivatives of [`Noise::value`] along x, y and z. On a face between cells, where
    /// linear interpolation has two derivatives, it returns the one of the upper cell.
    #[must_use]
    pub fn gradient(&self, point: DVec3) -> DVec3 {
        let cell = Cell::of(point);
        by_weights(self.corners(&cell), self.faded(&cell)) * self.fade_slopes(&cell)
    }

    /// Returns the values at the corners of a cell, in the figure's order. Bit 0 of the corner's
    /// index selects the upper x, bit 1 the upper z and bit 2 the upper y.
    pub(super) fn corners(&self, cell: &Cell) -> [f64; 8] {
        std::array::from_fn(|k| self.lattice.value(cell.at(step(k))))
    }

    pub(super) fn faded(&self, cell: &Cell) -> DVec3 {
        cell.offset.map(|t| self.interpolation.fade(t))
    }

    pub(super) fn fade_slopes(&self, cell: &Cell) -> DVec3 {
        cell.offset.map(|t| self.interpolation.slope(t))
    }
}

/// Returns the position of corner `k` of fig. 2.1 in its cell.
pub(super) fn step(k: usize) -> [i64; 3] {
    [k & 1, k >> 2 & 1, k >> 1 & 1].map(|x| x as i64)
}

/// Interpolates as fig. 2.1 does, in its order of operations.
pub(super) fn interpolated(v: [f64; 8], o: DVec3) -> f64 {
    let n00 = v[0] + o.x * (v[1] - v[0]);
    let n01 = v[2] + o.x * (v[3] - v[2]);
    let n10 = v[4] + o.x * (v[5] - v[4]);
    let n11 = v[6] + o.x * (v[7] - v[6]);
    let n0 = n00 + o.y * (n10 - n00);
    let n1 = n01 + o.y * (n11 - n01);
    n0 + o.z * (n1 - n0)
}

/// Returns the derivatives of [`interpolated`] by its three weights.
pub(super) fn by_weights(v: [f64; 8], o: DVec3) -> DVec3 {
    let [n00, n01] = [v[0] + o.x * (v[1] - v[0]), v[2] + o.x * (v[3] - v[2])];
    let [n10, n11] = [v[4] + o.x * (v[5] - v[4]), v[6] + o.x * (v[7] - v[6])];
    let [n0, n1] = [n00 + o.y * (n10 - n00), n01 + o.y * (n11 - n01)];
    let between = |lower: f64, upper: f64, t: f64| lower + t * (upper - lower);
    let by_x = between(
        between(v[1] - v[0], v[5] - v[4], o.y),
        between(v[3] - v[2], v[7] - v[6], o.y),
        o.z,
    );
    let by_y = between(n10 - n00, n11 - n01, o.z);
    DVec3::new(by_x, by_y, n1 - n0)
}
