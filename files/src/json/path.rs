//! Finds the values of a JSON text by their paths.

use jsonc_parser::ast::Value;
use jsonc_parser::common::Ranged;
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};

/// Returns the byte offset of the value at `path`, or of the deepest value on the path that exists.
pub(super) fn offset_of(text: &str, path: &str) -> Option<usize> {
    let parsed = parse_to_ast(text, &CollectOptions::default(), &ParseOptions::default()).ok()?;
    let root = parsed.value?;
    let mut value = &root;
    for step in path.split(['.', '[']).filter(|step| !step.is_empty()) {
        let next = match (value, step.strip_suffix(']')) {
            (Value::Array(array), Some(index)) => {
                index.parse().ok().and_then(|index: usize| array.elements.get(index))
            }
            (Value::Object(object), None) => object
                .properties
                .iter()
                .find(|property| property.name.as_str() == step)
                .map(|property| &property.value),
            _ => None,
        };
        match next {
            Some(found) => value = found,
            None => break,
        }
    }
    Some(value.start())
}

/// Returns the kind of the value at a path, if the text is complete and the value is not text. An
/// object is one without keys, since others are names with values.
pub(super) fn kind_at(text: &str, path: &str) -> Option<&'static str> {
    let offset = offset_of(text, path)?;
    match text[offset..].chars().next()? {
        '-' | '0'..='9' => Some("a number"),
        't' => Some("true"),
        'f' => Some("false"),
        'n' => Some("null"),
        '[' => Some("a list"),
        '{' => Some("an object without a name"),
        _ => None,
    }
}
