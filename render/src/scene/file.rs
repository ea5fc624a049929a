//! The scene file: JSON, format `tb-scene`, version 1.
//!
//! ```json
//! {
//!   "format": "tb-scene", "version": 1,
//!   "camera": { "eye": [0, 1.5, 6], "target": [0, 0.9, 0], "up": [0, 1, 0], "fov_deg": 40 },
//!   "background": [0.55, 0.7, 0.9],
//!   "ambient": 0.2,
//!   "lights": [ { "point": { "position": [4, 8, 5], "color": 0.9 } } ],
//!   "max_depth": 12, "min_weight": 0.0001,
//!   "textures": {
//!     "checks": { "image": "../textures/checkerboard.png", "wrap": "repeat", "values": "srgb" },
//!     "stone": { "marble": {}, "place": { "scale": 0.4 } }
//!   },
//!   "materials": {
//!     "floor": { "diffuse": 0.9, "bump": { "wall": {}, "strength": 0.02 } },
//!     "glass": { "ambient": 0, "diffuse": 0, "specular": 0.5, "reflectivity": 1,
//!                "transparency": 1, "index_of_refraction": 1.5, "fresnel": true }
//!   },
//!   "objects": [
//!     { "sphere": { "center": [0, 1.3, 0], "radius": 1, "material": "glass" } },
//!     { "rectangle": { "corner": [-4, 0, 4], "edge_u": [8, 0, 0], "edge_v": [0, 0, -8],
//!                      "material": "floor", "texture": "checks", "repeat": [4, 4] } },
//!     { "plane": { "point": [0, -1, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, -1],
//!                  "material": "floor" } },
//!     { "box": { "low": [-1, 0, -1], "high": [1, 0.2, 1], "material": "floor", "texture": "checks",
//!                "place": [ { "rotate_deg": { "axis": [0, 1, 0], "angle": 30 } },
//!                           { "translate": [0, 0, -3] } ] } },
//!     { "superquadric": { "center": [2, 0.5, 0], "radii": [0.5, 0.5, 0.5], "exponents": [0.3, 1],
//!                         "material": "floor" } },
//!     { "mesh": { "name": "vase", "material": "floor", "textures": { "2": "checks" } } }
//!   ]
//! }
//! ```
//!
//! Colours are linear, one number for grey or `[red, green, blue]`. Lengths are in any one unit,
//! axes are right-handed. What each key means, its range and its default stand at the fields below,
//! which the JSON Schema that `render --emit-schema` prints is made of. Numbers without another range
//! are at most [`LARGEST`](super::schema::LARGEST) without their sign.
//!
//! Of one ray from the eye and all that follow from it the first 8191 hits count, as many as a
//! `max_depth` of 12 can have.
//!
//! Spheres, boxes, superquadrics, planes (behind them) and closed meshes have an inside. They may contain and overlap each
//! other, and the camera may stand in them. A rectangle or an open mesh has none: it absorbs
//! nothing, and a ray that passes it is still in what it was in.
//!
//! The background is a colour, or a sky: `"background": { "by_elevation": [[-1, 0.3], [0, 0.8], [90, [0.2,
//! 0.35, 0.6]]] }` gives colours at degrees above the horizon, where y points up.
//!
//! A light is a `point` light or a `directional` one, whose `direction` is the way its light goes. A
//! point light may fade: `"falloff": { "quadratic": 1, "reference": 4 }` is the inverse square with
//! the light's colour at a distance of 4, in general `1 / (constant + linear x + quadratic x^2)` with
//! `x = distance / reference`. Nothing is made brighter by it than a million times.
//!
//! A texture is a picture (`image`) or a solid, which fills space and is carved by the surface: see
//! [`solid`]. A picture fills a rectangle, or the unit square of a mesh's or sphere's texture coordinates;
//! `repeat` lays it several times. A material's `bump` turns normals as a relief would: see [`bump`]. Paths count from the folder of the file that they stand in.
//!
//! Where two surfaces coincide one of them is seen, the other is not behind it: leave a small gap
//! between glass and what it stands on, and let water and the glass around it overlap a little.
//!
//! | an object's shape | keys | its texture |
//! |---|---|---|
//! | `sphere` | `center`, `radius` | a map: longitude from -z over +z, latitude from -y to +y |
//! | `rectangle` | `corner`, `edge_u`, `edge_v` | `repeat` times, default once each way |
//! | `plane` | `point`, `edge_u`, `edge_v` | once on the parallelogram, and on from there |
//! | `box` | `low`, `high`, two corners | once on each face, upright on the four sides |
//! | `superquadric` | `center`, `radii`, `exponents`, `ring` | as on a sphere; around the tube of a ring |
//! | `mesh` | `name`, `file` | by its own coordinates |
//!
//! `exponents` are Barr's e1 and e2, of the section through the axis y and of that across it, 0.05 to
//! 4: near 0 a square, 1 a circle, 2 a square on its corner, above it a pinched star. `[1, 1]` is an
//! ellipsoid, `[0.1, 1]` a drum, `[1, 0.1]` a pillow, `[0.1, 0.1]` a box with rounded edges. With a
//! `ring` (1 to 1000) it is a supertoroid: `radii` are those of its tube, the middle of which is `ring`
//! times as far from the axis.
//!
//! Any object may have a `"place"`, a list of steps that are taken in their order: `{ "scale": [x, y,
//! z] }`, `{ "rotate_deg": { "axis": [x, y, z], "angle": a } }` (counter-clockwise as seen from where
//! the axis points), `{ "translate": [x, y, z] }` and `{ "matrix": [[...], [...], [...]] }` with three
//! rows of four numbers. All are about the origin of the scene. Mirrors are welcome, and what was
//! outside stays outside; flat maps are not: the Frobenius norms of the whole matrix and of its inverse
//! may multiply to at most a million (a turn makes 3).
//!
//! # Meshes
//!
//! A mesh comes from `--mesh NAME=FILE`, or else from its own `"file"`. The surfaces of a mesh that
//! `triangulate` made are named by a texture id and a surface id: `textures` binds texture ids to
//! textures, `materials` binds surface ids to materials; `material` and `texture` stand for all that
//! are not bound. In an OBJ of another tool both maps are keyed by the name that `usemtl` gives, and
//! `mtl` names the material library that the tool wrote beside it ([what is read](super::mtl)).
//!
//! # Parts
//!
//! `include` takes in lights, textures, materials and objects from files of format `tb-scene-part`,
//! which have no camera and may include others:
//!
//! ```json
//! {
//!   "format": "tb-scene-part", "version": 1,
//!   "materials": { "brass": { "color": [0.8, 0.6, 0.2], "specular": 0.6, "reflectivity": 0.2 } }
//! }
//! ```
//!
//! What is taken in stands before what takes it in: `[a, b]` gives the lights and objects of a, those
//! of b, then the scene's own, and of surfaces at the same place the first is seen. A name may be given
//! once in all files together, and used in any of them. A part that is reached on two ways is taken in once.

mod background;
pub mod bump;
mod color;
mod light;
mod material;
mod object;
mod part;
pub mod solid;
mod texture;

pub use background::{BackgroundFile, SkyFile};
pub use color::ColorFile;
pub use light::{DirectionalLightFile, FalloffFile, LightFile, PointLightFile};
pub use material::{MaterialFile, ThinFilmFile};
pub use object::{BoxFile, MeshFile, ObjectFile, PlaneFile, RectangleFile};
pub use object::{RotateDegFile, SphereFile, StepFile, SuperquadricFile};
pub use part::{FORMAT as PART_FORMAT, Lists, PartFile};
pub use texture::TextureFile;

use super::schema;
use files::names::each_name_once;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The value of `format` in a scene.
pub const FORMAT: &str = "tb-scene";

/// The value of `version` in a scene and its parts.
pub const VERSION: u32 = 1;

/// A scene as its file says it; nothing is checked but its types.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// Where an editor finds the schema of this file; passed over.
    #[serde(rename = "$schema")]
    pub schema: Option<String>,
    /// `tb-scene`.
    #[schemars(extend("const" = FORMAT))]
    pub format: String,
    /// 1.
    #[schemars(extend("const" = VERSION))]
    pub version: u32,
    /// Files of format `tb-scene-part` whose lights, textures, materials and objects are taken in, in
    /// this order and before the scene's own; paths count from this file's folder.
    #[serde(default)]
    pub include: Vec<PathBuf>,
    /// Where the scene is seen from.
    pub camera: CameraFile,
    /// What a ray sees that leaves the scene: a colour, or colours by the elevation; black if left
    /// out.
    #[serde(default)]
    pub background: BackgroundFile,
    /// Light from everywhere; 0.1 if left out.
    #[serde(default = "dim")]
    pub ambient: ColorFile,
    /// The lights; none if left out.
    #[serde(default)]
    pub lights: Vec<LightFile>,
    /// How often a ray is reflected or refracted at most: 0 to 64; 12 if left out.
    #[serde(default = "twelve")]
    #[schemars(transform = schema::range(0..=schema::DEEPEST))]
    pub max_depth: u32,
    /// A ray that would count for less than this in its pixel is not followed: 0 to 1; 0.0001 if
    /// left out.
    #[serde(default = "one_ten_thousandth")]
    #[schemars(transform = schema::range(0.0..=1.0))]
    pub min_weight: f64,
    /// Pictures for surfaces, by names of one's choice.
    #[serde(default, deserialize_with = "each_name_once")]
    pub textures: BTreeMap<String, TextureFile>,
    /// What surfaces are made of, by names of one's choice.
    #[serde(default, deserialize_with = "each_name_once")]
    pub materials: BTreeMap<String, MaterialFile>,
    /// What there is to see; of surfaces at the same place the first is seen.
    pub objects: Vec<ObjectFile>,
}

/// A pinhole camera.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CameraFile {
    /// Where it stands, in the unit of length.
    pub eye: [f64; 3],
    /// A point in the middle of the picture, not at the eye.
    pub target: [f64; 3],
    /// A direction that points up in the picture, not along the view; y if left out.
    #[serde(default = "y_axis")]
    pub up: [f64; 3],
    /// The angle between the lower and the upper edge of the picture, in degrees, above 0 and below
    /// 180.
    #[schemars(transform = schema::between(0.0, 180.0))]
    pub fov_deg: f64,
}

fn dim() -> ColorFile {
    ColorFile([0.1; 3])
}

fn twelve() -> u32 {
    12
}

fn one_ten_thousandth() -> f64 {
    1e-4
}

fn y_axis() -> [f64; 3] {
    [0.0, 1.0, 0.0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use files::json::Document;

    /// The JSON on this page, in its order.
    fn examples() -> Vec<String> {
        let page = include_str!("file.rs");
        let lines = page.lines().map_while(|line| line.strip_prefix("//!"));
        let text: String = lines.map(|line| format!("{line}\n")).collect();
        let examples = text.split("```json").skip(1);
        examples.map(|rest| rest.split("```").next().unwrap_or_default().into()).collect()
    }

    #[test]
    fn the_example_on_this_page_is_a_scene() {
        let text = &examples()[0];
        let scene: SceneFile = Document::new("page", text.as_bytes()).unwrap().parse().unwrap();
        assert_eq!(scene.objects.len(), 6);
        assert_eq!(scene.ambient, ColorFile([0.2; 3]));
    }

    #[test]
    fn the_second_example_on_this_page_is_a_part_of_a_scene() {
        let text = &examples()[1];
        let part: PartFile = Document::new("page", text.as_bytes()).unwrap().parse().unwrap();
        assert_eq!(part.materials["brass"].specular, 0.6);
        assert_eq!(part.format, part::FORMAT);
    }
}
