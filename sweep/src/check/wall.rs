//! Walls that are thicker than the radius of curvature of the surface.

use super::{Finding, Severity, short};
use crate::grid::GridMesh;
use crate::sampling::Sweep;
use rayon::prelude::*;

/// Returns a finding about cells of a wall that are turned over, because half the wall's thickness exceeds the radius at
/// which the surface bends there.
#[must_use]
pub fn findings(sweep: &Sweep, grid: &GridMesh) -> Option<Finding> {
    let wall = sweep.wall?;
    let (rows, cols) = (grid.rows(), grid.cols());
    let turned = |row: usize| {
        grid.quads_of(row).filter(|cell| {
            let [a, b, c, d] = cell.corners.map(|i| grid.positions[i]);
            (c - a).cross(d - b).dot(grid.normals[cell.corners[0]].as_dvec3()) <= 0.0
        })
    };
    let count: usize = (0..rows).into_par_iter().map(|row| turned(row).count()).sum();
    let message = format!(
        "{count} of {} cells are turned over: half the wall, {}, is more than the radius at which the \
         surface bends there; a thinner wall passes",
        rows * cols,
        short(wall.half)
    );
    (count > 0).then(|| Finding::new(Severity::Wrong, "wall", message))
}
