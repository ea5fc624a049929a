//! The numbers of glTF accessors: rows of equal length in a view of a buffer, of any type of numbers, with
//! replacements of single rows (glTF 2.0, sections 3.6.2 and 3.11).
//!
//! The accessors of the crate `gltf` do not check their ranges, and take all positions for `f32`.

use super::Fault;
use gltf::accessor::{Accessor, DataType};
use gltf::buffer::View;

/// Reads the rows of accessors from the bytes of all buffers.
#[derive(Debug)]
pub(super) struct Numbers<'a> {
    buffers: &'a [Vec<u8>],
    /// The binary chunk of a GLB, which is the first buffer without a URI.
    chunk: Option<&'a [u8]>,
}

/// The rows of an array in a view.
struct Rows<'a> {
    view: View<'a>,
    offset: usize,
    stride: usize,
    count: usize,
    kind: DataType,
}

impl<'a> Numbers<'a> {
    pub(super) fn new(buffers: &'a [Vec<u8>], chunk: Option<&'a [u8]>) -> Self {
        Self { buffers, chunk }
    }

    /// Returns the bytes of a view.
    pub(super) fn view(&self, view: &View<'_>) -> Result<&'a [u8], Fault> {
        let buffer = view.buffer();
        let bytes = match buffer.source() {
            gltf::buffer::Source::Bin => self.chunk.unwrap_or_default(),
            gltf::buffer::Source::Uri(_) => &self.buffers[buffer.index()],
        };
        let rest = bytes.get(view.offset()..);
        rest.and_then(|rest| rest.get(..view.length())).ok_or_else(|| {
            let found = format!(
                "{} bytes from byte {} on at `bufferViews[{}]`",
                view.length(),
                view.offset(),
                view.index()
            );
            let expected =
                format!("at most the {} bytes of buffer {}", bytes.len(), buffer.index());
            Fault::part(found, expected)
        })
    }

    /// Returns the rows of an accessor. Whole numbers are divided by their largest value if the accessor
    /// says so. `N` must be the length of its rows; longer rows are cut.
    pub(super) fn rows<const N: usize>(
        &self,
        accessor: &Accessor<'_>,
    ) -> Result<Vec<[f64; N]>, Fault> {
        let length = accessor.dimensions().multiplicity();
        let at = accessor.index();
        if length < N {
            let found = format!("rows of {length} numbers at `accessors[{at}]`");
            return Err(Fault::part(found, format!("rows of {N}")));
        }
        let kind = accessor.data_type();
        let scale = if accessor.normalized() { largest(kind) } else { 1.0 };
        let mut rows = match accessor.view() {
            None => vec![[0.0; N]; accessor.count()],
            Some(view) => {
                let stride = view.stride().unwrap_or(length * size(kind));
                let (offset, count) = (accessor.offset(), accessor.count());
                self.array(&Rows { view, offset, stride, count, kind }, length, at)?
            }
        };
        if let Some(sparse) = accessor.sparse() {
            let count = sparse.count();
            let (indices, values) = (sparse.indices(), sparse.values());
            let kind_of_index = match indices.index_type() {
                gltf::accessor::sparse::IndexType::U8 => DataType::U8,
                gltf::accessor::sparse::IndexType::U16 => DataType::U16,
                gltf::accessor::sparse::IndexType::U32 => DataType::U32,
            };
            let part = |view, offset, length: usize, kind| Rows {
                view,
                offset,
                stride: length * size(kind),
                count,
                kind,
            };
            let places: Vec<[f64; 1]> =
                self.array(&part(indices.view(), indices.offset(), 1, kind_of_index), 1, at)?;
            let values: Vec<[f64; N]> =
                self.array(&part(values.view(), values.offset(), length, kind), length, at)?;
            for ([place], value) in places.into_iter().zip(values) {
                let count = rows.len();
                *rows.get_mut(place as usize).ok_or_else(|| {
                    let found = format!("row {place} at `accessors[{at}].sparse`");
                    Fault::part(found, format!("at most {}", count.saturating_sub(1)))
                })? = value;
            }
        }
        if scale != 1.0 {
            for number in rows.as_flattened_mut() {
                *number = (*number / scale).max(-1.0);
            }
        }
        Ok(rows)
    }

    fn array<const N: usize>(
        &self,
        rows: &Rows<'_>,
        length: usize,
        at: usize,
    ) -> Result<Vec<[f64; N]>, Fault> {
        let view = self.view(&rows.view)?;
        let row = length * size(rows.kind);
        let end = rows.count.checked_sub(1).map_or(Some(0), |last| {
            last.checked_mul(rows.stride)?.checked_add(rows.offset)?.checked_add(row)
        });
        if rows.stride == 0 || end.is_none_or(|end| end > view.len()) {
            let found = format!("{} rows at `accessors[{at}]`", rows.count);
            let expected = format!("as many as fit into the {} bytes of its view", view.len());
            return Err(Fault::part(found, expected));
        }
        let each = size(rows.kind);
        let row = |k: usize| {
            let bytes = &view[rows.offset + k * rows.stride..];
            let mut numbers = [0.0; N];
            for (number, bytes) in numbers.iter_mut().zip(bytes.chunks_exact(each)) {
                *number = value(rows.kind, bytes);
            }
            numbers
        };
        Ok((0..rows.count).map(row).collect())
    }
}

fn size(kind: DataType) -> usize {
    match kind {
        DataType::I8 | DataType::U8 => 1,
        DataType::I16 | DataType::U16 => 2,
        DataType::U32 | DataType::F32 => 4,
    }
}

/// The number that stands for 1 in an array that is normalized.
fn largest(kind: DataType) -> f64 {
    match kind {
        DataType::I8 => 127.0,
        DataType::U8 => 255.0,
        DataType::I16 => 32767.0,
        DataType::U16 => 65535.0,
        DataType::U32 => 4_294_967_295.0,
        DataType::F32 => 1.0,
    }
}

fn value(kind: DataType, bytes: &[u8]) -> f64 {
    let mut four = [0; 4];
    four[..bytes.len()].copy_from_slice(bytes);
    let [a, b, ..] = four;
    match kind {
        DataType::I8 => f64::from(a as i8),
        DataType::U8 => f64::from(a),
        DataType::I16 => f64::from(i16::from_le_bytes([a, b])),
        DataType::U16 => f64::from(u16::from_le_bytes([a, b])),
        DataType::U32 => f64::from(u32::from_le_bytes(four)),
        DataType::F32 => f64::from(f32::from_le_bytes(four)),
    }
}
