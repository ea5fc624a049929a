//! Triangles in memory.

use crate::Options;
use crate::obj::object_name;
use crate::triangulator::Sink;

/// A mesh of triangles; flat arrays that indices point into, as in OBJ, but from 0.
///
/// Positions, texture coordinates and normals are shared separately: a vertex on a seam is one
/// position with two texture coordinates, on a crease one position with two normals.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TriMesh {
    /// The object's name, one word.
    pub name: String,
    /// The texture id of all triangles; 0 is none.
    pub texture: u32,
    /// The surface id of all triangles.
    pub surface: u32,
    /// Points in the grid's unit.
    pub positions: Vec<[f32; 3]>,
    /// Picture coordinates from the lower left corner, one picture to the unit; they repeat.
    pub uvs: Vec<[f32; 2]>,
    /// Unit normals, outward.
    pub normals: Vec<[f32; 3]>,
    /// Triangles in the order of rows, then columns.
    pub triangles: Vec<Triangle>,
}

/// A triangle, counter-clockwise seen from outside: three indices, from 0, into each array.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Triangle {
    /// Into the positions.
    pub position: [u32; 3],
    /// Into the picture coordinates.
    pub uv: [u32; 3],
    /// Into the normals.
    pub normal: [u32; 3],
}

impl TriMesh {
    /// A mesh without triangles yet; `name` becomes one word.
    #[must_use]
    pub fn new(name: &str, options: &Options) -> Self {
        Self {
            name: object_name(name),
            texture: options.texture,
            surface: options.surface,
            ..Self::default()
        }
    }
}

impl Sink for TriMesh {
    fn position(&mut self, position: [f32; 3]) {
        self.positions.push(position);
    }

    fn uv(&mut self, uv: [f32; 2]) {
        self.uvs.push(uv);
    }

    fn normal(&mut self, normal: [f32; 3]) {
        self.normals.push(normal);
    }

    fn triangle(&mut self, triangle: &Triangle) {
        self.triangles.push(*triangle);
    }
}
