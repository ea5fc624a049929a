//! A bounding volume hierarchy, built by obvhs and walked here.
//!
//! The library builds a binary tree (PLOC with reinsertion) over boxes rounded outward to `f32`.
//! The walk tests those boxes in `f64`; what is hit is decided elsewhere, by one function for every
//! structure.

use super::slabs::SlabRay;
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
        Some(Self { nodes: tree.nodes, order: tree.primitive_indices })
    }

    /// Gives `visit` every box that the ray may meet within `t_max`, nearer ones first as far as
    /// the tree tells; `visit` takes the current `t_max` and returns the one to go on with.
    pub fn walk(&self, ray: &SlabRay, t_max: f64, mut visit: impl FnMut(u32, f64) -> f64) {
        if enters(ray, &self.nodes[0].aabb, t_max).is_some() {
            self.walk_from(0, ray, t_max, &mut visit);
        }
    }

    /// Memory in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + size_of_val(&*self.order)
    }

    fn walk_from(
        &self,
        start: u32,
        ray: &SlabRay,
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
            let enters = |child: u32| enters(ray, &nodes[child as usize].aabb, t_max);
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

/// Where the ray enters the box, if that is before `t_max`.
fn enters(ray: &SlabRay, bounds: &Aabb, t_max: f64) -> Option<f64> {
    let [enter, _] = ray.crosses([bounds.min.as_dvec3(), bounds.max.as_dvec3()])?;
    (enter <= t_max).then_some(enter)
}

fn round_down(v: DVec3) -> Vec3A {
    let down = |x: f64| if f64::from(x as f32) <= x { x as f32 } else { (x as f32).next_down() };
    Vec3A::new(down(v.x), down(v.y), down(v.z))
}

fn round_up(v: DVec3) -> Vec3A {
    let up = |x: f64| if f64::from(x as f32) >= x { x as f32 } else { (x as f32).next_up() };
    Vec3A::new(up(v.x), up(v.y), up(v.z))
}
