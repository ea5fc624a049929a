//! The flags for the files that are read: the scene and its meshes.

use super::UseError;
use clap::Args;
use files::json::Document;
use files::memory::of_process;
use files::{FileError, Ledger, Report, Setting, input, setting};
use render::Scene;
use render::scene::MeshSource;
use render::scene::mesh_file::{self, Near};
use render::scene::read::{self, Draft};
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub struct InputArguments {
    /// The scene: a JSON file, or - for standard input
    #[arg(required_unless_present = "emit_schema")]
    scene: Option<PathBuf>,
    /// A mesh for the scene: its name in the scene, and an OBJ, STL, PLY or glTF file or - for standard input
    #[arg(long = "mesh", value_name = "NAME=FILE", value_parser = mesh_argument)]
    meshes: Vec<MeshArgument>,
    /// Set a value of the scene: -D ambient=0.5; may be given several times
    #[arg(short = 'D', value_name = "PATH=VALUE")]
    settings: Vec<Setting>,
    /// Render nothing: print the contents of the scene, and what is wrong or suspicious, on standard
    /// output; the exit code is 4 if something is wrong
    #[arg(long, conflicts_with_all = ["output", "pixel"])]
    pub check: bool,
    /// Print the JSON Schema of scenes and do nothing else
    #[arg(long, exclusive = true)]
    pub emit_schema: bool,
}

#[derive(Debug, Clone)]
struct MeshArgument {
    name: String,
    file: PathBuf,
}

impl InputArguments {
    /// Checks that standard input is used once and that no mesh is given twice.
    pub fn check(&self) -> Result<(), UseError> {
        let scene = std::iter::once(("the scene".to_string(), self.scene()));
        let meshes =
            self.meshes.iter().map(|mesh| (format!("--mesh {}", mesh.name), mesh.file.as_path()));
        let mut from_stdin = scene.chain(meshes).filter(|(_, file)| input::is_stdin(file));
        if let (Some((first, _)), Some((second, _))) = (from_stdin.next(), from_stdin.next()) {
            return Err(UseError::TwoFromStdin(first, second));
        }
        for (k, mesh) in self.meshes.iter().enumerate() {
            if self.meshes[..k].iter().any(|other| other.name == mesh.name) {
                return Err(UseError::SameMesh(mesh.name.clone()));
            }
        }
        Ok(())
    }

    /// Enters the files that will be read into the ledger, so that no output replaces them.
    pub fn expect(&self, ledger: &Ledger) -> Result<(), FileError> {
        ledger.expect(self.scene(), "the scene")?;
        let mut meshes = self.meshes.iter();
        meshes.try_for_each(|mesh| ledger.expect(&mesh.file, &format!("the mesh {}", mesh.name)))
    }

    /// Reads the scene through the ledger, and calls `then` with the scene and its files.
    pub fn read_scene<T>(
        &self,
        ledger: &Ledger,
        then: impl FnOnce(&Draft<'_>, Scene) -> Result<T, Report>,
    ) -> Result<T, Report> {
        let name = self.name();
        let text = ledger.argument_json(self.scene(), "the scene")?;
        let text = setting::apply(&name, text, &self.settings)?;
        let name = setting::name(name, &self.settings);
        let document = Document::new(&name, &text)?;
        let file = read::parse(&document)?;
        let folder = match self.scene().parent() {
            Some(folder) if !input::is_stdin(self.scene()) => folder,
            _ => Path::new(""),
        };
        let draft = Draft::gather(&document, &file, folder, ledger)?;
        draft.check_mesh_names(self.meshes.iter().map(|mesh| mesh.name.as_str()))?;
        let (mut given, mut kept) = (MeshSource::new(), Vec::new());
        for mesh in &self.meshes {
            let bytes = ledger.argument(&mesh.file, &format!("the mesh {}", mesh.name))?;
            let name = input::name_of(&mesh.file);
            let folder = match mesh.file.parent() {
                Some(folder) if !input::is_stdin(&mesh.file) => folder,
                _ => Path::new(""),
            };
            let reserve = &mut |bytes| {
                kept.push(of_process().reserve(bytes, || format!("mesh {name}"))?);
                Ok(())
            };
            let read = mesh_file::read(&name, &bytes, Near { folder, source: ledger, reserve })?;
            given.insert(mesh.name.clone(), read);
        }
        let scene = draft.resolve(ledger, given)?;
        drop(kept);
        then(&draft, scene)
    }

    /// Returns the names of the meshes that are given.
    pub fn mesh_names(&self) -> Vec<&str> {
        self.meshes.iter().map(|mesh| mesh.name.as_str()).collect()
    }

    /// Returns the file name of the scene, without its folders.
    pub fn file_name(&self) -> String {
        let name = self.scene().file_name().unwrap_or(self.scene().as_os_str());
        name.to_string_lossy().into_owned()
    }

    /// Returns the values that are set in the scene, each as `PATH=VALUE`.
    pub fn set(&self) -> Vec<String> {
        self.settings.iter().map(Setting::text).collect()
    }

    /// Returns the name of the scene in messages.
    pub fn name(&self) -> String {
        input::name_of(self.scene())
    }

    fn scene(&self) -> &Path {
        self.scene.as_deref().unwrap_or(Path::new("-"))
    }
}

fn mesh_argument(text: &str) -> Result<MeshArgument, String> {
    match text.split_once('=') {
        Some((name, file)) if !name.is_empty() && !file.is_empty() => {
            Ok(MeshArgument { name: name.into(), file: file.into() })
        }
        _ => Err("expected NAME=FILE, or NAME=- for standard input".into()),
    }
}
