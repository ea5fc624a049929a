//! A writer of one grid of a file, row by row.

use super::header::Header;
use super::{Encoding, Footer, binary, refused, text};
use crate::grid::Row;
use std::io::{self, Write};

/// Writes a grid with one row in memory at a time.
#[derive(Debug)]
pub struct Writer<'a, W> {
    out: &'a mut W,
    header: Header,
    encoding: Encoding,
    /// CRC-32 of everything written so far.
    crc: crc32fast::Hasher,
    rows: usize,
    /// `v` of the row before, if any.
    before: Option<f64>,
    bytes: Vec<u8>,
}

impl<'a, W: Write> Writer<'a, W> {
    /// Writes the header line. `out` gets one write for each row and need not be buffered.
    ///
    /// # Errors
    /// When writing to `out` fails. A header that no reader accepts is [`io::ErrorKind::InvalidInput`].
    pub fn new(header: &Header, encoding: Encoding, out: &'a mut W) -> io::Result<Self> {
        header.check().map_err(|fault| refused(&fault.to_string()))?;
        let bytes = header.line(encoding)?;
        let (header, crc) = (header.clone(), crc32fast::Hasher::new());
        let mut writer = Self { out, header, encoding, crc, rows: 0, before: None, bytes };
        writer.pass_on()?;
        Ok(writer)
    }

    /// Writes the next row.
    ///
    /// # Errors
    /// When writing to `out` fails. A row that no reader accepts (of another length, with a number that is
    /// not finite, with `v` out of order, or one too many) is [`io::ErrorKind::InvalidInput`].
    pub fn row(&mut self, row: &Row<'_>) -> io::Result<()> {
        let cols = self.header.cols();
        if self.rows == self.header.rows || [row.positions.len(), row.normals.len()] != [cols; 2] {
            let (number, found) = (self.rows + 1, row.positions.len().min(row.normals.len()));
            let expected = self.header.rows;
            return Err(refused(&format!(
                "found row {number} of {found} points, expected {expected} rows of {cols}"
            )));
        }
        row.check(self.header.seam_v, self.before).map_err(|fault| refused(&fault.to_string()))?;
        self.before = Some(row.v);
        self.rows += 1;
        self.bytes.clear();
        match self.encoding {
            Encoding::Binary => binary::encode(row, &mut self.bytes),
            Encoding::Json => text::encode(row, &mut self.bytes)?,
        }
        self.pass_on()
    }

    /// Writes the footer.
    ///
    /// # Errors
    /// When writing to `out` fails. Missing rows are [`io::ErrorKind::InvalidInput`].
    pub fn finish(self) -> io::Result<()> {
        if self.rows < self.header.rows {
            let (found, expected) = (self.rows, self.header.rows);
            return Err(refused(&format!("found {found} rows, expected {expected}")));
        }
        let footer = Footer { rows: self.rows as u64, crc32: self.crc.finalize() };
        match self.encoding {
            Encoding::Binary => self.out.write_all(&binary::encode_footer(footer)),
            Encoding::Json => self.out.write_all(&text::encode_footer(footer)?),
        }
    }

    fn pass_on(&mut self) -> io::Result<()> {
        self.crc.update(&self.bytes);
        self.out.write_all(&self.bytes)
    }
}
