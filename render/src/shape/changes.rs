//! Changes of texture coordinates and normals along the surface of a shape.

use super::{Shape, SurfacePoint};
use glam::{DVec2, DVec3};

/// Derivatives at a point of a shape for two steps along the surface: a step of twice the length
/// has changes twice as large.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Changes {
    /// Changes of the texture coordinates, for each step. They are zero where the shape has none.
    pub uv: [DVec2; 2],
    /// Changes of the unit normal for shading, for each step.
    pub normal: [DVec3; 2],
}

impl Shape {
    /// Returns the gradients of both texture coordinates along the surface at `position`, a point
    /// on the triangle or face `number`. The length of a gradient is the rate of change per scene
    /// unit. Gradients are zero where the shape has none.
    #[must_use]
    pub fn uv_gradients(&self, number: u32, position: DVec3) -> [DVec3; 2] {
        match self {
            Self::Sphere(sphere) => sphere.uv_gradients(position),
            Self::Quad(quad) => quad.uv_gradients(),
            Self::Mesh(mesh) => mesh.uv_gradients(number),
            Self::Cuboid(cuboid) => cuboid.uv_gradients(number),
            Self::Superquadric(superquadric) => superquadric.uv_gradients(position),
            Self::Placed(placed) => placed.uv_gradients(number, position),
            Self::Instance(instance) => instance.uv_gradients(number),
        }
    }

    /// Returns the changes for two `steps` along the surface, in scene units, at a point that
    /// [`Shape::surface_point`] returned for `number` and `barycentric`.
    #[must_use]
    pub fn changes(
        &self,
        number: u32,
        barycentric: [f64; 2],
        point: &SurfacePoint,
        steps: [DVec3; 2],
    ) -> Changes {
        match self {
            Self::Sphere(sphere) => sphere.changes(point.geometric_normal, steps),
            Self::Quad(quad) => Changes::flat(quad.uv_gradients(), steps),
            Self::Mesh(mesh) => mesh.changes(number, barycentric, steps),
            Self::Cuboid(cuboid) => Changes::flat(cuboid.uv_gradients(number), steps),
            Self::Superquadric(superquadric) => superquadric.changes(point.position, steps),
            Self::Placed(placed) => placed.changes(number, point, steps),
            Self::Instance(instance) => instance.changes(number, barycentric, steps),
        }
    }
}

impl Changes {
    /// Returns the changes on a flat shape, from the gradients of its texture coordinates.
    #[must_use]
    pub fn flat(uv_gradients: [DVec3; 2], steps: [DVec3; 2]) -> Self {
        let uv = steps.map(|step| DVec2::from(uv_gradients.map(|gradient| gradient.dot(step))));
        Self { uv, normal: [DVec3::ZERO; 2] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::mesh::{NONE, Triangle};
    use crate::shape::{Cuboid, Mesh, Placement, Quad, Sphere, Start, Superquadric};
    use glam::{DAffine3, DMat3};

    /// A step along the surface changes the texture coordinates by its product with the gradients.
    #[test]
    fn gradients_of_coordinates_agree_with_differences() {
        let ball = Sphere { center: DVec3::new(1.0, 2.0, 3.0), radius: 2.0 };
        let edges = [DVec3::new(2.0, 0.0, 0.5), DVec3::new(1.0, 3.0, 0.0)];
        let quad = Quad::new(DVec3::ONE, edges[0], edges[1], DVec2::new(2.0, 5.0), true).unwrap();
        let corner = |uv| Triangle { position: [0, 1, 2], uv, normal: [NONE; 3], surface: 0 };
        let mesh = Mesh {
            positions: vec![[0., 0., 1.], [2., 0., 0.], [1., 3., 0.]],
            uvs: vec![[0.1, 0.2], [1.5, 0.1], [0.4, 2.0]],
            triangles: vec![corner([0, 1, 2]), corner([NONE; 3])],
            ..Mesh::default()
        };
        let step = 1e-6;
        for k in 0..20 {
            let near = DVec3::new((2.1 * f64::from(k)).sin(), (0.7 * f64::from(k)).cos(), 0.4);
            let at = |point: DVec3| [ball.surface_point(point), quad.surface_point(point)];
            let here = at(ball.center + near);
            let found = [Shape::Sphere(ball), Shape::Quad(quad)].map(|shape| {
                let k = usize::from(!matches!(shape, Shape::Sphere(_)));
                shape.uv_gradients(0, here[k].position)
            });
            for which in 0..2 {
                let (tangent, _) = here[which].geometric_normal.any_orthonormal_pair();
                let moved = at(here[which].position + step * tangent)[which];
                let step_taken = moved.position - here[which].position;
                let expected = moved.uv - here[which].uv;
                let change = DVec2::from(found[which].map(|gradient| gradient.dot(step_taken)));
                assert!(change.abs_diff_eq(expected, 1e-11), "{change} and {expected}");
            }
            let weights = [(0.1, 0.2), (0.1 + 0.01 * f64::from(k), 0.25)];
            let [from, to] = weights.map(|(b, c)| mesh.surface_point(0, [b, c]));
            let step_taken = to.position - from.position;
            let change = DVec2::from(mesh.uv_gradients(0).map(|gradient| gradient.dot(step_taken)));
            assert!(change.abs_diff_eq(to.uv - from.uv, 1e-14));
        }
        assert_eq!(Shape::Mesh(mesh).uv_gradients(1, DVec3::ZERO), [DVec3::ZERO; 2]);
        assert_eq!(ball.uv_gradients(ball.center + 2.0 * DVec3::Y), [DVec3::ZERO; 2]);
    }

    #[test]
    fn gradients_on_solids_and_placed_shapes_agree_with_differences() {
        let solid = |exponents, ring| {
            let radii = DVec3::new(1.0, 1.5, 0.8);
            Shape::Superquadric(Superquadric::new(DVec3::X, radii, exponents, ring).unwrap())
        };
        let map = DAffine3::from_translation(DVec3::Y)
            * DAffine3::from_mat3(DMat3::from_cols_array(&[
                1., 0.2, 0., 0., 2., 0.3, -0.4, 0., 1.,
            ]));
        let placement = Placement::new(map).unwrap();
        let ball = Sphere { center: DVec3::new(0.2, 0.1, 0.0), radius: 1.0 };
        let shapes = [
            Shape::Cuboid(Cuboid::new(DVec3::NEG_ONE, DVec3::new(1.0, 2.0, 0.5)).unwrap()),
            solid([1.0, 0.7], None),
            solid([0.8, 1.0], Some(2.0)),
            Shape::Sphere(ball).placed(&placement).unwrap(),
            solid([0.7, 0.9], None).placed(&placement).unwrap(),
        ];
        let step = 1e-6;
        let mut seen = 0;
        for shape in &shapes {
            for k in 0..40 {
                let k = f64::from(k);
                let eye = 9.0 * DVec3::new((2.1 * k).sin(), (0.7 * k).cos(), 0.4 + (0.3 * k).sin());
                let toward = DVec3::new(1.3, 0.21, 0.17) - eye;
                let direction = toward.normalize();
                let Some((t, face)) =
                    shape.intersect(eye, direction, Start { left_face: None, skin: 0.0 })
                else {
                    continue;
                };
                let at = |point| shape.surface_point(face, [0.0; 2], point);
                let here = at(eye + t * direction);
                let normal = shape.geometric_normal(face, eye + t * direction);
                assert_eq!(normal, here.geometric_normal, "{shape:?}");
                let gradients = shape.uv_gradients(face, here.position);
                let (one, other) = here.geometric_normal.any_orthonormal_pair();
                for tangent in [one, other] {
                    let moved = at(here.position + step * tangent);
                    let step_taken = moved.position - here.position;
                    let change = DVec2::from(gradients.map(|gradient| gradient.dot(step_taken)));
                    let expected = moved.uv - here.uv;
                    // The error is of second order in the step, where the surface bends by at most
                    // 100.
                    assert!(change.abs_diff_eq(expected, 1e-9), "{shape:?} {change} {expected}");
                    seen += 1;
                }
            }
        }
        assert!(seen > 200, "{seen}");
    }
}
