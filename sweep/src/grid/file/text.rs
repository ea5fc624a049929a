//! Rows and footer as JSON text, one line each.

use super::Footer;
use crate::grid::Row;
use std::io;

/// Appends a row and its newline to `bytes`.
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
