//! Positions and copies of a whole part, as they are written.
//!
//! `place` is a list of motions of the finished part, applied one after another after `position`:
//!
//! | motion                                          | meaning                                        |
//! |-------------------------------------------------|------------------------------------------------|
//! | `{"translate": [x, y, z]}`                      | a translation                                  |
//! | `{"rotate_deg": {"axis": [x, y, z], "angle": a}}` | a right-handed rotation about an axis through the origin |
//! | `{"scale": s}`                                  | an enlargement from the origin, by the same factor in all directions |
//!
//! `copies` repeats a part: there are `count` of it, and each is moved by `step` once more than the one before it. The
//! second copy is a part named after the first, with `-copy2` at the end. Walls and reliefs are scaled with the part.
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "railing", "unit": "cm",
//!   "parts": [
//!     {
//!       "name": "baluster",
//!       "contour": { "svg": "M0 0H4V-3C2 -20 1 -40 3 -60V-80H0" },
//!       "trajectory": { "rotation": {} },
//!       "copies": { "count": 5, "step": [{ "translate": [15, 0, 0] }] },
//!       "mesh": { "rows": 24, "cols": 24 }
//!     },
//!     {
//!       "name": "rail",
//!       "contour": { "circle": 3 },
//!       "trajectory": { "line": [[-8, 82, 0], [68, 82, 0]] },
//!       "caps": { "start": "round", "end": "round" },
//!       "mesh": { "rows": 24, "cols": 24 }
//!     }
//!   ]
//! }
//! ```

use super::only;
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A motion of a finished part.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", try_from = "PlaceKeys")]
pub enum Place {
    /// A translation.
    Translate([f64; 3]),
    /// A rotation about an axis through the origin.
    RotateDeg(PlaceTurn),
    /// An enlargement from the origin.
    Scale(f64),
}

/// A rotation about an axis through the origin.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the keys axis and angle")]
pub struct PlaceTurn {
    /// Direction of the axis; of any length above 0.
    pub axis: [f64; 3],
    /// Angle in degrees, right-handed about the axis.
    pub angle: f64,
}

/// Copies of a part.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the keys count and step")]
pub struct Copies {
    /// Number of parts, with the first: from 1 to 1000.
    #[schemars(transform = limits::range(1..=1000))]
    pub count: usize,
    /// The motions from each copy to the next.
    pub step: Vec<Place>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with one of the keys translate, rotate_deg, scale"
)]
#[schemars(transform = limits::one_of)]
struct PlaceKeys {
    /// A translation `[x, y, z]`.
    translate: Option<[f64; 3]>,
    /// A right-handed rotation about an axis through the origin.
    rotate_deg: Option<PlaceTurn>,
    /// An enlargement from the origin, above 0.
    #[schemars(transform = limits::positive)]
    scale: Option<f64>,
}

impl TryFrom<PlaceKeys> for Place {
    type Error = String;

    fn try_from(keys: PlaceKeys) -> Result<Self, String> {
        only(
            "motion",
            [
                ("translate", keys.translate.map(Self::Translate)),
                ("rotate_deg", keys.rotate_deg.map(Self::RotateDeg)),
                ("scale", keys.scale.map(Self::Scale)),
            ],
        )
    }
}
