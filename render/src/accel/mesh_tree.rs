//! The triangles of a mesh in a tree.

use super::Accel;
use super::block::{ABSENT, Block, LANES};
use super::build::Numbered;
use super::frame::{Frame, TreeRay};
use super::kernel::Kernel;
use super::leaf::Probe;
use super::node::Child;
use super::own_ray::OwnRay;
use super::pages;
use super::simd::Task;
use super::tree::{Leaves, Tree};
use crate::ray::{Hit, Piece, Ray};
use crate::shape::Mesh;
use crate::shape::triangle::{self, Corners};
use rayon::prelude::*;
use std::ops::Range;

/// Largest number of triangles of a tree; a larger mesh has several trees.
pub const MOST: u32 = Child::MOST;

/// A tree over triangles of a mesh.
#[derive(Debug)]
pub struct MeshTree {
    tree: Tree,
    blocks: Vec<Block>,
    /// True if the blocks hold the exact corners. Only meshes with coordinates that are smaller than the
    /// mesh by a factor beyond 2^100 have inexact blocks.
    exact: bool,
}

impl MeshTree {
    /// Builds a tree over a range of at most [`MOST`] triangles, or returns `None` if no ray meets any
    /// of them.
    #[must_use]
    pub fn build(mesh: &Mesh, triangles: Range<u32>) -> Option<Self> {
        let first = triangles.start;
        let boxed = |number: u32| {
            let corners = mesh.corners(number);
            (!triangle::is_segment(&corners)).then(|| {
                let [low, high] = triangle::bounds(&corners).map(|side| side.as_vec3().to_array());
                Numbered::new(number - first, low, high)
            })
        };
        let mut boxes: Vec<Numbered> = triangles.into_par_iter().filter_map(boxed).collect();
        let bounds = boxes
            .par_iter()
            .map(Numbered::sides)
            .reduce_with(|a, b| [a[0].min(b[0]), a[1].max(b[1])])?;
        // Corners are exact in the frame of their own coordinates, from the offset.
        let own_frame = Frame::exact(bounds);
        let frame = own_frame.moved(mesh.offset);
        let bounds = bounds.map(|corner| corner + mesh.offset);
        boxes.par_iter_mut().for_each(|one| {
            let [low, high] = own_frame.box_around(one.sides());
            *one = Numbered::new(one.number(), low, high);
        });
        let (tree, leaves) = Tree::build(bounds, frame, &mut boxes, LANES);
        let block = |leaf: &Range<usize>| {
            let triangle = |one: &Numbered| {
                let number = first + one.number();
                (number, mesh.corners(number).map(|corner| own_frame.corner(corner)))
            };
            let mut triangles = [(0, [[0.0; 3]; 3]); LANES];
            for (triangle_of, one) in triangles.iter_mut().zip(&boxes[leaf.clone()]) {
                *triangle_of = triangle(one);
            }
            Block::new(&triangles[..leaf.len()])
        };
        let mut blocks = pages::vector(leaves.len());
        leaves.par_iter().map(block).collect_into_vec(&mut blocks);
        let is_exact = |block: &Block| {
            (0..LANES).filter(|&lane| block.numbers[lane] != ABSENT).all(|lane| {
                let scene = frame.scene(block.corners(lane));
                scene == triangle::by_axis(&mesh.corners(block.numbers[lane]), mesh.offset)
            })
        };
        let exact = blocks.par_iter().all(is_exact);
        Some(Self { tree, blocks, exact })
    }

    /// The tree.
    #[must_use]
    pub fn tree(&self) -> &Tree {
        &self.tree
    }

    /// The triangles of a leaf.
    #[must_use]
    #[inline(always)]
    pub fn block(&self, leaf: Child) -> &Block {
        &self.blocks[leaf.number()]
    }

    /// Memory in bytes of the tree and of its copies of triangles.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.tree.bytes() + size_of_val(&*self.blocks)
    }

    /// Calls `see` with the hits up to the distance that it last returned, initially `t_max`. Returns
    /// the last distance.
    #[inline(always)]
    pub fn walk<K: Kernel>(
        &self,
        kernel: K,
        ray: &Ray,
        (accel, object): (&Accel<'_>, u32),
        t_max: f64,
        see: &mut impl FnMut(Hit) -> f64,
    ) -> f64 {
        let mut blocks = Blocks { mesh: self, accel, object, ray, own: None, see };
        self.tree.walk(kernel, (ray, accel.extent), t_max, &mut blocks)
    }

    /// Calls `see` as [`MeshTree::walk`] does, with the hits of a ray in the space of an instance.
    /// Distances are in own units.
    #[inline(always)]
    pub fn walk_own<K: Kernel>(
        &self,
        kernel: K,
        own: &OwnRay,
        (accel, object): (&Accel<'_>, u32),
        t_max: f64,
        see: &mut impl FnMut(Hit) -> f64,
    ) {
        let ray = &own.ray;
        let mut blocks = Blocks { mesh: self, accel, object, ray, own: Some(own), see };
        self.tree.walk(kernel, (ray, own.extent), t_max, &mut blocks);
    }

    /// Returns the corners of a triangle in scene space.
    #[must_use]
    #[inline(always)]
    pub fn corners(&self, accel: &Accel<'_>, object: u32, block: &Block, lane: usize) -> Corners {
        if self.exact {
            self.tree.frame.scene(block.corners(lane))
        } else {
            let piece = Piece { object, triangle: block.numbers[lane] };
            triangle::by_axis(&accel.mesh_corners(piece), accel.offset(object))
        }
    }
}

/// The test of a ray against one triangle of a block. Few triangles of a tree come here, so that the
/// ray is prepared anew for each.
struct Test<'a, 'b> {
    mesh: &'a MeshTree,
    accel: &'a Accel<'b>,
    object: u32,
    ray: &'a Ray,
    own: Option<&'a OwnRay>,
    block: &'a Block,
    lane: usize,
    t_max: f64,
}

impl Task for Test<'_, '_> {
    type Out = Option<Hit>;

    #[inline(always)]
    fn run<K: Kernel>(&mut self, _: K) -> Option<Hit> {
        let Self { mesh, accel, object, ray, own, block, lane, t_max } = *self;
        let piece = Piece { object, triangle: block.numbers[lane & (LANES - 1)] };
        if ray.leaving == Some(piece) {
            return None;
        }
        let corners = mesh.corners(accel, object, block, lane);
        let probe = own.map_or_else(|| Probe::new(accel, ray), OwnRay::probe);
        probe.meet_triangle(accel, piece, &corners, t_max)
    }
}

/// The leaves of a mesh's tree, visited by a ray.
pub struct Blocks<'a, 'b, F> {
    mesh: &'a MeshTree,
    accel: &'a Accel<'b>,
    object: u32,
    ray: &'a Ray,
    /// The ray if the mesh is that of an instance.
    own: Option<&'a OwnRay>,
    see: F,
}

impl<'a, 'b, F: FnMut(Hit) -> f64> Blocks<'a, 'b, F> {
    /// The leaves of a mesh that is an object of the scene. `see` takes hits and returns the next distance.
    #[inline(always)]
    pub fn of(mesh: &'a MeshTree, accel: &'a Accel<'b>, object: u32, ray: &'a Ray, see: F) -> Self {
        Self { mesh, accel, object, ray, own: None, see }
    }
}

impl<F: FnMut(Hit) -> f64> Leaves for Blocks<'_, '_, F> {
    #[inline(always)]
    fn visit<K: Kernel>(
        &mut self,
        kernel: K,
        leaf: Child,
        tree_ray: &TreeRay,
        limit: f32,
        mut t_max: f64,
    ) -> f64 {
        let Self { mesh, accel, object, ray, own, see } = self;
        let block = &mesh.blocks[leaf.number()];
        let mut mask = kernel.triangles(block, tree_ray, leaf.longest(), limit);
        while mask != 0 {
            let lane = mask.trailing_zeros() as usize;
            mask &= mask - 1;
            let (object, ray, own) = (*object, *ray, *own);
            let mut test = Test { mesh, accel, object, ray, own, block, lane, t_max };
            if let Some(hit) = kernel.apart(&mut test) {
                t_max = see(hit);
            }
        }
        t_max
    }
}
