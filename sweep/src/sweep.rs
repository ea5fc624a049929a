//! A sweep that has been checked, and the grid it gives.

use crate::contour::{Column, Contour};
use crate::cut::{self, Stop};
use crate::grid::file::MAX_COLS;
use crate::grid::{GridMesh, Seam, UvLayout};
use crate::modulation::Modulation;
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
    pub(crate) rows: usize,
    pub(crate) cols: usize,
    pub(crate) uv: UvLayout,
    pub(crate) position: DVec3,
}

impl Sweep {
    /// Reads and checks a [`Spec`](crate::spec::Spec).
    ///
    /// # Errors
    /// When the text is not a spec, or its surface does not exist; the message has the place.
    pub fn read(document: &Document) -> Result<Self, SweepError> {
        read::read(document)
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

    /// Cells along the trajectory.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Cells along the contour, those of no width at creases not counted.
    #[must_use]
    pub fn cols(&self) -> usize {
        self.cols
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
        let sweep =
            Self { rows: rows.unwrap_or(self.rows), cols: cols.unwrap_or(self.cols), ..self };
        match sweep.resolution_fault() {
            Some((key, message)) => Err(SweepError::Resolution(format!("{key}: {message}"))),
            None => Ok(sweep),
        }
    }

    /// What is wrong with the numbers of cells: the key and a sentence.
    pub(crate) fn resolution_fault(&self) -> Option<(&'static str, String)> {
        let around = "to go around";
        let fewest = self.trajectory.fewest_cells();
        if self.rows < fewest {
            let why = match self.trajectory.breaks().len() {
                0 if fewest > 1 => around,
                0 => "along the trajectory",
                _ => "along a trajectory with corners: one for each piece between them",
            };
            return Some((
                "rows",
                format!("found {}, expected at least {fewest} {why}", self.rows),
            ));
        }
        let fewest = self.contour.fewest_cells();
        if self.cols < fewest {
            let why = match self.contour.creases() {
                0 if self.contour.closed() => around.to_owned(),
                0 => "along the contour".to_owned(),
                _ => "along a contour with corners: one for each piece between them".to_owned(),
            };
            return Some((
                "cols",
                format!("found {}, expected at least {fewest} {why}", self.cols),
            ));
        }
        // What is given besides the cells' first points: corners twice, an open end.
        let more = self.contour.creases() + usize::from(!self.contour.closed());
        let most = MAX_COLS.saturating_sub(more);
        if self.cols > most {
            return Some(("cols", format!("found {}, expected at most {most}", self.cols)));
        }
        let cells = self.rows.checked_mul(self.cols).filter(|&cells| cells <= MOST_CELLS);
        cells.is_none().then(|| {
            let (rows, cols) = (self.rows, self.cols);
            ("rows", format!("found {rows} x {cols} cells, expected at most {MOST_CELLS}"))
        })
    }

    /// The surface's points and normals.
    ///
    /// Rows and columns lie at equal lengths of the trajectory and of each smooth piece of the
    /// contour. The grid is the same for any number of threads.
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
        let columns = self.columns();
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
        let columns = self.columns();
        self.row_stops()
            .par_iter()
            .filter(|&&stop| {
                let section = self.modulation.section(&self.trajectory, stop);
                columns.iter().any(|column| section.folds(column))
            })
            .count()
    }

    fn row_stops(&self) -> Vec<Stop> {
        cut::evenly(self.trajectory.breaks(), self.trajectory.closed(), self.rows)
    }

    fn columns(&self) -> Vec<Column> {
        let stops = cut::evenly(&self.contour.breaks(), self.contour.closed(), self.cols);
        let mut columns = self.contour.columns(&stops);
        self.snap_to_axis(&mut columns);
        columns
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
