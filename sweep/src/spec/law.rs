//! Laws as they are written: a number, or an object with one key.

use super::only;
use crate::law::Ease;
use crate::limits;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use std::borrow::Cow;
use std::fmt;

/// A number that may change along the trajectory, as a function of the fraction of its length.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Law {
    /// The same number everywhere.
    Number(f64),
    /// Keys, with interpolation between them.
    Keys {
        /// Pairs `[at, value]`, with `at` strictly rising in `[0, 1]`.
        keys: Vec<[f64; 2]>,
        /// Interpolation between two keys.
        ease: Ease,
    },
    /// The graph of a Bezier curve.
    Bezier {
        /// Cubics of points `[at, value]`, along which `at` does not fall.
        bezier: Vec<[[f64; 2]; 4]>,
    },
    /// A linear law from 0 at the start to a number at the end.
    Total {
        /// The number at the end.
        total: f64,
    },
}

/// One law for both axes of the contour, or one for each.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Scale {
    /// One law for both axes.
    Both(Law),
    /// One law for x and one for y.
    Each([Law; 2]),
}

/// The keys of a law as they are read.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("dependentRequired" = {"ease": ["keys"]}), transform = limits::one_of)]
struct LawKeys {
    /// Pairs `[at, value]`, with `at` strictly rising in `[0, 1]`.
    #[schemars(transform = limits::graph)]
    keys: Option<Vec<[f64; 2]>>,
    /// Interpolation between two keys; `linear` if left out.
    ease: Option<Ease>,
    /// Cubics of points `[at, value]`, along which `at` does not fall.
    #[schemars(transform = limits::graph)]
    bezier: Option<Vec<[[f64; 2]; 4]>>,
    /// The value at the end of a linear law that starts at 0.
    total: Option<f64>,
}

impl TryFrom<LawKeys> for Law {
    type Error = String;

    fn try_from(given: LawKeys) -> Result<Self, String> {
        let ease = given.ease.unwrap_or_default();
        if given.ease.is_some() && given.keys.is_none() {
            return Err("found `ease` without `keys`, which it belongs to".into());
        }
        only(
            "law",
            [
                ("keys", given.keys.map(|keys| Self::Keys { keys, ease })),
                ("bezier", given.bezier.map(|bezier| Self::Bezier { bezier })),
                ("total", given.total.map(|total| Self::Total { total })),
            ],
        )
    }
}

impl JsonSchema for Law {
    fn schema_name() -> Cow<'static, str> {
        "Law".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A number that may change along the trajectory, by the fraction of its length.",
            "anyOf": [{ "type": "number" }, generator.subschema_for::<LawKeys>()],
        })
    }
}

impl JsonSchema for Scale {
    fn schema_name() -> Cow<'static, str> {
        "Scale".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let law = generator.subschema_for::<Law>();
        json_schema!({
            "description": "One law for both axes of the contour, or one for each.",
            "anyOf": [law, { "type": "array", "items": law, "minItems": 2, "maxItems": 2 }],
        })
    }
}

impl<'de> Deserialize<'de> for Law {
    fn deserialize<D: Deserializer<'de>>(reader: D) -> Result<Self, D::Error> {
        struct Visit;
        impl<'de> Visitor<'de> for Visit {
            type Value = Law;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str(
                    "a law: a number, or an object with one of the keys keys, bezier, total",
                )
            }

            fn visit_f64<E: Error>(self, number: f64) -> Result<Law, E> {
                Ok(Law::Number(number))
            }

            fn visit_i64<E: Error>(self, number: i64) -> Result<Law, E> {
                Ok(Law::Number(number as f64))
            }

            fn visit_u64<E: Error>(self, number: u64) -> Result<Law, E> {
                Ok(Law::Number(number as f64))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Law, A::Error> {
                let keys = LawKeys::deserialize(MapAccessDeserializer::new(map))?;
                keys.try_into().map_err(Error::custom)
            }
        }
        reader.deserialize_any(Visit)
    }
}

impl<'de> Deserialize<'de> for Scale {
    fn deserialize<D: Deserializer<'de>>(reader: D) -> Result<Self, D::Error> {
        struct Visit;
        impl<'de> Visitor<'de> for Visit {
            type Value = Scale;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a law, or two of them in brackets, for x and y")
            }

            fn visit_f64<E: Error>(self, number: f64) -> Result<Scale, E> {
                Ok(Scale::Both(Law::Number(number)))
            }

            fn visit_i64<E: Error>(self, number: i64) -> Result<Scale, E> {
                self.visit_f64(number as f64)
            }

            fn visit_u64<E: Error>(self, number: u64) -> Result<Scale, E> {
                self.visit_f64(number as f64)
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Scale, A::Error> {
                Law::deserialize(MapAccessDeserializer::new(map)).map(Scale::Both)
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut laws: A) -> Result<Scale, A::Error> {
                let mut next =
                    |i| laws.next_element()?.ok_or_else(|| Error::invalid_length(i, &"two laws"));
                Ok(Scale::Each([next(0)?, next(1)?]))
            }
        }
        reader.deserialize_any(Visit)
    }
}
