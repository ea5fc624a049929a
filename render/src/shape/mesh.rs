//! The triangle mesh, with coordinates exactly as in its file.
//!
//! Coordinates far from the origin, such as metres in a national grid, do not fit `f32`. Such a mesh has
//! an [`Mesh::offset`], from which its coordinates count.

use super::{Changes, Placement, PlacementError, SurfacePoint, offset, triangle};
use crate::differential;
use glam::{DVec2, DVec3};
use thiserror::Error;

/// Index of a corner without texture coordinates or normal.
pub const NONE: u32 = u32::MAX;

/// Triangles over shared positions, texture coordinates and normals.
///
/// Coordinates are the `f32` values of the OBJ file, plus the offset. Hits are found and refined on
/// exactly these sums, in `f64`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Origin of the positions, in scene space; zero for a mesh near the scene's origin.
    pub offset: DVec3,
    /// Corner positions from the offset, in the object's units.
    pub positions: Vec<[f32; 3]>,
    /// Colours of the positions, linear RGB; empty if the mesh has none.
    pub colors: Vec<[f32; 3]>,
    /// Texture coordinates, across and up; a texture fills the unit square.
    pub uvs: Vec<[f32; 2]>,
    /// Shading normals, which need not be unit.
    pub normals: Vec<[f32; 3]>,
    /// The triangles; a triangle is identified by its index.
    pub triangles: Vec<Triangle>,
    /// Names of the surfaces, as given by `usemtl`. [`Triangle::surface`] is an index into this
    /// list.
    pub surfaces: Vec<String>,
}

/// A triangle of a [`Mesh`], with indices for each of its three corners.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Triangle {
    /// Indices into [`Mesh::positions`].
    pub position: [u32; 3],
    /// Indices into [`Mesh::uvs`], or three times [`NONE`].
    pub uv: [u32; 3],
    /// Indices into [`Mesh::normals`], or three times [`NONE`].
    pub normal: [u32; 3],
    /// Index into [`Mesh::surfaces`].
    pub surface: u32,
}

/// The reason why arrays do not form a mesh.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum MeshError {
    /// The mesh has no triangles.
    #[error("found no triangles, expected at least one")]
    Empty,
    /// An index is outside its array.
    #[error("triangle {triangle}: found index {index} into {count} {what}, expected less")]
    Index {
        /// Index of the triangle, from 0.
        triangle: usize,
        /// Name of the array.
        what: &'static str,
        /// The index that was found.
        index: u32,
        /// Length of the array.
        count: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("{what} {index}: found a number that is not finite")]
    NotFinite {
        /// Name of the array.
        what: &'static str,
        /// Index of the entry, from 0.
        index: usize,
    },
    /// The mesh has more triangles than a picture can number.
    #[error("found {0} triangles, expected at most 4294967295")]
    TooMany(usize),
}

impl Mesh {
    /// Checks the properties on which the renderer relies.
    ///
    /// # Errors
    /// If there are no triangles or too many, if an index is outside its array, or if a number is
    /// not finite.
    pub fn check(&self) -> Result<(), MeshError> {
        if self.triangles.is_empty() {
            return Err(MeshError::Empty);
        }
        if self.triangles.len() >= NONE as usize {
            return Err(MeshError::TooMany(self.triangles.len()));
        }
        let finite3 =
            |values: &[[f32; 3]]| values.iter().position(|v| !v.iter().all(|x| x.is_finite()));
        let bad_uv = self.uvs.iter().position(|v| !v.iter().all(|x| x.is_finite()));
        let bad = [
            ("vertex", finite3(&self.positions)),
            ("normal", finite3(&self.normals)),
            ("vertex colour", finite3(&self.colors)),
            ("texture coordinate", bad_uv),
        ];
        if let Some((what, Some(index))) = bad.into_iter().find(|(_, bad)| bad.is_some()) {
            return Err(MeshError::NotFinite { what, index });
        }
        for (number, triangle) in self.triangles.iter().enumerate() {
            let arrays = [
                ("vertices", triangle.position, self.positions.len(), false),
                ("texture coordinates", triangle.uv, self.uvs.len(), true),
                ("normals", triangle.normal, self.normals.len(), true),
                ("surfaces", [triangle.surface; 3], self.surfaces.len(), false),
            ];
            for (what, indices, count, optional) in arrays {
                let strays =
                    |&index: &u32| index as usize >= count && !(optional && indices == [NONE; 3]);
                if let Some(index) = indices.into_iter().find(strays) {
                    return Err(MeshError::Index { triangle: number, what, index, count });
                }
            }
        }
        Ok(())
    }

    /// Returns the mesh, moved. Coordinates are computed in `f64` and rounded once, from a new offset if
    /// the mesh then lies far from the origin. If the placement mirrors, the order of each triangle's
    /// corners is reversed, so that its outside stays its outside.
    ///
    /// # Errors
    /// If a coordinate leaves the range of `f32`.
    pub fn placed(mut self, placement: &Placement) -> Result<Self, PlacementError> {
        let from = self.offset;
        let moved =
            |position: [f32; 3]| placement.to_scene().transform_point3(as_dvec3(position) + from);
        self.offset = offset::of(self.positions.iter().map(|&position| moved(position)));
        for (number, position) in self.positions.iter_mut().enumerate() {
            let moved = (moved(*position) - self.offset).as_vec3();
            if !moved.is_finite() {
                return Err(PlacementError::Far(number));
            }
            *position = moved.into();
        }
        for normal in &mut self.normals {
            *normal = placement.normal(as_dvec3(*normal)).normalize_or_zero().as_vec3().into();
        }
        if placement.mirrors() {
            for triangle in &mut self.triangles {
                for corners in [&mut triangle.position, &mut triangle.uv, &mut triangle.normal] {
                    corners.swap(1, 2);
                }
            }
        }
        Ok(self)
    }

    /// Returns the three corner positions of a triangle, from the mesh's offset.
    #[must_use]
    pub fn corners(&self, triangle: u32) -> [[f32; 3]; 3] {
        self.triangles[triangle as usize].position.map(|index| self.positions[index as usize])
    }

    /// Returns the three corner positions of a triangle in scene space.
    #[must_use]
    pub fn places(&self, triangle: u32) -> [DVec3; 3] {
        self.corners(triangle).map(|corner| as_dvec3(corner) + self.offset)
    }

    /// Returns the unit normal of a triangle's plane, on the side from which its corners turn left.
    #[must_use]
    pub fn normal(&self, triangle: u32) -> DVec3 {
        normal(self.corners(triangle).map(as_dvec3))
    }

    /// Returns the surface point with these barycentric weights of the second and third corner.
    #[must_use]
    pub fn surface_point(&self, triangle: u32, barycentric: [f64; 2]) -> SurfacePoint {
        let [b, c] = barycentric;
        let weights = [1.0 - b - c, b, c];
        let corners = &self.triangles[triangle as usize];
        let [p0, p1, p2] = corners.position.map(|i| as_dvec3(self.positions[i as usize]));
        let geometric_normal = normal([p0, p1, p2]);
        let shading_normal = match self.corner_normals(triangle) {
            None => geometric_normal,
            Some(normals) => weighted(weights, normals).normalize_or(geometric_normal),
        };
        let uv = if corners.uv[0] == NONE {
            DVec2::ZERO
        } else {
            let uvs = corners.uv.map(|i| self.uvs[i as usize].map(f64::from));
            let [s, t] = [0, 1].map(|k| (0..3).map(|i| weights[i] * uvs[i][k]).sum());
            DVec2::new(s, t)
        };
        let position = weighted(weights, [p0, p1, p2]) + self.offset;
        SurfacePoint { position, geometric_normal, shading_normal, uv, part: corners.surface }
    }

    /// Returns the gradients of a triangle's texture coordinates. They are zero if the triangle has
    /// no texture coordinates or no area.
    #[must_use]
    pub fn uv_gradients(&self, triangle: u32) -> [DVec3; 2] {
        let corners = &self.triangles[triangle as usize];
        if corners.uv[0] == NONE {
            return [DVec3::ZERO; 2];
        }
        let Some([by_b, by_c]) = self.weight_gradients(triangle) else { return [DVec3::ZERO; 2] };
        let [along_b, along_c] = self.uv_sides(corners);
        [along_b.x * by_b + along_c.x * by_c, along_b.y * by_b + along_c.y * by_c]
    }

    /// Returns changes as [`Shape::changes`](super::Shape::changes) does. They are zero on a triangle
    /// without area, and those of the normal also on a triangle without normals.
    #[must_use]
    pub fn changes(&self, triangle: u32, barycentric: [f64; 2], steps: [DVec3; 2]) -> Changes {
        self.changes_with(triangle, barycentric, steps, self.corner_normals(triangle))
    }

    /// Returns the normals at a triangle's corners as in the file, or `None` if it has none.
    pub(super) fn corner_normals(&self, triangle: u32) -> Option<[DVec3; 3]> {
        let normals = self.triangles[triangle as usize].normal;
        (normals[0] != NONE).then(|| normals.map(|i| as_dvec3(self.normals[i as usize])))
    }

    /// Returns changes as [`Mesh::changes`] does, with other normals at the corners.
    pub(super) fn changes_with(
        &self,
        triangle: u32,
        barycentric: [f64; 2],
        steps: [DVec3; 2],
        normals: Option<[DVec3; 3]>,
    ) -> Changes {
        let mut changes = Changes::default();
        let corners = &self.triangles[triangle as usize];
        let with_uv = corners.uv[0] != NONE;
        if !with_uv && normals.is_none() {
            return changes;
        }
        let Some([by_b, by_c]) = self.weight_gradients(triangle) else { return changes };
        let weights = steps.map(|step| [by_b.dot(step), by_c.dot(step)]);
        if with_uv {
            let [along_b, along_c] = self.uv_sides(corners);
            changes.uv = weights.map(|[b, c]| b * along_b + c * along_c);
        }
        if let Some(normals) = normals {
            let [b, c] = barycentric;
            let sum = weighted([1.0 - b - c, b, c], normals);
            if sum != DVec3::ZERO {
                let [along_b, along_c] = [normals[1] - normals[0], normals[2] - normals[0]];
                let of_sum = weights.map(|[b, c]| b * along_b + c * along_c);
                changes.normal = differential::normalized(sum, of_sum);
            }
        }
        changes
    }

    /// Returns the differences of a triangle's texture coordinates from the first corner to the
    /// second and to the third. The triangle has texture coordinates.
    fn uv_sides(&self, corners: &Triangle) -> [DVec2; 2] {
        let uvs = corners.uv.map(|i| DVec2::from(self.uvs[i as usize].map(f64::from)));
        [uvs[1] - uvs[0], uvs[2] - uvs[0]]
    }

    /// Returns the gradients of the barycentric weights of a triangle's second and third corner, or
    /// `None` if the triangle has no area.
    pub(super) fn weight_gradients(&self, triangle: u32) -> Option<[DVec3; 2]> {
        let [p0, p1, p2] = self.corners(triangle).map(as_dvec3);
        let (b, c) = (p1 - p0, p2 - p0);
        let normal = b.cross(c);
        let area_sq = normal.length_squared();
        (area_sq > 0.0).then(|| [c.cross(normal) / area_sq, normal.cross(b) / area_sq])
    }

    /// Lower and upper corner of the box around all triangles in scene space, or `None` without triangles.
    #[must_use]
    pub fn all_bounds(&self) -> Option<[DVec3; 2]> {
        let boxes = (0..self.triangles.len() as u32).map(|number| self.bounds(number));
        boxes.reduce(|all, one| [all[0].min(one[0]), all[1].max(one[1])])
    }

    /// Largest absolute value of a coordinate in scene space.
    #[must_use]
    pub fn extent(&self) -> f64 {
        let places = self.positions.iter().map(|&at| as_dvec3(at) + self.offset);
        places.fold(0.0, |most, place| place.abs().max_element().max(most))
    }

    /// Lower and upper corner of a triangle's bounding box, in scene space.
    #[must_use]
    pub fn bounds(&self, triangle: u32) -> [DVec3; 2] {
        triangle::bounds(&self.corners(triangle)).map(|corner| corner + self.offset)
    }
}

/// Unit normal of a triangle; up if it has no area.
fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a).normalize_or(DVec3::Y)
}

/// Sum of points with these weights.
pub(super) fn weighted(weights: [f64; 3], points: [DVec3; 3]) -> DVec3 {
    weights[0] * points[0] + weights[1] * points[1] + weights[2] * points[2]
}

/// Converts coordinates of a mesh to the precision of the arithmetic.
#[must_use]
pub fn as_dvec3(v: [f32; 3]) -> DVec3 {
    DVec3::new(f64::from(v[0]), f64::from(v[1]), f64::from(v[2]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A unit square in the plane z = 0 with texture coordinates up to `repeat`.
    fn square(repeat: f32) -> Mesh {
        let corner = |triangle: [u32; 3]| Triangle {
            position: triangle,
            uv: triangle,
            normal: [NONE; 3],
            surface: 0,
        };
        Mesh {
            positions: vec![[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]],
            uvs: vec![[0., 0.], [repeat, 0.], [repeat, repeat], [0., repeat]],
            triangles: vec![corner([0, 1, 2]), corner([0, 2, 3])],
            surfaces: vec![String::new()],
            ..Mesh::default()
        }
    }

    #[test]
    fn the_centre_of_gravity_maps_to_the_centre_of_gravity() {
        let point = square(3.0).surface_point(0, [1.0 / 3.0, 1.0 / 3.0]);
        assert!(point.position.abs_diff_eq(DVec3::new(2.0 / 3.0, 1.0 / 3.0, 0.0), 1e-15));
        assert!(point.uv.abs_diff_eq(DVec2::new(2.0, 1.0), 1e-15));
        assert_eq!(point.shading_normal, DVec3::Z);
    }

    #[test]
    fn broken_arrays_are_named() {
        let mut mesh = square(1.0);
        assert_eq!(mesh.check(), Ok(()));
        mesh.triangles[1].position[2] = 4;
        assert!(mesh.check().unwrap_err().to_string().contains("index 4 into 4 vertices"));
        mesh.positions[3][1] = f32::NAN;
        assert!(mesh.check().unwrap_err().to_string().starts_with("vertex 3"));
        assert_eq!(Mesh::default().check(), Err(MeshError::Empty));
    }
}
