//! Walls as they are written: the thickness of a hollow sweep.
//!
//! `"wall": t` makes a tube hollow, with walls of the thickness t, in the unit of length. The ends of an open
//! trajectory are closed by flat rings. An object has more choices:
//!
//! | key         | meaning                                                                                 |
//! |-------------|-----------------------------------------------------------------------------------------|
//! | `thickness` | a law along the trajectory, above 0                                                     |
//! | `side`      | `inward` (the default): the contour is the outside; `outward`: it is the inside; `center`: the middle |
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "reducer",
//!   "contour": { "circle": 1 },
//!   "trajectory": { "line": [[0, 0, 0], [0, 6, 0]] },
//!   "scale": { "keys": [[0, 1], [0.4, 1], [0.7, 0.5], [1, 0.5]], "ease": "smooth" },
//!   "wall": { "thickness": { "keys": [[0, 0.2], [1, 0.1]] }, "side": "inward" },
//!   "mesh": { "rows": 40, "cols": 32 }
//! }
//! ```
//!
//! | `rim`       | of a vessel: `flat` (the default), or `round`, a half circle over the thickness         |
//! | `floor`     | of a vessel: the thickness from the axis to the first corner; as the rest if left out   |
//!
//! # Vessels
//!
//! The wall of a rotation whose contour is open makes a vessel: the contour, a rim, and the contour moved by the thickness
//! become one outline. Its law follows the contour, from its start to its end. A contour that starts on the axis has a
//! floor. Inside a corner the moved sides meet; around a corner they are joined by an arc. A `depth` lies on the outer
//! side and fades to the rim. `--check` finds a wall that crosses itself, and names bends that are tighter than the wall
//! is thick.
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "tumbler", "unit": "mm",
//!   "contour": { "svg": "M0 0H28L36 -90" },
//!   "trajectory": { "rotation": {} },
//!   "wall": { "thickness": 2, "rim": "round", "floor": 6 },
//!   "mesh": { "rows": 64, "cols": 60 }
//! }
//! ```
//!
//! # Tubes
//!
//! The thickness is measured in the plane of the section, after the scale, along the normal of the contour. The contour
//! is closed. If the contour has corners, its sides are straight, and the wall has corners at the same rows. A `depth` lies
//! on the outer side, with the heights that it has without a wall, and does not show on the inner side. `caps` and `areas`
//! are not combined with the wall of a tube.
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "grip", "unit": "mm",
//!   "contour": { "circle": 14 },
//!   "trajectory": { "line": [[0, 0, 0], [0, 90, 0]] },
//!   "wall": 2,
//!   "depth": { "mode": "offset", "terms": [{ "amp": 0.6, "u": 9, "v": 6 }, { "amp": 0.6, "u": -9, "v": 6 }] },
//!   "mesh": { "rows": 60, "cols": 96 }
//! }
//! ```
//!
//! With `"seam": "mirror"` a wall is a number, and surrounds the one-sided surface on both sides.

use super::Law;
use crate::limits;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use std::borrow::Cow;
use std::fmt;

/// The wall of a hollow sweep, or of a one-sided surface.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Wall {
    /// The thickness, in the unit of length; above 0.
    Thickness(f64),
    /// A thickness with its side.
    Keys(WallKeys),
}

/// A thickness that may change along the trajectory, and the side of the contour that the wall lies on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the key thickness, and any of side, rim, floor"
)]
pub struct WallKeys {
    /// The thickness, in the unit of length; above 0.
    pub thickness: Law,
    /// The side of the contour that the wall lies on.
    #[serde(default)]
    pub side: WallSide,
    /// The shape of the rim of a vessel.
    #[serde(default)]
    pub rim: Rim,
    /// Thickness of a vessel from the axis to the first corner, in the unit of length; above 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::positive)]
    pub floor: Option<f64>,
}

/// The shape of the rim of a vessel.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Rim {
    /// Straight from the outer side to the inner side.
    #[default]
    Flat,
    /// A half circle over the thickness.
    Round,
}

/// The side of the contour that a wall lies on.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WallSide {
    /// The contour is the outside of the wall.
    #[default]
    Inward,
    /// The contour is the inside of the wall.
    Outward,
    /// The contour is the middle of the wall.
    Center,
}

impl JsonSchema for Wall {
    fn schema_name() -> Cow<'static, str> {
        "Wall".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut number = json_schema!({ "type": "number" });
        limits::positive(&mut number);
        json_schema!({
            "description": "The thickness of a wall, or a thickness with its side.",
            "anyOf": [number, generator.subschema_for::<WallKeys>()],
        })
    }
}

impl<'de> Deserialize<'de> for Wall {
    fn deserialize<D: Deserializer<'de>>(reader: D) -> Result<Self, D::Error> {
        struct Visit;
        impl<'de> Visitor<'de> for Visit {
            type Value = Wall;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a thickness, or an object with the keys thickness and side")
            }

            fn visit_f64<E: Error>(self, number: f64) -> Result<Wall, E> {
                Ok(Wall::Thickness(number))
            }

            fn visit_i64<E: Error>(self, number: i64) -> Result<Wall, E> {
                Ok(Wall::Thickness(number as f64))
            }

            fn visit_u64<E: Error>(self, number: u64) -> Result<Wall, E> {
                Ok(Wall::Thickness(number as f64))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Wall, A::Error> {
                WallKeys::deserialize(MapAccessDeserializer::new(map)).map(Wall::Keys)
            }
        }
        reader.deserialize_any(Visit)
    }
}
