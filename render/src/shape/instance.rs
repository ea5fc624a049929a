//! A mesh that several objects show, each in a place of its own.
//!
//! The mesh stays in its own space and exists once. Rays are transformed to that space, and hits are
//! transformed back. Positions are therefore computed in `f64` from the coordinates of the file, where
//! a placed copy ([`Mesh::placed`]) rounds each corner to `f32`.

use super::{Changes, Charts, Mesh, Placement, PlacementError, SurfacePoint, mesh};
use glam::DVec3;
use std::sync::{Arc, OnceLock};

/// Margin of the bounding box of an instance, in roundings of the largest coordinate.
const ROUNDINGS: f64 = 16.0;

/// A mesh for any number of instances, with properties that all of them share.
#[derive(Debug)]
pub struct SharedMesh {
    mesh: Mesh,
    bounds: [DVec3; 2],
    extent: f64,
    closed: OnceLock<bool>,
    charts: OnceLock<Charts>,
}

impl SharedMesh {
    /// Shares a mesh, which has at least one triangle.
    #[must_use]
    pub fn new(mesh: Mesh) -> Arc<Self> {
        let bounds = mesh.all_bounds().unwrap_or([DVec3::ZERO; 2]);
        let extent = mesh.extent();
        let (closed, charts) = (OnceLock::new(), OnceLock::new());
        Arc::new(Self { mesh, bounds, extent, closed, charts })
    }

    /// The mesh, in its own space.
    #[must_use]
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Largest absolute value of a coordinate, in own space.
    #[must_use]
    pub fn extent(&self) -> f64 {
        self.extent
    }
}

/// A shared mesh and its placement.
#[derive(Debug, Clone)]
pub struct Instance {
    shared: Arc<SharedMesh>,
    placement: Placement,
    /// Upper bound of the factor by which the map to own space lengthens a vector.
    growth: f64,
}

impl Instance {
    /// Places a shared mesh.
    #[must_use]
    pub fn new(shared: Arc<SharedMesh>, placement: Placement) -> Self {
        let columns = placement.to_own().matrix3.to_cols_array();
        let growth = columns.into_iter().map(|x| x * x).sum::<f64>().sqrt();
        Self { shared, placement, growth }
    }

    /// Returns the instance, moved.
    ///
    /// # Errors
    /// If both placements together are not valid.
    pub fn placed(self, placement: &Placement) -> Result<Self, PlacementError> {
        let both = Placement::new(placement.to_scene() * self.placement.to_scene())?;
        Ok(Self::new(self.shared, both))
    }

    /// The shared mesh.
    #[must_use]
    pub fn shared(&self) -> &SharedMesh {
        &self.shared
    }

    /// The mesh, in its own space.
    #[must_use]
    pub fn mesh(&self) -> &Mesh {
        &self.shared.mesh
    }

    /// The placement of the mesh.
    #[must_use]
    pub fn placement(&self) -> &Placement {
        &self.placement
    }

    /// Returns a number that instances have in common if, and only if, they share a mesh.
    #[must_use]
    pub fn key(&self) -> usize {
        Arc::as_ptr(&self.shared).addr()
    }

    /// Returns a length in own space that is not less than the image of any vector of this length in
    /// scene space.
    #[must_use]
    pub fn own_length(&self, length: f64) -> f64 {
        self.growth * length
    }

    /// Returns a ray in own space, with a unit direction, and the length of one scene unit along the ray
    /// in own units.
    #[must_use]
    pub fn own_ray(&self, origin: DVec3, direction: DVec3) -> (DVec3, DVec3, f64) {
        let to_own = self.placement.to_own();
        let along = to_own.transform_vector3(direction);
        let length = along.length();
        (to_own.transform_point3(origin), along / length, length)
    }

    /// Returns the unit normal of a triangle, in scene space.
    #[must_use]
    pub fn normal(&self, triangle: u32) -> DVec3 {
        self.turned(self.mesh().normal(triangle))
    }

    /// Returns a surface point as [`Mesh::surface_point`] does, in scene space.
    #[must_use]
    pub fn surface_point(&self, triangle: u32, barycentric: [f64; 2]) -> SurfacePoint {
        let own = self.mesh().surface_point(triangle, barycentric);
        let geometric_normal = self.turned(own.geometric_normal);
        let [b, c] = barycentric;
        let shading_normal = self.corner_normals(triangle).map_or(geometric_normal, |normals| {
            mesh::weighted([1.0 - b - c, b, c], normals).normalize_or(geometric_normal)
        });
        let position = self.placement.to_scene().transform_point3(own.position);
        SurfacePoint { position, geometric_normal, shading_normal, ..own }
    }

    /// Returns the normals at a triangle's corners, as a placed copy has them, or `None` if it has none.
    fn corner_normals(&self, triangle: u32) -> Option<[DVec3; 3]> {
        let own = self.mesh().corner_normals(triangle)?;
        let turned = |own: DVec3| self.placement.normal(own).normalize_or_zero();
        Some(if self.placement.is_identity() { own } else { own.map(turned) })
    }

    /// Returns gradients as [`Mesh::uv_gradients`] does, in scene space.
    #[must_use]
    pub fn uv_gradients(&self, triangle: u32) -> [DVec3; 2] {
        let normal = self.normal(triangle);
        self.mesh().uv_gradients(triangle).map(|own| {
            let gradient = self.placement.normal(own);
            gradient - gradient.dot(normal) * normal
        })
    }

    /// Returns changes as [`Mesh::changes`] does, in scene space.
    #[must_use]
    pub fn changes(&self, triangle: u32, barycentric: [f64; 2], steps: [DVec3; 2]) -> Changes {
        let to_own = self.placement.to_own();
        let own_steps = steps.map(|step| to_own.transform_vector3(step));
        // The weights of the corners change as in own space.
        self.mesh().changes_with(triangle, barycentric, own_steps, self.corner_normals(triangle))
    }

    fn turned(&self, normal: DVec3) -> DVec3 {
        self.placement.normal(normal).normalize_or(DVec3::Y)
    }

    /// Lower and upper corner of the placed box of the mesh, in scene space.
    #[must_use]
    pub fn box_of_mesh(&self) -> [DVec3; 2] {
        self.placement.bounds(self.shared.bounds)
    }

    /// Lower and upper corner of the bounding box, in scene space. It contains all roundings.
    #[must_use]
    pub fn bounds(&self) -> [DVec3; 2] {
        let [low, high] = self.box_of_mesh();
        let widening = ROUNDINGS * f64::EPSILON * self.extent();
        [low - widening, high + widening]
    }

    /// Largest absolute value of the coordinates from which the points of the surface are computed, in
    /// scene units.
    #[must_use]
    pub fn extent(&self) -> f64 {
        let own = DVec3::splat(self.shared.extent);
        let [low, high] = self.placement.bounds([-own, own]);
        low.abs().max(high.abs()).max_element()
    }

    /// Returns whether the mesh is closed.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        *self.shared.closed.get_or_init(|| self.mesh().is_closed())
    }

    /// Returns the charts of the mesh, which are found once for all instances.
    #[must_use]
    pub fn charts(&self) -> Charts {
        self.shared.charts.get_or_init(|| Charts::of(self.mesh())).clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::mesh::{Triangle, as_dvec3};
    use glam::{DAffine3, DMat3, DVec2};
    use proptest::prelude::*;

    /// A bent square with texture coordinates and normals.
    fn mesh() -> Mesh {
        let corner = |triangle: [u32; 3]| Triangle {
            position: triangle,
            uv: triangle,
            normal: triangle,
            surface: 0,
        };
        Mesh {
            positions: vec![[0., 0., 0.], [1., 0., 0.25], [1., 1., 0.], [0., 1., 0.5]],
            uvs: vec![[0., 0.], [2., 0.], [2., 1.], [0., 1.]],
            normals: vec![[0., 0., 1.], [0.25, 0., 1.], [0., 0.5, 1.], [0., 0., 2.]],
            triangles: vec![corner([0, 1, 2]), corner([0, 2, 3])],
            surfaces: vec![String::new()],
            ..Mesh::default()
        }
    }

    fn vector(size: f64) -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-size..size).prop_map(DVec3::from)
    }

    /// Rotated, sheared, stretched, mirrored and moved placements, not flatter than a tenth.
    fn placement() -> impl Strategy<Value = Placement> {
        let linear = (vector(2.0), vector(2.0), vector(2.0));
        (linear, vector(10.0)).prop_filter_map("not flat", |((x, y, z), shift)| {
            let linear = DMat3::from_cols(x, y, z);
            let thick = linear.determinant().abs() > 0.1;
            thick.then(|| Placement::new(DAffine3::from_mat3_translation(linear, shift)).unwrap())
        })
    }

    proptest! {
        /// An instance has the points, normals, gradients and changes of a placed copy, up to the
        /// rounding of the copy's corners. The order of a mirrored copy's corners is reversed.
        #[test]
        fn an_instance_is_a_copy_that_is_not_rounded(
            placement in placement(), triangle in 0u32..2, b in 0.05..0.45f64, c in 0.05..0.45f64,
            steps in prop::array::uniform2(vector(1.0)),
        ) {
            let instance = Instance::new(SharedMesh::new(mesh()), placement);
            let copy = mesh().placed(&placement).unwrap();
            let own = [b, c];
            let swapped = if placement.mirrors() { [c, b] } else { own };
            let (one, other) =
                (instance.surface_point(triangle, own), copy.surface_point(triangle, swapped));
            // Corners up to 13 units are rounded to 1e-6, and normals of triangles that are a tenth
            // as thick to a hundred times as much.
            prop_assert!(one.position.distance(other.position) < 2e-6);
            prop_assert!(one.geometric_normal.distance(other.geometric_normal) < 1e-3);
            prop_assert!(one.shading_normal.distance(other.shading_normal) < 1e-3);
            prop_assert!(one.uv.distance(other.uv) < 1e-14);
            prop_assert_eq!(one.geometric_normal, instance.normal(triangle));
            let [low, high] = instance.bounds();
            prop_assert!(one.position.cmpge(low).all() && one.position.cmple(high).all());
            prop_assert!(instance.extent() >= one.position.abs().max_element());

            // Steps along the surface. A gradient is as steep as the triangle is small.
            let normal = one.geometric_normal;
            let along = steps.map(|step| step - step.dot(normal) * normal);
            let [mine, copied] =
                [instance.uv_gradients(triangle), copy.uv_gradients(triangle)];
            let changes = instance.changes(triangle, own, along);
            for (step, change) in along.iter().zip(changes.uv) {
                let du = DVec2::from(mine.map(|gradient| gradient.dot(*step)));
                let others = DVec2::from(copied.map(|gradient| gradient.dot(*step)));
                let size = 1.0 + mine[0].length() + mine[1].length();
                prop_assert!(du.distance(others) < 1e-3 * size * size, "{du} {others}");
                prop_assert!(change.distance(du) < 1e-9 * size);
            }
            // The change of the normal is the derivative along the step, by differences.
            let to_own = placement.to_own();
            let corners = mesh().corners(triangle).map(as_dvec3);
            let sides = DMat3::from_cols(
                corners[1] - corners[0], corners[2] - corners[0], mesh().normal(triangle));
            for (step, change) in along.iter().zip(changes.normal) {
                let own = to_own.transform_vector3(*step);
                let h = 1e-6 / (1.0 + own.length());
                let moved = sides.inverse() * (h * own);
                let there = instance.surface_point(triangle, [b + moved.x, c + moved.y]);
                let truth = (there.shading_normal - one.shading_normal) / h;
                prop_assert!(truth.distance(change) < 1e-3 * (1.0 + truth.length()));
            }
        }
    }

    #[test]
    fn instances_share_one_mesh() {
        let shared = SharedMesh::new(mesh());
        let far = Placement::new(DAffine3::from_translation(DVec3::X)).unwrap();
        let [a, b] = [Placement::identity(), far].map(|at| Instance::new(shared.clone(), at));
        assert_eq!(a.key(), b.key());
        assert_ne!(a.key(), Instance::new(SharedMesh::new(mesh()), far).key());
        assert!(!a.is_closed());
        assert_eq!(a.charts(), Charts::of(&mesh()));
    }
}
