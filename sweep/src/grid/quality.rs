//! Quality of a grid, as far as the program that made it knows it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Folds of a surface: parts that run backward because the trajectory bends more sharply than the contour is
/// wide.
///
/// At a point `q` of the contour the surface is stretched along the trajectory by `1 - k.q`, where `k` is the
/// trajectory's curvature. Where this is below 0 the surface runs backward.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fold {
    /// The smallest stretch of all points.
    pub worst: f64,
    /// Number of rows in which part of the surface runs backward.
    pub rows: usize,
    /// The largest factor of the contour with which no part would run backward.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fits: Option<f64>,
}

/// Requested and measured accuracy of a grid. A value that was not requested, or not measured, is `None`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Tolerance {
    /// Requested largest distance between surface and mesh, in the grid's unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub asked: Option<f64>,
    /// Largest measured distance between surface and mesh, in the grid's unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reached: Option<f64>,
    /// Requested largest angle between a triangle and the surface's normals at its corners, in degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angle_asked_deg: Option<f64>,
    /// Largest measured angle between a triangle and the surface's normals at its corners, in degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angle_reached_deg: Option<f64>,
    /// Requested largest distance on the picture of a camera, in pixels.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pixels: Option<f64>,
}

impl Fold {
    /// Returns the folds of two patches together.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            worst: self.worst.min(other.worst),
            rows: self.rows.saturating_add(other.rows),
            fits: both(self.fits, other.fits, f64::min),
        }
    }

    pub(super) fn is_finite(&self) -> bool {
        [Some(self.worst), self.fits].iter().flatten().all(|x| x.is_finite())
    }
}

impl Tolerance {
    /// Returns the tolerances of two patches together: the strictest request and the worst measurement.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            asked: both(self.asked, other.asked, f64::min),
            reached: both(self.reached, other.reached, f64::max),
            angle_asked_deg: both(self.angle_asked_deg, other.angle_asked_deg, f64::min),
            angle_reached_deg: both(self.angle_reached_deg, other.angle_reached_deg, f64::max),
            pixels: both(self.pixels, other.pixels, f64::min),
        }
    }

    pub(super) fn is_finite(&self) -> bool {
        let Self { asked, reached, angle_asked_deg, angle_reached_deg, pixels } = self;
        let all = [asked, reached, angle_asked_deg, angle_reached_deg, pixels];
        all.into_iter().flatten().all(|x| x.is_finite())
    }
}

/// Returns the only value given, or `of` both.
fn both(a: Option<f64>, b: Option<f64>, of: fn(f64, f64) -> f64) -> Option<f64> {
    match (a, b) {
        (Some(a), Some(b)) => Some(of(a, b)),
        (one, other) => one.or(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_two_patches_the_worse_counts() {
        let one = Fold { worst: -0.5, rows: 2, fits: None };
        let other = Fold { worst: 0.25, rows: 1, fits: Some(0.75) };
        assert_eq!(one.and(other), Fold { worst: -0.5, rows: 3, fits: Some(0.75) });
        let one = Tolerance { asked: Some(1.0), reached: Some(0.5), ..Tolerance::default() };
        let other = Tolerance { asked: Some(2.0), reached: Some(3.0), pixels: Some(0.5), ..one };
        assert_eq!(one.and(other), Tolerance { asked: Some(1.0), ..other });
    }
}
