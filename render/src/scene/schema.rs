//! JSON Schema of scenes and their parts, for editors and for programs that write them.
//!
//! It comes from the types that read a scene, with their pages as descriptions, and is of draft
//! 2020-12. What it refuses the reader refuses; what it cannot say (edges that are parallel, names
//! that nothing has, files that are not there) the reader alone knows. It is stricter where the
//! reader takes more than is meant: `null` for a key that is left out, an array of its values for an
//! object. It is laxer in one point: to JSON Schema `3.0` is a whole number.
//!
//! The functions here are what the types in [`file`](super::file) say about themselves beyond their
//! form, and the ranges are those that the reader checks.

use super::file::{PartFile, SceneFile};
use files::schema::insert;
use schemars::Schema;
use serde_json::{Value, json};

pub use files::schema::range;

/// The largest number of a scene, without its sign. Products of three such numbers still have room
/// below the largest `f64`, and coordinates below the largest `f32`.
pub const LARGEST: f64 = 1e30;

/// The smallest number where one above 0 is asked for.
pub const SMALLEST: f64 = 1e-30;

/// Deeper recursion is refused: it would show nothing more and could exhaust the stack.
pub const DEEPEST: u32 = 64;

/// The schema of a scene and of a part of one, told apart by `format`.
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

/// Numbers above one and below another.
pub fn between(low: f64, high: f64) -> impl FnMut(&mut Schema) {
    move |schema| insert(schema, &json!({ "exclusiveMinimum": low, "exclusiveMaximum": high }))
}

/// Numbers above 0 that can be reckoned with.
pub fn positive(schema: &mut Schema) {
    range(SMALLEST..=LARGEST)(schema);
}
