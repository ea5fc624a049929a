//! The numbers behind the header of a PLY file, as text or as bytes.

use super::header::{Encoding, Header, Kind};

/// Reads one number after the other.
#[derive(Debug)]
pub(super) struct Body<'a> {
    bytes: &'a [u8],
    /// Offset of the next number.
    at: usize,
    encoding: Encoding,
    /// Offset and number of the first line, from 0.
    first: (usize, usize),
}

/// The position of a number: its line from 1, or the offset of its first byte.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Position {
    Line(usize),
    Byte(usize),
}

/// A number that is missing or is none.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Fault {
    pub(super) position: Position,
    pub(super) found: String,
}

impl<'a> Body<'a> {
    pub(super) fn new(bytes: &'a [u8], header: &Header) -> Self {
        let at = header.end;
        Self { bytes, at, encoding: header.encoding, first: (at, header.lines) }
    }

    /// Reads the next number.
    pub(super) fn number(&mut self, kind: Kind) -> Result<f64, Fault> {
        if self.encoding == Encoding::Text {
            return self.word();
        }
        let size = kind.size();
        let Some(found) = self.bytes.get(self.at..self.at + size) else {
            return Err(self.fault(self.bytes.len(), "the end of the file".into()));
        };
        let mut number = [0; 8];
        number[..size].copy_from_slice(found);
        if self.encoding == Encoding::BigEndian {
            number[..size].reverse();
        }
        self.at += size;
        let [a, b, c, d, ..] = number;
        Ok(match kind {
            Kind::I8 => f64::from(a as i8),
            Kind::U8 => f64::from(a),
            Kind::I16 => f64::from(i16::from_le_bytes([a, b])),
            Kind::U16 => f64::from(u16::from_le_bytes([a, b])),
            Kind::I32 => f64::from(i32::from_le_bytes([a, b, c, d])),
            Kind::U32 => f64::from(u32::from_le_bytes([a, b, c, d])),
            Kind::F32 => f64::from(f32::from_le_bytes([a, b, c, d])),
            Kind::F64 => f64::from_le_bytes(number),
        })
    }

    /// Passes over the rest of a line of text, behind the numbers of an element. Returns whether there
    /// were more words.
    pub(super) fn end_line(&mut self) -> bool {
        if self.encoding != Encoding::Text {
            return false;
        }
        let rest = &self.bytes[self.at..];
        let length =
            rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(rest.len());
        self.at += length;
        !rest[..length].trim_ascii().is_empty()
    }

    fn word(&mut self) -> Result<f64, Fault> {
        let rest = &self.bytes[self.at..];
        let blank = rest.iter().position(|byte| !byte.is_ascii_whitespace()).unwrap_or(rest.len());
        let rest = &rest[blank..];
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        let start = self.at + blank;
        self.at = start + length;
        let word = std::str::from_utf8(&rest[..length]).unwrap_or_default();
        word.parse().map_err(|_| {
            let found = match length {
                0 => "the end of the file".into(),
                _ => format!(
                    "`{}`",
                    crate::scene::obj::shortened(&String::from_utf8_lossy(&rest[..length]))
                ),
            };
            self.fault(start, found)
        })
    }

    /// Returns the fault of a number that ends before the next one.
    pub(super) fn before(&self, found: String) -> Fault {
        self.fault(self.at.saturating_sub(1), found)
    }

    fn fault(&self, offset: usize, found: String) -> Fault {
        let position = if self.encoding == Encoding::Text {
            let (start, lines) = self.first;
            let text = &self.bytes[start..offset.max(start)];
            let ends = |end: u8| text.iter().filter(|&&byte| byte == end).count();
            // A text may have lines that end in CR alone.
            Position::Line(1 + lines + ends(b'\n').max(ends(b'\r')))
        } else {
            Position::Byte(offset)
        };
        Fault { position, found }
    }

    /// Returns the bytes that are left.
    pub(super) fn left(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }
}
