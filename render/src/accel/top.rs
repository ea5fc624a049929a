//! The trees of a scene: one over the objects, and one for each mesh.

use super::Accel;
use super::build::Numbered;
use super::frame::{Frame, TreeRay};
use super::kernel::Kernel;
use super::leaf::Probe;
use super::mesh_tree::{self, MeshTree};
use super::node::Child;
use super::tree::{Leaves, Tree};
use crate::ray::{Hit, Ray};
use crate::shape::Shape;

use glam::DVec3;

/// An object of the upper tree.
#[derive(Debug)]
enum Item {
    /// A shape that is one piece.
    Whole(u32),
    /// Triangles of a mesh.
    Mesh(u32, MeshTree),
}

/// A tree over objects.
#[derive(Debug)]
pub struct Trees {
    tree: Option<Tree>,
    /// The objects, in the order of the upper tree's leaves.
    items: Vec<Item>,
}

impl Trees {
    /// Builds the trees. `bounds` are those of the shapes that are one piece; shapes without bounds
    /// are left out.
    #[must_use]
    pub fn build(shapes: &[&Shape], bounds: &[Option<[DVec3; 2]>]) -> Self {
        let mut items: Vec<(Item, [DVec3; 2])> = Vec::new();
        for (object, shape) in shapes.iter().enumerate() {
            let number = object as u32;
            if let Shape::Mesh(mesh) = shape {
                let count = mesh.triangles.len() as u32;
                for first in (0..count).step_by(mesh_tree::MOST as usize) {
                    let last = first.saturating_add(mesh_tree::MOST).min(count);
                    if let Some(tree) = MeshTree::build(mesh, first..last) {
                        let bounds = tree.tree().bounds;
                        items.push((Item::Mesh(number, tree), bounds));
                    }
                }
            } else if let Some(bounds) = bounds[object] {
                items.push((Item::Whole(number), bounds));
            }
        }
        let whole = items.iter().map(|(_, bounds)| *bounds);
        let Some(whole) = whole.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]) else {
            return Self { tree: None, items: vec![] };
        };
        let frame = Frame::around(whole);
        let numbered = |(number, (_, bounds)): (usize, &(Item, [DVec3; 2]))| {
            let [low, high] = frame.box_around(*bounds);
            Numbered::new(number as u32, low, high)
        };
        let mut boxes: Vec<Numbered> = items.iter().enumerate().map(numbered).collect();
        let (tree, leaves) = Tree::build(whole, frame, &mut boxes, 1);
        let mut unsorted: Vec<Option<Item>> =
            items.into_iter().map(|(item, _)| Some(item)).collect();
        let in_order = leaves.into_iter().flatten().map(|at| boxes[at].number());
        let items = in_order.filter_map(|number| unsorted[number as usize].take()).collect();
        Self { tree: Some(tree), items }
    }

    /// The trees of the meshes.
    fn meshes(&self) -> impl Iterator<Item = &MeshTree> {
        self.items.iter().filter_map(|item| match item {
            Item::Mesh(_, tree) => Some(tree),
            Item::Whole(_) => None,
        })
    }

    /// Memory in bytes of all trees and of their copies of triangles.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let own = self.tree.as_ref().map_or(0, Tree::bytes);
        own + self.meshes().map(MeshTree::bytes).sum::<usize>()
    }

    /// Number of boxes examined to build the trees; a box counts each time it is examined.
    #[must_use]
    pub fn looks(&self) -> u64 {
        let meshes = self.meshes().map(|mesh| mesh.tree().looks()).sum::<u64>();
        self.tree.as_ref().map_or(0, Tree::looks) + meshes
    }

    /// Calls `see` with the hits up to the distance that it last returned, initially `t_max`.
    #[inline(always)]
    pub fn walk<K: Kernel>(
        &self,
        kernel: K,
        ray: &Ray,
        accel: &Accel<'_>,
        t_max: f64,
        see: &mut impl FnMut(Hit) -> f64,
    ) {
        let Some(tree) = &self.tree else { return };
        let mut objects = Objects { items: &self.items, accel, ray, see };
        if let [item] = &*self.items {
            objects.visit_item(kernel, item, t_max);
        } else {
            tree.walk(kernel, (ray, accel.extent), t_max, &mut objects);
        }
    }
}

/// The leaves of the upper tree, visited by a ray.
struct Objects<'a, 'b, F> {
    items: &'a [Item],
    accel: &'a Accel<'b>,
    ray: &'a Ray,
    see: F,
}

impl<F: FnMut(Hit) -> f64> Objects<'_, '_, F> {
    #[inline(always)]
    fn visit_item<K: Kernel>(&mut self, kernel: K, item: &Item, t_max: f64) -> f64 {
        let Self { accel, ray, see, .. } = self;
        match item {
            Item::Whole(object) => {
                let hit = Probe::new(accel, ray).meet_shape(accel, *object, t_max);
                hit.map_or(t_max, see)
            }
            Item::Mesh(object, mesh) => mesh.walk(kernel, ray, (accel, *object), t_max, see),
        }
    }
}

impl<F: FnMut(Hit) -> f64> Leaves for Objects<'_, '_, F> {
    #[inline(always)]
    fn visit<K: Kernel>(&mut self, kernel: K, leaf: Child, _: &TreeRay, _: f32, t_max: f64) -> f64 {
        let items = self.items;
        self.visit_item(kernel, &items[leaf.number()], t_max)
    }
}
