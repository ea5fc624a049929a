//! A bounding volume hierarchy, built by obvhs and walked here.
//!
//! The library builds a binary tree (PLOC with reinsertion). For the walk the boxes of two siblings
//! lie in one cache line as `f32`, counted from the middle of the tree, and are tested together.
//!
//! **Nothing missed.** [`SlabRay::crosses`] decides in `f64` which boxes a ray crosses. The test in
//! `f32` lets through all of those: the ray is first moved to where it enters the whole tree, so
//! that everything is as small as the tree, and boxes are widened by more than the roundings. With
//! `h` the tree's largest coordinate and in units of `2^-24 h` these are 1 for the start, 1 for
//! moving it by the widening, 2 for its distance from a plane, 4 for the product with the inverse:
//! 8 of about 17 that are given. Those of `f64` are added as parts of their scale.

use super::slabs::SlabRay;
use glam::{DVec3, Vec3A, Vec4, Vec4Swizzles};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::leaf_collapser::collapse;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

/// How many nodes may wait at once before the walk recurses.
///
/// Larger, and every ray clears memory that it does not use; smaller, and large meshes recurse,
/// which tests are made to do.
const STACK: usize = if cfg!(test) { 2 } else { 24 };

/// A tree over boxes, which are renumbered in the tree's order.
#[derive(Debug)]
pub struct Bvh {
    bounds: [DVec3; 2],
    /// The middle of the tree, from which its boxes count.
    middle: DVec3,
    /// The largest coordinate of any box, from the middle and without its sign.
    half: f64,
    root: Child,
    pairs: Vec<Pair>,
}

/// Two siblings: along each axis the lower sides of both boxes and then the upper ones.
#[derive(Debug, Clone, Copy)]
struct Pair {
    x: Vec4,
    y: Vec4,
    z: Vec4,
    children: [Child; 2],
}

/// A node without its box.
#[derive(Debug, Clone, Copy, Default)]
struct Child {
    /// Its first box, or where its own children are.
    first: u32,
    /// How many boxes it has; 0 for children.
    count: u32,
}

/// A ray prepared for the tests of one tree.
#[derive(Debug, Clone, Copy)]
struct PairRay {
    /// Where the ray enters the tree; distances count from here.
    start: f64,
    x: Vec4,
    y: Vec4,
    z: Vec4,
    inverse: [Vec4; 3],
}

impl PairRay {
    fn new(tree: &Bvh, ray: &SlabRay, start: f64) -> Self {
        let widening = (1e-6 * tree.half + 64.0 * f64::EPSILON * ray.scale) as f32 + 1e-37;
        let place = ray.origin + start * ray.direction - tree.middle;
        let sides = |axis: usize| {
            let place = place[axis].clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32;
            let (above, below) = (place + widening, place - widening);
            Vec4::new(above, above, below, below)
        };
        // Where this cuts, the ray stays on one side of all planes in the tree.
        let inverse = ray.inverse.clamp(DVec3::splat(-1e30), DVec3::splat(1e30)).as_vec3();
        let inverse = inverse.to_array().map(Vec4::splat);
        Self { start, x: sides(0), y: sides(1), z: sides(2), inverse }
    }

    /// A distance of the ray as one in the tree, not less.
    fn distance(&self, t: f64) -> f32 {
        ((t - self.start) as f32).next_up()
    }

    /// For both siblings where the ray enters, and whether it does before `t_max`.
    #[inline]
    fn enters(&self, pair: &Pair, t_max: f32) -> ([f32; 2], [bool; 2]) {
        let x = (pair.x - self.x) * self.inverse[0];
        let y = (pair.y - self.y) * self.inverse[1];
        let z = (pair.z - self.z) * self.inverse[2];
        // Upper sides come first where the ray goes down.
        let (a, b, c) = (x.zwxy(), y.zwxy(), z.zwxy());
        let enter = x.min(a).max(y.min(b)).max(z.min(c)).max(Vec4::ZERO);
        let leave = x.max(a).min(y.max(b)).min(z.max(c)).min(Vec4::splat(t_max));
        let met = enter.cmple(leave).bitmask();
        ([enter.x, enter.y], [met & 1 != 0, met & 2 != 0])
    }
}

impl Bvh {
    /// A tree over boxes given as lower and upper corners, and the boxes' numbers in its order;
    /// nothing for no boxes.
    #[must_use]
    pub fn build(boxes: &[[DVec3; 2]]) -> Option<(Self, Vec<u32>)> {
        let bounds = boxes.iter().copied().reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])?;
        let middle = 0.5 * (bounds[0] + bounds[1]);
        let half = (bounds[0] - middle).abs().max((bounds[1] - middle).abs()).max_element();
        let boxes: Vec<Aabb> = boxes
            .iter()
            .map(|[low, high]| Aabb {
                min: round_down(*low - middle),
                max: round_up(*high - middle),
            })
            .collect();
        let indices = (0..boxes.len() as u32).collect();
        let mut tree = PlocBuilder::with_capacity(boxes.len()).build(
            PlocSearchDistance::Medium,
            &boxes,
            indices,
            SortPrecision::U64,
            3,
        );
        // obvhs's own figures for its "medium" build.
        let mut optimizer = ReinsertionOptimizer::default();
        optimizer.run(&mut tree, 0.05, None);
        collapse(&mut tree, 4, 3.0);
        optimizer.run(&mut tree, 0.1, None);
        let (root, pairs, order) = laid_out(&tree);
        Some((Self { bounds, middle, half, root, pairs }, order))
    }

    /// Memory in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.pairs)
    }

    /// Gives `visit` every box that the ray may meet within `t_max`, nearer ones first as far as
    /// the tree tells; `visit` takes the current `t_max` and returns the one to go on with.
    pub fn walk(&self, ray: &SlabRay, t_max: f64, mut visit: impl FnMut(u32, f64) -> f64) {
        if let Some([enter, _]) = ray.crosses(self.bounds).filter(|[enter, _]| *enter <= t_max) {
            self.walk_from(self.root, &PairRay::new(self, ray, enter), t_max, &mut visit);
        }
    }

    fn walk_from(
        &self,
        start: Child,
        ray: &PairRay,
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
            } else {
                let pair = &self.pairs[current.first as usize];
                let (enter, met) = ray.enters(pair, limit);
                let [a, b] = pair.children;
                match met {
                    [false, false] => {}
                    [true, false] => {
                        current = a;
                        continue;
                    }
                    [false, true] => {
                        current = b;
                        continue;
                    }
                    [true, true] => {
                        let (near, far) = if enter[0] <= enter[1] {
                            (a, (b, enter[1]))
                        } else {
                            (b, (a, enter[0]))
                        };
                        if count < STACK {
                            waiting[count] = far;
                            count += 1;
                            current = near;
                        } else {
                            // A tree deeper than the stack: finish the near side first.
                            t_max = self.walk_from(near, ray, t_max, visit);
                            limit = ray.distance(t_max);
                            current = far.0;
                        }
                        continue;
                    }
                }
            }
            // The nearest node that still matters.
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

/// The nodes in pairs, parents first, and the boxes' numbers in the order of the leaves.
fn laid_out(tree: &Bvh2) -> (Child, Vec<Pair>, Vec<u32>) {
    let mut pairs: Vec<Pair> = Vec::with_capacity(tree.nodes.len() / 2);
    let mut order = Vec::with_capacity(tree.primitive_indices.len());
    let mut root = Child::default();
    // Nodes, and which child of which pair they are.
    let mut open = vec![(0u32, None)];
    while let Some((number, parent)) = open.pop() {
        let node = &tree.nodes[number as usize];
        let first = node.first_index;
        let child = if node.is_leaf() {
            let slots = first as usize..(first + node.prim_count) as usize;
            let start = order.len() as u32;
            order.extend(&tree.primitive_indices[slots]);
            Child { first: start, count: node.prim_count }
        } else {
            let [a, b] = [first, first + 1].map(|child| tree.nodes[child as usize].aabb);
            let sides = |axis: usize| Vec4::new(a.min[axis], b.min[axis], a.max[axis], b.max[axis]);
            let place = pairs.len();
            let children = [Child::default(); 2];
            pairs.push(Pair { x: sides(0), y: sides(1), z: sides(2), children });
            open.extend([(first + 1, Some((place, 1))), (first, Some((place, 0)))]);
            Child { first: place as u32, count: 0 }
        };
        match parent {
            Some((pair, which)) => pairs[pair].children[which] = child,
            None => root = child,
        }
    }
    (root, pairs, order)
}

fn round_down(v: DVec3) -> Vec3A {
    let down = |x: f64| if f64::from(x as f32) <= x { x as f32 } else { (x as f32).next_down() };
    Vec3A::new(down(v.x), down(v.y), down(v.z))
}

fn round_up(v: DVec3) -> Vec3A {
    let up = |x: f64| if f64::from(x as f32) >= x { x as f32 } else { (x as f32).next_up() };
    Vec3A::new(up(v.x), up(v.y), up(v.z))
}
