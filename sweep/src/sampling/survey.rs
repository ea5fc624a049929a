//! A survey of the folds of a surface: parts that run backward along the trajectory.
//!
//! A point at `q` on the contour moves along the trajectory by `1 - k.q` of the trajectory's own speed, where `k`
//! is the trajectory's curvature. This factor is the *stretch*; below 0 the surface runs backward. The contour
//! scaled by `f` has the stretch `1 - f k.q`, so the largest factor without a fold is `1 / max(k.q)`, with
//! twist, scale and relief as they are.
//!
//! The survey needs each point of the grid once, as do the rows. [`RowSurvey`] is therefore filled while a row is
//! evaluated, and the surveys of all rows give the [`Survey`].

use crate::curve::cut::Stop;
use crate::grid::Fold;
use crate::surface::profile::Column;
use crate::surface::shape::{Shape, SurfacePoint};
use rayon::prelude::*;

/// A stretch above minus this number, without a unit, is no fold, since rounding decides the sign
/// of a stretch near 0.
pub(crate) const TOUCHES: f64 = 1e-9;

/// Steps of a golden-section search, which narrow two cells down to 1e-7 of their width.
const STEPS: usize = 36;

/// The stretch of every row of a grid.
#[derive(Debug, Clone)]
pub struct Survey {
    pub(crate) rows: Vec<Stop>,
    /// Rows that run backward because the trajectory bends.
    pub(crate) bent: Vec<bool>,
    /// Rows that run backward because the relief is deeper than the contour is round.
    pub(crate) relief: Vec<bool>,
    /// Rows in which a deformation turns space inside out.
    pub(crate) deformed: Vec<bool>,
    /// The smallest stretch of the surface and its position (`u`, `v`); `None` for a rotation.
    pub(crate) worst: Option<(f64, [f64; 2])>,
}

/// The stretch of one row, filled point by point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RowSurvey {
    bent: bool,
    relief: bool,
    deformed: bool,
    /// True if the row lies on a trajectory whose bends can fold a contour: on no cap and no
    /// rotation.
    measured: bool,
    /// The smallest stretch of the row and its `u`.
    least: Option<(f64, f64)>,
}

impl RowSurvey {
    /// Returns the survey of a row without points.
    pub(crate) fn new(shape: &Shape, stop: Stop) -> Self {
        let measured = !shape.trajectory.is_rotation() && shape.along(stop).is_some();
        Self { bent: false, relief: false, deformed: false, measured, least: None }
    }

    /// Adds the point at `u`.
    pub(crate) fn add(&mut self, u: f64, point: &SurfacePoint) {
        let stretch = point.stretch;
        if self.measured && self.least.is_none_or(|(least, _)| stretch < least) {
            self.least = Some((stretch, u));
        }
        // A pole of a rotation rounds to either side of 0.
        self.bent |= stretch < -TOUCHES;
        self.relief |= point.contour_folds && stretch >= 0.0;
        self.deformed |= point.space_folds;
    }
}

impl Survey {
    /// Surveys every point of a grid of these columns and rows, and closely around the worst of them.
    #[must_use]
    pub(crate) fn of(shape: &Shape, columns: &[Column], rows: Vec<Stop>) -> Self {
        let row = |&stop: &Stop| {
            let section = shape.section(stop);
            let mut row = RowSurvey::new(shape, stop);
            columns.iter().for_each(|column| row.add(column.u, &shape.evaluate(&section, column)));
            row
        };
        let found: Vec<RowSurvey> = rows.par_iter().map(row).collect();
        Self::from_rows(shape, columns.len(), rows, &found)
    }

    /// Returns the survey of rows that have been surveyed one by one, in a grid of `cols` columns.
    pub(crate) fn from_rows(
        shape: &Shape,
        cols: usize,
        rows: Vec<Stop>,
        found: &[RowSurvey],
    ) -> Self {
        let least = found.iter().zip(&rows).filter_map(|(row, stop)| Some((row.least?, stop.at)));
        let least = least.min_by(|((a, _), _), ((b, _), _)| a.total_cmp(b));
        let worst = least.map(|((least, u), v)| {
            closely(shape, [u, v], [1.0 / cols as f64, 1.0 / rows.len() as f64], least)
        });
        let all = |of: fn(&RowSurvey) -> bool| found.iter().map(of).collect();
        Self {
            bent: all(|row| row.bent),
            relief: all(|row| row.relief),
            deformed: all(|row| row.deformed),
            worst,
            rows,
        }
    }

    /// Returns whether a row has points that run backward, for any reason.
    #[must_use]
    pub fn folds(&self, row: usize) -> bool {
        // The grid of a wall runs along its sheet twice.
        let row = row % self.rows.len();
        self.bent[row] || self.relief[row] || self.deformed[row]
    }

    /// Returns the number of rows that have points that run backward.
    #[must_use]
    pub fn folded_rows(&self) -> usize {
        (0..self.rows.len()).filter(|&row| self.folds(row)).count()
    }

    /// Returns the smallest stretch `1 - k.q` of the surface; `None` for a rotation.
    #[must_use]
    pub fn worst(&self) -> Option<f64> {
        self.worst.map(|worst| worst.0)
    }

    /// Returns the largest factor of the contour with which no bend of the trajectory folds it; `None` if there
    /// is no largest.
    #[must_use]
    pub fn fits(&self) -> Option<f64> {
        self.worst().filter(|&worst| worst < 1.0).map(|worst| 1.0 / (1.0 - worst))
    }

    /// Returns the survey as a grid file records it; `None` for a rotation.
    #[must_use]
    pub fn fold(&self) -> Option<Fold> {
        self.worst().map(|worst| Fold { worst, rows: self.folded_rows(), fits: self.fits() })
    }
}

/// Returns the smallest stretch within a cell around the point (u, v) in each direction, and its position.
/// `least` is the stretch at the point itself.
fn closely(shape: &Shape, position: [f64; 2], cell: [f64; 2], least: f64) -> (f64, [f64; 2]) {
    let stretch_at = |[u, v]: [f64; 2]| {
        let u = if shape.contour.closed() { u.rem_euclid(1.0) } else { u.clamp(0.0, 1.0) };
        let stop = Stop::after(v.clamp(0.0, 1.0));
        match shape.along(stop) {
            Some(_) => shape.section(stop).stretch(&shape.contour.at(u)),
            None => f64::INFINITY,
        }
    };
    let mut best = (least, position);
    for direction in [0, 1, 0, 1] {
        let (_, from) = best;
        let moved = |by: f64| {
            let mut position = from;
            position[direction] += by;
            position
        };
        let (mut low, mut high) = (-cell[direction], cell[direction]);
        let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
        for _ in 0..STEPS {
            let (a, b) = (high - golden * (high - low), low + golden * (high - low));
            if stretch_at(moved(a)) <= stretch_at(moved(b)) {
                high = b;
            } else {
                low = a;
            }
        }
        let found = moved(0.5 * (low + high));
        let stretch = stretch_at(found);
        if stretch < best.0 {
            best = (stretch, found.map(|x| x.rem_euclid(1.0)));
        }
    }
    best
}
