//! JSON Schema of the specs, for editors and for programs that write specs.
//!
//! The schema, of draft 2020-12, is generated from the types that read a spec, with their docs as
//! descriptions. Whatever it refuses, the reader refuses too. Some rules cannot be expressed in it and are
//! checked by the reader alone: curves that meet, keys that rise, a mirrored contour that meets itself. The
//! schema is stricter where the reader accepts more than is intended: `null` for a key that is left out, or
//! an array of values for an object. It is laxer in one point: to JSON Schema `3.0` is a whole number.
//!
//! What the Rust form of the types does not say, the module `limits` adds.

use super::{Parts, Spec};
use crate::limits::LARGEST;
use schemars::Schema;
use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use serde_json::{Value, json};

/// Returns the schema of a spec, of one sweep or of parts.
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

/// Removes keywords of the types that mean nothing here, and bounds all numbers without bounds.
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
