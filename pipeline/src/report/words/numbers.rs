//! Numbers as one says them.

/// An error to two digits, such as `0.21` or `0.0083`.
#[must_use]
pub fn error(value: f64) -> String {
    digits(value, 2)
}

/// A number above 0 to so many digits, without a power of ten from 1e-5 to 1e6.
#[must_use]
pub fn digits(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{}", value + 0.0);
    }
    // Rounded first: 0.0996 has its two digits where 0.10 has them.
    let rounded: f64 = format!("{value:.*e}", digits.max(1) - 1).parse().unwrap_or(value);
    let power = rounded.abs().log10().floor() as i32;
    if (-5..6).contains(&power) {
        let after = (digits as i32 - 1 - power).max(0) as usize;
        format!("{rounded:.after$}")
    } else {
        format!("{rounded:e}")
    }
}

/// Seconds in the unit that suits their size, to two digits; whole above 100.
#[must_use]
pub fn seconds(value: f64) -> String {
    match value {
        v if v >= 100.0 => format!("{v:.0} s"),
        v if v >= 0.9995 || v <= 0.0 || !v.is_finite() => format!("{} s", digits(v, 2)),
        v => format!("{} ms", digits(1e3 * v, 2)),
    }
}

/// Bytes as MiB or KiB.
#[must_use]
pub fn bytes(value: u64) -> String {
    let mib = value as f64 / f64::from(1 << 20);
    match mib {
        v if v >= 9.95 => format!("{v:.0} MiB"),
        v if v >= 0.1 => format!("{v:.1} MiB"),
        v => format!("{:.0} KiB", 1024.0 * v),
    }
}

/// How long one thing takes by another: `in a seventh of the time`.
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
    // A part is said where it is within a tenth of the number; in between, the number.
    let near = (whole * ratio).max(1.0 / (whole * ratio)) <= by;
    match PARTS.get(whole as usize - 2) {
        Some(part) if near && whole >= 2.0 => format!("in {part} of the time"),
        None if whole > 10.0 => format!("in 1/{whole:.0} of the time"),
        _ => format!("in {} of the time", digits(ratio, 2)),
    }
}

/// A factor: to two digits below 10, whole above.
#[must_use]
pub fn times(ratio: f64) -> String {
    if ratio >= 9.95 { format!("{ratio:.0}") } else { digits(ratio, 2) }
}

/// Things one after the other: `a`, `a and b`, `a, b and c`.
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
    fn numbers_have_two_digits() {
        for (value, text) in [
            (0.2149, "0.21"),
            (0.0996, "0.10"),
            (0.00834, "0.0083"),
            (3.96, "4.0"),
            (0.0, "0"),
            (-0.0, "0"),
            (f64::NAN, "NaN"),
            (1.5e-9, "1.5e-9"),
            (123_456.0, "120000"),
        ] {
            assert_eq!(error(value), text);
        }
        for (value, text) in [
            (0.0349, "35 ms"),
            (1.0, "1.0 s"),
            (0.9999, "1.0 s"),
            (12.34, "12 s"),
            (432.1, "432 s"),
        ] {
            assert_eq!(seconds(value), text);
        }
        assert_eq!(bytes(5_242_872), "5.0 MiB");
        assert_eq!(bytes(63_062_112), "60 MiB");
        assert_eq!(bytes(2048), "2 KiB");
    }

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
