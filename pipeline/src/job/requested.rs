//! The value of the key `error`: a number, or `"8bit"`.

use render::accuracy::OF_8BIT;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserialize, Deserializer, Visitor};
use std::borrow::Cow;
use std::fmt;

/// A requested error, which may be out of range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Requested(f64);

impl Requested {
    /// Returns the error, root mean square in linear light.
    #[must_use]
    pub fn number(self) -> f64 {
        self.0
    }
}

impl JsonSchema for Requested {
    fn schema_name() -> Cow<'static, str> {
        "Requested".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "An error in linear light, or `8bit` for half a step of an 8-bit picture.",
            "anyOf": [
                { "type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 1 },
                { "const": "8bit" },
            ],
        })
    }
}

impl<'de> Deserialize<'de> for Requested {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(RequestedVisitor)
    }
}

struct RequestedVisitor;

impl Visitor<'_> for RequestedVisitor {
    type Value = Requested;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, or \"8bit\"")
    }

    fn visit_f64<E: de::Error>(self, number: f64) -> Result<Requested, E> {
        Ok(Requested(number))
    }

    fn visit_u64<E: de::Error>(self, number: u64) -> Result<Requested, E> {
        Ok(Requested(number as f64))
    }

    fn visit_i64<E: de::Error>(self, number: i64) -> Result<Requested, E> {
        Ok(Requested(number as f64))
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Requested, E> {
        match text {
            "8bit" => Ok(Requested(OF_8BIT)),
            _ => Err(E::invalid_value(de::Unexpected::Str(text), &self)),
        }
    }
}
