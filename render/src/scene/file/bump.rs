//! `bump` of a material.
//!
//! ```json
//! { "hammered": { "color": 0.6, "bump": { "noise": { "octaves": 2 }, "strength": 0.02,
//!                                         "place": { "scale": 0.2 } } } }
//! ```
//!
//! Exactly one relief: `noise` (the fractal sum of octaves), `turbulence`, `wall`, `dnoise` (the
//! vectors of thesis fig. 2.3), or `image` (a grey picture as heights, laid by the surface's texture
//! coordinates). The noise of a bump is `smooth` unless `interpolation` says
//! otherwise: slopes of `linear` noise, the thesis's, jump at the faces of its cells, and the light
//! shows them as creases.

use super::solid::{PlaceFile, WallFile};
use crate::procedural::Interpolation;
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::PathBuf;

/// How a material's normals are turned.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BumpFile {
    /// The fractal sum of noise as a height from -2 to 2.
    pub noise: Option<OctavesFile>,
    /// Turbulence as a height from 0 to 2.
    pub turbulence: Option<OctavesFile>,
    /// Clamped slow noise and fast noise as a height.
    pub wall: Option<WallFile>,
    /// The normalised differences of the lattice, added to the normal as they are.
    pub dnoise: Option<DnoiseFile>,
    /// The grey of a picture as a height from 0 to 1.
    pub image: Option<ImageReliefFile>,
    /// The length of a height of 1 in the object's units, below 0 for dents; of `dnoise` a number.
    /// -1e6 to 1e6.
    pub strength: f64,
    /// Where the relief lies in the object; not of `image`, which lies on the surface.
    pub place: Option<PlaceFile>,
}

/// Octaves of noise.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct OctavesFile {
    /// How many, 1 to 12, default 1.
    pub octaves: u32,
    /// How the noise is interpolated.
    pub interpolation: Interpolation,
}

impl Default for OctavesFile {
    fn default() -> Self {
        Self { octaves: 1, interpolation: Interpolation::default() }
    }
}

/// `dnoise`.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DnoiseFile {
    /// How the differences are interpolated.
    pub interpolation: Interpolation,
}

/// A picture as a relief.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ImageReliefFile {
    /// The path of a PNG or JPEG file, from the scene file's folder; its grey is the height.
    pub file: PathBuf,
    /// How often it is laid over the unit square of texture coordinates, across and up; 1e-6 to
    /// 1e6, default once.
    #[serde(default = "once")]
    pub repeat: [f64; 2],
    /// Whether it is mirrored at its edges, in place of beginning again; default false.
    #[serde(default)]
    pub mirror: bool,
}

fn once() -> [f64; 2] {
    [1.0; 2]
}

#[cfg(test)]
mod tests {
    use crate::scene::file::MaterialFile;
    use files::json::Document;
    use std::collections::BTreeMap;

    #[test]
    fn the_example_on_this_page_is_read() {
        let page = include_str!("bump.rs");
        let lines = page.lines().skip_while(|line| *line != "//! ```json").skip(1);
        let text: String = lines
            .take_while(|line| *line != "//! ```")
            .map(|line| line.trim_start_matches("//!").to_string() + "\n")
            .collect();
        let document = Document::new("page", text.as_bytes()).unwrap();
        let read: BTreeMap<String, MaterialFile> = document.parse().unwrap();
        assert_eq!(read.len(), 1);
    }
}
