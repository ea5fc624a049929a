//! Calibration: are requested errors reached, and do stated bounds hold?
//!
//! Pages, and random scenes that no threshold was chosen on, are rendered with several requests. The
//! true errors are those of all pixels by brute force.

pub mod measure;
mod page;
pub mod scenes;
mod summary;

pub use measure::SceneCases;
pub use page::page;
pub use summary::{Summary, by_request, interval};
