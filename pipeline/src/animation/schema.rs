//! The JSON Schema of values over the time of an animation ([`super::law`]).

use files::schema::range;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use std::borrow::Cow;
use sweep::law::Ease;
use sweep::spec;

/// A value that may change over the time of an animation, of which only the schema is used.
pub(super) struct OverTime;

/// A law of the time, from 0 in the first frame to 1 in the last. It has one of the keys `keys`, `bezier` and `total`.
#[derive(JsonSchema)]
#[expect(dead_code, reason = "only its schema is used")]
#[schemars(rename = "LawOfTime", deny_unknown_fields, extend("dependentRequired" = {"ease": ["keys"]}))]
#[schemars(transform = one_of)]
struct Keys {
    /// Pairs `[time, value]`, with strictly rising times in `[0, 1]`. Values are numbers, or lists of as many numbers.
    #[schemars(length(min = 1))]
    keys: Option<Vec<(Time, Numbers)>>,
    /// Interpolation between two keys; `linear` if left out.
    ease: Option<Ease>,
    /// Cubics of points `[time, value]`, along which the time does not fall.
    #[schemars(length(min = 1))]
    bezier: Option<Vec<[(Time, f64); 4]>>,
    /// The value at the end of a linear law that starts at 0.
    total: Option<Numbers>,
}

/// A time.
#[derive(JsonSchema)]
#[expect(dead_code, reason = "only its schema is used")]
#[schemars(transparent, inline, transform = range(0.0..=1.0))]
struct Time(f64);

/// A number or a list of numbers.
#[derive(JsonSchema)]
#[expect(dead_code, reason = "only its schema is used")]
#[schemars(untagged, inline)]
enum Numbers {
    One(f64),
    Several(#[schemars(length(min = 1))] Vec<f64>),
}

/// Requires exactly one law.
fn one_of(schema: &mut Schema) {
    let laws = ["keys", "bezier", "total"].map(|key| serde_json::json!({ "required": [key] }));
    schema.insert("oneOf".into(), laws.to_vec().into());
}

impl JsonSchema for OverTime {
    fn schema_name() -> Cow<'static, str> {
        "ValueOverTime".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let law = generator.subschema_for::<spec::Law>();
        json_schema!({
            "description": "A number, a list with a law for each of its numbers, or a law of numbers or lists.",
            "anyOf": [
                { "type": "number" },
                { "type": "array", "items": law, "minItems": 1 },
                generator.subschema_for::<Keys>(),
            ],
        })
    }
}
