//! A bounding volume hierarchy, built by [`super::build`] and walked here.
//!
//! For the walk the boxes of two siblings lie in one cache line as `f32`, counted from the middle of
//! the tree, and are tested together.
//!
//! **Nothing missed.** [`SlabRay::crosses`] decides in `f64` which boxes a ray crosses. The test in
//! `f32` lets through all of those: the ray is first moved to where it enters the whole tree, so
//! that everything is as small as the tree, and boxes are widened by more than the roundings. With
//! `h` the tree's largest coordinate and in units of `2^-24 h` these are 1 for the start, 1 for
//! moving it by the widening, 2 for its distance from a plane, 4 for the product with the inverse:
//! 8 of about 17 that are given. Those of `f64` are added as parts of their scale.

use super::build::{Bounds, Builder, Part};
use super::slabs::SlabRay;
use glam::{DVec3, Vec4, Vec4Swizzles};

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
    looks: u64,
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
        let boxes: Vec<Bounds> = boxes
            .iter()
            .map(|[low, high]| Bounds::around([*low - middle, *high - middle]))
            .collect();
        let whole = Bounds::around(bounds.map(|corner| corner - middle));
        let mut builder = Builder::new(&boxes);
        let (root, pairs, order) = laid_out(&mut builder, whole, boxes.len());
        Some((Self { bounds, middle, half, root, pairs, looks: builder.looks }, order))
    }

    /// How many boxes were looked at to build the tree, each time counted.
    #[must_use]
    pub fn looks(&self) -> u64 {
        self.looks
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

/// A part of the boxes that is still to be divided.
struct Open {
    /// Where its boxes are in the order.
    boxes: std::ops::Range<usize>,
    bounds: Bounds,
    depth: usize,
    /// The pair and the side that lead to the part; nothing for the whole.
    parent: Option<(usize, usize)>,
}

/// The nodes in pairs, parents first, and the boxes' numbers in the order of the leaves.
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
                let sides =
                    |axis: usize| Vec4::new(a.low[axis], b.low[axis], a.high[axis], b.high[axis]);
                let pair = pairs.len();
                let children = [Child::default(); 2];
                pairs.push(Pair { x: sides(0), y: sides(1), z: sides(2), children });
                let depth = depth + 1;
                let at = boxes.start + at;
                let part =
                    |boxes, bounds, side| Open { boxes, bounds, depth, parent: Some((pair, side)) };
                // The first part is divided next, so that it lies beside its parent.
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
