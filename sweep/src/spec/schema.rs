//! JSON Schema of the specs, for editors and for programs that write specs.
//!
//! The schema, of draft 2020-12, is generated from the types that read a spec, with their docs as
//! descriptions. Whatever it refuses, the reader refuses too. Some rules cannot be expressed in it and are
//! checked by the reader alone: curves that meet, keys that rise, a mirrored contour that meets itself. The
//! schema is stricter where the reader accepts more than is intended: `null` for a key that is left out, or
//! an array of values for an object. It is laxer in one point: to JSON Schema `3.0` is a whole number.
//!
//! The module `limits` adds the limits that the Rust form of the types does not state.

use super::{Parts, Spec};
use crate::limits::LARGEST;
use serde_json::{Value, json};

/// Returns the schema of a spec, of one sweep or of parts.
#[must_use]
pub fn of_spec() -> Value {
    let mut generator = files::schema::generator(LARGEST);
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
