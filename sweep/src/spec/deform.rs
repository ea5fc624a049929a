//! Deformations as they are written.
//!
//! `deform` is a list of deformations. They are applied to the finished surface one after another, before the
//! surface is moved to its `position`. Each has an `axis` (y) through an `origin` (zero) and acts between the
//! heights `from` and `to` on that axis. Its law runs from `from` to `to`.
//!
//! | deformation | what                                                                    |
//! |-------------|-------------------------------------------------------------------------|
//! | `taper`     | distances from the axis are multiplied by `factor`                      |
//! | `twist`     | everything is turned about the axis by `degrees`, right-handed          |
//! | `bend`      | the axis becomes an arc of `degrees` in the direction `toward`           |
//!
//! Beyond `from` and `to`, a taper and a twist keep their end values, and a bent axis goes straight on.
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "leaning-tower",
//!   "contour": { "svg": "M1 1H-1V-1H1Z" },
//!   "trajectory": { "line": [[0, 0, 0], [0, 8, 0]] },
//!   "deform": [
//!     { "taper": { "from": 0, "to": 8, "factor": { "keys": [[0, 1], [1, 0.4]], "ease": "smooth" } } },
//!     { "twist": { "from": 2, "to": 6, "degrees": { "total": 90 } } },
//!     { "bend": { "from": 0, "to": 8, "degrees": 25, "toward": [1, 0, 0] } }
//!   ],
//!   "mesh": { "rows": 90, "cols": 40 }
//! }
//! ```

use super::{Law, only, up};
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A deformation of the space that a surface lies in.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", try_from = "DeformKeys")]
pub enum Deform {
    /// Multiplies distances from an axis by a factor.
    Taper(Taper),
    /// Turns everything about an axis.
    Twist(AxisTwist),
    /// Bends an axis into an arc, and everything around it.
    Bend(Bend),
}

/// A taper: distances from an axis are multiplied by a factor that changes along the axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys from, to and factor, and any of axis, origin"
)]
pub struct Taper {
    /// The direction of the axis, of any length.
    #[serde(default = "up")]
    pub axis: [f64; 3],
    /// A point on the axis, from which `from` and `to` are measured.
    #[serde(default)]
    pub origin: [f64; 3],
    /// Height on the axis where the taper begins, in the unit of length.
    pub from: f64,
    /// Height on the axis where the taper ends; above `from`.
    pub to: f64,
    /// Factor of the distance from the axis, at least 0, as a law from `from` to `to`.
    pub factor: Law,
}

/// A rotation about an axis by an angle that changes along the axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys from, to and degrees, and any of axis, origin"
)]
pub struct AxisTwist {
    /// The direction of the axis, of any length.
    #[serde(default = "up")]
    pub axis: [f64; 3],
    /// A point on the axis, from which `from` and `to` are measured.
    #[serde(default)]
    pub origin: [f64; 3],
    /// Height on the axis where the twist begins, in the unit of length.
    pub from: f64,
    /// Height on the axis where the twist ends; above `from`.
    pub to: f64,
    /// Angle in degrees, right-handed about the axis, as a law from `from` to `to`.
    pub degrees: Law,
}

/// A bend: a piece of an axis becomes an arc of a circle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys from, to, degrees and toward, and any of axis, origin"
)]
pub struct Bend {
    /// The direction of the axis, of any length.
    #[serde(default = "up")]
    pub axis: [f64; 3],
    /// A point on the axis, from which `from` and `to` are measured.
    #[serde(default)]
    pub origin: [f64; 3],
    /// Height on the axis where the arc begins, in the unit of length.
    pub from: f64,
    /// Height on the axis where the arc ends; above `from`.
    pub to: f64,
    /// Angle of the arc in degrees, from -3600 to 3600.
    #[schemars(transform = limits::range(-3600.0..=3600.0))]
    pub degrees: f64,
    /// Direction that the axis bends toward; not parallel to the axis.
    pub toward: [f64; 3],
}

/// The keys of a deformation as they are read.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with one of the keys taper, twist, bend")]
#[schemars(transform = limits::one_of)]
struct DeformKeys {
    /// Multiplies distances from an axis by a factor.
    taper: Option<Taper>,
    /// Turns everything about an axis.
    twist: Option<AxisTwist>,
    /// Bends an axis into an arc, and everything around it.
    bend: Option<Bend>,
}

impl TryFrom<DeformKeys> for Deform {
    type Error = String;

    fn try_from(keys: DeformKeys) -> Result<Self, String> {
        only(
            "deformation",
            [
                ("taper", keys.taper.map(Self::Taper)),
                ("twist", keys.twist.map(Self::Twist)),
                ("bend", keys.bend.map(Self::Bend)),
            ],
        )
    }
}
