//! The scene: camera, lights, materials, textures and objects, checked and resolved.
//!
//! [`read`] is the only stage that fails on user input. All names are indices afterwards, and all
//! numbers are in their ranges.

pub mod background;
pub mod camera;
pub mod check;
pub mod file;
pub mod light;
pub mod limits;
pub mod material;
pub mod mesh_file;
pub mod mtl;
pub mod names;
pub mod obj;
pub mod ramp;
pub mod read;
pub mod schema;
pub mod text;

pub use background::{Background, Environment};
pub use camera::Camera;
pub use light::{DirectionalLight, Falloff, Light, PointLight, SpotLight};
pub use material::{Material, VertexColors};
pub use names::Names;
pub use ramp::AngleRamp;
pub use read::{MeshSource, SceneError};

use crate::color::Color;
use crate::procedural::Procedural;
use crate::shape::Shape;
use crate::texture::Texture;
use files::check::Finding;
use glam::DAffine3;
use std::collections::HashSet;

/// Everything from which a picture is rendered. Lengths are in the scene's unit, colours are linear
/// RGB, and axes are right-handed.
#[derive(Debug, Clone)]
pub struct Scene {
    /// The camera.
    pub camera: Camera,
    /// Colours of rays that leave the scene.
    pub background: Background,
    /// True if picture files show the background as transparent.
    pub is_transparent: bool,
    /// Ambient light, which comes from all directions; each channel at least 0.
    pub ambient: Color,
    /// Lights with a position or a direction.
    pub lights: Vec<Light>,
    /// Materials; surfaces refer to them by index.
    pub materials: Vec<Material>,
    /// Pictures on surfaces; surfaces refer to them by index.
    pub textures: Vec<Texture>,
    /// Solid textures and bumps, which are computed.
    pub procedural: Procedural,
    /// The objects. [`Piece::object`](crate::ray::Piece::object) is an index into this list.
    pub objects: Vec<Object>,
    /// Largest number of reflections and refractions of a ray, 0 to [`limits::DEEPEST`].
    pub max_depth: u32,
    /// Smallest weight in its pixel with which a ray is followed, in `[0, 1]`.
    pub min_weight: f64,
    /// Names of the scene file, for messages and reports.
    pub names: Names,
    /// One remark for each of the scene's files of which something is not used, or is used with another
    /// meaning than it states.
    pub remarks: Vec<Finding>,
}

impl Scene {
    /// Memory of all texels, in bytes.
    #[must_use]
    pub fn texture_bytes(&self) -> u64 {
        self.textures.iter().map(Texture::bytes).sum()
    }

    /// Number of triangles of all meshes together. A mesh that several objects share counts once.
    #[must_use]
    pub fn triangles(&self) -> u64 {
        let mut known = HashSet::new();
        let shapes = self.objects.iter().map(|object| &object.shape);
        let stored = shapes.filter(|shape| match shape {
            Shape::Instance(instance) => known.insert(instance.key()),
            _ => true,
        });
        stored.filter_map(Shape::mesh).map(|mesh| mesh.triangles.len() as u64).sum()
    }

    /// Returns whether some picture cuts out surfaces.
    #[must_use]
    pub fn has_masks(&self) -> bool {
        self.textures.iter().any(|texture| texture.mask.is_some())
    }

    /// Returns the number of the placement of an instance, from 0, among the objects that follow one
    /// another and share its mesh. Returns `None` for an object that is no instance.
    #[must_use]
    pub fn placement(&self, object: usize) -> Option<usize> {
        let key = |object: &Object| match &object.shape {
            Shape::Instance(instance) => Some(instance.key()),
            _ => None,
        };
        let own = key(self.objects.get(object)?)?;
        let before = self.objects[..object].iter().rev();
        Some(before.take_while(|object| key(object) == Some(own)).count())
    }

    /// Returns for each of `textures` whether some surface or the background shows it.
    #[must_use]
    pub fn shown_textures(&self) -> Vec<bool> {
        let mut shown = vec![false; self.textures.len()];
        for surface in self.objects.iter().flat_map(|object| &object.parts) {
            if let Some(texture) = surface.picture() {
                let shows = self.materials[surface.material].shows_color();
                shown[texture] |= shows || self.textures[texture].mask.is_some();
            }
        }
        if let Background::Picture(environment) = &self.background {
            shown[environment.texture] = true;
        }
        shown
    }
}

/// A shape and the appearance of its surfaces.
#[derive(Debug, Clone)]
pub struct Object {
    /// The shape, in scene space.
    pub shape: Shape,
    /// The object's surfaces, of which each is a textured area of its own: one for each name that
    /// `usemtl` gave in a mesh, six equal surfaces of a box, and one surface of any other shape.
    pub parts: Vec<Surface>,
    /// Map from scene space to the space in which the object was described. Solid textures are
    /// evaluated there, so that they move with the object.
    pub to_own_space: DAffine3,
}

/// The appearance of a surface, as indices into the scene's lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Surface {
    /// Index into the scene's `materials`.
    pub material: usize,
    /// The picture on the surface, or the solid from which the object is carved.
    pub texture: Option<SurfaceTexture>,
}

/// A texture of a surface; an index into one of the scene's lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SurfaceTexture {
    /// Index into the scene's `textures`: a picture, averaged over the part that a pixel sees.
    Picture(usize),
    /// Index into the scene's `procedural.solids`: a solid, evaluated at a point.
    Solid(usize),
}

impl Surface {
    /// The mask that cuts out the surface, if there is one.
    #[must_use]
    pub fn mask<'a>(&self, scene: &'a Scene) -> Option<&'a Texture> {
        scene.textures[self.picture()?].mask.as_deref()
    }

    /// Index of the picture on the surface, if there is one.
    #[must_use]
    pub fn picture(&self) -> Option<usize> {
        match self.texture {
            Some(SurfaceTexture::Picture(index)) => Some(index),
            Some(SurfaceTexture::Solid(_)) | None => None,
        }
    }

    /// Index of the solid from which the object is carved, if there is one.
    #[must_use]
    pub fn solid(&self) -> Option<usize> {
        match self.texture {
            Some(SurfaceTexture::Solid(index)) => Some(index),
            Some(SurfaceTexture::Picture(_)) | None => None,
        }
    }
}
