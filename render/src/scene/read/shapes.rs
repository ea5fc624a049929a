//! Reads the boxes and superquadrics of a scene file.

use super::ranges::Ranges;
use super::{Reader, SceneError};
use crate::scene::file::{BoxFile, SuperquadricFile};
use crate::shape::superquadric::{EXPONENTS, RINGS};
use crate::shape::{Cuboid, Shape, Superquadric};

impl Reader<'_> {
    pub(super) fn cuboid(&self, path: &str, file: &BoxFile) -> Result<Shape, SceneError> {
        self.vector(&format!("{path}.low"), file.low)?;
        self.vector(&format!("{path}.high"), file.high)?;
        for axis in 0..3 {
            let (low, high) = (file.low[axis], file.high[axis]);
            if high <= low {
                let message =
                    format!("found {high}, expected more than {low}, the same component of low");
                return self.fault(&format!("{path}.high[{axis}]"), message);
            }
        }
        match Cuboid::new(file.low.into(), file.high.into()) {
            Some(cuboid) => Ok(Shape::Cuboid(cuboid)),
            None => self.fault(
                &format!("{path}.high"),
                "found a box without extent, expected numbers above low",
            ),
        }
    }

    pub(super) fn superquadric(
        &self,
        path: &str,
        file: &SuperquadricFile,
    ) -> Result<Shape, SceneError> {
        self.vector(&format!("{path}.center"), file.center)?;
        for (axis, &radius) in file.radii.iter().enumerate() {
            self.above_zero(&format!("{path}.radii[{axis}]"), radius)?;
        }
        for (k, &exponent) in file.exponents.iter().enumerate() {
            self.within(&format!("{path}.exponents[{k}]"), exponent, EXPONENTS[0], EXPONENTS[1])?;
        }
        if let Some(ring) = file.ring {
            self.within(&format!("{path}.ring"), ring, RINGS[0], RINGS[1])?;
        }
        let (center, radii) = (file.center.into(), file.radii.into());
        match Superquadric::new(center, radii, file.exponents, file.ring) {
            Some(superquadric) => Ok(Shape::Superquadric(superquadric)),
            None => self.fault(path, "found a superquadric without extent, expected larger radii"),
        }
    }
}
