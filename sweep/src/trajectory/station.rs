//! A contour's place on a trajectory: points, stretch and normals in closed form.

use crate::curve::turn;
use crate::frame::Frame;
use glam::{DVec2, DVec3};

/// A contour's place on a trajectory: a frame, and how a point moves when the station does.
#[derive(Debug, Clone, Copy)]
pub struct Station {
    /// Where the contour's axes lie.
    pub frame: Frame,
    /// The speed along the tangent, by length of the trajectory, of the point at the origin...
    pub(super) forward: f64,
    /// ... and by how much it changes over the contour: `forward + bend . q`.
    pub(super) bend: DVec2,
    /// Lean of the section toward the tangent, by its `(x, y)`: `shear . q`, at a mitre.
    pub(super) shear: DVec2,
    /// Turn of the frame about the tangent, in radians by length.
    pub(super) spin: f64,
    /// Whether contour x = 0 is an axis that all stations share.
    pub(super) on_axis: bool,
}

impl Station {
    /// A station on a straight piece whose frame does not turn.
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

    /// The point of the surface over a point `q` of the contour.
    #[must_use]
    pub fn point(&self, q: DVec2) -> DVec3 {
        let Frame { origin, normal, binormal, tangent } = self.frame;
        if self.on_axis && q.x == 0.0 {
            // A pole is the same in every row to the last bit, which 0 * w1 need not be: it may
            // be -0.
            return origin + binormal * q.y;
        }
        let upright = origin + normal * q.x + binormal * q.y;
        if self.shear == DVec2::ZERO { upright } else { upright + tangent * self.shear.dot(q) }
    }

    /// The same place with the contour turned about the tangent by a fraction of a full turn, which
    /// changes at `rate` radians by length. Right-handed: from w1 toward w2.
    pub(crate) fn turned(self, fraction: f64, rate: f64) -> Self {
        let angle = turn(fraction);
        let Frame { normal, binormal, .. } = self.frame;
        let frame = Frame {
            normal: normal * angle.x + binormal * angle.y,
            binormal: binormal * angle.x - normal * angle.y,
            ..self.frame
        };
        // The same vectors in space, on the new axes.
        let back = |v: DVec2| DVec2::new(angle.x, -angle.y).rotate(v);
        let (bend, shear) = (back(self.bend), back(self.shear));
        Self { frame, bend, shear, spin: self.spin + rate, ..self }
    }

    /// A place straight ahead, which is moved through at `rate`.
    pub(crate) fn beyond(self, way: f64, rate: f64) -> Self {
        let origin = self.frame.origin + self.frame.tangent * way;
        Self { forward: rate, ..Self::along(Frame { origin, ..self.frame }) }
    }

    /// How far the point over `q` moves along the tangent, by length of the trajectory at the
    /// origin (by radian, for a rotation). Not above 0 where the surface folds back on itself.
    #[must_use]
    pub fn stretch(&self, q: DVec2) -> f64 {
        self.forward + self.bend.dot(q)
    }

    /// A vector across the section: the tangent, unless the section leans.
    fn across(&self) -> DVec3 {
        let Frame { tangent, normal, binormal, .. } = self.frame;
        if self.shear == DVec2::ZERO {
            return tangent;
        }
        tangent - normal * self.shear.x - binormal * self.shear.y
    }

    /// The unit normal over a point `q` of the contour with the unit tangent `q_u`.
    ///
    /// It is `S_u x S_v` in closed form, with `S_u = q_u.x w1 + q_u.y w2` and
    /// `S_v = stretch T + spin (q.x w2 - q.y w1)`. A rotation has no spin, so its normal does not
    /// hold the radius, and a pole has one like any other point. On a section that leans by a shear
    /// `m`, `w1 + m1 T` and `w2 + m2 T` stand for `w1` and `w2`, and so
    /// `S_u x S_v = stretch (q2_u w1 - q1_u w2) + spin (q.q_u) (T - m1 w1 - m2 w2)`.
    #[must_use]
    pub fn normal(&self, q: DVec2, q_u: DVec2) -> DVec3 {
        let Frame { normal, binormal, .. } = self.frame;
        let outward = normal * q_u.y - binormal * q_u.x;
        let stretch = self.stretch(q);
        if self.spin == 0.0 {
            return if stretch < 0.0 { -outward } else { outward };
        }
        let across = outward * stretch + self.across() * (self.spin * q.dot(q_u));
        across.try_normalize().unwrap_or(outward)
    }

    /// The same as [`Station::normal`] for a contour that changes on its way: `q_u` is along it, of
    /// any length, and `q_s` is how its point moves on it by length of the trajectory.
    #[must_use]
    pub(crate) fn normal_of_moving(&self, q: DVec2, q_u: DVec2, q_s: DVec2) -> DVec3 {
        let Frame { normal, binormal, .. } = self.frame;
        let outward = normal * q_u.y - binormal * q_u.x;
        let moving = q_s + q.perp() * self.spin;
        let across = outward * self.stretch(q) + self.across() * q_u.perp_dot(moving);
        // A contour pressed flat has no direction where it turns back.
        across.try_normalize().or(outward.try_normalize()).unwrap_or(normal)
    }
}
