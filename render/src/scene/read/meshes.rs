//! Reads the meshes of a scene: their triangles, and the appearance of their surfaces.

use super::libraries::{self, Libraries, Pictured, remark};
use super::ranges::Ranges;
use super::reliefs::Carved;
use super::stored::{Stored, Taken};
use super::{Reader, SceneError};
use crate::scene::file::{MeshFile, OneOrMore};
use crate::scene::mtl::{Entry, Map, counted, plain};
use crate::scene::obj::{self, ObjFile};
use crate::scene::text::before_comment;
use crate::scene::{Material, Object, Scene, Surface, SurfaceTexture, VertexColors};
use crate::shape::mesh::{NONE, Triangle};
use crate::shape::{Instance, Mesh, Placement, Shape, SharedMesh};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// A mesh whose triangles are not read yet.
#[derive(Debug)]
pub(super) struct PlannedMesh<'a> {
    pub(super) file: &'a MeshFile,
    /// JSON path of the mesh.
    pub(super) at: String,
    pub(super) bindings: Bindings,
    pub(super) placement: Placement,
    /// The placements of the copies of a mesh with instances, which include `placement`.
    pub(super) instances: Option<Vec<Placement>>,
}

/// The materials and textures that a mesh binds, by surface id and by texture id.
#[derive(Debug, Default)]
pub(super) struct Bindings {
    material: Option<usize>,
    texture: Option<SurfaceTexture>,
    materials: BTreeMap<String, usize>,
    textures: BTreeMap<String, SurfaceTexture>,
}

/// The appearance of a surface. The pictures are those of a library.
struct Bound {
    surface: Surface,
    picture: Option<Pictured>,
    relief: Option<Carved>,
}

/// The libraries of a mesh.
#[derive(Debug)]
struct Own {
    paths: Vec<PathBuf>,
    /// True if the scene names them, and false if the OBJ file does.
    named: bool,
    /// True if the vertices of the mesh have colours.
    colored: bool,
    /// True if the OBJ file names libraries, found or not.
    has_names: bool,
}

impl Reader<'_> {
    /// Reads the triangles of a mesh and binds its surfaces to materials and textures.
    pub(super) fn mesh(
        &self,
        planned: PlannedMesh<'_>,
        stored: &mut Stored,
        libraries: &mut Libraries,
        scene: &mut Scene,
    ) -> Result<(), SceneError> {
        let PlannedMesh { file, at, bindings, placement, instances } = planned;
        let key = stored.key(file, self.folder);
        let read = |given| self.mesh_file(&at, file, given);
        let (read, mut taken, first) = stored.take(&key, read)?;
        let mut sentences = if first { read.remarks.clone() } else { Vec::new() };
        if first && !read.unused.is_empty() {
            let unused: BTreeMap<String, usize> = read.unused.iter().cloned().collect();
            sentences.push(format!("not used: {}", counted(&unused)));
        }
        if !sentences.is_empty() {
            scene.remarks.push(remark(&read.file, &sentences));
        }
        let surfaces = taken.mesh().surfaces.clone();
        let own = self.libraries_of(&at, file, &bindings, (&read, &surfaces), libraries, scene)?;
        let (mut parts, mut maps) = (Vec::new(), Vec::new());
        for (number, name) in surfaces.iter().enumerate() {
            let taken = libraries.take(&own.paths, name, scene);
            let bound = self.bind(&at, file, &bindings, name, taken, &own, scene)?;
            let (mut surface, mut under) = (bound.surface, None);
            let at_library = format!("{at}.mtl");
            if let Some(picture) = bound.picture {
                surface.texture =
                    self.library_picture(&at_library, own.named, &picture, libraries, scene)?;
                under = picture.map().filter(|_| surface.texture.is_some()).cloned();
            }
            if let Some(relief) = bound.relief {
                let at = (at_library.as_str(), own.named);
                let (bare, under) = (surface.material, under.as_ref());
                surface.material = self.carved(at, bare, &relief, under, libraries, scene)?;
            }
            maps.extend(under.map(|map| (number as u32, map)));
            parts.push(surface);
        }
        if !maps.is_empty() {
            let mut mesh = taken.into_own();
            for (number, map) in maps {
                show_map(&mut mesh, &mut parts, number, &map);
            }
            taken = Taken::Owned(mesh);
        }
        self.check_texture_coordinates(&at, file, taken.mesh(), &parts)?;
        keep_shown_colors(&mut taken, &parts, first.then_some(&*read), scene);
        if parts.iter().any(|part| scene.materials[part.material].transparency > 0.0) {
            let joined = stored.close_rounded(&key, &mut taken);
            if joined > 0 {
                let sentence = format!(
                    "{joined} corners that differ by rounding were joined, which closes the mesh"
                );
                scene.remarks.push(remark(&file.name, &[sentence]));
            }
        }
        let placements = instances.unwrap_or(vec![placement]);
        let taken = match taken {
            Taken::Owned(mesh) if placements.len() > 1 => Taken::Shared(SharedMesh::new(mesh)),
            taken => taken,
        };
        match taken {
            Taken::Owned(mesh) => {
                let placement = placements.first().unwrap_or(&placement);
                scene.objects.push(self.placed(&at, Shape::Mesh(mesh), parts, placement)?);
            }
            Taken::Shared(shared) => {
                let objects = placements.into_iter().map(|placement| Object {
                    shape: Shape::Instance(Instance::new(shared.clone(), placement)),
                    parts: parts.clone(),
                    to_own_space: placement.to_own(),
                });
                scene.objects.extend(objects);
            }
        }
        Ok(())
    }

    /// Reads the libraries that the scene names for a mesh. If it names none, reads those that the OBJ
    /// file names, provided that a surface needs them.
    fn libraries_of(
        &self,
        at: &str,
        file: &MeshFile,
        bindings: &Bindings,
        (read, surfaces): (&ObjFile, &[String]),
        libraries: &mut Libraries,
        scene: &mut Scene,
    ) -> Result<Own, SceneError> {
        let colored = read.colored > 0;
        if let Some(named) = &file.mtl {
            let paths: Vec<PathBuf> =
                named.all().iter().map(|path| self.folder.join(path)).collect();
            for (k, path) in paths.iter().enumerate() {
                let at = match named {
                    OneOrMore::One(_) => format!("{at}.mtl"),
                    OneOrMore::More(_) => format!("{at}.mtl[{k}]"),
                };
                libraries.add(path, || self.named_file(&at, path), scene)?;
            }
            return Ok(Own { paths, named: true, colored, has_names: false });
        }
        let has_names = !read.libraries.is_empty();
        let mut own = Own { paths: Vec::new(), named: false, colored, has_names };
        let unbound = |name: &String| bindings.material_of(name).is_none();
        let is_unbound = surfaces.iter().any(unbound);
        // How an alpha is used does not matter without a picture.
        let is_plain = |entry: &Entry| {
            *entry == Entry { alpha: entry.alpha, ..Entry::new(&entry.name, plain()) }
        };
        if !read.materials.is_empty() {
            if is_unbound {
                own.paths.push(self.held_materials(read, libraries));
            } else if !read.materials.iter().all(is_plain) {
                let sentence =
                    "the materials of the file are not used, since the scene binds all surfaces";
                scene.remarks.push(remark(&read.file, &[sentence.into()]));
            }
        }
        if !is_unbound {
            if let Some(name) = read.libraries.first() {
                let sentence = format!(
                    "the library {} is not used, since the scene binds all surfaces; \"mtl\" uses it",
                    obj::shortened(name)
                );
                scene.remarks.push(remark(&read.file, &[sentence]));
            }
            return Ok(own);
        }
        for name in &read.libraries {
            for path in self.library_paths(&read.folder, name) {
                let unread = match self.source.read(&path) {
                    Ok(bytes) => {
                        libraries.add(&path, || Ok(bytes), scene).err().map(|e| e.to_string())
                    }
                    Err(error) => Some(error.to_string()),
                };
                match unread {
                    None => own.paths.push(path),
                    Some(error) => {
                        scene.remarks.push(remark(&read.file, &[format!("mtllib: {error}")]));
                    }
                }
            }
        }
        Ok(own)
    }

    /// Refuses a mesh with a texture on triangles without texture coordinates.
    fn check_texture_coordinates(
        &self,
        at: &str,
        file: &MeshFile,
        mesh: &Mesh,
        parts: &[Surface],
    ) -> Result<(), SceneError> {
        let is_lost = |triangle: &&Triangle| {
            triangle.uv[0] == NONE && parts[triangle.surface as usize].picture().is_some()
        };
        match mesh.triangles.iter().filter(is_lost).count() {
            0 => Ok(()),
            count => {
                let message = format!(
                    "found {count} triangles without texture coordinates (vt) in mesh {} on surfaces \
                     with a texture, expected vt at each corner, or no texture",
                    file.name
                );
                self.fault(at, message)
            }
        }
    }

    /// Finds the materials and textures that a mesh names.
    pub(super) fn mesh_bindings(&self, at: &str, file: &MeshFile) -> Result<Bindings, SceneError> {
        let mut bindings = Bindings::default();
        if let Some(name) = &file.material {
            bindings.material = Some(self.material_index(&format!("{at}.material"), name)?);
        }
        if let Some(name) = &file.texture {
            bindings.texture = Some(self.texture_index(&format!("{at}.texture"), name)?);
        }
        for (key, name) in &file.materials {
            let index = self.material_index(&format!("{at}.materials.{key}"), name)?;
            bindings.materials.insert(key.clone(), index);
        }
        for (key, name) in &file.textures {
            let index = self.texture_index(&format!("{at}.textures.{key}"), name)?;
            bindings.textures.insert(key.clone(), index);
        }
        Ok(bindings)
    }

    /// Returns the material and texture of the surface that `usemtl` names `surface`, the picture of
    /// a library if the scene binds no texture, and its relief if the scene binds no material. `taken` is the
    /// entry of the mesh's libraries.
    #[expect(clippy::too_many_arguments, reason = "what a surface may take its appearance from")]
    fn bind(
        &self,
        at: &str,
        file: &MeshFile,
        bindings: &Bindings,
        surface: &str,
        taken: Option<libraries::Taken>,
        own: &Own,
        scene: &mut Scene,
    ) -> Result<Bound, SceneError> {
        let ids = obj::ids(surface);
        let [texture_key, material_key] = ids.unwrap_or([surface, surface]);
        let material = match &taken {
            // A library that the scene names comes before the material for all surfaces.
            Some(taken) if own.named => {
                bindings.materials_entry(material_key).or(Some(taken.material))
            }
            _ => bindings.material_of(surface).or(taken.as_ref().map(|taken| taken.material)),
        };
        let material = material.or(bindings.material).or_else(|| {
            // Colours of the vertices stand for a material.
            own.colored.then(|| {
                scene.materials.push(Material { vertex_colors: VertexColors::Always, ..plain() });
                scene.names.materials.push("vertex".into());
                scene.materials.len() - 1
            })
        });
        let material = material.or_else(|| {
            // The OBJ names libraries, and none of them has the material.
            (!own.named && (own.has_names || !own.paths.is_empty())).then(|| {
                let name = obj::shortened(surface);
                let sentence = format!("no library has material {name}, which is plain white");
                scene.remarks.push(remark(&file.name, &[sentence]));
                scene.materials.push(plain());
                scene.names.materials.push(surface.into());
                scene.materials.len() - 1
            })
        });
        let Some(material) = material else {
            let message = format!(
                "found surface {material_key:?} in mesh {}, expected \"material\", or an entry for \
                 it in \"materials\" or the \"mtl\"",
                file.name
            );
            return self.fault(at, message);
        };
        let bound = bindings.textures_entry(texture_key);
        let is_taken = taken.as_ref().is_some_and(|taken| taken.material == material);
        let taken = taken.filter(|_| is_taken || own.named);
        let (picture, relief) = taken.map_or((None, None), |taken| (taken.picture, taken.relief));
        let (picture, relief) = (picture.filter(|_| bound.is_none()), relief.filter(|_| is_taken));
        let texture = bound.or(bindings.texture.filter(|_| picture.is_none()));
        // Texture id 0 means no texture; any other id was meant to be seen.
        if texture.is_none() && picture.is_none() && ids.is_some() && texture_key != "0" {
            let message = format!(
                "found texture id {texture_key} in mesh {}, expected an entry for it in \
                 \"textures\", or a \"texture\" for all",
                file.name
            );
            return self.fault(at, message);
        }
        Ok(Bound { surface: Surface { material, texture }, picture, relief })
    }
}

impl Bindings {
    /// Returns the material that the scene binds to a surface, by its name, or to all.
    fn material_of(&self, surface: &str) -> Option<usize> {
        let key = obj::ids(surface).map_or(surface, |[_, material]| material);
        self.materials_entry(key).or(self.material)
    }

    /// A name may be followed by a comment.
    fn materials_entry(&self, key: &str) -> Option<usize> {
        let short = || self.materials.get(before_comment(key)?);
        self.materials.get(key).or_else(short).copied()
    }

    fn textures_entry(&self, key: &str) -> Option<SurfaceTexture> {
        let short = || self.textures.get(before_comment(key)?);
        self.textures.get(key).or_else(short).copied()
    }
}

/// Removes the colours of the vertices of an object's own mesh if no material shows them. `first` is the file of a mesh
/// that no earlier object shows; a remark on the file counts the colours.
fn keep_shown_colors(
    taken: &mut Taken,
    parts: &[Surface],
    first: Option<&ObjFile>,
    scene: &mut Scene,
) {
    if taken.mesh().colors.is_empty()
        || parts
            .iter()
            .any(|part| scene.materials[part.material].vertex_colors.show(part.texture.is_some()))
    {
        return;
    }
    if let Taken::Owned(mesh) = taken {
        mesh.colors = Vec::new();
    }
    if let Some(read) = first {
        let sentence = format!(
            "not used: vertex colours ({} times), which a material with \"color\": \"vertex\" shows",
            read.colored
        );
        scene.remarks.push(remark(&read.file, &[sentence]));
    }
}

/// Moves the texture coordinates of a surface as a picture's options say. Triangles without texture
/// coordinates become a part of the same material without a picture.
fn show_map(mesh: &mut Mesh, parts: &mut Vec<Surface>, surface: u32, map: &Map) {
    let bare = mesh.surfaces.len() as u32;
    let mut moved: BTreeMap<u32, u32> = BTreeMap::new();
    let mut has_bare = false;
    for triangle in mesh.triangles.iter_mut().filter(|triangle| triangle.surface == surface) {
        if triangle.uv[0] == NONE {
            triangle.surface = bare;
            has_bare = true;
        } else if !map.is_plain() {
            triangle.uv = triangle.uv.map(|index| {
                *moved.entry(index).or_insert_with(|| {
                    mesh.uvs.push(map.moved(mesh.uvs[index as usize]));
                    mesh.uvs.len() as u32 - 1
                })
            });
        }
    }
    if has_bare {
        mesh.surfaces.push(mesh.surfaces[surface as usize].clone());
        parts.push(Surface { texture: None, ..parts[surface as usize] });
    }
}
