//! Limits of the numbers in a spec, and the keywords that state limits in the JSON Schema.
//!
//! The reader refuses numbers beyond the limits. The functions add limits to a type's schema that
//! its Rust form does not state.

use files::schema::insert;
use schemars::Schema;
use serde_json::{Map, Value, json};
use std::ops::RangeInclusive;

pub(crate) use files::schema::range;

/// Largest size of a coordinate; its fourth power fits a double with a wide margin.
pub(crate) const LARGEST: f64 = 1e60;

/// Smallest size of a curve; its fourth power is above the smallest double by a wide margin.
pub(crate) const SMALLEST: f64 = 1e-60;

/// Repeats of a picture, whose texture coordinates become f32 in a mesh.
pub(crate) const REPEATS: RangeInclusive<f64> = 1e-30..=1e30;

/// Allows numbers above `low`, up to `high`.
pub(crate) fn above(low: f64, high: f64) -> impl FnMut(&mut Schema) {
    move |schema| insert(schema, &json!({ "exclusiveMinimum": low, "maximum": high }))
}

/// Allows numbers from [`SMALLEST`] to below `high`.
pub(crate) fn below(high: f64) -> impl FnMut(&mut Schema) {
    move |schema| insert(schema, &json!({ "minimum": SMALLEST, "exclusiveMaximum": high }))
}

/// Allows numbers from [`SMALLEST`] to [`LARGEST`].
pub(crate) fn positive(schema: &mut Schema) {
    range(SMALLEST..=LARGEST)(schema);
}

/// Allows lists of numbers from [`SMALLEST`] to [`LARGEST`].
pub(crate) fn positive_items(schema: &mut Schema) {
    if let Some(items) = schema.ensure_object().get_mut("items") {
        items["minimum"] = json!(SMALLEST);
        items["maximum"] = json!(LARGEST);
    }
}

/// Allows whole numbers that are ids of a texture or a surface.
pub(crate) fn id(schema: &mut Schema) {
    range(0..=u32::MAX)(schema);
}

/// Allows one word: no white space and no control characters.
pub(crate) fn word(schema: &mut Schema) {
    let pattern = "^[^\\s\\u0000-\\u001f\\u007f-\\u009f]+$";
    insert(schema, &json!({ "pattern": pattern }));
}

/// Allows whole numbers from 1.
pub(crate) fn from_one(schema: &mut Schema) {
    insert(schema, &json!({ "minimum": 1 }));
}

/// Allows the path of a file, which is not empty.
pub(crate) fn file(schema: &mut Schema) {
    insert(schema, &json!({ "minLength": 1 }));
}

/// Requires points or a table of points.
pub(crate) fn points_or_csv(schema: &mut Schema) {
    schema.insert("oneOf".into(), json!([{ "required": ["points"] }, { "required": ["csv"] }]));
}

/// Requires at least `count` elements.
pub(crate) fn at_least(count: usize) -> impl FnMut(&mut Schema) {
    move |schema| {
        schema.insert("minItems".into(), json!(count));
    }
}

/// Allows points `[at, value]`, or lists of points, with `at` in `[0, 1]`.
pub(crate) fn graph(schema: &mut Schema) {
    fn points(items: &mut Map<String, Value>) {
        match items.get_mut("items") {
            Some(Value::Object(inner)) if inner.contains_key("items") => points(inner),
            Some(number) => {
                let number = number.take();
                items.insert(
                    "prefixItems".into(),
                    json!([
                        { "type": "number", "minimum": 0.0, "maximum": 1.0 }, number
                    ]),
                );
                items.insert("items".into(), json!(false));
            }
            None => {}
        }
    }
    points(schema.ensure_object());
    schema.insert("minItems".into(), json!(1));
}

/// Requires exactly one of the keys, besides keys that `dependentRequired` allows with one of them.
pub(crate) fn one_of(schema: &mut Schema) {
    let besides = schema.get("dependentRequired").cloned().unwrap_or_default();
    let Some(Value::Object(properties)) = schema.get("properties") else {
        return;
    };
    let keys = properties.keys().filter(|key| besides.get(key.as_str()).is_none());
    let kinds: Vec<Value> = keys.map(|key| json!({ "required": [key] })).collect();
    schema.insert("oneOf".into(), kinds.into());
}

/// Forbids some keys of the type.
pub(crate) fn without(keys: &[&str]) -> impl FnMut(&mut Schema) {
    let kinds: Vec<Value> = keys.iter().map(|key| json!({ "required": [key] })).collect();
    move |schema| {
        schema.insert("not".into(), json!({ "anyOf": kinds }));
    }
}

/// Requires at least three points if `closed`.
pub(crate) fn loop_of_three(schema: &mut Schema) {
    let closed = json!({ "properties": { "closed": { "const": true } }, "required": ["closed"] });
    let three = json!({ "properties": { "points": { "minItems": 3 } } });
    schema.insert("if".into(), closed);
    schema.insert("then".into(), three);
}

/// Requires waves or a picture.
pub(crate) fn terms_or_image(schema: &mut Schema) {
    let terms = json!({ "required": ["terms"], "properties": { "terms": { "minItems": 1 } } });
    schema.insert("anyOf".into(), json!([terms, { "required": ["image"] }]));
}

/// Requires both counts of cells, or a tolerance.
pub(crate) fn cells_or_tolerance(schema: &mut Schema) {
    let any = |keys: &[&str]| {
        let kinds: Vec<Value> = keys.iter().map(|key| json!({ "required": [key] })).collect();
        json!({ "anyOf": kinds })
    };
    let bounds = any(&["tol", "angle_deg", "pixels", "camera", "max_quads"]);
    let both = json!({ "required": ["rows", "cols"], "not": bounds });
    let mut near = any(&["tol", "angle_deg", "pixels"]);
    near["not"] = any(&["rows", "cols"]);
    schema.insert("oneOf".into(), json!([both, near]));
    schema.insert("not".into(), json!({ "required": ["tol", "pixels"] }));
    schema.insert("dependentRequired".into(), json!({ "camera": ["pixels"] }));
}
