//! The mesh of one spec, as the spec states it or coarse enough for the picture while a handle moves.

use crate::PipelineError;
use crate::job::MeshJob;
use crate::mesh::{for_render, grids};
use files::json::Document;
use files::{Source, input};
use render::scene::file::CameraFile;
use serde_json::{Value, json};
use std::path::Path;
use sweep::spec::{self, Resolution};
use sweep::{Object, SweepError};

/// How finely a mesh is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Finish {
    /// As few cells as show the shape.
    Draft,
    /// As the spec and the job state it.
    Stated,
}

/// Rows and columns of a draft at most.
const DRAFT: [usize; 2] = [48, 56];

/// The camera and the size of the picture, for meshes whose tolerance is in pixels.
#[must_use]
pub fn camera_of(file: &CameraFile, size: (u32, u32)) -> spec::Camera {
    let CameraFile { eye, target, up, .. } = *file;
    spec::Camera { eye, target, up, fov_deg: file.angle_deg(), size: [size.0, size.1] }
}

/// Reads the spec of a mesh, with the resolution that a finish needs.
///
/// # Errors
/// When the spec is refused, or a file that it names.
pub fn object(
    mesh: &MeshJob,
    source: &dyn Source,
    camera: spec::Camera,
    finish: Finish,
) -> Result<Object, PipelineError> {
    let (name, bytes) = (input::name_of(&mesh.spec), source.read_json(&mesh.spec)?);
    let folder = mesh.spec.parent().unwrap_or(Path::new(""));
    let document = Document::new(&name, &bytes)?;
    let stated = mesh.resolution.clone();
    let stated = Resolution { camera: stated.camera.or(Some(camera)), ..stated };
    let read = |seen: &Resolution| Object::read(&document, folder, source, seen);
    if finish == Finish::Draft
        && let Some(draft) = draft(&bytes, &mesh.resolution)
        && let Ok(document) = Document::new(&name, &draft)
        // Corners and loops may need the cells that are stated.
        && let Ok(object) = Object::read(&document, folder, source, &Resolution::default())
    {
        return Ok(object);
    }
    read(&stated).map_err(|error| match error {
        SweepError::Resolution(message) => mesh.resolution_fault(message).into(),
        other => other.into(),
    })
}

/// Returns the text of a spec with the cells of a draft, or `None` if the stated ones are no more. Texture areas, which
/// count cells, shrink with them.
fn draft(bytes: &[u8], of_job: &Resolution) -> Option<Vec<u8>> {
    let mut spec: Value = serde_json::from_slice(bytes).ok()?;
    let changed = match spec.get_mut("parts").and_then(Value::as_array_mut) {
        Some(parts) => {
            parts.iter_mut().map(|part| shrink(part, of_job)).filter(|is_shrunk| *is_shrunk).count()
        }
        None => usize::from(shrink(&mut spec, of_job)),
    };
    (changed > 0).then(|| spec.to_string().into_bytes())
}

/// Gives one sweep the cells of a draft. Returns whether they are fewer.
fn shrink(sweep: &mut Value, of_job: &Resolution) -> bool {
    let own =
        |key: &str| sweep["mesh"].get(key).and_then(Value::as_u64).map(|count| count as usize);
    let stated = [of_job.rows.or(own("rows")), of_job.cols.or(own("cols"))];
    let fits = |k: usize| stated[k].is_some_and(|count| count <= DRAFT[k]);
    if fits(0) && fits(1) {
        return false;
    }
    let made = [0, 1].map(|k| stated[k].map_or(DRAFT[k], |count| count.min(DRAFT[k])));
    let areas = sweep.get_mut("areas").and_then(Value::as_array_mut);
    for area in areas.into_iter().flatten() {
        for (k, key) in ["rows", "cols"].into_iter().enumerate() {
            let Some(stated) = stated[k].filter(|count| *count > 0) else { continue };
            let ends = area.get(key).and_then(Value::as_array);
            let ends: Vec<usize> = ends
                .into_iter()
                .flatten()
                .filter_map(Value::as_u64)
                .map(|end| (end as f64 * made[k] as f64 / stated as f64).round() as usize)
                .collect();
            if let [from, to] = ends[..] {
                let from = from.min(made[k].saturating_sub(1));
                area[key] = json!([from, to.max(from + 1)]);
            }
        }
    }
    sweep["mesh"] = json!({ "rows": made[0], "cols": made[1] });
    true
}

/// Makes the triangles of an object.
///
/// # Errors
/// When the mesh takes too much memory, or a point is not finite.
pub fn triangles(mesh: &MeshJob, object: &Object) -> Result<render::shape::Mesh, PipelineError> {
    let grids = grids(object, &mesh.name)?;
    Ok(for_render(triangulate::mesh(grids.as_slice(), &mesh.options)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_draft_has_fewer_cells_and_areas_shrink_with_them() {
        let spec = json!({ "mesh": { "rows": 640, "cols": 36 },
            "areas": [{ "rows": [0, 320], "cols": [0, 3] }, { "rows": [637, 640], "cols": [3, 36] }] });
        let draft = draft(spec.to_string().as_bytes(), &Resolution::default()).unwrap();
        let expected = json!({ "mesh": { "rows": 48, "cols": 36 },
            "areas": [{ "rows": [0, 24], "cols": [0, 3] }, { "rows": [47, 48], "cols": [3, 36] }] });
        assert_eq!(serde_json::from_slice::<Value>(&draft).unwrap(), expected);
        let small = json!({ "parts": [{ "mesh": { "rows": 9, "cols": 9 } }] }).to_string();
        assert_eq!(super::draft(small.as_bytes(), &Resolution::default()), None);
        let tolerance = json!({ "mesh": { "tol": 0.01 } }).to_string();
        assert!(super::draft(tolerance.as_bytes(), &Resolution::default()).is_some());
    }
}
