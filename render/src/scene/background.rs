//! The background, which is seen by rays that leave the scene.

use super::AngleRamp;
use crate::color::Color;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Colours at infinite distance.
#[derive(Debug, Clone, PartialEq)]
pub enum Background {
    /// One colour in all directions, linear RGB.
    Uniform(Color),
    /// Colours by the elevation above the horizon, -90 to 90 degrees; y points up. A ray sees the colour
    /// of its direction alone.
    ByElevation(AngleRamp),
    /// A picture of all directions, averaged over the directions that a pixel sees.
    Picture(Environment),
}

/// A picture of all directions: longitude across and latitude up (equirectangular).
///
/// ```text
///   v = 1  +y  +---------------+   the middle of the picture lies toward -z,
///              | -x   -z    +x |   and +x lies on its right;
///   v = 0  -y  +---------------+   y points up
///             u = 0           u = 1
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Environment {
    /// Index into the scene's `textures`.
    pub texture: usize,
    /// Angle by which the picture is turned about y, counter-clockwise as seen from above, in radians.
    pub turn: f64,
}

impl Environment {
    /// Returns the texture coordinates of a direction, across and up in `[0, 1]`, and how they change
    /// when the direction changes. `direction` is unit, and the changes are perpendicular to it. A change
    /// at a pole is infinite or NaN.
    #[must_use]
    pub fn coordinates(&self, direction: DVec3, changes: [DVec3; 2]) -> (DVec2, [DVec2; 2]) {
        let DVec3 { x, y, z } = direction;
        let across_sq = x * x + z * z;
        let longitude = x.atan2(-z) + self.turn;
        let uv = DVec2::new(
            (0.5 + longitude / TAU).rem_euclid(1.0),
            0.5 + y.atan2(across_sq.sqrt()) / PI,
        );
        let change = |d: DVec3| {
            let longitude = (z * d.x - x * d.z) / -across_sq;
            DVec2::new(longitude / TAU, d.y / across_sq.sqrt() / PI)
        };
        (uv, changes.map(change))
    }
}

impl Background {
    /// Returns the colour in a direction, linear RGB; `direction` is unit. A picture returns black, since
    /// its filter determines its colour.
    #[must_use]
    pub fn toward(&self, direction: DVec3) -> Color {
        match self {
            Self::Uniform(color) => *color,
            Self::ByElevation(ramp) => {
                ramp.at_degrees(direction.y.clamp(-1.0, 1.0).asin().to_degrees())
            }
            Self::Picture(_) => Color::ZERO,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_of_a_picture_lies_toward_the_back() {
        let straight = Environment { texture: 0, turn: 0.0 };
        for (direction, uv) in [
            (DVec3::NEG_Z, [0.5, 0.5]),
            (DVec3::X, [0.75, 0.5]),
            (DVec3::NEG_X, [0.25, 0.5]),
            (DVec3::Y, [0.5, 1.0]),
            (DVec3::NEG_Y, [0.5, 0.0]),
            (DVec3::new(0.0, 1.0, -1.0).normalize(), [0.5, 0.75]),
        ] {
            let (found, _) = straight.coordinates(direction, [DVec3::ZERO; 2]);
            let across = direction.y.abs() == 1.0 || (found.x - uv[0]).abs() < 1e-15;
            assert!(across && (found.y - uv[1]).abs() < 1e-15, "{direction}: {found}");
        }
        // Turned by 90 degrees, the middle of the picture lies to the left.
        let turned = Environment { texture: 0, turn: PI / 2.0 };
        let (found, _) = turned.coordinates(DVec3::NEG_X, [DVec3::ZERO; 2]);
        assert!(found.abs_diff_eq(DVec2::splat(0.5), 1e-15), "{found}");
    }

    #[test]
    fn changes_of_coordinates_agree_with_differences() {
        let environment = Environment { texture: 0, turn: 0.7 };
        for k in 1..50 {
            let k = f64::from(k);
            let direction = DVec3::new(k.sin(), (1.3 * k).cos(), (2.1 * k).sin()).normalize();
            let (one, other) = direction.any_orthonormal_pair();
            let (uv, changes) = environment.coordinates(direction, [one, other]);
            for (change, tangent) in changes.into_iter().zip([one, other]) {
                let step = 1e-7;
                let moved = (direction + step * tangent).normalize();
                let (there, _) = environment.coordinates(moved, [DVec3::ZERO; 2]);
                let mut difference = there - uv;
                difference.x -= difference.x.round();
                // Second-order terms grow toward the poles.
                let near = 1e-4 * (1.0 + change.length_squared());
                assert!((difference / step).abs_diff_eq(change, near), "{difference} {change}");
            }
        }
    }
}
