//! Speed against error: what each way of rendering a page costs, and how wrong it is.

mod document;
#[cfg(test)]
mod fixture;
pub mod measured;
mod method;
pub mod pareto;
pub mod plot;
mod table;
pub mod words;
mod write;

pub use measured::Measured;
pub use write::{files, write};
