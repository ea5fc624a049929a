//! Meshes that other programs break by merging vertices.
//!
//! Readers of STL files join vertices that lie in one place. Where parts of a surface touch, edges then have more than
//! two triangles. Where an edge is shorter than the readers' tolerance, its triangles vanish and leave a hole.

use super::{Finding, Severity, short};
use crate::grid::GridMesh;
use crate::grid::near::merged;
use glam::DVec3;

/// Points nearer than this fraction of the object's size are merged: the rounding of coordinates to f32.
const NEAR: f64 = 1e-7;

/// Returns a finding if merging the vertices of a closed surface would open or break its mesh.
#[must_use]
pub fn findings(grid: &GridMesh) -> Option<Finding> {
    let (low, high) = grid
        .positions
        .iter()
        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(*p), high.max(*p)));
    let near = NEAR * (high - low).length();
    let own = joined(grid, None);
    let merged = joined(grid, Some(near));
    let broken = odd_edges(grid, &merged);
    if odd_edges(grid, &own).count > 0 || broken.count == 0 {
        return None;
    }
    let at = grid.positions[broken.first?];
    let message = format!(
        "programs that merge vertices, such as readers of STL, would break the mesh: {} edges would not have two \
         triangles, the first near ({}, {}, {}), where points of the surface are less than {} apart",
        broken.count,
        short(at.x),
        short(at.y),
        short(at.z),
        short(near)
    );
    Some(Finding::new(Severity::Hint, "mesh", message))
}

/// Returns a number for each point: equal for neighbours in the grid with equal positions, and if `near` is given for
/// all points that are at most this far apart.
fn joined(grid: &GridMesh, near: Option<f64>) -> Vec<usize> {
    let (rows, cols) = (grid.rows(), grid.cols());
    let mut ids: Vec<usize> = (0..grid.positions.len()).collect();
    if let Some(near) = near.filter(|near| *near > 0.0) {
        return merged(&grid.positions, near);
    }
    for row in 0..rows {
        for col in 0..cols {
            let here = row * cols + col;
            let left = (col > 0).then(|| here - 1);
            let below = (row > 0).then(|| here - cols);
            let first = (grid.seam_u.joins() && col + 1 == cols && col > 0).then(|| row * cols);
            let same = |other: &usize| grid.positions[*other] == grid.positions[here];
            if let Some(other) = [left, below, first].into_iter().flatten().find(same) {
                ids[here] = ids[other];
            }
        }
    }
    ids
}

/// Edges with another number of triangles than two.
struct Odd {
    count: usize,
    /// A point of the first of them.
    first: Option<usize>,
}

fn odd_edges(grid: &GridMesh, ids: &[usize]) -> Odd {
    let mut sides: Vec<[usize; 2]> = Vec::with_capacity(6 * grid.positions.len());
    for cell in grid.quads() {
        let [a, b, c, d] = cell.corners.map(|corner| ids[corner]);
        for [a, b, c] in [[a, b, c], [a, c, d]] {
            if a != b && b != c && c != a {
                sides.extend([[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)]));
            }
        }
    }
    sides.sort_unstable();
    let odd = sides.chunk_by(|a, b| a == b).filter(|edge| edge.len() != 2);
    let firsts: Vec<usize> = odd.map(|edge| edge[0][0]).collect();
    Odd { count: firsts.len(), first: firsts.first().copied() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Sweep;
    use files::json::Document;

    fn finding(contour: &str, trajectory: &str) -> Option<Finding> {
        let text = format!(
            r#"{{"format": "tb-sweep", "version": 1, "name": "a", "contour": {contour},
               "trajectory": {trajectory}, "mesh": {{"rows": 12, "cols": 16}}}}"#
        );
        let sweep = Sweep::read(&Document::new("a.json", text.as_bytes()).unwrap()).unwrap();
        findings(&sweep.grid())
    }

    #[test]
    fn a_contour_that_touches_itself_is_broken_by_merging_and_another_one_is_not() {
        let ring = r#"{"circle": {"radius": 5}}"#;
        let bow = |apart: f64| {
            let points = format!("[[-1,-1],[0,-{apart}],[1,-1],[1,1],[0,{apart}],[-1,1]]");
            format!(r#"{{"polyline": {{"closed": true, "points": {points}}}}}"#)
        };
        assert!(finding(&bow(0.5), ring).is_none());
        for apart in [0.0, 1e-8] {
            let found = finding(&bow(apart), ring).unwrap();
            assert!(found.message.contains("would break the mesh"), "{found}");
        }
    }
}
