//! A sweep that has been checked, and the grid it gives.

use crate::contour::{Column, Contour};
use crate::cut::{self, Stop};
use crate::grid::file::MAX_COLS;
use crate::grid::{GridMesh, Seam, UvLayout};
use crate::modulation::Modulation;
use crate::resolution::place::Direction;
use crate::resolution::{Cells, Reached, Resolution, Search, Surface, Tolerance};
use crate::spec::Mesh;
use crate::trajectory::Trajectory;
use crate::{SweepError, read};
use files::json::Document;
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// Cells of one grid at most: 3.6 GB of points and normals, and twice that when it is one cell wide.
pub const MOST_CELLS: usize = 100_000_000;

/// Distances from the axis of a rotation below this fraction of the largest are on it.
pub(crate) const ON_AXIS: f64 = 1e-9;

/// A contour, a trajectory and a resolution that fit each other.
#[derive(Debug, Clone)]
pub struct Sweep {
    pub(crate) name: String,
    pub(crate) contour: Contour,
    pub(crate) trajectory: Trajectory,
    pub(crate) modulation: Modulation,
    pub(crate) resolution: Resolution,
    /// What a tolerance comes to.
    pub(crate) fitted: Option<Cells>,
    pub(crate) uv: UvLayout,
    pub(crate) position: DVec3,
}

impl Sweep {
    /// Reads and checks a [`Spec`](crate::spec::Spec).
    ///
    /// # Errors
    /// When the text is not a spec, or its surface does not exist; the message has the place.
    pub fn read(document: &Document) -> Result<Self, SweepError> {
        read::read(document, &Mesh::default())
    }

    /// The same with another resolution: each key of `rather` in place of that of the spec.
    ///
    /// # Errors
    /// As [`Sweep::read`]; about what is wrong with `rather` as [`SweepError::Resolution`].
    pub fn read_rather(document: &Document, rather: &Mesh) -> Result<Self, SweepError> {
        read::read(document, rather)
    }

    /// The object's name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The contour.
    #[must_use]
    pub fn contour(&self) -> &Contour {
        &self.contour
    }

    /// The trajectory.
    #[must_use]
    pub fn trajectory(&self) -> &Trajectory {
        &self.trajectory
    }

    /// Cells along the trajectory, those of no height at corners not counted.
    #[must_use]
    pub fn rows(&self) -> usize {
        match (&self.resolution, &self.fitted) {
            (Resolution::Cells { rows, .. }, _) => *rows,
            (_, Some(cells)) => cut::cells(&cells.rows, self.trajectory.closed()),
            (_, None) => self.trajectory.fewest_cells(),
        }
    }

    /// Cells along the contour, those of no width at creases not counted.
    #[must_use]
    pub fn cols(&self) -> usize {
        match (&self.resolution, &self.fitted) {
            (Resolution::Cells { cols, .. }, _) => *cols,
            (_, Some(cells)) => cut::cells(&cells.cols, self.contour.closed()),
            (_, None) => self.contour.fewest_cells(),
        }
    }

    /// How well a tolerance is kept; nothing where rows and columns were asked for.
    #[must_use]
    pub fn reached(&self) -> Option<Reached> {
        self.fitted.as_ref().map(|cells| cells.reached)
    }

    /// By how much a tolerance is missed, in words; nothing where it is kept or none was asked for.
    #[must_use]
    pub fn missed(&self) -> Option<String> {
        match &self.resolution {
            Resolution::Tolerance(asked) => {
                self.reached().and_then(|reached| asked.missed(&reached))
            }
            Resolution::Cells { .. } => None,
        }
    }

    /// The resolution asked for.
    #[must_use]
    pub fn resolution(&self) -> &Resolution {
        &self.resolution
    }

    /// The same sweep with other numbers of cells; `None` keeps a number.
    ///
    /// # Errors
    /// When there are too few for the contour or the trajectory, or more than [`MOST_CELLS`].
    pub fn with_resolution(
        self,
        rows: Option<usize>,
        cols: Option<usize>,
    ) -> Result<Self, SweepError> {
        let rows = rows.unwrap_or_else(|| self.rows());
        let cols = cols.unwrap_or_else(|| self.cols());
        let sweep = Self { resolution: Resolution::Cells { rows, cols }, fitted: None, ..self };
        match sweep.resolution_fault() {
            Some((key, message)) => Err(SweepError::Resolution(format!("{key}: {message}"))),
            None => Ok(sweep),
        }
    }

    /// The same sweep with as many cells as keep a tolerance.
    ///
    /// # Errors
    /// When `max_quads` is too few for the contour and the trajectory.
    pub fn with_tolerance(self, tolerance: Tolerance) -> Result<Self, SweepError> {
        let resolution = Resolution::Tolerance(tolerance);
        let sweep = Self { resolution, fitted: None, ..self };
        match sweep.resolution_fault() {
            Some((key, message)) => Err(SweepError::Resolution(format!("{key}: {message}"))),
            None => Ok(sweep.fitted()),
        }
    }

    /// This with the cells that its tolerance asks for.
    pub(crate) fn fitted(self) -> Self {
        let Resolution::Tolerance(tolerance) = &self.resolution else { return self };
        let cells = self.search(tolerance).run();
        Self { fitted: Some(cells), ..self }
    }

    /// How near the triangles of [`Sweep::grid`] come to the surface; `tolerance` says in which unit.
    #[must_use]
    pub fn measure(&self, tolerance: &Tolerance) -> Reached {
        self.search(tolerance).measured([&self.row_stops(), &self.column_stops()])
    }

    fn search<'a>(&'a self, tolerance: &'a Tolerance) -> Search<'a> {
        Search {
            surface: self,
            tolerance,
            directions: [
                Direction {
                    breaks: self.trajectory.breaks().to_vec(),
                    kinks: self.modulation.kinks(),
                    closed: self.trajectory.closed(),
                    fewest: self.trajectory.fewest_cells(),
                    even: false,
                },
                Direction {
                    breaks: self.contour.breaks(),
                    kinks: Vec::new(),
                    closed: self.contour.closed(),
                    fewest: self.contour.fewest_cells(),
                    even: self.uniform_columns(),
                },
            ],
            detail: self.detail(),
            most_cols: self.most_cols(),
        }
    }

    /// Whether columns are evenly wide also where the contour bends unevenly: so that a seam that
    /// takes columns to other columns can.
    fn uniform_columns(&self) -> bool {
        false
    }

    /// Cells that see all that the surface does, along trajectory and contour.
    fn detail(&self) -> [usize; 2] {
        let [along, around] = self.modulation.detail();
        let cells = |curve: f64, laws: f64| (curve + laws).clamp(8.0, 1e7) as usize;
        [cells(self.trajectory.detail(), along), cells(self.contour.detail(), around)]
    }

    /// The most cells along the contour that a row of the grid has place for.
    fn most_cols(&self) -> usize {
        // What is given besides the cells' first points: corners twice, an open end.
        let more = self.contour.creases() + usize::from(!self.contour.closed());
        MAX_COLS.saturating_sub(more)
    }

    /// What is wrong with the numbers of cells: the key and a sentence.
    pub(crate) fn resolution_fault(&self) -> Option<(&'static str, String)> {
        let (rows, cols) = match &self.resolution {
            Resolution::Cells { rows, cols } => (*rows, *cols),
            Resolution::Tolerance(tolerance) => {
                let fewest = self.trajectory.fewest_cells() * self.contour.fewest_cells();
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
        let fewest = self.trajectory.fewest_cells();
        if rows < fewest {
            let why = if fewest > 1 { around } else { "along the trajectory" };
            return Some(("rows", format!("found {rows}, expected at least {fewest} {why}")));
        }
        let fewest = self.contour.fewest_cells();
        if cols < fewest {
            let why = match self.contour.creases() {
                0 if self.contour.closed() => around.to_owned(),
                0 => "along the contour".to_owned(),
                _ => "along a contour with corners: one for each piece between them".to_owned(),
            };
            return Some(("cols", format!("found {cols}, expected at least {fewest} {why}")));
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

    /// The surface's points and normals.
    ///
    /// Rows and columns lie at equal lengths of the trajectory and of each smooth piece of the
    /// contour, or where a tolerance asks for them. The grid is the same for any number of threads.
    ///
    /// # Panics
    /// When there is no memory for it; see [`Sweep::try_grid`].
    #[must_use]
    pub fn grid(&self) -> GridMesh {
        self.try_grid().unwrap_or_else(|error| panic!("{error}"))
    }

    /// The same as [`Sweep::grid`].
    ///
    /// # Errors
    /// When there is no memory for it.
    pub fn try_grid(&self) -> Result<GridMesh, SweepError> {
        let columns = self.columns(&self.column_stops());
        let rows = self.row_stops();
        let count = rows.len() * columns.len();
        let (mut positions, mut normals) = (Vec::new(), Vec::new());
        let reserved = positions.try_reserve_exact(count).and(normals.try_reserve_exact(count));
        reserved.map_err(|_| SweepError::Memory {
            name: self.name.clone(),
            points: count,
            bytes: count * (size_of::<DVec3>() + size_of::<Vec3>()),
        })?;
        positions.resize(count, DVec3::ZERO);
        normals.resize(count, Vec3::ZERO);
        let stations = positions
            .par_chunks_mut(columns.len())
            .zip(normals.par_chunks_mut(columns.len()))
            .zip(&rows);
        stations.for_each(|((points, normals), &stop)| {
            let section = self.modulation.section(&self.trajectory, stop);
            for ((column, point), normal) in columns.iter().zip(points).zip(normals) {
                *point = section.point(column) + self.position;
                *normal = section.normal(column).as_vec3();
            }
        });
        let seam = |closed| if closed { Seam::Closed } else { Seam::Open };
        Ok(GridMesh {
            name: self.name.clone(),
            seam_u: seam(self.contour.closed()),
            seam_v: seam(self.trajectory.closed()),
            shift: 0,
            uv: self.uv,
            u: columns.iter().map(|column| column.u).collect(),
            v: rows.iter().map(|stop| stop.at).collect(),
            positions,
            normals,
        })
    }

    /// The surface at any place: the point and the unit normal, both as in the grid.
    ///
    /// `u` and `v` are fractions of the contour's and the trajectory's length. At a crease the
    /// normal is that of the side after.
    #[must_use]
    pub fn at(&self, u: f64, v: f64) -> (DVec3, DVec3) {
        let mut column = self.contour.at(u);
        self.snap_to_axis(std::slice::from_mut(&mut column));
        let section = self.modulation.section(&self.trajectory, Stop::after(v));
        (section.point(&column) + self.position, section.normal(&column))
    }

    /// The number of rows in which some of the surface folds back on itself, since the trajectory
    /// bends more sharply than the contour is wide. Normals are turned over there.
    #[must_use]
    pub fn folded_rows(&self) -> usize {
        let columns = self.columns(&self.column_stops());
        self.row_stops()
            .par_iter()
            .filter(|&&stop| {
                let section = self.modulation.section(&self.trajectory, stop);
                columns.iter().any(|column| section.folds(column))
            })
            .count()
    }

    fn row_stops(&self) -> Vec<Stop> {
        match &self.fitted {
            Some(cells) => cells.rows.clone(),
            None => cut::evenly(self.trajectory.breaks(), self.trajectory.closed(), self.rows()),
        }
    }

    fn column_stops(&self) -> Vec<Stop> {
        match &self.fitted {
            Some(cells) => cells.cols.clone(),
            None => cut::evenly(&self.contour.breaks(), self.contour.closed(), self.cols()),
        }
    }

    /// Puts points of a rotation that all but touch its axis on it.
    fn snap_to_axis(&self, columns: &mut [Column]) {
        if self.trajectory.is_rotation() {
            let on_axis = ON_AXIS * self.contour.x_range().1;
            for column in columns {
                if column.point.x <= on_axis {
                    column.point.x = 0.0;
                }
            }
        }
    }
}

impl Surface for Sweep {
    fn columns(&self, stops: &[Stop]) -> Vec<Column> {
        let mut columns = self.contour.columns(stops);
        self.snap_to_axis(&mut columns);
        columns
    }

    fn station(&self, stop: Stop, columns: &[Column]) -> Vec<(DVec3, DVec3)> {
        let section = self.modulation.section(&self.trajectory, stop);
        let place = |column| (section.point(column) + self.position, section.normal(column));
        columns.iter().map(place).collect()
    }

    fn points(&self, stop: Stop, columns: &[Column]) -> Vec<DVec3> {
        let section = self.modulation.section(&self.trajectory, stop);
        columns.iter().map(|column| section.point(column) + self.position).collect()
    }
}
