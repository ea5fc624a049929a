//! Triangles of meshes and faces of boxes that overlap in one plane.
//!
//! A tree finds pieces whose boxes touch. Two of them overlap if the corners of each lie in the plane of
//! the other, within rounding, and no side separates them. Neighbours in a mesh share a side, which
//! separates them. Flat objects among themselves and against meshes are those of
//! [`coincident`](super::coincident).

use super::boxes::{Bounds, Boxes, touch};
use super::subject::{Item, Subject};
use super::{Finding, Severity, count};
use crate::shape::Shape;
use glam::{DAffine3, DVec3};
use std::collections::BTreeMap;
use std::ops::ControlFlow;

/// Largest number of pairs of surfaces that the report names.
const MOST_NAMED: usize = 10;

/// Largest number of neighbours that are tried for each piece, on the average. A larger number makes a
/// mesh of long thin triangles slow. A smaller number lowers the counts of such a mesh.
const MOST_TRIED: u64 = 128;

/// Largest number of pieces up to which copies of meshes are compared. A larger number makes the check of a scene with
/// thousands of copies slow.
const MOST_OF_COPIES: usize = 1 << 22;

/// Part of the largest coordinate within which corners lie in a plane: some roundings of `f32` for meshes,
/// and of `f64` for boxes, which may be placed.
const NEAR_MESH: f64 = 8.0 * f32::EPSILON as f64;
const NEAR_BOX: f64 = 64.0 * f64::EPSILON;

/// Part of a polygon's width by which two polygons must overlap.
const OVERLAP: f64 = 1e-5;

/// A flat piece of a surface.
struct Piece {
    /// Indices of the item and of its part.
    surface: (usize, u32),
    /// Corners in order; a triangle repeats its last corner.
    corners: [DVec3; 4],
    normal: DVec3,
    /// Distance from the plane within which a point counts as in it, in scene units.
    near: f64,
}

impl Piece {
    /// Returns the piece, or `None` if it has no area.
    fn new(surface: (usize, u32), corners: [DVec3; 4], near: f64) -> Option<Self> {
        let across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let sides = [corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]];
        let longest = sides.iter().map(|side| side.length()).fold(0.0, f64::max);
        // The height of a sliver is rounding, and so is its plane.
        let height = across.length() / longest;
        let normal = across.try_normalize()?;
        (height > 4.0 * near).then_some(Self { surface, corners, normal, near })
    }

    fn bounds(&self) -> Bounds {
        let low = self.corners.into_iter().fold(DVec3::INFINITY, DVec3::min);
        let high = self.corners.into_iter().fold(DVec3::NEG_INFINITY, DVec3::max);
        [low - self.near, high + self.near]
    }

    fn holds(&self, other: &Self) -> bool {
        let near = self.near + other.near;
        let mut corners = other.corners.into_iter();
        corners.all(|corner| (corner - self.corners[0]).dot(self.normal).abs() <= near)
    }

    /// Returns whether one of the sides of this piece separates it from another in its plane.
    fn separates(&self, other: &Self) -> bool {
        (0..4).any(|k| {
            let side = self.corners[(k + 1) % 4] - self.corners[k];
            let Some(axis) = side.cross(self.normal).try_normalize() else { return false };
            let range = |piece: &Self| {
                let along = piece.corners.map(|corner| corner.dot(axis));
                let low = along.into_iter().fold(f64::INFINITY, f64::min);
                [low, along.into_iter().fold(f64::NEG_INFINITY, f64::max)]
            };
            let ([low, high], [other_low, other_high]) = (range(self), range(other));
            let least = self.near + other.near + OVERLAP * (high - low).min(other_high - other_low);
            high <= other_low + least || other_high <= low + least
        })
    }

    fn overlaps(&self, other: &Self) -> bool {
        let equal = |corner: &DVec3| other.corners.contains(corner);
        // A triangle with the corners of an earlier one has a finding of its own.
        let is_doubled = self.surface.0 == other.surface.0 && self.corners.iter().all(equal);
        !is_doubled
            && self.holds(other)
            && other.holds(self)
            && !self.separates(other)
            && !other.separates(self)
    }
}

/// Returns the findings about meshes and boxes whose surfaces overlap in one plane, and the number of
/// boxes and pairs that were tested.
#[must_use]
pub fn findings(subject: &Subject<'_>) -> (Vec<Finding>, u64) {
    let mut pieces = Vec::new();
    let mut left_out = 0;
    for (number, item) in subject.items.iter().enumerate() {
        left_out += usize::from(!add_pieces(number, item, &mut pieces));
    }
    let is_flat =
        |piece: &Piece| matches!(subject.items[piece.surface.0].object.shape, Shape::Quad(_));
    let is_mesh = |piece: &Piece| subject.items[piece.surface.0].mesh().is_some();
    let bounds: Vec<Bounds> = pieces.iter().map(Piece::bounds).collect();
    let tree = Boxes::new(bounds.clone());
    let mut left = MOST_TRIED * (pieces.len() as u64 + (1 << 12));
    let mut looks = 0;
    // For each pair of surfaces, the later one first, the number of pieces of the later one.
    let mut pairs: BTreeMap<[(usize, u32); 2], usize> = BTreeMap::new();
    for (k, piece) in pieces.iter().enumerate() {
        let mut met = Vec::new();
        looks += tree.search(
            |other| touch(other, &bounds[k]),
            |other| {
                let earlier = &pieces[other as usize];
                left = left.saturating_sub(1);
                if left == 0 {
                    return ControlFlow::Break(());
                }
                // Pairs with flat objects, but for those with boxes, are found elsewhere.
                let is_known = is_flat(piece) && (is_flat(earlier) || is_mesh(earlier))
                    || is_flat(earlier) && is_mesh(piece);
                if (other as usize) < k && !is_known && piece.overlaps(earlier) {
                    met.push(earlier.surface);
                }
                ControlFlow::Continue(())
            },
        );
        met.sort_unstable();
        met.dedup();
        for other in met {
            *pairs.entry([piece.surface, other]).or_default() += 1;
        }
    }
    let more = pairs.len().saturating_sub(MOST_NAMED);
    let mut findings: Vec<Finding> = pairs
        .iter()
        .take(MOST_NAMED)
        .map(|([own, other], &number)| described(subject, *own, *other, number))
        .collect();
    if more > 0 {
        let least = if left == 0 { "at least " } else { "" };
        let message = format!("{least}{more} more pairs of surfaces overlap in one plane");
        findings.push(Finding::new(Severity::Remark, "objects", message));
    }
    if left_out > 0 {
        let copies = count(left_out, "copy of a mesh was", "copies of meshes were");
        let message = format!(
            "{copies} not compared with other surfaces, since all copies together have more than {MOST_OF_COPIES} \
             triangles"
        );
        findings.push(Finding::new(Severity::Remark, "objects", message));
    }
    (findings, looks)
}

/// Adds the flat pieces of an item. Returns false for a copy of a mesh with which there would be too many.
fn add_pieces(number: usize, item: &Item<'_>, pieces: &mut Vec<Piece>) -> bool {
    let faces = |to_scene: &DAffine3, [low, high]: [DVec3; 2]| {
        let corner = |k: usize| {
            let pick = |bit: usize| if k >> bit & 1 == 0 { low[bit] } else { high[bit] };
            to_scene.transform_point3(DVec3::new(pick(0), pick(1), pick(2)))
        };
        // Each face by its corners, whose bits select low or high along the axes.
        [[0, 2, 6, 4], [1, 3, 7, 5], [0, 1, 5, 4], [2, 3, 7, 6], [0, 1, 3, 2], [4, 5, 7, 6]]
            .map(|face: [usize; 4]| face.map(corner))
    };
    let boxed = |faces: [[DVec3; 4]; 6], pieces: &mut Vec<Piece>| {
        let face = |(part, corners)| Piece::new((number, part), corners, near_box(&corners));
        pieces.extend((0..).zip(faces).filter_map(face));
    };
    match &item.object.shape {
        Shape::Mesh(mesh) => {
            pieces.extend((0..mesh.triangles.len() as u32).filter_map(|triangle| {
                let [a, b, c] = mesh.places(triangle);
                let surface = mesh.triangles[triangle as usize].surface;
                // The offset is exact: only the coordinates from it are rounded.
                let own = mesh.corners(triangle).into_iter().flatten();
                let largest = own.fold(0.0, |most: f32, x| most.max(x.abs()));
                let near = NEAR_MESH * f64::from(largest);
                Piece::new((number, surface), [a, b, c, c], near)
            }));
        }
        Shape::Instance(instance) => {
            let (mesh, to_scene) = (instance.mesh(), instance.placement().to_scene());
            if pieces.len() + mesh.triangles.len() > MOST_OF_COPIES {
                return false;
            }
            pieces.extend((0..mesh.triangles.len() as u32).filter_map(|triangle| {
                let places = mesh.places(triangle).map(|place| to_scene.transform_point3(place));
                let surface = mesh.triangles[triangle as usize].surface;
                let largest =
                    places.iter().map(|place| place.abs().max_element()).fold(0.0, f64::max);
                let [a, b, c] = places;
                Piece::new((number, surface), [a, b, c, c], NEAR_MESH * largest)
            }));
        }
        Shape::Cuboid(cuboid) => boxed(faces(&DAffine3::IDENTITY, cuboid.bounds()), pieces),
        Shape::Placed(placed) => {
            if let Shape::Cuboid(cuboid) = placed.shape() {
                let to_scene = item.object.to_own_space.inverse();
                boxed(faces(&to_scene, cuboid.bounds()), pieces);
            }
        }
        Shape::Quad(quad) => {
            let piece = |corners: [DVec3; 4]| Piece::new((number, 0), corners, near_box(&corners));
            pieces.extend(quad.corners().and_then(piece));
        }
        Shape::Sphere(_) | Shape::Superquadric(_) => {}
    }
    true
}

/// Returns the distance from the plane of exact corners within which a point counts as in it.
fn near_box(corners: &[DVec3; 4]) -> f64 {
    let largest = corners.iter().map(|corner| corner.abs().max_element()).fold(0.0, f64::max);
    NEAR_BOX * largest
}

/// Describes two surfaces of which `number` pieces overlap.
fn described(
    subject: &Subject<'_>,
    own: (usize, u32),
    other: (usize, u32),
    number: usize,
) -> Finding {
    let [item, with] = [own.0, other.0].map(|index| &subject.items[index]);
    let pieces = if item.mesh().is_some() {
        count(number, "triangle", "triangles")
    } else {
        count(number, "face", "faces")
    };
    let name = |item: &Item<'_>, part: u32| {
        let name = item.mesh().and_then(|mesh| mesh.surfaces.get(part as usize));
        name.filter(|name| !name.is_empty()).map(|name| format!(" of {name}")).unwrap_or_default()
    };
    let place = if own.0 == other.0 {
        format!("other triangles{}", name(with, other.1))
    } else {
        format!("{} ({}){}", with.path, with.kind, name(with, other.1))
    };
    let clear = subject.is_clear(item) || subject.is_clear(with);
    let end = if clear {
        "no light goes from one into the other: leave a small gap"
    } else {
        "rounding decides at each point which of the two is seen: move one of them a little"
    };
    let verb = if number == 1 { "overlaps" } else { "overlap" };
    let message = format!("{pieces}{} {verb} {place} in one plane; {end}", name(item, own.1));
    Finding::new(Severity::Hint, &item.path, message)
}
