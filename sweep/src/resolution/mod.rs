//! How finely a surface is cut: in rows x cols, or as its shape asks for.
//!
//! Where a *tolerance* is asked for, the grid stays a product of rows and columns, so that no
//! T-junction can occur; what is chosen is where the stops lie. `search` does it:
//!
//! 1. `measure` cuts the surface and finds, in every cell, how far the triangles are from the true
//!    surface and what the cell's width and height contribute to that.
//! 2. `demand` finds the widths of columns and heights of rows that keep the tolerance with the
//!    fewest cells: the product of two integrals is least under a bound on every cell, which is a
//!    convex problem in the logarithms. `place` puts the stops accordingly.
//! 3. What comes out is measured again, and so on until it is kept, and then thinned out until a
//!    column or a row less would break it.
//!
//! So the surface's laws, twist and relief need no second derivatives, and what is reported is
//! measured on the triangles themselves. All errors are taken relative to what is allowed, so that
//! the unit of length does not matter.

mod demand;
mod measure;
pub(crate) mod place;
mod search;
mod triangle;
mod view;

pub use measure::Surface;
pub use search::{Cells, Search};
pub use view::View;

use glam::DVec3;

/// How finely a surface is cut.
#[derive(Debug, Clone, PartialEq)]
pub enum Resolution {
    /// Cells along the trajectory and the contour, of equal length on each smooth piece.
    Cells {
        /// Cells along the trajectory.
        rows: usize,
        /// Cells along the contour, those of no width at creases not counted.
        cols: usize,
    },
    /// As many as keep a tolerance.
    Tolerance(Tolerance),
}

/// What triangles may be off by.
#[derive(Debug, Clone, PartialEq)]
pub struct Tolerance {
    /// How far from the surface they may be, if that counts.
    pub distance: Option<Distance>,
    /// The largest angle in radians between a triangle and the surface over it, if that counts:
    /// between the triangle's own direction and the true normals at its corners. Normals
    /// interpolated between the corners are nearer to the truth by an order.
    pub angle: Option<f64>,
    /// Cells at most.
    pub max_quads: usize,
}

/// How far triangles may be from the surface.
#[derive(Debug, Clone, PartialEq)]
pub enum Distance {
    /// The same everywhere, in the spec's unit.
    Everywhere(f64),
    /// As many pixels of a picture.
    Pixels(f64, View),
}

/// What a grid made to a tolerance has come to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reached {
    /// The largest distance measured between the triangles and the surface, in the spec's unit.
    pub tol: f64,
    /// The same in pixels, where pixels were asked for.
    pub pixels: Option<f64>,
    /// The largest angle measured between a triangle and the surface, in degrees.
    pub angle_deg: f64,
    /// Cells, those of no width at creases not counted.
    pub quads: usize,
    /// How often the surface was cut and measured.
    pub rounds: usize,
    /// Whether all that was asked for is kept.
    pub kept: bool,
}

impl Tolerance {
    /// By how much it is missed, in words; nothing where it is kept.
    #[must_use]
    pub fn missed(&self, reached: &Reached) -> Option<String> {
        if reached.kept {
            return None;
        }
        let distance = match (&self.distance, reached.pixels) {
            (Some(Distance::Everywhere(tol)), _) => {
                Some(format!("{:.3e} from the surface, not {tol:?}", reached.tol))
            }
            (Some(Distance::Pixels(pixels, _)), Some(most)) => {
                Some(format!("{most:.3} pixels from the surface, not {pixels:?}"))
            }
            _ => None,
        };
        let angle = self.angle.map(|angle| {
            let asked = angle.to_degrees();
            format!("{:.3} degrees from its normals, not {asked:.3}", reached.angle_deg)
        });
        let off: Vec<String> = distance.into_iter().chain(angle).collect();
        let (quads, most, off) = (reached.quads, self.max_quads, off.join(" and "));
        Some(format!(
            "the tolerance is not kept: with {quads} of at most {most} quads the triangles are up to \
             {off}"
        ))
    }

    /// One over the distance that is allowed at a point; 0 where none is too large.
    pub(crate) fn per_distance(&self, point: DVec3) -> f64 {
        match &self.distance {
            None => 0.0,
            Some(Distance::Everywhere(tol)) => 1.0 / tol,
            Some(Distance::Pixels(pixels, view)) => 1.0 / (pixels * view.pixel_at(point)),
        }
    }

    /// One over the square of what is allowed between unit normals: the chord of the angle.
    pub(crate) fn per_turn_sq(&self) -> f64 {
        self.angle.map_or(0.0, |angle| (2.0 * (0.5 * angle).sin()).powi(-2))
    }
}
