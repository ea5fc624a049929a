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
//!     "checks": { "image": "../textures/checkerboard.png", "wrap": "repeat", "values": "srgb" }
//!   },
//!   "materials": {
//!     "floor": { "diffuse": 0.9 },
//!     "glass": { "ambient": 0, "diffuse": 0, "specular": 0.5, "reflectivity": 1,
//!                "transparency": 1, "index_of_refraction": 1.5, "fresnel": true }
//!   },
//!   "objects": [
//!     { "sphere": { "center": [0, 1.3, 0], "radius": 1, "material": "glass" } },
//!     { "rectangle": { "corner": [-4, 0, 4], "edge_u": [8, 0, 0], "edge_v": [0, 0, -8],
//!                      "material": "floor", "texture": "checks", "repeat": [4, 4] } },
//!     { "plane": { "point": [0, -1, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, -1],
//!                  "material": "floor" } },
//!     { "mesh": { "name": "vase", "material": "floor", "textures": { "2": "checks" } } }
//!   ]
//! }
//! ```
//!
//! Colours are linear, one number for grey or `[red, green, blue]`, each at least 0. Lengths are in
//! any one unit, axes are right-handed. `up` defaults to y. A ray is reflected or refracted at most
//! `max_depth` times (0 to 64, default 12), and not when it would count for less than `min_weight` in
//! every channel of its pixel (0 to 1, default 0.0001), so that each ray left out takes at most that
//! part of the brightest light; and of one ray from the eye and all that follow from it the
//! first 8191 hits count, as many as a depth of 12 can have. `ambient` is light from everywhere
//! (default 0.1), `background` what a ray sees that leaves the scene (default black).
//!
//! | a material's key | meaning | range | default |
//! |---|---|---|---|
//! | `color` | multiplies the texture, or stands for it | at least 0 | 1 |
//! | `ambient`, `diffuse` | shares of the ambient light and of the lights | 0 to 1 | 1, 0.9 |
//! | `specular`, `shininess` | strength and Phong's exponent of the highlight | 0 to 1, 1 to 1e6 | 0, 50 |
//! | `reflectivity`, `transparency` | weights of the mirrored and the refracted ray | 0 to 1 | 0 |
//! | `index_of_refraction` | of the inside; outside is what the ray was in, or 1 | 0.1 to 10 | 1.5 |
//! | `fresnel` | whether those weights take Fresnel's share and its rest | true, false | false |
//! | `absorption` | of the inside: a way `d` leaves `exp(-absorption d)` of the light | at least 0 | 0 |
//! | `priority` | which of overlapping insides is there; of equals, the last entered | 0 to 255 | 0 |
//! | `by_angle` | `[[degrees, colour], ...]`, by the angle between light and normal | 0 to 90 | none |
//! | `thin_film` | such colours by interference: `thickness_nm`, `index`, `base_index` | 1 to 5000, 1 to 5 | none, 1.33, 1 |
//!
//! Spheres, planes (behind them) and closed meshes have an inside. They may contain and overlap each
//! other, and the camera may stand in them. A rectangle or an open mesh has none: it absorbs
//! nothing, and a ray that passes it is still in what it was in.
//!
//! A light is a `point` light or a `directional` one, whose `direction` is the way its light goes. A
//! point light may fade: `"falloff": { "quadratic": 1, "reference": 4 }` is the inverse square with
//! the light's colour at a distance of 4, in general `1 / (constant + linear x + quadratic x^2)` with
//! `x = distance / reference`. Nothing is made brighter by it than a million times.
//!
//! `wrap` is `repeat` or `clamp`, `values` is `srgb` or `linear`; the first is the default. A texture fills a rectangle, or the unit square of a mesh's or sphere's
//! texture coordinates; `repeat` lays it several times. Paths count from the scene file's folder.
//!
//! Where two surfaces coincide one of them is seen, the other is not behind it: leave a small gap
//! between glass and what it stands on, and let water and the glass around it overlap a little.
//!
//! A mesh comes from `--mesh NAME=FILE`, or else from its own `"file"`. The surfaces of a mesh that
//! `triangulate` made are named by a texture id and a surface id: `textures` binds texture ids to
//! textures, `materials` binds surface ids to materials; `material` and `texture` stand for all that
//! are not bound. In an OBJ of another tool both maps are keyed by the name that `usemtl` gives.

mod color;
mod light;
mod material;
mod object;
mod texture;

pub use color::ColorFile;
pub use light::{DirectionalLightFile, FalloffFile, LightFile, PointLightFile};
pub use material::{MaterialFile, ThinFilmFile};
pub use object::{MeshFile, ObjectFile, PlaneFile, RectangleFile, SphereFile};
pub use texture::TextureFile;

use files::names::each_name_once;
use serde::Deserialize;
use std::collections::BTreeMap;

/// A scene as its file says it; nothing is checked but its types.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "the module page explains the keys")]
pub struct SceneFile {
    pub format: String,
    pub version: u32,
    pub camera: CameraFile,
    #[serde(default)]
    pub background: ColorFile,
    #[serde(default = "dim")]
    pub ambient: ColorFile,
    #[serde(default)]
    pub lights: Vec<LightFile>,
    #[serde(default = "twelve")]
    pub max_depth: u32,
    #[serde(default = "one_ten_thousandth")]
    pub min_weight: f64,
    #[serde(default, deserialize_with = "each_name_once")]
    pub textures: BTreeMap<String, TextureFile>,
    #[serde(default, deserialize_with = "each_name_once")]
    pub materials: BTreeMap<String, MaterialFile>,
    pub objects: Vec<ObjectFile>,
}

/// `camera`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "see SceneFile")]
pub struct CameraFile {
    pub eye: [f64; 3],
    pub target: [f64; 3],
    #[serde(default = "y_axis")]
    pub up: [f64; 3],
    /// The angle between the lower and the upper edge of the picture.
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

    #[test]
    fn the_example_on_this_page_is_a_scene() {
        let page = include_str!("file.rs");
        let lines = page.lines().skip_while(|line| *line != "//! ```json").skip(1);
        let text: String = lines
            .take_while(|line| *line != "//! ```")
            .map(|line| line.trim_start_matches("//!").to_string() + "\n")
            .collect();
        let document = Document::new("page", text.as_bytes()).unwrap();
        let scene: SceneFile = document.parse().unwrap();
        assert_eq!(scene.objects.len(), 4);
        assert_eq!(scene.ambient, ColorFile([0.2; 3]));
    }
}
