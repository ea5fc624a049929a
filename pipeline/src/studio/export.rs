//! Exports of meshes and pictures, with the commands that make the same files.
//!
//! An export reads the saved files, as the commands do. A test compares the bytes.

use super::board::Snapshot;
use super::folder::Folder;
use crate::job::MeshJob;
use crate::{Job, PipelineError, mesh};
use files::json::Document;
use files::memory::of_process;
use files::{Source, input};
use render::accuracy::Request;
use render::color::Encoding;
use render::film::command::{Named, command};
use render::film::encode::{self, Bits, Coding};
use render::film::{PixelFilter, alpha, memory};
use render::scene::MeshSource;
use render::scene::read;
use render::shade::View;
use render::{Prepared, Settings, render};
use std::path::Path;
use sweep::Object;
use sweep::grid::GridMesh;
use triangulate::{Format, Options, TriangulateError, Unit};

/// The result of an export.
#[derive(Debug)]
pub struct Exported {
    /// The bytes of the file.
    pub bytes: Vec<u8>,
    /// The commands that make the same file in the opened folder, one after another.
    pub commands: Vec<String>,
}

/// Makes the file of a path, whose extension says the format. `mesh` names the mesh of a mesh file; the first mesh if it
/// is empty.
///
/// # Errors
/// When the extension is unknown, or a file is wrong. The error is a sentence.
pub fn export(
    snapshot: &Snapshot,
    folder: &Folder,
    path: &str,
    name: &str,
) -> Result<Exported, String> {
    let job =
        Job::read(Path::new(&snapshot.opened.job), folder).map_err(|error| error.to_string())?;
    let extension = Path::new(path).extension().and_then(|end| end.to_str()).unwrap_or_default();
    if let Some(format) = encode::Format::of(Path::new(path)) {
        let made = picture(snapshot, &job, folder, path, format);
        return made.map_err(|error| error.to_string());
    }
    let Some(format) = Format::of_extension(extension) else {
        return Err(format!(
            "found the extension \"{extension}\", expected png, exr, obj, stl, ply, glb or 3mf"
        ));
    };
    let own = job.meshes.iter().find(|mesh| name.is_empty() || mesh.name == name);
    let own = own.ok_or_else(|| format!("the job makes no mesh \"{name}\""))?;
    let bytes = bytes_of_mesh(own, folder, format).map_err(|error| error.to_string())?;
    Ok(Exported { bytes, commands: vec![command_of_mesh(own, path)] })
}

/// Makes the grids of a mesh as `sweep` does with the flags of [`command_of_mesh`].
fn grids(mesh: &MeshJob, folder: &Folder) -> Result<(Object, Vec<GridMesh>), PipelineError> {
    let (name, bytes) = (input::name_of(&mesh.spec), folder.read_json(&mesh.spec)?);
    let below = mesh.spec.parent().unwrap_or(Path::new(""));
    let document = Document::new(&name, &bytes)?;
    let object = Object::read(&document, below, folder, &mesh.resolution)?;
    let grids = object.grids()?;
    Ok((object, grids))
}

fn bytes_of_mesh(
    mesh: &MeshJob,
    folder: &Folder,
    format: Format,
) -> Result<Vec<u8>, PipelineError> {
    let (object, grids) = grids(mesh, folder)?;
    let mut out = Vec::new();
    if format == Format::Obj {
        triangulate::write_obj(grids.as_slice(), &mesh.options, &mut out)?;
        return Ok(out);
    }
    let made = triangulate::mesh(grids.as_slice(), &mesh.options)?;
    let unit = object.unit().map(Unit::from);
    let written = match format {
        Format::Obj => Ok(()),
        Format::Stl => triangulate::write_stl(&made, &mut out),
        Format::Ply => triangulate::write_ply(&made, &mut out),
        Format::Glb => triangulate::write_glb(&made, unit, &mut out),
        Format::ThreeMf => {
            let mut archive = std::io::Cursor::new(Vec::new());
            let written = triangulate::write_3mf(&made, unit.unwrap_or_default(), &mut archive);
            out = archive.into_inner();
            written
        }
    };
    written.map_err(TriangulateError::Write)?;
    Ok(out)
}

/// Returns the command that makes a mesh file.
fn command_of_mesh(mesh: &MeshJob, path: &str) -> String {
    let mut words = vec!["sweep".to_string(), quoted(&mesh.spec.display().to_string())];
    let stated = &mesh.resolution;
    let mut flag = |name: &str, value: Option<String>| {
        words.extend(value.map(|value| format!("--{name} {value}")));
    };
    flag("rows", stated.rows.map(|count| count.to_string()));
    flag("cols", stated.cols.map(|count| count.to_string()));
    flag("tol", stated.tol.map(|length| length.to_string()));
    flag("angle", stated.angle_deg.map(|angle| angle.to_string()));
    flag("pixels", stated.pixels.map(|count| count.to_string()));
    flag("max-quads", stated.max_quads.map(|count| count.to_string()));
    let Options { texture, surface } = mesh.options;
    words.push("| triangulate".into());
    words.extend(texture.map(|id| format!("--texture {id}")));
    words.extend(surface.map(|id| format!("--surface {id}")));
    words.push(format!("-o {}", quoted(path)));
    words.join(" ")
}

fn picture(
    snapshot: &Snapshot,
    job: &Job,
    folder: &Folder,
    path: &str,
    format: encode::Format,
) -> Result<Exported, PipelineError> {
    let (name, bytes) = (input::name_of(&job.scene), folder.read_json(&job.scene)?);
    let document = Document::new(&name, &bytes)?;
    let file = read::parse(&document)?;
    let below = job.scene.parent().unwrap_or(Path::new(""));
    let (mut given, mut commands) = (MeshSource::new(), Vec::new());
    let beside = Path::new(path).parent().unwrap_or(Path::new(""));
    let mut flags = String::new();
    for own in &job.meshes {
        let (_, grids) = grids(own, folder)?;
        let made = triangulate::mesh(grids.as_slice(), &own.options)?;
        given.insert(own.name.clone(), mesh::for_render(made).into());
        let obj = beside.join(format!("{}.obj", own.name)).display().to_string();
        commands.push(command_of_mesh(own, &obj));
        flags += &format!(" --mesh {}", quoted(&format!("{}={obj}", own.name)));
    }
    let scene = read::resolve(&document, &file, below, folder, given)?;
    let is_transparent = scene.is_transparent;
    let mut settings = snapshot.view.settings();
    if is_transparent {
        settings.view = View::Foreground;
    }
    let _reserved = memory::reserve(&scene, &settings, Some(format), of_process())?;
    let prepared = Prepared::new(&scene);
    let error = snapshot.view.error.map(|error| error.to_string());
    let mut made = match snapshot.view.error {
        Some(error) => {
            let reached = Request::new(&prepared, &settings, PixelFilter::Box).reach(error);
            settings = reached.settings;
            reached.picture
        }
        None => render(&prepared, &settings, &|_, _| {}).0,
    };
    if is_transparent {
        let of_coverage = Settings { view: View::Coverage, ..settings.clone() };
        let (open, _) = render(&prepared, &of_coverage, &|_, _| {});
        alpha::add(&mut made, &open);
    }
    let file_name = job.scene.file_name().unwrap_or(job.scene.as_os_str()).to_string_lossy();
    let meshes: Vec<&str> = job.meshes.iter().map(|mesh| mesh.name.as_str()).collect();
    let named = Named {
        scene: &file_name,
        meshes: &meshes,
        set: &[],
        look: &[],
        error: error.as_deref(),
        alpha: is_transparent,
        encoding: Encoding::Srgb,
        bits: Bits::Eight,
    };
    let coding =
        Coding { command: Some(command(&named, &settings)), ..Coding::new(Encoding::Srgb) };
    let bytes = encode::encode_as(&made, format, &coding)
        .map_err(|source| PipelineError::Encode { name: path.into(), source })?;
    let [width, height] = snapshot.view.size;
    let error = error.map_or(String::new(), |error| format!(" --error {error}"));
    let scene = quoted(&job.scene.display().to_string());
    let out = quoted(path);
    commands.push(format!("render {scene}{flags} --size {width}x{height}{error} -o {out}"));
    Ok(Exported { bytes, commands })
}

/// Returns a word as a shell reads it.
fn quoted(word: &str) -> String {
    let word = super::folder::slashed(Path::new(word));
    let is_plain = |c: char| c.is_alphanumeric() || "-_=.,/+".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word;
    }
    format!("'{}'", word.replace('\'', "'\\''"))
}
