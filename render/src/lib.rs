//! A ray tracer whose textures are area sampled: a JSON scene and meshes to a picture.

pub mod accel;
pub mod color;
pub mod optics;
pub mod ray;
pub mod shape;
