//! JSON Schema of scenes and their parts, for editors and for programs that write them.
//!
//! The schema is of draft 2020-12. It is generated from the types that read a scene ([`file`]), whose
//! documentation becomes its descriptions. The reader refuses every file that the schema refuses, with
//! two exceptions: the reader accepts `null` for a key that is left out, and an array of values for an
//! object. Only the reader checks relations between values, such as parallel edges, unknown names and
//! missing files. JSON Schema takes `3.0` for a whole number, and the reader does not.
//!
//! [`file`]: super::file

use super::file::{PartFile, SceneFile};
use super::limits::LARGEST;
use schemars::Schema;
use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use serde_json::{Value, json};

/// Returns the schema of scenes and of their parts. `format` decides which of the two applies.
#[must_use]
pub fn of_scene() -> Value {
    let settings = SchemaSettings::draft2020_12().with_transform(RecursiveTransform(plain));
    let mut generator = settings.into_generator();
    let scene = generator.subschema_for::<SceneFile>();
    let part = generator.subschema_for::<PartFile>();
    let types = generator.take_definitions(true);
    let is_part = json!({
        "properties": { "format": { "const": super::file::PART_FORMAT } }, "required": ["format"],
    });
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "tb-scene",
        "description": "What there is to see, how it is lit and from where it is seen; or a part of \
                        that, of format tb-scene-part. Lengths are in any one unit, angles in degrees, \
                        colours are linear, axes right-handed.",
        "type": "object",
        "if": is_part,
        "then": part,
        "else": scene,
        "$defs": types,
    })
}

/// Removes keywords of Rust types that mean nothing in JSON, and bounds each number without a range.
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
