//! Makes examples small: few cells, few texels.

use image::imageops::FilterType;
use image::{ImageFormat, ImageResult};
use serde_json::{Value, json};
use std::io::Cursor;

/// Texels of a seed picture across and down.
const SIDE: u32 = 16;

/// Largest number of rows, and of columns, of a seed spec.
const CELLS: u64 = 24;

/// Largest number of cells that a seed spec allows for a tolerance.
const MAX_QUADS: u64 = 300;

/// Returns the picture with few texels.
///
/// # Errors
/// When the bytes are no picture.
pub fn picture(bytes: &[u8]) -> ImageResult<Vec<u8>> {
    let whole = image::load_from_memory(bytes)?;
    let mut small = Cursor::new(Vec::new());
    whole.resize_exact(SIDE, SIDE, FilterType::Nearest).write_to(&mut small, ImageFormat::Png)?;
    Ok(small.into_inner())
}

/// Limits the cells of every mesh of a spec. Numbers that a mutation made small, negative or
/// invalid stay unchanged.
pub fn bound(spec: &mut Value) {
    bound_to(spec, CELLS, MAX_QUADS);
}

/// Limits the cells of every mesh of a spec: rows and columns to `cells` each, and the cells for a
/// tolerance to `max_quads`.
pub fn bound_to(spec: &mut Value, cells: u64, max_quads: u64) {
    let count = |part: &Value, key: &str| part.get("mesh")?.get(key)?.as_f64();
    let of = |part: &mut Value| {
        let before = ["rows", "cols"].map(|key| count(part, key));
        if let Some(mesh) = part.get_mut("mesh") {
            bound_mesh(mesh, cells, max_quads);
        }
        for (key, before) in ["rows", "cols"].into_iter().zip(before) {
            if let (Some(before), Some(after)) = (before, count(part, key))
                && after < before
            {
                scale_areas(part, key, after / before);
            }
        }
    };
    of(spec);
    spec.get_mut("parts").and_then(Value::as_array_mut).into_iter().flatten().for_each(of);
}

/// Limits the cells of every mesh of a job, and the rays of its modes.
pub fn bound_job(job: &mut Value) {
    let meshes = job.get_mut("meshes").and_then(Value::as_object_mut);
    for mesh in meshes.into_iter().flat_map(|meshes| meshes.values_mut()) {
        if let Some(mesh) = mesh.get_mut("mesh") {
            bound_mesh(mesh, CELLS, MAX_QUADS);
        }
    }
}

/// Scales the areas of a spec by the factor by which its cells became fewer.
fn scale_areas(part: &mut Value, key: &str, factor: f64) {
    let areas = part.get_mut("areas").and_then(Value::as_array_mut);
    for ends in areas.into_iter().flatten().filter_map(|area| area.get_mut(key)) {
        for end in ends.as_array_mut().into_iter().flatten() {
            if let Some(cell) = end.as_u64() {
                *end = json!((cell as f64 * factor).ceil() as u64);
            }
        }
    }
}

/// Returns true if a mesh of the document has a count from 5000 to below 1e9. The work for such a
/// mesh rightly takes longer than a test should take, and the mesh is not refused.
#[must_use]
pub fn asks_for_much(text: &[u8]) -> bool {
    let Ok(document) = serde_json::from_slice::<Value>(text) else { return false };
    fn any(value: &Value) -> bool {
        let much = |key: &str, value: &Value| {
            matches!(key, "rows" | "cols" | "max_quads")
                && value.as_f64().is_some_and(|count| (5000.0..1e9).contains(&count))
        };
        match value {
            Value::Object(keys) => keys.iter().any(|(key, value)| much(key, value) || any(value)),
            Value::Array(list) => list.iter().any(any),
            _ => false,
        }
    }
    any(&document)
}

fn bound_mesh(mesh: &mut Value, cells: u64, max_quads: u64) {
    let Value::Object(mesh) = mesh else { return };
    for (key, most) in [("rows", cells), ("cols", cells), ("max_quads", max_quads)] {
        if let Some(number) = mesh.get_mut(key)
            && number.as_f64().is_some_and(|x| x > most as f64)
        {
            *number = json!(most);
        }
    }
    let asks = |key: &str| mesh.get(key).is_some();
    if asks("tol") || asks("angle_deg") || asks("pixels") {
        mesh.entry("max_quads").or_insert(json!(max_quads));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_cells_become_few_and_nonsense_stays() {
        let mut spec = json!({"mesh": {"rows": 1e9, "cols": -4},
            "parts": [{"mesh": {"tol": 0.1, "rows": "x"}}]});
        bound(&mut spec);
        assert_eq!(spec["mesh"], json!({"rows": CELLS, "cols": -4}));
        assert_eq!(spec["parts"][0]["mesh"]["max_quads"], json!(MAX_QUADS));
    }
}
