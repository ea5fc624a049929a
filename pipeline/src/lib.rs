//! `sweep`, `triangulate` and `render` in one process, and the picture book.
//!
//! A [`Job`] names curve specs, the texture ids of their surfaces, a scene, and the modes in which
//! it is rendered. [`run()`] runs a job. Grids and meshes pass in memory, as the same numbers that
//! the three programs pass through pipes, so the pictures are equal byte for byte. The jobs in
//! [`pages`] are built into the program, and [`mod@book`] shows them. [`mod@report`] measures what
//! each method of rendering a page costs, and how far its picture is from the truth.
//!
//! A built-in page, and the meshes that its job makes:
//!
//! ```
//! let job = pipeline::pages::page("vase")?;
//! assert_eq!(job.meshes[0].name, "vase");
//! let last = job.modes.last().expect("a job has a mode");
//! assert_eq!(last.name, "exact");
//! # Ok::<(), pipeline::PipelineError>(())
//! ```

pub mod animation;
pub mod book;
pub mod calibrate;
pub mod cli;
mod coding;
pub mod collected;
pub mod contact_sheet;
pub mod error;
pub mod farm;
pub mod fineness;
pub mod html;
pub mod job;
pub mod mesh;
pub mod number;
pub mod pages;
pub mod report;
pub mod run;
pub mod settings;
pub mod show;
pub mod stages;
pub mod start;
#[cfg(feature = "studio")]
pub mod studio;
pub mod truth;

pub use error::PipelineError;
pub use job::Job;
pub use run::run;
