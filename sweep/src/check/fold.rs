//! Where the surface folds back on itself.
//!
//! A point at `q` on the contour moves along the trajectory by `1 - k.q` of the trajectory's own
//! speed, for its curvature `k`. Below 0 it runs backward. The contour scaled by `f` has
//! `1 - f k.q`, so that the largest factor that passes is `1 / max(k.q)`, with twist, scale and
//! relief as they are.

use super::{Finding, Severity, ranges, short};
use crate::Sweep;
use crate::cut::Stop;
use crate::grid::Fold;
use crate::profile::Column;
use glam::DVec3;
use rayon::prelude::*;

/// A stretch within this of 0 only touches: rounding decides its sign.
const TOUCHES: f64 = 1e-9;

/// Steps of a golden section: they narrow two cells down to 1e-7 of their width.
const STEPS: usize = 36;

/// The stretch of every row.
#[derive(Debug, Clone)]
pub struct Survey {
    rows: Vec<Stop>,
    /// Rows that run backward since the trajectory bends, the relief is steep, space is bent.
    bent: Vec<bool>,
    relief: Vec<bool>,
    deformed: Vec<bool>,
    /// The least stretch anywhere, and where (`u`, `v`).
    worst: Option<(f64, [f64; 2])>,
}

struct Row {
    bent: bool,
    relief: bool,
    deformed: bool,
    least: Option<(f64, f64)>,
}

impl Survey {
    /// Looks at every point of the grid, and closely around the worst of them.
    #[must_use]
    pub fn of(sweep: &Sweep) -> Self {
        let (columns, rows) = sweep.lines();
        let found: Vec<Row> = rows.par_iter().map(|&stop| row(sweep, &columns, stop)).collect();
        let least = found.iter().zip(&rows).filter_map(|(row, stop)| Some((row.least?, stop.at)));
        let least = least.min_by(|((a, _), _), ((b, _), _)| a.total_cmp(b));
        let worst = least.map(|((least, u), v)| {
            closely(sweep, [u, v], [1.0 / columns.len() as f64, 1.0 / rows.len() as f64], least)
        });
        let all = |of: fn(&Row) -> bool| found.iter().map(of).collect();
        Self {
            bent: all(|row| row.bent),
            relief: all(|row| row.relief),
            deformed: all(|row| row.deformed),
            worst,
            rows,
        }
    }

    /// Whether a row has points that run backward, for any reason.
    #[must_use]
    pub fn folds(&self, row: usize) -> bool {
        // A wall's grid goes along its sheet twice.
        let row = row % self.rows.len();
        self.bent[row] || self.relief[row] || self.deformed[row]
    }

    /// The number of such rows.
    #[must_use]
    pub fn folded_rows(&self) -> usize {
        (0..self.rows.len()).filter(|&row| self.folds(row)).count()
    }

    /// The least stretch `1 - k.q` of the surface; none for a rotation.
    #[must_use]
    pub fn worst(&self) -> Option<f64> {
        self.worst.map(|worst| worst.0)
    }

    /// The largest factor of the contour with which no bend of the trajectory folds it; none where
    /// every factor passes.
    #[must_use]
    pub fn fits(&self) -> Option<f64> {
        self.worst().filter(|&worst| worst < 1.0).map(|worst| 1.0 / (1.0 - worst))
    }

    /// The same as a grid file tells it; none for a rotation.
    #[must_use]
    pub fn fold(&self) -> Option<Fold> {
        self.worst().map(|worst| Fold { worst, rows: self.folded_rows(), fits: self.fits() })
    }

    /// What is to be said of it.
    #[must_use]
    pub fn findings(&self) -> Vec<Finding> {
        let folds = |is: &[bool], path: &str, why: &str| {
            let count = is.iter().filter(|&&folded| folded).count();
            let rows = if count == 1 { "row" } else { "rows" };
            let message = format!(
                "the surface folds back on itself in {count} {rows}, where {why} ({})",
                ranges(&self.rows, is)
            );
            (count > 0).then(|| Finding::new(Severity::Wrong, path, message))
        };
        let (worst, fits) = (short(self.worst().unwrap_or(0.0)), short(self.fits().unwrap_or(0.0)));
        let bend = format!(
            "the trajectory bends more sharply than the contour is wide: the least stretch \
             1 - k.q is {worst}, and a contour of up to {fits} times this size passes"
        );
        let relief = "the relief is deeper than the contour is round: a smaller amp passes";
        let bent = folds(&self.bent, "trajectory", &bend).or_else(|| {
            let (worst, [_, v]) = self.worst?;
            let between = format!(
                "the surface folds back on itself between two rows at v {}, where {bend}",
                short(v)
            );
            let touches = format!(
                "the surface touches itself at v {}, where the contour reaches the axis that the \
                 trajectory bends about: a contour of below {fits} times this size does not",
                short(v)
            );
            if worst < -TOUCHES {
                Some(Finding::new(Severity::Wrong, "trajectory", between))
            } else if worst <= TOUCHES {
                Some(Finding::new(Severity::Hint, "trajectory", touches))
            } else {
                None
            }
        });
        let deformed = folds(&self.deformed, "deform", "a bend turns space inside out");
        bent.into_iter().chain(folds(&self.relief, "depth", relief)).chain(deformed).collect()
    }
}

fn row(sweep: &Sweep, columns: &[Column], stop: Stop) -> Row {
    let section = sweep.shape.section(stop);
    let measured = !sweep.shape.trajectory.is_rotation() && sweep.shape.along(stop).is_some();
    let mut row = Row { bent: false, relief: false, deformed: false, least: None };
    for column in columns {
        let stretch = section.stretch(column);
        if measured && row.least.is_none_or(|(least, _)| stretch < least) {
            row.least = Some((stretch, column.u));
        }
        // A pole of a rotation rounds to either side of 0.
        let backward = stretch < -TOUCHES;
        row.bent |= backward;
        row.relief |= section.folds(column) && stretch >= 0.0;
        if !sweep.shape.deforms.is_empty() {
            let mut point = section.point(column);
            for deform in &sweep.shape.deforms {
                let moved = deform.apply(point, DVec3::Y);
                row.deformed |= moved.folds;
                point = moved.point;
            }
        }
    }
    row
}

/// The least stretch around a place, within a cell to all sides, and where it is.
fn closely(sweep: &Sweep, place: [f64; 2], cell: [f64; 2], least: f64) -> (f64, [f64; 2]) {
    let at = |[u, v]: [f64; 2]| {
        let u = if sweep.shape.contour.closed() { u.rem_euclid(1.0) } else { u.clamp(0.0, 1.0) };
        let stop = Stop::after(v.clamp(0.0, 1.0));
        match sweep.shape.along(stop) {
            Some(_) => sweep.shape.section(stop).stretch(&sweep.shape.contour.at(u)),
            None => f64::INFINITY,
        }
    };
    let mut best = (least, place);
    for direction in [0, 1, 0, 1] {
        let (_, from) = best;
        let moved = |by: f64| {
            let mut place = from;
            place[direction] += by;
            place
        };
        let (mut low, mut high) = (-cell[direction], cell[direction]);
        let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
        for _ in 0..STEPS {
            let (a, b) = (high - golden * (high - low), low + golden * (high - low));
            if at(moved(a)) <= at(moved(b)) {
                high = b;
            } else {
                low = a;
            }
        }
        let found = moved(0.5 * (low + high));
        let stretch = at(found);
        if stretch < best.0 {
            best = (stretch, found.map(|x| x.rem_euclid(1.0)));
        }
    }
    best
}
