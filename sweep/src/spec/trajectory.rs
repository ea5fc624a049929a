//! Trajectories as they are written.

use super::{Bezier3, Circle, Flat, Free, Helix, Polyline3, Rotation, only};
use crate::schema;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A curve in space, or a rotation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", try_from = "TrajectoryKeys")]
pub enum Trajectory {
    /// A straight line by its ends.
    Line([[f64; 3]; 2]),
    /// A circle or an arc of one.
    Circle(Circle),
    /// A helix.
    Helix(Helix),
    /// Cubic Bezier segments.
    Bezier(Bezier3),
    /// Points that straight lines join.
    Polyline(Polyline3),
    /// Points that a spline goes through.
    Free(Free<[f64; 3]>),
    /// A curve drawn flat, with a height.
    Flat(Flat),
    /// A turn of the contour about an axis in its plane.
    Rotation(Rotation),
}

/// The keys of a trajectory as they are read, so that none and two of them get a sentence.
#[derive(Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with one of the keys line, circle, helix, bezier, polyline, free, flat, rotation"
)]
#[schemars(transform = schema::one_of)]
struct TrajectoryKeys {
    /// A straight line by its ends `[x, y, z]`, which differ.
    line: Option<[[f64; 3]; 2]>,
    /// A circle or an arc of one.
    circle: Option<Circle>,
    /// A helix.
    helix: Option<Helix>,
    /// Cubic Bezier segments of points `[x, y, z]`.
    bezier: Option<Bezier3>,
    /// Points `[x, y, z]` that straight lines join.
    polyline: Option<Polyline3>,
    /// Points `[x, y, z]` that a spline goes through.
    free: Option<Free<[f64; 3]>>,
    /// A curve drawn flat, with a height.
    flat: Option<Flat>,
    /// A turn of the contour about an axis in its plane.
    rotation: Option<Rotation>,
}

impl TryFrom<TrajectoryKeys> for Trajectory {
    type Error = String;

    fn try_from(keys: TrajectoryKeys) -> Result<Self, String> {
        only(
            "curve",
            [
                ("line", keys.line.map(Self::Line)),
                ("circle", keys.circle.map(Self::Circle)),
                ("helix", keys.helix.map(Self::Helix)),
                ("bezier", keys.bezier.map(Self::Bezier)),
                ("polyline", keys.polyline.map(Self::Polyline)),
                ("free", keys.free.map(Self::Free)),
                ("flat", keys.flat.map(Self::Flat)),
                ("rotation", keys.rotation.map(Self::Rotation)),
            ],
        )
    }
}
