//! A row of the grid while its vertices are numbered.

use crate::TriangulateError;
use glam::DVec3;
use sweep::grid::file::Header;
use sweep::grid::{Row, Seam};

/// The number of a vertex that has not been passed to the sink.
pub const UNNUMBERED: u32 = u32::MAX;

/// A row, rounded to f32, with the numbers of its vertices.
#[derive(Debug, Default)]
pub struct Station {
    /// Parameter along the trajectory, in [0, 1]; 1 for the first row at the end of a seam.
    pub v: f64,
    /// Points, by column.
    pub points: Vec<[f32; 3]>,
    /// Normals, by column.
    pub normals: Vec<[f32; 3]>,
    /// Numbers of the points, by column. A number is an index into the mesh's positions.
    pub position: Vec<u32>,
    /// Numbers of the normals, by column. Normals and picture coordinates are numbered when a triangle
    /// first needs them, since some of them at a pole are never needed.
    pub normal: Vec<u32>,
    /// Numbers of the picture coordinates, by column, with one more entry for `u = 1` at a seam. Each
    /// entry keeps the last two, since two cells of a band meet at a point.
    pub uv: Vec<[NumberedUv; 2]>,
}

/// Number of the picture coordinates of a point in one area. Each area that meets at the point has its
/// own.
#[derive(Debug, Clone, Copy)]
pub struct NumberedUv {
    /// The number of the area.
    pub owner: u32,
    /// The index of the picture coordinates in the mesh, or [`UNNUMBERED`].
    pub number: u32,
}

impl NumberedUv {
    /// No picture coordinates passed to the sink yet.
    pub const NONE: Self = Self { owner: 0, number: UNNUMBERED };
}

impl Station {
    /// Fills the station with row `number` (from 1) of `object`. No vertex is numbered yet. `uv_slots`
    /// is the number of picture columns.
    ///
    /// Coordinates are rounded to f32 here and nowhere else.
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
        self.normal.resize(self.normals.len(), UNNUMBERED);
        self.uv.clear();
        self.uv.resize(uv_slots, [NumberedUv::NONE; 2]);
        Ok(())
    }

    /// Returns the first row as it follows the last row across the seam, at `v = 1`. Its columns have
    /// the order of the last row's. Its normals are negated at a mirrored seam. Points keep their
    /// numbers, and so do normals that are not negated.
    pub fn over_seam(self, header: &Header) -> Self {
        let cols = self.points.len();
        let from: Vec<usize> =
            (0..cols).map(|col| header.seam_v.leads_to(col, header.shift, cols)).collect();
        let mirrored = header.seam_v == Seam::Mirror;
        // Subtracting from zero makes 0 into +0.
        let turned = |n: [f32; 3]| if mirrored { n.map(|x| 0.0 - x) } else { n };
        let normal = |&col: &usize| if mirrored { UNNUMBERED } else { self.normal[col] };
        Self {
            v: 1.0,
            points: from.iter().map(|&col| self.points[col]).collect(),
            normals: from.iter().map(|&col| turned(self.normals[col])).collect(),
            position: from.iter().map(|&col| self.position[col]).collect(),
            normal: from.iter().map(normal).collect(),
            uv: vec![[NumberedUv::NONE; 2]; self.uv.len()],
        }
    }
}

/// Rounds to the nearest f32 numbers. Adding zero makes -0 into +0, so that equal points have equal
/// bits.
fn rounded(p: DVec3) -> [f32; 3] {
    [p.x as f32 + 0.0, p.y as f32 + 0.0, p.z as f32 + 0.0]
}
