//! The shapes of a scene, as one closed enum with a file for each kind.

mod changes;
pub mod charts;
mod closed;
pub mod cuboid;
mod gradient_changes;
mod in_triangle;
pub mod instance;
pub mod mesh;
pub mod offset;
pub mod placed;
pub mod placement;
pub mod quad;
pub mod smooth;
pub mod sphere;
pub mod superquadric;
pub mod triangle;
pub mod weld;

pub use changes::Changes;
pub use charts::Charts;
pub use cuboid::Cuboid;
pub use in_triangle::SmoothPoint;
pub use instance::{Instance, SharedMesh};
pub use mesh::Mesh;
pub use placed::Placed;
pub use placement::{Placement, PlacementError};
pub use quad::Quad;
pub use sphere::Sphere;
pub use superquadric::Superquadric;
pub use weld::Weld;

use glam::{DVec2, DVec3};

/// A shape of the scene.
///
/// A new shape provides, and the compiler leads to each `match`:
///
/// - a file in this folder, whose type has `intersect`, `surface_point`, `uv_gradients`, `changes`
///   and `bounds`, with the meaning of the methods of [`Shape`];
/// - answers of [`Shape`]: kind, faces, parts, extent, charts, poles, placement, and
///   [`Shape::is_closed`] (`closed.rs`). A shape without poles, seams and faces joins an existing arm;
/// - for an infinite shape, the half space that it encloses (`trace/volume.rs`, where only planes have
///   one);
/// - its key in scene files: a variant of [`ObjectFile`](crate::scene::file::ObjectFile), which states
///   what a new key provides;
/// - answers of `--check`: `contains` and `height` in `scene/check/solid.rs`, `None` where not computed;
/// - tests: the nearest hit equals a closed form; `uv_gradients` and `changes` equal differences
///   (`changes.rs`, `render/tests/differentials.rs`);
///   a ray that leaves the surface does not meet its start. Hits lie within `bounds`; a placed
///   shape equals the shape seen by a transformed ray (`placed.rs`); a scene in examples/ shows the
///   shape.
#[derive(Debug, Clone)]
pub enum Shape {
    /// A sphere.
    Sphere(Sphere),
    /// A rectangle or parallelogram, or a whole plane.
    Quad(Quad),
    /// A mesh of triangles.
    Mesh(Mesh),
    /// A box.
    Cuboid(Cuboid),
    /// A superellipsoid or supertoroid.
    Superquadric(Superquadric),
    /// A sphere, superquadric or box that is moved, rotated or stretched.
    Placed(Placed),
    /// A mesh that several objects share, in one of its places.
    Instance(Instance),
}

/// The properties of a ray's start on which intersections depend.
///
/// A ray that leaves a surface must not hit this surface at its start. Any other surface within
/// `skin` of the start coincides with it and is not hit there either.
#[derive(Debug, Clone, Copy)]
pub struct Start {
    /// The face of this shape that the ray leaves, if it leaves this shape.
    pub left_face: Option<u32>,
    /// Distance from the start, in scene units and perpendicular to the surface, that still counts
    /// as the start.
    pub skin: f64,
}

impl Shape {
    /// Returns the key of this kind of shape in a scene file.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Sphere(_) => "sphere",
            Self::Quad(quad) if quad.bounds().is_some() => "rectangle",
            Self::Quad(_) => "plane",
            Self::Mesh(_) | Self::Instance(_) => "mesh",
            Self::Cuboid(_) => "box",
            Self::Superquadric(_) => "superquadric",
            Self::Placed(placed) => placed.shape().kind(),
        }
    }

    /// Returns the mesh in its own space, if the shape is a mesh or an instance of one. The own space
    /// of a mesh is the scene's.
    #[must_use]
    pub fn mesh(&self) -> Option<&Mesh> {
        match self {
            Self::Mesh(mesh) => Some(mesh),
            Self::Instance(instance) => Some(instance.mesh()),
            Self::Sphere(_)
            | Self::Quad(_)
            | Self::Cuboid(_)
            | Self::Superquadric(_)
            | Self::Placed(_) => None,
        }
    }

    /// Returns the nearest distance above 0 at which a ray meets the shape, and the number of the
    /// face that it meets. The number is one of six on a box, and 0 on other shapes. `direction` is
    /// unit, and distances are in scene units.
    ///
    /// A mesh as a whole is never met; its triangles are tested one by one with
    /// [`triangle::ShearedRay`].
    #[must_use]
    pub fn intersect(&self, origin: DVec3, direction: DVec3, start: Start) -> Option<(f64, u32)> {
        let leaves = start.left_face.is_some();
        let only_face = |t: f64| (t, 0);
        match self {
            Self::Sphere(sphere) => {
                sphere.intersect(origin, direction, leaves, start.skin).map(only_face)
            }
            Self::Quad(_) if leaves => None,
            Self::Quad(quad) => quad.intersect(origin, direction, start.skin).map(only_face),
            Self::Mesh(_) | Self::Instance(_) => None,
            Self::Cuboid(cuboid) => cuboid.intersect(origin, direction, start),
            Self::Superquadric(superquadric) => {
                superquadric.intersect(origin, direction, start).map(only_face)
            }
            Self::Placed(placed) => placed.intersect(origin, direction, start),
        }
    }

    /// Returns the surface point at a hit, in scene space. On a mesh `number` is the triangle, and
    /// `barycentric` holds the weights of its second and third corner. On other shapes `number` is
    /// the face, and `near` is the hit as computed along the ray.
    #[must_use]
    pub fn surface_point(&self, number: u32, barycentric: [f64; 2], near: DVec3) -> SurfacePoint {
        match self {
            Self::Sphere(sphere) => sphere.surface_point(near),
            Self::Quad(quad) => quad.surface_point(near),
            Self::Mesh(mesh) => mesh.surface_point(number, barycentric),
            Self::Cuboid(cuboid) => cuboid.surface_point(number, near),
            Self::Superquadric(superquadric) => superquadric.surface_point(near),
            Self::Placed(placed) => placed.surface_point(number, near),
            Self::Instance(instance) => instance.surface_point(number, barycentric),
        }
    }

    /// Returns the unit normal of the surface itself at a hit, in scene space: that of
    /// [`Shape::surface_point`], to the last bit, for less work.
    #[must_use]
    pub fn geometric_normal(&self, number: u32, near: DVec3) -> DVec3 {
        match self {
            Self::Sphere(sphere) => sphere.normal(near),
            Self::Quad(quad) => quad.normal(),
            Self::Mesh(mesh) => mesh.normal(number),
            Self::Cuboid(cuboid) => cuboid.normal(number),
            Self::Superquadric(superquadric) => superquadric.normal(near),
            Self::Placed(placed) => placed.normal(number, near),
            Self::Instance(instance) => instance.normal(number),
        }
    }

    /// Returns the index of the object's part to which the triangle or face `number` belongs.
    #[must_use]
    pub fn part(&self, number: u32) -> u32 {
        match self {
            Self::Mesh(mesh) => mesh.triangles[number as usize].surface,
            Self::Cuboid(_) => number,
            Self::Placed(placed) => placed.shape().part(number),
            Self::Instance(instance) => instance.mesh().triangles[number as usize].surface,
            Self::Sphere(_) | Self::Quad(_) | Self::Superquadric(_) => 0,
        }
    }

    /// Returns the number of parts of the shape. Each part is a textured area of its own.
    #[must_use]
    pub fn parts(&self) -> usize {
        match self {
            Self::Mesh(mesh) => mesh.surfaces.len(),
            Self::Cuboid(_) => cuboid::FACES,
            Self::Placed(placed) => placed.shape().parts(),
            Self::Instance(instance) => instance.mesh().surfaces.len(),
            Self::Sphere(_) | Self::Quad(_) | Self::Superquadric(_) => 1,
        }
    }

    /// Lower and upper corner of the bounding box; `None` for a whole plane.
    #[must_use]
    pub fn bounds(&self) -> Option<[DVec3; 2]> {
        match self {
            Self::Sphere(sphere) => Some(sphere.bounds()),
            Self::Quad(quad) => quad.bounds(),
            Self::Mesh(mesh) => mesh.all_bounds(),
            Self::Cuboid(cuboid) => Some(cuboid.bounds()),
            Self::Superquadric(superquadric) => Some(superquadric.bounds()),
            Self::Placed(placed) => Some(placed.bounds()),
            Self::Instance(instance) => Some(instance.bounds()),
        }
    }

    /// Largest absolute value of the coordinates from which the shape's points are computed.
    #[must_use]
    pub fn extent(&self) -> f64 {
        let largest = |corners: [DVec3; 2]| corners[0].abs().max(corners[1].abs()).max_element();
        match self {
            Self::Sphere(sphere) => largest(sphere.bounds()),
            // The edges determine the size of the rectangle, and the corner its position.
            Self::Quad(quad) => quad.corner().abs().max_element(),
            Self::Mesh(mesh) => mesh.extent(),
            Self::Cuboid(cuboid) => largest(cuboid.bounds()),
            Self::Superquadric(superquadric) => largest(superquadric.bounds()),
            Self::Placed(placed) => placed.extent(),
            Self::Instance(instance) => instance.extent(),
        }
    }

    /// Returns the charts of the shape's texture coordinates.
    #[must_use]
    pub fn charts(&self) -> Charts {
        match self {
            Self::Sphere(sphere) => Charts::one(sphere.seam()),
            Self::Mesh(mesh) => Charts::of(mesh),
            Self::Superquadric(superquadric) => Charts::one(superquadric.seam()),
            Self::Placed(placed) => placed.shape().charts(),
            Self::Instance(instance) => instance.charts(),
            Self::Quad(_) | Self::Cuboid(_) => Charts::one(DVec2::ZERO),
        }
    }

    /// Returns whether the texture ends above and below in poles, beyond which it does not
    /// continue.
    #[must_use]
    pub fn has_poles(&self) -> bool {
        match self {
            Self::Sphere(_) => true,
            Self::Superquadric(superquadric) => !superquadric.is_ring(),
            Self::Placed(placed) => placed.shape().has_poles(),
            Self::Quad(_) | Self::Mesh(_) | Self::Cuboid(_) | Self::Instance(_) => false,
        }
    }

    /// Returns the shape moved, rotated, stretched or mirrored. Its outside stays its outside.
    ///
    /// The corners and edges of flat shapes are transformed in `f64`, and those of a mesh are then
    /// rounded once to `f32`. Other shapes stay unchanged, also the mesh of an instance, and rays are
    /// transformed to their own space. The identity returns the shape itself.
    ///
    /// # Errors
    /// If coordinates of a mesh leave the range of `f32`, or if the edges of a rectangle become
    /// parallel.
    pub fn placed(self, placement: &Placement) -> Result<Self, PlacementError> {
        if placement.is_identity() {
            return Ok(self);
        }
        match self {
            Self::Quad(quad) => quad.placed(placement).map(Self::Quad),
            Self::Mesh(mesh) => mesh.placed(placement).map(Self::Mesh),
            Self::Instance(instance) => instance.placed(placement).map(Self::Instance),
            curved @ (Self::Sphere(_)
            | Self::Cuboid(_)
            | Self::Superquadric(_)
            | Self::Placed(_)) => Ok(Self::Placed(Placed::new(curved, *placement))),
        }
    }
}

/// Position, normals and texture coordinates at a point of a shape.
#[derive(Debug, Clone, Copy)]
pub struct SurfacePoint {
    /// Position of the point, in scene space.
    pub position: DVec3,
    /// Unit normal of the surface itself. It points outward on closed shapes.
    pub geometric_normal: DVec3,
    /// Unit normal for shading: interpolated on a mesh, else the geometric normal.
    pub shading_normal: DVec3,
    /// Texture coordinates, across and up; a texture fills the unit square.
    pub uv: DVec2,
    /// Index of the object's part to which the point belongs.
    pub part: u32,
}

/// Period by which texture coordinates jump at a seam, across and up; 0 without a seam.
pub type SeamPeriod = DVec2;
