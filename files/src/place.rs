//! Places: how objects, copies and textures are moved, turned and stretched. All formats write them alike.
//!
//! A place is a step, or a list of steps that apply one after another. Each step moves about the origin of the space
//! in which the place stands:
//!
//! | key of a step | value | meaning |
//! |---|---|---|
//! | `scale` | `s` or `[x, y, z]` | factors along the axes, not 0; a factor below 0 mirrors |
//! | `rotate_deg` | `{"axis": [x, y, z], "angle": a}` or `[x, y, z]` | a rotation by `a` degrees, counter-clockwise as seen from the tip of the axis; or rotations about the axes x, then y, then z |
//! | `translate` | `[x, y, z]` | a translation, in the unit of length |
//! | `matrix` | `[[a, b, c, x], [d, e, f, y], [g, h, i, z]]` | any affine map, in rows; without other keys |
//!
//! A step with several keys scales first, then rotates, then translates. A list states any other order.
//!
//! ```json
//! [
//!   { "scale": 0.5, "rotate_deg": [0, 30, 0], "translate": [0, 1, 0] },
//!   [{ "translate": [0, 1, 0] }, { "rotate_deg": { "axis": [1, 0, 1], "angle": 30 } }]
//! ]
//! ```
//!
//! | what is placed | key | which places are allowed |
//! |---|---|---|
//! | a sweep, or the step from a copy to the next | `place`, `copies.step` of a spec | those that stretch all directions alike and do not mirror |
//! | an object of a scene, or an instance of a mesh | `place`, `instances` | all that do not flatten: stretches may differ a million times, by the product of the Frobenius norms of matrix and inverse |
//! | a texture or a relief that fills space | `place` of a texture or a bump | the same, with units of the texture 1e-6 to 1e6 long |

use glam::{DAffine3, DMat3, DVec3};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;

/// A step, or steps that apply one after another.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Place {
    /// One step.
    One(Step),
    /// Steps in the order in which they apply. Without any, nothing is moved.
    List(Vec<Step>),
}

/// A step of a place: `scale`, then `rotate_deg`, then `translate`, or `matrix` alone. Without keys it moves nothing.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "a step: an object with any of the keys scale, rotate_deg, translate, or with the key matrix"
)]
#[schemars(extend("if" = {"required": ["matrix"]}, "then" = {"maxProperties": 1}))]
pub struct Step {
    /// A factor, or factors along x, y and z, about the origin; not 0. Factors below 0 mirror.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scale: Option<Factors>,
    /// A rotation about an axis through the origin, or rotations about the axes x, then y, then z, in degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotate_deg: Option<Rotation>,
    /// A translation `[x, y, z]`, in the unit of length.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub translate: Option<[f64; 3]>,
    /// Any affine map: three rows of four numbers, of which the last is the translation. Not allowed with other keys.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub matrix: Option<[[f64; 4]; 3]>,
}

/// Factors along the axes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Factors {
    /// One factor for all axes.
    All(f64),
    /// Factors along x, y and z.
    Each([f64; 3]),
}

/// A rotation in degrees.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Rotation {
    /// A rotation about an axis through the origin.
    About(Turn),
    /// Rotations about the fixed axes x, then y, then z.
    Angles([f64; 3]),
}

/// A rotation about an axis through the origin.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the keys axis and angle")]
pub struct Turn {
    /// Direction of the axis, of any length but 0.
    pub axis: [f64; 3],
    /// Angle in degrees, counter-clockwise as seen from the direction in which the axis points.
    pub angle: f64,
}

/// A place as an affine map, with its inverse. Numbers may be infinite if those of the place are too large.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Map {
    /// The map.
    pub there: DAffine3,
    /// Its inverse. Inverses of scales, translations and quarter turns are exact to one rounding for each step.
    pub back: DAffine3,
}

/// A step that is no map.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlaceFault {
    /// Path of the value from the place, such as `[1].scale[0]` or `.rotate_deg.axis`.
    pub path: String,
    /// A sentence about the found and the expected value.
    pub message: String,
}

impl Default for Place {
    fn default() -> Self {
        Self::List(Vec::new())
    }
}

impl Place {
    /// Returns the steps in their order.
    #[must_use]
    pub fn steps(&self) -> &[Step] {
        match self {
            Self::One(step) => std::slice::from_ref(step),
            Self::List(steps) => steps,
        }
    }

    /// Returns whether there is no step.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.steps().is_empty()
    }

    /// Returns the map of all steps.
    ///
    /// # Errors
    /// If a step has a factor of 0, an axis of length 0, or a matrix beside other keys.
    pub fn map(&self) -> Result<Map, PlaceFault> {
        let mut whole = Map { there: DAffine3::IDENTITY, back: DAffine3::IDENTITY };
        for (k, step) in self.steps().iter().enumerate() {
            let next = step.map().map_err(|fault| match self {
                Self::One(_) => fault,
                Self::List(_) => PlaceFault { path: format!("[{k}]{}", fault.path), ..fault },
            })?;
            whole = whole.then(next);
        }
        Ok(whole)
    }
}

impl Map {
    fn then(self, next: Self) -> Self {
        Self { there: next.there * self.there, back: self.back * next.back }
    }
}

impl Step {
    fn map(&self) -> Result<Map, PlaceFault> {
        let fault = |path: &str, message: &str| {
            Err(PlaceFault { path: path.into(), message: message.into() })
        };
        let Self { scale, rotate_deg, translate, matrix } = *self;
        if let Some(rows) = matrix {
            if scale.is_some() || rotate_deg.is_some() || translate.is_some() {
                let message =
                    "found other keys beside `matrix`, expected a step of its own for them";
                return fault(".matrix", message);
            }
            let column = |k: usize| DVec3::new(rows[0][k], rows[1][k], rows[2][k]);
            let there = DAffine3::from_cols(column(0), column(1), column(2), column(3));
            return Ok(Map { there, back: there.inverse() });
        }
        let mut whole = Map { there: DAffine3::IDENTITY, back: DAffine3::IDENTITY };
        if let Some(factors) = scale {
            let [x, y, z] = factors.along();
            if let Some(axis) = [x, y, z].iter().position(|&factor| factor == 0.0) {
                let path = match factors {
                    Factors::All(_) => ".scale".into(),
                    Factors::Each(_) => format!(".scale[{axis}]"),
                };
                return fault(&path, "found 0, expected any other number");
            }
            whole = Map {
                there: DAffine3::from_scale(DVec3::new(x, y, z)),
                back: DAffine3::from_scale(DVec3::new(1.0 / x, 1.0 / y, 1.0 / z)),
            };
        }
        if let Some(rotation) = rotate_deg {
            let Some(turn) = rotation.matrix() else {
                let message = "found an axis without length, expected a direction";
                return fault(".rotate_deg.axis", message);
            };
            let there = DAffine3::from_mat3(turn);
            whole = whole.then(Map { there, back: DAffine3::from_mat3(turn.transpose()) });
        }
        if let Some(by) = translate {
            let by = DVec3::from(by);
            let back = DAffine3::from_translation(-by);
            whole = whole.then(Map { there: DAffine3::from_translation(by), back });
        }
        Ok(whole)
    }
}

impl Factors {
    /// Returns the factors along x, y and z.
    #[must_use]
    pub fn along(self) -> [f64; 3] {
        match self {
            Self::All(factor) => [factor; 3],
            Self::Each(factors) => factors,
        }
    }
}

impl Rotation {
    /// Returns the matrix of the rotation; `None` if its axis has no length. Quarter turns about the axes are exact.
    #[must_use]
    pub fn matrix(self) -> Option<DMat3> {
        match self {
            Self::About(turn) => Some(about(DVec3::from(turn.axis).try_normalize()?, turn.angle)),
            Self::Angles([x, y, z]) => {
                Some(about(DVec3::Z, z) * about(DVec3::Y, y) * about(DVec3::X, x))
            }
        }
    }
}

/// Returns the matrix of a rotation by degrees about an axis of length 1.
fn about(axis: DVec3, degrees: f64) -> DMat3 {
    // The remainder keeps the digits of an angle of many turns.
    let angle = degrees % 360.0;
    let (sine, cosine) = match angle {
        0.0 => (0.0, 1.0),
        90.0 | -270.0 => (1.0, 0.0),
        180.0 | -180.0 => (0.0, -1.0),
        270.0 | -90.0 => (-1.0, 0.0),
        _ => angle.to_radians().sin_cos(),
    };
    // Rodrigues' formula: the part along the axis is unchanged, and the rest is rotated.
    let turned = |v: DVec3| {
        let along = v.dot(axis) * axis;
        cosine * (v - along) + sine * axis.cross(v) + along
    };
    let [x, y, z] = DVec3::AXES.map(turned);
    DMat3::from_cols(x, y, z)
}

/// Reads values that are a list or something else. `$what` says what is expected.
macro_rules! either {
    ($name:ident, $what:literal, { $($visit:tt)* }) => {
        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(reader: D) -> Result<Self, D::Error> {
                struct Visit;
                impl<'de> Visitor<'de> for Visit {
                    type Value = $name;

                    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                        f.write_str($what)
                    }

                    $($visit)*
                }
                reader.deserialize_any(Visit)
            }
        }
    };
}

either!(Place, "a step (an object) or a list of steps", {
    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Place, A::Error> {
        Step::deserialize(MapAccessDeserializer::new(map)).map(Place::One)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Place, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(list)).map(Place::List)
    }
});

either!(Factors, "a factor or three factors [x, y, z]", {
    fn visit_f64<E: Error>(self, factor: f64) -> Result<Factors, E> {
        Ok(Factors::All(factor))
    }

    fn visit_u64<E: Error>(self, factor: u64) -> Result<Factors, E> {
        self.visit_f64(factor as f64)
    }

    fn visit_i64<E: Error>(self, factor: i64) -> Result<Factors, E> {
        self.visit_f64(factor as f64)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Factors, A::Error> {
        <[f64; 3]>::deserialize(SeqAccessDeserializer::new(list)).map(Factors::Each)
    }
});

either!(
    Rotation,
    "an object with the keys axis and angle, or three angles [x, y, z] in degrees",
    {
        fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Rotation, A::Error> {
            Turn::deserialize(MapAccessDeserializer::new(map)).map(Rotation::About)
        }

        fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Rotation, A::Error> {
            <[f64; 3]>::deserialize(SeqAccessDeserializer::new(list)).map(Rotation::Angles)
        }
    }
);

impl JsonSchema for Place {
    fn schema_name() -> Cow<'static, str> {
        "Place".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let step = generator.subschema_for::<Step>();
        json_schema!({
            "description": "A step, or a list of steps that apply one after another.",
            "anyOf": [step, { "type": "array", "items": step }],
        })
    }
}

impl JsonSchema for Factors {
    fn schema_name() -> Cow<'static, str> {
        "Factors".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let factor = json_schema!({ "type": "number", "not": { "const": 0 } });
        json_schema!({
            "description": "A factor, or factors along x, y and z.",
            "anyOf": [factor, { "type": "array", "items": factor, "minItems": 3, "maxItems": 3 }],
        })
    }
}

impl JsonSchema for Rotation {
    fn schema_name() -> Cow<'static, str> {
        "RotationDeg".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let turn = generator.subschema_for::<Turn>();
        let angles = json_schema!({ "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 });
        json_schema!({
            "description": "A rotation about an axis, or rotations about the axes x, then y, then z, in degrees.",
            "anyOf": [turn, angles],
        })
    }
}

#[cfg(test)]
mod tests;
