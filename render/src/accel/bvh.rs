//! A bounding volume hierarchy, built by obvhs and walked here.
//!
//! The library builds a binary tree (PLOC with reinsertion) over boxes rounded outward to `f32`.
//! The walk tests those boxes in `f64` and a hair generously, so that no primitive is lost to
//! rounding; what is hit is decided elsewhere, by one function for every structure.
//!
//! The triangle test works on coordinates relative to the ray's origin and is off by their
//! rounding, so a ray that misses a box by that much may still hit what is in it. Boxes are
//! therefore widened, for each ray, by a bound on it.

use glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::leaf_collapser::collapse;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

/// How many nodes may wait at once before the walk recurses.
///
/// Larger, and every ray clears memory that it does not use; smaller, and large meshes recurse,
/// which tests are made to do.
const STACK: usize = if cfg!(test) { 2 } else { 24 };

/// A tree over boxes; the leaves name them by index.
#[derive(Debug)]
pub struct Bvh {
    nodes: Vec<Bvh2Node>,
    order: Vec<u32>,
    /// The largest coordinate of any box, without its sign.
    extent: f64,
}

/// A ray prepared for the box tests of one tree.
#[derive(Debug, Clone, Copy)]
struct BoxRay {
    /// The origin moved up and down by the widening, which is the same as widening every box.
    above: DVec3,
    below: DVec3,
    inverse: DVec3,
}

impl BoxRay {
    fn new(origin: DVec3, direction: DVec3, extent: f64) -> Self {
        // A zero component becomes a huge finite inverse: no product is NaN, even on a box's face.
        let invert = |d: f64| if d.abs() > 1e-300 { 1.0 / d } else { 1e300f64.copysign(d) };
        let inverse = DVec3::new(invert(direction.x), invert(direction.y), invert(direction.z));
        // Shearing rounds each coordinate four times; twice that, and the box test's own three.
        let widening = 16.0 * f64::EPSILON * (origin.abs().max_element() + extent);
        Self { above: origin + widening, below: origin - widening, inverse }
    }

    /// Where the ray enters the box, if that is before `t_max`.
    fn enters(&self, bounds: &Aabb, t_max: f64) -> Option<f64> {
        let low = (bounds.min.as_dvec3() - self.above) * self.inverse;
        let high = (bounds.max.as_dvec3() - self.below) * self.inverse;
        let enter = low.min(high).max_element().max(0.0);
        let leave = low.max(high).min_element();
        (enter <= leave && enter <= t_max).then_some(enter)
    }
}

impl Bvh {
    /// A tree over boxes given as lower and upper corners; nothing for no boxes.
    #[must_use]
    pub fn build(boxes: &[[DVec3; 2]]) -> Option<Self> {
        if boxes.is_empty() {
            return None;
        }
        let boxes: Vec<Aabb> = boxes
            .iter()
            .map(|[low, high]| Aabb { min: round_down(*low), max: round_up(*high) })
            .collect();
        let extent = boxes.iter().fold(0.0, |extent: f32, bounds| {
            extent.max(bounds.min.abs().max(bounds.max.abs()).max_element())
        });
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
        Some(Self { nodes: tree.nodes, order: tree.primitive_indices, extent: f64::from(extent) })
    }

    /// Gives `visit` every box that the ray may meet within `t_max`, nearer ones first as far as
    /// the tree tells; `visit` takes the current `t_max` and returns the one to go on with.
    pub fn walk(
        &self,
        origin: DVec3,
        direction: DVec3,
        t_max: f64,
        mut visit: impl FnMut(u32, f64) -> f64,
    ) {
        let ray = BoxRay::new(origin, direction, self.extent);
        if ray.enters(&self.nodes[0].aabb, t_max).is_some() {
            self.walk_from(0, &ray, t_max, &mut visit);
        }
    }

    fn walk_from(
        &self,
        start: u32,
        ray: &BoxRay,
        mut t_max: f64,
        visit: &mut impl FnMut(u32, f64) -> f64,
    ) -> f64 {
        let nodes = &self.nodes;
        let mut waiting = [(0u32, 0.0f64); STACK];
        let mut count = 0;
        let mut next = Some(start);
        loop {
            let Some(current) = next.take() else {
                // The nearest node that still matters.
                loop {
                    if count == 0 {
                        return t_max;
                    }
                    count -= 1;
                    let (node, enter) = waiting[count];
                    if enter <= t_max {
                        next = Some(node);
                        break;
                    }
                }
                continue;
            };
            let node = &nodes[current as usize];
            let first = node.first_index;
            if node.is_leaf() {
                for slot in first..first + node.prim_count {
                    t_max = visit(self.order[slot as usize], t_max);
                }
                continue;
            }
            let enters = |child: u32| ray.enters(&nodes[child as usize].aabb, t_max);
            let (near, far) = match (enters(first), enters(first + 1)) {
                (None, None) => continue,
                (Some(_), None) => (first, None),
                (None, Some(_)) => (first + 1, None),
                (Some(a), Some(b)) if a <= b => (first, Some((first + 1, b))),
                (Some(a), Some(_)) => (first + 1, Some((first, a))),
            };
            next = Some(near);
            if let Some(far) = far {
                if count == STACK {
                    // A tree deeper than the stack: finish the near side first.
                    t_max = self.walk_from(near, ray, t_max, visit);
                    next = Some(far.0);
                } else {
                    waiting[count] = far;
                    count += 1;
                }
            }
        }
    }
}

fn round_down(v: DVec3) -> Vec3A {
    let down = |x: f64| if f64::from(x as f32) <= x { x as f32 } else { (x as f32).next_down() };
    Vec3A::new(down(v.x), down(v.y), down(v.z))
}

fn round_up(v: DVec3) -> Vec3A {
    let up = |x: f64| if f64::from(x as f32) >= x { x as f32 } else { (x as f32).next_up() };
    Vec3A::new(up(v.x), up(v.y), up(v.z))
}
