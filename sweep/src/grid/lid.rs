//! Lids: flat ends of a sweep, triangles between the points of its first or its last row.

use crate::grid::row::{self, Fault};
use glam::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An end of the trajectory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// The first row.
    Start,
    /// The last row.
    End,
}

/// Triangles that close one end of several patches, one inside another: those of an outline and its holes.
///
/// A corner is a number that counts the columns of these patches one after another. Its point is that of the column in
/// the first or the last row. Lids belong to the last of their patches.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lid {
    /// The end that the lid closes.
    pub end: End,
    /// Number of patches that the lid closes: the patch itself and those before it.
    pub patches: usize,
    /// Triangles, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// One outward unit normal for all corners, or one for each corner.
    pub normals: Vec<[f32; 3]>,
    /// Picture coordinates of each corner, -1e30 to 1e30; the box of the outline is the unit square.
    pub uvs: Vec<[f64; 2]>,
}

/// The largest picture coordinate of a corner; far below the largest f32, to which a mesh rounds it.
const MOST_UV: f64 = 1e30;

impl Lid {
    /// Returns the outward normal of a corner.
    ///
    /// # Panics
    /// When the lid has no normals.
    #[must_use]
    pub fn normal(&self, corner: usize) -> Vec3 {
        Vec3::from(self.normals[if self.normals.len() == 1 { 0 } else { corner }])
    }

    /// Checks the numbers, as far as possible without the rows; `number` is that of the patch in its object.
    pub(super) fn check(&self, number: usize) -> Result<(), Fault> {
        let fault =
            |subject: &str, message: String| Err(Fault { subject: subject.into(), message });
        if !(1..=number).contains(&self.patches) {
            let message = format!("found {}, expected a number from 1 to {number}", self.patches);
            return fault("patches", message);
        }
        let corners = self.uvs.len();
        if self.normals.len() != 1 && self.normals.len() != corners {
            let message = format!(
                "found {}, expected 1 or {corners}, one for each of the uvs",
                self.normals.len()
            );
            return fault("normals", message);
        }
        if let Some(corner) = self.triangles.iter().flatten().find(|&&c| c as usize >= corners) {
            let message = format!("found corner {corner}, expected less than {corners}");
            return fault("triangles", message);
        }
        let finite = self.normals.iter().flatten().all(|x| x.is_finite())
            && self.uvs.iter().flatten().all(|x| x.is_finite());
        if !finite {
            let message = "found a number that is not finite, expected finite numbers";
            return fault("normals and uvs", message.into());
        }
        if let Some(far) = self.uvs.iter().flatten().find(|uv| uv.abs() > MOST_UV) {
            let found = row::number(*far);
            let message = format!("found {found}, expected -{MOST_UV:e} to {MOST_UV:e}");
            return fault("uvs", message);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lid() -> Lid {
        let uvs = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let normals = vec![[0.0, 0.0, 1.0]];
        Lid { end: End::End, patches: 1, triangles: vec![[0, 1, 2]], normals, uvs }
    }

    #[test]
    fn every_number_of_a_lid_has_a_range() {
        assert!(lid().check(1).is_ok());
        type Change = fn(&mut Lid);
        let faults: [(Change, &str); 7] = [
            (|lid| lid.patches = 2, "patches"),
            (|lid| lid.patches = 0, "patches"),
            (|lid| lid.normals.push([0.0; 3]), "normals"),
            (|lid| lid.triangles[0][1] = 3, "triangles"),
            (|lid| lid.normals[0][2] = f32::NAN, "normals and uvs"),
            (|lid| lid.uvs[1][0] = f64::INFINITY, "normals and uvs"),
            (|lid| lid.uvs[2][1] = -1e39, "uvs"),
        ];
        for (change, subject) in faults {
            let mut lid = lid();
            change(&mut lid);
            assert_eq!(lid.check(1).map_err(|fault| fault.subject), Err(subject.into()));
        }
    }
}
