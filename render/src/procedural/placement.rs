//! The position of a texture in an object.

use glam::{DAffine3, DMat3, DQuat, DVec3};

/// The map from an object's own space to the space in which a texture is defined.
///
/// ```text
///   own = translate + rotate (scale texture)
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    to_texture: DAffine3,
}

impl Placement {
    /// Places a texture whose unit is `scale` long (more than 0). The texture is rotated by the
    /// angles `rotate`, in radians, about the fixed axes x, then y, then z. It is then moved by
    /// `translate`.
    #[must_use]
    pub fn new(scale: f64, rotate: DVec3, translate: DVec3) -> Self {
        let turn = DQuat::from_rotation_z(rotate.z)
            * DQuat::from_rotation_y(rotate.y)
            * DQuat::from_rotation_x(rotate.x);
        // Without a rotation the matrix is exact, and faces between cells stay in place.
        let back = DMat3::from_quat(turn).transpose() * (1.0 / scale);
        Self { to_texture: DAffine3 { matrix3: back, translation: -(back * translate) } }
    }

    /// The map from the object's own space to texture space.
    #[must_use]
    pub fn map(&self) -> &DAffine3 {
        &self.to_texture
    }

    /// Maps a point of the object's own space to texture space.
    #[must_use]
    pub fn to_texture(&self, own: DVec3) -> DVec3 {
        self.to_texture.transform_point3(own)
    }

    /// Maps a step in the object's own space to texture space.
    #[must_use]
    pub fn step_to_texture(&self, own: DVec3) -> DVec3 {
        self.to_texture.transform_vector3(own)
    }

    /// Maps the gradient of a function in texture space to the gradient in own space.
    #[must_use]
    pub fn gradient(&self, texture: DVec3) -> DVec3 {
        self.to_texture.matrix3.transpose() * texture
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn a_texture_is_scaled_then_turned_then_moved() {
        let place = Placement::new(2.0, DVec3::new(0.0, 0.0, FRAC_PI_2), DVec3::new(5.0, 0.0, 0.0));
        // The texture's (1, 0, 0) is 2 long, rotated to y, and moved by 5.
        let own = DVec3::new(5.0, 2.0, 0.0);
        assert!(place.to_texture(own).abs_diff_eq(DVec3::X, 1e-15));
        // The texture's x increases by 0.5 for a unit step along own y.
        assert!(place.gradient(DVec3::X).abs_diff_eq(DVec3::new(0.0, 0.5, 0.0), 1e-15));
        let both = Placement::new(1.0, DVec3::new(FRAC_PI_2, FRAC_PI_2, 0.0), DVec3::ZERO);
        // z is rotated about x to -y, which the rotation about y leaves unchanged.
        assert!(both.to_texture(DVec3::NEG_Y).abs_diff_eq(DVec3::Z, 1e-15));
    }

    #[test]
    fn without_a_turn_nothing_is_rounded() {
        let place = Placement::new(1.0, DVec3::ZERO, DVec3::ZERO);
        let point = DVec3::new(0.1, -7.3, 1e9);
        assert_eq!(place.to_texture(point), point);
    }
}
