//! Frames as they are written: how the contour's axes lie along the trajectory.
//!
//! The axes `w1` (contour x) and `w2` (contour y) are fixed by one of
//!
//! | frame                  | what                                                                |
//! |------------------------|---------------------------------------------------------------------|
//! | `{"start": [x, y, z]}` | `w1` starts toward that direction, and the frame turns as little as possible |
//! | `{"up": [x, y, z]}`    | `w2` is everywhere as near to that direction as the trajectory allows |
//! | `{"frenet": {}}`       | `w1` points to the centre of curvature                              |
//! | `{"guide": CURVE}`     | `w1` points to the point of another curve at the same fraction of its length |
//! | `{"away": {"axis": [x, y, z]}}` | `w1` points away from the line through `origin` (zero if left out) along `axis` |
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "ramp",
//!   "contour": { "svg": "M2 0H-2" },
//!   "trajectory": { "helix": { "radius": 9, "rise": 4, "turns": 2 } },
//!   "frame": { "up": [0, 1, 0] },
//!   "mesh": { "rows": 90, "cols": 4 }
//! }
//! ```
//!
//! A guide is any curve that can be a trajectory, except a rotation. The guide of a closed trajectory is
//! closed.
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "ribbon",
//!   "contour": { "svg": "M1 0H0" },
//!   "trajectory": { "line": [[0, 0, 0], [0, 9, 0]] },
//!   "frame": { "guide": { "helix": { "radius": 1, "rise": 9, "turns": 1 } } },
//!   "mesh": { "rows": 60, "cols": 6 }
//! }
//! ```
//!
//! A frame fixed by a direction does not exist where that direction is parallel to the trajectory. An `up`
//! frame does not exist where the trajectory is parallel to `up`. Frenet's frame does not exist on straight
//! pieces and at inflections. The frame of a guide does not exist where the guide's point lies on the
//! tangent. The reader refuses such a trajectory and reports the fraction of its length. To find such points,
//! it samples the trajectory densely and halves steps in which the frame turns by more than half a radian.
//! Then it searches for the minimum near every approach. A frame fixed by a direction must also not jump
//! where two segments meet. Frenet's frame does so if the curvatures of the segments differ in direction.
//! Frames of a closed trajectory close by themselves.
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "band",
//!   "contour": { "svg": "M.2 .1H-.2V-.1H.2Z" },
//!   "trajectory": { "free": { "closed": true, "points": [[2, 0, 0], [0, 0.5, 1], [-2, 0, 0], [0, 0.5, -1]] } },
//!   "frame": { "frenet": {} },
//!   "mesh": { "rows": 90, "cols": 12 }
//! }
//! ```

use super::{Trajectory, only};
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The rule that fixes the frames along a trajectory.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", try_from = "FrameKeys")]
pub enum Frame {
    /// The contour's x starts as near to this direction as the trajectory allows.
    Start([f64; 3]),
    /// The contour's y is everywhere as near to this direction as the trajectory allows.
    Up([f64; 3]),
    /// The contour's x points to the centre of curvature.
    Frenet(Frenet),
    /// The contour's x points to the point of this curve at the same fraction of its length.
    Guide(Box<Trajectory>),
    /// The contour's x points away from an axis.
    Away(Away),
}

/// A line that the contour's x points away from.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the key axis, and origin if it is not zero"
)]
pub struct Away {
    /// A point of the line, `[x, y, z]`.
    #[serde(default)]
    pub origin: [f64; 3],
    /// Direction of the line; of any length above 0.
    pub axis: [f64; 3],
}

/// Frenet's frame, which has no settings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an empty object, {}")]
pub struct Frenet {}

#[derive(Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with one of the keys start, up, frenet, guide, away"
)]
#[schemars(transform = limits::one_of)]
struct FrameKeys {
    /// Direction `[x, y, z]` that the contour's x is nearest to at the start.
    start: Option<[f64; 3]>,
    /// Direction `[x, y, z]` that the contour's y is nearest to everywhere.
    up: Option<[f64; 3]>,
    /// The contour's x points to the centre of curvature.
    frenet: Option<Frenet>,
    /// The contour's x points to the point of this curve at the same fraction of its length; not a rotation.
    #[schemars(transform = limits::without(&["rotation", "swc"]))]
    guide: Option<Box<Trajectory>>,
    /// The contour's x points away from an axis.
    away: Option<Away>,
}

impl TryFrom<FrameKeys> for Frame {
    type Error = String;

    fn try_from(keys: FrameKeys) -> Result<Self, String> {
        only(
            "frame",
            [
                ("start", keys.start.map(Self::Start)),
                ("up", keys.up.map(Self::Up)),
                ("frenet", keys.frenet.map(Self::Frenet)),
                ("guide", keys.guide.map(Self::Guide)),
                ("away", keys.away.map(Self::Away)),
            ],
        )
    }
}
