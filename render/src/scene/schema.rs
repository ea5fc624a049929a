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
use serde_json::{Value, json};

/// Returns the schema of scenes and of their parts. `format` decides which of the two applies.
#[must_use]
pub fn of_scene() -> Value {
    let mut generator = files::schema::generator(LARGEST);
    let scene = generator.subschema_for::<SceneFile>();
    let part = generator.subschema_for::<PartFile>();
    let types = generator.take_definitions(true);
    let is_part = json!({
        "properties": { "format": { "const": super::file::PART_FORMAT } }, "required": ["format"],
    });
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "tb-scene",
        "description": "A scene (camera, lights, textures, materials and objects), or a part of a \
                        scene, of format tb-scene-part. Lengths are in any one unit, angles in \
                        degrees, colours are linear, axes right-handed.",
        "type": "object",
        "if": is_part,
        "then": part,
        "else": scene,
        "$defs": types,
    })
}
