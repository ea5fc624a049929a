//! The two triangles of a cell, as they will be cut, and how far a point is from them.

use glam::DVec3;

/// How much nearer to the surface, as a part of its length, the second diagonal must be.
const NEARER: f64 = 1e-6;
/// How much shorter, as a part of the squared length, the second diagonal must be.
const SHORTER: f64 = 1e-5;

/// The triangles of a cell with corners A, B, C, D, counter-clockwise from its first.
#[derive(Debug, Clone, Copy)]
pub struct Pair {
    /// Whether the diagonal runs from A to C, else from B to D.
    pub ac: bool,
    /// Corner numbers.
    pub corners: [[usize; 3]; 2],
}

impl Pair {
    /// Cuts a cell by the rule of `triangulate`: along the diagonal whose ends' normals say that it
    /// is nearer to the surface, and of equally near ones along the shorter.
    ///
    /// That rule sees coordinates of f32; where both diagonals are equally near it may decide
    /// otherwise, and then either is as good.
    pub fn choose(points: &[DVec3; 4], normals: &[DVec3; 4]) -> Self {
        let chord = |from: usize, to: usize| {
            let chord = points[to] - points[from];
            (chord.dot(normals[to] - normals[from]).abs(), chord.length_squared())
        };
        let (off_ac, length_sq_ac) = chord(0, 2);
        let (off_bd, length_sq_bd) = chord(1, 3);
        let slack = NEARER * length_sq_ac.max(length_sq_bd).sqrt();
        let ac = if (off_ac - off_bd).abs() > slack {
            off_bd >= off_ac
        } else {
            length_sq_bd >= length_sq_ac * (1.0 - SHORTER)
        };
        let corners = if ac { [[0, 1, 2], [0, 2, 3]] } else { [[0, 1, 3], [1, 2, 3]] };
        Self { ac, corners }
    }
}

/// A triangle, made ready to be asked for many points.
#[derive(Debug, Clone, Copy)]
pub struct Facet {
    corners: [DVec3; 3],
    /// From each side, in the order of the corners that it starts at, into the triangle.
    inward: [DVec3; 3],
    /// The unit normal; nothing where the triangle has no area.
    pub normal: Option<DVec3>,
}

impl Facet {
    pub fn new(corners: [DVec3; 3]) -> Self {
        let [a, b, c] = corners;
        let (p, q) = (b - a, c - a);
        let across = p.cross(q);
        let long_sq = p.length_squared().max(q.length_squared());
        // Below this rounding alone decides the direction.
        let has_area = across.length_squared() > (1e-12 * long_sq).powi(2);
        let inward = [b - a, c - b, a - c].map(|side| across.cross(side));
        Self { corners, inward, normal: has_area.then(|| across.normalize()) }
    }

    /// The squared distance of a point.
    pub fn distance_sq(&self, point: DVec3) -> f64 {
        let [a, b, c] = self.corners;
        if let Some(normal) = self.normal
            && [a, b, c]
                .iter()
                .zip(&self.inward)
                .all(|(&from, way)| (point - from).dot(*way) >= 0.0)
        {
            return (point - a).dot(normal).powi(2);
        }
        let edge = |from: DVec3, to: DVec3| {
            let (along, off) = (to - from, point - from);
            let length_sq = along.length_squared();
            let t =
                if length_sq > 0.0 { (off.dot(along) / length_sq).clamp(0.0, 1.0) } else { 0.0 };
            (off - along * t).length_squared()
        };
        edge(a, b).min(edge(b, c)).min(edge(c, a))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_to_the_face_an_edge_or_a_corner() {
        let facet = Facet::new([DVec3::ZERO, DVec3::X * 4.0, DVec3::Y * 4.0]);
        let off = |x, y, z| facet.distance_sq(DVec3::new(x, y, z)).sqrt();
        assert_eq!(off(1.0, 1.0, -3.0), 3.0);
        assert_eq!(off(1.0, -3.0, 4.0), 5.0);
        assert_eq!(off(-3.0, -4.0, 0.0), 5.0);
        assert!((off(3.0, 3.0, 0.0) - 2f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn a_triangle_without_area_is_its_longest_side() {
        let line = Facet::new([DVec3::ZERO, DVec3::ZERO, DVec3::X]);
        assert!(line.normal.is_none());
        assert_eq!(line.distance_sq(DVec3::new(0.5, 2.0, 0.0)), 4.0);
    }
}
