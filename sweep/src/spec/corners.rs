//! Trajectories that may have corners, as they are written.
//!
//! A trajectory bends smoothly, unless a Bezier or a polyline says what becomes of its corners:
//!
//! | corners            | what                                                                     |
//! |--------------------|--------------------------------------------------------------------------|
//! | `{"round": d}`     | each is cut off at the length d before and after it, and bridged by a cubic that goes on from both; between straight legs it is as near to an arc as a cubic is |
//! | `{"mitre": limit}` | the section is sheared into the plane that halves the corner, where straight legs meet |
//!
//! A corner turns by more than a degree. Cuts take at most half of the way between two corners or to
//! an end. Cusps and hairpins are rounded too, unless both legs lie on one line. A mitre is as much
//! longer than the section is wide as 1 is more than the sine of half the angle between the legs; where
//! that is above the limit the corner is refused, as is a mitre next to a bent segment.
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
use crate::schema;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Cubic Bezier segments in space, each of which starts where the one before it ends.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the key segments, closed if it is, and corners if it has any"
)]
pub struct Bezier3 {
    /// Whether the last segment ends at the start of the first.
    #[serde(default)]
    pub closed: bool,
    /// Four control points each.
    #[schemars(transform = schema::at_least(1))]
    pub segments: Vec<[[f64; 3]; 4]>,
    /// What becomes of corners.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub corners: Option<Corners>,
}

/// Points in space that straight lines join.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the key points, closed if it is, and corners if it has any"
)]
#[schemars(transform = schema::loop_of_three)]
pub struct Polyline3 {
    /// Whether the last point leads on to the first, which is not given again.
    #[serde(default)]
    pub closed: bool,
    /// At least two points, three when closed.
    #[schemars(transform = schema::at_least(2))]
    pub points: Vec<[f64; 3]>,
    /// What becomes of corners.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub corners: Option<Corners>,
}

/// What becomes of the corners of a trajectory.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", try_from = "CornersKeys")]
pub enum Corners {
    /// They are cut off at this length before and after, and bridged.
    Round(f64),
    /// They are mitred, up to this limit, which is at least 1.
    Mitre(f64),
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with one of the keys round, mitre")]
#[schemars(transform = schema::one_of)]
struct CornersKeys {
    /// They are cut off at this length before and after, above 0, and bridged.
    #[schemars(transform = schema::positive)]
    round: Option<f64>,
    /// They are mitred, up to this limit, at least 1.
    #[schemars(transform = schema::range(1.0..=f64::MAX))]
    mitre: Option<f64>,
}

impl TryFrom<CornersKeys> for Corners {
    type Error = String;

    fn try_from(keys: CornersKeys) -> Result<Self, String> {
        only(
            "way",
            [("round", keys.round.map(Self::Round)), ("mitre", keys.mitre.map(Self::Mitre))],
        )
    }
}
