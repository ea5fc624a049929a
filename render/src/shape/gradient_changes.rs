//! Changes of the gradients of texture coordinates along the surface of a shape.
//!
//! The slopes of a bump from a picture are known by texture coordinates. Gradients of the coordinates
//! turn them into slopes in space, so the change of a bumped normal needs the changes of gradients.

use super::{Shape, SurfacePoint};
use glam::DVec3;

/// A function of space that equals a texture coordinate on the surface, at a point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extension {
    /// Gradient of the function; it need not lie along the surface.
    pub gradient: DVec3,
    /// Changes of the gradient for two steps.
    pub changes: [DVec3; 2],
}

impl Shape {
    /// Returns the changes of both [`Shape::uv_gradients`] for two steps along the surface, as
    /// `[step][coordinate]`. Their parts across the surface are left out. `normals` are the changes
    /// of the unit normal for the steps. The changes are zero where gradients are.
    #[must_use]
    pub fn uv_gradient_changes(
        &self,
        point: &SurfacePoint,
        steps: [DVec3; 2],
        normals: [DVec3; 2],
    ) -> [[DVec3; 2]; 2] {
        let Some(extensions) = self.extensions(point.position, steps) else {
            return [[DVec3::ZERO; 2]; 2];
        };
        // A gradient along the surface is that of the function without its part along the normal,
        // which turns with the surface.
        [0, 1].map(|k| {
            extensions.map(|Extension { gradient, changes }| {
                let change = changes[k] - gradient.dot(point.geometric_normal) * normals[k];
                if change.is_finite() { change } else { DVec3::ZERO }
            })
        })
    }

    /// Returns both texture coordinates as functions of space; `None` where their gradients are
    /// constant on each face.
    pub(super) fn extensions(&self, position: DVec3, steps: [DVec3; 2]) -> Option<[Extension; 2]> {
        match self {
            Self::Sphere(sphere) => Some(sphere.extensions(position, steps)),
            Self::Superquadric(superquadric) => Some(superquadric.extensions(position, steps)),
            Self::Placed(placed) => placed.extensions(position, steps),
            Self::Quad(_) | Self::Mesh(_) | Self::Cuboid(_) | Self::Instance(_) => None,
        }
    }
}

impl Extension {
    /// Returns the function in a space to which positions are transformed by the linear part `map`.
    pub fn seen_from(self, map: impl Fn(DVec3) -> DVec3) -> Self {
        Self { gradient: map(self.gradient), changes: self.changes.map(map) }
    }

    /// Returns the angle around the axis y as a share of `turn`, eastward from +z toward +x. `point`
    /// is a position relative to the centre.
    pub fn around(point: DVec3, steps: [DVec3; 2], turn: f64) -> Self {
        let DVec3 { x, z, .. } = point;
        let square = x * x + z * z;
        let gradient = DVec3::new(z, 0.0, -x) / (turn * square);
        let changes = steps.map(|step| {
            let of_square = 2.0 * (x * step.x + z * step.z);
            DVec3::new(step.z, 0.0, -step.x) / (turn * square) - of_square / square * gradient
        });
        Self { gradient, changes }
    }

    /// Returns the angle at height `y` and the distance `out` across the axis, as a share of `turn`.
    /// `outward` is the gradient of the distance and `bends` are its changes for the steps.
    pub fn up(
        y: f64,
        (out, outward): (f64, DVec3),
        bends: [DVec3; 2],
        steps: [DVec3; 2],
        turn: f64,
    ) -> Self {
        let square = out * out + y * y;
        let gradient = (out * DVec3::Y - y * outward) / (turn * square);
        let changes = [0, 1].map(|k| {
            let of_out = outward.dot(steps[k]);
            let of_square = 2.0 * (out * of_out + y * steps[k].y);
            let turned = of_out * DVec3::Y - steps[k].y * outward - y * bends[k];
            turned / (turn * square) - of_square / square * gradient
        });
        Self { gradient, changes }
    }

    /// Returns the distance from the axis y, its gradient, and the changes of the gradient, for
    /// [`Extension::up`].
    pub fn from_axis(point: DVec3, steps: [DVec3; 2]) -> ((f64, DVec3), [DVec3; 2]) {
        let flat = DVec3::new(point.x, 0.0, point.z);
        let distance = flat.length();
        let outward = flat / distance;
        let bends = steps.map(|step| {
            let step = DVec3::new(step.x, 0.0, step.z);
            (step - outward * outward.dot(step)) / distance
        });
        ((distance, outward), bends)
    }
}
