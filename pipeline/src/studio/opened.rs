//! The opened files: a job, or a spec or scene with the job and the scene that it lacks.
//!
//! A spec gets a scene and a job of its own, which exist only as texts until they are saved: `vase-scene.json` and
//! `vase-job.json` beside `vase.json`. If these files exist, they are opened instead.

use super::automatic;
use super::folder::{Folder, slashed};
use super::source::Edited;
use super::texts::Texts;
use crate::Job;
use files::words::shown;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// The kind of an opened file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A curve spec, `tb-sweep`.
    Spec,
    /// A scene, `tb-scene`.
    Scene,
    /// A job, `tb-job`.
    Job,
}

impl Kind {
    /// Returns the kind that a text states, if it is one of the three.
    #[must_use]
    pub fn of(text: &str) -> Option<Self> {
        let value: Value = serde_json::from_str(text).ok()?;
        match value.get("format")?.as_str()? {
            "tb-sweep" => Some(Self::Spec),
            "tb-scene" => Some(Self::Scene),
            "tb-job" => Some(Self::Job),
            _ => None,
        }
    }

    /// Returns the word of the kind: `spec`, `scene` or `job`.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Spec => "spec",
            Self::Scene => "scene",
            Self::Job => "job",
        }
    }
}

/// The opened files.
#[derive(Debug, Clone)]
pub struct Opened {
    /// The file that the user opened.
    pub main: String,
    /// The path of the job, which may have no file yet.
    pub job: String,
    /// The path of the scene.
    pub scene: String,
    /// The names of the job's meshes, and the paths of their specs.
    pub specs: Vec<(String, String)>,
}

impl Opened {
    /// Opens a file of the folder and the files that it names.
    ///
    /// # Errors
    /// When a file cannot be read, or the file is of no known kind. The error is a sentence.
    pub fn open(folder: &Folder, path: &str, texts: &mut Texts) -> Result<Self, String> {
        let path = slashed(Path::new(path));
        texts.read(folder, &path)?;
        let text = texts.get(&path).map(|text| text.now.to_string()).unwrap_or_default();
        let kind = Kind::of(&text).ok_or_else(|| {
            let path = shown(&path);
            format!("{path}: expected a \"format\" of tb-sweep, tb-scene or tb-job")
        })?;
        let job = match kind {
            Kind::Job => path.clone(),
            Kind::Spec => Self::beside(folder, &path, texts, "job", &|stem, name| {
                let scene = Value::from(format!("{stem}-scene.json"));
                let (title, name) = (Value::from(stem), Value::from(name));
                let meshes = format!("{{ \"{}\": {{ \"spec\": {name} }} }}", mesh_name(stem));
                job_text(&format!("\"title\": {title},\n  \"meshes\": {meshes},"), &scene)
            }),
            Kind::Scene => Self::beside(folder, &path, texts, "job", &|stem, name| {
                job_text(&format!("\"title\": {},", Value::from(stem)), &Value::from(name))
            }),
        };
        if kind == Kind::Spec {
            Self::beside(folder, &path, texts, "scene", &|stem, _| {
                automatic::scene(folder, &path, &text, &mesh_name(stem))
            });
        }
        let edited = Edited { texts: texts.snapshot(), folder: folder.clone() };
        let read = Job::read(Path::new(&job), &edited).map_err(|error| error.to_string())?;
        let scene = slashed(&read.scene);
        texts.read(folder, &scene)?;
        let mut specs = Vec::new();
        for mesh in &read.meshes {
            let spec = slashed(&mesh.spec);
            texts.read(folder, &spec)?;
            specs.push((mesh.name.clone(), spec));
        }
        Ok(Self { main: path, job, scene, specs })
    }

    /// Opens the file `STEM-WHAT.json` beside a file, or adds its text. Returns its path.
    fn beside(
        folder: &Folder,
        path: &str,
        texts: &mut Texts,
        what: &str,
        make: &dyn Fn(&str, &str) -> String,
    ) -> String {
        let whole = PathBuf::from(path);
        let stem = whole.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let name = whole.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let own = slashed(&whole.with_file_name(format!("{stem}-{what}.json")));
        if texts.get(&own).is_none() && texts.read(folder, &own).is_err() {
            texts.add(&own, &make(&stem, &name));
        }
        own
    }
}

/// Returns the name of a mesh made of a file's name: letters, digits, `-` and `_`.
fn mesh_name(stem: &str) -> String {
    let name: String =
        stem.chars().map(|c| if c.is_alphanumeric() || c == '_' { c } else { '-' }).collect();
    if name.is_empty() { "mesh".into() } else { name }
}

/// Returns the text of a job with these keys and this scene.
fn job_text(keys: &str, scene: &Value) -> String {
    format!("{{\n  \"format\": \"tb-job\", \"version\": 1,\n  {keys}\n  \"scene\": {scene}\n}}\n")
}
