//! One row of a grid, borrowed.

use super::{GridMesh, Seam};
use glam::{DVec3, Vec3};

/// One row of a [`GridMesh`]: a contour placed on the trajectory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row<'a> {
    /// Position on the trajectory, in `[0, 1]`.
    pub v: f64,
    /// One point for each column, in the spec's unit.
    pub positions: &'a [DVec3],
    /// One unit normal for each column.
    pub normals: &'a [Vec3],
}

/// A value that cannot be part of a grid.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Fault {
    /// Name of the value, such as `u[3]` or `the position of column 3`.
    pub subject: String,
    /// The found and the expected value, in words.
    pub message: String,
}

impl std::fmt::Display for Fault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.subject, self.message)
    }
}

impl GridMesh {
    /// Returns the rows in the order of `v`.
    ///
    /// # Panics
    /// When `positions` or `normals` is shorter than `rows * cols`.
    pub fn row_views(&self) -> impl Iterator<Item = Row<'_>> {
        let cols = self.cols();
        self.v.iter().enumerate().map(move |(row, &v)| {
            let points = row * cols..(row + 1) * cols;
            Row { v, positions: &self.positions[points.clone()], normals: &self.normals[points] }
        })
    }
}

impl Row<'_> {
    /// Checks the numbers of a row; `before` is the `v` of the row before, if any.
    pub(super) fn check(&self, seam_v: Seam, before: Option<f64>) -> Result<(), Fault> {
        check_parameter(self.v, before, seam_v)
            .map_err(|message| Fault { subject: "v".into(), message })?;
        let position = self.positions.iter().position(|p| !p.is_finite());
        let normal = self.normals.iter().position(|n| !n.is_finite());
        let subject = match (position, normal) {
            (None, None) => return Ok(()),
            (Some(col), _) => format!("the position of column {col}"),
            (None, Some(col)) => format!("the normal of column {col}"),
        };
        let message = "found a number that is not finite, expected finite numbers".into();
        Err(Fault { subject, message })
    }
}

/// Checks one `u` or `v` against the one before it: the first is 0, none decreases, all are at most 1 if open
/// and below 1 if closed.
pub(super) fn check_parameter(found: f64, before: Option<f64>, seam: Seam) -> Result<(), String> {
    let expected = match (before, seam) {
        (None, _) if found == 0.0 => return Ok(()),
        (None, _) => "0, where every grid starts".into(),
        (Some(before), Seam::Open) if found >= before && found <= 1.0 => return Ok(()),
        (Some(before), Seam::Open) => {
            format!("a number from {} (the one before it) to 1", number(before))
        }
        (Some(before), _) if found >= before && found < 1.0 => return Ok(()),
        (Some(before), _) => {
            format!(
                "a number from {} (the one before it) to below 1, since the grid is closed here",
                number(before)
            )
        }
    };
    Err(format!("found {}, expected {expected}", number(found)))
}

/// Formats a number briefly: a very large or very small number gets an exponent instead of hundreds of zeros.
pub(super) fn number(value: f64) -> String {
    let usual = value == 0.0 || (1e-5..1e16).contains(&value.abs());
    if usual { value.to_string() } else { format!("{value:?}") }
}
