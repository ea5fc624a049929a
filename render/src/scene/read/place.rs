//! Reads the placement of an object: joins the steps of `place` to one map.

use super::ranges::Ranges;
use super::{Reader, SceneError};
use crate::scene::Object;
use crate::scene::file::{RotateDegFile, StepFile};
use crate::shape::Placement;
use glam::{DAffine3, DMat3, DVec3};

impl Reader<'_> {
    /// Returns the placement of the object at the JSON path `path`; the identity without steps.
    pub(super) fn placement(
        &self,
        path: &str,
        steps: &[StepFile],
    ) -> Result<Placement, SceneError> {
        let list = format!("{path}.place");
        let whole = self.joined(&list, steps)?;
        self.valid(&list, whole)
    }

    /// Returns the placement of each instance of the mesh at the JSON path `path`, which is placed by
    /// `place` first.
    pub(super) fn instances(
        &self,
        path: &str,
        place: &Placement,
        instances: &[Vec<StepFile>],
    ) -> Result<Vec<Placement>, SceneError> {
        if instances.is_empty() {
            let message =
                "found no placement, expected at least one: leave the key out for one object";
            return self.fault(&format!("{path}.instances"), message);
        }
        let bytes = instances.len() as u64 * size_of::<Object>() as u64;
        self.memory.keep(bytes, || format!("instances of {path}"))?;
        let placed = instances.iter().enumerate().map(|(k, steps)| {
            let list = format!("{path}.instances[{k}]");
            let whole = self.joined(&list, steps)? * place.to_scene();
            self.valid(&list, whole)
        });
        placed.collect()
    }

    /// Joins the steps at the JSON path `list` to one map.
    fn joined(&self, list: &str, steps: &[StepFile]) -> Result<DAffine3, SceneError> {
        let mut whole = DAffine3::IDENTITY;
        for (k, step) in steps.iter().enumerate() {
            let at = |key: &str| format!("{list}[{k}].{key}");
            let step = match step {
                StepFile::Scale(factors) => {
                    if let Some(axis) = factors.iter().position(|&factor| factor == 0.0) {
                        return self.fault(
                            &format!("{}[{axis}]", at("scale")),
                            "found 0, expected any other number",
                        );
                    }
                    DAffine3::from_scale(DVec3::from(*factors))
                }
                StepFile::RotateDeg(turn) => match rotation(turn) {
                    Some(turn) => DAffine3::from_mat3(turn),
                    None => {
                        return self.fault(
                            &at("rotate_deg.axis"),
                            "found an axis without length, expected a direction",
                        );
                    }
                },
                StepFile::Translate(shift) => DAffine3::from_translation(DVec3::from(*shift)),
                StepFile::Matrix(rows) => {
                    let column = |k: usize| DVec3::new(rows[0][k], rows[1][k], rows[2][k]);
                    DAffine3::from_cols(column(0), column(1), column(2), column(3))
                }
            };
            whole = step * whole;
        }
        Ok(whole)
    }

    fn valid(&self, path: &str, whole: DAffine3) -> Result<Placement, SceneError> {
        match Placement::new(whole) {
            Ok(placement) => Ok(placement),
            Err(error) => self.fault(path, error.to_string()),
        }
    }
}

/// Returns the matrix of a rotation; `None` if the axis has no length. Quarter turns about the axes are
/// exact.
fn rotation(turn: &RotateDegFile) -> Option<DMat3> {
    let axis = DVec3::from(turn.axis).try_normalize()?;
    let angle = turn.angle % 360.0;
    let (sine, cosine) = match angle {
        0.0 => (0.0, 1.0),
        90.0 | -270.0 => (1.0, 0.0),
        180.0 | -180.0 => (0.0, -1.0),
        270.0 | -90.0 => (-1.0, 0.0),
        _ => angle.to_radians().sin_cos(),
    };
    // Rodrigues' formula: the part along the axis is unchanged, and the rest is rotated.
    let turned = |v: DVec3| {
        let along = v.dot(axis) * axis;
        cosine * (v - along) + sine * axis.cross(v) + along
    };
    let [x, y, z] = DVec3::AXES.map(turned);
    Some(DMat3::from_cols(x, y, z))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turn(axis: [f64; 3], angle: f64) -> DMat3 {
        rotation(&RotateDegFile { axis, angle }).unwrap()
    }

    #[test]
    fn turns_are_counter_clockwise_and_quarters_exact() {
        assert_eq!(turn([0.0, 3.0, 0.0], 90.0) * DVec3::Z, DVec3::X);
        assert_eq!(turn([0.0, 0.0, 1.0], -450.0) * DVec3::X, DVec3::NEG_Y);
        assert_eq!(turn([1.0, 0.0, 0.0], 720.0), DMat3::IDENTITY);
        let truth = DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.3);
        let ours = turn([3.0, 0.0, 4.0], 0.3f64.to_degrees());
        assert!(ours.abs_diff_eq(truth, 1e-15), "{ours}");
        assert!(rotation(&RotateDegFile { axis: [0.0; 3], angle: 1.0 }).is_none());
    }
}
