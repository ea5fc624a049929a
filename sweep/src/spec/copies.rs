//! Copies of a whole part, as they are written.
//!
//! `copies` repeats a part: there are `count` of it, and each is moved by `step` once more than the one before it. `step`
//! is a place ([`Step`](files::place::Step)), as `place` of the part is. The second copy is a part named after the first, with `-copy2`
//! at the end. Walls and reliefs are scaled with the part.
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "railing", "unit": "cm",
//!   "parts": [
//!     {
//!       "name": "baluster",
//!       "contour": { "svg": "M0 0H4V-3C2 -20 1 -40 3 -60V-80H0" },
//!       "trajectory": { "rotation": {} },
//!       "copies": { "count": 5, "step": { "translate": [15, 0, 0] } },
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

use crate::limits;
use files::Place;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Copies of a part.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the keys count and step")]
pub struct Copies {
    /// Number of parts, with the first: from 1 to 1000.
    #[schemars(transform = limits::range(1..=1000))]
    pub count: usize,
    /// The place of each copy, seen from the one before it: a step or a list of steps.
    pub step: Place,
}
