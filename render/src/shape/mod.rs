//! The shapes of a scene, as one closed enum with a file for each kind.

pub mod charts;
mod closed;
pub mod cuboid;
pub mod mesh;
pub mod placed;
pub mod placement;
pub mod quad;
pub mod sphere;
pub mod superquadric;
pub mod triangle;
pub mod weld;

pub use charts::Charts;
pub use cuboid::Cuboid;
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
/// - a file in this folder, whose type has `intersect`, `surface_point`, `uv_gradients` and `bounds`,
///   with the meaning of the methods of [`Shape`];
/// - answers of [`Shape`]: kind, faces, parts, extent, charts, poles, placement, and
///   [`Shape::is_closed`] (`closed.rs`). A shape without poles, seams and faces joins an existing arm;
/// - for an infinite shape, the half space that it encloses (`trace/volume.rs`, where only planes have
///   one);
/// - its key in scene files: a variant of [`ObjectFile`](crate::scene::file::ObjectFile), which states
///   what a new key provides;
/// - answers of `--check`: `contains` and `height` in `scene/check/solid.rs`, `None` where not computed;
/// - tests: the nearest hit equals a closed form; `uv_gradients` equals differences (tests below);
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
            Self::Mesh(_) => "mesh",
            Self::Cuboid(_) => "box",
            Self::Superquadric(_) => "superquadric",
            Self::Placed(placed) => placed.shape().kind(),
        }
    }

    /// Returns the mesh, if the shape is one.
    #[must_use]
    pub fn mesh(&self) -> Option<&Mesh> {
        match self {
            Self::Mesh(mesh) => Some(mesh),
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
            Self::Mesh(_) => None,
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
        }
    }

    /// Returns the index of the object's part to which the triangle or face `number` belongs.
    #[must_use]
    pub fn part(&self, number: u32) -> u32 {
        match self {
            Self::Mesh(mesh) => mesh.triangles[number as usize].surface,
            Self::Cuboid(_) => number,
            Self::Placed(placed) => placed.shape().part(number),
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
            Self::Sphere(_) | Self::Quad(_) | Self::Superquadric(_) => 1,
        }
    }

    /// Lower and upper corner of the bounding box; `None` for a whole plane.
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

    /// Largest absolute value of the coordinates from which the shape's points are computed.
    #[must_use]
    pub fn extent(&self) -> f64 {
        let largest = |corners: [DVec3; 2]| corners[0].abs().max(corners[1].abs()).max_element();
        match self {
            Self::Sphere(sphere) => largest(sphere.bounds()),
            // The edges determine the size of the rectangle, and the corner its position.
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

    /// Returns the charts of the shape's texture coordinates.
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

    /// Returns whether the texture ends above and below in poles, beyond which it does not
    /// continue.
    #[must_use]
    pub fn has_poles(&self) -> bool {
        match self {
            Self::Sphere(_) => true,
            Self::Superquadric(superquadric) => !superquadric.is_ring(),
            Self::Placed(placed) => placed.shape().has_poles(),
            Self::Quad(_) | Self::Mesh(_) | Self::Cuboid(_) => false,
        }
    }

    /// Returns the shape moved, rotated, stretched or mirrored. Its outside stays its outside.
    ///
    /// The corners and edges of flat shapes are transformed in `f64`, and those of a mesh are then
    /// rounded once to `f32`. Other shapes stay unchanged, and rays are transformed to their own
    /// space. The identity returns the shape itself.
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
            curved @ (Self::Sphere(_)
            | Self::Cuboid(_)
            | Self::Superquadric(_)
            | Self::Placed(_)) => Ok(Self::Placed(Placed::new(curved, *placement))),
        }
    }

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
        }
    }

    /// Returns the changes of the unit normal for shading when the point of a hit moves by `steps`
    /// along the surface. The normal is that of [`Shape::surface_point`], and so are `number` and
    /// `barycentric`; `position` is the point. The changes are derivatives: those of steps of twice
    /// the length are twice as large.
    #[must_use]
    pub fn normal_changes(
        &self,
        number: u32,
        barycentric: [f64; 2],
        position: DVec3,
        steps: [DVec3; 2],
    ) -> [DVec3; 2] {
        match self {
            Self::Sphere(sphere) => steps.map(|step| step / sphere.radius),
            Self::Quad(_) | Self::Cuboid(_) => [DVec3::ZERO; 2],
            Self::Mesh(mesh) => mesh.normal_changes(number, barycentric, steps),
            Self::Superquadric(superquadric) => superquadric.normal_changes(position, steps),
            Self::Placed(placed) => placed.normal_changes(number, position, steps),
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

#[cfg(test)]
mod tests {
    use super::mesh::{NONE, Triangle};
    use super::*;
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
