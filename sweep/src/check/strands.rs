//! Parts of a surface that meet far from each other.
//!
//! Triangles that share no corner are tested in pairs, by the edges of each against the other. A
//! uniform grid of boxes finds the pairs; a pair that shares several boxes is tested in the one that
//! holds the lower corner of what their bounds share. Triangles in one plane do not count.

use super::{Finding, Severity, short};
use crate::grid::GridMesh;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::HashMap;

/// Entries in boxes, by triangle, at most; with more the boxes are made larger.
const MOST_ENTRIES: f64 = 24.0;

struct Triangle {
    corners: [DVec3; 3],
    ids: [u32; 3],
    /// Its cell by row and column.
    cell: [u32; 2],
}

/// The places where a surface meets itself.
#[must_use]
pub fn findings(grid: &GridMesh) -> Option<Finding> {
    let triangles = triangles(grid);
    let pairs = pairs(&triangles);
    let &[a, b] = pairs.first()?;
    let [first, second] = [a, b].map(|i| &triangles[i]);
    let middle = first.corners.iter().sum::<DVec3>() / 3.0;
    let message = format!(
        "the surface meets itself: {} pairs of triangles cross, the first at row {} col {} and row {} \
         col {}, near ({}, {}, {})",
        pairs.len(),
        first.cell[0],
        first.cell[1],
        second.cell[0],
        second.cell[1],
        short(middle.x),
        short(middle.y),
        short(middle.z)
    );
    Some(Finding::new(Severity::Remark, "trajectory", message))
}

/// The triangles of all cells, but for those without area; corners at one place have one id.
fn triangles(grid: &GridMesh) -> Vec<Triangle> {
    let (rows, cols) = (grid.rows(), grid.cols());
    let mut ids: HashMap<[u64; 3], u32> = HashMap::with_capacity(grid.positions.len());
    let welded: Vec<u32> = grid
        .positions
        .iter()
        .map(|p| {
            let next = ids.len() as u32;
            // Adding 0 takes -0 to 0.
            *ids.entry(p.to_array().map(|x| (x + 0.0).to_bits())).or_insert(next)
        })
        .collect();
    let mut triangles = Vec::with_capacity(2 * rows * cols);
    for row in 0..if grid.seam_v.joins() { rows } else { rows - 1 } {
        for col in 0..if grid.seam_u.joins() { cols } else { cols - 1 } {
            let next = (col + 1) % cols;
            let above = |col: usize| match row + 1 == rows {
                true => grid.seam_v.leads_to(col, grid.shift, cols),
                false => (row + 1) * cols + col,
            };
            let [a, b, c, d] = [row * cols + col, row * cols + next, above(next), above(col)];
            for corners in [[a, b, c], [a, c, d]] {
                let ids = corners.map(|i| welded[i]);
                if ids[0] != ids[1] && ids[1] != ids[2] && ids[2] != ids[0] {
                    let corners = corners.map(|i| grid.positions[i]);
                    triangles.push(Triangle { corners, ids, cell: [row as u32, col as u32] });
                }
            }
        }
    }
    triangles
}

fn bounds(corners: &[DVec3; 3]) -> [DVec3; 2] {
    let [a, b, c] = *corners;
    [a.min(b).min(c), a.max(b).max(c)]
}

/// Pairs of triangles that cross and share no corner, in rising order.
fn pairs(triangles: &[Triangle]) -> Vec<[usize; 2]> {
    if triangles.is_empty() {
        return Vec::new();
    }
    let boxes: Vec<[DVec3; 2]> = triangles.iter().map(|one| bounds(&one.corners)).collect();
    let low = boxes.iter().fold(DVec3::INFINITY, |low, one| low.min(one[0]));
    let high = boxes.iter().fold(DVec3::NEG_INFINITY, |high, one| high.max(one[1]));
    let mean =
        boxes.iter().map(|one| (one[1] - one[0]).max_element()).sum::<f64>() / boxes.len() as f64;
    let whole = (high - low).max_element();
    // No more boxes along an edge than 20 bits hold.
    let mut edge = (1.5 * mean).max(whole / 1e6);
    let span = |one: &[DVec3; 2], edge: f64| {
        one.map(|p| ((p - low) / edge).to_array().map(|x| x.floor() as i64))
    };
    let entries = |edge: f64| -> f64 {
        let count = |one: &[DVec3; 2]| {
            let [from, to] = span(one, edge);
            (0..3).map(|axis| (to[axis] - from[axis] + 1) as f64).product::<f64>()
        };
        boxes.iter().map(count).sum()
    };
    while entries(edge) > MOST_ENTRIES * boxes.len() as f64 {
        edge *= 2.0;
    }
    let key = |[x, y, z]: [i64; 3]| (x << 42) | (y << 21) | z;
    let mut filled: Vec<(i64, u32)> = Vec::new();
    for (i, one) in boxes.iter().enumerate() {
        let [from, to] = span(one, edge);
        for x in from[0]..=to[0] {
            for y in from[1]..=to[1] {
                filled.extend((from[2]..=to[2]).map(|z| (key([x, y, z]), i as u32)));
            }
        }
    }
    filled.par_sort_unstable();
    let groups: Vec<&[(i64, u32)]> = filled.chunk_by(|a, b| a.0 == b.0).collect();
    let cross = |&[i, j]: &[usize; 2], at: i64| {
        let (a, b) = (&boxes[i], &boxes[j]);
        let (from, to) = (a[0].max(b[0]), a[1].min(b[1]));
        let (first, second) = (&triangles[i], &triangles[j]);
        from.cmple(to).all()
            && key(span(&[from, to], edge)[0]) == at
            && !first.ids.iter().any(|id| second.ids.contains(id))
            && crosses(&first.corners, &second.corners)
    };
    let mut pairs: Vec<[usize; 2]> = groups
        .par_iter()
        .flat_map_iter(|group| {
            let pair = move |(n, &(at, i)): (usize, &(i64, u32))| {
                group[n + 1..].iter().map(move |&(_, j)| ([i as usize, j as usize], at))
            };
            group.iter().enumerate().flat_map(pair)
        })
        .filter(|(pair, at)| cross(pair, *at))
        .map(|(pair, _)| pair)
        .collect();
    pairs.par_sort_unstable();
    pairs
}

/// Whether an edge of one triangle passes through the other.
fn crosses(a: &[DVec3; 3], b: &[DVec3; 3]) -> bool {
    let through = |edges: &[DVec3; 3], triangle: &[DVec3; 3]| {
        (0..3).any(|i| pierces(edges[i], edges[(i + 1) % 3], triangle))
    };
    through(a, b) || through(b, a)
}

/// Whether a segment passes through a triangle; along its plane it does not.
fn pierces(from: DVec3, to: DVec3, [a, b, c]: &[DVec3; 3]) -> bool {
    let normal = (*b - *a).cross(*c - *a);
    let (before, after) = (normal.dot(from - *a), normal.dot(to - *a));
    if before == 0.0 || after == 0.0 || (before > 0.0) == (after > 0.0) {
        return false;
    }
    let along = to - from;
    let side = |p: DVec3, q: DVec3| along.dot((p - from).cross(q - from));
    let sides = [side(*a, *b), side(*b, *c), side(*c, *a)];
    sides.iter().all(|&side| side > 0.0) || sides.iter().all(|&side| side < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_boxes_find_the_pairs_that_trying_all_finds() {
        let part = |i: usize, golden: f64| (i as f64 * golden).fract();
        // Triangles of very different sizes, one in ten with the whole for its bounds.
        let triangles: Vec<Triangle> = (0..400_usize)
            .map(|i| {
                let at = DVec3::new(part(i, 0.618_034), part(i, 0.754_877), part(i, 0.569_84));
                let size = if i % 10 == 0 { 1.0 } else { 0.15 };
                let corner = |k: usize| {
                    let j = 7 * i + k;
                    let off = DVec3::new(part(j, 0.819_17), part(j, 0.671_04), part(j, 0.549_7));
                    at + (off - 0.5) * size
                };
                let ids = [0, 1, 2].map(|k| (3 * i + k) as u32);
                Triangle { corners: [corner(1), corner(2), corner(4)], ids, cell: [0, 0] }
            })
            .collect();
        let mut all = Vec::new();
        for i in 0..triangles.len() {
            for j in i + 1..triangles.len() {
                if crosses(&triangles[i].corners, &triangles[j].corners) {
                    all.push([i, j]);
                }
            }
        }
        assert!(all.len() > 100, "{}", all.len());
        assert_eq!(pairs(&triangles), all);
    }

    #[test]
    fn an_edge_pierces_a_triangle_at_its_inside() {
        let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y].map(|p| p * 1e-60);
        let stroke = |x: f64, y: f64| {
            let [from, to] = [-1.0, 1.0].map(|z| DVec3::new(x, y, z) * 1e-60);
            pierces(from, to, &triangle)
        };
        assert!(stroke(0.3, 0.3) && !stroke(0.6, 0.6) && !stroke(-0.1, 0.3));
    }
}
