//! The thesis's grids and brute force over all pieces of a scene.
//!
//! The mesh of instances has a list of triangles and a grid of its own, in its own space. A ray tries
//! each instance whose box it crosses.

use super::brute::Brute;
use super::grid::Grids;
use super::leaf::{Leaf, Probe};
use super::own_ray::OwnRay;
use super::{Accel, MOST_APART, OUTSIZED};
use crate::ray::{Hit, Piece, Ray};
use crate::shape::{Mesh, Shape, triangle};
use glam::DVec3;
use std::collections::HashMap;
use std::ops::Range;

/// A box with what it surrounds.
type Boxed = (Leaf, [DVec3; 2]);

/// A structure over pieces, or none.
#[derive(Debug)]
enum Index {
    Grids(Grids),
    All(Brute),
}

/// Pieces and a structure over them.
#[derive(Debug)]
struct Pieces {
    leaves: Vec<Leaf>,
    index: Index,
}

/// The pieces of a scene.
#[derive(Debug)]
pub struct Flat {
    /// Shapes that every ray tries.
    apart: Vec<Leaf>,
    pieces: Pieces,
    /// The meshes of instances, in their own spaces.
    shared: Vec<Pieces>,
    /// Each instance, with the index of its mesh in `shared`.
    instances: Vec<(u32, usize)>,
}

impl Flat {
    /// Builds grids over the pieces of shapes, with the outsized ones apart, or a plain list without
    /// `grids`. `bounds` are those of shapes that are one piece; `apart` are shapes without bounds.
    #[must_use]
    pub fn build(
        shapes: &[&Shape],
        bounds: &[Option<[DVec3; 2]>],
        mut apart: Vec<Leaf>,
        grids: bool,
    ) -> Self {
        let mut bounded: Vec<Boxed> = Vec::new();
        let mut shared = Vec::new();
        let mut instances = Vec::new();
        let mut known = HashMap::new();
        for (object, shape) in shapes.iter().enumerate() {
            let number = object as u32;
            match shape {
                Shape::Mesh(mesh) => bounded.extend(triangles(number, mesh)),
                Shape::Instance(instance) => {
                    let at = *known.entry(instance.key()).or_insert_with(|| {
                        shared.push(Pieces::over(triangles(0, instance.mesh()).collect(), grids));
                        shared.len() - 1
                    });
                    instances.push((number, at));
                }
                _ => bounded.extend(bounds[object].map(|bounds| (Leaf::whole(number), bounds))),
            }
        }
        let whole = bounded.iter().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |all, (_, b)| {
            [all[0].min(b[0]), all[1].max(b[1])]
        });
        let limit = OUTSIZED * (whole[1] - whole[0]).max_element();
        let mut free = MOST_APART.saturating_sub(apart.len());
        bounded.retain(|(leaf, [low, high])| {
            let outsized = free > 0 && (*high - *low).max_element() > limit;
            if outsized {
                apart.push(*leaf);
                free -= 1;
            }
            !outsized
        });
        Self { apart, pieces: Pieces::over(bounded, grids), shared, instances }
    }

    fn all(&self) -> impl Iterator<Item = &Pieces> {
        self.shared.iter().chain([&self.pieces])
    }

    /// Memory in bytes of the structure and of its copies of triangles.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let bytes = |pieces: &Pieces| match &pieces.index {
            Index::Grids(grids) => grids.bytes() + size_of_val(&*pieces.leaves),
            Index::All(_) => size_of_val(&*pieces.leaves),
        };
        self.all().map(bytes).sum()
    }

    /// The grids, if there are any.
    pub fn grids(&self) -> impl Iterator<Item = &Grids> {
        self.all().filter_map(|pieces| match &pieces.index {
            Index::Grids(grids) => Some(grids),
            Index::All(_) => None,
        })
    }

    /// Calls `see` with the hits up to the distance that it last returned, initially `t_max`.
    pub fn walk(
        &self,
        accel: &Accel<'_>,
        ray: &Ray,
        mut t_max: f64,
        see: &mut impl FnMut(Hit) -> f64,
    ) {
        let probe = Probe::new(accel, ray);
        for leaf in &self.apart {
            if let Some(hit) = probe.meet(accel, leaf, t_max) {
                t_max = see(hit);
            }
        }
        t_max = self.pieces.walk(&probe, t_max, &mut |leaf, t_max| {
            let hit = probe.meet(accel, leaf, t_max);
            hit.map_or(t_max, &mut *see)
        });
        for &(object, mesh) in &self.instances {
            let Shape::Instance(instance) = accel.shapes[object as usize] else { continue };
            let own = OwnRay::new(accel, (object, instance), ray, &probe.slabs, t_max);
            let Some(own) = own else { continue };
            let probe = own.probe();
            self.shared[mesh].walk(&probe, own.limit(t_max), &mut |leaf, limit| {
                let hit = probe.meet(accel, &leaf.of_object(object), limit);
                if let Some(hit) = hit.and_then(|hit| own.in_scene(hit, t_max)) {
                    t_max = see(hit);
                }
                own.limit(t_max)
            });
        }
    }
}

/// Returns the triangles of a mesh that rays may meet, each with its box.
fn triangles(object: u32, mesh: &Mesh) -> impl Iterator<Item = Boxed> {
    (0..mesh.triangles.len() as u32)
        .map(move |triangle| (Piece { object, triangle }, mesh.corners(triangle)))
        .filter(|(_, corners)| !triangle::is_segment(corners))
        .map(|(piece, corners)| (Leaf::of_triangle(piece, corners), mesh.bounds(piece.triangle)))
}

impl Pieces {
    /// Builds a grid over the pieces of each object, or a plain list.
    fn over(boxed: Vec<Boxed>, grids: bool) -> Self {
        let (leaves, boxes): (Vec<Leaf>, Vec<[DVec3; 2]>) = boxed.into_iter().unzip();
        let index = if grids {
            let object = |a: &Leaf, b: &Leaf| a.object() == b.object();
            let ranges = leaves.chunk_by(object).scan(0, |end, leaves| {
                let start = std::mem::replace(end, *end + leaves.len() as u32);
                Some(start..*end)
            });
            Index::Grids(Grids::build(&boxes, &ranges.collect::<Vec<Range<u32>>>()))
        } else {
            Index::All(Brute { pieces: leaves.len() as u32 })
        };
        Self { leaves, index }
    }

    /// Visits the pieces that a ray may meet up to the distance that `visit` last returned, and returns
    /// that distance.
    fn walk(
        &self,
        probe: &Probe<'_>,
        t_max: f64,
        visit: &mut impl FnMut(&Leaf, f64) -> f64,
    ) -> f64 {
        let mut last = t_max;
        let visit = |leaf: u32, t_max: f64| {
            last = visit(&self.leaves[leaf as usize], t_max);
            last
        };
        match &self.index {
            Index::Grids(grids) => grids.walk(&probe.slabs, t_max, visit),
            Index::All(brute) => brute.walk(t_max, visit),
        }
        last
    }
}
