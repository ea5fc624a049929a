//! The two triangles of a cell as they will be cut, and distances of points from them.

use glam::DVec3;

/// Least difference of the two diagonals' distances from the surface, as a fraction of the longer diagonal,
/// that counts.
const NEARER: f64 = 1e-6;
/// Fraction of the squared length by which the second diagonal must be shorter to be chosen.
const SHORTER: f64 = 1e-5;

/// Distances of the two diagonals of a saddle that differ by less than this fraction are alike.
const ALIKE: f64 = 0.03;
/// The line in space that decides between the diagonals of a saddle.
const FIXED: DVec3 = DVec3::new(0.48, 0.61, 0.63);

/// A triangle whose doubled area is below this fraction of its squared longest side has no direction: rounding of its
/// corners decides it.
const NO_AREA: f64 = 1e-12;

/// The two triangles of a cell with corners A, B, C, D, counter-clockwise from its first corner.
#[derive(Debug, Clone, Copy)]
pub struct Pair {
    /// True if the diagonal runs from A to C; otherwise it runs from B to D.
    pub ac: bool,
    /// Indices of the corners of both triangles.
    pub corners: [[usize; 3]; 2],
}

impl Pair {
    /// Cuts a cell by the rule of `triangulate`: along the diagonal that is nearer to the surface, judged by
    /// the normals at its ends. Of equally near diagonals the shorter is taken, on a saddle the one along a fixed
    /// line.
    ///
    /// `triangulate` sees coordinates of f32. Where both diagonals are equally near it may decide otherwise;
    /// then both are equally good.
    pub fn choose(points: &[DVec3; 4], normals: &[DVec3; 4]) -> Self {
        let chord = |from: usize, to: usize| {
            let chord = points[to] - points[from];
            (chord.dot(normals[to] - normals[from]), chord.length_squared())
        };
        let (bulge_ac, length_sq_ac) = chord(0, 2);
        let (bulge_bd, length_sq_bd) = chord(1, 3);
        let (off_ac, off_bd) = (bulge_ac.abs(), bulge_bd.abs());
        let slack = NEARER * length_sq_ac.max(length_sq_bd).sqrt();
        let saddle = bulge_ac * bulge_bd < 0.0 && off_ac.min(off_bd) > slack;
        let ac = if saddle && (off_ac - off_bd).abs() <= ALIKE * off_ac.max(off_bd) {
            let along = |from: usize, to: usize| (points[to] - points[from]).dot(FIXED).abs();
            along(0, 2) >= along(1, 3)
        } else if (off_ac - off_bd).abs() > slack {
            off_bd >= off_ac
        } else {
            length_sq_bd >= length_sq_ac * (1.0 - SHORTER)
        };
        let corners = if ac { [[0, 1, 2], [0, 2, 3]] } else { [[0, 1, 3], [1, 2, 3]] };
        Self { ac, corners }
    }
}

/// A triangle prepared for distance queries.
#[derive(Debug, Clone, Copy)]
pub struct Facet {
    corners: [DVec3; 3],
    /// Vectors from each side into the triangle, perpendicular to the side, in the order of the corners where
    /// sides start.
    inward: [DVec3; 3],
    /// The unit normal; `None` if the triangle has no area.
    pub normal: Option<DVec3>,
}

impl Facet {
    pub fn new(corners: [DVec3; 3]) -> Self {
        let [a, b, c] = corners;
        let (p, q) = (b - a, c - a);
        let across = p.cross(q);
        let long_sq = p.length_squared().max(q.length_squared());
        // Below this bound, rounding alone decides the direction.
        let has_area = across.length_squared() > (NO_AREA * long_sq).powi(2);
        let inward = [b - a, c - b, a - c].map(|side| across.cross(side));
        Self { corners, inward, normal: has_area.then(|| across.normalize()) }
    }

    /// Returns the squared distance of a point from the triangle.
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
