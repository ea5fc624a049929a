//! Colours of a scene file.

use crate::scene::limits::LARGEST;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{self, Deserializer, SeqAccess, Visitor};
use std::borrow::Cow;
use std::fmt;

/// A linear colour: one number for grey, or red, green and blue; each 0 or more.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ColorFile(pub [f64; 3]);

impl<'de> Deserialize<'de> for ColorFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ColorVisitor)
    }
}

impl JsonSchema for ColorFile {
    fn schema_name() -> Cow<'static, str> {
        "Color".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let light = json_schema!({ "type": "number", "minimum": 0.0, "maximum": LARGEST });
        json_schema!({
            "description": "Linear light: one number for grey, or [red, green, blue].",
            "oneOf": [light, { "type": "array", "items": light, "minItems": 3, "maxItems": 3 }],
        })
    }
}

pub(super) struct ColorVisitor;

impl<'de> Visitor<'de> for ColorVisitor {
    type Value = ColorFile;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a colour: one number for grey or [red, green, blue]")
    }

    fn visit_f64<E: de::Error>(self, grey: f64) -> Result<ColorFile, E> {
        Ok(ColorFile([grey; 3]))
    }

    fn visit_u64<E: de::Error>(self, grey: u64) -> Result<ColorFile, E> {
        self.visit_f64(grey as f64)
    }

    fn visit_i64<E: de::Error>(self, grey: i64) -> Result<ColorFile, E> {
        self.visit_f64(grey as f64)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut channels: A) -> Result<ColorFile, A::Error> {
        let mut color = [0.0; 3];
        for (k, channel) in color.iter_mut().enumerate() {
            *channel =
                channels.next_element()?.ok_or_else(|| de::Error::invalid_length(k, &self))?;
        }
        match channels.next_element::<f64>()? {
            None => Ok(ColorFile(color)),
            Some(_) => Err(de::Error::invalid_length(4, &self)),
        }
    }
}

/// The colour of a surface: one colour, or `"vertex"` for the colours of a mesh's vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SurfaceColorFile {
    /// One colour.
    Uniform(ColorFile),
    /// The colours of the vertices.
    Vertex,
}

/// The name that stands for the colours of the vertices.
const VERTEX: &str = "vertex";

impl<'de> Deserialize<'de> for SurfaceColorFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(SurfaceColorVisitor)
    }
}

impl JsonSchema for SurfaceColorFile {
    fn schema_name() -> Cow<'static, str> {
        "SurfaceColor".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let uniform = generator.subschema_for::<ColorFile>();
        json_schema!({
            "description": "A colour, or \"vertex\" for the colours of a mesh's vertices.",
            "oneOf": [uniform, { "const": VERTEX }],
        })
    }
}

struct SurfaceColorVisitor;

impl<'de> Visitor<'de> for SurfaceColorVisitor {
    type Value = SurfaceColorFile;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        ColorVisitor.expecting(f)?;
        write!(f, ", or \"{VERTEX}\"")
    }

    fn visit_f64<E: de::Error>(self, grey: f64) -> Result<SurfaceColorFile, E> {
        ColorVisitor.visit_f64(grey).map(SurfaceColorFile::Uniform)
    }

    fn visit_u64<E: de::Error>(self, grey: u64) -> Result<SurfaceColorFile, E> {
        self.visit_f64(grey as f64)
    }

    fn visit_i64<E: de::Error>(self, grey: i64) -> Result<SurfaceColorFile, E> {
        self.visit_f64(grey as f64)
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<SurfaceColorFile, E> {
        let unknown = || de::Error::invalid_value(de::Unexpected::Str(name), &self);
        (name == VERTEX).then_some(SurfaceColorFile::Vertex).ok_or_else(unknown)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, channels: A) -> Result<SurfaceColorFile, A::Error> {
        ColorVisitor.visit_seq(channels).map(SurfaceColorFile::Uniform)
    }
}

/// White, the default of most colours.
pub(super) fn white() -> ColorFile {
    ColorFile([1.0; 3])
}
