//! The key `textures` of a scene file.

use super::solid::{
    BrickFile, CheckerFile, CloudsFile, GraniteFile, MarbleFile, PlaceFile, StripesFile, WallFile,
    WoodFile,
};
use crate::texture::{Values, Wrap};
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::PathBuf;

/// A texture: one picture or one solid.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TextureFile {
    /// A picture: path of a PNG or JPEG file with 8 or 16 bits, relative to this file's folder.
    pub image: Option<PathBuf>,
    /// Continuation beyond the edges of the picture; `repeat` if left out. For pictures only.
    pub wrap: Option<Wrap>,
    /// Meaning of the picture's codes; `srgb` if left out. For pictures only.
    pub values: Option<Values>,
    /// Veined stone.
    pub marble: Option<MarbleFile>,
    /// Crystals of several minerals.
    pub granite: Option<GraniteFile>,
    /// Rings of a trunk along y.
    pub wood: Option<WoodFile>,
    /// Clamped slow noise plus fast noise.
    pub wall: Option<WallFile>,
    /// The sum of octaves of the noise's absolute value.
    pub turbulence: Option<CloudsFile>,
    /// The sum of octaves of noise.
    pub clouds: Option<CloudsFile>,
    /// Cubes of two alternating colours.
    pub checker: Option<CheckerFile>,
    /// Repeating layers along x.
    pub stripes: Option<StripesFile>,
    /// Brickwork.
    pub brick: Option<BrickFile>,
    /// Position of a solid in the object. For solids only.
    pub place: Option<PlaceFile>,
}
