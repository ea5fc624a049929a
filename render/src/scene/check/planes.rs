//! Which flat objects may lie in one plane.
//!
//! Planes are sorted by their normals and by their distance from the origin, one number after another,
//! and parted wherever two neighbours are farther apart than the rounding of either.

use super::boxes::Bounds;
use crate::shape::Quad;
use glam::DVec3;

/// Points of one surface are computed this near to another that coincides with it, in parts of the
/// largest coordinate: what a ray takes for the same place.
pub const NEAR: f64 = 64.0 * f64::EPSILON;

/// How much wider than [`NEAR`] planes are taken for near: the roundings of the numbers that are sorted.
const WIDER: f64 = 8.0;

/// What tells one flat object from another, bit by bit: its corners, or the point and the normal of a
/// plane without end.
pub type Bits = [u64; 13];

/// The bits of a flat object.
#[must_use]
pub fn bits(quad: &Quad) -> Bits {
    let points = match quad.corners() {
        Some(corners) => corners,
        None => [quad.corner(), normal(quad), DVec3::ZERO, DVec3::ZERO],
    };
    let mut bits = [0; 13];
    for (place, number) in points.iter().flat_map(DVec3::to_array).enumerate() {
        // Minus zero is the same number as zero.
        bits[place] = (number + 0.0).to_bits();
    }
    bits[12] = u64::from(quad.bounds().is_none());
    bits
}

/// The unit normal of a flat object.
#[must_use]
pub fn normal(quad: &Quad) -> DVec3 {
    quad.surface_point(quad.corner()).geometric_normal
}

/// The box of a flat object, a little wider than it is; endless for a plane.
#[must_use]
pub fn bounds(quad: &Quad) -> Bounds {
    match quad.bounds() {
        Some([low, high]) => {
            let slack = WIDER * NEAR * (low.abs().max(high.abs()).max_element() + 1.0);
            [low - slack, high + slack]
        }
        None => [DVec3::NEG_INFINITY, DVec3::INFINITY],
    }
}

/// A number to sort by, and how far off a near one may be.
type Key = (f64, f64);

/// Groups of flat objects, of at least two each, whose planes may be one; in any order. Objects of
/// different groups are never in one plane.
#[must_use]
pub fn near_each_other(quads: &[&Quad]) -> Vec<Vec<usize>> {
    let keys: Vec<[Key; 4]> = quads.iter().map(|quad| keys(quad)).collect();
    let all: Vec<usize> = (0..quads.len()).collect();
    (0..4).fold(vec![all], |groups, number| {
        let parted = groups.into_iter().flat_map(|group| part(group, |k| keys[k][number]));
        parted.filter(|group| group.len() > 1).collect()
    })
}

/// The direction of the normal without its sign, and the distance of the plane from the origin.
fn keys(quad: &Quad) -> [Key; 4] {
    let normal = normal(quad);
    // Squares and products of coordinates do not tell a normal from its opposite.
    let turns = WIDER * NEAR;
    let size = quad.corner().abs().max_element();
    let distance = normal.dot(quad.corner()).abs();
    [
        (normal.x * normal.x, turns),
        (normal.y * normal.y, turns),
        (normal.x * normal.y + 2.0 * normal.y * normal.z + 3.0 * normal.z * normal.x, turns),
        (distance, WIDER * NEAR * size),
    ]
}

/// A group parted where neighbours in rising order are not near.
fn part(mut group: Vec<usize>, key: impl Fn(usize) -> Key) -> Vec<Vec<usize>> {
    let low = |k: usize| key(k).0 - key(k).1;
    group.sort_by(|&a, &b| low(a).total_cmp(&low(b)).then(a.cmp(&b)));
    let mut parts: Vec<Vec<usize>> = Vec::new();
    let mut reach = f64::NEG_INFINITY;
    for k in group {
        match parts.last_mut() {
            Some(last) if low(k) <= reach => last.push(k),
            _ => parts.push(vec![k]),
        }
        reach = reach.max(key(k).0 + key(k).1);
    }
    parts
}

/// The plane of a flat object with its box, to find triangles that lie in it.
#[derive(Debug)]
pub struct Slab {
    corner: DVec3,
    normal: DVec3,
    bounds: Bounds,
}

impl Slab {
    /// That of a flat object.
    #[must_use]
    pub fn of(quad: &Quad) -> Self {
        Self { corner: quad.corner(), normal: normal(quad), bounds: bounds(quad) }
    }

    /// Whether a box may hold a triangle of which each corner is in the plane and the middle in the
    /// object's box; never false where that is so.
    #[must_use]
    pub fn meets(&self, around: &Bounds) -> bool {
        let [low, high] = *around;
        let size = low.abs().max(high.abs()).max_element() + self.corner.abs().max_element();
        let slack = WIDER * NEAR * (size + 1.0);
        let touches =
            (low - slack).cmple(self.bounds[1]).all() && (high + slack).cmpge(self.bounds[0]).all();
        let middle = low.midpoint(high);
        let reach = (0.5 * (high - low)).dot(self.normal.abs());
        touches && (middle - self.corner).dot(self.normal).abs() <= reach + slack
    }
}
