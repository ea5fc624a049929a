//! Numbers as one reads them.

use std::time::Duration;

/// A count with a comma at each thousand.
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

/// A count in millions with two digits, or in full below a million.
#[must_use]
pub fn millions(value: u64) -> String {
    let millions = value as f64 / 1e6;
    match millions {
        m if m < 1.0 => count(value),
        m if m < 9.95 => format!("{m:.1} million"),
        m => format!("{m:.0} million"),
    }
}

/// Seconds, with as many digits as tell something.
#[must_use]
pub fn seconds(time: Duration) -> String {
    match time.as_secs_f64() {
        0.0 => "–".into(),
        s if s < 0.0095 => format!("{:.0} ms", (1e3 * s).max(1.0)),
        s if s < 9.95 => format!("{s:.2} s"),
        s => format!("{s:.1} s"),
    }
}

/// What the thesis calls minutes and hours.
#[must_use]
pub fn minutes(minutes: u32) -> String {
    match minutes {
        m if m < 60 => format!("{m} min"),
        m => format!("{} h", f64::from(m) / 60.0),
    }
}

/// How often one time goes into another, to two digits.
#[must_use]
pub fn times(ratio: f64) -> String {
    let step = 10_f64.powf(ratio.max(1.0).log10().floor() - 1.0).max(1.0);
    count(((ratio / step).round() * step) as u64)
}

/// An error to two digits.
#[must_use]
pub fn error(value: f64) -> String {
    let after =
        if value > 0.0 { (1.0 - value.log10().floor()).clamp(2.0, 6.0) as usize } else { 1 };
    format!("{value:.after$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_at_a_glance() {
        assert_eq!([count(7), count(7200), count(1_234_567)], ["7", "7,200", "1,234,567"]);
        assert_eq!([millions(999_999), millions(5_220_000)], ["999,999", "5.2 million"]);
        let time = |seconds| super::seconds(Duration::from_secs_f64(seconds));
        assert_eq!(
            [time(0.0), time(0.0042), time(0.61), time(12.34)],
            ["–", "4 ms", "0.61 s", "12.3 s"]
        );
        assert_eq!([minutes(20), minutes(90), minutes(180)], ["20 min", "1.5 h", "3 h"]);
        assert_eq!([times(7.4), times(1234.0), times(98_765.0)], ["7", "1,200", "99,000"]);
        assert_eq!(
            [error(0.214), error(0.0213), error(0.0), error(0.00047)],
            ["0.21", "0.021", "0.0", "0.00047"]
        );
    }
}
