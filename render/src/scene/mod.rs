//! The scene: what there is to see, checked and resolved. After it nothing fails on user input.

pub mod camera;
pub mod file;
pub mod light;
pub mod material;
pub mod obj;
pub mod ramp;
pub mod read;

pub use camera::Camera;
pub use light::{DirectionalLight, Falloff, Light, PointLight};
pub use material::Material;
pub use ramp::AngleRamp;
pub use read::{MeshSource, SceneError};

use crate::color::Color;
use crate::shape::Shape;
use crate::texture::Texture;
use glam::DAffine3;

/// Everything a picture is made from.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Where it is seen from.
    pub camera: Camera,
    /// What a ray sees that leaves the scene.
    pub background: Color,
    /// Light from everywhere.
    pub ambient: Color,
    /// Lights.
    pub lights: Vec<Light>,
    /// What surfaces are made of.
    pub materials: Vec<Material>,
    /// Pictures on surfaces.
    pub textures: Vec<Texture>,
    /// The objects; a ray's hit counts in here.
    pub objects: Vec<Object>,
    /// How often a ray may be reflected or refracted.
    pub max_depth: u32,
    /// A ray that counts for less than this in its pixel is not followed.
    pub min_weight: f64,
}

/// A shape and what its surfaces look like.
#[derive(Debug, Clone)]
pub struct Object {
    /// Its shape.
    pub shape: Shape,
    /// Its surfaces: one, or for a mesh one for each name that `usemtl` gave.
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
    /// The picture on it.
    pub texture: Option<usize>,
}
