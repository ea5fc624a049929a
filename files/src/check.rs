//! Findings of the `--check` of a program, and their form in print.

use std::fmt::{self, Display};

/// The weight of a finding, from the least to the most.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Useful to know, and often intended.
    Remark,
    /// Probably not intended.
    Hint,
    /// The result cannot be the one that the input means.
    Wrong,
}

/// A fact about an input that deserves attention.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// The weight of the finding.
    pub severity: Severity,
    /// The JSON path of the part of the input. The name of the file precedes it in an included file.
    pub path: String,
    /// A sentence with a number that the reader can act on.
    pub message: String,
}

impl Finding {
    /// Makes a finding about the part of the input at a JSON path.
    pub fn new(severity: Severity, path: impl Into<String>, message: impl Into<String>) -> Self {
        Self { severity, path: path.into(), message: message.into() }
    }
}

impl Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Remark => "remark",
            Self::Hint => "hint",
            Self::Wrong => "wrong",
        })
    }
}

impl Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}: {}", self.severity, self.path, self.message)
    }
}

/// Formats a number with four significant digits, without zeros at the end. Sizes below 1e-4 and from
/// 1e6 on have an exponent and three digits. Zero and numbers that are not finite are allowed.
#[must_use]
pub fn short(x: f64) -> String {
    let size = x.abs();
    if size != 0.0 && !(1e-4..1e6).contains(&size) {
        return format!("{x:.2e}");
    }
    let digits = if size < 1.0 { 4 } else { 3 - (size.log10().floor() as usize).min(3) };
    let text = format!("{x:.digits$}");
    match text.split_once('.') {
        Some((whole, part)) => {
            let part = part.trim_end_matches('0');
            let dot = if part.is_empty() { "" } else { "." };
            format!("{whole}{dot}{part}")
        }
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_the_digits_that_say_something() {
        for (x, text) in [
            (0.0, "0"),
            (0.999, "0.999"),
            (-0.25, "-0.25"),
            (12.3456, "12.35"),
            (1234.5, "1234"),
            (360.0, "360"),
            (1e-7, "1.00e-7"),
            (2.5e9, "2.50e9"),
        ] {
            assert_eq!(short(x), text);
        }
    }

    #[test]
    fn a_finding_is_printed_with_its_weight_and_its_path() {
        let finding = Finding::new(Severity::Hint, "camera.eye", "found 0");
        assert_eq!(finding.to_string(), "hint: camera.eye: found 0");
        assert!(Severity::Remark < Severity::Hint && Severity::Hint < Severity::Wrong);
    }
}
