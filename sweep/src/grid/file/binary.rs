//! Binary rows and footers of a grid file.

use super::Footer;
use super::buffer::RowBuffer;
use crate::grid::Row;
use glam::{DVec3, Vec3};

/// Number of bytes before the positions: `v` and the flags.
const HEAD: usize = 9;
const POSITION: usize = 24;
const NORMAL: usize = 12;
/// Number of bytes of the footer.
pub(super) const FOOTER: usize = 12;

/// Returns the number of bytes of a row.
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
    for (slot, p) in positions.chunks_exact_mut(POSITION).zip(row.positions) {
        slot[..8].copy_from_slice(&p.x.to_le_bytes());
        slot[8..16].copy_from_slice(&p.y.to_le_bytes());
        slot[16..].copy_from_slice(&p.z.to_le_bytes());
    }
    for (slot, n) in normals.chunks_exact_mut(NORMAL).zip(row.normals) {
        slot[..4].copy_from_slice(&n.x.to_le_bytes());
        slot[4..8].copy_from_slice(&n.y.to_le_bytes());
        slot[8..].copy_from_slice(&n.z.to_le_bytes());
    }
}

pub(super) fn encode_footer(footer: Footer) -> [u8; FOOTER] {
    let mut bytes = [0; FOOTER];
    bytes[..8].copy_from_slice(&footer.rows.to_le_bytes());
    bytes[8..].copy_from_slice(&footer.crc32.to_le_bytes());
    bytes
}

/// Decodes a row from its [`row_len`] bytes.
pub(super) fn decode(bytes: &[u8], cols: usize, row: &mut RowBuffer) {
    let (head, points) = bytes.split_at(HEAD);
    row.v = f64_at(head, 0);
    row.flags = head[8];
    let (positions, normals) = points.split_at(cols * POSITION);
    row.positions.clear();
    row.positions.extend(
        positions
            .chunks_exact(POSITION)
            .map(|p| DVec3::new(f64_at(p, 0), f64_at(p, 8), f64_at(p, 16))),
    );
    row.normals.clear();
    row.normals.extend(
        normals.chunks_exact(NORMAL).map(|n| Vec3::new(f32_at(n, 0), f32_at(n, 4), f32_at(n, 8))),
    );
}

pub(super) fn decode_footer(bytes: [u8; FOOTER]) -> Footer {
    let [r0, r1, r2, r3, r4, r5, r6, r7, c0, c1, c2, c3] = bytes;
    Footer {
        rows: u64::from_le_bytes([r0, r1, r2, r3, r4, r5, r6, r7]),
        crc32: u32::from_le_bytes([c0, c1, c2, c3]),
    }
}

fn f64_at(bytes: &[u8], at: usize) -> f64 {
    let mut number = [0; 8];
    number.copy_from_slice(&bytes[at..at + 8]);
    f64::from_le_bytes(number)
}

fn f32_at(bytes: &[u8], at: usize) -> f32 {
    let mut number = [0; 4];
    number.copy_from_slice(&bytes[at..at + 4]);
    f32::from_le_bytes(number)
}
