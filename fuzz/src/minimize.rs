//! Finds a small input with the same fault.
//!
//! JSON loses keys and elements as long as the fault stays. Then any input loses pieces, from
//! halves down to single bytes (Zeller and Hildebrandt 2002, without the complements). The result
//! is minimal only if the number of trials suffices.

use serde_json::Value;
use std::time::{Duration, Instant};

/// Largest number of trials.
const TRIALS: usize = 2000;

/// Time for all trials.
const TIME: Duration = Duration::from_secs(30);

/// Shrinks an input as long as `same` returns true for the smaller input, that is, as long as it
/// shows the same fault.
pub fn minimized(input: &[u8], same: &mut dyn FnMut(&[u8]) -> bool) -> Vec<u8> {
    let mut budget = Budget { trials: TRIALS, end: Instant::now() + TIME };
    let mut kept = input.to_vec();
    if let Ok(document) = serde_json::from_slice::<Value>(input) {
        let text = |value: &Value| value.to_string().into_bytes();
        if same(&text(&document)) {
            kept = text(&of_json(document, &mut |value| budget.spend() && same(&text(value))));
        }
    }
    of_bytes(kept, &mut |bytes| budget.spend() && same(bytes))
}

struct Budget {
    trials: usize,
    end: Instant,
}

impl Budget {
    fn spend(&mut self) -> bool {
        let left = self.trials > 0 && Instant::now() < self.end;
        self.trials = self.trials.saturating_sub(1);
        left
    }
}

/// Removes elements and keys of a document, from the outermost level inward.
fn of_json(mut document: Value, same: &mut dyn FnMut(&Value) -> bool) -> Value {
    let mut paths = vec![String::new()];
    let mut at = 0;
    while at < paths.len() {
        let path = paths[at].clone();
        let names: Vec<String> = match document.pointer(&path) {
            // From the last element on, so that the positions of the others stay.
            Some(Value::Array(list)) => (0..list.len()).rev().map(|i| i.to_string()).collect(),
            Some(Value::Object(object)) => object.keys().cloned().collect(),
            _ => Vec::new(),
        };
        for name in names {
            let mut less = document.clone();
            match less.pointer_mut(&path) {
                Some(Value::Array(list)) => {
                    name.parse().map(|i: usize| list.remove(i)).ok();
                }
                Some(Value::Object(object)) => drop(object.remove(&name)),
                _ => {}
            }
            if same(&less) {
                document = less;
            }
        }
        let left: Vec<String> = match document.pointer(&path) {
            Some(Value::Array(list)) => (0..list.len()).map(|i| i.to_string()).collect(),
            Some(Value::Object(object)) => object.keys().cloned().collect(),
            _ => Vec::new(),
        };
        let step = |name: String| format!("{path}/{}", name.replace('~', "~0").replace('/', "~1"));
        paths.extend(left.into_iter().map(step));
        at += 1;
    }
    document
}

/// Removes pieces of bytes, the largest first.
fn of_bytes(mut kept: Vec<u8>, same: &mut dyn FnMut(&[u8]) -> bool) -> Vec<u8> {
    let mut size = kept.len() / 2;
    while size > 0 {
        let mut at = 0;
        while at < kept.len() {
            let end = (at + size).min(kept.len());
            let less = [&kept[..at], &kept[end..]].concat();
            if same(&less) { kept = less } else { at = end }
        }
        size /= 2;
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_bytes_of_the_fault_are_left() {
        let input = b"many bytes X and more Y of them".repeat(3);
        let has = |bytes: &[u8]| bytes.contains(&b'X') && bytes.ends_with(b"m");
        assert_eq!(minimized(&input, &mut |bytes| has(bytes)), b"Xm");
    }

    #[test]
    fn json_stays_json() {
        let input = br#"{"a": [1, {"b/c": [7, 8, 9]}, 2], "d": {"e": "f"}}"#;
        let wrong = |bytes: &[u8]| {
            serde_json::from_slice::<Value>(bytes)
                .is_ok_and(|value| value.to_string().contains('8'))
        };
        let left = minimized(input, &mut |bytes| wrong(bytes));
        assert_eq!(String::from_utf8(left).unwrap(), "{\"\":[{\"\":[8]}]}");
    }
}
