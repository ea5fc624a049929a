//! Ranges of a field, as keywords of its JSON Schema. The reader checks the same ranges.

use crate::scene::limits::{LARGEST, SMALLEST};
use schemars::Schema;
use serde_json::{Map, Value, json};
use std::ops::RangeInclusive;

/// Inserts keywords into a schema. If the schema is that of an array, the keywords are inserted into
/// the schema of its innermost elements.
fn insert(schema: &mut Schema, keywords: &Value) {
    fn innermost(object: &mut Map<String, Value>, keywords: &Value) {
        if let Some(Value::Object(items)) = object.get_mut("items") {
            innermost(items, keywords);
        } else if let Value::Object(keywords) = keywords {
            object.extend(keywords.clone());
        }
    }
    innermost(schema.ensure_object(), keywords);
}

/// Numbers in a closed range.
pub(super) fn range<N: Into<Value> + Copy>(range: RangeInclusive<N>) -> impl FnMut(&mut Schema) {
    let [low, high] = [*range.start(), *range.end()].map(Into::into);
    move |schema| insert(schema, &json!({ "minimum": low, "maximum": high }))
}

/// Numbers in the open range from `low` to `high`.
pub(super) fn between(low: f64, high: f64) -> impl FnMut(&mut Schema) {
    move |schema| insert(schema, &json!({ "exclusiveMinimum": low, "exclusiveMaximum": high }))
}

/// Numbers from [`SMALLEST`] to [`LARGEST`].
pub(super) fn positive(schema: &mut Schema) {
    range(SMALLEST..=LARGEST)(schema);
}
