//! Trajectories as they are written: the curves that a contour is swept along.

use super::{Bezier3, Circle, Flat, FormulaCurve, Helix, Measured, Rotation, Swc, only};
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A curve in space, or a rotation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", try_from = "TrajectoryKeys")]
pub enum Trajectory {
    /// A straight line, given by its two ends.
    Line([[f64; 3]; 2]),
    /// A circle, or an arc of a circle.
    Circle(Circle),
    /// A helix.
    Helix(Helix),
    /// Cubic Bezier segments that meet end to end.
    Bezier(Bezier3),
    /// Points joined by straight lines.
    Polyline(Measured),
    /// Points that a C2 spline passes through.
    Free(Measured),
    /// A plane curve with a height.
    Flat(Flat),
    /// Formulas of the coordinates.
    Formula(FormulaCurve),
    /// A tree of neurites, which becomes several parts.
    Swc(Swc),
    /// A rotation of the contour about an axis in its plane.
    Rotation(Rotation),
}

/// The keys of a trajectory as they are read. With this type, a missing or a second key gets an error message
/// of its own.
#[derive(Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with one of the keys line, circle, helix, bezier, polyline, free, flat, formula, swc, rotation"
)]
#[schemars(transform = limits::one_of)]
struct TrajectoryKeys {
    /// A straight line, given by its two ends `[x, y, z]`, which must differ.
    line: Option<[[f64; 3]; 2]>,
    /// A circle, or an arc of a circle.
    circle: Option<Circle>,
    /// A helix.
    helix: Option<Helix>,
    /// Cubic Bezier segments of points `[x, y, z]` that meet end to end.
    bezier: Option<Bezier3>,
    /// Points `[x, y, z]` joined by straight lines.
    polyline: Option<Measured>,
    /// Points `[x, y, z]` that a C2 spline passes through.
    free: Option<Measured>,
    /// A plane curve with a height.
    flat: Option<Flat>,
    /// Formulas of x, y and z.
    formula: Option<FormulaCurve>,
    /// A tree of neurites, which becomes several parts.
    swc: Option<Swc>,
    /// A rotation of the contour about an axis in its plane.
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
                ("formula", keys.formula.map(Self::Formula)),
                ("swc", keys.swc.map(Self::Swc)),
                ("rotation", keys.rotation.map(Self::Rotation)),
            ],
        )
    }
}
