//! Rows and footers of a grid file as JSON text, one line each.

use super::Footer;
use super::buffer::RowBuffer;
use crate::grid::Row;
use files::JsonError;
use files::json::Document;
use glam::{DVec3, Vec3};
use serde::de::DeserializeOwned;
use std::io;

/// Appends a row and a newline to `bytes`.
pub(super) fn encode(row: &Row<'_>, bytes: &mut Vec<u8>) -> io::Result<()> {
    serde_json::to_writer(&mut *bytes, &(row.v, 0_u8, row.positions, row.normals))?;
    bytes.push(b'\n');
    Ok(())
}

pub(super) fn encode_footer(footer: Footer) -> io::Result<Vec<u8>> {
    let mut bytes = serde_json::to_vec(&footer)?;
    bytes.push(b'\n');
    Ok(bytes)
}

/// Length in bytes of the longest footer line.
pub(super) const FOOTER_LIMIT: usize = 200;

/// Returns the length in bytes of the longest row line. An f64 needs up to 24 characters and an f32 up to 15,
/// so a point with its normal takes 129 with brackets and commas. The rest leaves space for blanks.
pub(super) fn row_limit(cols: usize) -> usize {
    1000 + 200 * cols
}

/// Decodes a row from its line, which is line number `line` (from 1) of the file `name`.
pub(super) fn decode(
    name: &str,
    line: usize,
    bytes: &[u8],
    cols: usize,
    row: &mut RowBuffer,
) -> Result<(), JsonError> {
    // Arrays instead of glam vectors, because error messages about those would name Rust types.
    let (v, flags, positions, normals): (_, _, Vec<[f64; 3]>, Vec<[f32; 3]>) =
        parse(name, line, bytes)?;
    (row.v, row.flags) = (v, flags);
    row.positions = positions.into_iter().map(DVec3::from).collect();
    row.normals = normals.into_iter().map(Vec3::from).collect();
    for (path, what, count) in
        [("[2]", "positions", row.positions.len()), ("[3]", "normals", row.normals.len())]
    {
        if count != cols {
            let message = format!("found {count} {what}, expected {cols}, one per column");
            let fault = Document::new(name, bytes)?.fault(path, message);
            return Err(JsonError { line, ..fault });
        }
    }
    Ok(())
}

pub(super) fn decode_footer(name: &str, line: usize, bytes: &[u8]) -> Result<Footer, JsonError> {
    parse(name, line, bytes)
}

fn parse<T: DeserializeOwned>(name: &str, line: usize, bytes: &[u8]) -> Result<T, JsonError> {
    Document::new(name, bytes)
        .and_then(|document| document.parse())
        .map_err(|error| JsonError { line, ..error })
}
