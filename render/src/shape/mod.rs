//! The shapes of a scene, each in its own file, behind one closed enum.

mod closed;
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
