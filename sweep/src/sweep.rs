//! A sweep that has been checked, and the grid it gives.

use crate::cap::Cap;
use crate::closing::Closing;
use crate::cut::{self, Stop};
use crate::deform::{Deform, Moved};
use crate::grid::file::MAX_COLS;
use crate::grid::{Area, GridMesh, Seam, UvLayout};
use crate::modulation::{Modulation, Section};
use crate::profile::{Column, Profile};
use crate::trajectory::Trajectory;
use crate::{Object, SweepError};
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
    pub(crate) contour: Profile,
    pub(crate) trajectory: Trajectory,
    pub(crate) modulation: Modulation,
    /// What closes the start and the end.
    pub(crate) caps: [Option<Cap>; 2],
    /// How it comes back to its start, where columns do not meet themselves.
    pub(crate) closing: Option<Closing>,
    /// What happens to the surface in the end, one after another.
    pub(crate) deforms: Vec<Deform>,
    pub(crate) rows: usize,
    pub(crate) cols: usize,
    pub(crate) uv: UvLayout,
    pub(crate) areas: Vec<Area>,
    pub(crate) position: DVec3,
}

impl Sweep {
    /// Reads and checks a spec of one sweep.
    ///
    /// # Errors
    /// As [`Object::read`], and when the object has several parts.
    pub fn read(document: &Document<'_>) -> Result<Self, SweepError> {
        let mut parts = Object::read(document)?.parts;
        match (parts.pop(), parts.len()) {
            (Some(sweep), 0) => Ok(sweep),
            (_, more) => {
                let message = format!("found {} parts, expected one sweep", more + 1);
                Err(document.fault("parts", message).into())
            }
        }
    }

    /// The object's name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What is swept: one contour or several.
    #[must_use]
    pub fn contour(&self) -> &Profile {
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
            None => {
                match sweep.areas.iter().find_map(|area| area.fault([sweep.rows, sweep.cols])) {
                    Some((key, message)) => {
                        Err(SweepError::Resolution(format!("areas, {key}: {message}")))
                    }
                    None => Ok(sweep),
                }
            }
        }
    }

    /// What is wrong with the numbers of cells: the key and a sentence.
    pub(crate) fn resolution_fault(&self) -> Option<(&'static str, String)> {
        let around = "to go around";
        let pieces = cut::pieces(&self.row_breaks());
        let fewest = if self.closed() { 3 } else { 1 }.max(pieces);
        if self.rows < fewest {
            let why = match fewest {
                1 => "along the trajectory",
                _ if fewest == pieces => "one for each piece between corners and for each cap",
                _ => around,
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
        let most = (MAX_COLS / self.contour.contours()).saturating_sub(more);
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
        let stops = self.col_stops();
        let (seam_v, shift) = self.seam(&stops);
        let stations = positions
            .par_chunks_mut(columns.len())
            .zip(normals.par_chunks_mut(columns.len()))
            .zip(&rows);
        stations.for_each(|((points, normals), &stop)| {
            let section = self.section(stop);
            for ((column, point), normal) in columns.iter().zip(points).zip(&mut *normals) {
                let place = self.place(&section, column);
                (*point, *normal) = (place.point, place.normal.as_vec3());
            }
            if self.closing.is_some() && stop == Stop::before(0.0) {
                // The end has come to the points of the start, with normals of its own.
                let end = self.section(Stop::before(1.0));
                let side = if seam_v == Seam::Mirror { -1.0 } else { 1.0 };
                for (col, column) in columns.iter().enumerate() {
                    let led = seam_v.leads_to(col, shift, columns.len());
                    normals[led] = (self.place(&end, column).normal * side).as_vec3();
                }
            }
        });
        let seam = |closed| if closed { Seam::Closed } else { Seam::Open };
        Ok(GridMesh {
            name: self.name.clone(),
            seam_u: seam(self.contour.closed()),
            seam_v,
            shift,
            uv: self.uv,
            areas: self.areas.clone(),
            u: columns.iter().map(|column| column.u).collect(),
            v: rows.iter().map(|stop| stop.at).collect(),
            positions,
            normals,
            ..GridMesh::default()
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
        let place = self.place(&self.section(Stop::after(v)), &column);
        (place.point, place.normal)
    }

    /// The number of rows in which some of the surface folds back on itself, since the trajectory
    /// bends more sharply than the contour is wide. Normals are turned over there.
    #[must_use]
    pub fn folded_rows(&self) -> usize {
        let columns = self.columns();
        self.row_stops()
            .par_iter()
            .filter(|&&stop| {
                let section = self.section(stop);
                columns
                    .iter()
                    .any(|column| section.folds(column) || self.place(&section, column).folds)
            })
            .count()
    }

    /// The contour at a stop of the rows, on the trajectory or on a cap.
    pub(crate) fn section(&self, stop: Stop) -> Section {
        let [start, end] = self.body();
        let on_trajectory = |at| self.modulation.section(&self.trajectory, Stop { at, ..stop });
        match self.caps {
            [None, None] => on_trajectory(stop.at),
            [Some(cap), _] if stop.at < start || stop == Stop::before(start) => {
                on_trajectory(0.0).gathered(cap.at(1.0 - stop.at / start), -1.0)
            }
            [_, Some(cap)] if stop.at > end || stop == Stop::after(end) => {
                on_trajectory(1.0).gathered(cap.at((stop.at - end) / (1.0 - end)), 1.0)
            }
            _ => on_trajectory(((stop.at - start) / (end - start)).clamp(0.0, 1.0)),
        }
    }

    /// A point of a section in its place in space, with its unit normal.
    fn place(&self, section: &Section, column: &Column) -> Moved {
        let (point, normal) = (section.point(column), section.normal(column));
        let mut moved = Moved { point, normal, folds: false };
        for deform in &self.deforms {
            let next = deform.apply(moved.point, moved.normal);
            moved = Moved {
                normal: next.normal.try_normalize().unwrap_or(moved.normal),
                folds: next.folds || moved.folds,
                ..next
            };
        }
        Moved { point: moved.point + self.position, ..moved }
    }

    /// Which part of `v` is on the trajectory: before and after it are the caps.
    fn body(&self) -> [f64; 2] {
        let [start, end] = self.caps.map(|cap| cap.map_or(0.0, |cap| cap.length()));
        let whole = start + self.trajectory.length() + end;
        [start / whole, if end == 0.0 { 1.0 } else { 1.0 - end / whole }]
    }

    /// Where the surface may have an edge along the contour: at caps, and at corners of the
    /// trajectory.
    fn row_breaks(&self) -> Vec<f64> {
        let [start, end] = self.body();
        let inner = self.trajectory.breaks().iter().map(|at| start + (end - start) * at);
        let first = self.caps[0].map(|_| start);
        let last = self.caps[1].map(|_| end);
        let edge = self.closing.filter(|closing| closing.edge).map(|_| 0.0);
        let folds = self.modulation.breaks(self.trajectory.closed());
        let folds = folds.map(|at| start + (end - start) * at);
        let mut breaks: Vec<f64> =
            edge.into_iter().chain(first).chain(inner).chain(folds).chain(last).collect();
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        breaks
    }

    fn row_stops(&self) -> Vec<Stop> {
        cut::evenly(&self.row_breaks(), self.closed(), self.rows)
    }

    fn col_stops(&self) -> Vec<Stop> {
        let (breaks, closed) = (self.contour.breaks(), self.contour.closed());
        match self.closing {
            Some(closing) => {
                cut::between(breaks, closed, self.cols, &closing.anchors(breaks, closed))
            }
            None => cut::evenly(breaks, closed, self.cols),
        }
    }

    /// Whether the rows lead back to the first.
    fn closed(&self) -> bool {
        self.trajectory.closed() || self.closing.is_some()
    }

    /// The seam of the rows, and its shift, with columns at these stops.
    fn seam(&self, stops: &[Stop]) -> (Seam, usize) {
        let plain = if self.closed() { Seam::Closed } else { Seam::Open };
        let closing = self
            .closing
            .as_ref()
            .and_then(|closing| closing.seam(stops, self.contour.breaks(), self.contour.closed()));
        closing.unwrap_or((plain, 0))
    }

    /// Whether the columns of the end meet those of the start.
    pub(crate) fn columns_meet(&self) -> bool {
        let (breaks, closed) = (self.contour.breaks(), self.contour.closed());
        let stops = self.col_stops();
        self.closing.is_none_or(|closing| closing.seam(&stops, breaks, closed).is_some())
    }

    fn columns(&self) -> Vec<Column> {
        let mut columns = self.contour.columns(&self.col_stops());
        self.snap_to_axis(&mut columns);
        columns
    }

    /// Puts points of a rotation that all but touch its axis on it.
    fn snap_to_axis(&self, columns: &mut [Column]) {
        if self.trajectory.is_rotation() {
            let on_axis = ON_AXIS * self.contour.x_range().1;
            let places = columns
                .iter_mut()
                .flat_map(|column| std::iter::once(&mut column.first).chain(&mut column.others));
            for place in places.filter(|place| place.point.x <= on_axis) {
                place.point.x = 0.0;
            }
        }
    }

    /// The columns and the rows of the grid.
    pub(crate) fn lines(&self) -> (Vec<Column>, Vec<Stop>) {
        (self.columns(), self.row_stops())
    }

    /// Where on the trajectory a stop of the rows lies; `None` on a cap.
    pub(crate) fn along(&self, stop: Stop) -> Option<f64> {
        let [start, end] = self.body();
        let before = stop.at < start || self.caps[0].is_some() && stop == Stop::before(start);
        let after = stop.at > end || self.caps[1].is_some() && stop == Stop::after(end);
        (!before && !after).then(|| ((stop.at - start) / (end - start)).clamp(0.0, 1.0))
    }
}
