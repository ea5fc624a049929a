//! Values of a mesh at a point of one of its triangles: the colour of its vertices, and the smooth surface
//! that its normals stand for.

use super::mesh::{NONE, as_dvec3, weighted};
use super::{Mesh, Shape};
use glam::DVec3;

/// A point of the smooth surface over a triangle, where shadow rays start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmoothPoint {
    /// The point, in scene space.
    pub position: DVec3,
    /// Unit normal of the smooth surface, on the side that is seen.
    pub normal: DVec3,
}

impl Shape {
    /// Returns the colour of the vertices at a point of the triangle `number`, linear RGB, interpolated
    /// linearly. Returns `None` for a shape without such colours.
    #[must_use]
    pub fn vertex_color(&self, number: u32, point: DVec3) -> Option<DVec3> {
        let mesh = self.mesh().filter(|mesh| !mesh.colors.is_empty())?;
        let corners = mesh.triangles[number as usize].position;
        let colors = corners.map(|index| as_dvec3(mesh.colors[index as usize]));
        Some(weighted(mesh.weights(number, point), colors))
    }

    /// Returns the point of the smooth surface over a point of the triangle `number`. `facing` is the
    /// triangle's normal on the side that is seen. Returns `None` for a shape or triangle without
    /// interpolated normals.
    ///
    /// Each corner's tangent plane is moved to the side that is seen, never behind the triangle, and the
    /// three projections of the point are interpolated (J. Hanika, "Hacking the Shadow Terminator", Ray
    /// Tracing Gems II, 2021). Where the normals agree, the point stays where it is.
    #[must_use]
    pub fn smooth_point(&self, number: u32, point: DVec3, facing: DVec3) -> Option<SmoothPoint> {
        let mesh = self.mesh()?;
        let corners = mesh.triangles[number as usize].normal;
        if corners[0] == NONE {
            return None;
        }
        let normals = corners.map(|index| as_dvec3(mesh.normals[index as usize]));
        let normals = [0, 1, 2].map(|k| normals[k].try_normalize());
        let [Some(a), Some(b), Some(c)] = normals else { return None };
        let (normals, weights) = ([a, b, c], mesh.weights(number, point));
        let places = mesh.places(number);
        let across = (places[1] - places[0]).cross(places[2] - places[0]);
        // Normals point outward; seen from the inside they are turned.
        let side = if across.dot(facing) < 0.0 { -1.0 } else { 1.0 };
        let moves = [0, 1, 2].map(|k| {
            let height = side * (point - places[k]).dot(normals[k]);
            height.min(0.0) * side * normals[k]
        });
        let normal = weighted(weights, normals).try_normalize()?;
        Some(SmoothPoint { position: point - weighted(weights, moves), normal: side * normal })
    }
}

impl Mesh {
    /// Returns the weights of a triangle's corners at a point of it. They are at least 0 and sum to 1,
    /// also where the point lies beside the triangle.
    fn weights(&self, triangle: u32, point: DVec3) -> [f64; 3] {
        let Some([by_b, by_c]) = self.weight_gradients(triangle) else { return [1.0, 0.0, 0.0] };
        let from = point - self.places(triangle)[0];
        let b = by_b.dot(from).clamp(0.0, 1.0);
        let c = by_c.dot(from).clamp(0.0, 1.0 - b);
        [1.0 - b - c, b, c]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::mesh::Triangle;

    /// A triangle with its corners on the unit sphere, and the sphere's normals.
    fn on_a_sphere() -> Shape {
        let positions = vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let triangle =
            Triangle { position: [0, 1, 2], uv: [NONE; 3], normal: [0, 1, 2], surface: 0 };
        Shape::Mesh(Mesh {
            normals: positions.clone(),
            colors: vec![[1.0, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 0.25]],
            positions,
            triangles: vec![triangle],
            surfaces: vec![String::new()],
            ..Mesh::default()
        })
    }

    #[test]
    fn shadows_start_outside_the_triangle_and_at_its_corners_on_it() {
        let shape = on_a_sphere();
        let middle = DVec3::splat(1.0 / 3.0);
        let outside = shape.smooth_point(0, middle, DVec3::ONE).unwrap();
        // Each tangent plane is moved by 2/3 along one axis, with the weight 1/3.
        assert!(outside.position.abs_diff_eq(DVec3::splat(1.0 / 3.0 + 2.0 / 9.0), 1e-15));
        assert!(outside.normal.abs_diff_eq(DVec3::splat(1.0 / 3f64.sqrt()), 1e-15));
        for corner in [DVec3::X, DVec3::Y, DVec3::Z] {
            let found = shape.smooth_point(0, corner, DVec3::ONE).unwrap();
            assert!(found.position.abs_diff_eq(corner, 1e-15) && found.normal == corner);
        }
        // Seen from the inside of the sphere, the tangent planes lie behind the triangle.
        assert_eq!(shape.smooth_point(0, middle, DVec3::NEG_ONE).unwrap().position, middle);
    }

    #[test]
    fn colours_are_those_of_the_corners_and_linear_between() {
        let shape = on_a_sphere();
        assert_eq!(shape.vertex_color(0, DVec3::Y), Some(DVec3::new(0.0, 0.5, 0.0)));
        let middle = shape.vertex_color(0, DVec3::splat(1.0 / 3.0)).unwrap();
        assert!(middle.abs_diff_eq(DVec3::new(1.0, 0.5, 0.25) / 3.0, 1e-15));
        let beside = shape.vertex_color(0, DVec3::new(5.0, 0.0, 0.0)).unwrap();
        assert!(beside.min_element() >= 0.0 && beside.max_element() <= 1.0);
    }
}
