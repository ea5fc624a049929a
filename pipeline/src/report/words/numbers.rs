//! Writes numbers in words.

use crate::number::{digits, times};

/// Returns a ratio of times in words: `in a seventh of the time`.
#[must_use]
pub fn in_the_time(ratio: f64) -> String {
    const PARTS: [&str; 9] = [
        "half",
        "a third",
        "a quarter",
        "a fifth",
        "a sixth",
        "a seventh",
        "an eighth",
        "a ninth",
        "a tenth",
    ];
    let by = super::AS_FAST;
    if ratio > by {
        return format!("in {} times the time", times(ratio));
    }
    if ratio >= 1.0 / by {
        return "in about the same time".into();
    }
    let whole = (1.0 / ratio).round();
    // The fraction in words is used where it is within a tenth of the ratio, and the number otherwise.
    let near = (whole * ratio).max(1.0 / (whole * ratio)) <= by;
    match PARTS.get(whole as usize - 2) {
        Some(part) if near && whole >= 2.0 => format!("in {part} of the time"),
        None if whole > 10.0 => format!("in 1/{whole:.0} of the time"),
        _ => format!("in {} of the time", digits(ratio, 2)),
    }
}

/// Joins items to a list: `a`, `a and b`, `a, b and c`.
#[must_use]
pub fn list(things: &[String]) -> String {
    match things {
        [] => String::new(),
        [one] => one.clone(),
        [most @ .., last] => format!("{} and {last}", most.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_time_are_near_the_number() {
        for (ratio, text) in [
            (1.0 / 7.2, "in a seventh of the time"),
            (0.5, "in half of the time"),
            (0.7, "in 0.70 of the time"),
            (0.95, "in about the same time"),
            (1.08, "in about the same time"),
            (1.5, "in 1.5 times the time"),
            (23.4, "in 23 times the time"),
            (0.02, "in 1/50 of the time"),
            (0.1, "in a tenth of the time"),
            (0.4, "in 0.40 of the time"),
        ] {
            assert_eq!(in_the_time(ratio), text, "{ratio}");
        }
        assert_eq!(list(&["a".into(), "b".into(), "c".into()]), "a, b and c");
    }
}
