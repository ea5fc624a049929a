//! The triangle mesh in memory.

use crate::Material;
use crate::obj::object_name;
use crate::triangulator::Sink;
use std::collections::{HashMap, HashSet};
use std::ops::Range;
use sweep::grid::file::Header;
use sweep::grid::{Fold, Tolerance};

/// A mesh of triangles: flat arrays with indices into them as in OBJ, but counted from 0.
///
/// Positions, texture coordinates and normals have separate indices. A vertex on a seam is one position
/// with two texture coordinates; a vertex on a crease is one position with two normals. The patches of
/// an object share no vertices.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TriMesh {
    /// The object's name, one word: the name of its first patch.
    pub name: String,
    /// The patches in their order. An empty list means one patch of all triangles.
    pub patches: Vec<Patch>,
    /// The runs of one material, in the order of triangles. Triangles before the first run have no
    /// texture and surface 0.
    pub runs: Vec<Run>,
    /// Points in the grid's unit.
    pub positions: Vec<[f32; 3]>,
    /// Picture coordinates from the lower left corner; one unit is one repeat of the picture.
    pub uvs: Vec<[f32; 2]>,
    /// Unit normals, outward.
    pub normals: Vec<[f32; 3]>,
    /// Triangles ordered by patch, then by row, then by material, then by column.
    pub triangles: Vec<Triangle>,
}

/// A triangle, counter-clockwise seen from outside: three indices into each array, from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Triangle {
    /// Indices into the positions.
    pub position: [u32; 3],
    /// Indices into the picture coordinates.
    pub uv: [u32; 3],
    /// Indices into the normals.
    pub normal: [u32; 3],
}

/// A patch of a mesh: the triangles from index `first` up to the `first` of the next patch.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Patch {
    /// The name of the patch, one word.
    pub name: String,
    /// The index of the first triangle of the patch, from 0.
    pub first: usize,
    /// How far the patch folds back on itself, if its grid records this.
    pub fold: Option<Fold>,
    /// How near the patch is to the exact surface, if its grid records this.
    pub tolerance: Option<Tolerance>,
}

/// Triangles of one material: those from index `first` up to the `first` of the next run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Run {
    /// The material that the triangles are bound to.
    pub material: Material,
    /// The index of the first triangle of the run, from 0.
    pub first: usize,
}

impl TriMesh {
    /// Returns an upper bound of the bytes for the mesh of a grid of `points` points. The mesh has
    /// three arrays of vertices and two triangles to a cell, in lists that grow by doubling.
    #[must_use]
    pub fn bytes_for(points: u64) -> u64 {
        const VERTEX: u64 = (3 + 2 + 3) * size_of::<f32>() as u64;
        const CELL: u64 = 2 * size_of::<Triangle>() as u64;
        points.saturating_mul(2 * (VERTEX + CELL))
    }

    /// Returns the materials of all triangles, ordered by the first triangle of each material.
    #[must_use]
    pub fn materials(&self) -> Vec<Material> {
        let mut known = HashSet::new();
        let mut materials = Vec::new();
        for (material, triangles) in self.runs() {
            if !triangles.is_empty() && known.insert(material) {
                materials.push(material);
            }
        }
        materials
    }

    /// Returns for each triangle the index of its material in [`TriMesh::materials`].
    #[must_use]
    pub fn material_numbers(&self) -> Vec<u32> {
        let materials = self.materials();
        let numbers: HashMap<Material, u32> = materials.into_iter().zip(0..).collect();
        let of_run = |(material, triangles): (Material, Range<usize>)| {
            std::iter::repeat_n(numbers.get(&material).copied().unwrap_or(0), triangles.len())
        };
        self.runs().flat_map(of_run).collect()
    }

    /// Returns the triangles of patch `number`, from 0, with the vertices of all patches, as a mesh of
    /// one patch.
    ///
    /// # Panics
    /// When there is no patch `number`.
    #[must_use]
    pub fn of_patch(&self, number: usize) -> Self {
        let patch = self.patches[number].clone();
        let first = patch.first;
        let end = self.patches.get(number + 1).map_or(self.triangles.len(), |patch| patch.first);
        let within = |(material, triangles): (Material, Range<usize>)| {
            let (from, to) = (triangles.start.max(first), triangles.end.min(end));
            (from < to).then(|| Run { material, first: from - first })
        };
        Self {
            name: patch.name.clone(),
            patches: vec![Patch { first: 0, ..patch }],
            runs: self.runs().filter_map(within).collect(),
            triangles: self.triangles[first..end].to_vec(),
            positions: self.positions.clone(),
            uvs: self.uvs.clone(),
            normals: self.normals.clone(),
        }
    }

    /// Returns the runs one after another, each as a material and a range of triangle indices.
    fn runs(&self) -> impl Iterator<Item = (Material, Range<usize>)> {
        let ends = self.runs.iter().map(|run| run.first).chain([self.triangles.len()]);
        let materials = self.runs.iter().map(|run| (run.material, run.first));
        std::iter::once((Material::default(), 0))
            .chain(materials)
            .zip(ends)
            .map(|((material, first), end)| (material, first..end))
    }
}

impl Sink for TriMesh {
    fn patch(&mut self, header: &Header) {
        let name = object_name(&header.name);
        if self.patches.is_empty() {
            self.name.clone_from(&name);
        }
        let Header { fold, tolerance, .. } = *header;
        self.patches.push(Patch { name, first: self.triangles.len(), fold, tolerance });
    }

    fn material(&mut self, material: Material) {
        let first = self.triangles.len();
        self.runs.pop_if(|run| run.first == first);
        if self.runs.last().is_none_or(|run| run.material != material) {
            self.runs.push(Run { material, first });
        }
    }

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

#[cfg(test)]
mod tests {
    use super::*;

    fn material(texture: u32) -> Material {
        Material { texture, surface: 0 }
    }

    #[test]
    fn materials_are_numbered_as_triangles_first_have_them() {
        let mut mesh = TriMesh::default();
        let mut add = |texture: Option<u32>, triangles: usize| {
            if let Some(texture) = texture {
                mesh.material(material(texture));
            }
            for _ in 0..triangles {
                mesh.triangle(&Triangle { position: [0; 3], uv: [0; 3], normal: [0; 3] });
            }
        };
        add(None, 1);
        add(Some(7), 0);
        add(Some(5), 2);
        add(Some(5), 1);
        add(Some(0), 1);
        add(Some(6), 0);
        assert_eq!(mesh.runs.len(), 3);
        assert_eq!(mesh.materials(), [material(0), material(5)]);
        assert_eq!(mesh.material_numbers(), [0, 1, 1, 1, 0]);
    }

    #[test]
    fn a_patch_has_its_triangles_and_their_materials() {
        let mut mesh = TriMesh::default();
        for texture in 1..4 {
            mesh.patch(&Header { name: format!("a {texture}"), ..Header::default() });
            for texture in [0, texture] {
                mesh.material(material(texture));
                mesh.triangle(&Triangle { position: [texture; 3], uv: [0; 3], normal: [0; 3] });
            }
        }
        assert_eq!(mesh.name, "a_1");
        for number in 0..3 {
            let patch = mesh.of_patch(number);
            let texture = number as u32 + 1;
            assert_eq!((patch.name.as_str(), patch.triangles.len()), (&*format!("a_{texture}"), 2));
            assert_eq!(patch.materials(), [material(0), material(texture)]);
            assert_eq!(patch.triangles[1].position, [texture; 3]);
        }
    }
}
