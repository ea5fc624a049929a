//! The position of a finished part: a rotation, an enlargement and a translation.

use glam::{DQuat, DVec3};

/// A similarity: a point `p` becomes `scale * rotation(p) + translation`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// Rotation about the origin.
    pub rotation: DQuat,
    /// Enlargement from the origin, above 0.
    pub scale: f64,
    /// Translation after both, in the unit of length.
    pub translation: DVec3,
}

impl Default for Placement {
    fn default() -> Self {
        Self { rotation: DQuat::IDENTITY, scale: 1.0, translation: DVec3::ZERO }
    }
}

impl Placement {
    /// Returns this placement followed by another one.
    #[must_use]
    pub fn then(self, next: Self) -> Self {
        Self {
            rotation: (next.rotation * self.rotation).normalize(),
            scale: next.scale * self.scale,
            translation: next.point(self.translation),
        }
    }

    /// Returns the image of a point.
    #[must_use]
    pub fn point(self, point: DVec3) -> DVec3 {
        self.direction(point) * self.scale + self.translation
    }

    /// Returns the image of a unit vector.
    #[must_use]
    pub fn direction(self, vector: DVec3) -> DVec3 {
        // Without a rotation the vector keeps all its bits.
        if self.rotation == DQuat::IDENTITY { vector } else { self.rotation * vector }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn motions_follow_one_another() {
        let moved = Placement { translation: DVec3::X, ..Placement::default() };
        let turned =
            Placement { rotation: DQuat::from_rotation_z(FRAC_PI_2), ..Placement::default() };
        let doubled = Placement { scale: 2.0, ..Placement::default() };
        let all = moved.then(turned).then(doubled);
        assert!((all.point(DVec3::ZERO) - DVec3::Y * 2.0).length() < 1e-15);
        assert!((all.point(DVec3::Y) - DVec3::new(-2.0, 2.0, 0.0)).length() < 1e-15);
        let point = DVec3::new(0.1, 0.2, 0.3);
        assert_eq!(Placement::default().point(point), point);
    }
}
