//! Mutations of JSON by its structure.
//!
//! Most of these mutations replace a value by another value of the same key, or change a number a
//! little. So many cases pass the reader's types and ranges and reach the work after them. A few
//! mutations change the text itself into forms that no JSON value has: numbers that overflow, and
//! keys that occur twice.

use super::text;
use crate::dice::Dice;
use fixtures::tree::{count, nth};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

/// Numbers that strain readers and arithmetic.
const NUMBERS: [f64; 28] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    2.0,
    3.0,
    0.5,
    1e-3,
    1e-9,
    -1e-9,
    1e-16,
    1e-30,
    1e-70,
    1e-320,
    5e-324,
    64.0,
    180.0,
    360.0,
    0.999_999_999,
    1e9,
    -1e9,
    1e15,
    1e29,
    1e31,
    1e155,
    1e308,
    -1e308,
    2_147_483_648.0,
];

/// Texts that strain a program that prints them or takes them for a path.
const TEXTS: [&str; 14] = [
    "",
    " ",
    "\u{1b}[2J",
    "a\nb",
    "\u{202e}abc",
    "../../..",
    "/",
    ".",
    "a\0b",
    "NaN",
    "-",
    "\u{1f600}",
    "M0 0C1 1 1e300 0 0 0Z",
    "%s<b>&amp;\"'",
];

/// Tokens of JSON text, valid and invalid.
const TOKENS: [&str; 20] = [
    "{",
    "}",
    "[",
    "]",
    ",",
    ":",
    "\"",
    "\\",
    "null",
    "true",
    "1e400",
    "-1e-400",
    "NaN",
    "0x1",
    "18446744073709551616",
    "1e99999999999",
    "\\ud800",
    "/*",
    "\u{feff}",
    "\t",
];

/// Values by their keys, from many documents.
#[derive(Debug, Default)]
pub struct Index {
    by_key: BTreeMap<String, Vec<Value>>,
    /// The keys that occur beside each other, by the key above them.
    siblings: BTreeMap<String, Vec<String>>,
}

impl Index {
    /// Makes the index of some documents.
    #[must_use]
    pub fn of<'a>(documents: impl IntoIterator<Item = &'a Value>) -> Self {
        let mut index = Self::default();
        documents.into_iter().for_each(|document| index.add("", document));
        index
    }

    fn add(&mut self, key: &str, value: &Value) {
        match value {
            Value::Object(object) => {
                let siblings = self.siblings.entry(key.into()).or_default();
                siblings.extend(object.keys().cloned());
                siblings.sort();
                siblings.dedup();
                object.iter().for_each(|(key, value)| self.add(key, value));
            }
            Value::Array(list) => {
                let element = format!("{key}[]");
                list.iter().for_each(|value| self.add(&element, value));
            }
            _ => {}
        }
        self.by_key.entry(key.into()).or_default().push(value.clone());
    }

    /// Returns a value that occurs under this key in some document.
    fn like(&self, key: &str, dice: &mut Dice) -> Option<Value> {
        self.by_key.get(key).map(|values| dice.one(values).clone())
    }

    /// Returns a key that occurs below the key `above` in some document, and one of its values.
    fn sibling(&self, above: &str, dice: &mut Dice) -> Option<(String, Value)> {
        let key = dice.one(self.siblings.get(above)?);
        Some((key.clone(), self.like(key, dice)?))
    }
}

/// Changes a document at one position.
pub fn mutate(document: &mut Value, dice: &mut Dice, index: &Index) {
    let total = count(document);
    let mut at = dice.below(total);
    // Most often a number, whose change is the mildest.
    for _ in 0..dice.below(6) {
        if nth(document, at).0.is_number() {
            break;
        }
        at = dice.below(total);
    }
    let (place, key) = nth(document, at);
    if dice.once_in(4)
        && let Some(other) = index.like(&key, dice)
    {
        *place = other;
        return;
    }
    match place {
        Value::Number(number) => *place = other_number(number.as_f64().unwrap_or(0.0), dice),
        Value::Array(list) if !list.is_empty() => array(list, dice),
        Value::Object(object) if !object.is_empty() => keys(object, &key, dice, index),
        Value::String(text) if dice.once_in(3) => *text = other_text(text, dice),
        _ if dice.once_in(2) => {
            if let Some(other) = index.like(&key, dice) {
                *place = other;
            }
        }
        _ => {
            *place = dice
                .one(&[Value::Null, json!(true), json!([]), json!({}), json!("word"), json!(7)])
                .clone();
        }
    }
}

/// Returns the document as text. The text itself is mutated once in ten cases.
#[must_use]
pub fn written(document: &Value, dice: &mut Dice, other: &Value) -> Vec<u8> {
    let mut bytes = document.to_string().into_bytes();
    if dice.once_in(10) {
        match dice.below(8) {
            0 => {
                let deep = dice.one(&["[", "{\"a\":", "[[0],"]).repeat(*dice.one(&[50, 200, 5000]));
                let at = dice.below(bytes.len());
                bytes.splice(at..at, deep.bytes());
            }
            1 => {
                let all = String::from_utf8_lossy(&bytes).into_owned();
                let twice =
                    format!("{},{}", all.trim_end_matches('}'), all.trim_start_matches('{'));
                bytes = twice.into_bytes();
            }
            2..4 => text::number(&mut bytes, dice),
            _ => text::mutate(&mut bytes, dice, &TOKENS, other.to_string().as_bytes()),
        }
    }
    bytes
}

fn other_number(old: f64, dice: &mut Dice) -> Value {
    match dice.below(12) {
        0..3 => json!(old * (0.5 + dice.fraction())),
        3..5 if old.fract() == 0.0 => json!(old as i64 + dice.below(5) as i64 - 2),
        5 => json!(-old),
        6 => json!(old + 1e-9),
        7 => json!(old * 10_f64.powi(dice.below(40) as i32 - 20)),
        8 => json!(old.round() as i64),
        9 => json!(dice.fraction()),
        _ => json!(dice.one(&NUMBERS)),
    }
}

fn other_text(old: &str, dice: &mut Dice) -> String {
    match dice.below(6) {
        0 => old.to_uppercase(),
        1 => format!("{old}{}", dice.one(&TEXTS)),
        2 => "long ".repeat(*dice.one(&[20, 200, 4000])),
        3 => {
            let mut bytes = old.as_bytes().to_vec();
            text::mutate(&mut bytes, dice, &[], b"");
            String::from_utf8_lossy(&bytes).into_owned()
        }
        _ => (*dice.one(&TEXTS)).into(),
    }
}

fn array(list: &mut Vec<Value>, dice: &mut Dice) {
    let (a, b) = (dice.below(list.len()), dice.below(list.len()));
    match dice.below(7) {
        0 => list.swap(a, b),
        1 => drop(list.remove(a)),
        2 => list.insert(b, list[a].clone()),
        3 => list[a] = list[b].clone(),
        4 => list.reverse(),
        5 => list.truncate(a),
        _ => {
            // Seldom very many copies: they reveal work that grows faster than the input.
            let copies = if dice.once_in(30) { 1500 } else { *dice.one(&[2, 3, 20]) };
            (0..copies).for_each(|_| list.insert(b, list[a].clone()));
        }
    }
}

fn keys(object: &mut Map<String, Value>, above: &str, dice: &mut Dice, index: &Index) {
    let names: Vec<String> = object.keys().cloned().collect();
    let (a, b) = (dice.one(&names), dice.one(&names));
    match dice.below(9) {
        0..5 => {
            if let Some((key, value)) = index.sibling(above, dice) {
                object.insert(key, value);
            }
        }
        5 => drop(object.remove(a)),
        6 => {
            // An object with one key is often a choice between kinds.
            if let Some((key, value)) = index.sibling(above, dice) {
                object.remove(a);
                object.insert(key, value);
            }
        }
        7 => object[a] = object[b].clone(),
        _ => {
            if let Some(value) = object.remove(a) {
                object.insert(other_text(a, dice), value);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn most_mutations_change_the_document() {
        let seed = json!({"a": [1, 2.5], "b": {"c": "x"}, "d": true});
        let index = Index::of([&seed]);
        let mut changed = 0;
        for case in 0..300 {
            let mut value = seed.clone();
            mutate(&mut value, &mut crate::dice::of_case(0, "json", case), &index);
            changed += usize::from(value != seed);
        }
        assert!(changed > 150, "{changed}");
    }
}
