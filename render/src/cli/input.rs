//! The flags for the files that are read: the scene and its meshes.

use super::UseError;
use super::loaded::Loaded;
use super::mesh::{Staging, read_mesh};
use clap::Args;
use files::{FileError, Ledger, Report, Setting, Variant, input, variants};
use render::scene::MeshSource;
use render::scene::mesh_file;
use render::scene::obj::ObjFile;
use render::showcase::{self, Look, Subject, look};
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub struct InputArguments {
    /// The scene: a JSON file, or - for standard input. A mesh (OBJ, STL, PLY, glTF) is shown without a scene
    #[arg(required_unless_present = "emit_schema")]
    scene: Option<PathBuf>,
    /// A mesh for the scene: its name in the scene, and an OBJ, STL, PLY or glTF file or - for standard input
    #[arg(long = "mesh", value_name = "NAME=FILE", value_parser = mesh_argument)]
    meshes: Vec<MeshArgument>,
    /// Set a value of the scene: -D ambient=0.5; may be given several times
    #[arg(short = 'D', value_name = "PATH=VALUE")]
    settings: Vec<Setting>,
    /// Make a picture for each row of a table: a column is a path as in -D, and a cell its value. The column
    /// name is added to the name of the picture; without it a number is. Meshes are read once
    #[arg(long, value_name = "FILE.csv", requires = "output", conflicts_with_all = ["pixel", "scene_out"])]
    jobs_from: Option<PathBuf>,
    #[command(flatten)]
    pub look: Look,
    /// Write the scene that shows the mesh, as a starting point for a scene of your own
    #[arg(long, value_name = "FILE.json", help_heading = look::HEADING)]
    pub scene_out: Option<PathBuf>,
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
        let table = self.jobs_from.iter().map(|path| ("--jobs-from".into(), path.as_path()));
        let meshes = meshes.chain(table);
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

    /// Returns whether an input is standard input.
    pub fn reads_stdin(&self) -> bool {
        let meshes = self.meshes.iter().map(|mesh| mesh.file.as_path());
        let files = meshes.chain(self.jobs_from.as_deref()).chain([self.scene()]);
        files.into_iter().any(input::is_stdin)
    }

    /// Enters the files that will be read into the ledger, so that no output replaces them.
    pub fn expect(&self, ledger: &Ledger) -> Result<(), FileError> {
        ledger.expect(self.scene(), "the scene")?;
        if let Some(path) = &self.scene_out {
            ledger.claim(path, "name another file with --scene-out")?;
        }
        if let Some(path) = &self.look.texture {
            ledger.expect(path, "the picture")?;
        }
        let mut meshes = self.meshes.iter();
        meshes.try_for_each(|mesh| ledger.expect(&mesh.file, &format!("the mesh {}", mesh.name)))
    }

    /// Reads the file of the scene and the given meshes through the ledger. A mesh gets a scene of its own.
    pub fn load<'a>(&'a self, ledger: &'a Ledger, staging: &Staging) -> Result<Loaded<'a>, Report> {
        let name = self.name();
        let bytes = ledger.argument(self.scene(), "the scene")?;
        let (mut given, mut kept) = (MeshSource::new(), Vec::new());
        let (text, folder) = if mesh_file::is_mesh(&name, &bytes) {
            let read = read_mesh(self.scene(), &bytes, ledger, &mut kept)?;
            let made = self.stage(&read, &bytes, staging, ledger)?;
            given.insert(showcase::MESH.into(), read);
            made
        } else {
            let scene_out = || self.scene_out.as_ref().map(|_| "--scene-out".into());
            if let Some(flag) = self.look.given().or_else(scene_out) {
                return Err(UseError::LookOfScene(flag, name).into());
            }
            (input::room_for_values(bytes, || name.clone())?, folder_of(self.scene()))
        };
        // The scene's own text is checked before the meshes are read.
        let mut loaded = Loaded { name, text, folder, given, ledger, _kept: Vec::new() };
        let names = self.meshes.iter().map(|mesh| mesh.name.as_str());
        loaded.check(&self.settings, names)?;
        for mesh in &self.meshes {
            let bytes = ledger.argument(&mesh.file, &format!("the mesh {}", mesh.name))?;
            let read = read_mesh(&mesh.file, &bytes, ledger, &mut kept)?;
            loaded.given.insert(mesh.name.clone(), read);
        }
        loaded._kept = kept;
        if let Some(path) = &self.scene_out {
            ledger.create(path)?.commit_all(&loaded.text_with(&self.settings)?)?;
        }
        Ok(loaded)
    }

    /// Returns the scene of a mesh that has none, as the text of a file in a folder.
    fn stage(
        &self,
        read: &ObjFile,
        bytes: &[u8],
        staging: &Staging,
        ledger: &Ledger,
    ) -> Result<(Vec<u8>, &Path), Report> {
        let name = self.name();
        let folder = self.scene_out.as_deref().map_or(Path::new(""), folder_of);
        let is_stdin = input::is_stdin(self.scene());
        let file = (!is_stdin).then(|| showcase::seen_from(folder, self.scene()));
        let texture = self.look.texture.as_ref().map(|path| showcase::seen_from(folder, path));
        let subject = Subject {
            mesh: read,
            name: &name,
            given: showcase::MESH,
            file: file.as_deref(),
            texture: texture.as_deref(),
            up: showcase::up_of(&name, bytes),
            has_colors: showcase::has_colors(read, ledger),
            aspect: staging.aspect,
            alone: staging.alone,
            is_soft: true,
        };
        Ok((showcase::scene(&subject, &self.look)?.into_bytes(), folder))
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

    /// Returns the values that are set in the scene.
    pub fn settings(&self) -> &[Setting] {
        &self.settings
    }

    /// Returns the variants of `--jobs-from`, with the values of `-D` before their own, if it is given.
    pub fn variants(&self, ledger: &Ledger) -> Result<Option<Vec<Variant>>, Report> {
        let Some(path) = &self.jobs_from else { return Ok(None) };
        let bytes = ledger.argument(path, "the variants")?;
        let mut variants = variants::read(&input::name_of(path), &bytes)?;
        for variant in &mut variants {
            variant.settings.splice(0..0, self.settings.iter().cloned());
        }
        Ok(Some(variants))
    }

    /// Returns the name of the scene in messages.
    pub fn name(&self) -> String {
        input::name_of(self.scene())
    }

    fn scene(&self) -> &Path {
        self.scene.as_deref().unwrap_or(Path::new("-"))
    }
}

/// Returns the folder of a file that is not standard input.
fn folder_of(file: &Path) -> &Path {
    file.parent().filter(|_| !input::is_stdin(file)).unwrap_or(Path::new(""))
}

fn mesh_argument(text: &str) -> Result<MeshArgument, String> {
    match text.split_once('=') {
        Some((name, file)) if !name.is_empty() && !file.is_empty() => {
            Ok(MeshArgument { name: name.into(), file: file.into() })
        }
        _ => Err("expected NAME=FILE, or NAME=- for standard input".into()),
    }
}
