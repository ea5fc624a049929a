//! Common parts of the JSON Schemas of all formats. A schema is generated from the types that read
//! a file.
//!
//! A schema is of draft 2020-12. It is stricter than a reader that accepts more than is intended:
//! `null` for a key that is left out, or an array of values for an object. It is laxer in one
//! point: to JSON Schema `3.0` is a whole number.

use schemars::Schema;
use schemars::generate::{SchemaGenerator, SchemaSettings};
use schemars::transform::RecursiveTransform;
use serde_json::{Map, Value, json};
use std::ops::RangeInclusive;

/// Makes a generator of schemas in which every number has bounds. Numbers whose type states no bounds
/// lie between `-largest` and `largest`.
#[must_use]
pub fn generator(largest: f64) -> SchemaGenerator {
    let plain = move |schema: &mut Schema| plain(schema, largest);
    SchemaSettings::draft2020_12().with_transform(RecursiveTransform(plain)).into_generator()
}

/// Removes keywords of the types that mean nothing in a file, and bounds all numbers without bounds.
fn plain(schema: &mut Schema, largest: f64) {
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
            // The description of a key takes precedence over the description of its type.
            for (word, value) in only {
                object.entry(word).or_insert(value);
            }
        }
    }
    let bounded = ["minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum", "const"];
    if object.get("type").is_some_and(|kind| kind == "number")
        && !bounded.iter().any(|bound| object.contains_key(*bound))
    {
        object.insert("minimum".into(), json!(-largest));
        object.insert("maximum".into(), json!(largest));
    }
}

/// Inserts keywords into a schema, or into the schema of an array's innermost elements.
pub fn insert(schema: &mut Schema, words: &Value) {
    fn innermost(object: &mut Map<String, Value>, words: &Value) {
        match (object.get_mut("items"), words) {
            (Some(Value::Object(items)), _) => innermost(items, words),
            (_, Value::Object(words)) => object.extend(words.clone()),
            _ => {}
        }
    }
    innermost(schema.ensure_object(), words);
}

/// Allows numbers in a closed range.
pub fn range<N: Into<Value> + Copy>(range: RangeInclusive<N>) -> impl FnMut(&mut Schema) {
    let [low, high] = [*range.start(), *range.end()].map(Into::into);
    move |schema| insert(schema, &json!({ "minimum": low, "maximum": high }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_bounds_and_a_key_that_may_be_missing_is_not_null() {
        let text = json!({ "type": ["number", "null"], "format": "double", "default": null });
        let mut schema = Schema::try_from(text).unwrap();
        plain(&mut schema, 1e30);
        let bounded = json!({ "type": "number", "minimum": -1e30, "maximum": 1e30 });
        assert_eq!(schema.to_value(), bounded);
    }

    #[test]
    fn a_key_that_may_be_missing_keeps_its_own_description() {
        let inner = json!({ "type": "string", "description": "of the type" });
        let key = json!({ "description": "of the key", "anyOf": [inner, { "type": "null" }] });
        let mut schema = Schema::try_from(key).unwrap();
        plain(&mut schema, 1e30);
        let expected = json!({ "type": "string", "description": "of the key" });
        assert_eq!(schema.to_value(), expected);
    }

    #[test]
    fn keywords_go_into_the_innermost_elements() {
        let list = json!({ "items": { "items": { "type": "number" } } });
        let mut schema = Schema::try_from(list).unwrap();
        range(0.0..=1.0)(&mut schema);
        let inner = json!({ "type": "number", "minimum": 0.0, "maximum": 1.0 });
        assert_eq!(schema.to_value(), json!({ "items": { "items": inner } }));
    }
}
