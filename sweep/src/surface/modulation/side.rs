//! Sides of a wall: a section moved along the normals of its contour.
//!
//! Let `C` be the contour by its length `l`, `R` the contour with its relief, `S` the scale, `n` the outer normal of `S C`
//! and `d` the distance. Then the side and its derivatives are
//!
//! ```text
//!     q   = S R + d n
//!     q_l = S R_l + d n_l
//!     q_s = (S R)_s + d_s n + d n_s
//! ```
//!
//! The normal is that of the contour without its relief. So a relief on the outer side of a wall has the heights that it
//! has without a wall, and does not show on the inner side. Between two corners the vector from one mitre to the next
//! replaces `n`, so that the side ends where the moved sides meet.

use super::{Local, PRESSED, Section};
use crate::surface::profile::{Column, Side2};
use glam::DVec2;

/// A vector that moves a point out of the contour, with its derivatives by length of the contour and of the trajectory.
#[derive(Debug, Clone, Copy)]
struct Out {
    out: DVec2,
    out_l: DVec2,
    out_s: DVec2,
}

/// A direction of the scaled contour, and its rate of turn along the trajectory.
#[derive(Debug, Clone, Copy)]
struct Turning {
    normal: DVec2,
    normal_s: DVec2,
}

impl Section {
    /// Moves a point of the section along its outer normal by an offset, which changes by `slope` along the trajectory.
    /// `axes` are the factors of the direction `q_u` of the point: the scale divided by its larger factor.
    pub(super) fn move_out(
        &self,
        local: &mut Local,
        [offset, slope]: [f64; 2],
        column: &Column,
        axes: DVec2,
    ) {
        let own = column.first.tangent;
        let Some(here) = self.turning(own, axes) else { return };
        let tangent = here.normal.perp();
        let Out { out, out_l, out_s } = match column.side {
            Some(side) => self.between_corners(here, column, side, axes),
            None => {
                let curvature = column.first.curvature * self.scale.x * self.scale.y;
                let stretched = (self.scale * own).length();
                let bend = curvature / stretched.powi(3);
                local.folds |= 1.0 + offset * bend < 0.0;
                Out { out: here.normal, out_l: tangent * (bend * stretched), out_s: here.normal_s }
            }
        };
        local.q += out * offset;
        local.q_s += out * slope + out_s * offset;
        let size = self.scale.abs().max_element();
        if self.relief.is_some() && size > 0.0 {
            // Without a relief the side is parallel to the contour.
            let forward = local.q_u.dot(tangent) > 0.0;
            local.q_u += out_l * (offset / size);
            local.folds |= forward && local.q_u.dot(tangent) < 0.0;
        }
    }

    /// Returns the normal of the scaled contour at a tangent of the contour. `None` if the contour has no direction there.
    fn turning(&self, own: DVec2, axes: DVec2) -> Option<Turning> {
        let along = axes * own;
        // A side along an axis that is pressed flat keeps its direction.
        let pressed = along.length_squared() <= (PRESSED * own.length()).powi(2);
        let tangent = if pressed { self.signs * own } else { along }.try_normalize()?;
        let normal = -tangent.perp();
        // The scale turns the tangent as it changes, and the normal turns with the tangent.
        let length = (self.scale * own).length();
        let rate = if length > 0.0 { tangent.perp_dot(self.scale_s * own) / length } else { 0.0 };
        Some(Turning { normal, normal_s: tangent * rate })
    }

    /// Returns the vector from a side of a polygon to the moved side, between the mitres at both its corners.
    fn between_corners(&self, here: Turning, column: &Column, side: Side2, axes: DVec2) -> Out {
        let mitre = |other: DVec2| {
            let other = self.turning(other, axes).unwrap_or(here);
            let whole = 1.0 + other.normal.dot(here.normal);
            let out = (other.normal + here.normal) / whole;
            let whole_s = other.normal_s.dot(here.normal) + other.normal.dot(here.normal_s);
            [out, (other.normal_s + here.normal_s - out * whole_s) / whole]
        };
        let [[start, start_s], [end, end_s]] = side.around.map(mitre);
        let length = side.length / column.first.pace;
        Out {
            out: start.lerp(end, side.part),
            out_l: (end - start) / length,
            out_s: start_s.lerp(end_s, side.part),
        }
    }
}
