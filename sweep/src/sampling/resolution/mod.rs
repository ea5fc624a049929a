//! Resolution of a surface: rows x cols, or as fine as a tolerance needs.
//!
//! With a *tolerance*, the grid remains a product of rows and columns, so that no T-junction can occur. Only
//! the positions of the stops are chosen. `search` does this:
//!
//! 1. `measure` cuts the surface. In every cell it measures the distance of the triangles from the true
//!    surface, and how the cell's width and height contribute to that.
//! 2. `demand` finds the widths of columns and heights of rows that keep the tolerance with the fewest cells.
//!    The product of two integrals is minimized under a bound on every cell, which is a convex problem in the
//!    logarithms. `stops` puts the stops accordingly.
//! 3. The result is measured again, and the steps are repeated until the tolerance is kept. Then columns and
//!    rows are removed until one less would break it.
//! 4. `stall` ends the search where finer cells do not come nearer to an angle. Then the coarsest cells that come as
//!    near are made.
//!
//! So no second derivatives of the surface's laws, twist and relief are needed, and the reported errors are
//! measured on the triangles themselves. All errors are relative to the tolerance, so the unit of length does
//! not matter.

mod demand;
mod measure;
mod search;
mod stall;
pub(crate) mod stops;
mod triangle;
mod view;

pub use search::{Cells, Search, Tell};
pub use view::View;

use glam::DVec3;

/// Resolution of a surface.
#[derive(Debug, Clone, PartialEq)]
pub enum Resolution {
    /// Numbers of cells along the trajectory and the contour, of equal length on each smooth piece.
    Cells {
        /// Number of cells along the trajectory.
        rows: usize,
        /// Number of cells along the contour, without the cells of no width at creases.
        cols: usize,
    },
    /// As many cells as a tolerance needs.
    Tolerance(Tolerance),
}

/// Largest allowed errors of the triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Tolerance {
    /// Largest distance from the surface, if it is bounded.
    pub distance: Option<Distance>,
    /// Largest angle in radians between a triangle and the surface over it, if it is bounded. The angle is
    /// that between the triangle's own normal and the true normals at its corners. Normals interpolated
    /// between the corners are more accurate by one order.
    pub angle: Option<f64>,
    /// Largest number of cells.
    pub max_quads: usize,
}

/// Largest allowed distance of triangles from the surface.
#[derive(Debug, Clone, PartialEq)]
pub enum Distance {
    /// One distance everywhere, in the spec's unit.
    Everywhere(f64),
    /// A number of pixels of a picture.
    Pixels(f64, View),
}

/// The accuracy and the cost of a grid made to a tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reached {
    /// Largest measured distance between the triangles and the surface, in the spec's unit.
    pub tol: f64,
    /// Largest measured distance in pixels, if the tolerance is in pixels.
    pub pixels: Option<f64>,
    /// Largest measured angle between a triangle and the surface, in degrees.
    pub angle_deg: f64,
    /// Number of cells, without those of no width at creases.
    pub quads: usize,
    /// Number of times that the surface was cut and measured.
    pub rounds: usize,
    /// True if the whole tolerance is kept.
    pub kept: bool,
}

impl Tolerance {
    /// Returns a sentence that says by how much the tolerance is missed; `None` if it is kept.
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
            (Some(Distance::Pixels(..)), None) | (None, _) => None,
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

    /// Returns 1 over the distance allowed at a point; 0 if distances are not bounded.
    pub(crate) fn per_distance(&self, point: DVec3) -> f64 {
        match &self.distance {
            None => 0.0,
            Some(Distance::Everywhere(tol)) => 1.0 / tol,
            Some(Distance::Pixels(pixels, view)) => 1.0 / (pixels * view.pixel_at(point)),
        }
    }

    /// Returns 1 over the square of the chord between unit normals at the allowed angle; 0 if angles are not
    /// bounded.
    pub(crate) fn per_turn_sq(&self) -> f64 {
        self.angle.map_or(0.0, |angle| (2.0 * (0.5 * angle).sin()).powi(-2))
    }
}
