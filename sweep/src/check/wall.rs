//! Walls thicker than the surface is round.

use super::{Finding, Severity, short};
use crate::grid::GridMesh;
use crate::sampling::Sweep;
use rayon::prelude::*;

/// Cells of a wall that are turned over, since half of it is more than the surface's radius there.
#[must_use]
pub fn findings(sweep: &Sweep, grid: &GridMesh) -> Option<Finding> {
    let wall = sweep.wall?;
    let (rows, cols) = (grid.rows(), grid.cols());
    let turned = |row: usize| {
        let above = (row + 1) % rows;
        (0..cols).filter(move |&col| {
            let next = (col + 1) % cols;
            let at = [row * cols + col, row * cols + next, above * cols + next, above * cols + col];
            let [a, b, c, d] = at.map(|i| grid.positions[i]);
            (c - a).cross(d - b).dot(grid.normals[at[0]].as_dvec3()) <= 0.0
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
