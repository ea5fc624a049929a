//! Reads STL files: triangles for printers, as text or as bytes.
//!
//! ```text
//! solid NAME                          80 bytes     any text
//! facet normal 0 0 1                  u32          the number of facets
//!   outer loop                        and for each facet, 50 bytes:
//!     vertex 0 0 0                      3 x f32    its normal
//!     vertex 1 0 0                      9 x f32    its corners
//!     vertex 0 1 0                      u16        0, or a colour
//!   endloop
//! endfacet
//! endsolid NAME
//! ```
//!
//! A file is binary if its length is the one that its count of facets asks for, since many binary files
//! begin with `solid` too. Equal corners become one vertex. Normals are those of the triangles' planes:
//! the file's own are often zero, and never differ on purpose. Several solids become one mesh.

use super::Placed;
use super::error::MeshFileError;
use crate::scene::obj::{ObjFile, shortened};
use crate::scene::text;
use crate::shape::Mesh;
use crate::shape::mesh::{NONE, Triangle};
use files::MemoryError;
use glam::DVec3;
use std::collections::{BTreeMap, HashMap};

/// Bytes before the first facet of a binary file: the header and the count.
const START: usize = 84;

/// Bytes of a facet of a binary file.
const FACET: usize = 50;

/// Upper bound of the bytes for a facet while it is read: a triangle and three corners, each in a list
/// and in a table of known corners. Lists and tables grow by doubling.
const NEEDED: u64 = 2 * (size_of::<Triangle>() as u64 + 3 * (12 + 24 + 29));

/// Returns whether the length of a file is that of a binary STL.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    count(bytes)
        .is_some_and(|count| count > 0 && bytes.len() as u64 == START as u64 + FACET as u64 * count)
}

/// Returns whether a file begins as an STL of text does, and goes on so. Some binary files begin with
/// `solid` too, and are cut off.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    let Some((word, rest)) = start.split_at_checked(5) else { return false };
    let has = |what: &[u8]| {
        let part = &rest[..rest.len().min(1024)];
        part.windows(what.len()).any(|window| window.eq_ignore_ascii_case(what))
    };
    word.eq_ignore_ascii_case(b"solid")
        && rest.first().is_none_or(u8::is_ascii_whitespace)
        && (has(b"facet") || has(b"endsolid"))
        && !rest[..rest.len().min(1024)].contains(&0)
}

/// Returns the count of facets of a binary file.
fn count(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(START - 4..START)?.first_chunk()?;
    Some(u32::from_le_bytes(*count).into())
}

/// Reads the bytes of an STL file. Asks for memory first.
pub(super) fn read(
    file: &str,
    bytes: &[u8],
    reserve: &mut dyn FnMut(u64) -> Result<(), MemoryError>,
) -> Result<Placed, MeshFileError> {
    let mut facets = Facets::default();
    let mut unused = BTreeMap::new();
    let mut remarks = Vec::new();
    if !is_binary(bytes) && is_text(bytes) {
        // Each facet has the word `vertex` three times, in three lines of at least 12 characters.
        reserve(NEEDED * (bytes.len() as u64 / 36))?;
        if !read_text(file, bytes, &mut facets, &mut unused)? {
            remarks.push("`endsolid` is missing; the file may be cut off".into());
        }
    } else {
        read_binary(file, bytes, reserve, &mut facets, &mut unused)?;
    }
    let mesh = Mesh { surfaces: vec![String::new()], ..facets.mesh };
    let unused = unused.into_iter().collect();
    let read = ObjFile { file: file.into(), mesh, unused, remarks, ..ObjFile::default() };
    Ok((read, facets.positions))
}

/// The triangles so far.
#[derive(Debug, Default)]
struct Facets {
    mesh: Mesh,
    positions: Vec<DVec3>,
    known: HashMap<[u64; 3], u32>,
}

impl Facets {
    fn push(&mut self, corners: [[f64; 3]; 3]) {
        let position = corners.map(|corner| {
            // Adding zero makes -0 into +0.
            let bits = corner.map(|x| (x + 0.0).to_bits());
            *self.known.entry(bits).or_insert_with(|| {
                self.positions.push(corner.into());
                self.positions.len() as u32 - 1
            })
        });
        let none = [NONE; 3];
        self.mesh.triangles.push(Triangle { position, uv: none, normal: none, surface: 0 });
    }
}

type Unused = BTreeMap<String, usize>;

fn read_binary(
    file: &str,
    bytes: &[u8],
    reserve: &mut dyn FnMut(u64) -> Result<(), MemoryError>,
    facets: &mut Facets,
    unused: &mut Unused,
) -> Result<(), MeshFileError> {
    let fault = |offset, found: String, expected: String| MeshFileError::Byte {
        file: file.into(),
        offset,
        found,
        expected,
    };
    let count = count(bytes).ok_or_else(|| {
        let expected = "an STL: `solid` and facets as text, or 84 bytes and binary facets".into();
        fault(bytes.len(), "the end of the file".into(), expected)
    })?;
    let end = START as u64 + FACET as u64 * count;
    if (bytes.len() as u64) < end {
        let expected = format!("{end} bytes for the {count} facets that the file counts");
        return Err(fault(bytes.len(), "the end of the file".into(), expected));
    }
    reserve(NEEDED * count)?;
    let (all, _) = bytes[START..end as usize].as_chunks::<FACET>();
    let mut colored = 0;
    for (number, facet) in all.iter().enumerate() {
        let mut numbers =
            facet.as_chunks::<4>().0.iter().map(|four| f32::from_le_bytes(*four)).skip(3);
        let mut corner = || [(); 3].map(|()| numbers.next().unwrap_or_default());
        let corners = [corner(), corner(), corner()];
        if let Some(k) = corners.as_flattened().iter().position(|x| !x.is_finite()) {
            let found = corners.as_flattened()[k].to_string();
            return Err(fault(START + FACET * number + 12 + 4 * k, found, FINITE.into()));
        }
        facets.push(corners.map(|corner| corner.map(f64::from)));
        colored += usize::from(facet[48..] != [0; 2]);
    }
    let rest = bytes.len() - end as usize;
    for (what, count) in [("colours of facets", colored), ("bytes behind the last facet", rest)] {
        if count > 0 {
            unused.insert(what.into(), count);
        }
    }
    Ok(())
}

const FINITE: &str = "three finite numbers for each corner";

/// Reads the facets of a text. Returns whether the text is ended.
fn read_text(
    file: &str,
    bytes: &[u8],
    facets: &mut Facets,
    unused: &mut Unused,
) -> Result<bool, MeshFileError> {
    let fault = |number: usize, found: String, expected: &str| MeshFileError::Line {
        file: file.into(),
        line: number + 1,
        found,
        expected: expected.into(),
    };
    let quoted = |line: &str| format!("`{}`", shortened(line.trim()));
    let text = text::of(bytes).map_err(|text::NotText(line)| {
        fault(line - 1, "a byte 0".into(), "the text of an STL mesh")
    })?;
    let mut corners: Vec<[f64; 3]> = Vec::new();
    let mut is_ended = false;
    let mut last = 0;
    for (number, line) in text.lines().enumerate() {
        last = number;
        let mut words = line.split_ascii_whitespace();
        while let Some(word) = words.next() {
            match word.to_ascii_lowercase().as_str() {
                // A name follows.
                "solid" => break,
                "endsolid" => {
                    is_ended = true;
                    break;
                }
                "vertex" => {
                    let mut next = || words.next().and_then(|word| word.parse().ok());
                    let corner = (next(), next(), next());
                    match corner {
                        (Some(x), Some(y), Some(z))
                            if [x, y, z].iter().all(|x: &f64| x.is_finite()) =>
                        {
                            corners.push([x, y, z]);
                        }
                        _ => {
                            return Err(fault(
                                number,
                                quoted(line),
                                "`vertex` and three finite numbers",
                            ));
                        }
                    }
                }
                "endloop" => {
                    let Ok(three) = corners[..].try_into() else {
                        let found = format!("`endloop` after {} vertices", corners.len());
                        return Err(fault(number, found, "a facet of three"));
                    };
                    facets.push(three);
                    corners.clear();
                }
                // The words of a facet's frame, and its normal.
                "facet" | "normal" | "outer" | "loop" | "endfacet" => {}
                other if other.parse::<f32>().is_ok() => {}
                other => {
                    *unused.entry(shortened(other)).or_default() += 1;
                    break;
                }
            }
        }
    }
    if !corners.is_empty() {
        return Err(fault(last, "the end of the file".into(), "`endloop` after the last vertices"));
    }
    Ok(is_ended)
}
