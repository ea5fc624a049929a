//! The header of a grid as its JSON line stores it, and the JSON Schema of that line.

use super::header::MAX_COLS;
use super::{Encoding, Patch};
use crate::grid::{Fold, Lid, PlacedArea, Seam, Tolerance, Unit, UvLayout};
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// The first line of a grid: everything except its rows.
#[derive(Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Header")]
pub(super) struct Line {
    /// Path or URL of this line's JSON Schema, for editors; ignored by the reader.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// The format, `tb-grid`.
    #[schemars(extend("const" = "tb-grid"))]
    pub format: String,
    /// The version of the format, 1.
    #[schemars(extend("const" = 1))]
    pub version: u64,
    /// Encoding of the rows.
    pub encoding: Encoding,
    /// Byte order of binary rows.
    pub endian: Endian,
    /// The object's name; one word.
    #[schemars(transform = limits::word)]
    pub name: String,
    /// Number of this patch in its object, from 1, and the number of patches.
    #[serde(default, skip_serializing_if = "Patch::is_whole")]
    #[schemars(with = "[u32; 2]", transform = limits::range(1..=u32::MAX))]
    pub patch: Patch,
    /// Number of rows, which are stations of the contour on the trajectory.
    #[schemars(transform = limits::range(1..=u32::MAX))]
    pub rows: usize,
    /// Number of columns, which are points of a station.
    #[schemars(transform = limits::range(1..=MAX_COLS))]
    pub cols: usize,
    /// How the last column leads back to the first; not `mirror`.
    pub seam_u: Seam,
    /// How the last row leads back to the first.
    pub seam_v: Seam,
    /// Shift in columns between the last row and the first, below `cols`.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[schemars(transform = limits::range(0..=MAX_COLS))]
    pub shift: usize,
    /// Texture id of the patch, if it has its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::id)]
    pub texture: Option<u32>,
    /// Surface id of the patch, if it has its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::id)]
    pub surface: Option<u32>,
    /// Areas with textures of their own; later areas cover earlier ones.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub areas: Vec<PlacedArea>,
    /// Flat ends of this patch and of patches before it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lids: Vec<Lid>,
    /// True if the first, and if the last row is pressed to a line, where opposite columns meet.
    #[serde(default, skip_serializing_if = "is_none_of")]
    pub pressed: [bool; 2],
    /// Where the surface folds back on itself, if that was measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fold: Option<Fold>,
    /// The requested and the measured distance from the surface, if one was requested.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<Tolerance>,
    /// The unit of length, if the spec states one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<Unit>,
    /// How texture coordinates lie on the surface.
    pub uv: UvLayout,
    /// `u` of each column, not decreasing, in `[0, 1]`.
    #[schemars(transform = limits::range(0.0..=1.0))]
    pub u: Vec<f64>,
}

/// Byte order of binary rows. Only one exists, and the file states it.
#[derive(Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum Endian {
    /// The least significant byte comes first.
    Little,
}

fn is_zero(shift: &usize) -> bool {
    *shift == 0
}

fn is_none_of(flags: &[bool; 2]) -> bool {
    *flags == [false; 2]
}

/// Returns the JSON Schema of the header line of a grid.
#[must_use]
pub fn schema() -> Value {
    let mut generator = files::schema::generator(f64::MAX);
    let line = generator.subschema_for::<Line>();
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "tb-grid",
        "description": "The header line of a grid of points and normals, which `sweep` writes and `triangulate` reads.",
        "type": "object",
        "allOf": [line],
        "$defs": generator.take_definitions(true),
    })
}
