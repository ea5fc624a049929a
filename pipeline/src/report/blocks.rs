//! Distributes rays over the blocks of a picture, so that the fewest rays make the noise of the whole
//! picture small enough.

/// The noise measured in a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Block {
    /// Sum of the squared differences between two pictures over the pixels and channels of the block,
    /// in linear light.
    pub squares: f64,
    /// Rays along each side of a pixel, in each of the two pictures.
    pub samples: u32,
    /// Number of pixels.
    pub pixels: usize,
}

impl Block {
    /// Returns the expected squares with other samples. Squares fall in inverse proportion to the
    /// number of rays in a pixel, or faster.
    fn squares_with(&self, samples: u32) -> f64 {
        self.squares * (f64::from(self.samples) / f64::from(samples)).powi(2)
    }

    /// Returns the rays along each side of a pixel when an additional ray is worth `price`. The number
    /// of rays in the pixel is proportional to the standard deviation of a single ray. Never fewer than
    /// the block has; otherwise at most `most`.
    fn samples_at(&self, price: f64, most: u32) -> u32 {
        let deviation = f64::from(self.samples) * (self.squares / self.pixels as f64).sqrt();
        let wanted = (deviation * price).sqrt().ceil().min(f64::from(most));
        self.samples.max(wanted as u32)
    }
}

/// Returns for each block the rays along each side of a pixel, so that the expected squares of all
/// blocks together are at most `goal`. A block never gets fewer rays than it has, and at most `most`.
/// If `goal` cannot be reached, the result comes as near as possible.
#[must_use]
pub fn allot(blocks: &[Block], goal: f64, most: u32) -> Vec<u32> {
    let at = |price: f64| -> Vec<u32> {
        blocks.iter().map(|block| block.samples_at(price, most)).collect()
    };
    let squares = |samples: &[u32]| -> f64 {
        blocks.iter().zip(samples).map(|(block, &samples)| block.squares_with(samples)).sum()
    };
    if squares(&at(0.0)) <= goal {
        return at(0.0);
    }
    // The logarithm of the price lies between these bounds. 64 halvings find it to the last bit.
    let (mut low, mut high) = (-20.0_f64, 60.0_f64);
    for _ in 0..64 {
        let middle = 0.5 * (low + high);
        if squares(&at(middle.exp())) <= goal { high = middle } else { low = middle }
    }
    at(high.exp())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(squares: f64, pixels: usize) -> Block {
        Block { squares, samples: 8, pixels }
    }

    #[test]
    fn a_quiet_picture_is_left_as_it_is() {
        assert_eq!(allot(&[block(1.0, 256), block(0.0, 10)], 1.0, 64), [8, 8]);
    }

    #[test]
    fn the_goal_is_reached_where_it_can_be() {
        let blocks = [block(4.0, 256), block(1.0, 256), block(0.0, 256), block(1.0, 64)];
        let samples = allot(&blocks, 1.0, 256);
        let left = |samples: &[u32]| -> f64 {
            blocks.iter().zip(samples).map(|(block, &n)| block.squares_with(n)).sum()
        };
        assert!(left(&samples) <= 1.0, "{samples:?}");
        // One step back along every side misses the goal: no more rays are given than needed, up to
        // rounding.
        let fewer: Vec<u32> = samples.iter().map(|n| (n - 1).max(8)).collect();
        assert!(left(&fewer) > 1.0, "{samples:?}");
        // Twice the noise gets twice the rays, counted over both sides of a pixel. Blocks with equal
        // noise in each pixel get equal rays, and a block without noise gets none.
        assert!((f64::from(samples[0]).powi(2) / f64::from(samples[1]).powi(2) - 2.0).abs() < 0.3);
        assert!(samples[3] > samples[1] && samples[2] == 8, "{samples:?}");
    }

    #[test]
    fn what_cannot_be_reached_is_approached() {
        assert_eq!(allot(&[block(4.0, 256), block(0.0, 256)], 1e-9, 32), [32, 8]);
    }
}
