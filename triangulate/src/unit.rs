//! The unit of length that a mesh file may state.

use clap::ValueEnum;

/// A unit of length. Its name on the command line is the one that a 3MF file states.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum Unit {
    /// A thousandth of a millimeter
    Micron,
    /// A millimeter, which printers assume
    #[default]
    Millimeter,
    /// Ten millimeters
    Centimeter,
    /// 25.4 millimeters
    Inch,
    /// Twelve inches
    Foot,
    /// A thousand millimeters
    Meter,
}

impl From<sweep::grid::Unit> for Unit {
    fn from(unit: sweep::grid::Unit) -> Self {
        match unit {
            sweep::grid::Unit::Um => Self::Micron,
            sweep::grid::Unit::Mm => Self::Millimeter,
            sweep::grid::Unit::Cm => Self::Centimeter,
            sweep::grid::Unit::In => Self::Inch,
            sweep::grid::Unit::Ft => Self::Foot,
            sweep::grid::Unit::M => Self::Meter,
        }
    }
}

impl Unit {
    /// Returns the name of the unit.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Micron => "micron",
            Self::Millimeter => "millimeter",
            Self::Centimeter => "centimeter",
            Self::Inch => "inch",
            Self::Foot => "foot",
            Self::Meter => "meter",
        }
    }

    /// Returns the length of the unit in meters.
    #[must_use]
    pub fn meters(self) -> f64 {
        match self {
            Self::Micron => 1e-6,
            Self::Millimeter => 1e-3,
            Self::Centimeter => 1e-2,
            Self::Inch => 0.0254,
            Self::Foot => 0.3048,
            Self::Meter => 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_the_word_of_the_command_line() {
        for &unit in Unit::value_variants() {
            assert_eq!(Unit::from_str(unit.name(), false), Ok(unit));
        }
        assert!((12.0 * Unit::Inch.meters() - Unit::Foot.meters()).abs() < 1e-15);
    }
}
