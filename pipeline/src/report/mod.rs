//! Speed against error: what each way of rendering a page costs, and how wrong it is.

mod blocks;
pub mod csv;
pub mod measure;
pub mod measured;
pub mod plan;
pub mod truth;
pub mod regions;
mod sight;

pub use measured::Measured;
pub use plan::Plan;
