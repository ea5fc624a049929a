//! Decides whether a shape is closed and therefore has an inside.

use super::mesh::as_dvec3;
use super::weld::{Weld, join_near};
use super::{Mesh, Shape};

/// Distance within which the corners of an almost closed mesh are joined, in units in the last place of
/// its largest coordinate.
///
/// Some programs compute the same corner twice by different formulas, such as sin(2 pi) for sin(0). A
/// larger distance would close gaps that are meant.
const JOINED: f64 = 16.0;

impl Shape {
    /// Returns whether the shape divides space into an inside and an outside, with its normals
    /// pointing out. A rectangle does not. A plane does, with the inside behind it. A mesh does if
    /// it is closed.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        match self {
            Self::Sphere(_) | Self::Cuboid(_) | Self::Superquadric(_) => true,
            Self::Placed(placed) => placed.shape().is_closed(),
            Self::Instance(instance) => instance.is_closed(),
            Self::Quad(quad) => quad.bounds().is_none(),
            Self::Mesh(mesh) => mesh.is_closed(),
        }
    }
}

impl Mesh {
    /// Returns whether the mesh is closed: each side of each triangle is matched by a side of
    /// another triangle that runs in the opposite direction, and the enclosed volume is positive.
    /// Corners at equal positions count as one corner. Triangles with two equal corners are
    /// ignored.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        let weld = Weld::new(&self.positions);
        // Each side with its smaller corner first; the reverse direction counts as -1.
        let mut sides: Vec<([u32; 2], i32)> = Vec::with_capacity(3 * self.triangles.len());
        let mut volume = 0.0;
        for (number, triangle) in (0..).zip(&self.triangles) {
            let [a, b, c] = weld.corners(triangle.position);
            if a == b || b == c || c == a {
                continue;
            }
            for [from, to] in [[a, b], [b, c], [c, a]] {
                let sign = if from < to { 1 } else { -1 };
                sides.push(([from.min(to), from.max(to)], sign));
            }
            // Six times the volume between the triangle and one corner of the mesh, which loses no
            // digits far from the origin.
            let origin = as_dvec3(self.corners(0)[0]);
            let [p, q, r] = self.corners(number).map(|corner| as_dvec3(corner) - origin);
            volume += p.dot(q.cross(r));
        }
        sides.sort_unstable_by_key(|(side, _)| *side);
        let matched =
            |group: &[([u32; 2], i32)]| group.iter().map(|(_, sign)| sign).sum::<i32>() == 0;
        volume > 0.0 && sides.chunk_by(|(a, _), (b, _)| a == b).all(matched)
    }

    /// Closes a mesh that is open only because some of its corners differ by rounding: joins them. Returns
    /// the number of corners that were moved, 0 if the mesh is closed already or does not become closed.
    pub fn close_rounded(&mut self) -> usize {
        let largest = self.positions.iter().flatten().fold(0.0, |most: f32, x| most.max(x.abs()));
        if largest == 0.0 || self.is_closed() {
            return 0;
        }
        let distance = JOINED * f64::from(f32::EPSILON) * f64::from(largest);
        let before = self.positions.clone();
        let moved = join_near(&mut self.positions, distance);
        if moved > 0 && self.is_closed() {
            return moved;
        }
        self.positions = before;
        0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::mesh::{NONE, Triangle};

    /// A tetrahedron in which each triangle has corners of its own.
    fn tetrahedron() -> Mesh {
        let corners = [[5., 5., 5.], [6., 5., 5.], [5., 6., 5.], [5., 5., 6.]];
        let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
        let triangle = |first: u32| Triangle {
            position: [first, first + 1, first + 2],
            uv: [NONE; 3],
            normal: [NONE; 3],
            surface: 0,
        };
        Mesh {
            positions: faces.into_iter().flatten().map(|corner: usize| corners[corner]).collect(),
            triangles: (0..4).map(|face| triangle(3 * face)).collect(),
            surfaces: vec![String::new()],
            ..Mesh::default()
        }
    }

    #[test]
    fn corners_that_differ_by_rounding_are_joined_if_that_closes_the_mesh() {
        let mut rounded = tetrahedron();
        rounded.positions[3][1] = rounded.positions[3][1].next_up();
        assert!(!rounded.is_closed());
        assert_eq!(rounded.close_rounded(), 1);
        assert!(rounded.is_closed() && rounded.positions == tetrahedron().positions);
        let mut open = tetrahedron();
        open.positions[3][1] += 0.1;
        let before = open.clone();
        assert_eq!((open.close_rounded(), &open), (0, &before));
    }

    #[test]
    fn a_mesh_is_closed_when_each_side_is_met_by_another() {
        let whole = tetrahedron();
        assert!(whole.is_closed());
        let mut open = whole.clone();
        open.triangles.pop();
        assert!(!open.is_closed());
        let mut turned = whole.clone();
        turned.triangles[0].position.swap(0, 1);
        assert!(!turned.is_closed());
        let mut inside_out = whole;
        inside_out.triangles.iter_mut().for_each(|triangle| triangle.position.swap(0, 1));
        assert!(!inside_out.is_closed());
    }
}
