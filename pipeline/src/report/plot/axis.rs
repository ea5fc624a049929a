//! A logarithmic axis.

/// The unit of the numbers on an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Seconds, written as ns, µs, ms or s.
    Seconds,
    /// Numbers without a unit.
    Plain,
}

/// A logarithmic axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// The label of the axis.
    pub label: String,
    /// The unit of its numbers.
    pub unit: Unit,
    /// The smallest value, above 0.
    pub low: f64,
    /// The largest value, above `low`.
    pub high: f64,
}

/// A mark at a value of an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Tick {
    /// The value.
    pub at: f64,
    /// The label of the mark. Minor marks have none.
    pub label: Option<String>,
}

/// Margin beyond the outermost values, in decades.
const MARGIN: f64 = 0.12;

/// Shortest axis in decades. A shorter one would make differences of a few percent look large.
const LEAST: f64 = 0.8;

/// Below this length in decades, 2 and 5 also have labels.
const FEW: f64 = 2.2;

impl Axis {
    /// Makes an axis that shows all values from 1e-300 to 1e300, with a margin at both ends. Other
    /// values are ignored.
    #[must_use]
    pub fn around(label: &str, unit: Unit, values: impl Iterator<Item = f64>) -> Self {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.filter(|value| (1e-300..=1e300).contains(value)) {
            low = low.min(value.log10());
            high = high.max(value.log10());
        }
        if low > high {
            (low, high) = (-1.0, 0.0);
        }
        let more = (0.5 * (LEAST - (high - low))).max(0.0) + MARGIN;
        let value = |power: f64| 10.0_f64.powf(power);
        Self { label: label.into(), unit, low: value(low - more), high: value(high + more) }
    }

    /// Returns the position of a value along the axis: 0 at `low`, 1 at `high`, and outside [0, 1] for
    /// values beyond. `None` for 0, for negative values, and for values that are not finite.
    #[must_use]
    pub fn part(&self, value: f64) -> Option<f64> {
        let part = (value / self.low).ln() / (self.high / self.low).ln();
        part.is_finite().then_some(part)
    }

    /// Returns the marks: the values 1 to 9 of every power of ten. The powers have labels, and on a
    /// short axis 2 and 5 as well. Over more than 8 decades, only powers have marks, and only some have
    /// labels.
    #[must_use]
    pub fn ticks(&self) -> Vec<Tick> {
        let (low, high) = (self.low.log10(), self.high.log10());
        let few = high - low < FEW;
        let every = ((high - low) / 8.0).ceil().max(1.0) as i32;
        let mut ticks = Vec::new();
        for power in low.floor() as i32..=high.ceil() as i32 {
            for digit in 1..=9 {
                let at = f64::from(digit) * 10.0_f64.powi(power);
                if at < self.low || at > self.high || (every > 1 && digit > 1) {
                    continue;
                }
                let labelled = match digit {
                    1 => power.rem_euclid(every) == 0,
                    2 | 5 => few,
                    _ => false,
                };
                let label = labelled.then(|| self.unit.write(digit, power));
                ticks.push(Tick { at, label });
            }
        }
        ticks
    }
}

impl Unit {
    /// Returns the label of `digit * 10^power`.
    fn write(self, digit: u32, power: i32) -> String {
        match self {
            Self::Seconds if (-9..5).contains(&power) => {
                let (unit, of) = match power {
                    -9..-6 => ("ns", -9),
                    -6..-3 => ("\u{b5}s", -6),
                    -3..0 => ("ms", -3),
                    _ => ("s", 0),
                };
                format!("{digit}{} {unit}", "0".repeat((power - of) as usize))
            }
            Self::Plain if (-4..0).contains(&power) => {
                format!("0.{}{digit}", "0".repeat((-1 - power) as usize))
            }
            Self::Plain if (0..5).contains(&power) => {
                format!("{digit}{}", "0".repeat(power as usize))
            }
            _ => {
                let raised: String = power.to_string().chars().map(superscript).collect();
                let factor = if digit == 1 { String::new() } else { format!("{digit}\u{b7}") };
                let unit = if self == Self::Seconds { " s" } else { "" };
                format!("{factor}10{raised}{unit}")
            }
        }
    }
}

fn superscript(c: char) -> char {
    match c {
        '-' => '\u{207b}',
        '1' => '\u{b9}',
        '2' => '\u{b2}',
        '3' => '\u{b3}',
        '0' | '4'..='9' => char::from_u32(0x2070 + c.to_digit(10).unwrap_or_default()).unwrap_or(c),
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(unit: Unit, values: &[f64]) -> Vec<String> {
        let axis = Axis::around("", unit, values.iter().copied());
        axis.ticks().into_iter().filter_map(|tick| tick.label).collect()
    }

    #[test]
    fn powers_of_ten_are_written_as_one_writes_them() {
        assert_eq!(labels(Unit::Seconds, &[0.004, 30.0]), ["10 ms", "100 ms", "1 s", "10 s"]);
        assert_eq!(labels(Unit::Plain, &[0.02, 0.4]), ["0.02", "0.05", "0.1", "0.2", "0.5"]);
        assert_eq!(labels(Unit::Plain, &[0.5, 2e5]), ["1", "10", "100", "1000", "10000", "10⁵"]);
        assert_eq!(labels(Unit::Plain, &[2e-17, 2e-14]), ["10⁻¹⁶", "10⁻¹⁵", "10⁻¹⁴"]);
        assert_eq!(labels(Unit::Seconds, &[3e-6, 5e-5]), ["5 µs", "10 µs", "20 µs", "50 µs"]);
    }

    #[test]
    fn values_lie_within_and_in_proportion_to_their_logarithms() {
        let axis = Axis::around("", Unit::Plain, [0.01, 10.0].into_iter());
        let [a, b, c, d] = [0.01, 0.1, 1.0, 10.0].map(|value| axis.part(value).unwrap());
        assert!(a > 0.0 && d < 1.0);
        assert!((b - a - (c - b)).abs() < 1e-12 && (d - c - (c - b)).abs() < 1e-12);
        for none in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(axis.part(none), None, "{none}");
        }
    }

    #[test]
    fn an_axis_of_nothing_or_of_one_value_still_has_a_length() {
        for values in [&[][..], &[0.3], &[0.0, f64::NAN], &[1e-320], &[f64::MAX], &[1e-300, 1e300]]
        {
            let axis = Axis::around("", Unit::Plain, values.iter().copied());
            assert!(axis.low > 0.0 && axis.high > axis.low && axis.high.is_finite(), "{values:?}");
            assert!(!axis.ticks().is_empty(), "{values:?}");
        }
    }
}
