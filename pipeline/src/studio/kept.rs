//! The scene of the last picture, of which the next picture keeps as much as it can.
//!
//! While a handle is dragged only the mesh of one spec changes. The textures, the other meshes and the materials stay,
//! and the new mesh takes the place of the old one. If the text of the scene changes, apart from its camera, the whole
//! scene is read again.

use super::mesh::{self, Finish};
use super::source::Edited;
use crate::job::MeshJob;
use crate::{Job, PipelineError};
use files::input;
use files::json::Document;
use files::{JsonError, Source};
use glam::DAffine3;
use render::Scene;
use render::Stock;
use render::scene::file::SceneFile;
use render::scene::read::{self, Draft};
use render::scene::{Camera, MeshSource};
use render::shape::Shape;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use sweep::Object;

/// A scene with its meshes, and the texts from which it was made.
#[derive(Debug)]
pub struct Kept {
    /// The scene.
    pub scene: Scene,
    /// The objects of the meshes, by name.
    pub objects: BTreeMap<String, Arc<Object>>,
    /// Data of the last pictures that the scene can take over.
    stock: Stock,
    /// The objects whose meshes were replaced since then.
    replaced: Vec<usize>,
    frame: Frame,
    meshes: BTreeMap<String, MeshKey>,
}

/// All texts but those of the specs, without the camera.
#[derive(Debug, Clone, PartialEq)]
struct Frame {
    job: Vec<u8>,
    scene: Value,
}

/// The text of a spec, and its finish.
#[derive(Debug, Clone, PartialEq)]
struct MeshKey {
    text: Vec<u8>,
    finish: Finish,
    camera: Option<String>,
}

/// The files of a picture, read.
#[derive(Debug)]
pub struct Files {
    /// The job.
    pub job: Job,
    /// The camera of the scene.
    pub camera: Camera,
    camera_in_spec: sweep::spec::Camera,
    name: String,
    bytes: Vec<u8>,
    file: SceneFile,
    frame: Frame,
    meshes: BTreeMap<String, Vec<u8>>,
}

impl Files {
    /// Reads the job and the scene, and the texts of the specs. `size` is that of the picture in pixels.
    ///
    /// # Errors
    /// When a file cannot be read or is wrong.
    pub fn read(job: &str, source: &Edited, size: (u32, u32)) -> Result<Self, PipelineError> {
        let job_text = source.read_json(Path::new(job))?;
        let job = Job::read(Path::new(job), source)?;
        let (name, bytes) = (input::name_of(&job.scene), source.read_json(&job.scene)?);
        let document = Document::new(&name, &bytes)?;
        let file = read::parse(&document)?;
        let camera = read::camera_of(&document, &file)?;
        let mut scene: Value = document.parse()?;
        if let Some(keys) = scene.as_object_mut() {
            keys.remove("camera");
        }
        let mut meshes = BTreeMap::new();
        for mesh in &job.meshes {
            meshes.insert(mesh.name.clone(), source.read_json(&mesh.spec)?);
        }
        let camera_in_spec = mesh::camera_of(&file.camera, size);
        let frame = Frame { job: job_text, scene };
        Ok(Self { job, camera, camera_in_spec, name, bytes, file, frame, meshes })
    }

    fn key(&self, mesh: &MeshJob, finish: Finish) -> MeshKey {
        let text = self.meshes.get(&mesh.name).cloned().unwrap_or_default();
        let pixels = mesh.resolution.pixels.is_some() || contains(&text, b"\"pixels\"");
        let camera =
            (pixels && finish == Finish::Stated).then(|| format!("{:?}", self.camera_in_spec));
        MeshKey { text, finish, camera }
    }
}

fn contains(text: &[u8], word: &[u8]) -> bool {
    text.windows(word.len()).any(|part| part == word)
}

impl Kept {
    /// Returns whether the scene is that of the files, apart from the camera, with meshes of at least this finish.
    #[must_use]
    pub fn shows(&self, files: &Files, finish: Finish) -> bool {
        let is_made = |mesh: &MeshJob| {
            let own = self.meshes.get(&mesh.name);
            let is = |finish| own == Some(&files.key(mesh, finish));
            is(Finish::Stated) || (finish == Finish::Draft && is(Finish::Draft))
        };
        self.frame == files.frame && files.job.meshes.iter().all(is_made)
    }

    /// Makes the scene of the files in place of an old one, and takes over what the old one has of it. After an error the
    /// old scene stays.
    ///
    /// # Errors
    /// When a file is wrong.
    pub fn make(
        old: &mut Option<Self>,
        files: &Files,
        source: &Edited,
        finish: Finish,
    ) -> Result<(), PipelineError> {
        if let Some(own) = old
            && own.frame == files.frame
            && own.replace_meshes(files, source, finish)?
        {
            return Ok(());
        }
        *old = Some(Self::whole(files, source, finish)?);
        Ok(())
    }

    /// Takes what earlier pictures have left, without the data of objects whose meshes were replaced since then.
    pub fn take_stock(&mut self) -> Stock {
        let replaced = std::mem::take(&mut self.replaced);
        std::mem::take(&mut self.stock).of_same(|_| true, |object| !replaced.contains(&object))
    }

    /// Keeps what is left of the pictures of the scene as it is.
    pub fn keep(&mut self, stock: Stock) {
        self.stock = stock;
        self.replaced.clear();
    }

    /// Makes the whole scene of the files.
    ///
    /// # Errors
    /// When a file is wrong.
    pub fn whole(files: &Files, source: &Edited, finish: Finish) -> Result<Self, PipelineError> {
        let document = Document::new(&files.name, &files.bytes)?;
        let folder = files.job.scene.parent().unwrap_or(Path::new(""));
        let draft = Draft::gather(&document, &files.file, folder, source)?;
        let names = files.job.meshes.iter().map(|mesh| mesh.name.as_str());
        draft.check_mesh_names(names)?;
        let (mut given, mut meshes) = (MeshSource::new(), BTreeMap::new());
        let mut objects = BTreeMap::new();
        for mesh in &files.job.meshes {
            let object = mesh::object(mesh, source, files.camera_in_spec, finish)?;
            given.insert(mesh.name.clone(), mesh::triangles(mesh, &object)?.into());
            meshes.insert(mesh.name.clone(), files.key(mesh, finish));
            objects.insert(mesh.name.clone(), Arc::new(object));
        }
        let scene = draft.resolve(source, given)?;
        let (stock, replaced, frame) = (Stock::default(), Vec::new(), files.frame.clone());
        Ok(Self { scene, objects, stock, replaced, frame, meshes })
    }

    /// Replaces the meshes whose specs changed. Returns false if a mesh is placed, shared or smoothed, so that the scene
    /// must be read again.
    fn replace_meshes(
        &mut self,
        files: &Files,
        source: &Edited,
        finish: Finish,
    ) -> Result<bool, PipelineError> {
        for mesh in &files.job.meshes {
            let old = self.meshes.get(&mesh.name);
            let key = files.key(mesh, finish);
            if old == Some(&key) || old == Some(&files.key(mesh, Finish::Stated)) {
                continue;
            }
            let Some(slot) = self.slot(&mesh.name) else { return Ok(false) };
            let object = mesh::object(mesh, source, files.camera_in_spec, finish)?;
            let mut made = mesh::triangles(mesh, &object)?;
            let Some(own) = self.scene.objects.get_mut(slot) else { return Ok(false) };
            let Shape::Mesh(before) = &own.shape else { return Ok(false) };
            if before.surfaces != made.surfaces {
                return Ok(false);
            }
            let materials = &self.scene.materials;
            if own.parts.iter().any(|part| materials[part.material].transparency > 0.0) {
                made.close_rounded();
            }
            own.shape = Shape::Mesh(made);
            self.replaced.push(slot);
            self.meshes.insert(mesh.name.clone(), key);
            self.objects.insert(mesh.name.clone(), Arc::new(object));
        }
        Ok(true)
    }

    /// Returns the index of the only object that shows a mesh as it is made.
    fn slot(&self, name: &str) -> Option<usize> {
        let is_named = |other: &Option<String>| other.as_deref() == Some(name);
        let mut slots =
            self.scene.names.objects.iter().enumerate().filter(|(_, own)| is_named(own));
        let (slot, _) = slots.next()?;
        let own = self.scene.objects.get(slot)?;
        let is_plain = own.to_own_space == DAffine3::IDENTITY && !self.is_smoothed();
        (slots.next().is_none()
            && is_plain
            && self.scene.names.objects.len() == self.scene.objects.len())
        .then_some(slot)
    }

    /// Returns whether some mesh of the scene is smoothed by an angle.
    fn is_smoothed(&self) -> bool {
        let objects = self.frame.scene["objects"].as_array();
        objects.is_some_and(|all| all.iter().any(|one| one["mesh"].get("smooth_deg").is_some()))
    }
}

/// Returns the position of an error in a text, if it has one.
#[must_use]
pub fn position(error: &PipelineError) -> Option<&JsonError> {
    use render::scene::SceneError;
    use sweep::SweepError;
    match error {
        PipelineError::Json(error) => Some(error),
        PipelineError::Sweep(
            SweepError::Malformed(error)
            | SweepError::Geometry(error)
            | SweepError::Named(error, _)
            | SweepError::TooLarge(error),
        ) => Some(error),
        PipelineError::Scene(SceneError::Json(error) | SceneError::Named(error, _)) => Some(error),
        PipelineError::Scene(SceneError::TooLarge(error)) => Some(error),
        _ => None,
    }
}
