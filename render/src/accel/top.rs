//! The trees of a scene: one over the objects, and one for each mesh.

use super::Accel;
use super::build::Numbered;
use super::frame::{Frame, TreeRay};
use super::group::Group;
use super::kernel::Kernel;
use super::leaf::Probe;
use super::mesh_tree::{self, MeshTree};
use super::node::Child;
use super::own_ray::OwnRay;
use super::simd::Task;
use super::slabs::SlabRay;
use super::tree::{Leaves, Tree};
use crate::ray::{Hit, Ray};
use crate::shape::{Mesh, Shape};
use glam::DVec3;
use std::collections::{BTreeMap, HashMap};
use std::ops::Range;

/// Largest number of objects that are tested against a group. If larger, a group tests boxes that no ray
/// comes near. If smaller, scenes of many objects trace their rays one by one.
const FEW: usize = 32;

/// Largest number of objects that every ray tries without the upper tree. If larger, rays try objects
/// beside their path. If smaller, scenes of an object and a floor pay for a tree.
const ALL: usize = 2;

/// An object of the upper tree.
#[derive(Debug, Clone, Copy)]
enum Item {
    /// A shape that is one piece.
    Whole(u32),
    /// An object that is a mesh, and a tree over triangles of the mesh.
    Mesh(u32, usize),
    /// An instance, and a tree over triangles of its mesh.
    Instance(u32, usize),
}

/// A tree over objects.
#[derive(Debug)]
pub struct Trees {
    tree: Option<Tree>,
    /// The objects, in the order of the upper tree's leaves.
    items: Vec<Item>,
    /// The boxes of the objects.
    bounds: Vec<[DVec3; 2]>,
    /// The trees of all meshes. The instances of a mesh have the same trees.
    meshes: Vec<MeshTree>,
}

impl Trees {
    /// Builds the trees. `bounds` are those of the shapes that are one piece; shapes without bounds
    /// are left out.
    ///
    /// `stock` returns the trees of an object that is a mesh, if they were built before.
    #[must_use]
    pub fn build(
        shapes: &[&Shape],
        bounds: &[Option<[DVec3; 2]>],
        stock: &mut dyn FnMut(usize) -> Option<Vec<MeshTree>>,
    ) -> Self {
        let mut items: Vec<(Item, [DVec3; 2])> = Vec::new();
        let mut meshes = Vec::new();
        let mut known = HashMap::new();
        for (object, shape) in shapes.iter().enumerate() {
            let number = object as u32;
            match (shape, bounds[object]) {
                (Shape::Mesh(mesh), _) => {
                    let trees = match stock(object) {
                        Some(trees) => {
                            let before = meshes.len();
                            meshes.extend(trees);
                            before..meshes.len()
                        }
                        None => plant(mesh, &mut meshes),
                    };
                    items.extend(trees.map(|k| (Item::Mesh(number, k), meshes[k].tree().bounds)));
                }
                (Shape::Instance(instance), Some(bounds)) => {
                    let trees = known.entry(instance.key());
                    let trees = trees.or_insert_with(|| plant(instance.mesh(), &mut meshes));
                    items.extend(trees.clone().map(|k| (Item::Instance(number, k), bounds)));
                }
                (_, Some(bounds)) => items.push((Item::Whole(number), bounds)),
                (_, None) => {}
            }
        }
        let whole = items.iter().map(|(_, bounds)| *bounds);
        let Some(whole) = whole.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]) else {
            return Self { tree: None, items: vec![], bounds: vec![], meshes };
        };
        let frame = Frame::around(whole);
        let numbered = |(number, (_, bounds)): (usize, &(Item, [DVec3; 2]))| {
            let [low, high] = frame.box_around(*bounds);
            Numbered::new(number as u32, low, high)
        };
        let mut boxes: Vec<Numbered> = items.iter().enumerate().map(numbered).collect();
        let (tree, leaves) = Tree::build(whole, frame, &mut boxes, 1);
        let in_order = leaves.into_iter().flatten().map(|at| boxes[at].number());
        let (items, bounds) = in_order.map(|number| items[number as usize]).unzip();
        Self { tree: Some(tree), items, bounds, meshes }
    }

    /// Returns the trees of the objects that are meshes, by the number of the object.
    #[must_use]
    pub fn into_meshes(self) -> BTreeMap<usize, Vec<MeshTree>> {
        let of_mesh = |item: &Item| match *item {
            Item::Mesh(object, tree) => Some((tree, object as usize)),
            Item::Whole(_) | Item::Instance(..) => None,
        };
        let objects: BTreeMap<usize, usize> = self.items.iter().filter_map(of_mesh).collect();
        let mut trees: BTreeMap<usize, Vec<MeshTree>> = BTreeMap::new();
        for (number, tree) in self.meshes.into_iter().enumerate() {
            if let Some(&object) = objects.get(&number) {
                trees.entry(object).or_default().push(tree);
            }
        }
        trees
    }

    /// Memory in bytes of all trees and of their copies of triangles.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let own = self.tree.as_ref().map_or(0, Tree::bytes);
        // Of a single object, there is nothing to search.
        let items = size_of_val(&*self.items) + size_of_val(&*self.bounds);
        let items = if own > 0 { items } else { 0 };
        own + items + self.meshes.iter().map(MeshTree::bytes).sum::<usize>()
    }

    /// Number of boxes examined to build the trees; a box counts each time it is examined.
    #[must_use]
    pub fn looks(&self) -> u64 {
        let meshes = self.meshes.iter().map(|mesh| mesh.tree().looks()).sum::<u64>();
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
        let mut objects = Objects { trees: self, accel, ray, see };
        if self.items.len() <= ALL {
            let mut t_max = t_max;
            for item in &self.items {
                t_max = objects.visit_item(kernel, item, t_max);
            }
        } else {
            tree.walk(kernel, (ray, accel.extent), t_max, &mut objects);
        }
    }
}

impl Trees {
    /// Calls the group's `see` with the hits of all its rays. The upper tree is not used: the boxes of a
    /// few objects are tested against the whole group. Among many objects, rays are traced one by one.
    #[inline(always)]
    pub fn walk_group<K: Kernel>(
        &self,
        kernel: K,
        group: &mut Group<'_, '_, impl FnMut(usize, Hit) -> f64>,
    ) {
        let accel = group.accel;
        if self.items.len() > FEW {
            group.each(|ray, t_max, mut see| self.walk(kernel, ray, accel, t_max, &mut see));
            return;
        }
        if let [Item::Mesh(object, mesh)] = *self.items {
            group.walk_mesh(kernel, object, &self.meshes[mesh]);
            return;
        }
        let around = group.lanes.around();
        let mut order = [(0.0, 0); FEW];
        let mut count = 0;
        for (number, bounds) in self.bounds.iter().enumerate() {
            let Some(enter) = group.lanes.crosses(&around, bounds) else { continue };
            let mut at = count;
            while at > 0 && enter < order[at - 1].0 {
                order[at] = order[at - 1];
                at -= 1;
            }
            order[at] = (enter, number);
            count += 1;
        }
        for &(enter, number) in &order[..count] {
            if enter > group.lanes.farthest() {
                return;
            }
            match self.items[number] {
                Item::Whole(object) => group.each(|ray, t_max, see| {
                    if let Some(hit) = Probe::new(accel, ray).meet_shape(accel, object, t_max) {
                        see(hit);
                    }
                }),
                Item::Mesh(object, mesh) => {
                    group.walk_mesh(kernel, object, &self.meshes[mesh]);
                }
                Item::Instance(object, mesh) => {
                    let mesh = &self.meshes[mesh];
                    group.each(|ray, t_max, see| {
                        kernel.apart(&mut InOwnSpace { mesh, accel, object, ray, t_max, see });
                    });
                }
            }
        }
    }
}

/// The leaves of the upper tree, visited by a ray.
struct Objects<'a, 'b, F> {
    trees: &'a Trees,
    accel: &'a Accel<'b>,
    ray: &'a Ray,
    see: F,
}

impl<F: FnMut(Hit) -> f64> Objects<'_, '_, F> {
    #[inline(always)]
    fn visit_item<K: Kernel>(&mut self, kernel: K, item: &Item, t_max: f64) -> f64 {
        let Self { trees, accel, ray, see } = self;
        match item {
            Item::Whole(object) => {
                let hit = Probe::new(accel, ray).meet_shape(accel, *object, t_max);
                hit.map_or(t_max, see)
            }
            Item::Mesh(object, mesh) => {
                let mesh = &trees.meshes[*mesh];
                mesh.walk(kernel, ray, (accel, *object), t_max, see)
            }
            Item::Instance(object, mesh) => {
                let (object, mesh) = (*object, &trees.meshes[*mesh]);
                kernel.apart(&mut InOwnSpace { mesh, accel, object, ray, t_max, see })
            }
        }
    }
}

impl<F: FnMut(Hit) -> f64> Leaves for Objects<'_, '_, F> {
    #[inline(always)]
    fn visit<K: Kernel>(&mut self, kernel: K, leaf: Child, _: &TreeRay, _: f32, t_max: f64) -> f64 {
        let trees = self.trees;
        self.visit_item(kernel, &trees.items[leaf.number()], t_max)
    }
}

/// The walk of a ray through the mesh of an instance.
struct InOwnSpace<'a, 'b, F> {
    mesh: &'a MeshTree,
    accel: &'a Accel<'b>,
    object: u32,
    ray: &'a Ray,
    t_max: f64,
    see: F,
}

impl<F: FnMut(Hit) -> f64> Task for InOwnSpace<'_, '_, F> {
    type Out = f64;

    #[inline(always)]
    fn run<K: Kernel>(&mut self, kernel: K) -> f64 {
        let Self { mesh, accel, object, ray, t_max, see } = self;
        let Shape::Instance(instance) = accel.shapes[*object as usize] else { return *t_max };
        let slabs = SlabRay::new(ray.origin, ray.direction, accel.extent);
        let own = OwnRay::new(accel, (*object, instance), ray, &slabs, *t_max);
        let Some(own) = own else { return *t_max };
        mesh.walk_own(kernel, &own, (accel, *object), own.limit(*t_max), &mut |hit| {
            if let Some(hit) = own.in_scene(hit, *t_max) {
                *t_max = see(hit);
            }
            own.limit(*t_max)
        });
        *t_max
    }
}

/// Builds the trees of a mesh and returns their indices.
fn plant(mesh: &Mesh, trees: &mut Vec<MeshTree>) -> Range<usize> {
    let (before, count) = (trees.len(), mesh.triangles.len() as u32);
    for first in (0..count).step_by(mesh_tree::MOST as usize) {
        let last = first.saturating_add(mesh_tree::MOST).min(count);
        trees.extend(MeshTree::build(mesh, first..last));
    }
    before..trees.len()
}
