//! The shapes of a scene, each in its own file, behind one closed enum.

pub mod charts;
pub mod cuboid;
pub mod mesh;
pub mod placed;
pub mod placement;
pub mod quad;
pub mod right_triangle;
pub mod sphere;
pub mod superquadric;
pub mod triangle;

pub use charts::Charts;
pub use cuboid::Cuboid;
pub use mesh::Mesh;
pub use placed::Placed;
pub use placement::{Placement, PlacementError};
pub use quad::Quad;
pub use sphere::Sphere;
pub use superquadric::Superquadric;

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
    /// A box.
    Cuboid(Cuboid),
    /// A superellipsoid or supertoroid.
    Superquadric(Superquadric),
    /// One of the curved shapes or a box, moved, turned or stretched.
    Placed(Placed),
}

/// What a shape must know of the start of a ray.
///
/// A ray that leaves a surface must not hit it again at its start; what else lies within `skin` of
/// the start coincides with that surface and is not hit there either.
#[derive(Debug, Clone, Copy)]
pub struct Start {
    /// The face of this shape that the ray leaves, if it leaves this shape.
    pub leaves: Option<u32>,
    /// How far from the start, measured across the surface, is still the start.
    pub skin: f64,
}

impl Shape {
    /// What a scene file calls a shape of this kind.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Sphere(_) => "sphere",
            Self::Quad(quad) if quad.bounds().is_some() => "rectangle",
            Self::Quad(_) => "plane",
            Self::Mesh(_) => "mesh",
            Self::Cuboid(_) => "box",
            Self::Superquadric(_) => "superquadric",
            Self::Placed(placed) => placed.shape().kind(),
        }
    }

    /// The nearest distance above 0 at which a ray meets the shape, and which of its faces it
    /// meets there: one of six on a box, else 0. `direction` is unit.
    ///
    /// A mesh is not met as a whole, but triangle by triangle: see [`triangle::ShearedRay`].
    #[must_use]
    pub fn intersect(&self, origin: DVec3, direction: DVec3, start: Start) -> Option<(f64, u32)> {
        let leaves = start.leaves.is_some();
        let only_face = |t: f64| (t, 0);
        match self {
            Self::Sphere(sphere) => {
                sphere.intersect(origin, direction, leaves, start.skin).map(only_face)
            }
            Self::Quad(_) if leaves => None,
            Self::Quad(quad) => quad.intersect(origin, direction, start.skin).map(only_face),
            Self::Mesh(_) => None,
            Self::Cuboid(cuboid) => cuboid.intersect(origin, direction, start),
            Self::Superquadric(superquadric) => {
                superquadric.intersect(origin, direction, start).map(only_face)
            }
            Self::Placed(placed) => placed.intersect(origin, direction, start),
        }
    }

    /// The surface point at a hit: on a mesh that of the triangle `number` with these weights of
    /// its second and third corner, else that of the face `number`; `near` is the hit as found
    /// along the ray.
    #[must_use]
    pub fn surface_point(&self, number: u32, barycentric: [f64; 2], near: DVec3) -> SurfacePoint {
        match self {
            Self::Sphere(sphere) => sphere.surface_point(near),
            Self::Quad(quad) => quad.surface_point(near),
            Self::Mesh(mesh) => mesh.surface_point(number, barycentric),
            Self::Cuboid(cuboid) => cuboid.surface_point(number, near),
            Self::Superquadric(superquadric) => superquadric.surface_point(near),
            Self::Placed(placed) => placed.surface_point(number, near),
        }
    }

    /// Which of the object's parts the triangle or face `number` belongs to.
    #[must_use]
    pub fn part(&self, number: u32) -> u32 {
        match self {
            Self::Mesh(mesh) => mesh.triangles[number as usize].surface,
            Self::Cuboid(_) => number,
            Self::Placed(placed) => placed.shape().part(number),
            Self::Sphere(_) | Self::Quad(_) | Self::Superquadric(_) => 0,
        }
    }

    /// How many parts its object has: each is a textured area by itself.
    #[must_use]
    pub fn parts(&self) -> usize {
        match self {
            Self::Mesh(mesh) => mesh.surfaces.len(),
            Self::Cuboid(_) => cuboid::FACES,
            Self::Placed(placed) => placed.shape().parts(),
            Self::Sphere(_) | Self::Quad(_) | Self::Superquadric(_) => 1,
        }
    }

    /// Lower and upper corner of its box; nothing for a whole plane.
    #[must_use]
    pub fn bounds(&self) -> Option<[DVec3; 2]> {
        match self {
            Self::Sphere(sphere) => Some(sphere.bounds()),
            Self::Quad(quad) => quad.bounds(),
            Self::Mesh(mesh) => (0..mesh.triangles.len() as u32)
                .map(|number| mesh.bounds(number))
                .reduce(|all, one| [all[0].min(one[0]), all[1].max(one[1])]),
            Self::Cuboid(cuboid) => Some(cuboid.bounds()),
            Self::Superquadric(superquadric) => Some(superquadric.bounds()),
            Self::Placed(placed) => Some(placed.bounds()),
        }
    }

    /// The largest coordinate, without its sign, that its points are computed from.
    #[must_use]
    pub fn extent(&self) -> f64 {
        let largest = |corners: [DVec3; 2]| corners[0].abs().max(corners[1].abs()).max_element();
        match self {
            Self::Sphere(sphere) => largest(sphere.bounds()),
            // Its edges say how far it goes, and not where it is.
            Self::Quad(quad) => quad.corner().abs().max_element(),
            Self::Mesh(mesh) => {
                let coordinates = mesh.positions.iter().flatten();
                coordinates.fold(0.0, |most: f64, &x| most.max(f64::from(x).abs()))
            }
            Self::Cuboid(cuboid) => largest(cuboid.bounds()),
            Self::Superquadric(superquadric) => largest(superquadric.bounds()),
            Self::Placed(placed) => placed.extent(),
        }
    }

    /// How its texture coordinates hang together.
    #[must_use]
    pub fn charts(&self) -> Charts {
        match self {
            Self::Sphere(sphere) => Charts::one(sphere.seam()),
            Self::Mesh(mesh) => Charts::of(mesh),
            Self::Superquadric(superquadric) => Charts::one(superquadric.seam()),
            Self::Placed(placed) => placed.shape().charts(),
            Self::Quad(_) | Self::Cuboid(_) => Charts::one(DVec2::ZERO),
        }
    }

    /// Whether its texture ends above and below in a pole, beyond which there is none of it.
    #[must_use]
    pub fn has_poles(&self) -> bool {
        match self {
            Self::Sphere(_) => true,
            Self::Superquadric(superquadric) => !superquadric.is_ring(),
            Self::Placed(placed) => placed.shape().has_poles(),
            Self::Quad(_) | Self::Mesh(_) | Self::Cuboid(_) => false,
        }
    }

    /// The shape moved, turned, stretched or mirrored; its outside stays its outside.
    ///
    /// Flat shapes have their corners and edges moved, in `f64`; those of a mesh are then rounded
    /// to `f32`, once. Others stay as they are, and rays are brought to them. A placement that
    /// changes nothing gives the shape itself.
    ///
    /// # Errors
    /// When coordinates of a mesh leave the range of `f32`, or edges of a rectangle become parallel.
    pub fn placed(self, placement: &Placement) -> Result<Self, PlacementError> {
        if placement.is_identity() {
            return Ok(self);
        }
        match self {
            Self::Quad(quad) => quad.placed(placement).map(Self::Quad),
            Self::Mesh(mesh) => mesh.placed(placement).map(Self::Mesh),
            curved => Ok(Self::Placed(Placed::new(curved, *placement))),
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
