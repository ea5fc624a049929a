//! Changes of single values in a JSON text.
//!
//! A change replaces, adds or removes one value and leaves every other character as it is. So the user's order and
//! formatting survive, and errors keep their lines.

use jsonc_parser::ast::{Array, Object, Value as Node};
use jsonc_parser::common::Ranged;
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// A step on the path to a value.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Step {
    /// The index of an element, from 0.
    Index(usize),
    /// The key of a value in an object.
    Key(String),
}

/// A change of one value.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case", deny_unknown_fields)]
pub enum Edit {
    /// Sets the value. Keys that are missing on the path are added.
    Set {
        /// The path of the value.
        path: Vec<Step>,
        /// The new value.
        value: Value,
    },
    /// Inserts an element into a list, before the element that now has its index.
    Insert {
        /// The path of the new element, which ends with its index.
        path: Vec<Step>,
        /// The new element.
        value: Value,
    },
    /// Removes a key with its value, or an element of a list.
    Remove {
        /// The path of the value.
        path: Vec<Step>,
    },
}

/// Applies changes one after another.
///
/// # Errors
/// When the text is not JSON, or has no place for a value. The error is a sentence.
pub fn apply(text: &str, edits: &[Edit]) -> Result<String, String> {
    edits.iter().try_fold(text.to_owned(), |text, edit| one(&text, edit))
}

fn one(text: &str, edit: &Edit) -> Result<String, String> {
    let parsed = parse_to_ast(text, &CollectOptions::default(), &ParseOptions::default());
    let parsed = parsed.map_err(|_| "the text is not JSON: correct it first".to_string())?;
    let root = parsed.value.ok_or("the text is empty")?;
    let (path, value) = match edit {
        Edit::Set { path, value } | Edit::Insert { path, value } => (path, Some(value)),
        Edit::Remove { path } => (path, None),
    };
    let Some((last, above)) = path.split_last() else {
        return match value {
            Some(value) => Ok(written(value)),
            None => Err("the whole text cannot be removed".into()),
        };
    };
    let mut node = &root;
    for (k, step) in above.iter().enumerate() {
        match child(node, step) {
            Some(next) => node = next,
            None => return missing(text, node, &path[k..], value),
        }
    }
    match (edit, node, last) {
        (Edit::Insert { value, .. }, Node::Array(array), Step::Index(at)) => {
            inserted(text, array, *at, value)
        }
        (Edit::Insert { .. }, ..) => Err(no_place(last)),
        (Edit::Set { value, .. }, _, _) => match child(node, last) {
            Some(old) => {
                Ok(format!("{}{}{}", &text[..old.start()], written(value), &text[old.end()..]))
            }
            None => missing(text, node, std::slice::from_ref(last), Some(value)),
        },
        (Edit::Remove { .. }, Node::Array(array), Step::Index(at)) => {
            let ranges = array.elements.iter().map(|one| (one.start(), one.end())).collect();
            removed(text, ranges, *at, (array.start(), array.end()))
        }
        (Edit::Remove { .. }, Node::Object(object), Step::Key(key)) => {
            let at = object.properties.iter().rposition(|one| one.name.as_str() == key);
            let ranges = object.properties.iter().map(|one| (one.start(), one.end())).collect();
            match at {
                Some(at) => removed(text, ranges, at, (object.start(), object.end())),
                None => Ok(text.into()),
            }
        }
        (Edit::Remove { .. }, ..) => Err(no_place(last)),
    }
}

fn child<'n, 'a>(node: &'n Node<'a>, step: &Step) -> Option<&'n Node<'a>> {
    match (node, step) {
        (Node::Object(object), Step::Key(key)) => {
            let own = object.properties.iter().rfind(|one| one.name.as_str() == key)?;
            Some(&own.value)
        }
        (Node::Array(array), Step::Index(at)) => array.elements.get(*at),
        _ => None,
    }
}

/// Adds what the rest of a path names below a node that lacks its first step.
fn missing(
    text: &str,
    node: &Node<'_>,
    rest: &[Step],
    value: Option<&Value>,
) -> Result<String, String> {
    let Some(value) = value else { return Ok(text.into()) };
    let Some((first, below)) = rest.split_first() else { return Err("no path".into()) };
    let mut value = value.clone();
    for step in below.iter().rev() {
        value = match step {
            Step::Key(key) => Value::Object([(key.clone(), value)].into_iter().collect()),
            Step::Index(0) => Value::Array(vec![value]),
            Step::Index(_) => return Err(no_place(step)),
        };
    }
    match (node, first) {
        (Node::Object(object), Step::Key(key)) => Ok(added(text, object, key, &value)),
        (Node::Array(array), Step::Index(at)) if *at == array.elements.len() => {
            inserted(text, array, *at, &value)
        }
        _ => Err(no_place(first)),
    }
}

fn no_place(step: &Step) -> String {
    match step {
        Step::Index(at) => format!("the text has no list with a place for element {at}"),
        Step::Key(key) => format!("the text has no object with a place for \"{key}\""),
    }
}

/// Adds a key at the end of an object, on a line of its own if the last key has one.
fn added(text: &str, object: &Object<'_>, key: &str, value: &Value) -> String {
    let pair = format!("{}: {}", Value::from(key), written(value));
    match object.properties.last() {
        Some(last) => {
            let between = space_before(text, last.start());
            format!("{},{between}{pair}{}", &text[..last.end()], &text[last.end()..])
        }
        None => {
            let at = object.start() + 1;
            format!("{} {pair} {}", &text[..at], text[at..].trim_start())
        }
    }
}

fn inserted(text: &str, array: &Array<'_>, at: usize, value: &Value) -> Result<String, String> {
    let count = array.elements.len();
    let new = written(value);
    if at < count {
        let next = array.elements[at].start();
        let between = if at == 0 && count == 1 {
            " ".into()
        } else {
            space_before(text, array.elements[at.max(1)].start())
        };
        return Ok(format!("{}{new},{between}{}", &text[..next], &text[next..]));
    }
    if at > count {
        return Err(no_place(&Step::Index(at)));
    }
    Ok(match array.elements.last() {
        Some(last) => {
            let between = if count == 1 { " ".into() } else { space_before(text, last.start()) };
            format!("{},{between}{new}{}", &text[..last.end()], &text[last.end()..])
        }
        None => {
            format!("{}{new}{}", &text[..=array.start()], text[array.start() + 1..].trim_start())
        }
    })
}

/// Removes one of several values with its comma. `whole` is the range of the list or object around them.
fn removed(
    text: &str,
    ranges: Vec<(usize, usize)>,
    at: usize,
    whole: (usize, usize),
) -> Result<String, String> {
    let Some(&(start, end)) = ranges.get(at) else { return Err(no_place(&Step::Index(at))) };
    let (from, to) = match (at.checked_sub(1).map(|before| ranges[before].1), ranges.get(at + 1)) {
        (_, Some(&(next, _))) => (start, next),
        (Some(before), None) => (before, end),
        (None, None) => (whole.0 + 1, whole.1 - 1),
    };
    Ok(format!("{}{}", &text[..from], &text[to..]))
}

/// Returns the white space before a value, which is a line break with its indentation, or one space.
fn space_before(text: &str, at: usize) -> String {
    let before = &text[..at];
    let space = &before[before.trim_end().len()..];
    if space.contains('\n') { space.into() } else { " ".into() }
}

/// Returns a value as text with a space after each comma and colon, such as `[0.1, 0.2]`.
#[must_use]
pub fn written(value: &Value) -> String {
    match value {
        Value::Array(values) => {
            let values: Vec<String> = values.iter().map(written).collect();
            format!("[{}]", values.join(", "))
        }
        Value::Object(pairs) if pairs.is_empty() => "{}".into(),
        Value::Object(pairs) => {
            let pair = |(key, value): (&String, &Value)| {
                format!("{}: {}", Value::from(key.as_str()), written(value))
            };
            let pairs: Vec<String> = pairs.iter().map(pair).collect();
            format!("{{ {} }}", pairs.join(", "))
        }
        // A whole number is written without a point, as people write it.
        Value::Number(number) => match number.as_f64() {
            Some(whole) if whole.fract() == 0.0 && whole.abs() < 1e15 => {
                format!("{}", whole as i64)
            }
            _ => number.to_string(),
        },
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use serde_json::json;

    const TEXT: &str =
        "{\n  \"b\": [ [0,1],\n    [2, 3] ],   \"a\": {\"x\": 1.50},\n  \"c\":[]\n}\n";

    fn edited(edit: Value) -> String {
        one(TEXT, &serde_json::from_value(edit).unwrap()).unwrap()
    }

    #[test]
    fn only_the_value_changes() {
        let set = edited(json!({"do": "set", "path": ["b", 1, 0], "value": -7.25}));
        assert_eq!(set, TEXT.replace("[2, 3]", "[-7.25, 3]"));
        let set = edited(json!({"do": "set", "path": ["a", "x"], "value": [1.0, {"k": "v"}]}));
        assert_eq!(set, TEXT.replace("1.50", "[1, { \"k\": \"v\" }]"));
    }

    #[test]
    fn missing_keys_are_added_and_removed_again() {
        let set = edited(json!({"do": "set", "path": ["d", "e"], "value": 1}));
        assert_eq!(set, TEXT.replace("\"c\":[]", "\"c\":[],\n  \"d\": { \"e\": 1 }"));
        let edit = Edit::Remove { path: vec![Step::Key("d".into())] };
        assert_eq!(one(&set, &edit).unwrap(), TEXT);
        assert_eq!(edited(json!({"do": "remove", "path": ["missing", 3]})), TEXT);
        assert!(one(TEXT, &Edit::Set { path: vec![Step::Index(0)], value: json!(1) }).is_err());
    }

    #[test]
    fn elements_are_inserted_and_removed() {
        let first = edited(json!({"do": "insert", "path": ["b", 0], "value": [9, 9]}));
        assert_eq!(first, TEXT.replace("[ [0,1]", "[ [9, 9],\n    [0,1]"));
        let last = edited(json!({"do": "insert", "path": ["b", 2], "value": [9, 9]}));
        assert_eq!(last, TEXT.replace("[2, 3]", "[2, 3],\n    [9, 9]"));
        let into_empty = edited(json!({"do": "insert", "path": ["c", 0], "value": 5}));
        assert_eq!(into_empty, TEXT.replace("\"c\":[]", "\"c\":[5]"));
        let removed = edited(json!({"do": "remove", "path": ["b", 0]}));
        assert_eq!(removed, TEXT.replace("[0,1],\n    ", ""));
    }

    proptest! {
        #[test]
        fn an_edited_text_has_the_edited_value(k in 0_usize..2, at in 0_usize..3, x in -1e6..1e6_f64) {
            let mut expected: Value = serde_json::from_str(TEXT).unwrap();
            expected["b"][k] = json!([x, 1]);
            let path = vec![Step::Key("b".into()), Step::Index(k)];
            let text = one(TEXT, &Edit::Set { path, value: json!([x, 1]) }).unwrap();
            let found: Value = serde_json::from_str(&text).unwrap();
            prop_assert_eq!(&found, &expected);
            let path = vec![Step::Key("b".into()), Step::Index(at)];
            let text = one(&text, &Edit::Insert { path: path.clone(), value: json!("new") }).unwrap();
            let text = one(&text, &Edit::Remove { path }).unwrap();
            let found: Value = serde_json::from_str(&text).unwrap();
            prop_assert_eq!(found, expected);
        }
    }
}
