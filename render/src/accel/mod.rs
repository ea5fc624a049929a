//! Finds what a ray hits.
//!
//! A few shapes stand apart and are tried one by one: planes, which have no box, and shapes so
//! large beside the rest (a floor under a vase) that they would spoil a tree. All others are
//! leaves of one tree of boxes. One function, `Accel::try_piece`, decides for both.
//!
//! A ray that leaves a surface does not hit it again at its start, nor any surface that coincides
//! with it there: those whose distance from the start, measured across the surface, is less than
//! the rounding of both. Measured along the ray that distance would have no bound, since it grows
//! as the ray becomes flat. There is no epsilon in units of length, so a scene may be of any size.
//! An eye on a surface sees past it by the same rule.

mod bvh;

use crate::ray::{Hit, Piece, Ray};
use crate::shape::triangle::ShearedRay;
use crate::shape::{Shape, Start, SurfacePoint};
use bvh::Bvh;
use glam::DVec3;

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

/// The shapes of a scene, ready for rays.
#[derive(Debug)]
pub struct Accel<'a> {
    shapes: Vec<&'a Shape>,
    apart: Vec<Piece>,
    tree: Option<Bvh>,
    leaves: Vec<Leaf>,
    /// The largest coordinate that each shape's points are computed from, without its sign.
    extents: Vec<f64>,
}

/// A leaf of the tree: which piece, and for a triangle its corners, kept near each other.
#[derive(Debug, Clone, Copy)]
struct Leaf {
    piece: Piece,
    corners: [[f32; 3]; 3],
}

impl<'a> Accel<'a> {
    /// Gets the shapes ready; the index of a shape becomes [`Piece::object`].
    #[must_use]
    pub fn build(shapes: Vec<&'a Shape>) -> Self {
        let mut apart = Vec::new();
        let mut bounded: Vec<(Leaf, [DVec3; 2])> = Vec::new();
        for (object, shape) in shapes.iter().enumerate() {
            let piece = Piece { object: object as u32, triangle: 0 };
            let leaf = Leaf { piece, corners: [[0.0; 3]; 3] };
            match shape {
                Shape::Mesh(mesh) => bounded.extend((0..mesh.triangles.len() as u32).map(|n| {
                    let piece = Piece { triangle: n, ..piece };
                    (Leaf { piece, corners: mesh.corners(n) }, mesh.bounds(n))
                })),
                _ => match shape.bounds() {
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
        let (leaves, boxes): (Vec<Leaf>, Vec<[DVec3; 2]>) = bounded.into_iter().unzip();
        let extents = shapes.iter().map(|shape| shape.extent()).collect();
        Self { shapes, apart, tree: Bvh::build(&boxes), leaves, extents }
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
        let mut t_max = t_max;
        for &piece in &self.apart {
            let corners = match self.shapes[piece.object as usize] {
                Shape::Mesh(mesh) => mesh.corners(piece.triangle),
                _ => [[0.0; 3]; 3],
            };
            if let Some(hit) = self.try_piece(ray, &sheared, &Leaf { piece, corners }, t_max) {
                t_max = see(hit);
            }
        }
        if let Some(tree) = &self.tree {
            tree.walk(ray.origin, ray.direction, t_max, |leaf, t_max| {
                let hit = self.try_piece(ray, &sheared, &self.leaves[leaf as usize], t_max);
                hit.map_or(t_max, &mut see)
            });
        }
    }

    /// The one hit function: the hit of `ray` with one piece, with `t` in `(0, t_max]`.
    fn try_piece(&self, ray: &Ray, sheared: &ShearedRay, leaf: &Leaf, t_max: f64) -> Option<Hit> {
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
                let (t, barycentric) = sheared.intersect(&leaf.corners, t_max)?;
                if sheared.starts_on(&leaf.corners, skin()) {
                    return None;
                }
                Hit { t, piece, barycentric }
            }
            shape => {
                let left = ray.leaving.filter(|from| from.object == piece.object);
                let start = Start { leaves: left.map(|from| from.triangle), skin: skin() };
                let (t, face) = shape.intersect(ray.origin, ray.direction, start)?;
                Hit { t, piece: Piece { triangle: face, ..piece }, barycentric: [0.0; 2] }
            }
        };
        (hit.t <= t_max).then_some(hit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::mesh::{Mesh, NONE, Triangle};
    use crate::shape::{Quad, Sphere};
    use glam::DVec2;
    use proptest::prelude::*;

    /// A scene of everything: a triangle soup, spheres, a floor that stands apart.
    fn soup(corners: &[[[f32; 3]; 3]]) -> Vec<Shape> {
        let mut mesh = Mesh { surfaces: vec![String::new()], ..Mesh::default() };
        for corner in corners {
            let first = mesh.positions.len() as u32;
            mesh.positions.extend(corner);
            mesh.triangles.push(Triangle {
                position: [first, first + 1, first + 2],
                uv: [NONE; 3],
                normal: [NONE; 3],
                surface: 0,
            });
        }
        let floor = Quad::new(
            DVec3::new(-1e3, -1.0, -1e3),
            DVec3::new(0.0, 0.0, 2e3),
            DVec3::new(2e3, 0.0, 0.0),
            DVec2::ONE,
            true,
        );
        let sphere = |x: f64| Shape::Sphere(Sphere { center: DVec3::splat(x), radius: 0.3 });
        vec![Shape::Mesh(mesh), Shape::Quad(floor.unwrap()), sphere(0.2), sphere(-0.4)]
    }

    /// The nearest hit by trying every piece.
    fn brute_force(accel: &Accel<'_>, ray: &Ray) -> Option<Hit> {
        let sheared = ShearedRay::new(ray.origin, ray.direction);
        let mut best: Option<Hit> = None;
        for (object, shape) in accel.shapes.iter().enumerate() {
            let count = if let Shape::Mesh(mesh) = shape { mesh.triangles.len() } else { 1 };
            for triangle in 0..count as u32 {
                let piece = Piece { object: object as u32, triangle };
                let corners = match shape {
                    Shape::Mesh(mesh) => mesh.corners(triangle),
                    _ => [[0.0; 3]; 3],
                };
                let leaf = Leaf { piece, corners };
                if let Some(hit) = accel.try_piece(ray, &sheared, &leaf, f64::INFINITY)
                    && best.is_none_or(|best| hit.before(&best))
                {
                    best = Some(hit);
                }
            }
        }
        best
    }

    /// Coordinates from a coarse lattice meet each other often: shared corners, flat triangles.
    fn corner() -> impl Strategy<Value = [f32; 3]> {
        prop::array::uniform3((-4i8..=4).prop_map(|k| f32::from(k) * 0.25))
    }

    proptest! {
        #[test]
        fn the_tree_sees_what_brute_force_sees(
            corners in prop::collection::vec(prop::array::uniform3(corner()), 1..60),
            eye in corner(), toward in corner(),
        ) {
            let eye = DVec3::new(f64::from(eye[0]), f64::from(eye[1]), 3.0 + f64::from(eye[2]));
            let toward = DVec3::new(f64::from(toward[0]), f64::from(toward[1]), f64::from(toward[2]));
            let shapes = soup(&corners);
            let accel = Accel::build(shapes.iter().collect());
            prop_assert!(!accel.apart.is_empty(), "the floor stands apart");
            let ray = Ray::from_eye(eye, (toward - eye).normalize());
            let (found, truth) = (accel.nearest(&ray), brute_force(&accel, &ray));
            prop_assert_eq!(found.map(|h| (h.t, h.piece)), truth.map(|h| (h.t, h.piece)));
        }
    }

    #[test]
    fn a_thousand_coincident_triangles_are_one_hit_the_first() {
        let corners = [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]; 1000];
        let shapes = soup(&corners);
        let accel = Accel::build(shapes.iter().take(1).collect());
        let ray = Ray::from_eye(DVec3::new(0.2, 0.2, 1.0), DVec3::NEG_Z);
        let hit = accel.nearest(&ray).unwrap();
        assert_eq!(hit.piece, Piece { object: 0, triangle: 0 });
        let mut count = 0;
        accel.all_before(&ray, 2.0, |_| {
            count += 1;
            true
        });
        assert_eq!(count, 1000);
    }

    #[test]
    fn an_empty_scene_has_no_hits() {
        let ray = Ray::from_eye(DVec3::ZERO, DVec3::X);
        assert!(Accel::build(vec![]).nearest(&ray).is_none());
    }
}
