//! Values that the command line sets in the files of a job: `-D scene.camera.fov_deg=35`.
//!
//! A path that starts with `scene` is a path in the scene, and one that starts with `specs.NAME` a path in the spec of
//! the job's mesh of that name. Any other path is one in the job file.

use crate::{Job, PipelineError, job};
use files::{FileError, Setting, Source, input, setting};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A source whose JSON files have values that the command line set.
#[derive(Debug)]
pub struct Changed<'a> {
    source: &'a dyn Source,
    settings: BTreeMap<PathBuf, Vec<Setting>>,
    /// The path of the job file, if settings are those of a job.
    job: Option<PathBuf>,
}

impl<'a> Changed<'a> {
    /// Returns the source with the settings of a job file, whose path is given.
    #[must_use]
    pub fn job(source: &'a dyn Source, path: &Path, settings: &[Setting]) -> Self {
        let own = settings.iter().filter(|one| !elsewhere(one)).cloned().collect();
        let job = Some(path.to_path_buf());
        Self { source, settings: BTreeMap::from([(path.to_path_buf(), own)]), job }
    }

    /// Returns the source with the settings of the files that a job names. Meshes that are made of the same spec have
    /// the same settings.
    ///
    /// # Errors
    /// When a setting names a mesh that the job does not make.
    pub fn parts(
        source: &'a dyn Source,
        job: &Job,
        settings: &[Setting],
    ) -> Result<Self, PipelineError> {
        let mut by_file: BTreeMap<PathBuf, Vec<Setting>> = BTreeMap::new();
        for setting in settings {
            if let Some(own) = setting.below("scene") {
                by_file.entry(job.scene.clone()).or_default().push(own);
            } else if let Some(of_mesh) = setting.below("specs") {
                let mesh =
                    job.meshes.iter().find_map(|mesh| Some((mesh, of_mesh.below(&mesh.name)?)));
                let Some((mesh, own)) = mesh else {
                    let known: Vec<&str> =
                        job.meshes.iter().map(|mesh| mesh.name.as_str()).collect();
                    return Err(PipelineError::UnknownSpec {
                        setting: setting.argument().into(),
                        job: job.name.clone(),
                        known: known.join(", "),
                    });
                };
                by_file.entry(mesh.spec.clone()).or_default().push(own);
            }
        }
        Ok(Self { source, settings: by_file, job: None })
    }
}

impl Source for Changed<'_> {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        self.source.read(path)
    }

    fn read_json(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        let mut text = self.source.read_json(path)?;
        if self.job.as_deref() == Some(path) {
            text = job::of_scene(path, text);
        }
        match self.settings.get(path) {
            Some(settings) => Ok(setting::apply(&input::name_of(path), text, settings)?),
            None => Ok(text),
        }
    }

    fn same_but_case(&self, path: &Path) -> Option<PathBuf> {
        self.source.same_but_case(path)
    }
}

/// Returns whether a setting is one of the scene or of a spec.
fn elsewhere(setting: &Setting) -> bool {
    setting.below("scene").is_some() || setting.below("specs").is_some()
}
