//! The key `bump` of a material.
//!
//! ```json
//! { "hammered": { "color": 0.6, "bump": { "noise": { "octaves": 2 }, "strength": 0.02,
//!                                         "place": { "scale": 0.2 } } } }
//! ```
//!
//! A bump has exactly one relief. `noise` is the fractal sum of octaves. `turbulence` is the sum of
//! absolute values. `wall` is clamped slow noise plus fast noise. `dnoise` is the vectors of thesis
//! fig. 2.3. `image` is a grey picture as heights, laid by the surface's texture coordinates. `normals` is a
//! picture of normals, as other programs bake them. The noise of a bump is `smooth` unless `interpolation` says otherwise. With `linear`, the thesis's
//! interpolation, the slopes of noise jump at the faces of its cells, and shading shows them as
//! creases.

use super::solid::WallFile;
use crate::procedural::Interpolation;
use files::Place;
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::PathBuf;

/// A relief that perturbs the normals of a material.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BumpFile {
    /// The fractal sum of noise, as a height from -2 to 2.
    pub noise: Option<OctavesFile>,
    /// The turbulence, as a height from 0 to 2.
    pub turbulence: Option<OctavesFile>,
    /// Clamped slow noise plus fast noise, as a height.
    pub wall: Option<WallFile>,
    /// The normalised differences of the noise lattice, added to the normal unchanged.
    pub dnoise: Option<DnoiseFile>,
    /// The grey of a picture, as a height from 0 to 1.
    pub image: Option<ImageReliefFile>,
    /// The colours of a picture, as normals.
    pub normals: Option<NormalsFile>,
    /// Length of a height of 1 in the object's units, negative for dents; for `dnoise` and `normals` a
    /// plain factor. -1e6 to 1e6.
    pub strength: f64,
    /// Place of the relief in the object: a step, or a list of steps. Not allowed with `image` and `normals`, which lie on the surface.
    pub place: Option<Place>,
}

/// The relief of a bump with its keys. Exactly one relief is given for each bump.
///
/// A new relief provides a field in [`BumpFile`], a variant here, the check of its ranges in
/// `read/bumps.rs`, and a variant of [`procedural::Relief`](crate::procedural::Relief).
#[derive(Debug, Clone, Copy)]
pub enum ReliefKind<'a> {
    /// `noise`.
    Noise(&'a OctavesFile),
    /// `turbulence`.
    Turbulence(&'a OctavesFile),
    /// `wall`.
    Wall(&'a WallFile),
    /// `dnoise`.
    Dnoise(&'a DnoiseFile),
    /// `image`.
    Image(&'a ImageReliefFile),
    /// `normals`.
    Normals(&'a NormalsFile),
}

impl BumpFile {
    /// Returns the key of each relief, with its contents if the file has the key. The order is that of
    /// messages.
    #[must_use]
    pub fn kinds(&self) -> [(&'static str, Option<ReliefKind<'_>>); 6] {
        // Named one by one, so that a new field does not compile until it has its kind.
        let Self { noise, turbulence, wall, dnoise, image, normals, strength: _, place: _ } = self;
        [
            ("noise", noise.as_ref().map(ReliefKind::Noise)),
            ("turbulence", turbulence.as_ref().map(ReliefKind::Turbulence)),
            ("wall", wall.as_ref().map(ReliefKind::Wall)),
            ("dnoise", dnoise.as_ref().map(ReliefKind::Dnoise)),
            ("image", image.as_ref().map(ReliefKind::Image)),
            ("normals", normals.as_ref().map(ReliefKind::Normals)),
        ]
    }
}

/// A sum of octaves of noise.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct OctavesFile {
    /// Number of octaves, 1 to 12, default 1.
    pub octaves: u32,
    /// Interpolation of the noise.
    pub interpolation: Interpolation,
}

impl Default for OctavesFile {
    fn default() -> Self {
        Self { octaves: 1, interpolation: Interpolation::default() }
    }
}

/// The keys of `dnoise`.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DnoiseFile {
    /// Interpolation of the differences.
    pub interpolation: Interpolation,
}

/// A picture used as a relief.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with \"file\"")]
pub struct ImageReliefFile {
    /// Path of a picture in one of the formats of textures, relative to the scene file's folder. Its grey
    /// is the height.
    pub file: PathBuf,
    /// Number of repetitions over the unit square of texture coordinates, across and up; 1e-6 to
    /// 1e6, default once.
    #[serde(default = "once")]
    pub repeat: [f64; 2],
    /// True if the picture is mirrored at its edges instead of repeated; default false.
    #[serde(default)]
    pub mirror: bool,
}

/// A picture whose colours are normals in the space of the texture coordinates: red to the right, green up,
/// blue outward.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with \"file\"")]
pub struct NormalsFile {
    /// Path of a picture in one of the formats of textures, relative to the scene file's folder. The codes
    /// from black to white of each channel are -1 to 1.
    pub file: PathBuf,
    /// Number of repetitions over the unit square of texture coordinates, across and up; 1e-6 to
    /// 1e6, default once.
    #[serde(default = "once")]
    pub repeat: [f64; 2],
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
