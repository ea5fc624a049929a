//! Laws of values over the time of an animation.
//!
//! | written as | value at the time `t`, from 0 to 1 |
//! |---|---|
//! | `2` or `[1, 2, 3]` | the same at all times |
//! | `{"keys": [[t, value], ...], "ease": "smooth"}` | between keys, `linear` unless `ease` says otherwise |
//! | `{"bezier": [[[t, value], x 4], ...]}` | the graph of Bezier curves |
//! | `{"total": value}` | evenly from 0 to the value |
//! | `[law, law, ...]` | a list with a law for each number |
//!
//! Values of keys and totals are numbers or lists of numbers. Laws of numbers are those of specs
//! ([`sweep::law`]).

use serde_json::{Value, json};
use sweep::curve::Cubic;
use sweep::law::is_graph;
use sweep::spec;

/// A number or a list of numbers over the time of an animation.
#[derive(Debug, Clone)]
pub struct Law {
    numbers: Vec<sweep::law::Law>,
    is_list: bool,
    /// The law as it is written.
    text: Value,
}

impl PartialEq for Law {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

impl Law {
    /// Reads a law.
    ///
    /// # Errors
    /// With a sentence if the value is not a law.
    pub fn read(value: &Value) -> Result<Self, String> {
        let (parts, is_list) = match value {
            Value::Array(parts) => (parts.clone(), true),
            _ => match count(value)? {
                None => (vec![value.clone()], false),
                Some(count) => ((0..count).map(|k| part(value, k)).collect(), true),
            },
        };
        if parts.is_empty() {
            return Err("found an empty list, expected numbers or laws".into());
        }
        let numbers = parts.iter().map(number).collect::<Result<_, _>>()?;
        Ok(Self { numbers, is_list, text: value.clone() })
    }

    /// Returns the value at a time from 0 to 1.
    #[must_use]
    pub fn at(&self, time: f64) -> Value {
        let mut values = self.numbers.iter().map(|law| whole(law.at(time).0));
        if self.is_list {
            Value::from(values.collect::<Vec<Value>>())
        } else {
            values.next().unwrap_or_default()
        }
    }
}

/// Returns a number as JSON. Whole numbers have no fraction, so that counts may follow a law.
fn whole(number: f64) -> Value {
    const EXACT: f64 = (1_u64 << 53) as f64;
    if number.fract() == 0.0 && number.abs() < EXACT {
        Value::from(number as i64)
    } else {
        Value::from(number)
    }
}

/// Returns the count of numbers in the lists of a law of keys or of a total; `None` if its values are no lists.
fn count(value: &Value) -> Result<Option<usize>, String> {
    let own = |value: &Value| value.as_array().map(Vec::len);
    if let Some(total) = value.get("total") {
        return Ok(own(total));
    }
    let keys = value.get("keys").and_then(Value::as_array);
    let mut counts = keys.into_iter().flatten().map(|key| key.get(1).and_then(own));
    let first = counts.next().flatten();
    for (k, other) in counts.enumerate() {
        if other != first {
            let words = |count: Option<usize>| match count {
                None => "a number".to_string(),
                Some(count) => format!("a list of {count}"),
            };
            return Err(format!(
                "found {} at keys[{}], expected {}, as at keys[0]",
                words(other),
                k + 1,
                words(first)
            ));
        }
    }
    Ok(first)
}

/// Returns a law with only the numbers at this index of its lists.
fn part(value: &Value, index: usize) -> Value {
    let mut part = value.clone();
    if let Some(total) = part.get_mut("total") {
        *total = total[index].take();
    }
    if let Some(keys) = part.get_mut("keys").and_then(Value::as_array_mut) {
        for key in keys {
            *key = json!([key[0].take(), key[1][index].take()]);
        }
    }
    part
}

/// Reads the law of a number.
fn number(value: &Value) -> Result<sweep::law::Law, String> {
    let law: spec::Law = match serde_json::from_value(value.clone()) {
        Ok(law) => law,
        Err(error) => {
            let why = if value.is_object() { format!(" ({error})") } else { String::new() };
            return Err(format!(
                "found {}{why}, expected a law: a number, a list, or an object with keys, bezier or total",
                files::words::shown(&value.to_string())
            ));
        }
    };
    let point = |at: f64, value: f64| {
        let fits = (0.0..=1.0).contains(&at) && value.is_finite();
        fits.then_some(()).ok_or(format!("found a key at {at:?}, expected a time from 0 to 1"))
    };
    match law {
        spec::Law::Number(value) => Ok(sweep::law::Law::constant(value)),
        spec::Law::Total { total } => Ok(sweep::law::Law::total(total)),
        spec::Law::Keys { keys, ease } => {
            if keys.is_empty() {
                return Err("found no keys, expected at least one".into());
            }
            keys.iter().try_for_each(|&[at, value]| point(at, value))?;
            if let Some(two) = keys.windows(2).find(|two| two[1][0] <= two[0][0]) {
                let [[before, _], [at, _]] = [two[0], two[1]];
                return Err(format!(
                    "found a key at {at:?} behind {before:?}, expected rising times"
                ));
            }
            Ok(sweep::law::Law::keys(keys, ease))
        }
        spec::Law::Bezier { bezier } => {
            if bezier.is_empty() {
                return Err("found no segments, expected at least one".into());
            }
            bezier.iter().flatten().try_for_each(|&[at, value]| point(at, value))?;
            if bezier.windows(2).any(|two| two[1][0] != two[0][3]) {
                return Err(
                    "found segments apart, expected each to start where another ends".into()
                );
            }
            let cubics: Vec<_> =
                bezier.into_iter().map(|points| Cubic(points.map(Into::into))).collect();
            if !cubics.iter().all(is_graph) {
                return Err(
                    "found a segment that turns back, expected times to rise along it".into()
                );
            }
            Ok(sweep::law::Law::bezier(cubics))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(law: &Value, time: f64) -> Value {
        Law::read(law).unwrap().at(time)
    }

    #[test]
    fn numbers_and_lists_follow_their_laws() {
        assert_eq!(at(&json!(2), 0.3), json!(2));
        assert_eq!(at(&json!([1, 2]), 0.3), json!([1, 2]));
        assert_eq!(at(&json!({"total": 8}), 0.25), json!(2));
        assert_eq!(at(&json!({"total": [8, -4]}), 0.25), json!([2, -1]));
        let keys = json!({"keys": [[0, [0, 10]], [0.5, [4, 10]], [1, [4, 0]]]});
        assert_eq!(at(&keys, 0.25), json!([2, 10]));
        assert_eq!(at(&keys, 0.75), json!([4, 5]));
        let smooth = json!({"keys": [[0, 0], [1, 32]], "ease": "smooth"});
        // 3 x^2 - 2 x^3 of a quarter is 5 / 32.
        assert_eq!(at(&smooth, 0.25), json!(5));
        // The same curve as a Bezier.
        let third = 1.0 / 3.0;
        let bezier = json!({"bezier": [[[0, 0], [third, 0], [2.0 * third, 32], [1, 32]]]});
        assert!((at(&bezier, 0.25).as_f64().unwrap() - 5.0).abs() < 1e-9);
        assert_eq!(at(&json!([1, {"total": 2}]), 0.5), json!([1, 1]));
    }

    #[test]
    fn what_is_no_law_is_refused() {
        for (law, part) in [
            (json!("fast"), "found \"fast\", expected a law"),
            (json!(null), "expected a law"),
            (json!([]), "an empty list"),
            (json!({}), "expected a law"),
            (json!({"keys": []}), "no keys"),
            (json!({"key": [[0, 1]]}), "key"),
            (json!({"keys": [[0, 1], [0, 2]]}), "a key at 0.0 behind 0.0"),
            (json!({"keys": [[0, 1], [1.5, 2]]}), "a key at 1.5, expected a time"),
            (
                json!({"keys": [[0, [1, 2]], [1, [1]]]}),
                "found a list of 1 at keys[1], expected a list of 2",
            ),
            (
                json!({"keys": [[0, 1], [1, [1]]]}),
                "found a list of 1 at keys[1], expected a number",
            ),
            (json!({"bezier": [[[0, 0], [1, 0], [0, 1], [0.5, 1]]]}), "turns back"),
            (json!({"total": 1, "keys": [[0, 1]]}), "expected a law"),
            (json!([[1, 2], 3]), "expected a law"),
        ] {
            let said = Law::read(&law).unwrap_err();
            assert!(said.contains(part), "{law}: {said}");
        }
    }
}
