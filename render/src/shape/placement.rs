//! The placement of an object in the scene: an affine map that moves, rotates and stretches it.

use glam::{DAffine3, DMat3, DVec3};
use thiserror::Error;

/// Largest ratio between the stretches of a placement.
///
/// A point that is transformed to the object's own space and back loses as many digits as this
/// number has. A larger number would make rounding visible. A smaller number would not allow thin
/// objects made of thick ones.
pub const MOST_SPREAD: f64 = 1e6;

/// Largest factor by which lengths may grow or shrink, so that products of lengths stay in range.
const LARGEST: f64 = 1e60;

/// An affine map from an object's own space to scene space, and its inverse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    to_scene: DAffine3,
    to_own: DAffine3,
}

/// The reason why a map is not a valid placement.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum PlacementError {
    /// A number of the map is not finite, or a stretch is outside the range of computation.
    #[error(
        "found a transform that stretches too much or too little, expected 1e-60 to 1e60 times"
    )]
    NotFinite,
    /// The map flattens the object, or nearly so.
    #[error(
        "found a transform that flattens the object, expected stretches that differ at most a \
         million times"
    )]
    Flat,
    /// The map moves points so far that boxes around them have no numbers.
    #[error("found a transform that moves points by more than 1e60, expected at most 1e60")]
    Away,
    /// A vertex of a mesh is moved beyond the range of its coordinates.
    #[error(
        "found vertex {0} moved beyond the range of single precision, expected coordinates up to 3e38"
    )]
    Far(usize),
    /// The edges of a rectangle become parallel.
    #[error("found edges that become parallel, expected two directions")]
    Parallel,
}

impl Placement {
    /// Creates a placement from a map. All numbers of the map must be finite. Its stretches may
    /// differ by at most [`MOST_SPREAD`], measured by the product of the Frobenius norms of its
    /// linear part and of the inverse of that part. The map may mirror.
    ///
    /// # Errors
    /// If the map has a number that is not finite, stretches too much or too little, or flattens
    /// objects.
    pub fn new(to_scene: DAffine3) -> Result<Self, PlacementError> {
        let linear = to_scene.matrix3;
        let size = linear.to_cols_array().into_iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        if !to_scene.is_finite() || size > LARGEST || (size > 0.0 && size < 1.0 / LARGEST) {
            return Err(PlacementError::NotFinite);
        }
        if to_scene.translation.abs().max_element() > LARGEST {
            return Err(PlacementError::Away);
        }
        // Scaled to a largest entry of 1, so that the inverse measures flatness.
        let inverse = (linear * (1.0 / size)).inverse();
        let norm = |m: DMat3| m.to_cols_array().into_iter().map(|x| x * x).sum::<f64>().sqrt();
        // A flat map gives an inverse that is not finite.
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

    /// The placement that changes nothing.
    #[must_use]
    pub fn identity() -> Self {
        Self { to_scene: DAffine3::IDENTITY, to_own: DAffine3::IDENTITY }
    }

    /// Returns whether the placement changes nothing.
    #[must_use]
    pub fn is_identity(&self) -> bool {
        self.to_scene == DAffine3::IDENTITY
    }

    /// Map from the object's own space to scene space.
    #[must_use]
    pub fn to_scene(&self) -> DAffine3 {
        self.to_scene
    }

    /// Map from scene space to the object's own space.
    #[must_use]
    pub fn to_own(&self) -> DAffine3 {
        self.to_own
    }

    /// Returns whether the placement mirrors, which exchanges left and right.
    #[must_use]
    pub fn mirrors(&self) -> bool {
        self.to_scene.matrix3.determinant() < 0.0
    }

    /// Transforms a normal to scene space; the result is not unit. The transpose of the inverse
    /// keeps it perpendicular to the surface and on the outer side, also in a mirror.
    #[must_use]
    pub fn normal(&self, own: DVec3) -> DVec3 {
        self.to_own.matrix3.transpose() * own
    }

    /// Returns the bounding box of a box that is placed, as lower and upper corner.
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
    fn the_inverse_undoes_the_map() {
        let map = DAffine3::from_scale_rotation_translation(
            DVec3::new(0.01, -3.0, 70.0),
            glam::DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), FRAC_PI_3),
            DVec3::new(5.0, -6.0, 7.0),
        );
        let placement = Placement::new(map).unwrap();
        assert!(placement.mirrors() && !placement.is_identity());
        let there_and_back = placement.to_own() * placement.to_scene();
        // The spread is 7000, which magnifies the rounding as much.
        assert!(there_and_back.abs_diff_eq(DAffine3::IDENTITY, 7000.0 * 1e-15), "{there_and_back}");
    }
}
