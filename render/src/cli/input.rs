//! What is read: the scene and its meshes.

use super::UseError;
use clap::Args;
use files::json::Document;
use files::{Disk, Report, input};
use render::Scene;
use render::scene::{MeshSource, obj, read};
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub struct InputArguments {
    /// The scene: a JSON file, or - for standard input
    scene: PathBuf,
    /// A mesh for the scene: its name there, and an OBJ file or - for standard input
    #[arg(long = "mesh", value_name = "NAME=FILE", value_parser = mesh_argument)]
    meshes: Vec<MeshArgument>,
}

#[derive(Debug, Clone)]
struct MeshArgument {
    name: String,
    file: PathBuf,
}

impl InputArguments {
    /// Checks that nothing is read twice and no mesh is given twice.
    pub fn check(&self) -> Result<(), UseError> {
        let scene = std::iter::once(("the scene".to_string(), &self.scene));
        let meshes = self.meshes.iter().map(|mesh| (format!("--mesh {}", mesh.name), &mesh.file));
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

    pub fn read_scene(&self) -> Result<Scene, Report> {
        let name = input::name_of(&self.scene);
        let text = input::read(&self.scene)?;
        let document = Document::new(&name, &text)?;
        let file = read::parse(&document)?;
        read::check_mesh_names(&file, self.meshes.iter().map(|mesh| mesh.name.as_str()))?;
        let mut given = MeshSource::new();
        for mesh in &self.meshes {
            let bytes = input::read(&mesh.file)?;
            given.insert(mesh.name.clone(), obj::read(&input::name_of(&mesh.file), &bytes)?);
        }
        let folder = match self.scene.parent() {
            Some(folder) if !input::is_stdin(&self.scene) => folder,
            _ => Path::new(""),
        };
        Ok(read::resolve(&document, &file, folder, &Disk, given)?)
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
