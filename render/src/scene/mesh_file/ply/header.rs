//! The header of a PLY file: the elements that follow, and the numbers of each.

use std::ops::Range;

/// A type of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Kind {
    fn of(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes of a number.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// The number that stands for a full channel of a colour.
    pub(super) fn white(self) -> f64 {
        match self {
            Self::I8 | Self::U8 => 255.0,
            Self::I16 | Self::U16 => 65535.0,
            Self::I32 | Self::U32 => 4_294_967_295.0,
            Self::F32 | Self::F64 => 1.0,
        }
    }
}

/// A property of an element.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Property {
    pub(super) name: String,
    /// The type of the count, if the property is a list.
    pub(super) list: Option<Kind>,
    /// The type of the number, or of the list's numbers.
    pub(super) kind: Kind,
}

/// A kind of element.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

/// The numbers behind a header.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// The header of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    pub(super) comments: Vec<String>,
    /// Offset of the first byte behind the header.
    pub(super) end: usize,
    /// Number of the header's lines.
    pub(super) lines: usize,
    /// Number of lines that are no statement.
    pub(super) strange: usize,
}

/// A fault of a header: the number of its line from 0, the line, and the expected text.
pub(super) type Fault = (usize, String, &'static str);

/// Most elements and properties of a header. Files have a handful of each.
const MOST: usize = 1000;

impl Header {
    /// Reads the header at the start of a file.
    pub(super) fn read(bytes: &[u8]) -> Result<Self, Fault> {
        let mut header = Self {
            encoding: Encoding::Text,
            elements: Vec::new(),
            comments: Vec::new(),
            end: 0,
            lines: 0,
            strange: 0,
        };
        let mut has_format = false;
        loop {
            let number = header.lines;
            let Some(line) = line_at(bytes, header.end) else {
                return Err((number, "the end of the file".into(), "`end_header`"));
            };
            header.end = line.end;
            header.lines += 1;
            let text = String::from_utf8_lossy(&bytes[line.text]);
            let words: Vec<&str> = text.split_ascii_whitespace().collect();
            let quoted = || format!("`{}`", crate::scene::obj::shortened(text.trim()));
            let fault = |expected| Err((number, quoted(), expected));
            match words[..] {
                ["ply"] if number == 0 => {}
                ["format", format, _] => {
                    header.encoding = match format {
                        "ascii" => Encoding::Text,
                        "binary_little_endian" => Encoding::LittleEndian,
                        "binary_big_endian" => Encoding::BigEndian,
                        _ => {
                            return fault(
                                "`format ascii 1.0`, `binary_little_endian` or `binary_big_endian`",
                            );
                        }
                    };
                    has_format = true;
                }
                ["element", name, count] => {
                    let Ok(count) = count.parse() else {
                        return fault("`element`, a name and a count");
                    };
                    let properties = Vec::new();
                    header.elements.push(Element { name: name.into(), count, properties });
                }
                ["property", ref words @ ..] => match (property(words), header.elements.last_mut())
                {
                    (Some(property), Some(element)) => element.properties.push(property),
                    (None, _) => return fault("`property`, a type of numbers and a name"),
                    (_, None) => return fault("an `element` before its properties"),
                },
                ["end_header"] if has_format => {
                    let is_empty = |e: &Element| e.properties.is_empty() && e.count > 0;
                    if header.elements.iter().any(is_empty) {
                        return fault("properties of each element before it");
                    }
                    return Ok(header);
                }
                ["end_header"] => return fault("`format` before it"),
                ["comment" | "obj_info", ..] => {
                    header.comments.push(words[1..].join(" "));
                }
                [] => {}
                // Some programs break a comment into lines. A file of another format is refused.
                _ if number > 0 && header.strange < MOST && text.is_ascii() => header.strange += 1,
                _ => {
                    return fault("`format`, `element`, `property`, `comment` or `end_header`");
                }
            }
            let properties = header.elements.last().map_or(0, |element| element.properties.len());
            if header.elements.len() > MOST || properties > MOST {
                return fault("at most 1000 elements and properties");
            }
        }
    }
}

fn property(words: &[&str]) -> Option<Property> {
    Some(match *words {
        ["list", count, kind, name] => {
            Property { name: name.into(), list: Some(Kind::of(count)?), kind: Kind::of(kind)? }
        }
        [kind, name] => Property { name: name.into(), list: None, kind: Kind::of(kind)? },
        _ => return None,
    })
}

/// A line of the header.
struct Line {
    /// Bytes without the end of the line.
    text: Range<usize>,
    /// Offset of the next line.
    end: usize,
}

/// Returns the line at an offset. It ends in LF, CR LF or CR. In binary numbers behind a line that ends in
/// CR, a first byte of 10 cannot be told from an LF, so CR alone counts only if the first line ends so.
fn line_at(bytes: &[u8], start: usize) -> Option<Line> {
    let length = bytes[start..].iter().position(|byte| matches!(byte, b'\n' | b'\r'))?;
    let end = start + length;
    let is_lone = |at: usize| bytes[at] == b'\r' && bytes.get(at + 1) != Some(&b'\n');
    let first = bytes.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(end);
    let is_pair = bytes[end] == b'\r' && bytes.get(end + 1) == Some(&b'\n') && !is_lone(first);
    Some(Line { text: start..end, end: end + 1 + usize::from(is_pair) })
}
