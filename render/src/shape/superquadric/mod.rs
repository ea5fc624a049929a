//! Superellipsoids and supertoroids: rounded boxes, pillows, pinched stars, and rings of these
//! sections.
//!
//! Barr: *Superquadrics and Angle-Preserving Transformations*, IEEE Computer Graphics &
//! Applications 1(1), 1981. With x, y, z in units of the radii and the axis along y, like the poles
//! of a sphere, the surfaces are:
//!
//! ```text
//! superellipsoid   (|x|^(2/e2) + |z|^(2/e2))^(e2/e1) + |y|^(2/e1) = 1
//! supertoroid      | (|x|^(2/e2) + |z|^(2/e2))^(e2/2) - ring |^(2/e1) + |y|^(2/e1) = 1
//! ```
//!
//! e1 shapes the section through the axis, and e2 the section across it. A section is a square near
//! 0, a circle at 1, a square on its corner at 2, and a pinched star above 2.
//!
//! Texture coordinates are defined as on the sphere. `u` is the longitude, eastward from +z toward
//! +x, one half at +z. `v` is the latitude of the direction from the centre in units of the radii.
//! Barr's own parameters are not used, since they crowd at the edges of a boxy shape. On a ring `v`
//! goes around the tube, one half at its outermost line, with a seam at its innermost.

mod field;
mod root;

use super::gradient_changes::Extension;
use super::{Changes, SeamPeriod, Start, SurfacePoint};
use crate::differential;
use field::{Field, Line};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Range of the exponents e1 and e2.
///
/// With smaller exponents edges are sharper than a thousandth of the shape, and a box serves
/// better. With larger exponents the points of the star are thinner than rounding.
pub const EXPONENTS: [f64; 2] = [0.05, 4.0];

/// Range of `ring`: from a ring whose hole is just closed to a thin hoop.
pub const RINGS: [f64; 2] = [1.0, 1000.0];

/// Relative margin of the box in which roots are searched, so that its sides are certainly outside
/// the shape.
const MARGIN: f64 = 1e-6;

/// A superellipsoid or, with a ring, a supertoroid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Superquadric {
    center: DVec3,
    radii: DVec3,
    field: Field,
}

impl Superquadric {
    /// Creates the shape. `radii` are half its size along each axis, or half the size of the tube
    /// of a ring. `exponents` are `[e1, e2]`. `ring` makes a supertoroid: it is the distance of the
    /// middle of the tube from the axis, in units of the radii.
    ///
    /// Returns `None` unless radii are above 0, exponents within [`EXPONENTS`] and a ring within
    /// [`RINGS`].
    #[must_use]
    pub fn new(
        center: DVec3,
        radii: DVec3,
        exponents: [f64; 2],
        ring: Option<f64>,
    ) -> Option<Self> {
        let within = |[low, high]: [f64; 2], x: f64| (low..=high).contains(&x);
        let fits = radii.cmpgt(DVec3::ZERO).all()
            && exponents.into_iter().all(|e| within(EXPONENTS, e))
            && ring.is_none_or(|ring| within(RINGS, ring));
        let [section, across] = exponents.map(|e| 2.0 / e);
        fits.then(|| Self {
            center,
            radii,
            field: Field { section, across, ring: ring.unwrap_or(0.0) },
        })
    }

    /// Returns whether the shape is a supertoroid.
    #[must_use]
    pub fn is_ring(&self) -> bool {
        self.field.ring > 0.0
    }

    /// Returns the nearest distance above 0 at which the ray meets the surface, in units of
    /// `direction`.
    ///
    /// No root is missed, except roots that rounding merges: a ray that touches the surface to
    /// within a few units in the last place may pass or hit. A hit is off the surface by about as
    /// much: 7e-15 for shapes and rays of size 1 to 6 of every kind. A ray that starts on the
    /// surface, according to `start`, meets it again only beyond the skin.
    #[must_use]
    pub fn intersect(&self, origin: DVec3, direction: DVec3, start: Start) -> Option<f64> {
        // Lengths are in units of the radii. t starts at the point of the ray nearest to the
        // centre, so that a long ray loses no digits.
        let from = (origin - self.center) / self.radii;
        let step = direction / self.radii;
        let shift = -from.dot(step) / step.length_squared();
        let line = Line { field: self.field, from: from + shift * step, step };
        let [enter, leave] = self.within_box(&line)?;
        let begin = enter.max(-shift);
        if begin >= leave {
            return None;
        }
        let on_surface = begin == -shift
            && (start.left_face.is_some() || start.skin > 0.0 && self.is_near(from, start.skin));
        let root = if self.field.is_convex() {
            root::of_convex(&line, begin, leave, on_surface)
        } else {
            root::first(&line, begin, leave, on_surface.then_some(begin + start.skin))
        };
        let t = root? + shift;
        (t > 0.0 && (!on_surface || t > start.skin)).then_some(t)
    }

    /// Returns the unit normal at a hit, outward. `near` is the hit as computed along the ray.
    #[must_use]
    pub fn normal(&self, near: DVec3) -> DVec3 {
        self.field.direction(self.refined(near), self.radii)
    }

    /// Returns a hit as a point of the surface, in units of the radii from the centre. `near` is the
    /// hit as computed along the ray.
    fn refined(&self, near: DVec3) -> DVec3 {
        let point = (near - self.center) / self.radii;
        // One Newton step, along the gradient.
        let gradient = self.field.gradient(point) / self.radii;
        let step = (self.field.value(point) - 1.0) / gradient.length_squared() * gradient;
        if step.is_finite() { point - step / self.radii } else { point }
    }

    /// Returns the surface point at a hit. `near` is the hit as computed along the ray.
    #[must_use]
    pub fn surface_point(&self, near: DVec3) -> SurfacePoint {
        let point = self.refined(near);
        let normal = self.field.direction(point, self.radii);
        let longitude = 0.5 - f64::atan2(-point.x, point.z) / TAU;
        let from_axis = point.x.hypot(point.z);
        let up = if self.is_ring() {
            let from_middle = self.field.axis_norm(point) - self.field.ring;
            0.5 + f64::atan2(point.y, from_middle) / TAU
        } else {
            0.5 + f64::atan2(point.y, from_axis) / PI
        };
        SurfacePoint {
            position: self.center + self.radii * point,
            geometric_normal: normal,
            shading_normal: normal,
            uv: DVec2::new(longitude, up),
            part: 0,
        }
    }

    /// Returns changes as [`Shape::changes`](super::Shape::changes) does. Those of the texture
    /// coordinates are zero on the axis, and those of the normal where two creases meet.
    #[must_use]
    pub fn changes(&self, position: DVec3, steps: [DVec3; 2]) -> Changes {
        let point = (position - self.center) / self.radii;
        let own_steps = steps.map(|step| step / self.radii);
        let bend = self.field.bend(point, own_steps);
        let DVec3 { x, y, z } = point;
        let from_axis_sq = x * x + z * z;
        let uv = own_steps.map(|step| {
            if from_axis_sq == 0.0 {
                return DVec2::ZERO;
            }
            let around = (z * step.x - x * step.z) / (TAU * from_axis_sq);
            // Distance across the axis, from the axis itself or from the middle of the tube.
            let (out, of_out, turn) = if self.is_ring() {
                (bend.axis_norm - self.field.ring, bend.axis_gradient.dot(step), TAU)
            } else {
                let from_axis = from_axis_sq.sqrt();
                (from_axis, (x * step.x + z * step.z) / from_axis, PI)
            };
            let up = (out * step.y - y * of_out) / (turn * (out * out + y * y));
            let change = DVec2::new(around, up);
            if change.is_finite() { change } else { DVec2::ZERO }
        });
        let gradient = bend.gradient / self.radii;
        let normal = if gradient.is_finite() && gradient != DVec3::ZERO {
            differential::normalized(gradient, bend.changes.map(|change| change / self.radii))
        } else {
            [DVec3::ZERO; 2]
        };
        Changes { uv, normal }
    }

    /// Returns the texture coordinates as functions of space.
    pub(super) fn extensions(&self, position: DVec3, steps: [DVec3; 2]) -> [Extension; 2] {
        let point = (position - self.center) / self.radii;
        let steps = steps.map(|step| step / self.radii);
        let (distance, bends, turn) = if self.is_ring() {
            let bend = self.field.bend(point, steps);
            let out = bend.axis_norm - self.field.ring;
            ((out, bend.axis_gradient), bend.axis_changes, TAU)
        } else {
            let (distance, bends) = Extension::from_axis(point, steps);
            (distance, bends, PI)
        };
        let around = Extension::around(point, steps, TAU);
        let up = Extension::up(point.y, distance, bends, steps, turn);
        [around, up].map(|own| own.seen_from(|vector| vector / self.radii))
    }

    /// Returns gradients as [`Shape::uv_gradients`](super::Shape::uv_gradients) does.
    #[must_use]
    pub fn uv_gradients(&self, position: DVec3) -> [DVec3; 2] {
        let point = (position - self.center) / self.radii;
        let DVec3 { x, y, z } = point;
        let from_axis_sq = x * x + z * z;
        if from_axis_sq == 0.0 {
            return [DVec3::ZERO; 2];
        }
        let around = DVec3::new(z, 0.0, -x) / (TAU * from_axis_sq);
        // Distance across the axis, from the axis itself or from the middle of the tube.
        let (out, outward, turn) = if self.is_ring() {
            let out = self.field.axis_norm(point) - self.field.ring;
            (out, self.field.axis_gradient(point), TAU)
        } else {
            let from_axis = from_axis_sq.sqrt();
            (from_axis, DVec3::new(x, 0.0, z) / from_axis, PI)
        };
        let up = (out * DVec3::Y - y * outward) / (turn * (out * out + y * y));
        let normal = self.field.direction(point, self.radii);
        [around, up].map(|own| {
            let gradient = own / self.radii;
            let along = gradient - gradient.dot(normal) * normal;
            if along.is_finite() { along } else { DVec3::ZERO }
        })
    }

    /// Returns the period of the texture coordinates. They jump by 1 across the seam meridian, and
    /// on a ring also at its innermost line.
    #[must_use]
    pub fn seam(&self) -> SeamPeriod {
        DVec2::new(1.0, if self.is_ring() { 1.0 } else { 0.0 })
    }

    /// Lower and upper corner of the bounding box.
    #[must_use]
    pub fn bounds(&self) -> [DVec3; 2] {
        let reach = self.radii * self.field.reach();
        [self.center - reach, self.center + reach]
    }

    /// Returns whether the surface is within `skin`, in scene units, of a point: whether the
    /// surface separates the two points at this distance along the gradient.
    fn is_near(&self, point: DVec3, skin: f64) -> bool {
        let offset = skin * self.field.direction(point, self.radii) / self.radii;
        (self.field.value(point + offset) < 1.0) != (self.field.value(point - offset) < 1.0)
    }

    /// Returns the range of `t` in which a line is inside the box around the shape.
    fn within_box(&self, line: &Line) -> Option<[f64; 2]> {
        let reach = self.field.reach() * (1.0 + MARGIN);
        let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
        for axis in 0..3 {
            let (from, step, reach) = (line.from[axis], line.step[axis], reach[axis]);
            if step == 0.0 {
                if from.abs() > reach {
                    return None;
                }
                continue;
            }
            let [a, b] = [(-reach - from) / step, (reach - from) / step];
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        (enter < leave).then_some([enter, leave])
    }
}

#[cfg(test)]
mod tests;
