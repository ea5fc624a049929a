//! Speed against error: what each way of rendering a page costs, and how wrong it is.

pub mod measured;

pub use measured::Measured;
