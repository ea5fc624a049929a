//! Stations: contours placed on a trajectory, with points, stretch and normals in closed form.

use crate::curve::turn;
use crate::frame::Frame;
use glam::{DVec2, DVec3};

/// A contour placed on a trajectory: a frame, and the motion of its points when the station moves.
#[derive(Debug, Clone, Copy)]
pub struct Station {
    /// The frame that carries the contour's axes.
    pub frame: Frame,
    /// Speed along the tangent, per length of the trajectory, of the point at the contour's origin.
    pub(super) forward: f64,
    /// Gradient of that speed over the contour: the speed of the point at `q` is `forward + bend . q`.
    pub(super) bend: DVec2,
    /// Displacement along the tangent at a mitre, per unit of contour x and y: a point at `q` moves by
    /// `shear . q`.
    pub(super) shear: DVec2,
    /// Turn of the frame about the tangent, in radians per length.
    pub(super) spin: f64,
    /// True if contour x = 0 is an axis that all stations share.
    pub(super) on_axis: bool,
}

impl Station {
    /// Returns a station on a straight piece whose frame does not turn.
    pub(super) fn along(frame: Frame) -> Self {
        Self {
            frame,
            forward: 1.0,
            bend: DVec2::ZERO,
            shear: DVec2::ZERO,
            spin: 0.0,
            on_axis: false,
        }
    }

    /// Returns the point of the surface above a point `q` of the contour.
    #[must_use]
    pub fn point(&self, q: DVec2) -> DVec3 {
        let Frame { origin, normal, binormal, tangent } = self.frame;
        if self.on_axis && q.x == 0.0 {
            // A pole must be equal in every row to the last bit. 0 * w1 could give -0 instead of 0.
            return origin + binormal * q.y;
        }
        let upright = origin + normal * q.x + binormal * q.y;
        if self.shear == DVec2::ZERO { upright } else { upright + tangent * self.shear.dot(q) }
    }

    /// Returns this station with the contour turned about the tangent by a fraction of a full turn,
    /// right-handed from w1 toward w2. The angle changes at `rate` radians per length.
    pub(crate) fn turned(self, fraction: f64, rate: f64) -> Self {
        let angle = turn(fraction);
        let Frame { normal, binormal, .. } = self.frame;
        let frame = Frame {
            normal: normal * angle.x + binormal * angle.y,
            binormal: binormal * angle.x - normal * angle.y,
            ..self.frame
        };
        // Expresses a vector on the new axes.
        let back = |v: DVec2| DVec2::new(angle.x, -angle.y).rotate(v);
        let (bend, shear) = (back(self.bend), back(self.shear));
        Self { frame, bend, shear, spin: self.spin + rate, ..self }
    }

    /// Returns a station straight ahead at this `distance`, which moves forward at `rate`.
    pub(crate) fn beyond(self, distance: f64, rate: f64) -> Self {
        let origin = self.frame.origin + self.frame.tangent * distance;
        Self { forward: rate, ..Self::along(Frame { origin, ..self.frame }) }
    }

    /// Returns the speed of the point at `q` along the tangent, per length of the trajectory at the contour's
    /// origin (per radian for a rotation). Not above 0 where the surface folds back on itself.
    #[must_use]
    pub fn stretch(&self, q: DVec2) -> f64 {
        self.forward + self.bend.dot(q)
    }

    /// Returns a vector perpendicular to the section: the tangent, unless the section is sheared.
    fn across(&self) -> DVec3 {
        let Frame { tangent, normal, binormal, .. } = self.frame;
        if self.shear == DVec2::ZERO {
            return tangent;
        }
        tangent - normal * self.shear.x - binormal * self.shear.y
    }

    /// Returns the unit normal above a point `q` of the contour with the unit tangent `q_u`.
    ///
    /// The normal is the direction of `S_u x S_v` in closed form, with `S_u = q_u.x w1 + q_u.y w2` and
    /// `S_v = stretch T + spin (q.x w2 - q.y w1)`. A rotation has no spin, so the radius cancels in its
    /// normal, and a pole has a normal like any other point. On a section with a shear `m`, `w1 + m1 T` and
    /// `w2 + m2 T` replace `w1` and `w2`. Then
    /// `S_u x S_v = stretch (q2_u w1 - q1_u w2) + spin (q.q_u) (T - m1 w1 - m2 w2)`.
    #[must_use]
    pub fn normal(&self, q: DVec2, q_u: DVec2) -> DVec3 {
        self.normal_stretched(q, q_u, self.stretch(q))
    }

    /// Returns the normal as [`Station::normal`] does, for the known `stretch` at `q`.
    pub(crate) fn normal_stretched(&self, q: DVec2, q_u: DVec2, stretch: f64) -> DVec3 {
        let Frame { normal, binormal, .. } = self.frame;
        let outward = normal * q_u.y - binormal * q_u.x;
        if self.spin == 0.0 {
            return if stretch < 0.0 { -outward } else { outward };
        }
        let across = outward * stretch + self.across() * (self.spin * q.dot(q_u));
        across.try_normalize().unwrap_or(outward)
    }

    /// Returns the unit normal, as [`Station::normal`] does, for a contour that changes along the trajectory.
    /// `q_u` is its direction, of any length. `q_s` is the derivative of its point on the contour's axes, per
    /// length of the trajectory. `stretch` is the known stretch at `q`.
    pub(crate) fn normal_of_moving(&self, q: DVec2, q_u: DVec2, q_s: DVec2, stretch: f64) -> DVec3 {
        let Frame { normal, binormal, .. } = self.frame;
        let outward = normal * q_u.y - binormal * q_u.x;
        let moving = q_s + q.perp() * self.spin;
        let across = outward * stretch + self.across() * q_u.perp_dot(moving);
        // A contour pressed flat has no direction where it turns back.
        across.try_normalize().or(outward.try_normalize()).unwrap_or(normal)
    }
}
