//! The position of a texture in an object.

use glam::{DAffine3, DVec3};

/// The map from an object's own space to the space in which a texture is defined.
///
/// ```text
///   own = translate + matrix texture
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Placement {
    to_texture: DAffine3,
}

impl Placement {
    /// Creates a placement from the map from the object's own space to texture space.
    #[must_use]
    pub fn new(to_texture: DAffine3) -> Self {
        Self { to_texture }
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
    use glam::DQuat;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn points_and_gradients_are_those_of_the_map() {
        let turn = DQuat::from_rotation_z(FRAC_PI_2);
        let (scale, at) = (DVec3::new(2.0, 3.0, 1.0), DVec3::new(5.0, 0.0, 0.0));
        let to_own = DAffine3::from_scale_rotation_translation(scale, turn, at);
        let place = Placement::new(to_own.inverse());
        // The texture's (1, 0, 0) is 2 long, rotated to y, and moved by 5.
        let own = DVec3::new(5.0, 2.0, 0.0);
        assert!(place.to_texture(own).abs_diff_eq(DVec3::X, 1e-15));
        // The texture's x increases by 1/2 for a unit step along own y, and its y by 1/3 along own -x.
        assert!(place.gradient(DVec3::X).abs_diff_eq(DVec3::new(0.0, 0.5, 0.0), 1e-15));
        assert!(place.gradient(DVec3::Y).abs_diff_eq(DVec3::new(-1.0 / 3.0, 0.0, 0.0), 1e-15));
    }
}
