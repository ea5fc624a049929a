//! Ranges of a field, as keywords of its JSON Schema. The reader checks the same ranges.

use crate::scene::limits::{LARGEST, SMALLEST};
use files::schema::insert;
use schemars::Schema;
use serde_json::json;

pub(super) use files::schema::range;

/// Numbers in the open range from `low` to `high`.
pub(super) fn between(low: f64, high: f64) -> impl FnMut(&mut Schema) {
    move |schema| insert(schema, &json!({ "exclusiveMinimum": low, "exclusiveMaximum": high }))
}

/// Numbers from [`SMALLEST`] to [`LARGEST`].
pub(super) fn positive(schema: &mut Schema) {
    range(SMALLEST..=LARGEST)(schema);
}
