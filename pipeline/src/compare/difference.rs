//! Errors of a picture, in linear light.

use serde::Serialize;

/// How far the pixels of one picture, or of a part of it, are from those of another, in linear light
/// where white is 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Difference {
    /// Pixels compared.
    pub pixels: usize,
    /// Root mean square over all pixels and the three channels.
    pub rmse: f64,
    /// The largest difference in any channel of any pixel.
    pub max: f64,
    /// What the largest difference among the channels of a pixel does not exceed in 99.9 % of the pixels.
    pub p999: f64,
    /// The mean of first minus second over pixels and channels: brighter if above 0.
    pub bias: f64,
}
