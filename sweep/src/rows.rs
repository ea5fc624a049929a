//! The rows of a sweep: all at once as a grid, or block by block into a file.

use crate::check::fold::Survey;
use crate::cut::Stop;
use crate::grid::file::{Encoding, Header, Patch, Writer};
use crate::grid::{self, By, GridMesh, Row, Seam};
use crate::profile::Column;
use crate::resolution::Surface;
use crate::wall::Wall;
use crate::{Sweep, SweepError};
use files::{memory, words};
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use std::io::{self, Write};
use std::ops::Range;
use std::time::{Duration, Instant};

/// Points that are found together when a grid is written: some megabytes, and enough work for many
/// threads.
const BLOCK: usize = 1 << 16;

/// A sweep cut into rows and columns.
pub struct Rows<'a> {
    sweep: &'a Sweep,
    /// Along the sheet; a wall goes along it twice.
    stops: Vec<Stop>,
    columns: Vec<Column>,
    /// What the grid counts columns and rows by.
    u: Vec<f64>,
    v: Vec<f64>,
    /// How the last row leads on to the first.
    seam: (Seam, usize),
    wall: Option<Sides<'a>>,
}

/// A wall, and how its way comes back on the other side.
struct Sides<'a> {
    wall: &'a Wall,
    /// The column of the sheet at each column of the way back.
    led: Vec<usize>,
}

/// Where the time of writing went.
#[derive(Debug, Clone, Copy, Default)]
pub struct Spent {
    /// Finding points and normals.
    pub sweeping: Duration,
    /// Making bytes of them and passing those on.
    pub writing: Duration,
}

impl<'a> Rows<'a> {
    /// The rows and columns that a sweep asks for.
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
                // Each side has half of it.
                Some(_) => {
                    v.iter().copied().chain(v.iter().map(|v| 1.0 + v)).map(|v| 0.5 * v).collect()
                }
                None => v,
            },
            stops: rows,
            columns: shape.columns(&cols),
            seam,
            wall: sweep.wall.as_ref().map(sides),
        }
    }

    /// The whole grid.
    pub fn grid(&self) -> Result<GridMesh, SweepError> {
        let mut grid = self.blank();
        let (rows, cols) = (self.v.len(), self.columns.len());
        let count = rows * cols;
        let _reserved = memory::of_process().reserve(grid::bytes(rows, cols), || {
            format!("{}: a grid of {rows} x {cols} points", words::shown(&self.sweep.name))
        })?;
        grid.positions.resize(count, DVec3::ZERO);
        grid.normals.resize(count, Vec3::ZERO);
        self.fill(0..rows, &mut grid.positions, &mut grid.normals);
        Ok(grid)
    }

    /// Writes the grid in the memory of one block of rows.
    pub fn write(
        &self,
        patch: Patch,
        encoding: Encoding,
        out: &mut impl Write,
    ) -> io::Result<Spent> {
        let header = Header { patch, rows: self.v.len(), ..Header::of(&self.blank()) };
        let mut writer = Writer::new(&header, encoding, out)?;
        let cols = self.columns.len();
        let height = (BLOCK / cols).max(1);
        let (mut spent, mut from) = (Spent::default(), Instant::now());
        let mut lap = |total: &mut Duration| {
            let now = Instant::now();
            *total += now - std::mem::replace(&mut from, now);
        };
        let (mut positions, mut normals) = (Vec::new(), Vec::new());
        for start in (0..self.v.len()).step_by(height) {
            let rows = start..(start + height).min(self.v.len());
            positions.resize(rows.len() * cols, DVec3::ZERO);
            normals.resize(rows.len() * cols, Vec3::ZERO);
            self.fill(rows.clone(), &mut positions, &mut normals);
            lap(&mut spent.sweeping);
            let points = positions.chunks(cols).zip(normals.chunks(cols));
            for (&v, (positions, normals)) in self.v[rows].iter().zip(points) {
                writer.row(&Row { v, positions, normals })?;
            }
            lap(&mut spent.writing);
        }
        writer.finish()?;
        Ok(spent)
    }

    /// The grid without its points.
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
            uv: sweep.uv,
            areas: sweep.areas.clone(),
            tolerance: sweep.tolerance(),
            fold: Survey::of(sweep).fold(),
            u: self.u.clone(),
            v: self.v.clone(),
            ..GridMesh::default()
        }
    }

    /// Finds the points and normals of some rows, on all threads.
    fn fill(&self, rows: Range<usize>, positions: &mut [DVec3], normals: &mut [Vec3]) {
        let cols = self.columns.len();
        positions
            .par_chunks_mut(cols)
            .zip(normals.par_chunks_mut(cols))
            .zip(rows)
            .for_each(|((points, normals), row)| self.row(row, points, normals));
    }

    fn row(&self, row: usize, points: &mut [DVec3], normals: &mut [Vec3]) {
        let rows = self.stops.len();
        self.row_of_sheet(self.stops[row % rows], points, normals);
        match &self.wall {
            Some(sides) if row < rows => sides.wall.near(points, normals),
            Some(sides) => sides.wall.far(points, normals, &sides.led),
            None => {}
        }
    }

    fn row_of_sheet(&self, stop: Stop, points: &mut [DVec3], normals: &mut [Vec3]) {
        let shape = &self.sweep.shape;
        let section = shape.section(stop);
        for ((column, point), normal) in self.columns.iter().zip(points).zip(&mut *normals) {
            let place = shape.place(&section, column);
            (*point, *normal) = (place.point, place.normal.as_vec3());
        }
        if shape.closing.is_some() && stop == Stop::before(0.0) {
            // The end has come to the points of the start, with normals of its own.
            let end = shape.section(Stop::before(1.0));
            let (seam, shift) = self.seam;
            let side = if seam == Seam::Mirror { -1.0 } else { 1.0 };
            for (col, column) in self.columns.iter().enumerate() {
                let led = seam.leads_to(col, shift, self.columns.len());
                normals[led] = (shape.place(&end, column).normal * side).as_vec3();
            }
        }
    }
}
