//! The scene: what there is to see, checked and resolved. After it nothing fails on user input.

pub mod background;
pub mod camera;
pub mod check;
pub mod file;
pub mod light;
pub mod material;
pub mod mtl;
pub mod names;
pub mod obj;
pub mod ramp;
pub mod read;
pub mod schema;

pub use background::Background;
pub use camera::Camera;
pub use light::{DirectionalLight, Falloff, Light, PointLight};
pub use material::Material;
pub use names::Names;
pub use ramp::AngleRamp;
pub use read::{MeshSource, SceneError};

use crate::color::Color;
use crate::procedural::Procedural;
use crate::shape::Shape;
use crate::texture::Texture;
use glam::DAffine3;

/// Everything a picture is made from.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Where it is seen from.
    pub camera: Camera,
    /// What a ray sees that leaves the scene.
    pub background: Background,
    /// Light from everywhere.
    pub ambient: Color,
    /// Lights.
    pub lights: Vec<Light>,
    /// What surfaces are made of.
    pub materials: Vec<Material>,
    /// Pictures on surfaces.
    pub textures: Vec<Texture>,
    /// Textures that are computed.
    pub procedural: Procedural,
    /// The objects; a ray's hit counts in here.
    pub objects: Vec<Object>,
    /// How often a ray may be reflected or refracted.
    pub max_depth: u32,
    /// A ray that counts for less than this in its pixel is not followed.
    pub min_weight: f64,
    /// What the scene file calls its things.
    pub names: Names,
}

impl Scene {
    /// Memory of all texels, in bytes.
    #[must_use]
    pub fn texture_bytes(&self) -> u64 {
        self.textures.iter().map(Texture::bytes).sum()
    }

    /// Triangles of all meshes.
    #[must_use]
    pub fn triangles(&self) -> u64 {
        let meshes = self.objects.iter().filter_map(|object| match &object.shape {
            Shape::Mesh(mesh) => Some(mesh.triangles.len() as u64),
            _ => None,
        });
        meshes.sum()
    }

    /// Which textures some surface shows.
    #[must_use]
    pub fn shown_textures(&self) -> Vec<bool> {
        let mut shown = vec![false; self.textures.len()];
        for surface in self.objects.iter().flat_map(|object| &object.parts) {
            if let Some(texture) = surface.picture()
                && self.materials[surface.material].shows_color()
            {
                shown[texture] = true;
            }
        }
        shown
    }
}

/// A shape and what its surfaces look like.
#[derive(Debug, Clone)]
pub struct Object {
    /// Its shape.
    pub shape: Shape,
    /// Its surfaces: one, or for a mesh one for each name that `usemtl` gave, or six alike for a
    /// box, each a textured area by itself.
    pub parts: Vec<Surface>,
    /// From the scene's space to the one that the object was described in: what is solid in the
    /// object, such as marble, is looked up there and moves with it.
    pub to_own_space: DAffine3,
}

/// What a surface looks like; indices into the scene's lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Surface {
    /// What it is made of.
    pub material: usize,
    /// The picture on it, or what it is carved from.
    pub texture: Option<SurfaceTexture>,
}

/// A texture of a surface; an index into one of the scene's lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SurfaceTexture {
    /// A picture on it, of the scene's `textures`: averaged over what a pixel sees.
    Picture(usize),
    /// What it is carved from, of the scene's `procedural.solids`: looked up at a point.
    Solid(usize),
}

impl Surface {
    /// The picture on it, if it has one.
    #[must_use]
    pub fn picture(&self) -> Option<usize> {
        match self.texture {
            Some(SurfaceTexture::Picture(index)) => Some(index),
            Some(SurfaceTexture::Solid(_)) | None => None,
        }
    }

    /// The solid it is carved from, if there is one.
    #[must_use]
    pub fn solid(&self) -> Option<usize> {
        match self.texture {
            Some(SurfaceTexture::Solid(index)) => Some(index),
            Some(SurfaceTexture::Picture(_)) | None => None,
        }
    }
}
