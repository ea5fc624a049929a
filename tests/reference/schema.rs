//! The types of a JSON Schema as sections of a page: objects with their keys, and choices with their values.

use serde_json::Value;
use std::collections::{BTreeSet, VecDeque};

/// A schema with its definitions.
#[derive(Debug, Clone, Copy)]
pub struct Schema<'a>(pub &'a Value);

/// A type of a schema.
#[derive(Debug)]
pub struct Section<'a> {
    /// Name of the type; that of an object inside another ends with its key, as in `Spec.uv`.
    pub name: String,
    pub description: &'a str,
    pub keys: Vec<Key<'a>>,
    /// Words that may stand instead of an object, or all values of a choice, each with its description.
    pub words: Vec<(&'a Value, &'a str)>,
}

/// A key of an object.
#[derive(Debug, Clone, Copy)]
pub struct Key<'a> {
    pub name: &'a str,
    pub schema: &'a Value,
    pub required: bool,
    /// The description of the choice that has only this key; empty if there is none.
    pub choice: &'a str,
}

pub fn text<'a>(schema: &'a Value, key: &str) -> &'a str {
    schema[key].as_str().unwrap_or_default()
}

/// Returns the schemas of a keyword that lists some, or none.
pub fn list<'a>(schema: &'a Value, keyword: &str) -> &'a [Value] {
    schema[keyword].as_array().map_or(&[], Vec::as_slice)
}

/// Returns the alternatives of a schema, or none.
pub fn alternatives(schema: &Value) -> impl Iterator<Item = &Value> {
    list(schema, "oneOf").iter().chain(list(schema, "anyOf"))
}

impl<'a> Schema<'a> {
    /// Follows references to the schema that they name. Returns the last name too.
    pub fn resolved(self, mut schema: &'a Value) -> (&'a Value, Option<&'a str>) {
        let mut name = None;
        while let Some(path) = schema["$ref"].as_str() {
            let last = path.rsplit('/').next().unwrap_or_default();
            (schema, name) = (&self.0["$defs"][last], Some(last));
        }
        (schema, name)
    }

    /// Returns the schemas of whole documents, the most usual first.
    pub fn roots(self) -> Vec<&'a Value> {
        let all = [&self.0["else"], &self.0["then"], self.0];
        let parts = all.into_iter().flat_map(|one| list(one, "allOf").iter().chain([one]));
        parts.filter(|one| one["$ref"].is_string()).collect()
    }

    /// Returns the keys of an object, or of the objects that are its alternatives.
    pub fn keys(self, schema: &'a Value) -> Vec<Key<'a>> {
        let required = |of: &'a Value, name: &str| {
            list(of, "required").iter().any(|key| key.as_str() == Some(name))
        };
        let own = |of: &'a Value, alone: bool| {
            let keys = of["properties"].as_object().into_iter().flatten();
            keys.map(move |(name, schema)| Key {
                name,
                schema,
                required: alone && required(of, name),
                choice: if alone { "" } else { text(of, "description") },
            })
        };
        let mut keys: Vec<Key<'a>> = own(schema, true).collect();
        if keys.is_empty() {
            keys.extend(alternatives(schema).flat_map(|one| own(one, false)));
        }
        keys.sort_by_key(|key| (!key.required, key.name));
        keys.dedup_by_key(|key| key.name);
        keys
    }

    /// Returns the words of a choice, each with its description.
    fn words(schema: &'a Value) -> Vec<(&'a Value, &'a str)> {
        let mut words = Vec::new();
        for one in alternatives(schema) {
            if let Some(word) = one.get("const") {
                words.push((word, text(one, "description")));
            }
            words.extend(list(one, "enum").iter().map(|word| (word, text(one, "description"))));
        }
        words.extend(list(schema, "enum").iter().map(|word| (word, "")));
        words
    }

    /// Returns whether a type has a section of its own.
    pub fn has_section(self, schema: &'a Value) -> bool {
        !self.keys(schema).is_empty() || Self::words(schema).len() > 1
    }

    /// Returns all types, each after the first that refers to it.
    pub fn sections(self) -> Vec<Section<'a>> {
        let mut sections = Vec::new();
        let mut seen: BTreeSet<String> = BTreeSet::new();
        let mut open: VecDeque<(String, &'a Value)> =
            self.roots().into_iter().map(|root| (String::new(), root)).collect();
        while let Some((place, schema)) = open.pop_front() {
            let (schema, name) = self.resolved(schema);
            let named = name.map_or(place.clone(), str::to_owned);
            let own = self.has_section(schema);
            if (own || name.is_some()) && !seen.insert(named.clone()) {
                continue;
            }
            let place = if own || name.is_some() { named } else { place };
            let keys = self.keys(schema);
            let inside = keys.iter().map(|key| (format!("{place}.{}", key.name), key.schema));
            open.extend(inside);
            let others = ["items", "additionalProperties"].map(|keyword| &schema[keyword]);
            let tuple = list(schema, "prefixItems").iter();
            let more = others.into_iter().chain(tuple).filter(|one| one.is_object());
            let choices = alternatives(schema).filter(|one| one["properties"].is_null());
            open.extend(more.chain(choices).map(|one| (place.clone(), one)));
            if own {
                let description = text(schema, "description");
                sections.push(Section {
                    name: place,
                    description,
                    keys,
                    words: Self::words(schema),
                });
            }
        }
        sections
    }

    /// Describes the values that a schema accepts, in Markdown. `place` is the section and the key.
    pub fn values(self, schema: &'a Value, place: &str) -> String {
        let (inner, name) = self.resolved(schema);
        if self.has_section(inner) {
            let name = name.unwrap_or(place);
            return format!("[{name}](#{})", anchor(name));
        }
        if let Some(word) = inner.get("const") {
            return format!("`{word}`");
        }
        let choices: Vec<String> = alternatives(inner)
            .map(|one| self.values(one, place))
            .filter(|one| !one.is_empty())
            .collect();
        if !choices.is_empty() {
            return choices.join(" or ");
        }
        match inner["type"].as_str() {
            Some("string") => "text".into(),
            Some("boolean") => "`true`, `false`".into(),
            Some("integer") => format!("whole number{}", range(inner)),
            Some("number") => format!("number{}", range(inner)),
            Some("array") => self.array(inner, place),
            Some("object") if inner["additionalProperties"].is_object() => {
                format!(
                    "object: names, each with {}",
                    self.values(&inner["additionalProperties"], place)
                )
            }
            Some("object") => "object".into(),
            _ => String::new(),
        }
    }

    fn array(self, schema: &'a Value, place: &str) -> String {
        let tuple: Vec<String> =
            list(schema, "prefixItems").iter().map(|one| self.values(one, place)).collect();
        if !tuple.is_empty() {
            return format!("pair: {}", tuple.join(", "));
        }
        let items = self.values(&schema["items"], place);
        let (least, most) = (schema["minItems"].as_u64(), schema["maxItems"].as_u64());
        match (least, most) {
            (Some(least), Some(most)) if least == most => format!("list of {least}: {items}"),
            (Some(least), _) => format!("list of at least {least}: {items}"),
            _ => format!("list: {items}"),
        }
    }
}

/// Bounds of numbers beyond which a schema states no real range.
const NO_BOUND: f64 = 1e29;

/// Least sizes of numbers that are only above 0.
const ABOVE_0: f64 = 1e-29;

/// Describes the range of a number.
fn range(schema: &Value) -> String {
    let bound = |keyword: &str| schema[keyword].as_f64().filter(|bound| bound.abs() < NO_BOUND);
    let tiny = |bound: f64| bound > 0.0 && bound < ABOVE_0;
    let low = match (bound("minimum"), bound("exclusiveMinimum")) {
        (Some(bound), _) if tiny(bound) => Some("above 0".to_owned()),
        (Some(bound), _) => Some(format!("at least {}", short(bound))),
        (None, Some(bound)) => Some(format!("above {}", short(bound))),
        (None, None) => None,
    };
    let high = match (bound("maximum"), bound("exclusiveMaximum")) {
        (Some(bound), _) => Some(format!("at most {}", short(bound))),
        (None, Some(bound)) => Some(format!("below {}", short(bound))),
        (None, None) => None,
    };
    match (bound("minimum").filter(|&bound| !tiny(bound)), bound("maximum"), low, high) {
        (Some(low), Some(high), ..) => format!(" from {} to {}", short(low), short(high)),
        (_, _, Some(low), Some(high)) => format!(" {low} and {high}"),
        (_, _, Some(one), None) | (_, _, None, Some(one)) => format!(" {one}"),
        _ => String::new(),
    }
}

/// Returns a number without a fraction of 0.
fn short(number: f64) -> String {
    if (1e-5..1e15).contains(&number.abs()) || number == 0.0 {
        format!("{number}")
    } else {
        format!("{number:e}")
    }
}

/// Returns the anchor that GitHub gives a heading.
pub fn anchor(name: &str) -> String {
    name.to_lowercase().chars().filter(|c| c.is_alphanumeric() || *c == '-' || *c == '_').collect()
}
