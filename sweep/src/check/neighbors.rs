//! Rows that cross the next one.
//!
//! Every station lies in a plane across the trajectory. Where the next station's points lie behind
//! it, the two rows cross although neither may fold by itself: a bend between them is tighter than
//! the contour is wide, at a mitre or a hairpin. Only rows that follow each other are compared.

use super::{Finding, Severity, ranges};
use crate::grid::Seam;
use crate::sampling::Survey;
use crate::sampling::Sweep;
use crate::surface::modulation::Section;
use rayon::prelude::*;

/// Points behind a plane by less than this part of the contour's size touch it.
const TOUCHES: f64 = 1e-9;

/// The cosine between directions that all but oppose each other: some 155 degrees.
const AGAINST: f64 = -0.9;

/// Rows of which some point lies behind the row before, those left out that fold by themselves.
#[must_use]
pub fn findings(sweep: &Sweep, survey: &Survey) -> Option<Finding> {
    let (columns, rows) = sweep.lines();
    // Of the sheet, where the grid is that of a wall around it.
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
        // A mirrored seam may come back against its direction.
        let arriving = if wraps { ahead } else { there.frame().tangent };
        // Planes that look against each other tell nothing.
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
