//! Interpolation between two neighbouring values: of the keys of a law, or of contours.
//!
//! A new member must provide its name in a spec (from its variant), [`Ease::weight`], [`Ease::graph`],
//! [`Ease::crossing`] and [`Ease::has_kinks`]. The weight rises from 0 at 0 to 1 at 1.

use crate::curve::Cubic;
use glam::DVec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Number of bisections that find where a smooth weight has a value; each gives one binary digit, and a double has
/// 53.
const BISECTIONS: usize = 60;

/// Interpolation between two keys.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Ease {
    /// Linear interpolation.
    #[default]
    Linear,
    /// Cubic interpolation with slope 0 at every key.
    Smooth,
}

impl Ease {
    /// Returns the weight of the second value and its derivative, at `x` in `[0, 1]` between the values.
    pub(crate) fn weight(self, x: f64) -> (f64, f64) {
        match self {
            Self::Linear => (x, 1.0),
            Self::Smooth => (x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x)),
        }
    }

    /// Returns the graph between two keys as a cubic.
    pub(super) fn graph(self, from: DVec2, to: DVec2) -> Cubic<DVec2> {
        let mut cubic = Cubic::line(from, to);
        match self {
            Self::Linear => {}
            Self::Smooth => (cubic.0[1].y, cubic.0[2].y) = (from.y, to.y),
        }
        cubic
    }

    /// Returns the `x` in `[0, 1]` at which the weight is `part`, also in `[0, 1]`.
    pub(super) fn crossing(self, part: f64) -> f64 {
        match self {
            Self::Linear => part,
            Self::Smooth => {
                let (mut low, mut high) = (0.0, 1.0);
                for _ in 0..BISECTIONS {
                    let x = 0.5 * (low + high);
                    if self.weight(x).0 < part { low = x } else { high = x }
                }
                high
            }
        }
    }

    /// Returns whether the derivative jumps at keys.
    pub(super) fn has_kinks(self) -> bool {
        match self {
            Self::Linear => true,
            Self::Smooth => false,
        }
    }
}
