//! A sweep that has been checked, and the grid it gives.

use super::Survey;
use super::resolution::stops::Direction;
use super::resolution::{Cells, Distance, Reached, Resolution, Search, Tell, Tolerance};
use super::rows::Rows;
use crate::curve::cut::{self, Stop};
use crate::error::SweepError;
use crate::grid::MOST_CELLS;
use crate::grid::file::MAX_COLS;
use crate::grid::{self, Area, GridMesh, Unit, UvLayout};
use crate::surface::Shape;
use crate::surface::Surface;
use crate::surface::profile::{Column, Profile};
use crate::surface::vessel::TightBend;
use crate::surface::wall::{self, Wall};
use crate::trajectory::Trajectory;
use files::{memory, words};
use glam::DVec3;
use rayon::prelude::*;
use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// Bytes for each cell that the search for a tolerance takes: an estimate, not measured.
const OF_SEARCH: u64 = 128;

/// A checked surface with its resolution.
#[derive(Debug, Clone)]
pub struct Sweep {
    pub(crate) name: String,
    pub(crate) shape: Shape,
    /// The wall around the surface, if it is given a thickness.
    pub(crate) wall: Option<Wall>,
    /// The bend of a vessel's profile that is tighter than its wall, if there is one.
    pub(crate) bend: Option<TightBend>,
    /// True for an end that a lid closes, with the other sweeps of the group.
    pub(crate) lids: [bool; 2],
    /// Number of sweeps of the group, an outline and its holes, if the sweep is the last of the group; otherwise 0.
    pub(crate) group: usize,
    pub(crate) resolution: Resolution,
    /// The rows and columns that keep the tolerance, if one is requested.
    pub(crate) fitted: Option<Cells>,
    /// Time that the search for these rows and columns took.
    pub(crate) spent: Duration,
    /// The survey of the grid of this resolution, once the grid or the survey was made.
    pub(crate) survey: OnceLock<Survey>,
    pub(crate) uv: UvLayout,
    pub(crate) unit: Option<Unit>,
    pub(crate) areas: Vec<Area>,
    pub(crate) texture: Option<u32>,
    pub(crate) surface: Option<u32>,
}

impl Sweep {
    /// Returns the name of the sweep.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the profile that is swept: one contour or several.
    #[must_use]
    pub fn contour(&self) -> &Profile {
        &self.shape.contour
    }

    /// Returns the trajectory.
    #[must_use]
    pub fn trajectory(&self) -> &Trajectory {
        &self.shape.trajectory
    }

    /// Returns the surface before it is cut into cells.
    #[must_use]
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Returns the point and the unit normal of the surface at (u, v), as [`Shape::at`] does.
    #[must_use]
    pub fn at(&self, u: f64, v: f64) -> (DVec3, DVec3) {
        self.shape.at(u, v)
    }

    /// Returns the number of cells along the trajectory and its caps, without the cells of no height at corners. A wall
    /// has twice as many.
    #[must_use]
    pub fn rows(&self) -> usize {
        match (&self.resolution, &self.fitted) {
            (Resolution::Cells { rows, .. }, _) => *rows,
            (_, Some(cells)) => cut::cells(&cells.rows, self.shape.closed()),
            (_, None) => self.shape.fewest_rows(),
        }
    }

    /// Returns the number of cells along the contour, without the cells of no width at creases.
    #[must_use]
    pub fn cols(&self) -> usize {
        cut::cells(&self.col_stops(), self.contour().closed())
    }

    /// Returns the numbers of rows and columns of points in the grid.
    #[must_use]
    pub fn points(&self) -> [usize; 2] {
        let sides = if self.wall.is_some() { wall::SIDES } else { 1 };
        [sides * self.row_stops().len(), self.col_stops().len()]
    }

    /// Returns the accuracy that a tolerance reached; `None` if rows and columns were requested.
    #[must_use]
    pub fn reached(&self) -> Option<Reached> {
        self.fitted.as_ref().map(|cells| cells.reached)
    }

    /// Returns the time that the search for the cells of a tolerance took; 0 without a tolerance.
    #[must_use]
    pub fn time_of_search(&self) -> Duration {
        self.spent
    }

    /// Returns a sentence that says by how much a tolerance is missed; `None` if it is kept or none was requested.
    #[must_use]
    pub fn missed(&self) -> Option<String> {
        match &self.resolution {
            Resolution::Tolerance(asked) => {
                self.reached().and_then(|reached| asked.missed(&reached))
            }
            Resolution::Cells { .. } => None,
        }
    }

    /// Returns the requested resolution.
    #[must_use]
    pub fn resolution(&self) -> &Resolution {
        &self.resolution
    }

    /// Returns this sweep with other numbers of cells; `None` keeps a number.
    ///
    /// # Errors
    /// When the cells are too few for the contour or the trajectory, or more than [`MOST_CELLS`].
    pub fn with_resolution(
        self,
        rows: Option<usize>,
        cols: Option<usize>,
    ) -> Result<Self, SweepError> {
        let rows = rows.unwrap_or_else(|| self.rows());
        let cols = cols.unwrap_or_else(|| self.cols());
        self.resolved(Resolution::Cells { rows, cols })
    }

    /// Returns this sweep with the fewest cells that keep a tolerance.
    ///
    /// # Errors
    /// When `max_quads` is too few for the contour and the trajectory.
    pub fn with_tolerance(self, tolerance: Tolerance) -> Result<Self, SweepError> {
        self.resolved(Resolution::Tolerance(tolerance))
    }

    fn resolved(self, resolution: Resolution) -> Result<Self, SweepError> {
        let sweep = Self { resolution, fitted: None, survey: OnceLock::new(), ..self };
        if let Some((key, message)) = sweep.resolution_fault() {
            return Err(SweepError::Resolution(format!("{key}: {message}")));
        }
        let sweep = sweep.fitted(&|_, _| {})?;
        let cells = [sweep.rows(), sweep.cols()];
        match sweep.areas.iter().find_map(|area| area.fault(cells)) {
            Some((key, message)) => Err(SweepError::Resolution(format!("areas, {key}: {message}"))),
            None => Ok(sweep),
        }
    }

    /// Returns this sweep with the cells that its tolerance needs. `tell` receives the progress of the search.
    ///
    /// # Errors
    /// When there is no memory for the search among as many cells as are allowed.
    pub(crate) fn fitted(self, tell: Tell<'_>) -> Result<Self, SweepError> {
        let Resolution::Tolerance(tolerance) = &self.resolution else { return Ok(self) };
        let most = tolerance.max_quads;
        let _reserved = memory::of_process()
            .reserve(OF_SEARCH.saturating_mul(most as u64), || {
                format!("{}: a search for at most {most} cells", words::shown(&self.name))
            })?;
        let started = Instant::now();
        let cells = self.search(tolerance).run(tell);
        let spent = started.elapsed();
        Ok(Self { fitted: Some(cells), spent, survey: OnceLock::new(), ..self })
    }

    /// Returns the distance of the triangles of [`Sweep::grid`] from the surface, in the units of `tolerance`.
    #[must_use]
    pub fn measure(&self, tolerance: &Tolerance) -> Reached {
        self.search(tolerance).measured([&self.row_stops(), &self.col_stops()])
    }

    fn search<'a>(&'a self, tolerance: &'a Tolerance) -> Search<'a> {
        let (shape, contour) = (&self.shape, self.contour());
        Search {
            surface: shape,
            tolerance,
            directions: [
                Direction {
                    breaks: shape.row_breaks(),
                    kinks: shape.kinks(),
                    closed: shape.closed(),
                    meets: shape.closing.is_none(),
                    fewest: shape.fewest_rows(),
                    even: None,
                },
                Direction {
                    breaks: contour.breaks().to_vec(),
                    kinks: shape.edges.cols.clone(),
                    closed: contour.closed(),
                    meets: true,
                    fewest: contour.fewest_cells(),
                    even: shape.anchors(),
                },
            ],
            detail: shape.detail(),
            most_cols: self.most_cols(),
        }
    }

    /// Returns the largest number of cells along the contour for which a row of the grid has columns.
    fn most_cols(&self) -> usize {
        // A row has the first point of each cell, a second point at each crease, and the end of an open contour.
        let more = self.contour().creases() + usize::from(!self.contour().closed());
        MAX_COLS.saturating_sub(more)
    }

    /// Returns the fault of the numbers of cells, if any: the key and a sentence.
    pub(crate) fn resolution_fault(&self) -> Option<(&'static str, String)> {
        let [fewest_rows, fewest_cols] = [self.shape.fewest_rows(), self.contour().fewest_cells()];
        let (rows, cols) = match &self.resolution {
            Resolution::Cells { rows, cols } => (*rows, *cols),
            Resolution::Tolerance(tolerance) => {
                let fewest = fewest_rows * fewest_cols;
                return (tolerance.max_quads < fewest).then(|| {
                    let message = format!(
                        "found {}, expected at least {fewest}, the fewest cells of these curves",
                        tolerance.max_quads
                    );
                    ("max_quads", message)
                });
            }
        };
        let around = "to go around";
        if rows < fewest_rows {
            let why = match self.shape.row_breaks().len() {
                0 if fewest_rows > 1 => around,
                0 => "along the trajectory",
                _ => "one for each piece between corners and for each cap",
            };
            return Some(("rows", format!("found {rows}, expected at least {fewest_rows} {why}")));
        }
        if cols < fewest_cols {
            let why = match self.contour().creases() {
                0 if self.contour().closed() => around,
                0 => "along the contour",
                _ => "along a contour with corners: one for each piece between them",
            };
            return Some(("cols", format!("found {cols}, expected at least {fewest_cols} {why}")));
        }
        let most = self.most_cols();
        if cols > most {
            return Some(("cols", format!("found {cols}, expected at most {most}")));
        }
        let cells = rows.checked_mul(cols).filter(|&cells| cells <= MOST_CELLS);
        cells.is_none().then(|| {
            ("rows", format!("found {rows} x {cols} cells, expected at most {MOST_CELLS}"))
        })
    }

    /// Returns the grid of points and normals.
    ///
    /// Rows and columns lie at equal lengths of the trajectory and of each smooth piece of the contour, or where a
    /// tolerance needs them. The grid does not depend on the number of threads.
    ///
    /// # Panics
    /// When there is not enough memory for the grid; see [`Sweep::try_grid`].
    #[must_use]
    pub fn grid(&self) -> GridMesh {
        self.try_grid().unwrap_or_else(|error| panic!("{error}"))
    }

    /// Returns the grid, as [`Sweep::grid`] does.
    ///
    /// # Errors
    /// When there is not enough memory for the grid.
    pub fn try_grid(&self) -> Result<GridMesh, SweepError> {
        Rows::of(self).grid()
    }

    /// Returns the tolerance as the grid file records it.
    pub(crate) fn tolerance(&self) -> Option<grid::Tolerance> {
        let (Resolution::Tolerance(asked), Some(reached)) = (&self.resolution, self.reached())
        else {
            return None;
        };
        Some(grid::Tolerance {
            asked: match asked.distance {
                Some(Distance::Everywhere(tol)) => Some(tol),
                Some(Distance::Pixels(..)) | None => None,
            },
            reached: Some(reached.tol),
            angle_asked_deg: asked.angle.map(f64::to_degrees),
            angle_reached_deg: Some(reached.angle_deg),
            pixels: match asked.distance {
                Some(Distance::Pixels(pixels, _)) => Some(pixels),
                Some(Distance::Everywhere(_)) | None => None,
            },
        })
    }

    /// Returns where the grid's surface folds back on itself.
    ///
    /// The survey is made once: while the grid is made, or by the first call.
    #[must_use]
    pub fn survey(&self) -> &Survey {
        if let Some(survey) = self.survey.get() {
            return survey;
        }
        // The survey is made outside the lock: a thread that waits for other threads may meet this
        // sweep again.
        let (columns, rows) = self.lines();
        let survey = Survey::of(&self.shape, &columns, rows);
        self.survey.get_or_init(|| survey)
    }

    /// Returns the number of rows in which part of the surface folds back on itself. Normals are turned over there.
    #[must_use]
    pub fn folded_rows(&self) -> usize {
        let columns = self.shape.columns(&self.col_stops());
        self.row_stops()
            .par_iter()
            .filter(|&&stop| {
                let section = self.shape.section(stop);
                columns.iter().any(|column| self.shape.evaluate(&section, column).folds())
            })
            .count()
    }

    pub(crate) fn row_stops(&self) -> Vec<Stop> {
        match &self.fitted {
            Some(cells) => cells.rows.clone(),
            None => cut::evenly(&self.shape.row_breaks(), self.shape.closed(), self.rows()),
        }
    }

    pub(crate) fn col_stops(&self) -> Vec<Stop> {
        match (&self.fitted, &self.resolution) {
            (Some(cells), _) => cells.cols.clone(),
            (None, Resolution::Cells { cols, .. }) => self.shape.even_columns(*cols),
            (None, Resolution::Tolerance(_)) => self.shape.even_columns(0),
        }
    }

    /// Returns the columns and the rows of the grid.
    pub(crate) fn lines(&self) -> (Vec<Column>, Vec<Stop>) {
        (self.shape.columns(&self.col_stops()), self.row_stops())
    }
}
