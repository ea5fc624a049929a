//! Reads the place of a whole part.

use super::Reader;
use crate::error::SweepError;
use crate::surface::place::Placement;
use files::Place;
use glam::DMat3;

/// Largest difference between a placement and one that scales all directions alike, relative to its factor. A larger
/// one would tilt normals visibly. A smaller one would refuse matrices that are written with ten digits.
const UNEQUAL: f64 = 1e-9;

impl Reader<'_> {
    /// Returns the placement of a part at the path `path`.
    pub(super) fn placement(&self, path: &str, place: &Place) -> Result<Placement, SweepError> {
        let map = match place.map() {
            Ok(map) => map.there,
            Err(fault) => return Err(self.fault(&format!("{path}{}", fault.path), fault.message)),
        };
        self.point(path, &map.translation.to_array())?;
        let scale = map.matrix3.x_axis.length();
        self.positive(path, scale)?;
        let rotation = map.matrix3 * (1.0 / scale);
        if rotation.determinant() < 0.0 {
            let message = "found a place that mirrors, expected one that does not: `place` in a scene mirrors the object";
            return Err(self.fault(path, message));
        }
        let difference = rotation.transpose() * rotation - DMat3::IDENTITY;
        if difference.to_cols_array().iter().any(|x| x.is_nan() || x.abs() > UNEQUAL) {
            let message = "found a place that stretches directions differently, expected the same factor for all: `place` in a scene stretches the object";
            return Err(self.fault(path, message));
        }
        Ok(Placement { rotation, scale, translation: map.translation })
    }
}
