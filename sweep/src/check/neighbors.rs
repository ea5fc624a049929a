//! Rows that cross the next row.
//!
//! Every station lies in a plane across the trajectory. If points of the next station lie behind this plane, the two
//! rows cross. Neither of them need fold by itself: the trajectory bends between them more sharply than the contour is
//! wide, at a mitre or a hairpin. Only neighbouring rows are compared.

use super::{Finding, Severity, ranges};
use crate::grid::Seam;
use crate::sampling::Survey;
use crate::sampling::Sweep;
use crate::surface::modulation::Section;
use rayon::prelude::*;

/// Points that lie behind a plane by less than this fraction of the contour's length touch it.
const TOUCHES: f64 = 1e-9;

/// Largest cosine between directions that count as opposed: an angle of some 155 degrees.
const AGAINST: f64 = -0.9;

/// Returns a finding about rows that cross the next row. Rows that fold by themselves are not counted.
#[must_use]
pub fn findings(sweep: &Sweep, survey: &Survey) -> Option<Finding> {
    let (columns, rows) = sweep.lines();
    // The seam is that of the sheet, also if a wall is built around it.
    let (seam, shift) = sweep.shape.seam(&sweep.col_stops()).unwrap_or_default();
    let sections: Vec<Section> = rows.par_iter().map(|&stop| sweep.shape.section(stop)).collect();
    let rotation = sweep.shape.trajectory.is_rotation();
    let narrow = TOUCHES * sweep.shape.contour.length();
    let crosses = |row: usize| {
        let wraps = row + 1 == rows.len();
        if wraps && seam == Seam::Open || survey.folds(row) {
            return false;
        }
        let next = if wraps { 0 } else { row + 1 };
        if survey.folds(next) {
            return false;
        }
        let (here, there) = (&sections[row], &sections[next]);
        let step = there.frame().origin - here.frame().origin;
        let ahead = here.frame().tangent;
        // At a mirrored seam the trajectory may return against its direction.
        let arriving = if wraps { ahead } else { there.frame().tangent };
        // Between opposed planes there is no order.
        if ahead.dot(arriving) < AGAINST || !rotation && step.dot(ahead) <= 0.0 {
            return false;
        }
        columns.iter().enumerate().any(|(col, column)| {
            let led = if wraps { seam.leads_to(col, shift, columns.len()) } else { col };
            let moved = there.point(&columns[led]) - here.point(column);
            moved.dot(ahead).min(moved.dot(arriving)) < -narrow
        })
    };
    let is: Vec<bool> = (0..rows.len()).into_par_iter().map(crosses).collect();
    let count = is.iter().filter(|&&crosses| crosses).count();
    let what = if count == 1 { "1 row crosses" } else { "rows cross" };
    let number = if count == 1 { String::new() } else { format!("{count} ") };
    let message = format!(
        "{number}{what} the next one ({}): the trajectory turns between them more sharply than the \
         contour is wide; a smaller contour or a wider bend passes",
        ranges(&rows, &is)
    );
    (count > 0).then(|| Finding::new(Severity::Wrong, "trajectory", message))
}
