//! Walls: one-sided surfaces given a thickness.
//!
//! A surface that closes mirrored has no inside, and a sheet has no thickness. A wall consists of
//! all points within half its thickness of the sheet. Its boundary is one closed surface with two
//! sides, the orientation cover of the sheet. This boundary runs along one side of the sheet,
//! returns over the mirrored seam on the other side, and closes after twice the sheet's length. A
//! Klein bottle thus becomes a torus, and a bottle of glass.
//!
//! The wall's points are those of the sheet moved along the normals. The normals are those of the sheet,
//! because a surface at a constant distance from another is parallel to it.

use glam::{DVec3, Vec3};

/// A wall around a sheet that closes mirrored.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wall {
    /// Half the thickness, in the unit of length; above 0.
    pub(crate) half: f64,
}

/// Number of times a wall runs along its sheet.
pub(crate) const SIDES: usize = 2;

impl Wall {
    /// Moves a row of the sheet to the side of its normals.
    pub(crate) fn near(self, points: &mut [DVec3], normals: &[Vec3]) {
        for (point, normal) in points.iter_mut().zip(normals) {
            *point += self.half * normal.as_dvec3();
        }
    }

    /// Moves a row of the sheet to the other side and reverses its normals. `led` holds the columns in the
    /// order in which the wall returns on them.
    pub(crate) fn far(self, points: &mut [DVec3], normals: &mut [Vec3], led: &[usize]) {
        let sheet: Vec<(DVec3, Vec3)> =
            points.iter().copied().zip(normals.iter().copied()).collect();
        for ((point, normal), &col) in points.iter_mut().zip(normals).zip(led) {
            let (middle, up) = sheet[col];
            *point = middle - self.half * up.as_dvec3();
            *normal = -up;
        }
    }
}
