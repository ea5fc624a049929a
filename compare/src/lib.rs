//! Measures the difference between two pictures, in linear light where white is 1.
//!
//! [`read`] reads the pictures from PNG and EXR files. [`Difference`] holds their errors as numbers,
//! [`ssim`] computes their structural similarity, and [`mod@map`] draws where they differ, in the colours
//! of a [`Scale`].
//!
//! ```
//! use compare::Difference;
//! use render::Picture;
//!
//! let dark = Picture::black(4, 3);
//! let mut light = dark.clone();
//! light.pixels.fill([0.5; 3]);
//! let found = Difference::between(&light, &dark, None)?;
//! assert_eq!((found.rmse, found.max, found.bias), (0.5, 0.5, 0.5));
//! # Ok::<(), compare::CompareError>(())
//! ```

pub mod difference;
pub mod error;
mod layer;
pub mod map;
pub mod read;
pub mod scale;
pub mod ssim;

pub use difference::Difference;
pub use error::CompareError;
pub use scale::Scale;
