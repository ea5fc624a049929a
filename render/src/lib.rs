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
//! [`showcase`] makes the scene of a mesh that has none,
//! [`accuracy`] measures the error of a picture and makes pictures of a requested error, and
//! [`inspect`] prints one pixel in detail.
//!
//! A scene without files, rendered to pixels in linear light:
//!
//! ```
//! use files::{Disk, json::Document};
//! use render::{Prepared, Settings, filter::Filter, scene::MeshSource, scene::read};
//! use std::path::Path;
//!
//! let text = br#"{ "format": "tb-scene", "version": 1, "background": 0.25,
//!     "camera": { "eye": [0, 0, 5], "target": [0, 0, 0], "fov_deg": 40 }, "ambient": 1,
//!     "materials": { "white": { "diffuse": 0 } },
//!     "objects": [{ "sphere": { "center": [0, 0, 0], "radius": 1, "material": "white" } }] }"#;
//! let document = Document::new("ball.json", text)?;
//! let file = read::parse(&document)?;
//! let scene = read::resolve(&document, &file, Path::new(""), &Disk, MeshSource::new())?;
//! let settings = Settings::new(9, 9, Filter::Exact);
//! let (picture, _) = render::render(&Prepared::new(&scene), &settings, &|_, _| {});
//! assert_eq!(picture.pixels[0], [0.25; 3], "a corner shows the background");
//! assert_eq!(picture.pixels[40], [1.0; 3], "the middle shows the sphere");
//! # Ok::<(), render::scene::SceneError>(())
//! ```

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
pub mod showcase;
pub mod stats;
pub mod stock;
pub mod texture;
pub mod trace;

pub use film::{Picture, Sampling, Settings, render};
pub use prepared::Prepared;
pub use scene::Scene;
pub use stock::Stock;
