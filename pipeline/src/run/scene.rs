//! Makes the scene of a job with its meshes.

use super::{Event, Run, Shared, settings};
use crate::fineness::Fineness;
use crate::job::MeshJob;
use crate::stages::Stages;
use crate::{PipelineError, mesh};
use files::input;
use files::json::Document;
use files::memory::{Reserved, of_process};
use render::Scene;
use render::film::encode::Format;
use render::film::memory;
use render::filter::Filter;
use render::scene::file::CameraFile;
use render::scene::read::{self, Draft};
use render::scene::{MeshSource, SceneError};
use std::io::Write;
use std::path::Path;
use std::time::Instant;
use sweep::grid::file as grid_file;
use sweep::spec::{self, Camera};
use sweep::{GridMesh, Object, SweepError};
use triangulate::{ObjWriter, Patches, TriMesh, TriangulateError};

impl Run<'_> {
    /// Makes the scene with the job's meshes. Only meshes as they are stated are told and kept in files.
    pub(super) fn scene(&self, fineness: Fineness) -> Result<Scene, PipelineError> {
        let (started, before) = (Instant::now(), self.stages.get().total());
        let path = &self.job.scene;
        let (name, bytes) = (input::name_of(path), self.source.read_json(path)?);
        let document = Document::new(&name, &bytes)?;
        let file = read::parse(&document)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let draft = Draft::gather(&document, &file, folder, self.source)?;
        draft
            .check_mesh_names(self.job.meshes.iter().map(|mesh| mesh.name.as_str()))
            .map_err(|error| self.of_meshes(error))?;
        let mut meshes = MeshSource::new();
        for mesh in &self.job.meshes {
            meshes.insert(mesh.name.clone(), self.mesh(mesh, &file.camera, fineness)?.into());
        }
        let scene = draft.resolve(self.source, meshes).map_err(|error| self.of_meshes(error))?;
        // Reserves memory for each picture together with the tables that earlier modes keep.
        let mut kept: Vec<(Filter, Reserved<'_>)> = Vec::new();
        for mode in self.job.all_modes() {
            kept.retain(|(filter, _)| *filter != mode.filter);
            let settings = settings(mode, self.options.size);
            memory::reserve(&scene, &settings, Some(Format::Png), of_process()).map(drop)?;
            kept.push((mode.filter, memory::reserve_tables(&scene, mode.filter, of_process())?));
        }
        // The meshes are made in between, and their times belong to other stages.
        let of_meshes = self.stages.get().total() - before;
        let read = started.elapsed().saturating_sub(of_meshes);
        self.took(Stages { read, ..Stages::default() });
        Ok(scene)
    }

    /// Turns an error of the scene into an error of the job, if the job has a mesh too many or too
    /// few.
    fn of_meshes(&self, error: SceneError) -> PipelineError {
        let job = self.job.name.clone();
        match error {
            SceneError::UnknownMesh { name, known } => {
                PipelineError::UnknownMesh { job, name, known }
            }
            SceneError::MissingMesh { name, path, scene } => {
                PipelineError::MissingMesh { job, name, path, scene }
            }
            other => other.into(),
        }
    }

    fn mesh(
        &self,
        mesh: &MeshJob,
        camera: &CameraFile,
        fineness: Fineness,
    ) -> Result<render::shape::Mesh, PipelineError> {
        let started = Instant::now();
        let (name, bytes) = (input::name_of(&mesh.spec), self.source.read_json(&mesh.spec)?);
        let folder = mesh.spec.parent().unwrap_or(Path::new(""));
        // A scene does not move its meshes, so the scene's camera sees each mesh as a camera in the
        // spec would.
        let CameraFile { eye, target, up, .. } = *camera;
        let fov_deg = camera.angle_deg();
        let size = [self.options.size.0, self.options.size.1];
        let camera = Camera { eye, target, up, fov_deg, size };
        let stated = mesh.resolution.clone();
        let seen = spec::Resolution { camera: stated.camera.or(Some(camera)), ..stated };
        let (kinds, made) = fineness.apply(&bytes, &seen, camera);
        self.kinds.set(self.kinds.get().and(kinds));
        let (bytes, seen) = match made {
            Some(made) => (made, spec::Resolution::default()),
            None => (bytes, seen),
        };
        let keep = self.batch.filter(|_| self.options.keep && fineness == Fineness::Stated);
        let shared = self.shared.filter(|_| keep.is_none());
        let key = shared.map(|_| Shared::key(mesh, &bytes, &seen));
        if let (Some(shared), Some(key)) = (shared, &key)
            && let Some(made) = shared.get(key)
        {
            return Ok(made);
        }
        let document = Document::new(&name, &bytes)?;
        let object =
            Object::read(&document, folder, self.source, &seen).map_err(|error| match error {
                // The complaint is about the resolution that the job states in place of the spec's.
                SweepError::Resolution(message) => mesh.resolution_fault(message).into(),
                other => PipelineError::from(other),
            })?;
        let grids = mesh::grids(&object, &mesh.name)?;
        let sweep = started.elapsed();
        let stated = fineness == Fineness::Stated;
        if let Some(batch) = keep {
            self.write((batch, &self.job.grid_file(mesh), None), |out| {
                grid_file::write_all(&grids, grid_file::Encoding::Binary, out)
                    .map_err(|source| out.failed(source).into())
            })?;
        }
        let write = started.elapsed() - sweep;
        let started = Instant::now();
        let triangles = match keep {
            Some(batch) => self.write((batch, &self.job.obj_file(mesh), None), |out| {
                mesh_and_obj(&grids, &mesh.options, out).map_err(|error| match error {
                    TriangulateError::Write(source) => out.failed(source).into(),
                    error => error.into(),
                })
            })?,
            None => triangulate::mesh(grids.as_slice(), &mesh.options)?,
        };
        let triangles = mesh::for_render(triangles);
        let triangulate = started.elapsed();
        self.took(Stages { sweep, triangulate, write, ..Stages::default() });
        if stated {
            (self.tell)(Event::Mesh {
                name: &mesh.name,
                triangles: triangles.triangles.len(),
                sweep,
                triangulate,
                missed: object.missed(),
            });
        }
        if let (Some(shared), Some(key)) = (shared, key) {
            shared.keep(key, &triangles);
        }
        Ok(triangles)
    }
}

/// Makes the triangles of grids in memory, and writes them as OBJ in the same pass.
fn mesh_and_obj(
    grids: &[GridMesh],
    options: &triangulate::Options,
    out: &mut impl Write,
) -> Result<TriMesh, TriangulateError> {
    let sinks = (ObjWriter::new(out), TriMesh::default());
    let ((writer, mesh), counts) = grids.run(options, sinks)?;
    writer.finish(&counts).map_err(TriangulateError::Write)?;
    Ok(mesh)
}
