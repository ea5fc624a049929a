//! Speed against error: what each way of rendering a page costs, and how wrong it is.

pub mod measured;
pub mod regions;
mod sight;

pub use measured::Measured;
