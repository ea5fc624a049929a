//! Equal bins for the middles of boxes, by which the tree's builder finds a cut.

use glam::Vec4;

/// Bins along each axis for parts of more than [`FEW`] boxes. More bins take longer and hardly find
/// better cuts.
pub const MOST_BINS: usize = 32;

/// Bins along each axis for smaller parts. If larger, most of the time is spent on empty bins.
const FEW_BINS: usize = 16;

/// Parts of more boxes get [`MOST_BINS`].
const FEW: usize = 1024;

/// Equal bins along each axis.
#[derive(Debug, Clone, Copy)]
pub struct Bins {
    /// Number of bins along each axis.
    pub count: usize,
    low: Vec4,
    /// Bins per unit of length, along each axis; 0 where all middles coincide.
    scale: Vec4,
}

impl Bins {
    /// The bins for a part of `boxes` boxes.
    #[must_use]
    pub fn new([low, high]: [Vec4; 2], boxes: usize) -> Self {
        let count = if boxes > FEW { MOST_BINS } else { FEW_BINS };
        let scale = (high - low).to_array().map(|size| {
            let scale = (count as f32 - 1.0) * (1.0 - 4.0 * f32::EPSILON) / size;
            if size > 0.0 && scale.is_finite() { scale } else { 0.0 }
        });
        Self { count, low, scale: Vec4::from_array(scale) }
    }

    /// Returns the bin along each axis. Bins round to the nearest number: in the sum with 2^23 the
    /// last bits are those of the rounded number.
    #[must_use]
    #[inline]
    pub fn of(&self, middle: Vec4) -> [usize; 3] {
        let place = (middle - self.low) * self.scale + 8_388_608.0;
        let bin = |place: f32| place.to_bits() as usize & (MOST_BINS - 1);
        [bin(place.x), bin(place.y), bin(place.z)]
    }

    /// Returns the bin along one axis.
    #[must_use]
    #[inline]
    pub fn of_axis(&self, middle: Vec4, axis: usize) -> usize {
        let place = (middle[axis] - self.low[axis]) * self.scale[axis] + 8_388_608.0;
        place.to_bits() as usize & (MOST_BINS - 1)
    }
}
