//! Parts of a surface that meet although they are far apart on the surface.
//!
//! Two triangles without a common corner cross if an edge of one passes through the other. A tree of oriented boxes
//! ([`super::patches`]) finds the pairs to test, each once. Triangles in one plane do not cross.

use super::patches::Patches;
use super::{Finding, Severity, short};
use crate::grid::{Cell, GridMesh};
use glam::DVec3;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Largest number of pairs of triangles that are tested for one leaf.
///
/// With a larger number, a surface whose triangles all cross takes long. With a smaller number, the
/// reported count of such a surface is further below the true one; the report then says "at least".
const MOST_TRIED: u64 = 1 << 15;

/// Number of leaves after which the search reports its progress.
const TELL_AFTER: usize = 1 << 12;

/// Receives the progress of the search: the number of leaves done, and of all leaves.
pub type Tell<'a> = &'a (dyn Fn(usize, usize) + Sync);

/// Rounding of a point, as a fraction of its largest coordinate: each point is the sum of about a dozen products.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// A triangle of a cell.
#[derive(Debug)]
pub struct Triangle {
    /// The corners, in the unit of length.
    pub corners: [DVec3; 3],
    /// Numbers of the corners; corners with equal positions have one number.
    pub ids: [u32; 3],
    /// Row and column of its cell.
    pub cell: [u32; 2],
    /// True if this triangle is the upper half of its cell, on the side of the next row.
    pub upper: bool,
}

/// Pairs of triangles that cross and share no corner.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Crossings {
    /// Number of pairs.
    pub count: u64,
    /// The first pair by the indices of its triangles, the smaller index first.
    pub first: Option<[usize; 2]>,
    /// True if the search was cut short, so that more pairs are possible.
    pub more: bool,
    /// Number of boxes and pairs that were tested.
    pub looks: u64,
}

/// Returns a finding if a surface meets itself; `tell` receives the progress.
#[must_use]
pub fn findings(grid: &GridMesh, tell: Tell<'_>) -> Option<Finding> {
    let triangles = triangles(grid);
    let found = crossings(&triangles, tell);
    let [first, second] = found.first?.map(|i| &triangles[i]);
    let middle = first.corners.iter().sum::<DVec3>() / 3.0;
    let least = if found.more { "at least " } else { "" };
    let message = format!(
        "the surface meets itself: {least}{} pairs of triangles cross, the first at row {} col {} and \
         row {} col {}, near ({}, {}, {})",
        found.count,
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

/// Returns the triangles of all cells except those with two equal corners. Corners with equal positions have one id.
fn triangles(grid: &GridMesh) -> Vec<Triangle> {
    let mut ids: HashMap<[u64; 3], u32> = HashMap::with_capacity(grid.positions.len());
    let welded: Vec<u32> = grid
        .positions
        .iter()
        .map(|p| {
            let next = ids.len() as u32;
            // Adding 0 turns -0 into 0.
            *ids.entry(p.to_array().map(|x| (x + 0.0).to_bits())).or_insert(next)
        })
        .collect();
    let mut triangles = Vec::with_capacity(2 * grid.positions.len());
    for Cell { row, col, corners: [a, b, c, d] } in grid.quads() {
        for (corners, upper) in [([a, b, c], false), ([a, c, d], true)] {
            let ids = corners.map(|i| welded[i]);
            if ids[0] != ids[1] && ids[1] != ids[2] && ids[2] != ids[0] {
                let corners = corners.map(|i| grid.positions[i]);
                let cell = [row as u32, col as u32];
                triangles.push(Triangle { corners, ids, cell, upper });
            }
        }
    }
    triangles
}

fn bounds(corners: &[DVec3; 3]) -> [DVec3; 2] {
    let [a, b, c] = *corners;
    [a.min(b).min(c), a.max(b).max(c)]
}

/// Returns all pairs of triangles that cross and share no corner.
#[must_use]
pub fn crossings(triangles: &[Triangle], tell: Tell<'_>) -> Crossings {
    let patches = Patches::new(triangles);
    let leaves = patches.leaves();
    let done = AtomicUsize::new(0);
    leaves
        .par_chunks(TELL_AFTER)
        .map(|some| {
            let found = some.iter().map(|&leaf| of_leaf(triangles, &patches, leaf));
            let found = found.fold(Crossings::default(), Crossings::and);
            tell(done.fetch_add(some.len(), Ordering::Relaxed) + some.len(), leaves.len());
            found
        })
        .reduce(Crossings::default, Crossings::and)
}

/// Tests each pair of a triangle of a leaf with a triangle of the same leaf or of a later one.
fn of_leaf(triangles: &[Triangle], patches: &Patches, leaf: u32) -> Crossings {
    let mut found = Crossings::default();
    let own = patches.triangles(leaf);
    let mut tried = 0;
    found.looks = patches.near(leaf, |other| {
        for (index, &i) in own.iter().enumerate() {
            // Within the leaf itself, each pair is tested once.
            let later = if other == leaf { index + 1 } else { 0 };
            for &j in &patches.triangles(other)[later..] {
                tried += 1;
                if tried > MOST_TRIED {
                    found.more = true;
                } else if cross(&triangles[i as usize], &triangles[j as usize]) {
                    let pair = [i.min(j) as usize, i.max(j) as usize];
                    found.count += 1;
                    found.first = Some(found.first.map_or(pair, |first| first.min(pair)));
                }
            }
        }
    });
    found.looks += tried;
    found
}

impl Crossings {
    /// Returns the crossings of two searches together.
    fn and(self, other: Self) -> Self {
        let first = match (self.first, other.first) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
        Self {
            count: self.count + other.count,
            first,
            more: self.more || other.more,
            looks: self.looks + other.looks,
        }
    }
}

/// Returns whether two triangles cross and share no corner.
fn cross(a: &Triangle, b: &Triangle) -> bool {
    let ([a_low, a_high], [b_low, b_high]) = (bounds(&a.corners), bounds(&b.corners));
    a_low.max(b_low).cmple(a_high.min(b_high)).all()
        && !a.ids.iter().any(|id| b.ids.contains(id))
        && crosses(&a.corners, &b.corners)
}

/// Returns whether an edge of one triangle passes through the other.
fn crosses(a: &[DVec3; 3], b: &[DVec3; 3]) -> bool {
    let through = |edges: &[DVec3; 3], triangle: &[DVec3; 3]| {
        (0..3).any(|i| pierces(edges[i], edges[(i + 1) % 3], triangle))
    };
    through(a, b) || through(b, a)
}

/// Returns whether a segment passes through a triangle. A segment in the plane of the triangle does not, and neither
/// does one that only touches the triangle or one of its sides. Distances within the rounding of the points are 0.
fn pierces(from: DVec3, to: DVec3, [a, b, c]: &[DVec3; 3]) -> bool {
    let (p, q) = (*b - *a, *c - *a);
    let normal = p.cross(q);
    let rounding = ROUNDING
        * [*a, *b, *c, from, to].iter().fold(0.0, |most: f64, x| most.max(x.abs().max_element()));
    // Moving each point by its rounding moves the volume of a parallelepiped by the areas of its faces.
    let (width, area) = (p.length() + q.length(), normal.length());
    let sign = |point: DVec3| {
        let off = point - *a;
        let volume = normal.dot(off);
        let slack = rounding * (area + width * off.length());
        if volume.abs() <= slack { 0.0 } else { volume.signum() }
    };
    if sign(from) * sign(to) >= 0.0 {
        return false;
    }
    let along = to - from;
    let side = |p: DVec3, q: DVec3| {
        let (p, q) = (p - from, q - from);
        let volume = along.dot(p.cross(q));
        let slack = rounding * (along.length() * (p.length() + q.length()) + p.cross(q).length());
        if volume.abs() <= slack { 0.0 } else { volume.signum() }
    };
    let sides = [side(*a, *b), side(*b, *c), side(*c, *a)];
    sides.iter().all(|&side| side > 0.0) || sides.iter().all(|&side| side < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

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
                let cell = [(i / 20) as u32, (i % 20) as u32];
                Triangle { corners: [corner(1), corner(2), corner(4)], ids, cell, upper: false }
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
        let found = crossings(&triangles, &|_, _| {});
        assert_eq!((found.count, found.first, found.more), (all.len() as u64, Some(all[0]), false));
    }

    /// Returns the triangles of a tube around a bent line, whose two ends pass through each other.
    /// The tube has `rows` x `cols` cells.
    fn tube(rows: usize, cols: usize) -> Vec<Triangle> {
        let point = |row: usize, col: usize| {
            let (along, around) = (row as f64 / rows as f64, TAU * col as f64 / cols as f64);
            let turn = 1.1 * TAU * along;
            let out = DVec3::new(turn.cos(), turn.sin(), 0.0);
            (2.0 + 0.3 * around.cos()) * out + (0.3 * around.sin() + 0.05 * turn) * DVec3::Z
        };
        let number = |row: usize, col: usize| (row * cols + col % cols) as u32;
        let mut triangles = Vec::new();
        for row in 0..rows {
            for col in 0..cols {
                let [a, b] = [[row, col], [row, col + 1]];
                let [c, d] = [[row + 1, col + 1], [row + 1, col]];
                for (three, upper) in [([a, b, c], false), ([a, c, d], true)] {
                    let corners = three.map(|[row, col]| point(row, col % cols));
                    let ids = three.map(|[row, col]| number(row, col));
                    let cell = [row as u32, col as u32];
                    triangles.push(Triangle { corners, ids, cell, upper });
                }
            }
        }
        triangles
    }

    #[test]
    fn long_thin_cells_take_work_in_proportion_to_their_number() {
        for cut in [|n| tube(n, 6), |n| tube(6, n), |n| tube(n / 32, 128)] {
            let [one, two] = [1000, 2000].map(|n| crossings(&cut(n), &|_, _| {}));
            assert!(one.count > 0 && two.count > 0, "{one:?} {two:?}");
            let each = [one.looks as f64 / 1000.0, two.looks as f64 / 2000.0];
            assert!(each[1] < 1.25 * each[0], "{one:?} {two:?}");
        }
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
