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
//!   "quads": 18,
//!   "euler": 0,
//!   "boundary_loops": 2,
//!   "orientable": true,
//!   "oriented": true,
//!   "manifold": true,
//!   "closed": false,
//!   "edge_length": { "min": 0.5, "max": 0.875 },
//!   "triangle_area": { "min": 0.125, "max": 0.25 },
//!   "edge_ratio": 1.75,
//!   "worst_aspect": 2.5,
//!   "folds": { "worst": 0.25, "rows": 0, "fits": 1.25 },
//!   "tolerance": {
//!     "asked": 0.01, "reached": 0.008, "angle_asked_deg": 10.0, "angle_reached_deg": 7.5, "pixels": 0.5
//!   },
//!   "left_out": { "collapsed": 0, "slivers": 0 },
//!   "displacement": 5e-8,
//!   "box": { "low": [-1.0, -1.0, 0.0], "high": [1.0, 1.0, 2.0] },
//!   "patches": [
//!     {
//!       "object": "tube", "vertices": 24, "edges": 60, "faces": 36, "euler": 0, "boundary_loops": 2,
//!       "orientable": true, "manifold": true, "closed": false, "folds": null, "tolerance": null
//!     }
//!   ]
//! }
//! ```
//!
//! `vertices` to `closed` are those of [`Topology`]; `unused_vertices` are positions that are
//! written and that no triangle uses; `quads` are cells of the grid that became two triangles.
//! `edge_ratio` is the longest edge over the shortest. The aspect of a triangle is its longest edge over
//! the height on that edge: 1.155 for an equal-sided one, and `worst_aspect` the largest there is.
//! `folds` and `tolerance` are what the grid says of itself ([`Fold`], [`Tolerance`]), of all patches
//! together the worst; null where it says nothing. Lengths are in the grid's unit, measured in f64 between the
//! points as written, in f32. `displacement` is the farthest that rounding to f32 moved a point.
//! Extremes are null where there is nothing to measure. All but `patches` is of the mesh as a whole,
//! named for its first patch; patches that touch are not joined there.

use crate::topology::{Topology, edges_of, sides};
use crate::{Counts, Material, TriMesh};
use glam::DVec3;
use serde::Serialize;
use std::io::{self, Write};
use sweep::grid::{Fold, Tolerance};

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
    /// Cells that became two triangles.
    pub quads: u64,
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
    /// The longest edge over the shortest.
    pub edge_ratio: Option<f64>,
    /// The largest of longest edge over height on it.
    pub worst_aspect: Option<f64>,
    /// Where the surface folds back on itself.
    pub folds: Option<Fold>,
    /// How near to the surface the mesh is.
    pub tolerance: Option<Tolerance>,
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
#[derive(Debug, Clone, PartialEq, Serialize)]
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
    /// Where it folds back on itself.
    pub folds: Option<Fold>,
    /// How near to the surface it is.
    pub tolerance: Option<Tolerance>,
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
        let aspect = |corners: [u32; 3]| {
            let [a, b, c] = corners;
            let longest = length([a, b]).max(length([b, c])).max(length([c, a]));
            longest * longest / (2.0 * area(corners))
        };
        let edge_length = Extremes::of(edges_of(&sides).map(|edge| length(edge[0].ends)));
        let aspects = Extremes::of(mesh.triangles.iter().map(|t| aspect(t.position)));
        Self {
            format: "tb-mesh-report",
            version: 1,
            object: mesh.name.clone(),
            materials: MaterialReport::all_of(mesh),
            vertices: found.vertices,
            unused_vertices: mesh.positions.len() - found.vertices,
            edges: found.edges,
            faces: found.faces,
            quads: counts.quads,
            euler: found.euler(),
            boundary_loops: found.boundary_loops,
            orientable: found.orientable,
            oriented: found.oriented,
            manifold: found.manifold,
            closed: found.closed,
            edge_length,
            triangle_area: Extremes::of(mesh.triangles.iter().map(|t| area(t.position))),
            edge_ratio: edge_length.map(|Extremes { min, max }| max / min),
            worst_aspect: aspects.map(|aspects| aspects.max),
            folds: mesh.patches.iter().filter_map(|patch| patch.fold).reduce(Fold::and),
            tolerance: mesh
                .patches
                .iter()
                .filter_map(|patch| patch.tolerance)
                .reduce(Tolerance::and),
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
    fn of(mesh: &TriMesh) -> Self {
        let found = Topology::of(mesh);
        Self {
            object: mesh.name.clone(),
            vertices: found.vertices,
            edges: found.edges,
            faces: found.faces,
            euler: found.euler(),
            boundary_loops: found.boundary_loops,
            orientable: found.orientable,
            manifold: found.manifold,
            closed: found.closed,
            folds: mesh.patches.first().and_then(|patch| patch.fold),
            tolerance: mesh.patches.first().and_then(|patch| patch.tolerance),
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
        let fold = Fold { worst: -0.5, rows: 3, fits: Some(0.5) };
        let all = Some(0.5);
        let tolerance = Tolerance {
            asked: all,
            reached: all,
            angle_asked_deg: all,
            angle_reached_deg: all,
            pixels: all,
        };
        let mesh = TriMesh {
            name: "a \"b\"".into(),
            patches: vec![Patch {
                name: "a".into(),
                fold: Some(fold),
                tolerance: Some(tolerance),
                ..Patch::default()
            }],
            positions: vec![[1.0, 0.0, 0.0], [4.0, 0.0, 0.0], [1.0, 4.0, 0.0], [0.0, 0.0, -7.5]],
            triangles: vec![triangle],
            ..TriMesh::default()
        };
        let counts =
            Counts { quads: 7, collapsed: 3, slivers: 2, displacement: 0.25, ..Counts::default() };
        let mut text = Vec::new();
        MeshReport::of(&mesh, &counts).write(&mut text).unwrap();
        assert!(text.ends_with(b"}\n"));
        let json: Value = serde_json::from_slice(&text).unwrap();
        assert_eq!(json["object"], "a \"b\"");
        assert_eq!(json["edge_length"], serde_json::json!({ "min": 3.0, "max": 5.0 }));
        assert_eq!(json["triangle_area"], serde_json::json!({ "min": 6.0, "max": 6.0 }));
        // Sides 3, 4 and 5: the height on the longest is 12 / 5.
        let ratios = [&json["edge_ratio"], &json["worst_aspect"]].map(|x| x.as_f64().unwrap());
        assert!((ratios[0] - 5.0 / 3.0).abs() < 1e-12 && (ratios[1] - 25.0 / 12.0).abs() < 1e-12);
        assert_eq!((&json["quads"], &json["folds"]["worst"]), (&7.into(), &(-0.5).into()));
        assert_eq!(json["patches"][0]["folds"]["rows"], 3);
        assert_eq!(json["left_out"], serde_json::json!({ "collapsed": 3, "slivers": 2 }));
        assert_eq!(json["box"]["low"], serde_json::json!([0.0, 0.0, -7.5]));
        assert_eq!(json["box"]["high"], serde_json::json!([4.0, 4.0, 0.0]));
        assert_eq!((&json["unused_vertices"], &json["displacement"]), (&1.into(), &0.25.into()));

        let page = include_str!("report.rs").lines().map_while(|line| line.strip_prefix("//!"));
        let page = page.skip_while(|line| *line != " ```json").skip(1);
        let page: String = page.take_while(|line| *line != " ```").collect();
        // Of the patch, what it says of itself is left out on the page.
        let mut json = json;
        for key in ["folds", "tolerance"] {
            json["patches"][0][key] = Value::Null;
        }
        assert_eq!(keys(&json), keys(&serde_json::from_str(&page).unwrap()));
    }

    #[test]
    fn an_empty_mesh_has_nothing_to_measure() {
        let report = MeshReport::of(&TriMesh::default(), &Counts::default());
        assert_eq!((report.edge_length, report.triangle_area, report.bounds), (None, None, None));
    }
}
