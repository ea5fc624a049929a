//! Formats numbers for people.

/// Formats a count with a comma at each thousand.
#[must_use]
pub fn count(value: u64) -> String {
    let digits = value.to_string();
    let mut text = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Formats a count in millions: with one decimal below 9.95 million, whole above; in full below a
/// million.
#[must_use]
pub fn millions(value: u64) -> String {
    let millions = value as f64 / 1e6;
    match millions {
        m if m < 1.0 => count(value),
        m if m < 9.95 => format!("{m:.1} million"),
        m => format!("{m:.0} million"),
    }
}

/// Formats a number with `digits` significant digits. Magnitudes from 1e-5 to below 1e6 are written
/// without an exponent. Zero and numbers that are not finite are written as they are.
#[must_use]
pub fn digits(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{}", value + 0.0);
    }
    // Rounding comes first, so that 0.0996 is written 0.10 with two digits.
    let rounded: f64 = format!("{value:.*e}", digits.max(1) - 1).parse().unwrap_or(value);
    let power = rounded.abs().log10().floor() as i32;
    if (-5..6).contains(&power) {
        let after = (digits as i32 - 1 - power).max(0) as usize;
        format!("{rounded:.after$}")
    } else {
        format!("{rounded:e}")
    }
}

/// Formats an error with two significant digits, such as `0.21` or `0.0083`.
#[must_use]
pub fn error(value: f64) -> String {
    digits(value, 2)
}

/// Formats seconds as s or ms with two significant digits; from 100 s on as whole seconds.
#[must_use]
pub fn seconds(value: f64) -> String {
    match value {
        v if v >= 100.0 => format!("{v:.0} s"),
        v if v >= 0.9995 || v <= 0.0 || !v.is_finite() => format!("{} s", digits(v, 2)),
        v => format!("{} ms", digits(1e3 * v, 2)),
    }
}

/// Formats the minutes of the thesis as min, or as h from one hour on.
#[must_use]
pub fn minutes(minutes: u32) -> String {
    match minutes {
        m if m < 60 => format!("{m} min"),
        m => format!("{} h", f64::from(m) / 60.0),
    }
}

/// Formats a number of bytes as MiB, or as KiB below 0.1 MiB.
#[must_use]
pub fn bytes(value: u64) -> String {
    let mib = value as f64 / f64::from(1 << 20);
    match mib {
        v if v >= 9.95 => format!("{v:.0} MiB"),
        v if v >= 0.1 => format!("{v:.1} MiB"),
        v => format!("{:.0} KiB", 1024.0 * v),
    }
}

/// Formats a ratio with two significant digits: as a decimal below 10, else whole with a comma at each
/// thousand.
#[must_use]
pub fn times(ratio: f64) -> String {
    if ratio < 9.95 {
        return digits(ratio, 2);
    }
    let step = 10_f64.powf(ratio.log10().floor() - 1.0);
    count(((ratio / step).round() * step) as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_read_at_a_glance() {
        assert_eq!([count(7), count(7200), count(1_234_567)], ["7", "7,200", "1,234,567"]);
        assert_eq!([millions(999_999), millions(5_220_000)], ["999,999", "5.2 million"]);
        assert_eq!([minutes(20), minutes(90), minutes(180)], ["20 min", "1.5 h", "3 h"]);
        let ratios = [0.7, 7.44, 9.96, 23.4, 1234.0, 98_765.0];
        assert_eq!(ratios.map(times), ["0.70", "7.4", "10", "23", "1,200", "99,000"]);
    }

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
}
