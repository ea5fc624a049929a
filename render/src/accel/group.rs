//! The walk of a group of rays: one visit of a node serves all rays of the group.
//!
//! A box is tested against intervals that contain all rays ([`super::bundle`]), and each triangle
//! against eight rays at once in `f32` and four in `f64` ([`super::lanes`]). A group whose rays go apart
//! visits leaves that hardly a ray meets. Its rays then go on one by one from the nodes that are left.
//! The hits are those of single rays, to the last bit, since the same conditions decide about them.

use super::Accel;
use super::block::{ABSENT, LANES};
use super::bundle::Bundle;
use super::frame::TreeRay;
use super::kernel::{Kernel, Tolerance};
use super::lanes::{FOUR, Lanes, Target};
use super::leaf::Probe;
use super::mesh_tree::{Blocks, MeshTree};
use super::node::Child;
use super::simd::Task;
use super::tree::{Leaves, Tree};
use super::waiting::Waiting;
use crate::ray::{Hit, Piece, Ray};
use crate::shape::triangle::START_OFF;
use glam::DVec4;

/// Groups of fewer rays are traced one by one.
pub const LEAST: usize = 6;

/// Number of leaves without a hit after which the rays of a group go on one by one. If larger, rays that
/// go apart test the triangles of the others. If smaller, groups that pass an edge are given up.
const IN_VAIN: usize = 12;

/// A group of rays, and the state of its walk.
pub struct Group<'a, 'b, F> {
    /// The shapes.
    pub accel: &'a Accel<'b>,
    /// The rays that the caller gave, each with the distance within which its hits count.
    pub rays: &'a [(Ray, f64)],
    /// The rays of `rays` that are traced together.
    pub lanes: Lanes,
    /// Takes the index of a ray among those that the caller gave, and a hit, and returns the next
    /// distance.
    pub see: F,
}

impl<F: FnMut(usize, Hit) -> f64> Group<'_, '_, F> {
    /// Calls `trace` for each ray that is not finished, with the ray, its distance, and a function that
    /// takes its hits and returns the next distance.
    #[inline(always)]
    pub fn each(&mut self, mut trace: impl FnMut(&Ray, f64, &mut dyn FnMut(Hit) -> f64)) {
        for k in 0..self.lanes.count {
            let Self { rays, lanes, see, .. } = self;
            let (number, mut t_max) = (lanes.number(k), lanes.t_max(k));
            if t_max >= 0.0 {
                trace(&rays[number].0, t_max, &mut |hit| {
                    t_max = see(number, hit);
                    t_max
                });
                lanes.shorten(k, t_max);
            }
        }
    }

    /// Finds hits with the triangles of a mesh, which is an object of the scene.
    #[inline(always)]
    pub fn walk_mesh<K: Kernel>(&mut self, kernel: K, object: u32, mesh: &MeshTree) {
        let tree = mesh.tree();
        let frame = (&tree.frame, tree.bounds);
        let bundle = Bundle::new(&self.lanes, self.rays, frame, self.accel.extent);
        let lanes = &self.lanes;
        let rays = (0..lanes.count).map(|k| &self.rays[lanes.number(k)].0);
        let skin = rays.map(|ray| Probe::skin_of(self.accel, ray, object)).fold(0.0, f64::max);
        let mut walk = Walk { group: self, mesh, object, skin, bundle };
        if walk.bundle.count < LEAST {
            walk.one_by_one(kernel, tree.root());
        } else {
            kernel.apart(&mut walk);
        }
    }
}

/// The walk of a bundle through the tree of a mesh.
struct Walk<'g, 'a, 'b, F> {
    group: &'g mut Group<'a, 'b, F>,
    mesh: &'g MeshTree,
    object: u32,
    /// The largest distance from its start, of all rays, within which a triangle coincides with the start.
    skin: f64,
    bundle: Bundle,
}

impl<F: FnMut(usize, Hit) -> f64> Task for Walk<'_, '_, '_, F> {
    type Out = ();

    #[inline(always)]
    fn run<K: Kernel>(&mut self, kernel: K) {
        let tree = self.mesh.tree();
        let mut waiting = Waiting::none();
        let mut in_vain = 0;
        let mut current = tree.root();
        loop {
            if in_vain > IN_VAIN || waiting.is_full() {
                self.one_by_one(kernel, current);
            } else if current.is_leaf() {
                in_vain += usize::from(!self.visit(kernel, current));
            } else {
                let node = tree.node(current);
                let (enter, met) = kernel.boxes_of_all(node, &self.bundle);
                if met != 0 {
                    current = waiting.nearest(node, &enter, met);
                    continue;
                }
            }
            match waiting.next(self.bundle.farthest) {
                Some(next) => current = next,
                None => return,
            }
        }
    }
}

impl<F: FnMut(usize, Hit) -> f64> Walk<'_, '_, '_, F> {
    /// Tests the triangles of a leaf, and returns whether a ray may hit one of them.
    #[inline(always)]
    fn visit<K: Kernel>(&mut self, kernel: K, leaf: Child) -> bool {
        let block = self.mesh.block(leaf);
        let tolerance = Tolerance::of_rounding(self.bundle.rounding, leaf.longest());
        let mut found = false;
        let mut lane = 0;
        while lane < LANES && block.numbers[lane] != ABSENT {
            let mask = kernel.rays(block, lane, &self.bundle, tolerance);
            if mask != 0 {
                found = true;
                let piece = Piece { object: self.object, triangle: block.numbers[lane] };
                let corners = self.mesh.corners(self.group.accel, self.object, block, lane);
                let [x, y, z] = &corners;
                let low = DVec4::new(x.min_element(), y.min_element(), z.min_element(), 0.0);
                let high =
                    DVec4::new(x.max_element(), y.max_element(), z.max_element(), f64::INFINITY);
                let size = (high - low).truncate().extend(0.0);
                // The largest skin of all rays, so that the test is certain for each.
                let off = START_OFF * self.skin * size.length_squared();
                self.decide(kernel, piece, &Target { corners, low, high, off }, mask);
            }
            lane += 1;
        }
        found
    }

    /// Decides about the hits of the rays in a mask with a triangle.
    #[inline(always)]
    fn decide<K: Kernel>(&mut self, kernel: K, piece: Piece, target: &Target, mut mask: u64) {
        let mut shortened = false;
        while mask != 0 {
            let four = mask.trailing_zeros() as usize / FOUR;
            let wanted = (mask >> (FOUR * four)) as u32 & ((1 << FOUR) - 1);
            mask &= !(((1 << FOUR) - 1) << (FOUR * four));
            let met = kernel.four(&self.group.lanes, four, target);
            let mut hits = met.mask & wanted;
            while hits != 0 {
                let lane = hits.trailing_zeros() as usize & (FOUR - 1);
                hits &= hits - 1;
                let k = FOUR * four + lane;
                let Group { accel, rays, lanes, see } = &mut *self.group;
                let (number, t_max) = (lanes.number(k), lanes.t_max(k));
                let ray = &rays[number].0;
                let hit = if met.clear >> lane & 1 == 1 && ray.leaving != Some(piece) {
                    let barycentric = [met.weights[0][lane], met.weights[1][lane]];
                    Some(Hit { t: met.t[lane], piece, barycentric })
                } else {
                    Probe::new(accel, ray).meet_triangle(accel, piece, &target.corners, t_max)
                };
                if let Some(hit) = hit {
                    let next = see(number, hit);
                    lanes.shorten(k, next);
                    self.bundle.shorten(k, next);
                    shortened = true;
                }
            }
        }
        if shortened {
            self.bundle.settle();
        }
    }

    /// Walks a part of the tree with each ray alone.
    fn one_by_one<K: Kernel>(&mut self, kernel: K, part: Child) {
        let (mesh, object) = (self.mesh, self.object);
        let tree = mesh.tree();
        let Group { accel, rays, lanes, see } = &mut *self.group;
        for k in 0..lanes.count {
            let (number, t_max) = (lanes.number(k), lanes.t_max(k));
            let ray = &rays[number].0;
            if t_max < 0.0 {
                continue;
            }
            let own = TreeRay::new(&tree.frame, tree.bounds, ray, accel.extent);
            let Some(own) = &own else { continue };
            let mut next = t_max;
            let found = |hit| {
                next = see(number, hit);
                next
            };
            let blocks = Blocks::of(mesh, accel, object, ray, found);
            kernel.apart(&mut Alone { tree, part, ray: own, t_max, blocks });
            lanes.shorten(k, next);
            self.bundle.shorten(k, next);
        }
        self.bundle.settle();
    }
}

/// The walk of one ray through a part of a tree.
struct Alone<'a, L> {
    tree: &'a Tree,
    part: Child,
    ray: &'a TreeRay,
    t_max: f64,
    blocks: L,
}

impl<L: Leaves> Task for Alone<'_, L> {
    type Out = f64;

    #[inline(always)]
    fn run<K: Kernel>(&mut self, kernel: K) -> f64 {
        self.tree.walk_from(kernel, self.part, self.ray, self.t_max, &mut self.blocks)
    }
}
