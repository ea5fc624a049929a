//! Measures the difference between two pictures, in linear light where white is 1.
//!
//! [`read`] reads the pictures from PNG and EXR files. [`Difference`] holds their errors as numbers,
//! [`ssim`] computes their structural similarity, and [`mod@map`] draws where they differ, in the colours
//! of a [`Scale`].

pub mod difference;
pub mod error;
pub mod map;
pub mod read;
pub mod scale;
pub mod ssim;

pub use difference::Difference;
pub use error::CompareError;
pub use scale::Scale;
