//! Where an object is put, and how it is turned and stretched there.

use glam::{DAffine3, DMat3, DVec3};
use thiserror::Error;

/// The most that stretches may differ.
///
/// A point that is brought into the object's own space and back has lost as many digits as this
/// number has; larger, and rounding would be seen, smaller, and thin things could not be made of
/// thick ones.
pub const MOST_SPREAD: f64 = 1e6;

/// The most by which lengths may grow or shrink: squares and products of lengths stay in range.
const LARGEST: f64 = 1e60;

/// An affine map from an object's own space to the scene's, and the way back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    to_scene: DAffine3,
    to_own: DAffine3,
}

/// Why an object cannot be placed so.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum PlacementError {
    /// A number of the map is not finite, or it stretches by more than can be computed with.
    #[error("found a map that stretches too much or too little, expected 1e-60 to 1e60 times")]
    NotFinite,
    /// All is pressed flat, or nearly so.
    #[error(
        "found a map that presses things flat, expected stretches that differ at most a million times"
    )]
    Flat,
    /// The map moves points so far that boxes around them have no numbers.
    #[error("found a map that moves points by more than 1e60, expected at most 1e60")]
    Away,
    /// A mesh is moved beyond what its coordinates can be.
    #[error("found vertex {0} moved to where f32 has no numbers, expected coordinates up to 3e38")]
    Far(usize),
    /// The edges of a rectangle become parallel.
    #[error("found edges that become parallel, expected two directions")]
    Parallel,
}

impl Placement {
    /// The map, checked: finite, and with stretches that differ by at most [`MOST_SPREAD`],
    /// measured by the Frobenius norms of its linear part and of that of its inverse. It may
    /// mirror.
    ///
    /// # Errors
    /// When it is not so.
    pub fn new(to_scene: DAffine3) -> Result<Self, PlacementError> {
        let linear = to_scene.matrix3;
        let size = linear.to_cols_array().into_iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        if !to_scene.is_finite() || size > LARGEST || (size > 0.0 && size < 1.0 / LARGEST) {
            return Err(PlacementError::NotFinite);
        }
        if to_scene.translation.abs().max_element() > LARGEST {
            return Err(PlacementError::Away);
        }
        // Scaled to a largest entry of 1, so that its determinant is a measure of flatness.
        let inverse = (linear * (1.0 / size)).inverse();
        let norm = |m: DMat3| m.to_cols_array().into_iter().map(|x| x * x).sum::<f64>().sqrt();
        // Not a number, when it is flat.
        if norm(linear * (1.0 / size)) * norm(inverse) > MOST_SPREAD || !inverse.is_finite() {
            return Err(PlacementError::Flat);
        }
        let inverse = inverse * (1.0 / size);
        let to_own = DAffine3::from_mat3_translation(inverse, -(inverse * to_scene.translation));
        if !to_own.is_finite() {
            return Err(PlacementError::NotFinite);
        }
        Ok(Self { to_scene, to_own })
    }

    /// Nothing moved.
    #[must_use]
    pub fn identity() -> Self {
        Self { to_scene: DAffine3::IDENTITY, to_own: DAffine3::IDENTITY }
    }

    /// Whether nothing is moved.
    #[must_use]
    pub fn is_identity(&self) -> bool {
        self.to_scene == DAffine3::IDENTITY
    }

    /// From the object's own space to the scene's.
    #[must_use]
    pub fn to_scene(&self) -> DAffine3 {
        self.to_scene
    }

    /// From the scene's space to the object's own.
    #[must_use]
    pub fn to_own(&self) -> DAffine3 {
        self.to_own
    }

    /// Whether left and right change places.
    #[must_use]
    pub fn mirrors(&self) -> bool {
        self.to_scene.matrix3.determinant() < 0.0
    }

    /// A normal in the scene's space, not unit: by the transpose of the way back, so that it stays
    /// across the surface and on its outer side, also in a mirror.
    #[must_use]
    pub fn normal(&self, own: DVec3) -> DVec3 {
        self.to_own.matrix3.transpose() * own
    }

    /// Box around a box that is placed.
    #[must_use]
    pub fn bounds(&self, [low, high]: [DVec3; 2]) -> [DVec3; 2] {
        let middle = self.to_scene.transform_point3(0.5 * (low + high));
        let half = 0.5 * (high - low);
        let reach =
            DMat3::from_cols_array(&self.to_scene.matrix3.to_cols_array().map(f64::abs)) * half;
        [middle - reach, middle + reach]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_3;

    fn scale(x: f64, y: f64, z: f64) -> Result<Placement, PlacementError> {
        Placement::new(DAffine3::from_scale(DVec3::new(x, y, z)))
    }

    #[test]
    fn flat_and_endless_maps_are_refused() {
        assert_eq!(scale(1.0, 0.0, 1.0), Err(PlacementError::Flat));
        assert_eq!(scale(0.0, 0.0, 0.0), Err(PlacementError::Flat));
        assert_eq!(scale(1e-3, 1.0, 1e4), Err(PlacementError::Flat));
        assert_eq!(scale(f64::NAN, 1.0, 1.0), Err(PlacementError::NotFinite));
        assert_eq!(scale(1e-310, 1e-310, 1e-310), Err(PlacementError::NotFinite));
        assert!(scale(1e-50, 1e-50, 1e-50).is_ok());
        assert!(scale(1e-2, 1.0, 1e3).is_ok());
        let sheared = DMat3::from_cols(DVec3::X, DVec3::new(1.0, 1e-7, 0.0), DVec3::Z);
        assert_eq!(Placement::new(DAffine3::from_mat3(sheared)), Err(PlacementError::Flat));
    }

    #[test]
    fn the_way_back_undoes_the_way() {
        let way = DAffine3::from_scale_rotation_translation(
            DVec3::new(0.01, -3.0, 70.0),
            glam::DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), FRAC_PI_3),
            DVec3::new(5.0, -6.0, 7.0),
        );
        let placement = Placement::new(way).unwrap();
        assert!(placement.mirrors() && !placement.is_identity());
        let there_and_back = placement.to_own() * placement.to_scene();
        // The spread is 7000, and so many roundings are seen of it.
        assert!(there_and_back.abs_diff_eq(DAffine3::IDENTITY, 7000.0 * 1e-15), "{there_and_back}");
    }
}
