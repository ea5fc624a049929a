//! JSON Schema of the specs, for editors and for programs that write them.
//!
//! It comes from the types that read a spec, with their pages as descriptions, and is of draft 2020-12.
//! What it refuses the reader refuses; what it cannot say (curves that meet, keys that rise, a mirrored
//! contour that meets itself) the reader alone knows. It is stricter where
//! the reader takes more than is meant: `null` for a key that is left out, an array of its values for an
//! object. It is laxer in one point: to JSON Schema `3.0` is a whole number.
//!
//! The functions here are what the types in [`spec`](crate::spec) say about themselves beyond their form.

use crate::spec::{Parts, Spec};
use schemars::Schema;
use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use serde_json::{Map, Value, json};
use std::ops::RangeInclusive;

pub(crate) use crate::read::{LARGEST, REPEATS, SMALLEST};

/// The schema of a spec, of one sweep or of parts.
#[must_use]
pub fn of_spec() -> Value {
    let settings = SchemaSettings::draft2020_12().with_transform(RecursiveTransform(plain));
    let mut generator = settings.into_generator();
    let (sweep, parts) = (generator.subschema_for::<Spec>(), generator.subschema_for::<Parts>());
    let types = generator.take_definitions(true);
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "tb-sweep",
        "description": "A contour swept along a trajectory, or several of them as `parts` of one \
                        object. Lengths are in any one unit, angles in degrees, y points up.",
        "type": "object",
        "if": { "required": ["parts"] },
        "then": parts,
        "else": { "allOf": [sweep], "required": ["format", "version"] },
        "$defs": types,
    })
}

/// Takes out what the types say that means nothing here, and bounds all numbers that nothing bounds.
fn plain(schema: &mut Schema) {
    let Some(object) = schema.as_object_mut() else {
        return;
    };
    object.remove("format");
    if object.get("default").is_some_and(Value::is_null) {
        object.remove("default");
    }
    if let Some(Value::Array(types)) = object.get_mut("type") {
        types.retain(|kind| kind != "null");
        if let [only] = &types[..] {
            let only = only.clone();
            object.insert("type".into(), only);
        }
    }
    if let Some(Value::Array(kinds)) = object.get_mut("anyOf") {
        kinds.retain(|kind| kind.get("type").is_none_or(|kind| kind != "null"));
        if let [Value::Object(only)] = &mut kinds[..] {
            let only = std::mem::take(only);
            object.remove("anyOf");
            object.extend(only);
        }
    }
    let bounded = ["minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum", "const"];
    if object.get("type").is_some_and(|kind| kind == "number")
        && !bounded.iter().any(|bound| object.contains_key(*bound))
    {
        object.insert("minimum".into(), json!(-LARGEST));
        object.insert("maximum".into(), json!(LARGEST));
    }
}

/// Inserts keywords into a schema, or into that of the innermost elements of an array.
fn insert(schema: &mut Schema, words: &Value) {
    fn innermost(object: &mut Map<String, Value>, words: &Value) {
        match (object.get_mut("items"), words) {
            (Some(Value::Object(items)), _) => innermost(items, words),
            (_, Value::Object(words)) => object.extend(words.clone()),
            _ => {}
        }
    }
    innermost(schema.ensure_object(), words);
}

/// Numbers from one to another.
pub(crate) fn range<N: Into<Value> + Copy>(range: RangeInclusive<N>) -> impl FnMut(&mut Schema) {
    let [low, high] = [*range.start(), *range.end()].map(Into::into);
    move |schema| insert(schema, &json!({ "minimum": low, "maximum": high }))
}

/// Numbers above one, up to another.
pub(crate) fn above(low: f64, high: f64) -> impl FnMut(&mut Schema) {
    move |schema| insert(schema, &json!({ "exclusiveMinimum": low, "maximum": high }))
}

/// Numbers above 0 that can be reckoned with, below another.
pub(crate) fn below(high: f64) -> impl FnMut(&mut Schema) {
    move |schema| insert(schema, &json!({ "minimum": SMALLEST, "exclusiveMaximum": high }))
}

/// Numbers above 0 that can be reckoned with.
pub(crate) fn positive(schema: &mut Schema) {
    range(SMALLEST..=LARGEST)(schema);
}

/// Whole numbers that stand for a texture or a surface.
pub(crate) fn id(schema: &mut Schema) {
    range(0..=u32::MAX)(schema);
}

/// One word.
pub(crate) fn word(schema: &mut Schema) {
    let pattern = "^[^\\s\\u0000-\\u001f\\u007f-\\u009f]+$";
    insert(schema, &json!({ "pattern": pattern }));
}

/// At least so many elements.
pub(crate) fn at_least(count: usize) -> impl FnMut(&mut Schema) {
    move |schema| {
        schema.insert("minItems".into(), json!(count));
    }
}

/// Points `[at, value]`, or lists of them, with `at` a part of a length.
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

/// Exactly one of the keys, besides those that go with one of them by `dependentRequired`.
pub(crate) fn one_of(schema: &mut Schema) {
    let besides = schema.get("dependentRequired").cloned().unwrap_or_default();
    let Some(Value::Object(properties)) = schema.get("properties") else {
        return;
    };
    let keys = properties.keys().filter(|key| besides.get(key.as_str()).is_none());
    let kinds: Vec<Value> = keys.map(|key| json!({ "required": [key] })).collect();
    schema.insert("oneOf".into(), kinds.into());
}

/// None of some keys of the type.
pub(crate) fn without(keys: &[&str]) -> impl FnMut(&mut Schema) {
    let kinds: Vec<Value> = keys.iter().map(|key| json!({ "required": [key] })).collect();
    move |schema| {
        schema.insert("not".into(), json!({ "anyOf": kinds }));
    }
}

/// At least three points where `closed`.
pub(crate) fn loop_of_three(schema: &mut Schema) {
    let closed = json!({ "properties": { "closed": { "const": true } }, "required": ["closed"] });
    let three = json!({ "properties": { "points": { "minItems": 3 } } });
    schema.insert("if".into(), closed);
    schema.insert("then".into(), three);
}

/// Waves or a picture.
pub(crate) fn terms_or_image(schema: &mut Schema) {
    let terms = json!({ "required": ["terms"], "properties": { "terms": { "minItems": 1 } } });
    schema.insert("anyOf".into(), json!([terms, { "required": ["image"] }]));
}

/// Both counts of cells, or a tolerance.
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
