//! The key `background` of a scene file.

use super::color::{ColorFile, ColorVisitor};
use super::keywords;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{self, Deserializer, MapAccess, SeqAccess, Visitor};
use std::borrow::Cow;
use std::fmt;
use std::path::PathBuf;

/// A colour, a sky, a picture, or nothing.
#[derive(Debug, Clone, PartialEq)]
pub enum BackgroundFile {
    /// Black, and transparent in picture files.
    Nothing,
    /// One colour in all directions.
    Uniform(ColorFile),
    /// Colours that depend on the elevation of the direction.
    Sky(SkyFile),
    /// A picture of all directions.
    Picture(EnvironmentFile),
}

/// A picture of all directions, of longitude across and latitude up. Its middle lies toward -z.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EnvironmentFile {
    /// Path of the picture, in one of the formats of textures, relative to this file's folder. HDR and EXR
    /// hold light brighter than white.
    pub picture: PathBuf,
    /// Angle by which the picture is turned about y, counter-clockwise as seen from above, in degrees:
    /// -1e6 to 1e6; 0 if left out.
    #[serde(default)]
    #[schemars(transform = keywords::range(-1e6..=1e6))]
    pub turn_deg: f64,
}

/// A sky, including the directions below the horizon.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SkyFile {
    /// Colours at degrees above the horizon, where y points up: `[degrees, colour]`, rising from
    /// -90 to 90. Colours are linear between the given degrees, and constant before the first and
    /// after the last.
    pub by_elevation: Vec<(f64, ColorFile)>,
}

impl Default for BackgroundFile {
    fn default() -> Self {
        Self::Uniform(ColorFile::default())
    }
}

impl<'de> Deserialize<'de> for BackgroundFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(BackgroundVisitor)
    }
}

impl JsonSchema for BackgroundFile {
    fn schema_name() -> Cow<'static, str> {
        "Background".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let kinds = [
            json_schema!({ "type": "null" }),
            generator.subschema_for::<ColorFile>(),
            generator.subschema_for::<SkyFile>(),
            generator.subschema_for::<EnvironmentFile>(),
        ];
        json_schema!({ "description": "A colour, a sky, a picture, or null.", "oneOf": kinds })
    }
}

/// The keys of both kinds of objects.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SkyOrPicture {
    by_elevation: Option<Vec<(f64, ColorFile)>>,
    picture: Option<PathBuf>,
    turn_deg: Option<f64>,
}

struct BackgroundVisitor;

impl<'de> Visitor<'de> for BackgroundVisitor {
    type Value = BackgroundFile;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        ColorVisitor.expecting(f)?;
        f.write_str(", null, or an object with by_elevation or picture")
    }

    fn visit_f64<E: de::Error>(self, grey: f64) -> Result<BackgroundFile, E> {
        ColorVisitor.visit_f64(grey).map(BackgroundFile::Uniform)
    }

    fn visit_u64<E: de::Error>(self, grey: u64) -> Result<BackgroundFile, E> {
        self.visit_f64(grey as f64)
    }

    fn visit_i64<E: de::Error>(self, grey: i64) -> Result<BackgroundFile, E> {
        self.visit_f64(grey as f64)
    }

    fn visit_unit<E: de::Error>(self) -> Result<BackgroundFile, E> {
        Ok(BackgroundFile::Nothing)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, channels: A) -> Result<BackgroundFile, A::Error> {
        ColorVisitor.visit_seq(channels).map(BackgroundFile::Uniform)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<BackgroundFile, A::Error> {
        let SkyOrPicture { by_elevation, picture, turn_deg } =
            SkyOrPicture::deserialize(MapAccessDeserializer::new(map))?;
        match (by_elevation, picture, turn_deg) {
            (Some(by_elevation), None, None) => Ok(BackgroundFile::Sky(SkyFile { by_elevation })),
            (None, Some(picture), turn_deg) => {
                let turn_deg = turn_deg.unwrap_or_default();
                Ok(BackgroundFile::Picture(EnvironmentFile { picture, turn_deg }))
            }
            _ => {
                Err(de::Error::custom("expected by_elevation, or picture with or without turn_deg"))
            }
        }
    }
}
