//! A reader of grids, row by row, which checks everything it reads.

use super::buffer::RowBuffer;
use super::edges::Edges;
use super::{Encoding, Footer, GridError, Header, Patch, binary, header, text};
use crate::grid::GridMesh;
use crate::grid::{self, Row};
use files::memory;

use std::io::{self, BufRead, Read};

/// A grid file being read, with one row in memory at a time.
///
/// The reader is positioned at one patch; [`GridReader::next_patch`] moves to the next.
#[derive(Debug)]
pub struct GridReader<R> {
    /// The file as the user named it.
    name: String,
    /// `name`, with the number of the patch if there are several.
    label: String,
    input: R,
    /// Number of text lines before this patch; binary patches count as none.
    lines: usize,
    header: Header,
    encoding: Encoding,
    crc: crc32fast::Hasher,
    /// Number of rows returned so far.
    given: usize,
    finished: bool,
    edges: Edges,
    bytes: Vec<u8>,
    row: RowBuffer,
}

/// Reads a file of one grid into memory.
///
/// # Errors
/// As [`read_all`], and when the file has several grids.
pub fn read(name: &str, input: impl BufRead) -> Result<GridMesh, GridError> {
    let mut reader = GridReader::open(name, input)?;
    let grid = rest_of(&mut reader)?;
    if reader.next_patch()? {
        return Err(GridError::Several { name: name.into() });
    }
    Ok(grid)
}

/// Reads all grids of a file into memory, at least one.
///
/// # Errors
/// As [`GridReader::open`], [`GridReader::next_row`] and [`GridReader::next_patch`].
pub fn read_all(name: &str, input: impl BufRead) -> Result<Vec<GridMesh>, GridError> {
    GridReader::open(name, input)?.read_rest()
}

/// Reads the rest of the current patch into memory.
fn rest_of(reader: &mut GridReader<impl BufRead>) -> Result<GridMesh, GridError> {
    let (mut v, mut positions, mut normals) = (Vec::new(), Vec::new(), Vec::new());
    // The reserved memory is that of the stated size. Vectors that grow by doubling take up to
    // twice as much.
    let (rows, cols) = (reader.header.rows, reader.header.cols());
    let _reserved = memory::of_process()
        .reserve(grid::bytes(rows, cols).saturating_mul(2), || {
            format!("{}: a grid of {rows} x {cols} points", reader.label)
        })?;
    while let Some(row) = reader.next_row()? {
        v.push(row.v);
        positions.extend_from_slice(row.positions);
        normals.extend_from_slice(row.normals);
    }
    let header = reader.header.clone();
    Ok(GridMesh {
        name: header.name,
        seam_u: header.seam_u,
        seam_v: header.seam_v,
        shift: header.shift,
        texture: header.texture,
        surface: header.surface,
        areas: header.areas.into_iter().map(|placed| placed.area).collect(),
        lids: header.lids,
        pressed: header.pressed,
        fold: header.fold,
        tolerance: header.tolerance,
        unit: header.unit,
        uv: header.uv,
        u: header.u,
        v,
        positions,
        normals,
    })
}

impl<R: BufRead> GridReader<R> {
    /// Reads and checks the first header line; `name` is the name of the file in messages.
    ///
    /// Memory is allocated for data that was read, never for a size that a header only states.
    ///
    /// # Errors
    /// When the input cannot be read, is not a grid, or has a header with a wrong value.
    pub fn open(name: &str, mut input: R) -> Result<Self, GridError> {
        let (header, encoding, bytes) = header::read(name, 0, &mut input)?;
        let mut crc = crc32fast::Hasher::new();
        crc.update(&bytes);
        let mut reader = Self {
            name: name.into(),
            label: name.into(),
            input,
            lines: 0,
            header,
            encoding,
            crc,
            given: 0,
            finished: false,
            edges: Edges::default(),
            bytes: Vec::new(),
            row: RowBuffer::default(),
        };
        reader.follows(None)?;
        Ok(reader)
    }

    /// Moves to the next patch and skips rows not yet read; returns false at the end of the file.
    ///
    /// # Errors
    /// As [`GridReader::next_row`] and [`GridReader::open`]. Also when the file ends although the header
    /// announced another patch, or when other data follows.
    pub fn next_patch(&mut self) -> Result<bool, GridError> {
        while self.next_row()?.is_some() {}
        let due = self.header.patch.next();
        let mut first = Vec::new();
        if let Err(source) = self.input.by_ref().take(1).read_to_end(&mut first) {
            return Err(self.read_error(source));
        }
        if first.is_empty() {
            let missing = |patch| GridError::PatchCut { name: self.name.clone(), patch };
            return due.map_or(Ok(false), |patch| Err(missing(patch)));
        }
        if first != b"{" {
            return Err(GridError::Trailing { name: self.name.clone() });
        }
        self.lines += match self.encoding {
            Encoding::Binary => 0,
            Encoding::Json => self.header.rows + 2,
        };
        let mut input = first.chain(&mut self.input);
        let (header, encoding, bytes) = header::read(&self.name, self.lines, &mut input)?;
        (self.header, self.encoding) = (header, encoding);
        self.crc = crc32fast::Hasher::new();
        self.crc.update(&bytes);
        (self.given, self.finished, self.edges) = (0, false, Edges::default());
        self.follows(due)?;
        Ok(true)
    }

    /// Reads the rest of this patch and all patches after it into memory.
    ///
    /// # Errors
    /// As [`GridReader::next_row`] and [`GridReader::next_patch`].
    pub fn read_rest(&mut self) -> Result<Vec<GridMesh>, GridError> {
        let mut grids = vec![rest_of(self)?];
        while self.next_patch()? {
            grids.push(rest_of(self)?);
        }
        Ok(grids)
    }

    /// Checks that the current patch is the one that is `due`, or the first of an object, and updates the
    /// label.
    fn follows(&mut self, due: Option<Patch>) -> Result<(), GridError> {
        let found = self.header.patch;
        let expected = due.unwrap_or(Patch { number: 1, of: found.of });
        if found != expected {
            return Err(GridError::PatchOrder { name: self.name.clone(), found, expected });
        }
        self.label = match found.of {
            1 => self.name.clone(),
            _ => format!("{}, {found}", self.name),
        };
        Ok(())
    }

    /// Returns the header of this patch.
    #[must_use]
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// Returns the name of the file in messages.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the next row of this patch, or `None` after all rows if the footer agrees with them.
    ///
    /// # Errors
    /// When the file is cut short, damaged, or holds a number that is not valid in a grid. Nothing more can
    /// be read afterwards.
    pub fn next_row(&mut self) -> Result<Option<Row<'_>>, GridError> {
        if self.finished {
            return Ok(None);
        }
        if self.given == self.header.rows {
            self.read_footer()?;
            if let Err(fault) = self.edges.finish(self.header.seam_v, &self.header.areas) {
                self.given = self.given.saturating_sub(1);
                return Err(self.row_error(fault.subject, fault.message));
            }
            self.finished = true;
            return Ok(None);
        }
        let before = (self.given > 0).then_some(self.row.v);
        match self.encoding {
            Encoding::Binary => self.read_binary_row()?,
            Encoding::Json => self.read_text_row()?,
        }
        self.crc.update(&self.bytes);
        if self.row.flags != 0 {
            let message = format!("found {}, expected 0 in version 1", self.row.flags);
            return Err(self.row_error("flags".into(), message));
        }
        let row = Row { v: self.row.v, positions: &self.row.positions, normals: &self.row.normals };
        let areas = &self.header.areas;
        if let Err(fault) =
            row.check(self.header.seam_v, before).and_then(|()| self.edges.row(row.v, areas))
        {
            return Err(self.row_error(fault.subject, fault.message));
        }
        self.given += 1;
        Ok(Some(Row { v: self.row.v, positions: &self.row.positions, normals: &self.row.normals }))
    }

    fn read_binary_row(&mut self) -> Result<(), GridError> {
        self.bytes.resize(binary::row_len(self.header.cols()), 0);
        match self.input.read_exact(&mut self.bytes) {
            Ok(()) => {}
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => {
                return Err(self.row_cut());
            }
            Err(source) => return Err(self.read_error(source)),
        }
        binary::decode(&self.bytes, self.header.cols(), &mut self.row);
        Ok(())
    }

    fn read_text_row(&mut self) -> Result<(), GridError> {
        let (limit, expected) = (text::row_limit(self.header.cols()), "one row of the grid");
        if !self.read_line(limit, expected)? {
            return Err(self.row_cut());
        }
        let (cols, number) = (self.header.cols(), self.given + 1);
        match text::decode(&self.label, self.lines + number + 1, &self.bytes, cols, &mut self.row) {
            Ok(()) => Ok(()),
            Err(mut error) => {
                let rows = self.header.rows;
                error.message = match text::decode_footer(&self.label, 0, &self.bytes) {
                    Ok(_) => format!("row {number} of {rows} is missing, found the closing line"),
                    Err(_) => format!("{} (row {number} of {rows})", error.message),
                };
                Err(error.into())
            }
        }
    }

    /// Reads the footer and checks it against the data read.
    fn read_footer(&mut self) -> Result<(), GridError> {
        let footer = match self.encoding {
            Encoding::Binary => {
                let mut bytes = [0; binary::FOOTER];
                match self.input.read_exact(&mut bytes) {
                    Ok(()) => binary::decode_footer(bytes),
                    Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => {
                        return Err(self.footer_cut());
                    }
                    Err(source) => return Err(self.read_error(source)),
                }
            }
            Encoding::Json => {
                if !self.read_line(text::FOOTER_LIMIT, "the closing row count and checksum")? {
                    return Err(self.footer_cut());
                }
                text::decode_footer(&self.label, self.lines + self.header.rows + 2, &self.bytes)?
            }
        };
        if footer.rows != self.header.rows as u64 {
            return Err(self.count_error(footer));
        }
        let expected = self.crc.clone().finalize();
        if footer.crc32 != expected {
            let (name, found) = (self.label.clone(), footer.crc32);
            return Err(GridError::Checksum { name, found, expected });
        }
        Ok(())
    }

    /// Reads a line into the byte buffer; returns false if the input ends before the newline.
    fn read_line(&mut self, limit: usize, expected: &'static str) -> Result<bool, GridError> {
        self.bytes.clear();
        let mut limited = self.input.by_ref().take(limit as u64);
        if let Err(source) = limited.read_until(b'\n', &mut self.bytes) {
            return Err(self.read_error(source));
        }
        if self.bytes.ends_with(b"\n") {
            return Ok(true);
        }
        if self.bytes.len() == limit {
            let (name, line) = (self.label.clone(), self.lines + self.given + 2);
            return Err(GridError::LongLine { name, line, limit, expected });
        }
        Ok(false)
    }

    fn read_error(&self, source: io::Error) -> GridError {
        GridError::Read { name: self.label.clone(), source }
    }

    fn row_cut(&self) -> GridError {
        let (name, rows) = (self.label.clone(), self.header.rows);
        GridError::RowCut { name, row: self.given + 1, rows }
    }

    fn row_error(&self, subject: String, message: String) -> GridError {
        let (name, rows) = (self.label.clone(), self.header.rows);
        GridError::Row { name, row: self.given + 1, rows, subject, message }
    }

    fn footer_cut(&self) -> GridError {
        GridError::FooterCut { name: self.label.clone(), rows: self.header.rows }
    }

    fn count_error(&self, footer: Footer) -> GridError {
        let (name, expected) = (self.label.clone(), self.header.rows);
        GridError::Count { name, found: footer.rows, expected }
    }
}
