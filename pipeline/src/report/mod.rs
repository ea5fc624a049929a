//! Speed against error: what each way of rendering a page costs, and how wrong it is.

mod blocks;
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
pub mod regions;
mod sight;
mod table;
pub mod truth;
pub mod words;
mod write;

pub use measured::Measured;
pub use plan::Plan;
pub use write::{files, write};
