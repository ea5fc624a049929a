//! The unit of length of an object.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A unit of length. A mesh keeps its numbers; the unit tells printers and other programs their size.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Unit {
    /// Micrometre.
    Um,
    /// Millimetre.
    Mm,
    /// Centimetre.
    Cm,
    /// Inch.
    In,
    /// Foot.
    Ft,
    /// Metre.
    M,
}

impl Unit {
    /// Returns the name of the unit as in the file: `um`, `mm`, `cm`, `in`, `ft` or `m`.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Um => "um",
            Self::Mm => "mm",
            Self::Cm => "cm",
            Self::In => "in",
            Self::Ft => "ft",
            Self::M => "m",
        }
    }

    /// Returns the length of the unit in millimetres.
    #[must_use]
    pub fn millimetres(self) -> f64 {
        match self {
            Self::Um => 1e-3,
            Self::Mm => 1.0,
            Self::Cm => 10.0,
            Self::In => 25.4,
            Self::Ft => 304.8,
            Self::M => 1e3,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Unit;

    #[test]
    fn symbols_are_those_of_the_file() {
        for unit in [Unit::Um, Unit::Mm, Unit::Cm, Unit::In, Unit::Ft, Unit::M] {
            assert_eq!(serde_json::to_string(&unit).unwrap(), format!("{:?}", unit.symbol()));
        }
    }
}
