//! The key `textures` of a scene file.

use super::solid::{
    BrickFile, CheckerFile, CloudsFile, GraniteFile, MarbleFile, StripesFile, WallFile, WoodFile,
};
use crate::texture::{Alpha, Values, Wrap};
use files::Place;
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// A texture: one picture or one solid.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TextureFile {
    /// A picture: path of a PNG, JPEG, TGA, BMP, TIFF, WebP, GIF, HDR or EXR file, relative to this file's
    /// folder. Of a file of several pictures the first is read. Texels are taken as they are stored: the
    /// orientation of a camera and colour profiles are not applied.
    pub image: Option<PathBuf>,
    /// Continuation beyond the edges of the picture; `repeat` if left out. For pictures only.
    pub wrap: Option<Wrap>,
    /// Meaning of the picture's codes; `srgb` if left out. For pictures only. Floating point values are
    /// always linear.
    pub values: Option<Values>,
    /// Use of the picture's alpha channel: `cut` if left out. For pictures only.
    pub alpha: Option<Alpha>,
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
    /// Place of a solid in the object: a step, or a list of steps. For solids only.
    pub place: Option<Place>,
}

/// The kind of a texture with its keys. Exactly one kind is given for each texture.
///
/// A new solid texture provides:
///
/// - a struct `XFile` with its keys, ranges and defaults in [`solid`](super::solid), and a row in the
///   table of that page;
/// - a field in [`TextureFile`] and a variant here; the compiler then leads to [`TextureFile::kinds`]
///   and to the reader `read/solids.rs`, which checks each range;
/// - the pattern itself, as [`procedural::Pattern`](crate::procedural::Pattern) states.
#[derive(Debug, Clone, Copy)]
pub enum TextureKind<'a> {
    /// `image`: the path of a picture.
    Image(&'a Path),
    /// `marble`.
    Marble(&'a MarbleFile),
    /// `granite`.
    Granite(&'a GraniteFile),
    /// `wood`.
    Wood(&'a WoodFile),
    /// `wall`.
    Wall(&'a WallFile),
    /// `turbulence`.
    Turbulence(&'a CloudsFile),
    /// `clouds`.
    Clouds(&'a CloudsFile),
    /// `checker`.
    Checker(&'a CheckerFile),
    /// `stripes`.
    Stripes(&'a StripesFile),
    /// `brick`.
    Brick(&'a BrickFile),
}

impl TextureFile {
    /// Returns the key of each kind, with its contents if the file has the key. The order is that of
    /// messages.
    #[must_use]
    pub fn kinds(&self) -> [(&'static str, Option<TextureKind<'_>>); 10] {
        // Named one by one, so that a new field does not compile until it has its kind.
        let Self {
            image,
            marble,
            granite,
            wood,
            wall,
            turbulence,
            clouds,
            checker,
            stripes,
            brick,
            wrap: _,
            values: _,
            alpha: _,
            place: _,
        } = self;
        [
            ("image", image.as_deref().map(TextureKind::Image)),
            ("marble", marble.as_ref().map(TextureKind::Marble)),
            ("granite", granite.as_ref().map(TextureKind::Granite)),
            ("wood", wood.as_ref().map(TextureKind::Wood)),
            ("wall", wall.as_ref().map(TextureKind::Wall)),
            ("turbulence", turbulence.as_ref().map(TextureKind::Turbulence)),
            ("clouds", clouds.as_ref().map(TextureKind::Clouds)),
            ("checker", checker.as_ref().map(TextureKind::Checker)),
            ("stripes", stripes.as_ref().map(TextureKind::Stripes)),
            ("brick", brick.as_ref().map(TextureKind::Brick)),
        ]
    }
}
