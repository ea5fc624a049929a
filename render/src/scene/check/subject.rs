//! A scene with the names and paths of its files.

use super::skin::Skin;
use crate::scene::file::{CameraFile, ObjectFile};
use crate::scene::read::{Draft, SceneText};
use crate::scene::{Background, Material, Object, Scene, SurfaceTexture};
use crate::shape::Mesh;
use glam::DVec3;
use std::collections::HashMap;

/// The scene as the checks see it.
#[derive(Debug)]
pub struct Subject<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The camera as in the file.
    pub camera: &'a CameraFile,
    /// Width of the picture over its height, positive.
    pub aspect: f64,
    /// The objects, in the scene's order.
    pub items: Vec<Item<'a>>,
    /// Paths of the lights, in the scene's order.
    pub lights: Vec<String>,
    /// Names and paths of the materials, in the scene's order.
    pub materials: Vec<[String; 2]>,
    /// The textures with their names and paths; pictures and solids each in the scene's order.
    pub textures: Vec<(SurfaceTexture, [String; 2])>,
    /// Index of each texture in `textures`.
    texture_indices: HashMap<SurfaceTexture, usize>,
}

/// An object with its path.
#[derive(Debug)]
pub struct Item<'a> {
    /// JSON path of the object, after the name of an included file.
    pub path: String,
    /// Kind of the object, with the name of a mesh.
    pub kind: String,
    /// The object.
    pub object: &'a Object,
    /// Rims and volume, if the object is a mesh.
    pub skin: Option<Skin>,
}

impl<'a> Subject<'a> {
    /// Pairs each object of a scene with its path in `texts`, which are those of `draft`.
    #[must_use]
    pub fn new(
        draft: &'a Draft<'_>,
        texts: &[SceneText<'a>],
        scene: &'a Scene,
        aspect: f64,
    ) -> Self {
        let mut subject = Self {
            scene,
            camera: &draft.file.camera,
            aspect,
            items: Vec::new(),
            lights: Vec::new(),
            materials: Vec::new(),
            textures: Vec::new(),
            texture_indices: HashMap::new(),
        };
        let mut objects = scene.objects.iter();
        let (mut pictures, mut solids) = (0.., 0..);
        for (number, text) in texts.iter().enumerate() {
            let own = number + 1 == texts.len();
            let file = if own { String::new() } else { format!("{}: ", text.document.file) };
            let lists = text.lists;
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
            for ((number, entry), object) in lists.objects.iter().enumerate().zip(&mut objects) {
                let kind = match entry {
                    ObjectFile::Mesh(mesh) => format!("mesh {}", mesh.name),
                    other @ (ObjectFile::Sphere(_)
                    | ObjectFile::Rectangle(_)
                    | ObjectFile::Plane(_)
                    | ObjectFile::Box(_)
                    | ObjectFile::Superquadric(_)) => other.kind().into(),
                };
                let path = format!("{file}objects[{number}].{}", entry.kind());
                let skin = object.shape.mesh().map(Skin::of);
                subject.items.push(Item { path, kind, object, skin });
            }
        }
        let textures = subject.textures.iter().enumerate();
        subject.texture_indices = textures.map(|(index, (texture, _))| (*texture, index)).collect();
        subject
    }

    /// Position of the camera.
    #[must_use]
    pub fn eye(&self) -> DVec3 {
        self.camera.eye.into()
    }

    /// Returns the name of a material. A material without a name comes from a material library.
    #[must_use]
    pub fn material_name(&self, material: usize) -> &str {
        self.materials.get(material).map_or("of its mtl", |[name, _]| name)
    }

    /// Returns the name of a texture. A texture without a name comes from a material library, or is that of
    /// the background.
    #[must_use]
    pub fn texture_name(&self, texture: SurfaceTexture) -> &str {
        let known = self.texture_indices.get(&texture).map(|&index| &self.textures[index]);
        let is_background = |index: usize| match &self.scene.background {
            Background::Picture(environment) => environment.texture == index,
            Background::Uniform(_) | Background::ByElevation(_) => false,
        };
        let unnamed = match texture {
            SurfaceTexture::Picture(index) if is_background(index) => "of the background",
            SurfaceTexture::Picture(_) | SurfaceTexture::Solid(_) => "of its mtl",
        };
        known.map_or(unnamed, |(_, [name, _])| name)
    }

    /// Returns the materials of an object.
    pub fn materials_of<'s>(&'s self, item: &'s Item<'_>) -> impl Iterator<Item = &'s Material> {
        item.object.parts.iter().map(|part| &self.scene.materials[part.material])
    }

    /// Returns whether light passes through some surface of an object.
    #[must_use]
    pub fn is_clear(&self, item: &Item<'_>) -> bool {
        self.materials_of(item).any(|material| material.transparency > 0.0)
    }

    /// Returns whether an object refracts light.
    #[must_use]
    pub fn bends(&self, item: &Item<'_>) -> bool {
        let bends = |material: &Material| {
            material.transparency > 0.0 && material.index_of_refraction != 1.0
        };
        self.materials_of(item).any(bends)
    }
}

impl Item<'_> {
    /// Returns the mesh, if the item is one.
    #[must_use]
    pub fn mesh(&self) -> Option<&Mesh> {
        self.object.shape.mesh()
    }
}
