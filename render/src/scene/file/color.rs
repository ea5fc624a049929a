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

/// White, the default of most colours.
pub(super) fn white() -> ColorFile {
    ColorFile([1.0; 3])
}
