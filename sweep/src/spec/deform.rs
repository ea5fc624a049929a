//! Deformations as they are written.
//!
//! `deform` is a list of what happens to the finished surface, one after another, before it is moved to
//! its `position`. Each has an `axis` (y) through an `origin` (zero), and acts between the
//! places `from` and `to` on it; its law runs from the one to the other.
//!
//! | deformation | what                                                                    |
//! |-------------|-------------------------------------------------------------------------|
//! | `taper`     | distances from the axis are multiplied by `factor`                      |
//! | `twist`     | all is turned about the axis by `degrees`, right-handed                 |
//! | `bend`      | the axis becomes an arc of `degrees` in the direction `toward`           |
//!
//! Beyond the two places a taper and a twist stay as they are there, and a bent axis goes straight
//! on.
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
use crate::schema;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A deformation of the space that a surface lies in.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", try_from = "DeformKeys")]
pub enum Deform {
    /// Draws everything toward an axis, or away from it.
    Taper(Taper),
    /// Turns everything about an axis.
    Twist(AxisTwist),
    /// Bends an axis, and everything with it.
    Bend(Bend),
}

/// A piece of an axis, along which a deformation takes place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys from, to and factor, and any of axis, origin"
)]
pub struct Taper {
    /// The direction of the axis, of any length.
    #[serde(default = "up")]
    pub axis: [f64; 3],
    /// Where the axis passes, and where `from` and `to` count from.
    #[serde(default)]
    pub origin: [f64; 3],
    /// Where on the axis it begins.
    pub from: f64,
    /// Where it ends; above `from`.
    pub to: f64,
    /// Factors of the distance from the axis, not negative, from `from` to `to`.
    pub factor: Law,
}

/// A turn about an axis that changes along it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys from, to and degrees, and any of axis, origin"
)]
pub struct AxisTwist {
    /// The direction of the axis, of any length.
    #[serde(default = "up")]
    pub axis: [f64; 3],
    /// Where the axis passes, and where `from` and `to` count from.
    #[serde(default)]
    pub origin: [f64; 3],
    /// Where on the axis it begins.
    pub from: f64,
    /// Where it ends; above `from`.
    pub to: f64,
    /// The turn in degrees, right-handed about the axis, from `from` to `to`.
    pub degrees: Law,
}

/// A piece of an axis that becomes an arc of a circle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys from, to, degrees and toward, and any of axis, origin"
)]
pub struct Bend {
    /// The direction of the axis, of any length.
    #[serde(default = "up")]
    pub axis: [f64; 3],
    /// Where the axis passes, and where `from` and `to` count from.
    #[serde(default)]
    pub origin: [f64; 3],
    /// Where on the axis it begins.
    pub from: f64,
    /// Where it ends; above `from`.
    pub to: f64,
    /// By how much the axis is turned after it, in degrees, at most 3600 either way.
    #[schemars(transform = schema::range(-3600.0..=3600.0))]
    pub degrees: f64,
    /// A direction across the axis, which it bends toward.
    pub toward: [f64; 3],
}

/// The keys of a deformation as they are read.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with one of the keys taper, twist, bend")]
#[schemars(transform = schema::one_of)]
struct DeformKeys {
    /// Multiplies distances from an axis.
    taper: Option<Taper>,
    /// Turns everything about an axis.
    twist: Option<AxisTwist>,
    /// Makes an axis an arc, and takes everything with it.
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
