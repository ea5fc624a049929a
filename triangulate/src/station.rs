//! A row on its way into the mesh.

use crate::TriangulateError;
use glam::DVec3;
use sweep::grid::Row;

/// The number of a vertex that was not told to the sink yet.
pub const UNTOLD: u32 = u32::MAX;

/// A row, rounded, and the numbers of its vertices.
#[derive(Debug, Default)]
pub struct Station {
    /// Where on the trajectory; 1 where a closed trajectory comes back to its first row.
    pub v: f64,
    /// Points, by column.
    pub points: Vec<[f32; 3]>,
    /// Normals, by column.
    pub normals: Vec<[f32; 3]>,
    /// Numbers of the points, by column.
    pub position: Vec<u32>,
    /// Numbers of the normals, by column. These and the picture coordinates are told when a
    /// triangle first needs them, since those at a pole are never needed.
    pub normal: Vec<u32>,
    /// Numbers of the picture coordinates, by column, and one more for `u = 1` over a seam.
    pub uv: Vec<u32>,
}

impl Station {
    /// Takes over a row, the `number`th (from 1) of `object`, with no vertex told.
    ///
    /// The rounding to f32 is here and nowhere else.
    pub fn take(
        &mut self,
        row: &Row<'_>,
        object: &str,
        number: usize,
        uv_slots: usize,
    ) -> Result<(), TriangulateError> {
        let refused = |what, col: usize, found| TriangulateError::Number {
            object: object.into(),
            row: number,
            col: col + 1,
            what,
            found,
        };
        self.v = row.v;
        self.points.clear();
        for (col, &position) in row.positions.iter().enumerate() {
            let point = rounded(position);
            if !point.iter().all(|x| x.is_finite()) {
                return Err(refused("position", col, position));
            }
            self.points.push(point);
        }
        self.normals.clear();
        for (col, normal) in row.normals.iter().enumerate() {
            if !normal.is_finite() {
                return Err(refused("normal", col, normal.as_dvec3()));
            }
            self.normals.push(rounded(normal.as_dvec3()));
        }
        self.position.clear();
        self.normal.clear();
        self.normal.resize(self.normals.len(), UNTOLD);
        self.uv.clear();
        self.uv.resize(uv_slots, UNTOLD);
        Ok(())
    }
}

/// The nearest f32 numbers; adding zero makes -0 into +0, so that equal points have equal bits.
fn rounded(p: DVec3) -> [f32; 3] {
    [p.x as f32 + 0.0, p.y as f32 + 0.0, p.z as f32 + 0.0]
}
