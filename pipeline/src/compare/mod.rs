//! Compares two pictures: differences in numbers, and an error map.

pub mod difference;
pub mod error;
pub mod map;
pub mod read;
pub mod scale;
pub mod ssim;

pub use difference::Difference;
pub use error::CompareError;
pub use scale::Scale;
