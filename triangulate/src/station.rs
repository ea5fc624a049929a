//! A row on its way into the mesh.

use crate::TriangulateError;
use glam::DVec3;
use sweep::grid::file::Header;
use sweep::grid::{Row, Seam};

/// The number of a vertex that was not told to the sink yet.
pub const UNTOLD: u32 = u32::MAX;

/// A row, rounded, and the numbers of its vertices.
#[derive(Debug, Default)]
pub struct Station {
    /// Where on the trajectory; 1 where the trajectory comes back to its first row.
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
    /// Numbers of the picture coordinates, by column, and one more for `u = 1` over a seam: the two
    /// last told, as two cells of a band meet at a point.
    pub uv: Vec<[ToldUv; 2]>,
}

/// Picture coordinates of a point, which are others in each area that meets there.
#[derive(Debug, Clone, Copy)]
pub struct ToldUv {
    /// The area.
    pub owner: u32,
    /// Their number.
    pub number: u32,
}

impl ToldUv {
    /// None told yet.
    pub const NONE: Self = Self { owner: 0, number: UNTOLD };
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
        self.uv.resize(uv_slots, [ToldUv::NONE; 2]);
        Ok(())
    }

    /// The first row as the last one leads on to it: at `v = 1`, with its columns in the order of
    /// the last row's, and turned over where the seam is mirrored. Points are the same vertices;
    /// so are normals that keep their side.
    pub fn over_seam(self, header: &Header) -> Self {
        let cols = self.points.len();
        let from: Vec<usize> =
            (0..cols).map(|col| header.seam_v.leads_to(col, header.shift, cols)).collect();
        let mirrored = header.seam_v == Seam::Mirror;
        // Taken from zero, 0 becomes +0.
        let turned = |n: [f32; 3]| if mirrored { n.map(|x| 0.0 - x) } else { n };
        let normal = |&col: &usize| if mirrored { UNTOLD } else { self.normal[col] };
        Self {
            v: 1.0,
            points: from.iter().map(|&col| self.points[col]).collect(),
            normals: from.iter().map(|&col| turned(self.normals[col])).collect(),
            position: from.iter().map(|&col| self.position[col]).collect(),
            normal: from.iter().map(normal).collect(),
            uv: vec![[ToldUv::NONE; 2]; self.uv.len()],
        }
    }
}

/// The nearest f32 numbers; adding zero makes -0 into +0, so that equal points have equal bits.
fn rounded(p: DVec3) -> [f32; 3] {
    [p.x as f32 + 0.0, p.y as f32 + 0.0, p.z as f32 + 0.0]
}
