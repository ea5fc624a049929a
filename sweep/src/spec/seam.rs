//! How a surface comes back to its start, as it is written.
//!
//! Along a closed trajectory each column meets itself, and a twist is a multiple of 360 degrees. With
//! `"seam": "shift"` a contour with a symmetry may meet itself turned: a column leads on to another
//! one. With `"seam": "mirror"` columns are led on in reverse order, so that the surface has one side.
//!
//! | surface                  | trajectory                       | contour                       | seam     |
//! |--------------------------|----------------------------------|-------------------------------|----------|
//! | Moebius band             | closed                           | open, the same from both ends | `mirror` |
//! | figure-8 Klein immersion | closed                           | a figure of eight             | `mirror` |
//! | Klein bottle             | back at its start, against itself | the same on both sides       | `mirror` |
//! | threefold torus          | closed                           | a threefold star              | `shift`  |
//!
//! A trajectory that comes back to its start against its own direction is given open, with both
//! ends at one point. What the contour lacks to meet itself is turned in evenly along the way, if no
//! `twist` is given; of all ways to meet the one with the least turn is taken. A `twist` must fit by itself. The contour
//! starts at one of 2 to 8, 10 or 12 equal parts from its image: on its axis of symmetry.
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "moebius-band",
//!   "contour": { "svg": "M-0.4 0H0.4" },
//!   "trajectory": { "circle": { "radius": 1 } },
//!   "seam": "mirror", "twist": { "total": 180 },
//!   "mesh": { "rows": 120, "cols": 12 }
//! }
//! ```
//!
//! A surface that closes mirrored has no inside. `"wall"` gives it one: in place of the sheet, all
//! that is within half the wall's thickness of it, bounded by one closed surface with two sides, which
//! a material of glass fills. The contour is closed and smooth, and there are no areas. `rows`, or the
//! tolerance, are those of the sheet: the wall goes along it twice, first on the side of its normals.
//!
//! ```json
//! {
//!   "format": "tb-sweep", "version": 1, "name": "glass-eight",
//!   "contour": { "free": { "closed": true, "points": [[0, 0], [0.4, 0.2], [0.4, -0.2], [0, 0],
//!                                                     [-0.4, 0.2], [-0.4, -0.2]] } },
//!   "trajectory": { "circle": { "radius": 1 } },
//!   "seam": "mirror", "twist": { "total": 180 }, "wall": 0.03,
//!   "mesh": { "rows": 120, "cols": 60 }
//! }
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the last section meets the first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SeamKind {
    /// Turned onto itself by a symmetry.
    Shift,
    /// In reverse.
    Mirror,
}
