//! How far one picture is from another.

pub mod difference;
pub mod error;

pub use difference::Difference;
pub use error::CompareError;
