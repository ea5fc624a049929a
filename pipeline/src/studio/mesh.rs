//! The mesh of one spec, as the spec states it or coarse enough for the picture while a handle moves.

use crate::PipelineError;
use crate::job::MeshJob;
use crate::mesh::for_render;
use files::json::Document;
use files::memory::of_process;
use files::words::shown;
use files::{Source, input};
use render::scene::file::CameraFile;
use serde_json::Value;
use std::path::Path;
use sweep::spec::{self, Resolution};
use sweep::{Object, SweepError};
use triangulate::TriMesh;

/// How finely a mesh is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Finish {
    /// As few cells as show the shape.
    Draft,
    /// As the spec and the job state it.
    Stated,
}

/// Rows and columns of a draft at most.
const DRAFT: [usize; 2] = [64, 72];

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
        // Areas and corners may need the cells that are stated.
        && let Ok(object) = read(&draft)
    {
        return Ok(object);
    }
    read(&stated).map_err(|error| match error {
        SweepError::Resolution(message) => mesh.resolution_fault(message).into(),
        other => other.into(),
    })
}

/// Returns the resolution of a draft, or `None` if the stated one has no more cells.
fn draft(bytes: &[u8], of_job: &Resolution) -> Option<Resolution> {
    let spec: Value = serde_json::from_slice(bytes).ok()?;
    let own = |key: &str| spec["mesh"].get(key).and_then(Value::as_u64).map(|count| count as usize);
    let rows = of_job.rows.or(own("rows"));
    let cols = of_job.cols.or(own("cols"));
    let few = |count: Option<usize>, most: usize| count.is_some_and(|count| count <= most);
    if few(rows, DRAFT[0]) && few(cols, DRAFT[1]) {
        return None;
    }
    let least = |count: Option<usize>, most: usize| Some(count.map_or(most, |own| own.min(most)));
    Some(Resolution {
        rows: least(rows, DRAFT[0]),
        cols: least(cols, DRAFT[1]),
        ..Resolution::default()
    })
}

/// Makes the triangles of an object.
///
/// # Errors
/// When the mesh takes too much memory, or a point is not finite.
pub fn triangles(mesh: &MeshJob, object: &Object) -> Result<render::shape::Mesh, PipelineError> {
    let points = object.parts().iter().map(|part| {
        let [rows, cols] = part.points();
        (rows as u64).saturating_mul(cols as u64)
    });
    let points: u64 = points.sum();
    // Memory for the grid, its triangles, and the copy of them that is rendered.
    let bytes = points.saturating_mul(36).saturating_add(TriMesh::bytes_for(2 * points));
    of_process().check(bytes, || format!("mesh {} of {points} points", shown(&mesh.name)))?;
    let grids = object.grids()?;
    Ok(for_render(triangulate::mesh(grids.as_slice(), &mesh.options)?))
}
