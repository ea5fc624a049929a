//! Seams: the continuation after the last row or column of a grid.

use super::row::Fault;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a direction of the grid leads back to its start, if it does.
///
/// Columns are only open or closed. Rows may also return *mirrored*, as in a Klein bottle or a
/// Moebius band. Closed and mirrored rows have a `shift` in columns, by which the contour has
/// turned within itself when it returns:
///
/// ```text
///   closed  column k of the last row leads on to column (k + shift) mod cols of the first
///   mirror  column k of the last row leads on to column (shift - k) mod cols of the first
/// ```
///
/// A mirrored surface returns with its other side out, so the normals at its two ends are opposite.
/// An open contour cannot turn within itself, and a mirrored seam joins it end to end. The shift of
/// an open contour is 0 if closed, and `cols - 1` if mirrored.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Seam {
    /// The last row or column is an edge of the surface.
    #[default]
    Open,
    /// The last row or column is followed by the first.
    Closed,
    /// The last row is followed by the first, in reverse.
    Mirror,
}

impl Seam {
    /// Returns whether the last row or column leads back to the first.
    #[must_use]
    pub fn joins(self) -> bool {
        self != Self::Open
    }

    /// Returns the column of the first row that follows column `col` of the last row; `cols` is the number of
    /// columns.
    #[must_use]
    pub fn leads_to(self, col: usize, shift: usize, cols: usize) -> usize {
        match self {
            Self::Open => col,
            Self::Closed => (col + shift) % cols,
            Self::Mirror => (shift + cols - col) % cols,
        }
    }
}

/// Checks the seams and the shift of a grid with `cols` columns.
pub(super) fn check(seams: [Seam; 2], shift: usize, cols: usize) -> Result<(), Fault> {
    let [seam_u, seam_v] = seams;
    let fault = |subject: &str, message| Err(Fault { subject: subject.into(), message });
    if seam_u == Seam::Mirror {
        return fault("seam_u", "found mirror, expected open or closed".into());
    }
    let expected = match (seam_v, seam_u) {
        (Seam::Open, _) if shift != 0 => "0 along an open trajectory".into(),
        (Seam::Closed, Seam::Open) if shift != 0 => {
            "0: an open contour cannot be shifted along itself".into()
        }
        (Seam::Mirror, Seam::Open) if shift + 1 != cols => {
            format!("{}: an open contour is mirrored end to end", cols.saturating_sub(1))
        }
        _ if shift >= cols => format!("less than {cols}, the number of columns"),
        _ => return Ok(()),
    };
    fault("shift", format!("found {shift}, expected {expected}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seam_leads_every_column_to_another_one_and_mirrored_twice_back() {
        for cols in 2..9 {
            for shift in 0..cols {
                for seam in [Seam::Closed, Seam::Mirror] {
                    let mut met: Vec<usize> =
                        (0..cols).map(|col| seam.leads_to(col, shift, cols)).collect();
                    if seam == Seam::Mirror {
                        let back = met.iter().map(|&col| seam.leads_to(col, shift, cols));
                        assert!(back.eq(0..cols));
                    }
                    met.sort_unstable();
                    assert!(met.into_iter().eq(0..cols));
                }
            }
        }
        assert_eq!(Seam::Mirror.leads_to(1, 4, 5), 3);
        assert_eq!(Seam::Closed.leads_to(4, 2, 5), 1);
    }

    #[test]
    fn a_contour_that_cannot_come_back_so_is_refused() {
        use Seam::{Closed, Mirror, Open};
        for (seams, shift, expected) in [
            ([Mirror, Open], 0, "seam_u: found mirror, expected open or closed"),
            ([Closed, Open], 1, "shift: found 1, expected 0 along an open trajectory"),
            ([Open, Closed], 2, "shift: found 2, expected 0: an open contour cannot be shifted"),
            ([Open, Mirror], 0, "shift: found 0, expected 4: an open contour is mirrored end"),
            ([Closed, Closed], 5, "shift: found 5, expected less than 5, the number of columns"),
            ([Closed, Mirror], 7, "shift: found 7, expected less than 5, the number of columns"),
        ] {
            let message = check(seams, shift, 5).unwrap_err().to_string();
            assert!(message.starts_with(expected), "{message}");
        }
        for (seams, shift) in [
            ([Open, Open], 0),
            ([Open, Closed], 0),
            ([Open, Mirror], 4),
            ([Closed, Closed], 4),
            ([Closed, Mirror], 0),
        ] {
            assert!(check(seams, shift, 5).is_ok());
        }
    }
}
