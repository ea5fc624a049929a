//! Points of a trajectory from a file, as they are written.
//!
//! `csv` stands for `points`, and for `radii` if it names a column of them:
//!
//! | key       | meaning                                                                               |
//! |-----------|---------------------------------------------------------------------------------------|
//! | `file`    | a table of comma-separated values; its path is relative to the spec's folder          |
//! | `columns` | the columns of x, y and z, each by its name in the first line or its number, from 1   |
//! | `radius`  | the column of the radii, if there is one                                              |
//!
//! Values are separated by commas, semicolons or tabs, whichever the first line has. Lines that start with `#` are
//! skipped. Without `columns` these are the columns named x, y and z, or the first three if the table has no names.
//!
//! ```text
//! t,x,y,z,r
//! 0.0,0.10,0.00,0.02,0.31
//! 0.1,0.98,0.21,0.05,0.30
//! ```
//!
//! A trajectory `"swc": {"file": "cell.swc"}` is a tree of neurites as neuron tracers write it. Each unbranched piece
//! becomes a part. A piece starts in the middle of the piece that it leaves, so that branches are joined; the thickest
//! branch continues its piece. A soma of one point becomes a sphere. `types` chooses the kinds of neurites by their
//! numbers in the file: 1 soma, 2 axon, 3 and 4 dendrites. The contour `{"circle": 1}` takes the radii of the file, and
//! the unit is `um` unless the spec states another.

use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A table with the points of a trajectory.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the key file, and any of columns, radius")]
pub struct Csv {
    /// The file; its path is relative to the spec's folder.
    #[schemars(transform = limits::file)]
    pub file: String,
    /// The columns of x, y and z; those of these names, or the first three, if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub columns: Option<[TableColumn; 3]>,
    /// The column of the radii.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius: Option<TableColumn>,
}

/// A column of a table.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "the name of a column, or its number from 1")]
pub enum TableColumn {
    /// The number of the column, from 1.
    Number(#[schemars(transform = limits::from_one)] usize),
    /// The name of the column in the first line.
    Name(String),
}

/// A tree of neurites.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with the key file, and types if not all")]
pub struct Swc {
    /// The SWC file; its path is relative to the spec's folder.
    #[schemars(transform = limits::file)]
    pub file: String,
    /// The kinds of neurites that are read, by their numbers in the file; all if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::at_least(1))]
    pub types: Option<Vec<u32>>,
}
