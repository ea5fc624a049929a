//! The rows of a sweep, evaluated all at once as a grid, or block by block into a file.

use super::survey::{RowSurvey, Survey};
use super::{Sweep, lids};
use crate::curve::cut::{Side, Stop};
use crate::error::SweepError;
use crate::grid::file::{Encoding, Header, Patch, Writer};
use crate::grid::{self, By, GridMesh, Lid, Row, Seam};
use crate::surface::Surface;
use crate::surface::profile::Column;
use crate::surface::wall::Wall;
use files::{memory, words};
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use std::io::{self, Write};
use std::ops::Range;
use std::time::{Duration, Instant};

/// Number of points that are evaluated together when a grid is written, some 2.4 MB. With a larger
/// number, writing takes more memory. With a smaller number, many threads have too little work.
const BLOCK: usize = 1 << 16;

/// Largest number of points of a grid that is made whole before it is written, some 19 MB. With a
/// larger number, writing takes more memory. With a smaller number, more grids are evaluated twice,
/// first for their header.
const KEPT: usize = 1 << 19;

/// A sweep cut into rows and columns.
pub struct Rows<'a> {
    sweep: &'a Sweep,
    /// Stops of the rows of the sheet; a wall runs along the sheet twice.
    stops: Vec<Stop>,
    /// Positions with two rows, one for each side.
    breaks: Vec<f64>,
    columns: Vec<Column>,
    /// Stops of the columns.
    cols: Vec<Stop>,
    /// `u` of each column of the grid.
    u: Vec<f64>,
    /// `v` of each row of the grid.
    v: Vec<f64>,
    /// The seam between the last row of the sheet and the first, and its shift in columns.
    seam: (Seam, usize),
    wall: Option<Sides<'a>>,
    /// The lids of the group, if the sweep is its last; `None` if they cannot be made.
    lids: Option<Vec<Lid>>,
}

/// A wall, and the columns on which it returns on the other side.
struct Sides<'a> {
    wall: &'a Wall,
    /// The column of the sheet for each column of the returning side.
    led: Vec<usize>,
}

/// Times that writing a grid took.
#[derive(Debug, Clone, Copy, Default)]
pub struct Spent {
    /// Time for the evaluation of points and normals, and for the survey of folds.
    pub sweeping: Duration,
    /// Time for encoding and for the output.
    pub writing: Duration,
}

impl<'a> Rows<'a> {
    /// Returns the rows and columns of a sweep, not yet evaluated.
    pub fn of(sweep: &'a Sweep) -> Self {
        let (rows, cols) = (sweep.row_stops(), sweep.col_stops());
        let (by, shape) = (sweep.uv.by, &sweep.shape);
        let seam = shape.seam(&cols).unwrap_or_default();
        let v: Vec<f64> = match by {
            By::Length => rows.iter().map(|stop| stop.at).collect(),
            By::Parameter => rows.iter().map(|stop| shape.parameter_of(stop.at)).collect(),
        };
        let sides = |wall| Sides {
            wall,
            led: (0..cols.len()).map(|col| seam.0.leads_to(col, seam.1, cols.len())).collect(),
        };
        Self {
            sweep,
            u: match by {
                By::Length => cols.iter().map(|stop| stop.at).collect(),
                By::Parameter => cols.iter().map(|&stop| shape.contour.parameter(stop)).collect(),
            },
            v: match sweep.wall {
                // Each side of the wall takes half of `v`.
                Some(_) => {
                    v.iter().copied().chain(v.iter().map(|v| 1.0 + v)).map(|v| 0.5 * v).collect()
                }
                None => v,
            },
            stops: rows,
            breaks: shape.row_breaks(),
            columns: shape.columns(&cols),
            cols: cols.clone(),
            seam,
            wall: sweep.wall.as_ref().map(sides),
            lids: if sweep.group == 1 {
                lids::of(std::slice::from_ref(sweep))
            } else {
                Some(Vec::new())
            },
        }
    }

    /// Returns the rows and columns of a sweep that is the last of a group.
    pub fn last_of(group: &'a [Sweep]) -> Self {
        let rows = Self::of(&group[group.len() - 1]);
        if group.len() == 1 { rows } else { Self { lids: lids::of(group), ..rows } }
    }

    /// Returns the whole grid. If the sweep has no survey yet, it is made from the same evaluation.
    ///
    /// # Errors
    /// When there is not enough memory for the grid.
    pub fn grid(&self) -> Result<GridMesh, SweepError> {
        let mut grid = self.blank();
        if self.lids.is_none() {
            return Err(SweepError::Lids(words::shown(&self.sweep.name).to_string()));
        }
        let (rows, cols) = (self.v.len(), self.columns.len());
        let count = rows * cols;
        let _reserved = memory::of_process().reserve(grid::bytes(rows, cols), || {
            format!("{}: a grid of {rows} x {cols} points", words::shown(&self.sweep.name))
        })?;
        grid.positions.resize(count, DVec3::ZERO);
        grid.normals.resize(count, Vec3::ZERO);
        let mut surveyed = self.fill(0..rows, &mut grid.positions, &mut grid.normals);
        // The second side of a wall surveys the sheet again.
        surveyed.truncate(self.stops.len());
        let survey = || Survey::from_rows(&self.sweep.shape, cols, self.stops.clone(), &surveyed);
        grid.fold = self.sweep.survey.get_or_init(survey).fold();
        Ok(grid)
    }

    /// Writes the grid. The header contains the survey and precedes the rows, so a grid of at most
    /// [`KEPT`] points is made whole. A larger one is surveyed first and then made in blocks of
    /// rows, which takes two evaluations of each point and the memory of one block.
    ///
    /// # Errors
    /// When writing to `out` fails.
    pub fn write(
        &self,
        patch: Patch,
        encoding: Encoding,
        out: &mut impl Write,
    ) -> io::Result<Spent> {
        if self.lids.is_none() {
            let error = SweepError::Lids(words::shown(&self.sweep.name).to_string());
            return Err(io::Error::new(io::ErrorKind::InvalidInput, error));
        }
        let small = self.v.len() * self.columns.len() <= KEPT;
        let mut clock = Clock::start();
        // Without memory for the whole grid, blocks may still fit.
        let whole =
            if small && self.sweep.survey.get().is_none() { self.grid().ok() } else { None };
        let mut spent = Spent::default();
        match whole {
            Some(grid) => {
                clock.lap(&mut spent.sweeping);
                let header = Header { patch, ..Header::of(&grid) };
                let mut writer = Writer::new(&header, encoding, out)?;
                grid.row_views().try_for_each(|row| writer.row(&row))?;
                writer.finish()?;
                clock.lap(&mut spent.writing);
            }
            None => self.write_blocks(patch, encoding, out, &mut clock, &mut spent)?,
        }
        Ok(spent)
    }

    fn write_blocks(
        &self,
        patch: Patch,
        encoding: Encoding,
        out: &mut impl Write,
        clock: &mut Clock,
        spent: &mut Spent,
    ) -> io::Result<()> {
        let fold = self.sweep.survey().fold();
        clock.lap(&mut spent.sweeping);
        let blank = GridMesh { fold, ..self.blank() };
        let header = Header { patch, rows: self.v.len(), ..Header::of(&blank) };
        let mut writer = Writer::new(&header, encoding, out)?;
        let cols = self.columns.len();
        let height = (BLOCK / cols).max(1);
        let (mut positions, mut normals) = (Vec::new(), Vec::new());
        for start in (0..self.v.len()).step_by(height) {
            let rows = start..(start + height).min(self.v.len());
            positions.resize(rows.len() * cols, DVec3::ZERO);
            normals.resize(rows.len() * cols, Vec3::ZERO);
            self.fill(rows.clone(), &mut positions, &mut normals);
            clock.lap(&mut spent.sweeping);
            let points = positions.chunks(cols).zip(normals.chunks(cols));
            for (&v, (positions, normals)) in self.v[rows].iter().zip(points) {
                writer.row(&Row { v, positions, normals })?;
            }
            clock.lap(&mut spent.writing);
        }
        writer.finish()
    }

    /// Returns the grid without its points and its survey.
    fn blank(&self) -> GridMesh {
        let sweep = self.sweep;
        let (seam_v, shift) = if self.wall.is_some() { (Seam::Closed, 0) } else { self.seam };
        GridMesh {
            name: sweep.name.clone(),
            seam_u: if sweep.contour().closed() { Seam::Closed } else { Seam::Open },
            seam_v,
            shift,
            texture: sweep.texture,
            surface: sweep.surface,
            unit: sweep.unit,
            uv: sweep.uv,
            areas: sweep.areas.clone(),
            lids: self.lids.clone().unwrap_or_default(),
            pressed: sweep.shape.press.map_or([false; 2], |press| press.ends),
            tolerance: sweep.tolerance(),
            u: self.u.clone(),
            v: self.v.clone(),
            ..GridMesh::default()
        }
    }

    /// Evaluates the points and normals of some rows on all threads, and returns the survey of each row.
    fn fill(
        &self,
        rows: Range<usize>,
        positions: &mut [DVec3],
        normals: &mut [Vec3],
    ) -> Vec<RowSurvey> {
        let cols = self.columns.len();
        positions
            .par_chunks_mut(cols)
            .zip(normals.par_chunks_mut(cols))
            .zip(rows)
            .map(|((points, normals), row)| self.row(row, points, normals))
            .collect()
    }

    fn row(&self, row: usize, points: &mut [DVec3], normals: &mut [Vec3]) -> RowSurvey {
        let rows = self.stops.len();
        let survey = self.row_of_sheet(self.stops[row % rows], points, normals);
        match &self.wall {
            Some(sides) if row < rows => sides.wall.near(points, normals),
            Some(sides) => sides.wall.far(points, normals, &sides.led),
            None => {}
        }
        survey
    }

    /// Returns whether a position has two rows.
    fn is_break(&self, at: f64) -> bool {
        self.breaks.binary_search_by(|other| other.total_cmp(&at)).is_ok()
    }

    fn row_of_sheet(&self, stop: Stop, points: &mut [DVec3], normals: &mut [Vec3]) -> RowSurvey {
        let shape = &self.sweep.shape;
        let section = shape.section(stop);
        // Both rows of a break have the points of the first one. Evaluated from the other side, the points of a
        // mitre would differ in their last bits, and the two rows would not be one.
        let first = (stop.side == Side::After && self.is_break(stop.at))
            .then(|| shape.section(Stop::before(stop.at)));
        let mut survey = RowSurvey::new(shape, stop);
        for ((column, point), normal) in self.columns.iter().zip(&mut *points).zip(&mut *normals) {
            let found = shape.evaluate(&section, column);
            survey.add(column.u, &found);
            *point = match &first {
                Some(first) => shape.evaluate(first, column).point,
                None => found.point,
            };
            *normal = found.normal.as_vec3();
        }
        if shape.closing.is_some() && stop == Stop::before(0.0) {
            // The end has the points of the start, with normals of its own.
            let end = shape.section(Stop::before(1.0));
            let (seam, shift) = self.seam;
            let side = if seam == Seam::Mirror { -1.0 } else { 1.0 };
            for (col, column) in self.columns.iter().enumerate() {
                let led = seam.leads_to(col, shift, self.columns.len());
                normals[led] = (shape.evaluate(&end, column).normal * side).as_vec3();
            }
        }
        if let Some(press) = shape.press.filter(|press| press.at(stop)) {
            press.join(&self.cols, shape.contour.breaks(), points);
        }
        survey
    }
}

/// A clock that adds up the times of stages that follow each other.
struct Clock(Instant);

impl Clock {
    fn start() -> Self {
        Self(Instant::now())
    }

    /// Adds the time since the last call to `total`.
    fn lap(&mut self, total: &mut Duration) {
        let now = Instant::now();
        *total += now - std::mem::replace(&mut self.0, now);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec;
    use files::Disk;
    use files::json::Document;
    use std::path::Path;

    /// A wall around a bottle that closes mirrored.
    const BOTTLE: &str = include_str!("../../../examples/curves/klein-glass.json");

    /// A spec of a bent tube that folds.
    const TUBE: &str = r#"{"format": "tb-sweep", "version": 1, "name": "tube",
        "contour": {"circle": 0.5}, "trajectory": {"line": [[0, 0, 0], [0, 3, 0]]},
        "depth": {"mode": "offset", "terms": [{"amp": 0.1, "u": 5, "v": 2}]},
        "deform": [{"bend": {"from": 0, "to": 3, "degrees": 700, "toward": [1, 0, 0]}}],
        "caps": {"start": "flat"}, "mesh": {"rows": 30, "cols": 24}}"#;

    #[test]
    fn blocks_are_the_same_bytes_as_a_whole_grid() {
        for text in [BOTTLE, TUBE] {
            let document = Document::new("a.json", text.as_bytes()).unwrap();
            let counts = spec::Resolution { rows: Some(40), cols: Some(24), ..Default::default() };
            let sweep = Sweep::read_in(&document, Path::new(""), &Disk, &counts).unwrap();
            let (mut whole, mut blocks) = (Vec::new(), Vec::new());
            let patch = Patch { number: 1, of: 1 };
            let (mut clock, mut spent) = (Clock::start(), Spent::default());
            let surveyed = sweep.clone();
            Rows::of(&surveyed)
                .write_blocks(patch, Encoding::Binary, &mut blocks, &mut clock, &mut spent)
                .unwrap();
            assert!(sweep.survey.get().is_none(), "the grid is surveyed with its rows");
            Rows::of(&sweep).write(patch, Encoding::Binary, &mut whole).unwrap();
            assert!(whole == blocks, "{text}");
            assert_eq!(format!("{:?}", sweep.survey()), format!("{:?}", surveyed.survey()));
        }
    }
}
