//! Binary rows and footer.

use super::Footer;
use crate::grid::Row;

/// Bytes before the positions: `v` and the flags.
const HEAD: usize = 9;
const POSITION: usize = 24;
const NORMAL: usize = 12;
/// Bytes of the footer.
pub(super) const FOOTER: usize = 12;

/// Bytes of a row.
pub(super) fn row_len(cols: usize) -> usize {
    HEAD + cols * (POSITION + NORMAL)
}

/// Appends a row to `bytes`.
pub(super) fn encode(row: &Row<'_>, bytes: &mut Vec<u8>) {
    let start = bytes.len();
    bytes.resize(start + row_len(row.positions.len()), 0);
    let (head, points) = bytes[start..].split_at_mut(HEAD);
    head[..8].copy_from_slice(&row.v.to_le_bytes());
    let (positions, normals) = points.split_at_mut(row.positions.len() * POSITION);
    for (place, p) in positions.chunks_exact_mut(POSITION).zip(row.positions) {
        place[..8].copy_from_slice(&p.x.to_le_bytes());
        place[8..16].copy_from_slice(&p.y.to_le_bytes());
        place[16..].copy_from_slice(&p.z.to_le_bytes());
    }
    for (place, n) in normals.chunks_exact_mut(NORMAL).zip(row.normals) {
        place[..4].copy_from_slice(&n.x.to_le_bytes());
        place[4..8].copy_from_slice(&n.y.to_le_bytes());
        place[8..].copy_from_slice(&n.z.to_le_bytes());
    }
}

pub(super) fn encode_footer(footer: Footer) -> [u8; FOOTER] {
    let mut bytes = [0; FOOTER];
    bytes[..8].copy_from_slice(&footer.rows.to_le_bytes());
    bytes[8..].copy_from_slice(&footer.crc32.to_le_bytes());
    bytes
}
