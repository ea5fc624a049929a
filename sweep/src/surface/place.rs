//! The position of a finished part: a rotation, an enlargement and a translation.

use glam::{DMat3, DVec3};

/// A similarity: a point `p` becomes `scale * rotation(p) + translation`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// Rotation about the origin.
    pub rotation: DMat3,
    /// Enlargement from the origin, above 0.
    pub scale: f64,
    /// Translation after both, in the unit of length.
    pub translation: DVec3,
}

impl Default for Placement {
    fn default() -> Self {
        Self { rotation: DMat3::IDENTITY, scale: 1.0, translation: DVec3::ZERO }
    }
}

impl Placement {
    /// Returns the image of a point.
    #[must_use]
    pub fn point(self, point: DVec3) -> DVec3 {
        self.direction(point) * self.scale + self.translation
    }

    /// Returns the image of a unit vector.
    #[must_use]
    pub fn direction(self, vector: DVec3) -> DVec3 {
        // Without a rotation the vector keeps all its bits.
        if self.rotation == DMat3::IDENTITY { vector } else { self.rotation * vector }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn points_are_turned_then_scaled_then_moved() {
        let place = Placement {
            rotation: DMat3::from_rotation_z(FRAC_PI_2),
            scale: 2.0,
            translation: DVec3::Y,
        };
        assert!((place.point(DVec3::X) - DVec3::Y * 3.0).length() < 1e-15);
        assert!((place.direction(DVec3::X) - DVec3::Y).length() < 1e-15);
        let point = DVec3::new(0.1, 0.2, 0.3);
        assert_eq!(Placement::default().point(point), point);
    }
}
