//! The triangle mesh, with the coordinates exactly as its file holds them.

use super::{Placement, PlacementError, SurfacePoint, triangle};
use glam::{DVec2, DVec3};
use thiserror::Error;

/// Marks a corner without texture coordinates or normal.
pub const NONE: u32 = u32::MAX;

/// Triangles over shared positions, texture coordinates and normals.
///
/// Coordinates are the `f32` of the OBJ file; hits are found and refined on exactly those, in `f64`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Corner positions.
    pub positions: Vec<[f32; 3]>,
    /// Texture coordinates, across and up.
    pub uvs: Vec<[f32; 2]>,
    /// Shading normals; need not be unit.
    pub normals: Vec<[f32; 3]>,
    /// The triangles; a triangle's identity is its place here.
    pub triangles: Vec<Triangle>,
    /// What `usemtl` called the surfaces; `Triangle::surface` counts in here.
    pub surfaces: Vec<String>,
}

/// Three corners of a [`Mesh`]; each has three indices.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Triangle {
    /// Into `positions`.
    pub position: [u32; 3],
    /// Into `uvs`, or [`NONE`].
    pub uv: [u32; 3],
    /// Into `normals`, or [`NONE`].
    pub normal: [u32; 3],
    /// Into `surfaces`.
    pub surface: u32,
}

/// Why arrays are not a mesh.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum MeshError {
    /// There is nothing to see.
    #[error("found no triangles, expected at least one")]
    Empty,
    /// An index leads out of its array.
    #[error("triangle {triangle}: found index {index} into {count} {what}, expected less")]
    Index {
        /// Triangle, from 0.
        triangle: usize,
        /// What the index counts.
        what: &'static str,
        /// The index.
        index: u32,
        /// How many there are.
        count: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("{what} {index}: found a number that is not finite")]
    NotFinite {
        /// Which array.
        what: &'static str,
        /// Entry, from 0.
        index: usize,
    },
    /// More triangles than a picture can number.
    #[error("found {0} triangles, expected at most 4294967295")]
    TooMany(usize),
}

impl Mesh {
    /// Checks what the renderer relies on.
    ///
    /// # Errors
    /// When there are no triangles, an index leads nowhere or a number is not finite.
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

    /// It moved: coordinates are computed in `f64` and rounded once. In a mirror the corners of
    /// each triangle are turned round, so that its outside stays its outside.
    ///
    /// # Errors
    /// When a coordinate leaves the range of `f32`.
    pub fn placed(mut self, placement: &Placement) -> Result<Self, PlacementError> {
        for (number, position) in self.positions.iter_mut().enumerate() {
            let moved = placement.to_scene().transform_point3(as_dvec3(*position)).as_vec3();
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

    /// The three corners of a triangle.
    #[must_use]
    pub fn corners(&self, triangle: u32) -> [[f32; 3]; 3] {
        self.triangles[triangle as usize].position.map(|index| self.positions[index as usize])
    }

    /// The surface point with these weights of the second and third corner.
    #[must_use]
    pub fn surface_point(&self, triangle: u32, barycentric: [f64; 2]) -> SurfacePoint {
        let [b, c] = barycentric;
        let weights = [1.0 - b - c, b, c];
        let corners = &self.triangles[triangle as usize];
        let [p0, p1, p2] = corners.position.map(|i| as_dvec3(self.positions[i as usize]));
        let geometric_normal = (p1 - p0).cross(p2 - p0).normalize_or(DVec3::Y);
        let shading_normal = if corners.normal[0] == NONE {
            geometric_normal
        } else {
            let normals = corners.normal.map(|i| as_dvec3(self.normals[i as usize]));
            weighted(weights, normals).normalize_or(geometric_normal)
        };
        let uv = if corners.uv[0] == NONE {
            DVec2::ZERO
        } else {
            let uvs = corners.uv.map(|i| self.uvs[i as usize].map(f64::from));
            let [s, t] = [0, 1].map(|k| (0..3).map(|i| weights[i] * uvs[i][k]).sum());
            DVec2::new(s, t)
        };
        let position = weighted(weights, [p0, p1, p2]);
        SurfacePoint { position, geometric_normal, shading_normal, uv, part: corners.surface }
    }

    /// The gradients of a triangle's texture coordinates; zero if it has none or no area.
    #[must_use]
    pub fn uv_gradients(&self, triangle: u32) -> [DVec3; 2] {
        let corners = &self.triangles[triangle as usize];
        if corners.uv[0] == NONE {
            return [DVec3::ZERO; 2];
        }
        let [p0, p1, p2] = corners.position.map(|i| as_dvec3(self.positions[i as usize]));
        let uvs = corners.uv.map(|i| DVec2::from(self.uvs[i as usize].map(f64::from)));
        let (b, c) = (p1 - p0, p2 - p0);
        let normal = b.cross(c);
        let area_sq = normal.length_squared();
        if area_sq == 0.0 {
            return [DVec3::ZERO; 2];
        }
        // The gradients of the weights of the second and the third corner.
        let (by_b, by_c) = (c.cross(normal) / area_sq, normal.cross(b) / area_sq);
        let (along_b, along_c) = (uvs[1] - uvs[0], uvs[2] - uvs[0]);
        [along_b.x * by_b + along_c.x * by_c, along_b.y * by_b + along_c.y * by_c]
    }

    /// Lower and upper corner of a triangle's box.
    #[must_use]
    pub fn bounds(&self, triangle: u32) -> [DVec3; 2] {
        triangle::bounds(&self.corners(triangle))
    }
}

fn weighted(weights: [f64; 3], points: [DVec3; 3]) -> DVec3 {
    weights[0] * points[0] + weights[1] * points[1] + weights[2] * points[2]
}

fn as_dvec3(v: [f32; 3]) -> DVec3 {
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
            normals: vec![],
            triangles: vec![corner([0, 1, 2]), corner([0, 2, 3])],
            surfaces: vec![String::new()],
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
