//! Groups of flat objects that may lie in one plane.
//!
//! Planes are sorted by each coordinate of their normals and by their distance from the origin. A group
//! is split where two neighbours differ by more than their roundings.

use super::boxes::Bounds;
use crate::shape::Quad;
use glam::DVec3;

/// Largest distance between surfaces that coincide, as a fraction of the largest coordinate. Rays use
/// the same distance to decide that a hit lies at their start.
pub const NEAR: f64 = 64.0 * f64::EPSILON;

/// Factor by which groups are wider than [`NEAR`], for the roundings of the sorted numbers.
const WIDER: f64 = 8.0;

/// Bits that identify a flat object: of its corners, or of the point and the normal of an infinite
/// plane.
pub type Bits = [u64; 13];

/// Returns the bits of a flat object.
#[must_use]
pub fn bits(quad: &Quad) -> Bits {
    let points = match quad.corners() {
        Some(corners) => corners,
        None => [quad.corner(), normal(quad), DVec3::ZERO, DVec3::ZERO],
    };
    let mut bits = [0; 13];
    for (k, number) in points.iter().flat_map(DVec3::to_array).enumerate() {
        // -0 has the bits of +0.
        bits[k] = (number + 0.0).to_bits();
    }
    bits[12] = u64::from(quad.bounds().is_none());
    bits
}

/// Returns the unit normal of a flat object.
#[must_use]
pub fn normal(quad: &Quad) -> DVec3 {
    quad.surface_point(quad.corner()).geometric_normal
}

/// Returns the bounding box of a flat object, widened by roundings; infinite for a plane.
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

/// A number to sort by, and its tolerance.
type Key = (f64, f64);

/// Returns groups of at least two flat objects that may lie in one plane, in any order. Objects of
/// different groups never lie in one plane.
#[must_use]
pub fn near_each_other(quads: &[&Quad]) -> Vec<Vec<usize>> {
    let keys: Vec<[Key; 4]> = quads.iter().map(|quad| keys(quad)).collect();
    let groups = vec![(0..quads.len()).collect::<Vec<usize>>()];
    (0..4).fold(groups, |groups, number| {
        let parted = groups.into_iter().flat_map(|group| part(group, |k| keys[k][number]));
        parted.filter(|group| group.len() > 1).collect()
    })
}

/// Returns the keys of a plane: three of its normal, which ignore the sign, and the distance from the
/// origin.
fn keys(quad: &Quad) -> [Key; 4] {
    let normal = normal(quad);
    // Squares and products of coordinates are equal for a normal and its opposite.
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

/// Splits a group where neighbours in ascending order are not near.
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

/// The plane and the bounding box of a flat object, for the search of triangles in the plane.
#[derive(Debug)]
pub struct Slab {
    corner: DVec3,
    normal: DVec3,
    bounds: Bounds,
}

impl Slab {
    /// Returns the slab of a flat object.
    #[must_use]
    pub fn of(quad: &Quad) -> Self {
        Self { corner: quad.corner(), normal: normal(quad), bounds: bounds(quad) }
    }

    /// Returns whether a box may contain a triangle that has all corners in the plane and its middle in
    /// the object's box. The result is never `false` for a box that contains such a triangle.
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
