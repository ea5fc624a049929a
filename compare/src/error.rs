//! Reasons why two pictures cannot be compared.

use files::{Exit, Failure};
use render::Picture;
use thiserror::Error;

/// A reason why two pictures in memory cannot be compared.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum CompareError {
    /// The pictures differ in size.
    #[error("the first picture is {}x{} and the second {}x{}: expected the same size", first.0, first.1, second.0, second.1)]
    Sizes {
        /// Width and height of the first picture, in pixels.
        first: (u32, u32),
        /// Width and height of the second picture, in pixels.
        second: (u32, u32),
    },
    /// The mask is not of the pictures' size.
    #[error("found a mask of {found} pixels, expected {expected}")]
    Mask {
        /// Number of pixels of the mask.
        found: usize,
        /// Number of pixels of each picture.
        expected: usize,
    },
    /// There are no pixels to compare, so no mean can be taken.
    #[error("found no pixels to compare, expected at least one")]
    NoPixels,
    /// A pixel is NaN or infinite.
    #[error("pixel {},{} of the {picture} picture is {value} in channel {channel}: expected a finite number", place.0, place.1)]
    NotFinite {
        /// `first` or `second`.
        picture: &'static str,
        /// Column and row, from 0.
        place: (u32, u32),
        /// The channel: 0 red, 1 green, 2 blue.
        channel: usize,
        /// The value of the channel.
        value: f32,
    },
}

impl Failure for CompareError {
    fn exit(&self) -> Exit {
        match self {
            Self::Sizes { .. } | Self::Mask { .. } | Self::NoPixels => Exit::Use,
            Self::NotFinite { .. } => Exit::Malformed,
        }
    }
}

/// Checks that two pictures have the same size and at least one pixel.
pub(crate) fn check_sizes(first: &Picture, second: &Picture) -> Result<(), CompareError> {
    let sizes = [first, second].map(|picture| (picture.width, picture.height));
    if sizes[0] != sizes[1] {
        return Err(CompareError::Sizes { first: sizes[0], second: sizes[1] });
    }
    if first.pixels.is_empty() {
        return Err(CompareError::NoPixels);
    }
    Ok(())
}

/// Checks that the three channels of a pixel are finite.
pub(crate) fn check_finite(
    picture: &'static str,
    width: u32,
    index: usize,
    pixel: &[f32; 3],
) -> Result<(), CompareError> {
    match pixel.iter().position(|light| !light.is_finite()) {
        None => Ok(()),
        Some(channel) => Err(CompareError::NotFinite {
            picture,
            place: place(width, index),
            channel,
            value: pixel[channel],
        }),
    }
}

/// Returns column and row, from 0, of the pixel with an index.
pub(crate) fn place(width: u32, index: usize) -> (u32, u32) {
    let width = width as usize;
    ((index % width) as u32, (index / width) as u32)
}
