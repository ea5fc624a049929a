//! Turns rows into vertices and triangles.

use crate::cell::{Cell, CellWriter, Picture};
use crate::lids::{self, Rim, Rims};
use crate::rounding::Rounding;
use crate::station::Station;
use crate::{Material, Options, Triangle, TriangulateError};
use std::collections::HashMap;
use std::io;
use sweep::grid::file::Header;
use sweep::grid::{Row, Seam};

/// Receives the parts of a mesh one by one.
///
/// Positions, picture coordinates and normals are numbered from 0 in the order they arrive, each kind
/// separately. A triangle refers only to numbers that arrived before it.
pub trait Sink {
    /// Starts a patch. All parts up to the next call belong to this patch.
    fn patch(&mut self, header: &Header);
    /// Sets the material of the triangles that follow.
    fn material(&mut self, material: Material);
    /// Takes the next position, in the grid's unit.
    fn position(&mut self, position: [f32; 3]);
    /// Takes the next picture coordinates.
    fn uv(&mut self, uv: [f32; 2]);
    /// Takes the next normal, a unit vector.
    fn normal(&mut self, normal: [f32; 3]);
    /// Takes the next triangle.
    fn triangle(&mut self, triangle: &Triangle);
    /// Marks the end of a row and its triangles, so that the sink can pass them on.
    ///
    /// # Errors
    /// When the sink cannot pass the row on.
    fn row_done(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Two sinks that receive the same calls.
impl<A: Sink, B: Sink> Sink for (A, B) {
    fn patch(&mut self, header: &Header) {
        self.0.patch(header);
        self.1.patch(header);
    }

    fn material(&mut self, material: Material) {
        self.0.material(material);
        self.1.material(material);
    }

    fn position(&mut self, position: [f32; 3]) {
        self.0.position(position);
        self.1.position(position);
    }

    fn uv(&mut self, uv: [f32; 2]) {
        self.0.uv(uv);
        self.1.uv(uv);
    }

    fn normal(&mut self, normal: [f32; 3]) {
        self.0.normal(normal);
        self.1.normal(normal);
    }

    fn triangle(&mut self, triangle: &Triangle) {
        self.0.triangle(triangle);
        self.1.triangle(triangle);
    }

    fn row_done(&mut self) -> io::Result<()> {
        self.0.row_done()?;
        self.1.row_done()
    }
}

/// Counts and rounding errors of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Counts {
    /// Number of different positions.
    pub positions: u32,
    /// Number of different picture coordinates.
    pub uvs: u32,
    /// Number of different normals.
    pub normals: u32,
    /// Number of triangles.
    pub triangles: u64,
    /// Number of cells that became two triangles.
    pub quads: u64,
    /// Number of triangles left out because two corners are one point, as at poles and creases.
    pub collapsed: u64,
    /// Number of triangles left out because their three corners lie on a line. The mesh has a slit of
    /// no width there.
    pub slivers: u64,
    /// The largest distance by which rounding to f32 moved a coordinate, as a fraction of the object's
    /// size (the diagonal of its box). About 1e-8 for an object about the origin. For an object far from
    /// the origin, the fraction grows with the ratio of its distance to its size. Infinite for an object
    /// that is one point and was moved.
    pub moved: f64,
    /// The largest distance by which rounding moved a point, in the grid's unit.
    pub displacement: f64,
    /// The largest distance by which rounding moved a point, as a fraction of the distance from the
    /// surface that the grid's tolerance allows. Above 1, rounding exceeds the tolerance. 0 for a
    /// grid without a tolerance.
    pub tolerance_used: f64,
}

/// The largest number of vertices of each kind.
const NUMBERS: u64 = u32::MAX as u64;
/// The most numbers that a point takes, of one kind. A pole gives a cell at most one more normal and
/// one more pair of picture coordinates than the cell has points.
const NUMBERS_OF_POINT: u64 = 2;
/// The most numbers that a point takes where a cell may share no picture coordinates with its
/// neighbours.
const NUMBERS_IN_AREAS: u64 = 4;
/// The largest number of repeats of a picture; far below the largest f32.
const MAX_REPEAT: f64 = 1e30;

/// Makes triangles of rows as they arrive.
///
/// Holds the current row, the row before, and the first row if the last row leads back to it.
#[derive(Debug)]
pub struct Triangulator<S> {
    header: Header,
    writer: CellWriter<S>,
    /// The first row as it follows the last row, if the last row leads back to it.
    first: Option<Station>,
    before: Option<Station>,
    /// A station that is no longer needed; its memory is reused.
    spare: Station,
    rounding: Rounding,
    /// Number of rows taken so far.
    rows: usize,
    /// The first and the last row, which lids join.
    rim: Rim,
}

impl<S: Sink> Triangulator<S> {
    /// Makes a triangulator of rows that fit `header`, for the first patch of an object.
    ///
    /// # Errors
    /// See [`Triangulator::following`].
    pub fn new(header: Header, options: &Options, sink: S) -> Result<Self, TriangulateError> {
        Self::following(Counts::default(), header, options, sink)
    }

    /// Makes a triangulator for a patch that follows others. `counts` are those of the patches before;
    /// vertices are numbered on from there.
    ///
    /// # Errors
    /// When the grid has too few points for a surface, or more than can be numbered; when its seam is
    /// invalid, or its picture repeats too often.
    pub fn following(
        counts: Counts,
        header: Header,
        options: &Options,
        mut sink: S,
    ) -> Result<Self, TriangulateError> {
        let (rows, cols) = (header.rows, header.cols());
        let object = header.name.clone();
        if rows < 2 || cols < 2 {
            return Err(TriangulateError::TooFew { object, rows, cols });
        }
        if let Some(fault) = header.seam_fault() {
            return Err(TriangulateError::Seam { object, fault });
        }
        // The limit includes the row and the column that seams add to the picture.
        let taken = counts.positions.max(counts.uvs).max(counts.normals);
        let of_point = if header.areas.is_empty() { NUMBERS_OF_POINT } else { NUMBERS_IN_AREAS };
        let limit = (NUMBERS - u64::from(taken)) / of_point;
        if (rows as u64 + 1).saturating_mul(cols as u64 + 1) > limit {
            return Err(TriangulateError::TooMany { object, rows, cols, limit });
        }
        let found = header.uv.repeat[0].max(header.uv.repeat[1]);
        if found > MAX_REPEAT {
            return Err(TriangulateError::Repeat { object, found });
        }
        let (picture, material) = (Picture::new(&header, options), options.material(&header));
        sink.patch(&header);
        sink.material(material);
        Ok(Self {
            header,
            writer: CellWriter::new(sink, counts, picture, material),
            first: None,
            before: None,
            spare: Station::default(),
            rounding: Rounding::none(),
            rows: 0,
            rim: Rim::default(),
        })
    }

    /// Takes the next row, and passes its vertices and the triangles between it and the row before to
    /// the sink.
    ///
    /// # Errors
    /// When the row has another number of points than the header says, is one too many, holds a number
    /// that does not fit in f32, or the sink fails.
    pub fn row(&mut self, row: Row<'_>) -> Result<(), TriangulateError> {
        let counts = [row.positions.len(), row.normals.len()];
        if self.rows == self.header.rows || counts != [self.header.cols(); 2] {
            return Err(self.misfit(counts[0].min(counts[1])));
        }
        self.rows += 1;
        let mut station = std::mem::take(&mut self.spare);
        station.take(&row, &self.header.name, self.rows, self.writer.picture.cols())?;
        self.rounding.add(row.positions, &station.points);
        self.number_positions(&mut station);
        if self.rows == 1 || self.rows == self.header.rows {
            let of_row = station.position.iter().copied().zip(station.points.iter().copied());
            self.rim.rows[usize::from(self.rows > 1)] = of_row.collect();
        }
        if let Some(mut before) = self.before.take() {
            self.band(&mut before, &mut station);
            if self.rows == 2 && self.header.seam_v.joins() {
                self.first = Some(before.over_seam(&self.header));
            } else {
                self.spare = before;
            }
        }
        self.before = Some(station);
        self.writer.sink.row_done().map_err(TriangulateError::Write)
    }

    /// Closes the seam, if there is one, and returns the sink with the counts of all patches so far.
    ///
    /// # Errors
    /// When rows are missing, or the sink fails.
    pub fn finish(self) -> Result<(S, Counts), TriangulateError> {
        self.close(&mut Rims::new())
    }

    /// Closes the seam as [`Triangulator::finish`] does, and adds the lids of the patch. `rims` are those of the
    /// patches before; that of this patch is added.
    pub(crate) fn close(mut self, rims: &mut Rims) -> Result<(S, Counts), TriangulateError> {
        if self.rows < self.header.rows {
            return Err(self.misfit(0));
        }
        if let (Some(mut first), Some(mut last)) = (self.first.take(), self.before.take()) {
            self.band(&mut last, &mut first);
            self.writer.sink.row_done().map_err(TriangulateError::Write)?;
        }
        rims.push(std::mem::take(&mut self.rim));
        if !self.header.lids.is_empty() {
            self.writer.patch_material();
            for lid in &self.header.lids {
                lids::write(lid, &self.header.name, rims, &mut self.writer)?;
            }
            self.writer.sink.row_done().map_err(TriangulateError::Write)?;
        }
        let before = self.writer.counts;
        let displacement = self.rounding.displacement_sq.sqrt();
        let asked = self.header.tolerance.and_then(|tolerance| tolerance.asked);
        let used = asked.map_or(0.0, |asked| displacement / asked);
        let counts = Counts {
            moved: before.moved.max(self.rounding.fraction()),
            displacement: before.displacement.max(displacement),
            tolerance_used: before.tolerance_used.max(used),
            ..before
        };
        Ok((self.writer.sink, counts))
    }

    /// Numbers the points of a row. A point that equals its neighbour to the left, below, or across a
    /// seam takes the neighbour's number. Any other point is a new vertex.
    fn number_positions(&mut self, station: &mut Station) {
        let cols = station.points.len();
        let over_seam = self.first.as_ref().filter(|_| self.rows == self.header.rows);
        let closed = self.header.seam_u == Seam::Closed;
        let ends = [self.rows == 1, self.rows == self.header.rows];
        let pressed = (0..2).any(|end| ends[end] && self.header.pressed[end]);
        let mut places: HashMap<[u32; 3], u32> = HashMap::new();
        for col in 0..cols {
            let point = station.points[col];
            let place = point.map(f32::to_bits);
            let in_column = |other: Option<&Station>| {
                other.filter(|other| other.points[col] == point).map(|other| other.position[col])
            };
            let in_row =
                |other: usize| (station.points[other] == point).then(|| station.position[other]);
            let known = col
                .checked_sub(1)
                .and_then(in_row)
                .or_else(|| in_column(self.before.as_ref()))
                .or_else(|| in_column(over_seam))
                .or_else(|| (closed && col > 0 && col + 1 == cols).then(|| in_row(0)).flatten())
                .or_else(|| places.get(&place).copied());
            let number = known.unwrap_or_else(|| self.writer.position(point));
            station.position.push(number);
            if pressed {
                places.insert(place, number);
            }
        }
    }

    /// Returns the error for a next row of `cols` points that does not fit the header.
    fn misfit(&self, cols: usize) -> TriangulateError {
        TriangulateError::Rows {
            object: self.header.name.clone(),
            row: self.rows + 1,
            cols,
            rows: self.header.rows,
            expected: self.header.cols(),
        }
    }

    /// Passes the triangles between two rows to the sink.
    fn band(&mut self, lower: &mut Station, upper: &mut Station) {
        let cols = self.header.cols();
        self.writer.picture.areas.next_band([lower.v, upper.v]);
        for left in 0..self.writer.picture.cols() - 1 {
            let right = if left + 1 == cols { 0 } else { left + 1 };
            let mut cell = Cell { lower, upper, left, right };
            self.writer.cell(&mut cell);
        }
        self.writer.band_done();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TriMesh;
    use glam::{DVec3, Vec3};
    use sweep::grid::UvLayout;

    fn header(rows: usize, cols: usize) -> Header {
        Header { name: "sheet".into(), rows, u: vec![0.0; cols], ..Header::default() }
    }

    fn complaint(header: Header) -> String {
        let options = Options::default();
        Triangulator::new(header, &options, TriMesh::default()).unwrap_err().to_string()
    }

    #[test]
    fn a_grid_that_makes_no_mesh_is_refused_at_once() {
        let message = complaint(header(3_000_000_000, 2));
        assert!(message.contains("found 3000000000 x 2 points, expected at most"), "{message}");
        let most = Counts { uvs: u32::MAX - 40, ..Counts::default() };
        let following = |cols| {
            let options = Options::default();
            Triangulator::following(most, header(3, cols), &options, TriMesh::default())
        };
        assert!(following(4).is_ok());
        let message = following(5).unwrap_err().to_string();
        assert!(message.contains("found 3 x 5 points, expected at most 20"), "{message}");
        let message = complaint(header(1, 5));
        assert_eq!(message, "sheet: found 1 rows of 5 columns, expected at least 2 of each");
        let message = complaint(Header { seam_v: Seam::Mirror, ..header(3, 3) });
        assert!(message.starts_with("sheet: shift: found 0, expected 2: an open"), "{message}");
        let uv = UvLayout { repeat: [1.0, 1e300], ..UvLayout::default() };
        assert!(complaint(Header { uv, ..header(2, 2) }).contains("a picture that repeats"));
    }

    #[test]
    fn rows_that_do_not_fit_the_header_are_refused() {
        let (positions, normals) = ([DVec3::ZERO; 3], [Vec3::Z; 3]);
        let row = |cols| Row { v: 0.0, positions: &positions[..cols], normals: &normals[..cols] };
        let started = || {
            let options = Options::default();
            Triangulator::new(header(2, 3), &options, TriMesh::default()).unwrap()
        };
        let mut short = started();
        let message = short.row(row(2)).unwrap_err().to_string();
        assert_eq!(message, "sheet: found row 1 with 2 points, expected 2 rows of 3 points");
        let mut long = started();
        long.row(row(3)).unwrap();
        long.row(row(3)).unwrap();
        let message = long.row(row(3)).unwrap_err().to_string();
        assert!(message.contains("found row 3 with 3 points"), "{message}");
        let mut missing = started();
        missing.row(row(3)).unwrap();
        let message = missing.finish().unwrap_err().to_string();
        assert!(message.contains("found row 2 with 0 points"), "{message}");
    }
}
