//! A tree of oriented boxes over the triangles of a surface.
//!
//! Boxes along the axes of space overlap by the thousand if cells are long, thin and askew. A box oriented along its
//! patch of the surface is as thin as the patch and overlaps only its neighbours: see Gottschalk, Lin and Manocha,
//! *`OBBTree`: A Hierarchical Structure for Rapid Interference Detection*, SIGGRAPH 1996. Two boxes are disjoint if a
//! plane perpendicular to an axis of either separates them. Long thin boxes that pass each other are separated along the
//! cross product of an axis of each. Patches are rectangles of cells, halved across their longer side, so the tree needs
//! no sorting and is `log2 n` deep.

use super::strands::Triangle;
use glam::{DVec3, Vec3};
use std::ops::Range;

/// Largest number of cells in a leaf. With a larger number, more pairs are tested. With a smaller
/// number, the tree takes more memory.
const LEAF: usize = 2;

/// Largest number of triangles of a patch that is bounded by its corners. Larger patches are bounded by the boxes of
/// their halves, which takes less time and is looser.
const BOUNDED_BY_CORNERS: usize = 1 << 12;

/// Fraction of its size by which a box is widened, for the rounding of its `f32` axes.
const SLACK: f64 = 1e-5;

/// A tree of oriented boxes.
#[derive(Debug)]
pub struct Patches {
    nodes: Vec<Node>,
    /// Indices of the triangles, leaf by leaf.
    order: Vec<u32>,
}

/// A patch. Its first half, if it has halves, is the next node.
#[derive(Debug, Clone)]
struct Node {
    middle: DVec3,
    /// Two unit axes; the third is their cross product.
    axes: [Vec3; 2],
    half: [f32; 3],
    /// The range of its triangles in the order of the tree.
    triangles: Range<u32>,
    /// Index of the second half; 0 for a leaf.
    second: u32,
}

/// An oriented box.
#[derive(Debug, Clone, Copy)]
struct Turned {
    middle: DVec3,
    axes: [DVec3; 3],
    half: [f64; 3],
}

/// Sums over a patch that give its orientation: of the sides of cells across and along, and of the normals, each with the
/// sum of their lengths.
type Lie = [(DVec3, f64); 3];

impl Patches {
    /// Builds a tree over triangles, which are given row by row.
    #[must_use]
    pub fn new(triangles: &[Triangle]) -> Self {
        let [rows, cols] = triangles.iter().fold([0, 0], |[rows, cols], triangle| {
            [rows.max(triangle.cell[0] + 1), cols.max(triangle.cell[1] + 1)]
        });
        // Index of the first triangle of each row.
        let mut starts = vec![0; rows as usize + 1];
        triangles.iter().for_each(|triangle| starts[triangle.cell[0] as usize + 1] += 1);
        for row in 0..rows as usize {
            starts[row + 1] += starts[row];
        }
        let mut builder = Builder {
            triangles,
            starts,
            steps: [0.0; 2],
            tree: Self { nodes: Vec::new(), order: Vec::with_capacity(triangles.len()) },
        };
        builder.steps = builder.mean_steps();
        if !triangles.is_empty() {
            builder.patch([0..rows, 0..cols]);
        }
        builder.tree
    }

    /// Returns the leaves, as indices of nodes.
    #[must_use]
    pub fn leaves(&self) -> Vec<u32> {
        let leaves = (0..self.nodes.len() as u32).filter(|&k| self.nodes[k as usize].second == 0);
        leaves.collect()
    }

    /// Returns the indices of the triangles of a leaf.
    #[must_use]
    pub fn triangles(&self, leaf: u32) -> &[u32] {
        let Range { start, end } = self.nodes[leaf as usize].triangles;
        &self.order[start as usize..end as usize]
    }

    /// Calls `see` with the leaf itself and with every later leaf whose box may meet its box. Returns the number of boxes
    /// that were tested against the box of the leaf.
    pub fn near(&self, leaf: u32, mut see: impl FnMut(u32)) -> u64 {
        let own = self.nodes[leaf as usize].turned();
        let own_end = self.nodes[leaf as usize].triangles.end;
        let mut looks = 0;
        let mut open = vec![0u32];
        see(leaf);
        while let Some(number) = open.pop() {
            let node = &self.nodes[number as usize];
            // The whole node lies before the leaf or is the leaf.
            if node.triangles.end <= own_end {
                continue;
            }
            looks += 1;
            if own.misses(&node.turned()) {
                continue;
            }
            if node.second == 0 {
                see(number);
            } else {
                open.extend([node.second, number + 1]);
            }
        }
        looks
    }
}

struct Builder<'a> {
    triangles: &'a [Triangle],
    starts: Vec<usize>,
    /// Mean length of a cell along a column and along a row.
    steps: [f64; 2],
    tree: Patches,
}

impl Builder<'_> {
    /// Adds the patch of a rectangle of cells and all of its halves.
    fn patch(&mut self, cells: [Range<u32>; 2]) -> (u32, Lie) {
        let number = self.tree.nodes.len() as u32;
        let start = self.tree.order.len() as u32;
        let nothing = Turned { middle: DVec3::ZERO, axes: DVec3::AXES, half: [0.0; 3] };
        self.tree.nodes.push(nothing.node(start..start, 0));
        let [rows, cols] = cells;
        let (second, lie) = if rows.len() * cols.len() <= LEAF {
            self.fill(&rows, &cols);
            (0, self.lie(start as usize))
        } else {
            let along = rows.len() as f64 * self.steps[0];
            let across = cols.len() as f64 * self.steps[1];
            let by_rows = cols.len() < 2 || (rows.len() > 1 && along >= across);
            let half = |range: &Range<u32>| range.start + range.len() as u32 / 2;
            let halves = if by_rows {
                let at = half(&rows);
                [[rows.start..at, cols.clone()], [at..rows.end, cols]]
            } else {
                let at = half(&cols);
                [[rows.clone(), cols.start..at], [rows, at..cols.end]]
            };
            let [first, second] = halves;
            let (_, a) = self.patch(first);
            let (second, b) = self.patch(second);
            (second, [0, 1, 2].map(|k| (a[k].0 + b[k].0, a[k].1 + b[k].1)))
        };
        let end = self.tree.order.len() as u32;
        let axes = axes(&lie);
        let turned = if (end - start) as usize <= BOUNDED_BY_CORNERS {
            let own = &self.tree.order[start as usize..end as usize];
            let corners = own.iter().flat_map(|&k| self.triangles[k as usize].corners);
            Turned::around(axes, corners)
        } else {
            let halves = [number + 1, second].map(|k| self.tree.nodes[k as usize].turned());
            Turned::around(axes, halves.iter().flat_map(Turned::corners))
        };
        self.tree.nodes[number as usize] = turned.node(start..end, second);
        (number, lie)
    }

    /// Adds the triangles of a rectangle of cells to the order.
    fn fill(&mut self, rows: &Range<u32>, cols: &Range<u32>) {
        for row in rows.clone() {
            let Self { triangles, starts, tree, .. } = self;
            let own = &triangles[starts[row as usize]..starts[row as usize + 1]];
            let first = own.partition_point(|triangle| triangle.cell[1] < cols.start);
            let end = own.partition_point(|triangle| triangle.cell[1] < cols.end);
            let numbers = first..end;
            tree.order.extend(numbers.map(|k| (starts[row as usize] + k) as u32));
        }
    }

    /// Returns the orientation of the triangles in the order from `start` on.
    fn lie(&self, start: usize) -> Lie {
        let mut lie = [(DVec3::ZERO, 0.0); 3];
        for &k in &self.tree.order[start..] {
            let [a, b, c] = self.triangles[k as usize].corners;
            let across = (b - a).cross(c - a);
            // The sides along the grid; the third is a cell's diagonal.
            let sides =
                if self.triangles[k as usize].upper { [b - c, c - a] } else { [b - a, c - b] };
            for (sum, side) in lie.iter_mut().zip([sides[0], sides[1], across]) {
                sum.0 += side;
                sum.1 += side.length();
            }
        }
        lie
    }

    fn mean_steps(&self) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for triangle in self.triangles {
            let [a, b, c] = triangle.corners;
            let [across, along] = if triangle.upper { [b - c, c - a] } else { [b - a, c - b] };
            sums[0] += along.length();
            sums[1] += across.length();
        }
        sums
    }
}

/// Returns the axes for a patch: first the direction in which its parts agree most, then the next.
fn axes(lie: &Lie) -> [Vec3; 2] {
    let agreement = |k: usize| if lie[k].1 > 0.0 { lie[k].0.length() / lie[k].1 } else { 0.0 };
    let mut order = [0, 1, 2];
    order.sort_by(|&a, &b| agreement(b).total_cmp(&agreement(a)));
    let [first, second] = [order[0], order[1]].map(|k| lie[k].0.normalize_or_zero());
    let first = first.try_normalize().unwrap_or(DVec3::X);
    let second = second - second.dot(first) * first;
    let second =
        if second.length() > 1e-3 { second.normalize() } else { first.any_orthonormal_vector() };
    [first.as_vec3(), second.as_vec3()]
}

impl Node {
    fn turned(&self) -> Turned {
        let [first, second] = self.axes.map(DVec3::from);
        let axes = [first, second, first.cross(second)];
        Turned { middle: self.middle, axes, half: self.half.map(f64::from) }
    }
}

impl Turned {
    /// Returns the box around points with these two axes and their cross product.
    fn around(axes: [Vec3; 2], points: impl Iterator<Item = DVec3> + Clone) -> Self {
        let [first, second] = axes.map(DVec3::from);
        let axes = [first, second, first.cross(second)];
        // Positions are relative to one of the points, so that no digits are lost far from the origin.
        let origin = points.clone().next().unwrap_or(DVec3::ZERO);
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for point in points {
            for k in 0..3 {
                let along = axes[k].dot(point - origin);
                (low[k], high[k]) = (low[k].min(along), high[k].max(along));
            }
        }
        let middle: DVec3 = (0..3).map(|k| 0.5 * (low[k] + high[k]) * axes[k]).sum();
        let half = [0, 1, 2].map(|k| 0.5 * (high[k] - low[k]));
        let size = half[0] + half[1] + half[2];
        let largest = origin.abs().max_element() + size;
        let slack = SLACK * size + 64.0 * f64::EPSILON * largest;
        Self { middle: origin + middle, axes, half: half.map(|half| half + slack) }
    }

    fn node(&self, triangles: Range<u32>, second: u32) -> Node {
        let axes = [self.axes[0].as_vec3(), self.axes[1].as_vec3()];
        let half = self.half.map(|half| (half as f32).next_up());
        Node { middle: self.middle, axes, half, triangles, second }
    }

    fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|corner| {
            let side = |k: usize| if corner >> k & 1 == 0 { -self.half[k] } else { self.half[k] };
            (0..3).fold(self.middle, |point, k| point + side(k) * self.axes[k])
        })
    }

    /// Returns whether a plane separates the boxes: perpendicular to an axis of one, or parallel to an axis of each.
    fn misses(&self, other: &Self) -> bool {
        let apart = other.middle - self.middle;
        let reach = |one: &Self, axis: DVec3| -> f64 {
            (0..3).map(|k| one.half[k] * one.axes[k].dot(axis).abs()).sum()
        };
        let parts = |axis: DVec3| apart.dot(axis).abs() > reach(self, axis) + reach(other, axis);
        self.axes.iter().chain(&other.axes).any(|&axis| parts(axis))
            || self.axes.iter().any(|a| other.axes.iter().any(|b| parts(a.cross(*b))))
    }
}
