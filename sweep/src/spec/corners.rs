//! Trajectories that may have corners, as they are written.
//!
//! A trajectory must bend smoothly, unless a Bezier or a polyline says how its corners are treated:
//!
//! | corners            | what                                                                     |
//! |--------------------|--------------------------------------------------------------------------|
//! | `{"round": d}`     | the curve is cut at the arc length d before and after each corner, and a cubic with the tangents of both cuts joins them; between straight legs the cubic is close to a circular arc |
//! | `{"mitre": limit}` | the section is sheared into the plane that halves the corner; both legs must be straight |
//!
//! A corner turns by more than a degree. Where d is more than half of the length between two corners, or between a
//! corner and an end, the cut of that corner is this half. Cusps and hairpins can be rounded too, unless both legs lie on one line. The length
//! of a mitre over the width of the section is 1 over the sine of half the angle between the legs. A corner
//! whose ratio is above the limit is refused, and so is a mitre next to a bent segment.
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "frame",
//!   "contour": { "svg": "M.2 .1H-.2V-.1H.2Z" },
//!   "trajectory": { "polyline": { "closed": true, "points": [[0, 0, 0], [4, 0, 0], [4, 3, 0], [0, 3, 0]], "corners": { "mitre": 4 } } },
//!   "mesh": { "rows": 8, "cols": 8 }
//! }
//! ```
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "pipe",
//!   "contour": { "circle": 0.2 },
//!   "trajectory": { "polyline": { "points": [[0, 0, 0], [4, 0, 0], [4, 3, 0], [4, 3, 5]], "corners": { "round": 1 } } },
//!   "mesh": { "rows": 60, "cols": 24 }
//! }
//! ```

use super::only;
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Cubic Bezier segments in space, each of which starts where the one before it ends.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the key segments, closed if it is, and corners if it has any"
)]
pub struct Bezier3 {
    /// True if the last segment ends at the start of the first.
    #[serde(default)]
    pub closed: bool,
    /// Four control points `[x, y, z]` for each segment, at least one segment.
    #[serde(deserialize_with = "super::pieces::read")]
    #[schemars(transform = limits::at_least(1))]
    pub segments: Vec<[[f64; 3]; 4]>,
    /// Treatment of corners; if left out, corners are errors.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub corners: Option<Corners>,
}

/// Treatment of the corners of a trajectory.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", try_from = "CornersKeys")]
pub enum Corners {
    /// Corners are rounded: the curve is cut at this arc length before and after each, above 0.
    Round(f64),
    /// Corners are mitred. The value limits the mitre's length over the section's width; at least 1.
    Mitre(f64),
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with one of the keys round, mitre")]
#[schemars(transform = limits::one_of)]
struct CornersKeys {
    /// Rounds corners: the curve is cut at this arc length before and after each, above 0.
    #[schemars(transform = limits::positive)]
    round: Option<f64>,
    /// Mitres corners. The value limits the mitre's length over the section's width; at least 1.
    #[schemars(transform = limits::range(1.0..=f64::MAX))]
    mitre: Option<f64>,
}

impl TryFrom<CornersKeys> for Corners {
    type Error = String;

    fn try_from(keys: CornersKeys) -> Result<Self, String> {
        only(
            "corner style",
            [("round", keys.round.map(Self::Round)), ("mitre", keys.mitre.map(Self::Mitre))],
        )
    }
}
