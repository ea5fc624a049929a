//! Blends: the two contours around a position of the trajectory, and the profile between them.
//!
//! Let `A` and `B` be the contours before and after a position, and `w(v)` the weight of `B`. Then the
//! profile and its derivatives are
//!
//! ```text
//!     q = A + w (B - A),   q_u = A_u + w (B_u - A_u),   q_uu likewise,   q_v = w' (B - A)
//! ```
//!
//! Before the first and after the last contour the profile is constant. Along a closed trajectory the last
//! contour blends into the first.

use super::Column;
use crate::law::Ease;
use crate::surface::contour::Local2;
use glam::DVec2;

/// Positions of a profile's contours on the trajectory.
#[derive(Debug, Clone)]
pub struct Blend {
    /// Fractions of the trajectory's length, strictly rising, one for each contour.
    pub(crate) at: Vec<f64>,
    /// Interpolation between two neighbouring contours.
    pub(crate) ease: Ease,
    /// True if the last contour blends into the first.
    pub(crate) wraps: bool,
}

/// Two neighbouring contours and the weight of the second.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mix {
    /// Index of the first contour.
    from: usize,
    /// Index of the second contour.
    to: usize,
    /// Weight of the second contour in `[0, 1]`.
    part: f64,
    /// Derivative of the weight by `v`.
    part_v: f64,
}

/// A point of a contour, with its change along the trajectory.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Moving {
    pub local: Local2,
    /// Derivative of the point by `v`.
    pub across: DVec2,
    /// Derivative by `v` of the tangent's angle, in radians.
    pub turning: f64,
}

impl Blend {
    /// Returns the two contours around `v`, with the weight there.
    pub(crate) fn at(&self, v: f64) -> Mix {
        let last = self.at.len() - 1;
        let held = |index| Mix { from: index, to: index, part: 0.0, part_v: 0.0 };
        let next = self.at.partition_point(|&at| at <= v);
        let (from, to, start, end) = match next {
            0 if self.wraps => (last, 0, self.at[last] - 1.0, self.at[0]),
            0 => return held(0),
            _ if next <= last => (next - 1, next, self.at[next - 1], self.at[next]),
            _ if self.wraps => (last, 0, self.at[last], self.at[0] + 1.0),
            // At the end of the trajectory the side before counts, as in laws.
            _ if v >= 1.0 && self.at[last] == 1.0 && last > 0 => {
                (last - 1, last, self.at[last - 1], 1.0)
            }
            _ => return held(last),
        };
        let x = (v - start) / (end - start);
        let (part, slope) = self.ease.weight(x);
        Mix { from, to, part, part_v: slope / (end - start) }
    }
}

impl Mix {
    /// Returns the profile's point at a column, with its derivatives.
    pub(crate) fn of(&self, column: &Column) -> Moving {
        let (a, b) = (column.on(self.from), column.on(self.to));
        let between = |a: DVec2, b: DVec2| a + (b - a) * self.part;
        // Derivatives of the points by `u`.
        let [a_u, b_u] = [a, b].map(|local| local.tangent / local.pace);
        let bend =
            |local: &Local2, velocity: DVec2| velocity.perp() * (local.curvature / local.pace);
        let q_u = between(a_u, b_u);
        let speed = q_u.length();
        // Contours that run against each other have a point without a direction.
        let pace = if speed > 0.0 { 1.0 / speed } else { 0.0 };
        let tangent = q_u * pace;
        let curvature = tangent.perp_dot(between(bend(a, a_u), bend(b, b_u))) * (pace * pace);
        Moving {
            local: Local2 { point: between(a.point, b.point), tangent, curvature, pace },
            across: (b.point - a.point) * self.part_v,
            turning: tangent.perp_dot(b_u - a_u) * (self.part_v * pace),
        }
    }
}

impl Moving {
    /// Returns a point of a contour that does not change along the trajectory.
    pub(crate) fn still(local: Local2) -> Self {
        Self { local, across: DVec2::ZERO, turning: 0.0 }
    }
}

impl Column {
    /// Returns the point on the contour with this index.
    fn on(&self, contour: usize) -> &Local2 {
        if contour == 0 { &self.first } else { &self.others[contour - 1] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mix(blend: &Blend, v: f64) -> (usize, usize, f64) {
        let mix = blend.at(v);
        (mix.from, mix.to, mix.part)
    }

    #[test]
    fn contours_are_held_outside_and_wrap_along_a_closed_trajectory() {
        let at = vec![0.25, 0.5, 0.75];
        let open = Blend { at: at.clone(), ease: Ease::Linear, wraps: false };
        assert_eq!([0.1, 0.25].map(|v| mix(&open, v)), [(0, 0, 0.0), (0, 1, 0.0)]);
        assert_eq!([0.375, 0.9].map(|v| mix(&open, v)), [(0, 1, 0.5), (2, 2, 0.0)]);
        let closed = Blend { at, ease: Ease::Linear, wraps: true };
        assert_eq!([0.0, 0.125].map(|v| mix(&closed, v)), [(2, 0, 0.5), (2, 0, 0.75)]);
        assert_eq!([0.875, 1.0].map(|v| mix(&closed, v)), [(2, 0, 0.25), (2, 0, 0.5)]);
    }

    #[test]
    fn the_end_is_met_from_before() {
        let blend = Blend { at: vec![0.0, 1.0], ease: Ease::Linear, wraps: false };
        let end = blend.at(1.0);
        assert_eq!((end.from, end.to, end.part, end.part_v), (0, 1, 1.0, 1.0));
        let smooth = Blend { ease: Ease::Smooth, ..blend };
        assert_eq!((smooth.at(1.0).part_v, smooth.at(0.5).part), (0.0, 0.5));
    }
}
