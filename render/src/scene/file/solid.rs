//! Solid textures of a scene file, and their placement.
//!
//! ```json
//! {
//!   "stone": { "marble": { "folds": 1.6 }, "place": { "scale": 0.4, "rotate_deg": [0, 0, 20] } },
//!   "board": { "checker": { "colors": [0.05, 0.8] }, "place": { "scale": 0.25 } },
//!   "sky": { "clouds": { "octaves": 5, "colors": [[0.4, [0.2, 0.4, 0.8]], [0.7, 1]] } }
//! }
//! ```
//!
//! A solid is defined in a space of its own, whose unit depends on the pattern: the distance of
//! marble's veins, a crystal of granite, a ring of wood, a cell of noise, a side of a checker.
//! `place` ([`Step`](files::place::Step)) maps this space to the object's own space. Colours are linear. A list of
//! `[position, colour]` is a ramp: positions rise, and colours between them are interpolated.
//!
//! | kind | keys | range | default |
//! |---|---|---|---|
//! | `marble` | `octaves`; `folds` of the layers, `net` of fine veins; `colors`, 0 in a vein, 1 far from it | 1 to 12; 0 to 100, 0 to 1 | 6; 2, 0.6; white with grey veins |
//! | `granite` | `minerals`, a list of `[share, colour]`; `flakes`, `flake_color`; `vary` | above 0; 0 to 1; 0 to 1 | rose, cream, quartz; 0.3, black; 0.6 |
//! | `wood` | `waver` of rings, `grain` of fibres; `colors`, 0 early wood, 1 late wood | 0 to 100, 0 to 1 | 0.6, 0.6; brown |
//! | `wall` | `clamp` of the slow noise; `rough`, `frequency` of the fast one; `colors`, 0 lowest, 1 highest | -1 to 1; 0 to 10, 0.001 to 1000 | -0.15, 0.15; 0.06, 8; plaster |
//! | `turbulence`, `clouds` | `octaves`; `colors`, 0 least, 1 most | 1 to 12 | 6; black to white |
//! | `checker` | `colors`, two of them | | black, white |
//! | `stripes` | `layers`, a list of `[thickness, colour]` along x | above 0 | black, white, 0.5 each |
//! | `brick` | `size` along x, y, z; `joint`; `colors` of brick and joint; `vary` | above 0; 0 to the least size; 0 to 1 | 1, 0.333, 0.5; 0.04; red, grey; 0.5 |
//!
//! Kinds made of noise have `interpolation`: `linear` (the thesis's), `smooth` (the default) or
//! `smoother`.

use super::color::ColorFile;
use crate::procedural::Interpolation;
use schemars::JsonSchema;
use serde::Deserialize;

/// Stops of a ramp: position and colour, positions rising.
pub type RampFile = Vec<(f64, ColorFile)>;

/// The keys of `marble`, whose veins lie one unit apart along x.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MarbleFile {
    /// Ramp from the middle of a vein, 0, to the ground between veins, 1; default white with grey
    /// veins.
    pub colors: RampFile,
    /// Octaves of the noise that folds the layers, 1 to 12, default 6.
    pub octaves: u32,
    /// Strength of the folds, in units, 0 to 100, default 2.
    pub folds: f64,
    /// Visibility of a net of fine veins, 0 to 1, default 0.6.
    pub net: f64,
    /// Interpolation of the noise.
    pub interpolation: Interpolation,
}

impl Default for MarbleFile {
    fn default() -> Self {
        let colors = vec![
            (0.0, ColorFile([0.07, 0.075, 0.09])),
            (0.05, ColorFile([0.17, 0.18, 0.20])),
            (0.13, ColorFile([0.40, 0.41, 0.43])),
            (0.4, ColorFile([0.64, 0.64, 0.64])),
            (0.75, ColorFile([0.80, 0.79, 0.775])),
            (1.0, ColorFile([0.87, 0.86, 0.84])),
        ];
        Self { colors, octaves: 6, folds: 2.0, net: 0.6, interpolation: Interpolation::default() }
    }
}

/// The keys of `granite`, whose crystals are about one unit large.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct GraniteFile {
    /// Share of each mineral, above 0, and its colour; default rose, cream and quartz.
    pub minerals: Vec<(f64, ColorFile)>,
    /// Part of the cells that hold a flake, 0 to 1, default 0.3.
    pub flakes: f64,
    /// Colour of the flakes; default nearly black.
    pub flake_color: ColorFile,
    /// Variation in tone between crystals of one mineral, 0 to 1, default 0.6.
    pub vary: f64,
    /// Interpolation of the noise that makes boundaries ragged.
    pub interpolation: Interpolation,
}

impl Default for GraniteFile {
    fn default() -> Self {
        let minerals = vec![
            (0.46, ColorFile([0.50, 0.27, 0.20])),
            (0.27, ColorFile([0.66, 0.56, 0.46])),
            (0.27, ColorFile([0.36, 0.34, 0.34])),
        ];
        let flake_color = ColorFile([0.025, 0.024, 0.026]);
        let interpolation = Interpolation::default();
        Self { minerals, flakes: 0.3, flake_color, vary: 0.6, interpolation }
    }
}

/// The keys of `wood`. The trunk stands along y, and rings are one unit apart.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct WoodFile {
    /// Ramp from early wood, 0, to late wood, 1; default brown.
    pub colors: RampFile,
    /// Distance by which rings wander, in units, 0 to 100, default 0.6.
    pub waver: f64,
    /// Strength of the fibres, 0 to 1, default 0.6.
    pub grain: f64,
    /// Interpolation of the noise.
    pub interpolation: Interpolation,
}

impl Default for WoodFile {
    fn default() -> Self {
        let colors = vec![
            (0.0, ColorFile([0.54, 0.31, 0.13])),
            (0.55, ColorFile([0.40, 0.195, 0.07])),
            (1.0, ColorFile([0.17, 0.066, 0.02])),
        ];
        Self { colors, waver: 0.6, grain: 0.6, interpolation: Interpolation::default() }
    }
}

/// The keys of `wall`, as a texture and as a bump. A cell of the slow noise is one unit.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct WallFile {
    /// Ramp from the lowest height, 0, to the highest, 1. For textures only.
    pub colors: Option<RampFile>,
    /// Lower and upper limit of the slow noise, -1 to 1, default -0.15 and 0.15.
    pub clamp: [f64; 2],
    /// Strength of the fast noise, 0 to 10, default 0.06.
    pub rough: f64,
    /// Frequency of the fast noise relative to the slow noise, 0.001 to 1000, default 8.
    pub frequency: f64,
    /// Interpolation of the noise.
    pub interpolation: Interpolation,
}

impl Default for WallFile {
    fn default() -> Self {
        let interpolation = Interpolation::default();
        Self { colors: None, clamp: [-0.15, 0.15], rough: 0.06, frequency: 8.0, interpolation }
    }
}

/// The keys of `turbulence` and `clouds`. A cell of the coarsest noise is one unit.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CloudsFile {
    /// Ramp from the least possible sum, 0, to the largest, 1; default black to white.
    pub colors: RampFile,
    /// Number of octaves, 1 to 12, default 6.
    pub octaves: u32,
    /// Interpolation of the noise.
    pub interpolation: Interpolation,
}

impl Default for CloudsFile {
    fn default() -> Self {
        let colors = vec![(0.0, ColorFile([0.0; 3])), (1.0, ColorFile([1.0; 3]))];
        Self { colors, octaves: 6, interpolation: Interpolation::default() }
    }
}

/// The keys of `checker`, whose cubes have side 1.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CheckerFile {
    /// Colour of the cube from the origin to (1, 1, 1), and colour of its neighbours.
    pub colors: [ColorFile; 2],
}

impl Default for CheckerFile {
    fn default() -> Self {
        Self { colors: [ColorFile([0.0; 3]), ColorFile([1.0; 3])] }
    }
}

/// The keys of `stripes`. Layers are stacked along x from the origin and repeat.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct StripesFile {
    /// Thickness of each layer, above 0, and its colour.
    pub layers: Vec<(f64, ColorFile)>,
}

impl Default for StripesFile {
    fn default() -> Self {
        Self { layers: vec![(0.5, ColorFile([0.0; 3])), (0.5, ColorFile([1.0; 3]))] }
    }
}

/// The keys of `brick`. Rows run along x and are stacked along y.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BrickFile {
    /// Distance from one brick to the next along x, y and z, joint included; above 0.
    pub size: [f64; 3],
    /// Thickness of the joint: at least 0, less than each size; default 0.04.
    pub joint: f64,
    /// Colours of the bricks and of the joint.
    pub colors: [ColorFile; 2],
    /// Variation in tone between bricks, 0 to 1, default 0.5.
    pub vary: f64,
}

impl Default for BrickFile {
    fn default() -> Self {
        let colors = [ColorFile([0.38, 0.10, 0.06]), ColorFile([0.52, 0.49, 0.45])];
        Self { size: [1.0, 1.0 / 3.0, 0.5], joint: 0.04, colors, vary: 0.5 }
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::file::TextureFile;
    use files::json::Document;
    use std::collections::BTreeMap;

    #[test]
    fn the_example_on_this_page_is_read() {
        let page = include_str!("solid.rs");
        let lines = page.lines().skip_while(|line| *line != "//! ```json").skip(1);
        let text: String = lines
            .take_while(|line| *line != "//! ```")
            .map(|line| line.trim_start_matches("//!").to_string() + "\n")
            .collect();
        let document = Document::new("page", text.as_bytes()).unwrap();
        let read: BTreeMap<String, TextureFile> = document.parse().unwrap();
        assert_eq!(read.len(), 3);
    }
}
