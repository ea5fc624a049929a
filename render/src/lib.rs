//! A ray tracer whose textures are area sampled: a JSON scene and meshes to a picture.
//!
//! The road of a ray, one room each, no room looking back:
//!
//! ```text
//!   scene -> accel -> trace -> footprint -> filter -> shade -> film -> picture file
//! ```
//!
//! [`scene`] reads and checks everything, so that nothing after it fails on user input. [`accel`]
//! finds hits. [`trace`] turns a place on the film into an intersection tree. [`footprint`] looks at
//! a node of it and at its neighbours and says which piece of texture the pixel sees. [`filter`]
//! averages a texture over that piece. [`procedural`] computes textures that are no pictures, and
//! bumps. [`shade`] turns trees into colours. [`prepared`] keeps what all pictures of a scene share, and
//! [`film`] makes pictures. [`film::render`] does it all, and [`inspect`] prints what one pixel is made of.

pub mod accel;
pub mod color;
pub mod film;
pub mod filter;
pub mod footprint;
pub mod inspect;
pub mod optics;
pub mod prepared;
pub mod procedural;
pub mod ray;
pub mod scene;
pub mod shade;
pub mod shape;
pub mod stats;
pub mod texture;
pub mod trace;

pub use film::{Picture, Sampling, Settings, render};
pub use prepared::Prepared;
pub use scene::Scene;
