//! An object of several sweeps, as it is written.
//!
//! `parts` are specs, in which `format` and `version` may be left out. Each part has a name of its own, which
//! becomes the name of its mesh. Together the parts are one object.
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "mug",
//!   "parts": [
//!     {
//!       "name": "wall",
//!       "contour": { "svg": "M0 0H1V-2H.9V-.1H0" },
//!       "trajectory": { "rotation": {} },
//!       "mesh": { "rows": 60, "cols": 40 }
//!     },
//!     {
//!       "name": "handle",
//!       "contour": { "circle": 0.12 },
//!       "trajectory": { "free": { "points": [[0.95, 1.6, 0], [1.5, 1.5, 0], [1.5, 0.6, 0], [0.95, 0.4, 0]] } },
//!       "mesh": { "rows": 40, "cols": 16 }
//!     }
//!   ]
//! }
//! ```

use super::{FORMAT, Spec, VERSION};
use crate::grid::Unit;
use crate::limits;
use files::note::Note;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Several sweeps that form one object.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object, a spec of parts")]
pub struct Parts {
    /// Path or URL of this file's JSON Schema, for editors; ignored by the reader.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// The format, `tb-sweep`.
    #[schemars(extend("const" = FORMAT))]
    pub format: String,
    /// The version of the format, 1.
    #[schemars(extend("const" = VERSION))]
    pub version: u32,
    /// The object's name; one word.
    #[schemars(transform = limits::word)]
    pub name: String,
    /// Sentences for people; ignored by the reader.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<Note>,
    /// The unit of length of all parts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<Unit>,
    /// The parts: at least one sweep, each with a name of its own.
    #[schemars(transform = limits::at_least(1))]
    pub parts: Vec<Spec>,
}
