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
//!                "place": { "rotate_deg": [0, 30, 0], "translate": [0, 0, -3] } } },
//!     { "superquadric": { "center": [2, 0.5, 0], "radii": [0.5, 0.5, 0.5], "exponents": [0.3, 1],
//!                         "material": "floor" } },
//!     { "mesh": { "name": "vase", "material": "floor", "textures": { "2": "checks" } } }
//!   ]
//! }
//! ```
//!
//! Colours are linear: one number for grey or `[red, green, blue]`. Lengths are in any one unit,
//! and axes are right-handed. The fields below document the meaning, range and default of each key.
//! The JSON Schema that `render --emit-schema` prints is made of them. The absolute value of a
//! number without another range is at most [`LARGEST`](super::limits::LARGEST).
//!
//! Of a ray from the eye and all rays that follow from it, only the first 8191 hits count: as many
//! as a `max_depth` of 12 can have.
//!
//! Spheres, boxes, superquadrics, planes (behind them) and closed meshes have an inside. They may
//! contain and overlap each other, and the camera may stand inside them. A rectangle or an open
//! mesh has no inside. It absorbs nothing, and a ray that passes it stays in the same medium.
//!
//! The background is a colour or a sky: `"background": { "by_elevation": [[-1, 0.3], [0, 0.8], [90,
//! [0.2, 0.35, 0.6]]] }` gives colours at degrees above the horizon, where y points up. A picture of all
//! directions, such as a sky in an HDR or EXR file, is `"background": { "picture": "sky.exr", "turn_deg": 30
//! }`. The background lights no surface; `ambient` and `lights` do.
//!
//! A light is a `point` light, a `directional` light, whose `direction` is the direction in which
//! its light travels, or a `spot` light, which shines into a cone: `{ "spot": { "position": [0, 4, 0],
//! "direction": [0, -1, 0], "outer_deg": 30 } }`. A point light may fade: `"falloff": { "quadratic": 1, "reference": 4 }` is
//! the inverse square, with the light's colour at a distance of 4. In general the colour is
//! multiplied by `1 / (constant + linear x + quadratic x^2)` with `x = distance / reference`. The
//! factor is at most a million.
//!
//! A texture is a picture (`image`) or a solid, which fills space and is carved by the surface: see
//! [`solid`]. A picture fills a rectangle, or the unit square of the texture coordinates of a mesh
//! or sphere; `repeat` lays it several times. A material's `bump` perturbs normals as a relief
//! would: see [`bump`]. Paths are relative to the folder of the file that contains them.
//!
//! Where two surfaces coincide, one of them is seen and the other is ignored. Leave a small gap
//! between glass and the object it stands on. Let water and the glass around it overlap a little.
//!
//! | an object's shape | keys | its texture |
//! |---|---|---|
//! | `sphere` | `center`, `radius` | a map: longitude from -z over +z, latitude from -y to +y |
//! | `rectangle` | `corner`, `edge_u`, `edge_v` | `repeat` times, default once across and once up |
//! | `plane` | `point`, `edge_u`, `edge_v` | once on the parallelogram, continued over the plane |
//! | `box` | `low`, `high`, two corners | once on each face, upright on the four sides |
//! | `superquadric` | `center`, `radii`, `exponents`, `ring` | as on a sphere; around the tube of a ring |
//! | `mesh` | `name`, `file` | by its own coordinates |
//!
//! `exponents` are Barr's e1 and e2, 0.05 to 4: of the section through the axis y and of the
//! section across it. A section is a square near 0, a circle at 1, a square on its corner at 2, and
//! a pinched star above 2. `[1, 1]` is an ellipsoid, `[0.1, 1]` a drum, `[1, 0.1]` a pillow,
//! `[0.1, 0.1]` a box with rounded edges. With a `ring` (1 to 1000) the shape is a supertoroid:
//! `radii` are the radii of its tube, and the middle of the tube is `ring` times as far from the
//! axis.
//!
//! Any object may have a `"place"`: a step or a list of steps, in the syntax that specs and textures have too
//! ([`Step`](files::place::Step)). Its origin is that of the scene. Mirroring is allowed, and the outside stays the outside.
//!
//! # Meshes
//!
//! A mesh comes from `--mesh NAME=FILE`, or else from its own `"file"`. The surfaces of a mesh that
//! `triangulate` made are named by a texture id and a surface id. `textures` binds texture ids to
//! textures, and `materials` binds surface ids to materials. `material` and `texture` apply to all
//! ids that are not bound. In an OBJ of another tool both maps are keyed by the name that `usemtl`
//! gives. `mtl` names the material library that the tool wrote with it ([what is
//! read](super::mtl)).
//!
//! `instances` shows a mesh several times: `"instances": [ { "translate": [-3, 0, 0] }, { "rotate_deg": [0, 40, 0],
//! "translate": [3, 0, 0] } ]`. Each is a place, which follows `place`, and an object of its own. The mesh is read,
//! stored and prepared for rays once. This also holds for objects that name the same file. Corners of such a mesh
//! are placed in double precision, where those of a single mesh are rounded to single precision.
//!
//! # Parts
//!
//! `include` adds lights, textures, materials and objects from files of format `tb-scene-part`.
//! These files have no camera and may include others:
//!
//! ```json
//! {
//!   "format": "tb-scene-part", "version": 1,
//!   "materials": { "brass": { "color": [0.8, 0.6, 0.2], "specular": 0.6, "reflectivity": 0.2 } }
//! }
//! ```
//!
//! Included lights and objects come before the including file's own. `[a, b]` gives the lights and
//! objects of a, then of b, then the scene's own. Of surfaces at the same position the first is
//! seen. A name may be defined only once in all files together, and may be used in any of them. A
//! part that is reached by two includes is added once.

mod background;
pub mod bump;
mod color;
mod keywords;
mod light;
mod material;
mod object;
mod part;
pub mod solid;
mod texture;

pub use background::{BackgroundFile, EnvironmentFile, SkyFile};
pub use color::{ColorFile, SurfaceColorFile};
pub use light::{DirectionalLightFile, FalloffFile, LightFile, PointLightFile, SpotLightFile};
pub use material::{MaterialFile, ThinFilmFile};
pub use object::{
    BoxFile, MeshFile, ObjectFile, OneOrMore, PlaneFile, RectangleFile, SphereFile,
    SuperquadricFile,
};
pub use part::{FORMAT as PART_FORMAT, Lists, PartFile};
pub use texture::{TextureFile, TextureKind};

use super::limits;
use files::names::each_name_once;
use files::note::Note;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The value of `format` in a scene file.
pub const FORMAT: &str = "tb-scene";

/// The value of `version` in a scene file and its parts.
pub const VERSION: u32 = 1;

/// The contents of a scene file, of which only the types are checked.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// Address of this file's JSON Schema, for editors; ignored by the program.
    #[serde(rename = "$schema")]
    pub schema: Option<String>,
    /// Format of this file: `tb-scene`.
    #[schemars(extend("const" = FORMAT))]
    pub format: String,
    /// Version of the format: 1.
    #[schemars(extend("const" = VERSION))]
    pub version: u32,
    /// Sentences for people; ignored by the program.
    pub note: Option<Note>,
    /// Files of format `tb-scene-part` whose lights, textures, materials and objects are added, in
    /// this order and before the scene's own. Paths are relative to this file's folder.
    #[serde(default)]
    pub include: Vec<PathBuf>,
    /// The camera that sees the scene.
    pub camera: CameraFile,
    /// Colour of rays that leave the scene: one colour, colours by elevation, or a picture; black if left
    /// out. With `null` the background is black, and transparent in the picture file.
    #[serde(default)]
    pub background: BackgroundFile,
    /// Ambient light, from all directions; 0.1 if left out.
    #[serde(default = "dim")]
    pub ambient: ColorFile,
    /// Lights of the scene; none if left out.
    #[serde(default)]
    pub lights: Vec<LightFile>,
    /// Largest number of reflections and refractions of a ray: 0 to 64; 12 if left out.
    #[serde(default = "twelve")]
    #[schemars(transform = keywords::range(0..=limits::DEEPEST))]
    pub max_depth: u32,
    /// Smallest weight in its pixel with which a ray is followed: 0 to 1; 0.0001 if left out.
    #[serde(default = "one_ten_thousandth")]
    #[schemars(transform = keywords::range(0.0..=1.0))]
    pub min_weight: f64,
    /// Textures of surfaces, pictures or solids, by names of your choice; none if left out.
    #[serde(default, deserialize_with = "each_name_once")]
    pub textures: BTreeMap<String, TextureFile>,
    /// Materials of surfaces, by names of your choice; none if left out.
    #[serde(default, deserialize_with = "each_name_once")]
    pub materials: BTreeMap<String, MaterialFile>,
    /// Objects of the scene. Of surfaces at the same position the first is seen.
    pub objects: Vec<ObjectFile>,
}

/// A pinhole camera with `fov_deg`, or an orthographic camera with `height`.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CameraFile {
    /// Position of the camera, in the unit of length.
    pub eye: [f64; 3],
    /// The point seen in the middle of the picture, not at the eye, in the unit of length.
    pub target: [f64; 3],
    /// A direction that points up in the picture, not along the view; y if left out.
    #[serde(default = "y_axis")]
    pub up: [f64; 3],
    /// Angle between the lower and the upper edge of the picture, in degrees, above 0 and below
    /// 180. Exactly one of `fov_deg` and `height` is given.
    #[schemars(transform = keywords::between(0.0, 180.0))]
    pub fov_deg: Option<f64>,
    /// Height of the picture of an orthographic camera, whose rays are parallel, in the unit of length,
    /// above 0: 1e-30 to 1e30. Its rays start in the plane through the eye.
    #[schemars(transform = keywords::positive)]
    pub height: Option<f64>,
}

impl CameraFile {
    /// Returns the angle between the lower and the upper edge of the picture, in degrees; for an
    /// orthographic camera the angle of its height at the target.
    #[must_use]
    pub fn angle_deg(&self) -> f64 {
        let distance = glam::DVec3::from(self.eye).distance(self.target.into());
        let of_height = |height: f64| 2.0 * (0.5 * height).atan2(distance).to_degrees();
        self.fov_deg.or(self.height.map(of_height)).unwrap_or_default()
    }
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

    /// Returns the JSON blocks of this page, in order.
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
