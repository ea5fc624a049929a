//! How far one picture is from another.

pub mod difference;

pub use difference::Difference;
