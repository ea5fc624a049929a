//! The key `background` of a scene file.

use super::color::{ColorFile, ColorVisitor};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{self, Deserializer, MapAccess, SeqAccess, Visitor};
use std::borrow::Cow;
use std::fmt;

/// A colour, or a sky.
#[derive(Debug, Clone, PartialEq)]
pub enum BackgroundFile {
    /// One colour in all directions.
    Uniform(ColorFile),
    /// Colours that depend on the elevation of the direction.
    Sky(SkyFile),
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
        let kinds = [generator.subschema_for::<ColorFile>(), generator.subschema_for::<SkyFile>()];
        json_schema!({ "description": "A colour, or a sky.", "oneOf": kinds })
    }
}

struct BackgroundVisitor;

impl<'de> Visitor<'de> for BackgroundVisitor {
    type Value = BackgroundFile;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        ColorVisitor.expecting(f)?;
        f.write_str(", or an object with by_elevation")
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

    fn visit_seq<A: SeqAccess<'de>>(self, channels: A) -> Result<BackgroundFile, A::Error> {
        ColorVisitor.visit_seq(channels).map(BackgroundFile::Uniform)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<BackgroundFile, A::Error> {
        SkyFile::deserialize(MapAccessDeserializer::new(map)).map(BackgroundFile::Sky)
    }
}
