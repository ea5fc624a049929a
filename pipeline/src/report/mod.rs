//! Speed against error: what each way of rendering a page costs, and how wrong it is.

#[cfg(test)]
mod fixture;
pub mod measured;
mod method;
pub mod pareto;
pub mod plot;
mod table;
pub mod words;

pub use measured::Measured;
