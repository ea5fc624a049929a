//! Examples of each key of a schema, from documents that readers accept.

use super::schema::{Schema, alternatives, list};
use serde_json::Value;
use std::collections::BTreeMap;

/// An example of a key: the shortest value of it in any document.
#[derive(Debug, Clone)]
pub struct Example {
    /// The value as JSON, with a space after each comma and colon.
    pub text: String,
    /// The document.
    pub document: String,
}

/// The examples by section and key.
pub type Examples = BTreeMap<(String, String), Example>;

/// Returns an example of each key that occurs in documents, which are given with their names.
pub fn examples(schema: Schema<'_>, documents: &[(String, Value)]) -> Examples {
    let mut found = Collector { schema, document: "", examples: Examples::new() };
    for (name, document) in documents {
        found.document = name;
        for root in schema.roots() {
            if found.fits(document, root) {
                found.walk(document, root, "");
            }
        }
    }
    found.examples
}

struct Collector<'a> {
    schema: Schema<'a>,
    document: &'a str,
    examples: Examples,
}

impl<'a> Collector<'a> {
    /// Returns whether a value has the kind and the keys that a schema describes.
    fn fits(&self, value: &Value, schema: &'a Value) -> bool {
        let (schema, _) = self.schema.resolved(schema);
        if let Some(word) = schema.get("const") {
            return value == word;
        }
        let keys = self.schema.keys(schema);
        if let (Value::Object(object), false) = (value, keys.is_empty()) {
            let known = |name: &String| keys.iter().any(|key| key.name == name);
            let stated = |key: &super::schema::Key<'_>| {
                let word = key.schema.get("const");
                word.is_none() || object.get(key.name).is_none_or(|value| Some(value) == word)
            };
            return object.keys().all(known) && keys.iter().all(stated);
        }
        if alternatives(schema).any(|one| one["required"].is_null()) {
            return alternatives(schema).any(|one| self.fits(value, one));
        }
        let kind = match value {
            Value::Null => "null",
            Value::Bool(_) => "boolean",
            Value::Number(_) => "number",
            Value::String(_) => "string",
            Value::Array(_) => "array",
            Value::Object(_) => "object",
        };
        let stated = schema["type"].as_str().unwrap_or(kind);
        stated == kind || stated == "integer" && kind == "number"
    }

    fn walk(&mut self, value: &Value, schema: &'a Value, place: &str) {
        let (schema, name) = self.schema.resolved(schema);
        let place = name.unwrap_or(place).to_owned();
        let keys = self.schema.keys(schema);
        if let (Value::Object(object), false) = (value, keys.is_empty()) {
            for key in keys {
                if let Some(value) = object.get(key.name) {
                    self.record(&place, key.name, value);
                    self.walk(value, key.schema, &format!("{place}.{}", key.name));
                }
            }
            return;
        }
        let choice = alternatives(schema).find(|one| self.fits(value, one));
        if let Some(choice) = choice {
            self.walk(value, choice, &place);
            return;
        }
        match value {
            Value::Object(object) => {
                for value in object.values() {
                    self.walk(value, &schema["additionalProperties"], &place);
                }
            }
            Value::Array(items) => {
                let tuple = list(schema, "prefixItems");
                for (i, item) in items.iter().enumerate() {
                    self.walk(item, tuple.get(i).unwrap_or(&schema["items"]), &place);
                }
            }
            _ => {}
        }
    }

    fn record(&mut self, place: &str, key: &str, value: &Value) {
        let text = spaced(value);
        let entry = (place.to_owned(), key.to_owned());
        let better = |known: &Example| {
            // A value of 0 or an empty one shows less than another.
            let bare = |text: &str| matches!(text, "0" | "0.0" | "1" | "{}" | "[]" | "\"\"");
            (bare(&text), text.len()) < (bare(&known.text), known.text.len())
        };
        if self.examples.get(&entry).is_none_or(better) {
            let document = self.document.to_owned();
            self.examples.insert(entry, Example { text, document });
        }
    }
}

/// Returns JSON on one line, with a space after each comma and colon.
pub fn spaced(value: &Value) -> String {
    match value {
        Value::Array(items) => {
            let items: Vec<String> = items.iter().map(spaced).collect();
            format!("[{}]", items.join(", "))
        }
        Value::Object(object) if object.is_empty() => "{}".into(),
        Value::Object(object) => {
            let pair = |(key, value): (&String, &Value)| format!("\"{key}\": {}", spaced(value));
            let pairs: Vec<String> = object.iter().map(pair).collect();
            format!("{{ {} }}", pairs.join(", "))
        }
        Value::Number(number) => {
            let text = number.to_string();
            text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
        }
        other => other.to_string(),
    }
}
