//! Measures speed against error: what each method of rendering a page costs, and how wrong its picture
//! is.
//!
//! [`measure`] renders a page by the methods of a [`Plan`] and compares the pictures with the
//! [`refined`] truth, as a whole and by [`regions`]. [`accompanying`] measures the modeler and the
//! filters separately. [`Measured`] holds the results, and [`write()`] turns the results into words,
//! plots and pages.

pub mod accompanying;
mod blocks;
#[cfg(test)]
mod board;
pub mod csv;
mod document;
#[cfg(test)]
mod fixture;
pub mod measure;
pub mod measured;
mod method;
pub mod pareto;
pub mod plan;
pub mod plot;
pub mod refined;
pub mod regions;
mod sight;
mod table;
pub mod words;
mod write;

pub use measured::Measured;
pub use plan::Plan;
pub use write::{files, write};
