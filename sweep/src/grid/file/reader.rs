//! Reading a grid row by row, trusting nothing.

use super::{Encoding, Footer, GridError, Header, binary, header, text};
use crate::GridMesh;
use crate::grid::Row;
use glam::{DVec3, Vec3};
use std::io::{self, BufRead, Read};

/// A grid file being read, one row in memory at a time.
#[derive(Debug)]
pub struct GridReader<R> {
    name: String,
    input: R,
    header: Header,
    encoding: Encoding,
    crc: crc32fast::Hasher,
    /// Rows given so far.
    given: usize,
    finished: bool,
    bytes: Vec<u8>,
    row: RowBuffer,
}

/// The numbers of the row last read.
#[derive(Debug, Default)]
pub(super) struct RowBuffer {
    pub v: f64,
    pub flags: u8,
    pub positions: Vec<DVec3>,
    pub normals: Vec<Vec3>,
}

/// Reads a whole grid into memory.
///
/// # Errors
/// As [`GridReader::open`] and [`GridReader::next_row`].
pub fn read(name: &str, input: impl BufRead) -> Result<GridMesh, GridError> {
    let mut reader = GridReader::open(name, input)?;
    let (mut v, mut positions, mut normals) = (Vec::new(), Vec::new(), Vec::new());
    while let Some(row) = reader.next_row()? {
        v.push(row.v);
        positions.extend_from_slice(row.positions);
        normals.extend_from_slice(row.normals);
    }
    let Header { name, rows: _, seam_u, seam_v, shift, uv, u } = reader.header;
    Ok(GridMesh { name, seam_u, seam_v, shift, uv, u, v, positions, normals })
}

impl<R: BufRead> GridReader<R> {
    /// Reads and checks the header line; `name` is how messages call the file.
    ///
    /// Memory is taken for what was read, never for what a header only promises.
    ///
    /// # Errors
    /// When the input cannot be read, is not a grid, or has a header with a wrong value in it.
    pub fn open(name: &str, mut input: R) -> Result<Self, GridError> {
        let (header, encoding, bytes) = header::read(name, &mut input)?;
        let mut crc = crc32fast::Hasher::new();
        crc.update(&bytes);
        Ok(Self {
            name: name.into(),
            input,
            header,
            encoding,
            crc,
            given: 0,
            finished: false,
            bytes: Vec::new(),
            row: RowBuffer::default(),
        })
    }

    /// What the header line says.
    #[must_use]
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// How messages call the file.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The next row, or `None` when all rows were given and the footer behind them agrees.
    ///
    /// # Errors
    /// When the file is cut short, damaged, or holds a number that no grid holds. Nothing more can
    /// be read then.
    pub fn next_row(&mut self) -> Result<Option<Row<'_>>, GridError> {
        if self.finished {
            return Ok(None);
        }
        if self.given == self.header.rows {
            self.read_footer()?;
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
        if let Err(fault) = row.check(self.header.seam_v, before) {
            return Err(self.row_error(fault.place, fault.message));
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
        match text::decode(&self.name, number + 1, &self.bytes, cols, &mut self.row) {
            Ok(()) => Ok(()),
            Err(mut error) => {
                let rows = self.header.rows;
                error.message = match text::decode_footer(&self.name, 0, &self.bytes) {
                    Ok(_) => format!("row {number} of {rows} is missing, found the closing line"),
                    Err(_) => format!("{} (row {number} of {rows})", error.message),
                };
                Err(error.into())
            }
        }
    }

    /// Reads the footer, holds it against what was read, and sees that nothing follows.
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
                text::decode_footer(&self.name, self.header.rows + 2, &self.bytes)?
            }
        };
        if footer.rows != self.header.rows as u64 {
            return Err(self.count_error(footer));
        }
        let expected = self.crc.clone().finalize();
        if footer.crc32 != expected {
            let (name, found) = (self.name.clone(), footer.crc32);
            return Err(GridError::Checksum { name, found, expected });
        }
        self.bytes.clear();
        match self.input.by_ref().take(1).read_to_end(&mut self.bytes) {
            Ok(0) => Ok(()),
            Ok(_) => Err(GridError::Trailing { name: self.name.clone() }),
            Err(source) => Err(self.read_error(source)),
        }
    }

    /// Reads a line into the byte buffer; false when the input ends before its newline.
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
            let (name, line) = (self.name.clone(), self.given + 2);
            return Err(GridError::LongLine { name, line, limit, expected });
        }
        Ok(false)
    }

    fn read_error(&self, source: io::Error) -> GridError {
        GridError::Read { name: self.name.clone(), source }
    }

    fn row_cut(&self) -> GridError {
        let (name, rows) = (self.name.clone(), self.header.rows);
        GridError::RowCut { name, row: self.given + 1, rows }
    }

    fn row_error(&self, place: String, message: String) -> GridError {
        let (name, rows) = (self.name.clone(), self.header.rows);
        GridError::Row { name, row: self.given + 1, rows, place, message }
    }

    fn footer_cut(&self) -> GridError {
        GridError::FooterCut { name: self.name.clone(), rows: self.header.rows }
    }

    fn count_error(&self, footer: Footer) -> GridError {
        let (name, expected) = (self.name.clone(), self.header.rows);
        GridError::Count { name, found: footer.rows, expected }
    }
}
