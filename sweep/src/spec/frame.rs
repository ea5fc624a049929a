//! Frames as they are written.
//!
//! What a contour's axes point at on their way is one of
//!
//! | frame                  | what                                                                |
//! |------------------------|---------------------------------------------------------------------|
//! | `{"start": [x, y, z]}` | `w1` starts toward that direction and turns as little as it can     |
//! | `{"up": [x, y, z]}`    | `w2` is everywhere as near to that direction as the trajectory lets it |
//! | `{"frenet": {}}`       | `w1` points to the centre of curvature                              |
//! | `{"guide": CURVE}`     | `w1` points to the point of another curve at the same fraction of its length |
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
//! A guide is any curve that a trajectory can be, but a rotation; it is closed where the trajectory is.
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
//! A frame that a direction fixes does not exist where that direction lies along the trajectory: an
//! upright one where the trajectory is upright itself, Frenet's on straight pieces and at inflections,
//! that of a guide where it meets the tangent. The reader refuses such a trajectory with the place, a
//! fraction of its length: it samples the trajectory densely, halves steps in which the frame turns
//! by more than half a radian, and follows every approach to its nearest point. Such a frame must
//! also not jump where two segments meet, as Frenet's does if their curvatures differ in direction.
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
use crate::schema;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What the frames along a trajectory are fixed by.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", try_from = "FrameKeys")]
pub enum Frame {
    /// What the contour's x points at in the beginning, as near as the trajectory lets it.
    Start([f64; 3]),
    /// What the contour's y points at everywhere, as near as the trajectory lets it.
    Up([f64; 3]),
    /// The contour's x points to the centre of curvature.
    Frenet(Frenet),
    /// The contour's x points to this curve.
    Guide(Box<Trajectory>),
}

/// Frenet's frame, about which there is nothing to say.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an empty object, {}")]
pub struct Frenet {}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with one of the keys start, up, frenet, guide")]
#[schemars(transform = schema::one_of)]
struct FrameKeys {
    /// What the contour's x points at in the beginning, a direction `[x, y, z]`.
    start: Option<[f64; 3]>,
    /// What the contour's y points at everywhere, a direction `[x, y, z]`.
    up: Option<[f64; 3]>,
    /// The contour's x points to the centre of curvature.
    frenet: Option<Frenet>,
    /// The contour's x points to this curve; no rotation.
    #[schemars(transform = schema::without(&["rotation"]))]
    guide: Option<Box<Trajectory>>,
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
            ],
        )
    }
}
