//! A scene beside the files that it was made of.

use super::solid::Skin;
use crate::scene::file::{CameraFile, ObjectFile};
use crate::scene::read::{Draft, Sheet};
use crate::scene::{Material, Object, Scene, SurfaceTexture};
use crate::shape::{Mesh, Shape};
use glam::DVec3;
use std::collections::HashMap;

/// What the checks look at.
#[derive(Debug)]
pub struct Subject<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Its camera as the file says it.
    pub camera: &'a CameraFile,
    /// How many times as wide as high its picture is.
    pub aspect: f64,
    /// Its objects, in its order.
    pub items: Vec<Item<'a>>,
    /// Its lights' paths, in its order.
    pub lights: Vec<String>,
    /// Its materials' names and paths, in its order.
    pub materials: Vec<[String; 2]>,
    /// Its textures with their names and paths, pictures and solids each in the scene's order.
    pub textures: Vec<(SurfaceTexture, [String; 2])>,
    /// Where each texture stands in `textures`.
    texture_places: HashMap<SurfaceTexture, usize>,
}

/// An object with its place.
#[derive(Debug)]
pub struct Item<'a> {
    /// Where the file says it.
    pub path: String,
    /// What it is, with the name of a mesh.
    pub kind: String,
    /// The object.
    pub object: &'a Object,
    /// Of a mesh, what its edges say.
    pub skin: Option<Skin>,
}

impl<'a> Subject<'a> {
    /// Puts the paths of `sheets`, which are the draft's, beside what the scene made of them.
    #[must_use]
    pub fn new(draft: &'a Draft<'_>, sheets: &[Sheet<'a>], scene: &'a Scene, aspect: f64) -> Self {
        let mut subject = Self {
            scene,
            camera: &draft.file.camera,
            aspect,
            items: Vec::new(),
            lights: Vec::new(),
            materials: Vec::new(),
            textures: Vec::new(),
            texture_places: HashMap::new(),
        };
        let mut objects = scene.objects.iter();
        let (mut pictures, mut solids) = (0.., 0..);
        for (number, sheet) in sheets.iter().enumerate() {
            let own = number + 1 == sheets.len();
            let file = if own { String::new() } else { format!("{}: ", sheet.document.file) };
            let lists = sheet.lists;
            subject.lights.extend((0..lists.lights.len()).map(|k| format!("{file}lights[{k}]")));
            let named = |key: &str, name: &String| [name.clone(), format!("{file}{key}.{name}")];
            subject.materials.extend(lists.materials.keys().map(|name| named("materials", name)));
            for (name, texture) in lists.textures {
                let texture = match texture.image {
                    Some(_) => pictures.next().map(SurfaceTexture::Picture),
                    None => solids.next().map(SurfaceTexture::Solid),
                };
                subject.textures.extend(texture.map(|texture| (texture, named("textures", name))));
            }
            for ((place, entry), object) in lists.objects.iter().enumerate().zip(&mut objects) {
                let kind = match entry {
                    ObjectFile::Mesh(mesh) => format!("mesh {}", mesh.name),
                    other => other.kind().into(),
                };
                let path = format!("{file}objects[{place}].{}", entry.kind());
                let skin = mesh_of(object).map(Skin::of);
                subject.items.push(Item { path, kind, object, skin });
            }
        }
        let textures = subject.textures.iter().enumerate();
        subject.texture_places = textures.map(|(place, (texture, _))| (*texture, place)).collect();
        subject
    }

    /// The camera's place.
    #[must_use]
    pub fn eye(&self) -> DVec3 {
        self.camera.eye.into()
    }

    /// The name of a material; one that no file names is of a material library.
    #[must_use]
    pub fn material_name(&self, material: usize) -> &str {
        self.materials.get(material).map_or("of its mtl", |[name, _]| name)
    }

    /// The name of a texture; one that no file names is of a material library.
    #[must_use]
    pub fn texture_name(&self, texture: SurfaceTexture) -> &str {
        let known = self.texture_places.get(&texture).map(|&place| &self.textures[place]);
        known.map_or("of its mtl", |(_, [name, _])| name)
    }

    /// The materials of an object.
    pub fn materials_of<'s>(&'s self, item: &'s Item<'_>) -> impl Iterator<Item = &'s Material> {
        item.object.parts.iter().map(|part| &self.scene.materials[part.material])
    }

    /// Whether light goes through some surface of an object.
    #[must_use]
    pub fn is_clear(&self, item: &Item<'_>) -> bool {
        self.materials_of(item).any(|material| material.transparency > 0.0)
    }

    /// Whether light is bent in an object.
    #[must_use]
    pub fn bends(&self, item: &Item<'_>) -> bool {
        let bends = |material: &Material| {
            material.transparency > 0.0 && material.index_of_refraction != 1.0
        };
        self.materials_of(item).any(bends)
    }
}

impl Item<'_> {
    /// Its triangles, if it is a mesh.
    #[must_use]
    pub fn mesh(&self) -> Option<&Mesh> {
        mesh_of(self.object)
    }
}

fn mesh_of(object: &Object) -> Option<&Mesh> {
    match &object.shape {
        Shape::Mesh(mesh) => Some(mesh),
        _ => None,
    }
}
