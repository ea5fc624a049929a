//! How the end of a surface meets its start, as it is written.
//!
//! Along a closed trajectory each column meets itself, and a twist is a multiple of 360 degrees. With
//! `"seam": "shift"`, a contour with a rotational symmetry may meet itself turned: each column continues as
//! another column. With `"seam": "mirror"`, columns continue in reverse order, so that the surface has one
//! side.
//!
//! | surface                  | trajectory                       | contour                       | seam     |
//! |--------------------------|----------------------------------|-------------------------------|----------|
//! | Moebius band             | closed                           | open, the same from both ends | `mirror` |
//! | figure-8 Klein immersion | closed                           | a figure of eight             | `mirror` |
//! | Klein bottle             | back at its start, against itself | the same on both sides       | `mirror` |
//! | threefold torus          | closed                           | a threefold star              | `shift`  |
//!
//! A trajectory that returns to its start against its own direction is given as an open curve with both ends
//! at one point. If no `twist` is given, the turn that the contour still needs to meet itself is added evenly
//! along the trajectory. Of all possible turns the smallest is taken. A given `twist` must fit by itself. The
//! contour and its image are shifted by a multiple of 1/q of the contour's length, with q from 1 to 8, 10 or
//! 12. A contour to be mirrored should therefore start on its axis of symmetry.
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
//! A surface that closes mirrored has no inside. `"wall"` gives it one: the sheet is replaced by all points
//! within half the wall's thickness of it. One closed surface with two sides bounds these points, and a
//! material of glass fills them. The contour must be closed and smooth, and there must be no areas. `rows`,
//! or the tolerance, are those of the sheet. The wall goes along the sheet twice, first on the side of the
//! sheet's normals.
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
    /// By a rotational symmetry of the contour: each column continues as another column.
    Shift,
    /// Mirrored: columns continue in reverse order.
    Mirror,
}
