//! Speed against error: what each way of rendering a page costs, and how wrong it is.
//!
//! [`measure`] renders a page by the methods of a [`Plan`] and holds the pictures against the
//! [`refined`] truth, whole and by [`regions`]; [`accompanying`] measures the modeler and the filters by
//! themselves. [`Measured`] is what comes of it, and [`write()`] makes words, plots and pages of that.

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
