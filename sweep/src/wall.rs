//! A wall: a one-sided surface given a thickness.
//!
//! A surface that closes mirrored has no inside, and a sheet no thickness. A wall is what lies within
//! half its thickness of the sheet, and its boundary is one closed surface with two sides, the sheet's
//! orientation cover: it goes along one side of the sheet, comes back over the mirrored seam on the
//! other, and closes after twice the way. A Klein bottle so becomes a torus, and a bottle of glass.
//!
//! Its points are the sheet's moved along the normals, and its normals the sheet's own, since a
//! surface at a constant distance from another is parallel to it.

use glam::{DVec3, Vec3};

/// A wall around a sheet that closes mirrored.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wall {
    /// Half its thickness.
    pub(crate) half: f64,
}

/// How often a wall goes along its sheet.
pub(crate) const SIDES: usize = 2;

impl Wall {
    /// Moves a row of the sheet to the side of its normals.
    pub(crate) fn near(self, points: &mut [DVec3], normals: &[Vec3]) {
        for (point, normal) in points.iter_mut().zip(normals) {
            *point += self.half * normal.as_dvec3();
        }
    }

    /// Moves a row of the sheet to the other side, where `led` are the columns in the order in which the
    /// way comes back on them.
    pub(crate) fn far(self, points: &mut [DVec3], normals: &mut [Vec3], led: &[usize]) {
        let sheet: Vec<(DVec3, Vec3)> =
            points.iter().copied().zip(normals.iter().copied()).collect();
        for ((point, normal), &col) in points.iter_mut().zip(normals).zip(led) {
            let (place, up) = sheet[col];
            *point = place - self.half * up.as_dvec3();
            *normal = -up;
        }
    }
}
