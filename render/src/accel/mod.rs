//! Finds what a ray hits.
//!
//! A few shapes stand apart and are tried one by one: planes, which have no box, and shapes so
//! large beside the rest (a floor under a vase) that they would spoil any structure. All others are
//! leaves of a [`Structure`]: one tree of boxes, or the thesis's grids, or none. One function,
//! `Accel::try_piece`, decides for all, and one rule, [`Hit::before`], says which hit is seen.
//!
//! So that all structures see the same to the last bit, a hit lies where the ray crosses the box of
//! its piece, widened by the roundings of the hit function (`Accel::meet`). A structure then has to
//! give every piece whose box the ray crosses before the nearest hit, and needs to know no more.
//! Where the arithmetic is sound this changes nothing; it holds triangles that are seen edge on,
//! whose distance is all rounding, to a place where they are.
//!
//! A ray that leaves a surface does not hit it again at its start, nor any surface that coincides
//! with it there: those whose distance from the start, measured across the surface, is less than
//! the rounding of both. Measured along the ray that distance would have no bound, since it grows
//! as the ray becomes flat. There is no epsilon in units of length, so a scene may be of any size.
//! An eye on a surface sees past it by the same rule.

mod brute;
mod build;
mod bvh;
mod grid;
mod slabs;

use crate::ray::{Hit, Piece, Ray};
use crate::shape::triangle::{self, ShearedRay};
use crate::shape::{Shape, Start, SurfacePoint};
use brute::Brute;
use bvh::Bvh;
use clap::ValueEnum;
use glam::DVec3;
use grid::Grids;
use serde::Deserialize;
use slabs::SlabRay;

/// A shape is outsized when its box is longer than this part of the box around everything.
///
/// Smaller, and the parts of ordinary objects stand apart and cost a test on every ray; larger,
/// and a floor twice as wide as its scene is already in the tree, where it does little harm.
const OUTSIZED: f64 = 0.5;

/// At most so many shapes stand apart, since every ray tries each of them.
const MOST_APART: usize = 8;

/// A computed point lies at most this many units in the last place of the largest coordinate off
/// the surface it was computed for.
///
/// The longest chain (a point on a parallelogram, whose normal is rounded as well) takes about 20
/// roundings. Larger, and cracks narrower than that are passed over, which nothing can see before
/// thousands; smaller, and coincident surfaces begin to shade each other in speckles.
const ROUNDINGS: f64 = 64.0;

/// So many for an eye, whose place is given and not computed. Larger, and a floor of 1e15 units is
/// not seen from a unit above it.
const EYE_ROUNDINGS: f64 = 4.0;

/// What finds the pieces that a ray may meet. All give the same picture, byte for byte. The name of
/// a structure on the command line and in JSON is that of the variant; the attribute `help` is the
/// text of `--help`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Structure {
    /// One tree of boxes, a bounding volume hierarchy.
    #[default]
    #[value(help = "A tree of boxes, the fastest")]
    Bvh,
    /// The thesis's uniform grid for each object (5.2).
    #[value(help = "A uniform grid for each object, as in the thesis")]
    Grid,
    /// None: every ray tries every piece.
    #[value(help = "Nothing: every ray tries every triangle")]
    None,
}

impl Structure {
    /// Every structure, in the order of their discriminants.
    pub const ALL: [Self; 3] = [Self::Bvh, Self::Grid, Self::None];
}

/// The shapes of a scene, ready for rays.
#[derive(Debug)]
pub struct Accel<'a> {
    shapes: Vec<&'a Shape>,
    apart: Vec<Piece>,
    index: Index,
    leaves: Vec<Leaf>,
    /// The boxes of shapes that are one piece; none for meshes and for planes.
    bounds: Vec<Option<[DVec3; 2]>>,
    /// The largest coordinate that each shape's points are computed from, without its sign.
    extents: Vec<f64>,
    /// The largest of them.
    extent: f64,
}

/// A structure over the leaves.
#[derive(Debug)]
enum Index {
    Tree(Option<Bvh>),
    Grids(Grids),
    All(Brute),
}

/// Which piece, and for a triangle its corners, kept near each other.
#[derive(Debug, Clone, Copy)]
struct Leaf {
    piece: Piece,
    corners: [[f32; 3]; 3],
}

impl<'a> Accel<'a> {
    /// Gets the shapes ready; the index of a shape becomes [`Piece::object`].
    #[must_use]
    pub fn build(shapes: Vec<&'a Shape>, structure: Structure) -> Self {
        let mut apart = Vec::new();
        let mut bounded: Vec<(Leaf, [DVec3; 2])> = Vec::new();
        let mut bounds = vec![None; shapes.len()];
        for (object, shape) in shapes.iter().enumerate() {
            let piece = Piece { object: object as u32, triangle: 0 };
            let leaf = Leaf { piece, corners: [[0.0; 3]; 3] };
            bounds[object] = match shape {
                Shape::Mesh(_) => None,
                _ => shape.bounds(),
            };
            match shape {
                Shape::Mesh(mesh) => {
                    let triangles = (0..mesh.triangles.len() as u32)
                        .map(|n| (Piece { triangle: n, ..piece }, mesh.corners(n)))
                        .filter(|(_, corners)| !triangle::is_segment(corners))
                        .map(|(piece, corners)| {
                            (Leaf { piece, corners }, triangle::bounds(&corners))
                        });
                    bounded.extend(triangles);
                }
                _ => match bounds[object] {
                    Some(bounds) => bounded.push((leaf, bounds)),
                    None => apart.push(piece),
                },
            }
        }
        let whole = bounded.iter().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |all, (_, b)| {
            [all[0].min(b[0]), all[1].max(b[1])]
        });
        let limit = OUTSIZED * (whole[1] - whole[0]).max_element();
        let mut room = MOST_APART.saturating_sub(apart.len());
        bounded.retain(|(leaf, [low, high])| {
            let outsized = room > 0 && (*high - *low).max_element() > limit;
            if outsized {
                apart.push(leaf.piece);
                room -= 1;
            }
            !outsized
        });
        let (mut leaves, boxes): (Vec<Leaf>, Vec<[DVec3; 2]>) = bounded.into_iter().unzip();
        let index = match structure {
            Structure::Bvh => Index::Tree(Bvh::build(&boxes).map(|(tree, order)| {
                leaves = order.into_iter().map(|leaf| leaves[leaf as usize]).collect();
                tree
            })),
            Structure::Grid => {
                let object = |a: &Leaf, b: &Leaf| a.piece.object == b.piece.object;
                let ranges = leaves.chunk_by(object).scan(0, |end, leaves| {
                    let start = std::mem::replace(end, *end + leaves.len() as u32);
                    Some(start..*end)
                });
                Index::Grids(Grids::build(&boxes, &ranges.collect::<Vec<_>>()))
            }
            Structure::None => Index::All(Brute { pieces: leaves.len() as u32 }),
        };
        let extents: Vec<f64> = shapes.iter().map(|shape| shape.extent()).collect();
        let extent = extents.iter().copied().fold(0.0, f64::max);
        Self { shapes, apart, index, leaves, bounds, extents, extent }
    }

    /// Memory in bytes: the structure, and the copies of triangles that it leads to.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let index = match &self.index {
            Index::Tree(tree) => tree.as_ref().map_or(0, Bvh::bytes),
            Index::Grids(grids) => grids.bytes(),
            Index::All(_) => 0,
        };
        index + size_of_val(&*self.leaves)
    }

    /// How many boxes were looked at to build the structure, each time counted.
    #[must_use]
    pub fn looks(&self) -> u64 {
        match &self.index {
            Index::Tree(tree) => tree.as_ref().map_or(0, Bvh::looks),
            Index::Grids(grids) => grids.looks(),
            Index::All(_) => 0,
        }
    }

    /// The hit that is seen: the nearest, and of equally near ones the first by [`Piece`].
    #[must_use]
    pub fn nearest(&self, ray: &Ray) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        self.walk(ray, f64::INFINITY, |hit| {
            if best.is_none_or(|best| hit.before(&best)) {
                best = Some(hit);
            }
            best.map_or(f64::INFINITY, |best| best.t)
        });
        best
    }

    /// Gives `see` every hit nearer than `t_max`, in no particular order, until it returns false.
    pub fn all_before(&self, ray: &Ray, t_max: f64, mut see: impl FnMut(Hit) -> bool) {
        self.walk(ray, t_max, |hit| if hit.t >= t_max || see(hit) { t_max } else { -1.0 });
    }

    /// The surface point of a hit of `ray`.
    #[must_use]
    pub fn surface_point(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        let shape = self.shapes[hit.piece.object as usize];
        shape.surface_point(hit.piece.triangle, hit.barycentric, ray.at(hit.t))
    }

    /// How far a point that was computed for a surface of this object may lie off it.
    #[must_use]
    pub fn rounding(&self, object: u32, point: DVec3) -> f64 {
        let largest = self.extents[object as usize] + point.abs().max_element();
        ROUNDINGS * f64::EPSILON * largest
    }

    /// Which of its object's surfaces a hit is on.
    #[must_use]
    pub fn part(&self, hit: &Hit) -> u32 {
        self.shapes[hit.piece.object as usize].part(hit.piece.triangle)
    }

    /// Shows `see` hits up to the distance it last returned, which starts as `t_max`.
    fn walk(&self, ray: &Ray, t_max: f64, mut see: impl FnMut(Hit) -> f64) {
        let sheared = ShearedRay::new(ray.origin, ray.direction);
        let slabs = SlabRay::new(ray.origin, ray.direction, self.extent);
        let mut t_max = t_max;
        for &piece in &self.apart {
            let corners = match self.shapes[piece.object as usize] {
                Shape::Mesh(mesh) => mesh.corners(piece.triangle),
                _ => [[0.0; 3]; 3],
            };
            if let Some(hit) = self.meet(ray, &sheared, &slabs, &Leaf { piece, corners }, t_max) {
                t_max = see(hit);
            }
        }
        let visit = |leaf: u32, t_max: f64| {
            let hit = self.meet(ray, &sheared, &slabs, &self.leaves[leaf as usize], t_max);
            hit.map_or(t_max, &mut see)
        };
        match &self.index {
            Index::Tree(Some(tree)) => tree.walk(&slabs, t_max, visit),
            Index::Tree(None) => {}
            Index::Grids(grids) => grids.walk(&slabs, t_max, visit),
            Index::All(brute) => brute.walk(t_max, visit),
        }
    }

    /// The hit of `ray` with one piece where the ray crosses the piece's widened box, with `t` in
    /// `(0, t_max]`. Whether there is one, and where, does not depend on `t_max`.
    fn meet(
        &self,
        ray: &Ray,
        sheared: &ShearedRay,
        slabs: &SlabRay,
        leaf: &Leaf,
        t_max: f64,
    ) -> Option<Hit> {
        let hit = self.try_piece(ray, sheared, leaf)?;
        let object = hit.piece.object as usize;
        let bounds = match self.shapes[object] {
            Shape::Mesh(_) => Some(triangle::bounds(&leaf.corners)),
            _ => self.bounds[object],
        };
        let t = match bounds {
            Some(bounds) => {
                let [enter, leave] = slabs.crosses(bounds)?;
                hit.t.clamp(enter, leave)
            }
            None => hit.t,
        };
        (t > 0.0 && t <= t_max).then_some(Hit { t, ..hit })
    }

    /// The one hit function: the hit of `ray` with one piece, with `t` above 0.
    fn try_piece(&self, ray: &Ray, sheared: &ShearedRay, leaf: &Leaf) -> Option<Hit> {
        let piece = leaf.piece;
        // What lies this near to the start is the surface that the ray leaves, or coincides with it;
        // or the eye is on it, and sees past it.
        let skin = || match ray.leaving {
            Some(from) => {
                self.rounding(from.object, ray.origin) + self.rounding(piece.object, DVec3::ZERO)
            }
            // What is meant to be on a surface is off it by the rounding of its own digits.
            None => EYE_ROUNDINGS / ROUNDINGS * self.rounding(piece.object, ray.origin),
        };
        let hit = match self.shapes[piece.object as usize] {
            Shape::Mesh(_) if ray.leaving == Some(piece) => return None,
            Shape::Mesh(_) => {
                let (t, barycentric) = sheared.intersect(&leaf.corners, f64::INFINITY)?;
                if sheared.starts_on(&leaf.corners, skin()) {
                    return None;
                }
                Hit { t, piece, barycentric }
            }
            shape => {
                let left = ray.leaving.filter(|from| from.object == piece.object);
                let start = Start { left_face: left.map(|from| from.triangle), skin: skin() };
                let (t, face) = shape.intersect(ray.origin, ray.direction, start)?;
                Hit { t, piece: Piece { triangle: face, ..piece }, barycentric: [0.0; 2] }
            }
        };
        Some(hit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn an_empty_scene_has_no_hits() {
        let ray = Ray::from_eye(DVec3::ZERO, DVec3::X);
        for structure in [Structure::Bvh, Structure::Grid, Structure::None] {
            assert!(Accel::build(vec![], structure).nearest(&ray).is_none());
        }
    }

    fn place() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-4i8..=4).prop_map(|p| DVec3::from(p.map(|k| f64::from(k) * 0.25)))
    }

    proptest! {
        /// What the structures promise, without any hit function: the boxes that a ray crosses
        /// before `t_max`, and no box twice.
        #[test]
        fn every_box_that_a_ray_crosses_is_given_once(
            boxes in prop::collection::vec((place(), place()), 1..200),
            origin in place(), toward in place(), near in any::<bool>(),
            nudge in prop::sample::select(vec![0.0, 1e-16, -1e-16, 1e-9]),
        ) {
            let boxes: Vec<_> = boxes.into_iter().map(|(a, b)| {
                // Small ones, many of them flat.
                let b = a + 0.25 * (b - a);
                [a.min(b), a.max(b)]
            }).collect();
            let t_max = if near { 0.75 } else { f64::INFINITY };
            let direction = (toward - origin + nudge).normalize_or(DVec3::NEG_X);
            let ray = SlabRay::new(origin, direction, 2.0);
            let crossed = |piece: &[DVec3; 2]| ray.crosses(*piece).is_some_and(|at| at[0] <= t_max);
            let half = boxes.len() as u32 / 2;
            let ranges = [0..half, half..boxes.len() as u32];
            let [mut by_tree, mut by_grids] = [vec![0; boxes.len()], vec![0; boxes.len()]];
            let (tree, order) = Bvh::build(&boxes).unwrap();
            tree.walk(&ray, t_max, |place, t_max| {
                by_tree[order[place as usize] as usize] += 1;
                t_max
            });
            let objects: Vec<_> = ranges.into_iter().filter(|range| !range.is_empty()).collect();
            Grids::build(&boxes, &objects).walk(&ray, t_max, |piece, t_max| {
                by_grids[piece as usize] += 1;
                t_max
            });
            for (k, piece) in boxes.iter().enumerate() {
                for given in [&by_tree, &by_grids] {
                    prop_assert!(given[k] <= 1, "box {} was given {} times", k, given[k]);
                    prop_assert!(given[k] == 1 || !crossed(piece), "box {} was missed", k);
                }
            }
        }
    }
}
