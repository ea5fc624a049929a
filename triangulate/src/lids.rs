//! The triangles of lids: flat ends of a sweep, between points of the first or the last rows of several patches.

use crate::cell::CellWriter;
use crate::diagonal::is_flat;
use crate::triangulator::Sink;
use crate::{Triangle, TriangulateError};
use sweep::grid::{End, Lid};

/// The first and the last row of a patch: numbers of the positions, and the points.
#[derive(Debug, Clone, Default)]
pub struct Rim {
    /// The rows, the first before the last.
    pub rows: [Vec<(u32, [f32; 3])>; 2],
}

/// The rims of the patches of an object so far.
pub type Rims = Vec<Rim>;

/// Passes the triangles of a lid to the writer.
///
/// # Errors
/// When the lid's corners do not fit the columns of its patches.
pub fn write<S: Sink>(
    lid: &Lid,
    object: &str,
    rims: &[Rim],
    writer: &mut CellWriter<S>,
) -> Result<(), TriangulateError> {
    let end = match lid.end {
        End::Start => 0,
        End::End => 1,
    };
    let first = rims.len().saturating_sub(lid.patches);
    let corners: Vec<(u32, [f32; 3])> =
        rims[first..].iter().flat_map(|rim| rim.rows[end].iter().copied()).collect();
    if lid.patches > rims.len() || corners.len() != lid.uvs.len() {
        let fault = format!(
            "found a lid of {} corners on {} patches, expected {}, the number of their columns",
            lid.uvs.len(),
            lid.patches,
            corners.len()
        );
        return Err(TriangulateError::Lid { object: object.into(), fault });
    }
    let mut uvs: Vec<Option<u32>> = vec![None; corners.len()];
    let mut normals: Vec<Option<u32>> = vec![None; lid.normals.len()];
    for triangle in &lid.triangles {
        let three = triangle.map(|corner| corners[corner as usize]);
        let [a, b, c] = three.map(|corner| corner.1);
        if a == b || b == c || c == a {
            writer.counts.collapsed += 1;
            continue;
        }
        if is_flat(a, b, c) {
            writer.counts.slivers += 1;
            continue;
        }
        let uv = triangle.map(|corner| {
            let corner = corner as usize;
            *uvs[corner]
                .get_or_insert_with(|| writer.write_uv(lid.uvs[corner].map(|x| x as f32 + 0.0)))
        });
        let normal = triangle.map(|corner| {
            let own = if normals.len() == 1 { 0 } else { corner as usize };
            let rounded = lid.normals[own].map(|x| x + 0.0);
            *normals[own].get_or_insert_with(|| writer.write_normal(rounded))
        });
        let triangle = Triangle { position: three.map(|corner| corner.0), uv, normal };
        writer.sink.triangle(&triangle);
        writer.counts.triangles += 1;
    }
    Ok(())
}
