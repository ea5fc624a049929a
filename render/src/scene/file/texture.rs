//! `textures` of a scene file.

use super::solid::{
    BrickFile, CheckerFile, CloudsFile, GraniteFile, MarbleFile, PlaceFile, StripesFile, WallFile,
    WoodFile,
};
use crate::texture::{Values, Wrap};
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::PathBuf;

/// One of `textures`: a picture, or one solid.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TextureFile {
    /// A picture: the path of a PNG or JPEG file of 8 or 16 bits, from this file's folder.
    pub image: Option<PathBuf>,
    /// What lies beyond the edges of the picture; `repeat` if left out. Of pictures only.
    pub wrap: Option<Wrap>,
    /// What the picture's codes mean; `srgb` if left out. Of pictures only.
    pub values: Option<Values>,
    /// Veined stone.
    pub marble: Option<MarbleFile>,
    /// Crystals of several minerals.
    pub granite: Option<GraniteFile>,
    /// Rings of a trunk along y.
    pub wood: Option<WoodFile>,
    /// Clamped slow noise and fast noise.
    pub wall: Option<WallFile>,
    /// The sum of octaves of the size of noise.
    pub turbulence: Option<CloudsFile>,
    /// The sum of octaves of noise.
    pub clouds: Option<CloudsFile>,
    /// Cubes of two colours.
    pub checker: Option<CheckerFile>,
    /// Layers along x.
    pub stripes: Option<StripesFile>,
    /// Brickwork.
    pub brick: Option<BrickFile>,
    /// Where a solid lies in the object. Of solids only.
    pub place: Option<PlaceFile>,
}
