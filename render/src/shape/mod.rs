//! The shapes of a scene, each in its own file, behind one closed enum.

pub mod mesh;
pub mod quad;
pub mod sphere;
pub mod triangle;

pub use mesh::Mesh;
pub use quad::Quad;
pub use sphere::Sphere;

use glam::{DVec2, DVec3};

/// A shape of the scene.
#[derive(Debug, Clone)]
pub enum Shape {
    /// A sphere.
    Sphere(Sphere),
    /// A rectangle or parallelogram, or the whole plane it lies in.
    Quad(Quad),
    /// A mesh of triangles.
    Mesh(Mesh),
}

impl Shape {
    /// The largest coordinate, without its sign, that its points are computed from.
    #[must_use]
    pub fn extent(&self) -> f64 {
        let largest = |corners: [DVec3; 2]| corners[0].abs().max(corners[1].abs()).max_element();
        match self {
            Self::Sphere(sphere) => largest(sphere.bounds()),
            Self::Quad(quad) => quad.bounds().map_or(quad.corner().abs().max_element(), largest),
            Self::Mesh(mesh) => {
                let coordinates = mesh.positions.iter().flatten();
                coordinates.fold(0.0, |most: f64, &x| most.max(f64::from(x).abs()))
            }
        }
    }

    /// The gradients of both texture coordinates along the surface at one of its points: the
    /// directions in which they grow, as long as they grow fast. Zero where they have none.
    #[must_use]
    pub fn uv_gradients(&self, triangle: u32, position: DVec3) -> [DVec3; 2] {
        match self {
            Self::Sphere(sphere) => sphere.uv_gradients(position),
            Self::Quad(quad) => quad.uv_gradients(),
            Self::Mesh(mesh) => mesh.uv_gradients(triangle),
        }
    }
}

/// What a shape knows of one of its points.
#[derive(Debug, Clone, Copy)]
pub struct SurfacePoint {
    /// Where it is.
    pub position: DVec3,
    /// Unit normal of the surface itself; outward for closed shapes.
    pub geometric_normal: DVec3,
    /// Unit normal to shade with: interpolated on a mesh, else the geometric one.
    pub shading_normal: DVec3,
    /// Texture coordinates, across and up; a texture fills the unit square.
    pub uv: DVec2,
    /// Which of the object's surfaces this is, an index into its parts.
    pub part: u32,
}

/// The period with which a shape's texture coordinates jump at a seam, across and up; 0 for none.
pub type SeamPeriod = DVec2;

#[cfg(test)]
mod tests {
    use super::mesh::{NONE, Triangle};
    use super::*;

    /// A step along the surface changes the coordinates by its product with the gradients.
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
                let place = usize::from(!matches!(shape, Shape::Sphere(_)));
                shape.uv_gradients(0, here[place].position)
            });
            for place in 0..2 {
                let (tangent, _) = here[place].geometric_normal.any_orthonormal_pair();
                let moved = at(here[place].position + step * tangent)[place];
                let way = moved.position - here[place].position;
                let expected = moved.uv - here[place].uv;
                let change = DVec2::from(found[place].map(|gradient| gradient.dot(way)));
                assert!(change.abs_diff_eq(expected, 1e-11), "{change} and {expected}");
            }
            let weights = [(0.1, 0.2), (0.1 + 0.01 * f64::from(k), 0.25)];
            let [from, to] = weights.map(|(b, c)| mesh.surface_point(0, [b, c]));
            let way = to.position - from.position;
            let change = DVec2::from(mesh.uv_gradients(0).map(|gradient| gradient.dot(way)));
            assert!(change.abs_diff_eq(to.uv - from.uv, 1e-14));
        }
        assert_eq!(Shape::Mesh(mesh).uv_gradients(1, DVec3::ZERO), [DVec3::ZERO; 2]);
        assert_eq!(ball.uv_gradients(ball.center + 2.0 * DVec3::Y), [DVec3::ZERO; 2]);
    }
}
