//! Renders the truth, the picture with which all others are compared, with a great many unfiltered
//! rays.
//!
//! Each pixel is made of `n * n` jittered rays. The truth uses none of the filters that are judged, but
//! many rays instead. The truth is rendered twice, with two seeds ([`Pair`]). Half the difference
//! between the two pictures is the noise of their mean.
//!
//! Where the noise is too large, blocks of the picture are rendered again with more rays, the noisiest
//! block with the most (`blocks.rs` allots them). Only the pictures that are thrown away decide which
//! blocks these are, so the new blocks are as unbiased as the first.

use super::blocks::{Block, allot};
use crate::truth::Pair;
use render::film::Crop;
use render::{Picture, Prepared};

/// Side of a block in pixels.
const SIDE: u32 = 16;

/// A pair of pictures whose blocks can be rendered again with more rays.
#[derive(Debug, Clone)]
pub struct Refined {
    pair: Pair,
    /// The blocks of the picture, each with its rays along each side of a pixel.
    blocks: Vec<(Crop, u32)>,
}

impl Refined {
    /// Renders both pictures with `samples * samples` rays in each pixel, with `samples` at most
    /// [`render::film::MOST_SAMPLES`]. `progress` is called with the work done so far and the total.
    ///
    /// Runs on the threads of the current rayon pool. The result is the same for any number of threads.
    #[must_use]
    pub fn render(
        scene: &Prepared<'_>,
        (width, height): (u32, u32),
        samples: u32,
        progress: &(dyn Fn(usize, usize) + Sync),
    ) -> Self {
        let whole = Crop::whole(width, height);
        let pair = Pair::render(scene, (width, height), whole, samples, progress);
        let blocks = whole.tiles(SIDE).into_iter();
        Self { pair, blocks: blocks.map(|block| (block, samples)).collect() }
    }

    /// Returns the mean of both pictures.
    #[must_use]
    pub fn mean(&self) -> Picture {
        self.pair.mean()
    }

    /// Returns the root mean square difference between both pictures, in linear light. The mean is over
    /// all channels of the pixels for which `mask` is true, or of all pixels. 0 if there are no such
    /// pixels.
    #[must_use]
    pub fn difference(&self, mask: Option<&[bool]>) -> f64 {
        let set = |k: &usize| mask.is_none_or(|mask| mask[*k]);
        let places: Vec<usize> = (0..self.pair.pictures[0].pixels.len()).filter(set).collect();
        let squares: f64 = places.iter().map(|&k| self.square(k)).sum();
        (squares / (3 * places.len()).max(1) as f64).sqrt()
    }

    /// Returns about the root mean square error of the mean of both pictures, over the pixels of `mask`
    /// as in [`Refined::difference`].
    #[must_use]
    pub fn noise(&self, mask: Option<&[bool]>) -> f64 {
        0.5 * self.difference(mask)
    }

    /// Returns the fewest and the most rays along each side of a pixel, over all blocks.
    #[must_use]
    pub fn samples(&self) -> (u32, u32) {
        let all = || self.blocks.iter().map(|(_, samples)| *samples);
        (all().min().unwrap_or(0), all().max().unwrap_or(0))
    }

    /// Renders blocks again with more rays, so that the expected root mean square difference of the
    /// whole is at most `goal`. A pixel gets at most `most` rays along each side. Returns whether any
    /// block was rendered.
    pub fn refine(
        &mut self,
        scene: &Prepared<'_>,
        goal: f64,
        most: u32,
        progress: &(dyn Fn(usize, usize) + Sync),
    ) -> bool {
        let Picture { width, height, .. } = self.pair.pictures[0];
        let values = 3.0 * self.pair.pictures[0].pixels.len() as f64;
        let measured: Vec<Block> = self.blocks.iter().map(|block| self.measured(*block)).collect();
        let allotted = allot(&measured, goal * goal * values, most);
        let rays = |block: Crop, samples: u32| {
            block.width as usize * block.height as usize * (samples * samples) as usize
        };
        let more = || self.blocks.iter().zip(&allotted).filter(|((_, has), gets)| *gets > has);
        let total: usize = more().map(|((block, _), gets)| rays(*block, *gets)).sum();
        let anew: Vec<(Crop, u32)> = more().map(|((block, _), gets)| (*block, *gets)).collect();
        let mut done = 0;
        for &(block, samples) in &anew {
            let anew = Pair::render(scene, (width, height), block, samples, &|_, _| {});
            for (picture, part) in self.pair.pictures.iter_mut().zip(&anew.pictures) {
                paste(picture, block, part);
            }
            done += rays(block, samples);
            progress(done, total);
        }
        for ((_, samples), gets) in self.blocks.iter_mut().zip(allotted) {
            *samples = gets;
        }
        !anew.is_empty()
    }

    fn measured(&self, (block, samples): (Crop, u32)) -> Block {
        let width = self.pair.pictures[0].width;
        let places =
            block.rows().flat_map(|y| block.columns().map(move |x| (y * width + x) as usize));
        let squares = places.map(|place| self.square(place)).sum();
        Block { squares, samples, pixels: block.width as usize * block.height as usize }
    }

    /// Returns the sum of the squared differences of a pixel's channels.
    fn square(&self, place: usize) -> f64 {
        let [a, b] = &self.pair.pictures;
        let pairs = a.pixels[place].iter().zip(&b.pixels[place]);
        pairs.map(|(a, b)| (f64::from(*a) - f64::from(*b)).powi(2)).sum()
    }
}

/// Copies a part into the picture at its position.
fn paste(picture: &mut Picture, place: Crop, part: &Picture) {
    for (y, row) in place.rows().zip(part.pixels.chunks_exact(place.width as usize)) {
        let start = (y * picture.width + place.x) as usize;
        picture.pixels[start..start + row.len()].copy_from_slice(row);
    }
}

#[cfg(test)]
mod tests {
    use super::super::board;
    use super::*;

    const SIZE: u32 = 20;

    fn error(pair: &Refined) -> f64 {
        let (mean, exact) = (pair.mean(), board::exact(SIZE));
        let pixels = mean.pixels.iter().flatten().zip(exact.pixels.iter().flatten());
        let squares: f64 = pixels.map(|(a, b)| f64::from(a - b).powi(2)).sum();
        (squares / f64::from(3 * SIZE * SIZE)).sqrt()
    }

    #[test]
    fn the_noise_is_about_the_error() {
        let scene = board::scene();
        for samples in [4, 16, 32] {
            let pair = Refined::render(&Prepared::new(&scene), (SIZE, SIZE), samples, &|_, _| {});
            let (noise, error) = (pair.noise(None), error(&pair));
            // A third of the 400 pixels cut no border and have no noise. Each of the others contributes
            // one random square, so error and noise are both known to about a tenth.
            assert!(error > 0.6 * noise && error < 1.6 * noise, "{samples}: {error}, {noise}");
            assert!(noise < 0.2 / f64::from(samples), "{samples}: {noise}");
        }
    }

    #[test]
    fn more_rays_go_where_the_noise_is_until_it_is_small_enough() {
        let scene = board::scene();
        let mut pair = Refined::render(&Prepared::new(&scene), (SIZE, SIZE), 4, &|_, _| {});
        let (before, first) = (pair.difference(None), error(&pair));
        let goal = 0.25 * before;
        assert!(pair.refine(&Prepared::new(&scene), goal, 64, &|_, _| {}));
        let after = pair.difference(None);
        // At borders, noise falls faster than the law by which rays are allotted.
        assert!(after <= 1.1 * goal, "{before} to {after}");
        assert!(error(&pair) < 0.5 * first);
        assert!(pair.samples().0 >= 4 && pair.samples().1 <= 64);
        assert!(
            !pair.refine(&Prepared::new(&scene), before, 64, &|_, _| {}),
            "there is nothing left to do"
        );
    }

    #[test]
    fn masks_choose_pixels() {
        let pair = Refined::render(&Prepared::new(&board::scene()), (SIZE, SIZE), 2, &|_, _| {});
        let count = (SIZE * SIZE) as usize;
        let left: Vec<bool> = (0..count).map(|k| k % (SIZE as usize) < 5).collect();
        let right: Vec<bool> = left.iter().map(|set| !set).collect();
        let squares = 0.25 * pair.difference(Some(&left)).powi(2)
            + 0.75 * pair.difference(Some(&right)).powi(2);
        assert!((squares.sqrt() - pair.difference(None)).abs() < 1e-12);
        assert_eq!(pair.difference(Some(&vec![false; count])), 0.0);
    }
}
