//! Finds the hits of rays with surfaces.
//!
//! [`Accel::build`] prepares the shapes of a scene. [`Accel::closest`] returns the visible hit of a ray,
//! and [`Accel::any`] whether a test accepts a hit before a distance. [`Accel::closest_of`] and
//! [`Accel::any_of`] do the same for several rays. No ray allocates memory or takes a lock.
//!
//! A few shapes stand apart, and every ray tries each of them: planes, which have no box, and with
//! grids also shapes so large beside the rest (a floor under a vase) that they would spoil a grid. All
//! others are leaves of a [`Structure`]: trees of boxes, the thesis's grids, or none. One function,
//! `Probe::meet`, decides about hits for all of them, and one rule, [`Hit::before`], selects the
//! visible hit. A mesh that many instances show is prepared once, in its own space, to which rays are
//! transformed (`own_ray.rs`).
//!
//! All structures find the same hits to the last bit. For this, a hit must lie where the ray
//! crosses the box of its piece, widened by the roundings of the hit function (`Probe::meet`). A
//! structure must find every piece whose box the ray crosses before the nearest hit, and needs no
//! other property. Where roundings are small this rule changes nothing. It bounds the distance of
//! triangles that are seen edge on, which otherwise consists of rounding only.
//!
//! A ray that starts on a surface does not hit this surface again at its start, nor any surface
//! that coincides with it there. Surfaces coincide if their distance from the start, measured
//! across the surface, is less than the rounding of both. Measured along the ray, that distance
//! would have no bound, since it grows as the ray becomes flat. No epsilon is given in units of
//! length, so a scene may have any size. The same rule lets an eye on a surface see past that
//! surface.

mod bins;
mod block;
mod brute;
mod build;
mod bundle;
mod collapse;
mod flat;
mod frame;
mod grid;
mod group;
mod kernel;
mod lanes;
mod leaf;
mod mesh_tree;
mod node;
mod own_ray;
mod pages;
mod parts;
mod simd;
mod slabs;
mod top;
mod tree;
mod waiting;

use crate::ray::{Hit, Piece, Ray};
use crate::shape::{Shape, SurfacePoint};
use clap::ValueEnum;
use flat::Flat;
use glam::DVec3;
use group::Group;
use kernel::Kernel;
use lanes::Lanes;
use leaf::{Leaf, Probe};
pub use mesh_tree::MeshTree;
use schemars::JsonSchema;
use serde::Deserialize;
use simd::{Instructions, Task};
use std::collections::BTreeMap;
use top::Trees;

/// A shape is outsized when its box is longer than this fraction of the box around everything.
///
/// If smaller, the parts of ordinary objects stand apart and cost a test on every ray. If larger, a
/// floor twice as wide as its scene is in a grid, where it does little harm.
const OUTSIZED: f64 = 0.5;

/// Outsized shapes stand apart only while fewer than this many shapes do, since every ray tries each
/// of them. Planes always stand apart.
const MOST_APART: usize = 8;

/// Bound on the distance of a computed point from its surface, in units in the last place of the
/// largest coordinate.
///
/// The longest chain (a point on a parallelogram, whose normal is rounded as well) takes about 20
/// roundings. If larger, rays pass over cracks narrower than the bound, which become visible only
/// at thousands. If smaller, coincident surfaces begin to shade each other in speckles.
const ROUNDINGS: f64 = 64.0;

/// The bound for an eye, whose position is given and not computed. If larger, an eye one unit above
/// a floor of 1e15 units does not see the floor.
const EYE_ROUNDINGS: f64 = 4.0;

/// A structure that finds the pieces which a ray may meet. All structures give the same picture,
/// byte for byte. The name of a structure on the command line and in JSON is that of the variant;
/// the attribute `help` is the text of `--help`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, ValueEnum, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(
    description = "A structure that finds the pieces which a ray may meet. All structures give the same picture."
)]
pub enum Structure {
    /// Trees of boxes, bounding volume hierarchies: one over the objects, and one for each mesh.
    #[default]
    #[value(help = "A tree of boxes, the fastest")]
    Bvh,
    /// The thesis's uniform grid for each object (5.2).
    #[value(help = "A uniform grid for each object, as in the thesis")]
    Grid,
    /// No structure: every ray tries every piece.
    #[value(help = "No structure: every ray is tested against every triangle")]
    None,
}

impl Structure {
    /// Every structure, in the order of their discriminants.
    pub const ALL: [Self; 3] = [Self::Bvh, Self::Grid, Self::None];
}

/// The shapes of a scene, prepared for rays.
#[derive(Debug)]
pub struct Accel<'a> {
    shapes: Vec<&'a Shape>,
    index: Index,
    /// Boxes of shapes that are one piece; `None` for meshes and planes.
    bounds: Vec<Option<[DVec3; 2]>>,
    /// The largest absolute coordinate from which each shape's points are computed.
    extents: Vec<f64>,
    /// The largest of the extents.
    extent: f64,
    instructions: Instructions,
}

/// A structure over all shapes.
#[derive(Debug)]
enum Index {
    /// Trees, and the shapes without a box.
    Trees(Trees, Vec<Leaf>),
    Flat(Flat),
}

impl<'a> Accel<'a> {
    /// Prepares the shapes; the index of a shape becomes [`Piece::object`].
    #[must_use]
    pub fn build(shapes: Vec<&'a Shape>, structure: Structure) -> Self {
        Self::with_trees(shapes, structure, &mut |_| None)
    }

    /// Prepares the shapes as [`Accel::build`] does. `stock` returns the trees of a shape that is a mesh, by its index, if
    /// they were built for an equal mesh before.
    #[must_use]
    pub fn with_trees(
        shapes: Vec<&'a Shape>,
        structure: Structure,
        stock: &mut dyn FnMut(usize) -> Option<Vec<MeshTree>>,
    ) -> Self {
        let bounds = |shape: &&Shape| match shape {
            Shape::Mesh(_) => None,
            shape => shape.bounds(),
        };
        let bounds: Vec<_> = shapes.iter().map(bounds).collect();
        let extents: Vec<f64> = shapes.iter().map(|shape| shape.extent()).collect();
        let extent = extents.iter().copied().fold(0.0, f64::max);
        let apart = unbounded(&shapes, &bounds);
        let index = match structure {
            Structure::Bvh => Index::Trees(Trees::build(&shapes, &bounds, stock), apart),
            Structure::Grid => Index::Flat(Flat::build(&shapes, &bounds, apart, true)),
            Structure::None => Index::Flat(Flat::build(&shapes, &bounds, apart, false)),
        };
        Self { shapes, index, bounds, extents, extent, instructions: Instructions::detect() }
    }

    /// Returns the trees of the shapes that are meshes, by the index of the shape. Other structures have none.
    #[must_use]
    pub fn into_trees(self) -> BTreeMap<usize, Vec<MeshTree>> {
        match self.index {
            Index::Trees(trees, _) => trees.into_meshes(),
            Index::Flat(_) => BTreeMap::new(),
        }
    }

    /// Memory in bytes of the structure and of its copies of triangles.
    #[must_use]
    pub fn bytes(&self) -> usize {
        match &self.index {
            Index::Trees(trees, _) => trees.bytes(),
            Index::Flat(flat) => flat.bytes(),
        }
    }

    /// Returns the number of voxels of all grids, the number of those that list a piece, and the number
    /// of entries of all lists; `None` for other structures.
    #[must_use]
    pub fn cells(&self) -> Option<[u64; 3]> {
        let Index::Flat(flat) = &self.index else { return None };
        let cells = flat.grids().map(grid::Grids::cells);
        cells.reduce(|a, b| [a[0] + b[0], a[1] + b[1], a[2] + b[2]])
    }

    /// Number of boxes examined to build the structure; a box counts each time it is examined.
    #[must_use]
    pub fn looks(&self) -> u64 {
        match &self.index {
            Index::Trees(trees, _) => trees.looks(),
            Index::Flat(flat) => flat.grids().map(grid::Grids::looks).sum(),
        }
    }

    /// Returns the visible hit among those with `t` up to `t_max`: the nearest, and among equally
    /// near hits the first by [`Piece`].
    #[must_use]
    pub fn closest(&self, ray: &Ray, t_max: f64) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        self.walk(ray, t_max, |hit| {
            if best.is_none_or(|best| hit.before(&best)) {
                best = Some(hit);
            }
            best.map_or(t_max, |best| best.t)
        });
        best
    }

    /// Returns whether `test` accepts a hit nearer than `t_max`. Calls `test` with the hits in no
    /// particular order until it accepts one. A test that accepts none sees all of them.
    pub fn any(&self, ray: &Ray, t_max: f64, mut test: impl FnMut(Hit) -> bool) -> bool {
        let mut found = false;
        self.walk(ray, t_max, |hit| {
            found = hit.t < t_max && test(hit);
            if found { -1.0 } else { t_max }
        });
        found
    }

    /// Finds the closest hits of several rays, each given with its `t_max`. The results are those of
    /// [`Accel::closest`] for each ray. `hits` has one element for each ray.
    pub fn closest_of(&self, rays: &[(Ray, f64)], hits: &mut [Option<Hit>]) {
        for (rays, hits) in rays.chunks(lanes::MOST).zip(hits.chunks_mut(lanes::MOST)) {
            hits.fill(None);
            self.walk_group(rays, |k, hit| {
                let best = &mut hits[k];
                if best.is_none_or(|best| hit.before(&best)) {
                    *best = Some(hit);
                }
                best.map_or(rays[k].1, |best| best.t)
            });
        }
    }

    /// Finds for several rays, each given with its `t_max`, whether `test` accepts a hit. The
    /// results are those of [`Accel::any`] for each ray. `test` also gets the index of the ray; the
    /// hits of different rays may alternate. `found` has one element for each ray.
    pub fn any_of(
        &self,
        rays: &[(Ray, f64)],
        mut test: impl FnMut(usize, Hit) -> bool,
        found: &mut [bool],
    ) {
        found.fill(false);
        for (part, rays) in rays.chunks(lanes::MOST).enumerate() {
            let first = part * lanes::MOST;
            self.walk_group(rays, |k, hit| {
                let (number, t_max) = (first + k, rays[k].1);
                found[number] = hit.t < t_max && test(number, hit);
                if found[number] { -1.0 } else { t_max }
            });
        }
    }

    /// Returns the surface point of a hit of `ray`.
    #[must_use]
    pub fn surface_point(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        let shape = self.shapes[hit.piece.object as usize];
        shape.surface_point(hit.piece.triangle, hit.barycentric, ray.at(hit.t))
    }

    /// Returns the unit normal of the surface at a hit of `ray`: that of [`Accel::surface_point`],
    /// without computing the other values.
    #[must_use]
    pub fn geometric_normal(&self, ray: &Ray, hit: &Hit) -> DVec3 {
        let shape = self.shapes[hit.piece.object as usize];
        shape.geometric_normal(hit.piece.triangle, ray.at(hit.t))
    }

    /// Returns a bound on the distance of a computed point of this object from its surface, in
    /// scene units.
    #[must_use]
    #[inline]
    pub fn rounding(&self, object: u32, point: DVec3) -> f64 {
        let largest = self.extents[object as usize] + point.abs().max_element();
        ROUNDINGS * f64::EPSILON * largest
    }

    /// Returns the number of the surface within its object on which a hit lies.
    #[must_use]
    pub fn part(&self, hit: &Hit) -> u32 {
        self.shapes[hit.piece.object as usize].part(hit.piece.triangle)
    }

    /// Returns the offset of a mesh; zero for another shape.
    fn offset(&self, object: u32) -> DVec3 {
        self.shapes[object as usize].mesh().map_or(DVec3::ZERO, |mesh| mesh.offset)
    }

    /// Returns the corners of a triangle, from the offset of its mesh.
    fn mesh_corners(&self, piece: Piece) -> [[f32; 3]; 3] {
        let mesh = self.shapes[piece.object as usize].mesh();
        mesh.map_or([[0.0; 3]; 3], |mesh| mesh.corners(piece.triangle))
    }

    /// Calls `see` with hits up to the distance that it last returned, initially `t_max`.
    #[inline]
    fn walk(&self, ray: &Ray, t_max: f64, see: impl FnMut(Hit) -> f64) {
        self.instructions.run(&mut Walk { accel: self, ray, t_max, see });
    }
}

impl Accel<'_> {
    /// Calls `see` with the numbers of rays and their hits, up to the distance that it last returned for
    /// the ray. There are at most [`lanes::MOST`] rays.
    #[inline]
    fn walk_group(&self, rays: &[(Ray, f64)], mut see: impl FnMut(usize, Hit) -> f64) {
        if rays.len() < group::LEAST || matches!(self.index, Index::Flat(_)) {
            for (k, (ray, t_max)) in rays.iter().enumerate() {
                self.walk(ray, *t_max, |hit| see(k, hit));
            }
        } else {
            self.instructions.run(&mut WalkGroup { accel: self, rays, see });
        }
    }
}

/// The walk of a group of rays.
struct WalkGroup<'a, 'b, F> {
    accel: &'a Accel<'b>,
    rays: &'a [(Ray, f64)],
    see: F,
}

impl<F: FnMut(usize, Hit) -> f64> Task for WalkGroup<'_, '_, F> {
    type Out = ();

    #[inline(always)]
    fn run<K: Kernel>(&mut self, kernel: K) {
        let Self { accel, rays, see } = self;
        let Index::Trees(trees, apart) = &accel.index else { return };
        let mut left = u64::MAX >> (lanes::MOST - rays.len().clamp(1, lanes::MOST));
        let mut group = Group { accel, rays, lanes: Lanes::none(), see };
        while left != 0 {
            group.lanes.take(rays, &mut left, accel.extent);
            for leaf in apart {
                group.each(|ray, t_max, see| {
                    if let Some(hit) = Probe::new(accel, ray).meet(accel, leaf, t_max) {
                        see(hit);
                    }
                });
            }
            trees.walk_group(kernel, &mut group);
        }
    }
}

/// The walk of one ray.
struct Walk<'a, 'b, F> {
    accel: &'a Accel<'b>,
    ray: &'a Ray,
    t_max: f64,
    see: F,
}

impl<F: FnMut(Hit) -> f64> Task for Walk<'_, '_, F> {
    type Out = ();

    #[inline(always)]
    fn run<K: Kernel>(&mut self, kernel: K) {
        let Self { accel, ray, t_max, see } = self;
        let mut t_max = *t_max;
        match &accel.index {
            Index::Trees(trees, apart) => {
                for leaf in apart {
                    if let Some(hit) = Probe::new(accel, ray).meet(accel, leaf, t_max) {
                        t_max = see(hit);
                    }
                }
                trees.walk(kernel, ray, accel, t_max, see);
            }
            Index::Flat(flat) => flat.walk(accel, ray, t_max, see),
        }
    }
}

/// Returns the shapes without a box.
fn unbounded(shapes: &[&Shape], bounds: &[Option<[DVec3; 2]>]) -> Vec<Leaf> {
    let objects = shapes.iter().zip(bounds).enumerate();
    objects
        .filter(|(_, (shape, bounds))| !matches!(shape, Shape::Mesh(_)) && bounds.is_none())
        .map(|(object, _)| Leaf::whole(object as u32))
        .collect()
}

#[cfg(test)]
mod tests;
