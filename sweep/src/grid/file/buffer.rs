//! The values of one row, between the decoders of both encodings and the reader.

use glam::{DVec3, Vec3};

/// The values of the row that was read last.
#[derive(Debug, Default)]
pub(super) struct RowBuffer {
    pub v: f64,
    pub flags: u8,
    pub positions: Vec<DVec3>,
    pub normals: Vec<Vec3>,
}
