//! What a mesh is like, for people and for programs: a JSON report.
//!
//! ```json
//! {
//!   "format": "tb-mesh-report",
//!   "version": 1,
//!   "object": "tube",
//!   "materials": [{ "texture": 0, "surface": 0, "faces": 36 }],
//!   "vertices": 24,
//!   "unused_vertices": 0,
//!   "edges": 60,
//!   "faces": 36,
//!   "euler": 0,
//!   "boundary_loops": 2,
//!   "orientable": true,
//!   "oriented": true,
//!   "manifold": true,
//!   "closed": false,
//!   "edge_length": { "min": 0.5, "max": 0.875 },
//!   "triangle_area": { "min": 0.125, "max": 0.25 },
//!   "left_out": { "collapsed": 0, "slivers": 0 },
//!   "displacement": 5e-8,
//!   "box": { "low": [-1.0, -1.0, 0.0], "high": [1.0, 1.0, 2.0] },
//!   "patches": [
//!     {
//!       "object": "tube", "vertices": 24, "edges": 60, "faces": 36, "euler": 0, "boundary_loops": 2,
//!       "orientable": true, "manifold": true, "closed": false
//!     }
//!   ]
//! }
//! ```
//!
//! `vertices` to `closed` are those of [`Topology`]; `unused_vertices` are positions that are
//! written and that no triangle uses. Lengths are in the grid's unit, measured in f64 between the
//! points as written, in f32. `displacement` is the farthest that rounding to f32 moved a point.
//! Extremes are null where there is nothing to measure. All but `patches` is of the mesh as a whole,
//! named for its first patch; patches that touch are not joined there.

use crate::topology::{Topology, edges_of, sides};
use crate::{Counts, Material, TriMesh};
use glam::DVec3;
use serde::Serialize;
use std::io::{self, Write};

/// What a mesh is like.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeshReport {
    /// What the file is: `tb-mesh-report`.
    pub format: &'static str,
    /// The version of the format: 1.
    pub version: u32,
    /// The object's name.
    pub object: String,
    /// What triangles are bound to, in the order in which they first are.
    pub materials: Vec<MaterialReport>,
    /// Positions that triangles use.
    pub vertices: usize,
    /// Positions that none uses.
    pub unused_vertices: usize,
    /// Edges.
    pub edges: usize,
    /// Triangles.
    pub faces: usize,
    /// Vertices - edges + faces.
    pub euler: i64,
    /// Rims.
    pub boundary_loops: usize,
    /// Whether it has two sides.
    pub orientable: bool,
    /// Whether neighbouring triangles face the same side as they are.
    pub oriented: bool,
    /// Whether it is a surface around every point.
    pub manifold: bool,
    /// Whether it has no rim.
    pub closed: bool,
    /// Lengths of edges.
    pub edge_length: Option<Extremes>,
    /// Areas of triangles.
    pub triangle_area: Option<Extremes>,
    /// Triangles of the grid that are not in the mesh.
    pub left_out: LeftOut,
    /// The farthest that rounding to f32 moved a point.
    pub displacement: f64,
    /// The box around all positions.
    #[serde(rename = "box")]
    pub bounds: Option<Bounds>,
    /// The patches, each by itself.
    pub patches: Vec<PatchReport>,
}

/// A material and how much has it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct MaterialReport {
    /// The texture id; 0 is none.
    pub texture: u32,
    /// The surface id.
    pub surface: u32,
    /// Triangles.
    pub faces: usize,
}

/// What a patch is like.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct PatchReport {
    /// Its name.
    pub object: String,
    /// Positions that its triangles use.
    pub vertices: usize,
    /// Edges.
    pub edges: usize,
    /// Triangles.
    pub faces: usize,
    /// Vertices - edges + faces.
    pub euler: i64,
    /// Rims.
    pub boundary_loops: usize,
    /// Whether it has two sides.
    pub orientable: bool,
    /// Whether it is a surface around every point.
    pub manifold: bool,
    /// Whether it has no rim.
    pub closed: bool,
}

/// The smallest and the largest of something.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Extremes {
    /// The smallest.
    pub min: f64,
    /// The largest.
    pub max: f64,
}

/// How many triangles were left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct LeftOut {
    /// Because two corners are one point, as at poles and creases.
    pub collapsed: u64,
    /// Because all three corners lie on a line.
    pub slivers: u64,
}

/// A box along the axes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bounds {
    /// Its lowest corner.
    pub low: [f32; 3],
    /// Its highest corner.
    pub high: [f32; 3],
}

impl MeshReport {
    /// Looks at a mesh; `counts` are those of its making.
    ///
    /// # Panics
    /// When an index of the mesh points nowhere; [`TriMesh::validate`] tells.
    #[must_use]
    pub fn of(mesh: &TriMesh, counts: &Counts) -> Self {
        let sides = sides(mesh);
        let found = Topology::of_sides(mesh, &sides);
        let point = |index: u32| DVec3::from(mesh.positions[index as usize].map(f64::from));
        let length = |[from, to]: [u32; 2]| point(from).distance(point(to));
        let area = |corners: [u32; 3]| {
            let [a, b, c] = corners.map(point);
            0.5 * (b - a).cross(c - a).length()
        };
        Self {
            format: "tb-mesh-report",
            version: 1,
            object: mesh.name.clone(),
            materials: MaterialReport::all_of(mesh),
            vertices: found.vertices,
            unused_vertices: mesh.positions.len() - found.vertices,
            edges: found.edges,
            faces: found.faces,
            euler: found.euler(),
            boundary_loops: found.boundary_loops,
            orientable: found.orientable,
            oriented: found.oriented,
            manifold: found.manifold,
            closed: found.closed,
            edge_length: Extremes::of(edges_of(&sides).map(|edge| length(edge[0].ends))),
            triangle_area: Extremes::of(mesh.triangles.iter().map(|t| area(t.position))),
            left_out: LeftOut { collapsed: counts.collapsed, slivers: counts.slivers },
            displacement: counts.displacement,
            bounds: Bounds::of(&mesh.positions),
            patches: (0..mesh.patches.len()).map(|k| PatchReport::of(&mesh.of_patch(k))).collect(),
        }
    }

    /// Writes the report as JSON, with a line break at its end.
    ///
    /// # Errors
    /// When the output fails.
    pub fn write(&self, mut out: impl Write) -> io::Result<()> {
        serde_json::to_writer_pretty(&mut out, self)?;
        writeln!(out)
    }
}

impl MaterialReport {
    fn all_of(mesh: &TriMesh) -> Vec<Self> {
        let of_one = |Material { texture, surface }| Self { texture, surface, faces: 0 };
        let mut all: Vec<Self> = mesh.materials().into_iter().map(of_one).collect();
        for number in mesh.material_numbers() {
            all[number as usize].faces += 1;
        }
        all
    }
}

impl PatchReport {
    fn of(patch: &TriMesh) -> Self {
        let found = Topology::of(patch);
        Self {
            object: patch.name.clone(),
            vertices: found.vertices,
            edges: found.edges,
            faces: found.faces,
            euler: found.euler(),
            boundary_loops: found.boundary_loops,
            orientable: found.orientable,
            manifold: found.manifold,
            closed: found.closed,
        }
    }
}

impl Extremes {
    fn of(numbers: impl Iterator<Item = f64>) -> Option<Self> {
        numbers.fold(None, |extremes: Option<Self>, x| match extremes {
            None => Some(Self { min: x, max: x }),
            Some(Self { min, max }) => Some(Self { min: min.min(x), max: max.max(x) }),
        })
    }
}

impl Bounds {
    fn of(positions: &[[f32; 3]]) -> Option<Self> {
        let (&first, rest) = positions.split_first()?;
        let widen = |Self { low, high }: Self, point: &[f32; 3]| Self {
            low: [0, 1, 2].map(|i| low[i].min(point[i])),
            high: [0, 1, 2].map(|i| high[i].max(point[i])),
        };
        Some(rest.iter().fold(Self { low: first, high: first }, widen))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Triangle;
    use crate::tri_mesh::Patch;
    use serde_json::Value;

    fn keys(value: &Value) -> Vec<String> {
        let object = value.as_object().into_iter().flatten();
        let of_object = object.flat_map(|(key, value)| [vec![key.clone()], keys(value)].concat());
        let of_list = value.as_array().into_iter().flatten().flat_map(keys);
        of_object.chain(of_list).collect()
    }

    #[test]
    fn a_right_triangle_has_its_sides_and_its_area_and_the_keys_of_the_page_above() {
        let triangle = Triangle { position: [0, 1, 2], uv: [0; 3], normal: [0; 3] };
        let mesh = TriMesh {
            name: "a \"b\"".into(),
            patches: vec![Patch { name: "a".into(), first: 0 }],
            positions: vec![[1.0, 0.0, 0.0], [4.0, 0.0, 0.0], [1.0, 4.0, 0.0], [0.0, 0.0, -7.5]],
            triangles: vec![triangle],
            ..TriMesh::default()
        };
        let counts = Counts { collapsed: 3, slivers: 2, displacement: 0.25, ..Counts::default() };
        let mut text = Vec::new();
        MeshReport::of(&mesh, &counts).write(&mut text).unwrap();
        assert!(text.ends_with(b"}\n"));
        let json: Value = serde_json::from_slice(&text).unwrap();
        assert_eq!(json["object"], "a \"b\"");
        assert_eq!(json["edge_length"], serde_json::json!({ "min": 3.0, "max": 5.0 }));
        assert_eq!(json["triangle_area"], serde_json::json!({ "min": 6.0, "max": 6.0 }));
        assert_eq!(json["left_out"], serde_json::json!({ "collapsed": 3, "slivers": 2 }));
        assert_eq!(json["box"]["low"], serde_json::json!([0.0, 0.0, -7.5]));
        assert_eq!(json["box"]["high"], serde_json::json!([4.0, 4.0, 0.0]));
        assert_eq!((&json["unused_vertices"], &json["displacement"]), (&1.into(), &0.25.into()));

        let page = include_str!("report.rs").lines().map_while(|line| line.strip_prefix("//!"));
        let page = page.skip_while(|line| *line != " ```json").skip(1);
        let page: String = page.take_while(|line| *line != " ```").collect();
        assert_eq!(keys(&json), keys(&serde_json::from_str(&page).unwrap()));
    }

    #[test]
    fn an_empty_mesh_has_nothing_to_measure() {
        let report = MeshReport::of(&TriMesh::default(), &Counts::default());
        assert_eq!((report.edge_length, report.triangle_area, report.bounds), (None, None, None));
    }
}
