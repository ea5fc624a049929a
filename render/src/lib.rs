//! A ray tracer with area sampled textures: it renders a JSON scene and meshes to a picture.
//!
//! Each stage of the work is a module, and no stage uses a later one:
//!
//! ```text
//!   scene -> accel -> trace -> footprint -> filter -> shade -> film -> picture file
//! ```
//!
//! [`scene`] reads and checks all input, so that no later stage fails on user input. [`accel`]
//! finds hits. [`trace`] turns a position on the film into an intersection tree. [`footprint`]
//! compares a node of the tree with its neighbours and determines the part of the texture that the
//! pixel sees. [`filter`] averages the texture over that part. [`procedural`] computes solid
//! textures and bumps. [`shade`] turns trees into colours. [`prepared`] keeps the data that all
//! pictures of a scene share. [`film`] makes pictures. [`film::render`] runs all stages,
//! [`accuracy`] measures the error of a picture and makes pictures of a requested error, and
//! [`inspect`] prints one pixel in detail.

pub mod accel;
pub mod accuracy;
pub mod color;
pub mod differential;
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
