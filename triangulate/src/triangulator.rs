//! Rows in, vertices and triangles out.

use crate::cell::{Cell, Picture, Teller};
use crate::station::Station;
use crate::{Material, Options, Triangle, TriangulateError};
use glam::DVec3;
use std::io;
use sweep::grid::file::Header;
use sweep::grid::{Row, Seam};

/// What the parts of a mesh are told to, one by one.
///
/// Positions, picture coordinates and normals are numbered from 0 in the order they are told,
/// each kind by itself; a triangle only names numbers told before it.
pub trait Sink {
    /// What is told from here on is this patch.
    fn patch(&mut self, header: &Header);
    /// Triangles told from here on are bound to this.
    fn material(&mut self, material: Material);
    /// The next position.
    fn position(&mut self, position: [f32; 3]);
    /// The next picture coordinates.
    fn uv(&mut self, uv: [f32; 2]);
    /// The next normal.
    fn normal(&mut self, normal: [f32; 3]);
    /// The next triangle.
    fn triangle(&mut self, triangle: &Triangle);
    /// A row and its triangles are complete: the time to pass them on.
    ///
    /// # Errors
    /// When they cannot be passed on.
    fn row_done(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Two sinks that are told the same.
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

/// How much a mesh has of everything.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Counts {
    /// Different positions.
    pub positions: u32,
    /// Different picture coordinates.
    pub uvs: u32,
    /// Different normals.
    pub normals: u32,
    /// Triangles.
    pub triangles: u64,
    /// Cells that became two triangles.
    pub quads: u64,
    /// Triangles left out because two corners are one point, as at poles and creases.
    pub collapsed: u64,
    /// Triangles left out because their three corners lie on a line. The mesh has a slit there,
    /// of no width.
    pub slivers: u64,
    /// How far rounding to f32 moved a coordinate, at most, as a fraction of the object's size (the
    /// diagonal of its box): some 1e-8 for an object about the origin, and more by as much as
    /// it lies farther away than it is large. Infinite for an object that is one point.
    pub moved: f64,
    /// How far it moved a point, at most, in the grid's unit.
    pub displacement: f64,
    /// How far it moved a point, as a part of the distance from the surface that was asked of the grid:
    /// above 1 it took away what was kept. 0 where none was asked.
    pub tolerance_used: f64,
}

/// What rounding does to an object.
#[derive(Debug)]
struct Rounding {
    low: DVec3,
    high: DVec3,
    /// The farthest that a coordinate was moved.
    moved: f64,
    /// The square of the farthest that a point was moved.
    displacement_sq: f64,
}

impl Rounding {
    fn none() -> Self {
        Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY, moved: 0.0, displacement_sq: 0.0 }
    }

    fn add(&mut self, points: &[DVec3], rounded: &[[f32; 3]]) {
        for (&point, &rounded) in points.iter().zip(rounded) {
            self.low = self.low.min(point);
            self.high = self.high.max(point);
            let off = point - DVec3::from(rounded.map(f64::from));
            self.moved = self.moved.max(off.abs().max_element());
            self.displacement_sq = self.displacement_sq.max(off.length_squared());
        }
    }

    /// As a fraction of the object's size.
    fn fraction(&self) -> f64 {
        if self.moved == 0.0 { 0.0 } else { self.moved / (self.high - self.low).length() }
    }
}

/// The numbers there are for vertices of each kind.
const NUMBERS: u64 = u32::MAX as u64;
/// The most numbers that a point takes. A pole gives a cell at most one more normal and one more
/// pair of picture coordinates than it has points.
const NUMBERS_OF_POINT: u64 = 2;
/// The same where a cell may share no picture coordinates with its neighbours.
const NUMBERS_IN_AREAS: u64 = 4;
/// The most repeats of a picture; far below the end of f32.
const MAX_REPEAT: f64 = 1e30;

/// Makes triangles of rows as they come.
///
/// It holds the row at hand, the one before, and the first one if the last leads back to it.
#[derive(Debug)]
pub struct Triangulator<S> {
    header: Header,
    teller: Teller<S>,
    /// The first row as the last one leads on to it, if it does.
    first: Option<Station>,
    before: Option<Station>,
    /// A station no longer needed, whose memory is used again.
    spare: Station,
    rounding: Rounding,
    /// Rows taken so far.
    rows: usize,
}

impl<S: Sink> Triangulator<S> {
    /// A triangulator of rows that fit `header`, of an object's first patch.
    ///
    /// # Errors
    /// As [`Triangulator::following`].
    pub fn new(header: Header, options: &Options, sink: S) -> Result<Self, TriangulateError> {
        Self::following(Counts::default(), header, options, sink)
    }

    /// The same for a patch that follows others, which have made so many `counts` of everything:
    /// its vertices are numbered on.
    ///
    /// # Errors
    /// When the grid has fewer points than a surface, or more than can be numbered.
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
        // Counted with the row and the column that seams add to the picture.
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
            teller: Teller::new(sink, counts, picture, material),
            first: None,
            before: None,
            spare: Station::default(),
            rounding: Rounding::none(),
            rows: 0,
        })
    }

    /// Takes the next row, and tells its vertices and the triangles between it and the one before.
    ///
    /// # Errors
    /// When the row has another number of points than the header says, is one too many, holds a
    /// number that f32 does not, or the sink fails.
    pub fn row(&mut self, row: Row<'_>) -> Result<(), TriangulateError> {
        let counts = [row.positions.len(), row.normals.len()];
        if self.rows == self.header.rows || counts != [self.header.cols(); 2] {
            return Err(self.misfit(counts[0].min(counts[1])));
        }
        self.rows += 1;
        let mut station = std::mem::take(&mut self.spare);
        station.take(&row, &self.header.name, self.rows, self.teller.picture.cols())?;
        self.rounding.add(row.positions, &station.points);
        self.number_positions(&mut station);
        if let Some(mut before) = self.before.take() {
            self.band(&mut before, &mut station);
            if self.rows == 2 && self.header.seam_v.joins() {
                self.first = Some(before.over_seam(&self.header));
            } else {
                self.spare = before;
            }
        }
        self.before = Some(station);
        self.teller.sink.row_done().map_err(TriangulateError::Write)
    }

    /// Closes the seam, if there is one, and gives the sink back.
    ///
    /// # Errors
    /// When rows are missing, or the sink fails.
    pub fn finish(mut self) -> Result<(S, Counts), TriangulateError> {
        if self.rows < self.header.rows {
            return Err(self.misfit(0));
        }
        if let (Some(mut first), Some(mut last)) = (self.first.take(), self.before.take()) {
            self.band(&mut last, &mut first);
            self.teller.sink.row_done().map_err(TriangulateError::Write)?;
        }
        let before = self.teller.counts;
        let displacement = self.rounding.displacement_sq.sqrt();
        let asked = self.header.tolerance.and_then(|tolerance| tolerance.asked);
        let used = asked.map_or(0.0, |asked| displacement / asked);
        let counts = Counts {
            moved: before.moved.max(self.rounding.fraction()),
            displacement: before.displacement.max(displacement),
            tolerance_used: before.tolerance_used.max(used),
            ..before
        };
        Ok((self.teller.sink, counts))
    }

    /// Numbers the points of a row. A point that equals its neighbour to the left, below, or over a
    /// seam is that vertex; any other is a new one.
    fn number_positions(&mut self, station: &mut Station) {
        let cols = station.points.len();
        let over_seam = self.first.as_ref().filter(|_| self.rows == self.header.rows);
        let closed = self.header.seam_u == Seam::Closed;
        for col in 0..cols {
            let point = station.points[col];
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
                .or_else(|| (closed && col > 0 && col + 1 == cols).then(|| in_row(0)).flatten());
            let number = known.unwrap_or_else(|| self.teller.position(point));
            station.position.push(number);
        }
    }

    /// The error for a next row of `cols` points that does not fit the header.
    fn misfit(&self, cols: usize) -> TriangulateError {
        TriangulateError::Rows {
            object: self.header.name.clone(),
            row: self.rows + 1,
            cols,
            rows: self.header.rows,
            expected: self.header.cols(),
        }
    }

    /// Tells the triangles between two rows.
    fn band(&mut self, lower: &mut Station, upper: &mut Station) {
        let cols = self.header.cols();
        self.teller.picture.areas.next_band([lower.v, upper.v]);
        for left in 0..self.teller.picture.cols() - 1 {
            let right = if left + 1 == cols { 0 } else { left + 1 };
            let mut cell = Cell { lower, upper, left, right };
            self.teller.cell(&mut cell);
        }
        self.teller.band_done();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TriMesh;
    use glam::Vec3;
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
