//! Measures a mesh and reports the result as JSON.
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
//!   "merged": { "vertices": 24, "manifold": true, "closed": false },
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
//! The values from `vertices` to `closed` are those of [`Topology`]. `merged` are the same values after vertices in
//! one place are merged, as readers of STL do ([`Merged`]). `unused_vertices` is the number of
//! positions that are written but used by no triangle. `quads` is the number of grid cells that became
//! two triangles. `edge_ratio` is the longest edge over the shortest. The aspect of a triangle is its
//! longest edge over the height on that edge, 1.155 for an equilateral triangle; `worst_aspect` is the
//! largest aspect in the mesh. `folds` and `tolerance` are copied from the grid ([`Fold`],
//! [`Tolerance`]) and combined to the worst of all patches; both are null where the grid holds none.
//! Lengths are in the grid's unit, measured in f64 between the points as written in f32. `displacement`
//! is the largest distance by which rounding to f32 moved a point. Extremes are null where there is
//! nothing to measure. All values but `patches` describe the whole mesh, which has the name of its
//! first patch. Patches that touch are not joined in the topology.

use crate::merged::Merged;
use crate::topology::{Topology, edges_of, sides};
use crate::{Counts, Material, TriMesh};
use glam::DVec3;
use serde::Serialize;
use std::io::{self, Write};
use sweep::grid::{Fold, Tolerance};

/// The report of a mesh.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeshReport {
    /// The name of the file format: `tb-mesh-report`.
    pub format: &'static str,
    /// The version of the format: 1.
    pub version: u32,
    /// The object's name.
    pub object: String,
    /// The materials of the triangles, ordered by the first triangle of each material.
    pub materials: Vec<MaterialReport>,
    /// Number of positions that triangles use.
    pub vertices: usize,
    /// Number of positions that no triangle uses.
    pub unused_vertices: usize,
    /// Number of edges.
    pub edges: usize,
    /// Number of triangles.
    pub faces: usize,
    /// Number of grid cells that became two triangles.
    pub quads: u64,
    /// Vertices - edges + faces.
    pub euler: i64,
    /// Number of boundary loops.
    pub boundary_loops: usize,
    /// True if triangles can be turned over so that all neighbours have the same winding.
    pub orientable: bool,
    /// True if all neighbouring triangles have the same winding already.
    pub oriented: bool,
    /// True if the mesh is a surface around every point.
    pub manifold: bool,
    /// True if the mesh has triangles and no boundary.
    pub closed: bool,
    /// The mesh after vertices in one place are merged.
    pub merged: Merged,
    /// Shortest and longest edge, in the grid's unit.
    pub edge_length: Option<Extremes>,
    /// Smallest and largest area of a triangle, in the grid's unit squared.
    pub triangle_area: Option<Extremes>,
    /// The longest edge over the shortest.
    pub edge_ratio: Option<f64>,
    /// The largest aspect of a triangle: its longest edge over the height on that edge.
    pub worst_aspect: Option<f64>,
    /// The worst fold of all patches, if their grids record folds.
    pub folds: Option<Fold>,
    /// The worst tolerance of all patches, if their grids record tolerances.
    pub tolerance: Option<Tolerance>,
    /// Numbers of triangles left out of the mesh.
    pub left_out: LeftOut,
    /// The largest distance by which rounding to f32 moved a point, in the grid's unit.
    pub displacement: f64,
    /// The box around all positions, in the grid's unit.
    #[serde(rename = "box")]
    pub bounds: Option<Bounds>,
    /// The reports of the patches, in order.
    pub patches: Vec<PatchReport>,
}

/// A material and the number of triangles that have it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct MaterialReport {
    /// The texture id; 0 means no texture.
    pub texture: u32,
    /// The surface id.
    pub surface: u32,
    /// Number of triangles.
    pub faces: usize,
}

/// The report of one patch.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PatchReport {
    /// The name of the patch.
    pub object: String,
    /// Number of positions that the patch's triangles use.
    pub vertices: usize,
    /// Number of edges.
    pub edges: usize,
    /// Number of triangles.
    pub faces: usize,
    /// Vertices - edges + faces.
    pub euler: i64,
    /// Number of boundary loops.
    pub boundary_loops: usize,
    /// True if the patch has two sides.
    pub orientable: bool,
    /// True if the patch is a surface around every point.
    pub manifold: bool,
    /// True if the patch has triangles and no boundary.
    pub closed: bool,
    /// How far the patch folds back on itself, if its grid records this.
    pub folds: Option<Fold>,
    /// How near the patch is to the exact surface, if its grid records this.
    pub tolerance: Option<Tolerance>,
}

/// The smallest and the largest of several numbers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Extremes {
    /// The smallest number.
    pub min: f64,
    /// The largest number.
    pub max: f64,
}

/// Numbers of triangles left out of the mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct LeftOut {
    /// Left out because two corners are one point, as at poles and creases.
    pub collapsed: u64,
    /// Left out because all three corners lie on a line.
    pub slivers: u64,
}

/// A box with sides parallel to the axes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bounds {
    /// Smallest x, y and z.
    pub low: [f32; 3],
    /// Largest x, y and z.
    pub high: [f32; 3],
}

impl MeshReport {
    /// Measures a mesh. `counts` are those returned when the mesh was made.
    ///
    /// # Panics
    /// When an index of the mesh is out of range (see [`TriMesh::validate`]).
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
            merged: Merged::of(mesh),
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
        // Sides 3, 4 and 5: the height on the longest side is 12 / 5.
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
        // The page above leaves `folds` and `tolerance` of the patch null.
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
