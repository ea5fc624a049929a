//! A bounding volume hierarchy, built by [`super::build`] and walked here.
//!
//! For the walk the binary tree is collapsed into groups of up to four boxes ([`super::wide`]). The
//! boxes of a group are `f32`, counted from the middle of the tree, and are tested together.
//!
//! **Nothing missed.** [`SlabRay::crosses`] decides in `f64` which boxes a ray crosses. The test in
//! `f32` accepts all of those boxes. The ray is first moved to where it enters the whole tree, so
//! that all numbers are as small as the tree. The boxes are widened by more than the roundings. Let
//! `h` be the tree's largest coordinate. In units of `2^-24 h` the roundings are 1 for the start, 1
//! for its move by the widening, 2 for its distance from a plane and 4 for the product with the
//! inverse. Their sum is 8; the widening is about 17. The roundings in `f64` are added as parts of
//! their scale.

use super::build::{Bounds, Builder, Part};
use super::slabs::SlabRay;
use super::wide::{self, Child, Group, Pair, WIDTH};
use glam::{DVec3, Vec4};

/// Capacity of the walk's stack of nodes, at least [`WIDTH`]. Beyond it the walk recurses.
///
/// If larger, every ray clears memory that it does not use. If smaller, rays recurse in large
/// meshes. Tests use the smallest capacity, so that they recurse.
const STACK: usize = if cfg!(test) { WIDTH } else { 32 };

/// A tree over boxes. The boxes are renumbered in the tree's order.
#[derive(Debug)]
pub struct Bvh {
    bounds: [DVec3; 2],
    /// The middle of the tree, the origin of its boxes' coordinates.
    middle: DVec3,
    /// The largest absolute coordinate of any box, from the middle.
    half: f64,
    root: Child,
    groups: Vec<Group>,
    looks: u64,
}

/// A ray prepared for the tests of one tree.
#[derive(Debug, Clone, Copy)]
struct GroupRay {
    /// Distance at which the ray enters the tree; distances in the tree count from it.
    start: f64,
    /// The side of a box that the ray meets first, along each axis: 0 the lower, 1 the upper.
    near: [usize; 3],
    /// Start of the ray along each axis, moved once for the near sides and once for the far ones.
    near_start: [Vec4; 3],
    far_start: [Vec4; 3],
    inverse: [Vec4; 3],
}

impl GroupRay {
    fn new(tree: &Bvh, ray: &SlabRay, start: f64) -> Self {
        let widening = (1e-6 * tree.half + 64.0 * f64::EPSILON * ray.scale) as f32 + 1e-37;
        let place = ray.origin + start * ray.direction - tree.middle;
        // Where the clamp applies, the ray stays on one side of all planes in the tree.
        let inverse = ray.inverse.clamp(DVec3::splat(-1e30), DVec3::splat(1e30)).as_vec3();
        let inverse = inverse.to_array();
        // Lower sides are moved down and upper sides up. This is equivalent to widening every box.
        let starts = |axis: usize| {
            let place = place[axis].clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32;
            let (for_lower, for_upper) = (place + widening, place - widening);
            if inverse[axis] < 0.0 { [for_upper, for_lower] } else { [for_lower, for_upper] }
        };
        let starts = [0, 1, 2].map(starts);
        Self {
            start,
            near: inverse.map(|inverse| usize::from(inverse < 0.0)),
            near_start: starts.map(|[near, _]| Vec4::splat(near)),
            far_start: starts.map(|[_, far]| Vec4::splat(far)),
            inverse: inverse.map(Vec4::splat),
        }
    }

    /// Converts a distance along the ray into one from the tree's entry, rounded up.
    fn distance(&self, t: f64) -> f32 {
        ((t - self.start) as f32).next_up()
    }

    /// Returns for each box of a group the distance at which the ray enters it, and a mask of the
    /// boxes that it enters before `t_max`.
    #[inline]
    fn enters(&self, group: &Group, t_max: f32) -> ([f32; WIDTH], u32) {
        let near = |axis: usize| {
            (group.sides[axis][self.near[axis] & 1] - self.near_start[axis]) * self.inverse[axis]
        };
        let far = |axis: usize| {
            (group.sides[axis][!self.near[axis] & 1] - self.far_start[axis]) * self.inverse[axis]
        };
        let enter = near(0).max(near(1)).max(near(2)).max(Vec4::ZERO);
        let leave = far(0).min(far(1)).min(far(2)).min(Vec4::splat(t_max));
        (enter.to_array(), enter.cmple(leave).bitmask())
    }
}

impl Bvh {
    /// Builds a tree over boxes given as lower and upper corners. Returns the tree and the boxes'
    /// numbers in its order, or `None` without boxes.
    #[must_use]
    pub fn build(boxes: &[[DVec3; 2]]) -> Option<(Self, Vec<u32>)> {
        let bounds = boxes.iter().copied().reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])?;
        let middle = 0.5 * (bounds[0] + bounds[1]);
        let half = (bounds[0] - middle).abs().max((bounds[1] - middle).abs()).max_element();
        let boxes: Vec<Bounds> = boxes
            .iter()
            .map(|[low, high]| Bounds::around([*low - middle, *high - middle]))
            .collect();
        let whole = Bounds::around(bounds.map(|corner| corner - middle));
        let mut builder = Builder::new(&boxes);
        let (root, pairs, order) = laid_out(&mut builder, whole, boxes.len());
        let (root, groups) = wide::collapsed(root, &pairs);
        Some((Self { bounds, middle, half, root, groups, looks: builder.looks }, order))
    }

    /// Number of boxes examined to build the tree; a box counts each time it is examined.
    #[must_use]
    pub fn looks(&self) -> u64 {
        self.looks
    }

    /// Memory of the tree, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.groups)
    }

    /// Calls `visit` with every box that the ray may meet within `t_max`, nearer ones first as far
    /// as the tree can tell. `visit` takes the current `t_max` and returns the next one.
    pub fn walk(&self, ray: &SlabRay, t_max: f64, mut visit: impl FnMut(u32, f64) -> f64) {
        if let Some([enter, _]) = ray.crosses(self.bounds).filter(|[enter, _]| *enter <= t_max) {
            self.walk_from(self.root, &GroupRay::new(self, ray, enter), t_max, &mut visit);
        }
    }

    fn walk_from(
        &self,
        start: Child,
        ray: &GroupRay,
        mut t_max: f64,
        visit: &mut impl FnMut(u32, f64) -> f64,
    ) -> f64 {
        let mut limit = ray.distance(t_max);
        let mut waiting = [(Child::default(), 0.0f32); STACK];
        let mut count = 0;
        let mut current = start;
        'nodes: loop {
            if current.count > 0 {
                for place in current.first..current.first + current.count {
                    t_max = visit(place, t_max);
                }
                limit = ray.distance(t_max);
            } else if count + WIDTH > STACK {
                // The tree is deeper than the stack.
                t_max = self.walk_from(current, ray, t_max, visit);
                limit = ray.distance(t_max);
            } else {
                let group = &self.groups[current.first as usize];
                let (enter, mut met) = ray.enters(group, limit);
                if met != 0 {
                    let child =
                        |k: usize| (group.children[k & (WIDTH - 1)], enter[k & (WIDTH - 1)]);
                    let mut nearest = child(met.trailing_zeros() as usize);
                    met &= met - 1;
                    let first = count;
                    while met != 0 {
                        let mut other = child(met.trailing_zeros() as usize);
                        met &= met - 1;
                        if other.1 < nearest.1 {
                            std::mem::swap(&mut nearest, &mut other);
                        }
                        // The nearer nodes leave the stack first.
                        let mut at = count;
                        while at > first && waiting[at - 1].1 < other.1 {
                            waiting[at] = waiting[at - 1];
                            at -= 1;
                        }
                        waiting[at] = other;
                        count += 1;
                    }
                    current = nearest.0;
                    continue;
                }
            }
            // Takes the nearest node that begins within `t_max`.
            while count > 0 {
                count -= 1;
                let (node, enter) = waiting[count];
                if enter <= limit {
                    current = node;
                    continue 'nodes;
                }
            }
            return t_max;
        }
    }
}

/// A part of the boxes that is not divided yet.
struct Open {
    /// Range of its boxes in the order.
    boxes: std::ops::Range<usize>,
    bounds: Bounds,
    depth: usize,
    /// The pair and the side that lead to the part; `None` for the root.
    parent: Option<(usize, usize)>,
}

/// Returns the nodes in pairs, parents first, and the boxes' numbers in the order of the leaves.
fn laid_out(
    builder: &mut Builder<'_>,
    whole: Bounds,
    count: usize,
) -> (Child, Vec<Pair>, Vec<u32>) {
    let mut pairs: Vec<Pair> = Vec::new();
    let mut order: Vec<u32> = (0..count as u32).collect();
    let mut root = Child::default();
    let mut open = vec![Open { boxes: 0..count, bounds: whole, depth: 0, parent: None }];
    while let Some(Open { boxes, bounds, depth, parent }) = open.pop() {
        let child = match builder.divide(&mut order[boxes.clone()], &bounds, depth) {
            Part::Leaf => Child { first: boxes.start as u32, count: boxes.len() as u32 },
            Part::Cut(at, [a, b]) => {
                let pair = pairs.len();
                pairs.push(Pair { bounds: [a, b], children: [Child::default(); 2] });
                let depth = depth + 1;
                let at = boxes.start + at;
                let part =
                    |boxes, bounds, side| Open { boxes, bounds, depth, parent: Some((pair, side)) };
                // The first part is divided next and therefore lies beside its parent.
                open.push(part(at..boxes.end, b, 1));
                open.push(part(boxes.start..at, a, 0));
                Child { first: pair as u32, count: 0 }
            }
        };
        match parent {
            Some((pair, side)) => pairs[pair].children[side] = child,
            None => root = child,
        }
    }
    (root, pairs, order)
}
