//! Makes the scene that shows one file alone: a curve spec, a grid or a mesh.
//!
//! A spec is swept and triangulated as `sweep` and `triangulate` would, and a grid is triangulated. [`render::showcase`]
//! then makes a scene for the mesh. Settings change the spec and, below `scene`, the scene.

use crate::{PipelineError, mesh};
use files::json::Document;
use files::memory::{Reserved, of_process};
use files::{Setting, Source, input, setting};
use render::Scene;
use render::scene::mesh_file::{self, Near};
use render::scene::obj::ObjFile;
use render::scene::read::{self, Draft};
use render::scene::{MeshSource, SceneError};
use render::showcase::{self, Look, Subject};
use std::path::Path;
use sweep::grid::file::GridReader;
use sweep::{Object, spec};
use triangulate::{Options, TriMesh, TriangulateError};

/// A file to show, and its circumstances.
#[derive(Debug)]
pub struct Showing<'a> {
    /// The path of the file.
    pub path: &'a Path,
    /// The bytes of the file.
    pub bytes: Vec<u8>,
    /// The source of the files that it names.
    pub source: &'a dyn Source,
    /// Values of the spec, and below `scene` of the scene.
    pub settings: &'a [Setting],
    /// Flags that change how the mesh is shown.
    pub look: &'a Look,
    /// Folder of the scene, if the scene is kept.
    pub folder: &'a Path,
    /// Width of the picture over its height.
    pub aspect: f64,
    /// True if nothing but the mesh is shown.
    pub alone: bool,
}

/// The scene of a file.
#[derive(Debug)]
pub struct Shown {
    /// The text of the scene file.
    pub text: Vec<u8>,
    /// The scene.
    pub scene: Scene,
    /// True if the scene names the file of its mesh. The scene of a spec or a grid is given its mesh.
    pub names_mesh: bool,
    /// True if the file is a spec.
    pub is_spec: bool,
    /// Sentences about the file.
    pub notes: Vec<String>,
}

/// A kind of file that can be shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Spec,
    Grid,
    Mesh,
}

impl Showing<'_> {
    /// Makes the scene.
    ///
    /// # Errors
    /// When the file is wrong, of another kind, or too large.
    pub fn scene(mut self) -> Result<Shown, PipelineError> {
        let name = input::name_of(self.path);
        let kind = kind(&name, &self.bytes)?;
        let up = showcase::up_of(&name, &self.bytes);
        let (mut kept, mut notes) = (Vec::new(), Vec::new());
        let bytes = std::mem::take(&mut self.bytes);
        let own = self.settings.iter().filter(|setting| setting.below("scene").is_none());
        let own: Vec<Setting> = own.cloned().collect();
        if let Some(setting) = own.first().filter(|_| kind != Kind::Spec) {
            return Err(PipelineError::NoSpec { setting: setting.argument().into(), name });
        }
        let read: ObjFile = match kind {
            Kind::Spec => self.swept(&name, bytes, &own, &mut notes)?.into(),
            Kind::Grid => {
                let mut reader =
                    GridReader::open(&name, bytes.as_slice()).map_err(TriangulateError::Grid)?;
                let points = bytes.len() as u64 / 24;
                kept.push(of_process().reserve(TriMesh::bytes_for(points), || name.clone())?);
                mesh::for_render(triangulate::mesh(&mut reader, &Options::default())?).into()
            }
            Kind::Mesh => self.read(&name, &bytes, &mut kept)?,
        };
        let names_mesh = kind == Kind::Mesh && !input::is_stdin(self.path);
        let file = names_mesh.then(|| showcase::seen_from(self.folder, self.path));
        let texture = self.look.texture.as_ref();
        let texture = texture.map(|path| showcase::seen_from(self.folder, path));
        let subject = Subject {
            mesh: &read,
            name: &name,
            given: showcase::MESH,
            file: file.as_deref(),
            texture: texture.as_deref(),
            up,
            has_colors: showcase::has_colors(&read, self.source),
            aspect: self.aspect,
            alone: self.alone,
            is_soft: true,
        };
        let text = showcase::scene(&subject, self.look)?.into_bytes();
        let of_scene: Vec<Setting> =
            self.settings.iter().filter_map(|setting| setting.below("scene")).collect();
        let scene_name = format!("the scene of {name}");
        let text = setting::apply(&scene_name, text, &of_scene).map_err(files::FileError::from)?;
        let scene_name = setting::name(scene_name, &of_scene);
        let document = Document::new(&scene_name, &text)?;
        let file = read::parse(&document)?;
        let draft = Draft::gather(&document, &file, self.folder, self.source)?;
        let given = MeshSource::from([(showcase::MESH.to_string(), read)]);
        let scene = draft.resolve(self.source, given)?;
        Ok(Shown { text, scene, names_mesh, is_spec: kind == Kind::Spec, notes })
    }

    /// Sweeps and triangulates a spec.
    fn swept(
        &self,
        name: &str,
        bytes: Vec<u8>,
        settings: &[Setting],
        notes: &mut Vec<String>,
    ) -> Result<render::shape::Mesh, PipelineError> {
        let bytes = input::room_for_values(bytes, || name.into())?;
        let bytes = setting::apply(name, bytes, settings).map_err(files::FileError::from)?;
        let name = setting::name(name.into(), settings);
        let document = Document::new(&name, &bytes)?;
        let folder = self.path.parent().unwrap_or(Path::new(""));
        let object = Object::read(&document, folder, self.source, &spec::Resolution::default())?;
        let grids = mesh::grids(&object, &name)?;
        notes.extend(object.missed());
        Ok(mesh::for_render(triangulate::mesh(grids.as_slice(), &Options::default())?))
    }

    /// Reads a mesh file.
    fn read(
        &self,
        name: &str,
        bytes: &[u8],
        kept: &mut Vec<Reserved<'static>>,
    ) -> Result<ObjFile, PipelineError> {
        let folder = self.path.parent().unwrap_or(Path::new(""));
        let reserve = &mut |bytes| {
            kept.push(of_process().reserve(bytes, || format!("mesh {name}"))?);
            Ok(())
        };
        let near = Near { folder, source: self.source, reserve };
        Ok(mesh_file::read(name, bytes, near).map_err(SceneError::from)?)
    }
}

/// Returns the kind of a file: a spec is JSON, and a grid begins with its header.
fn kind(name: &str, bytes: &[u8]) -> Result<Kind, PipelineError> {
    if mesh_file::is_mesh(name, bytes) {
        return Ok(Kind::Mesh);
    }
    let start = bytes.split(|&byte| byte == b'\n').next().unwrap_or_default();
    let is_format = |text: &[u8], format: &str| {
        String::from_utf8_lossy(&text[..text.len().min(500)]).contains(&format!("\"{format}\""))
    };
    if is_format(start, "tb-grid") {
        return Ok(Kind::Grid);
    }
    for (format, found, hint) in [
        ("tb-scene", "a scene", "`render SCENE.json -o FILE.png` makes its picture"),
        ("tb-job", "a job", "`pipeline run JOB.json` makes its pictures"),
    ] {
        if is_format(bytes, format) {
            return Err(PipelineError::NotShown { name: name.into(), found, hint });
        }
    }
    Ok(Kind::Spec)
}
