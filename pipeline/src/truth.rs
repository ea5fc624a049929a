//! Renders reference pictures ("truths") and measures the errors of other pictures against them.
//!
//! The truth is rendered with many jittered rays in each pixel, which interpolate textures without
//! a filter. The truth consists of two pictures `a` and `b` of two seeds, whose noise is
//! independent. Therefore the mean of `(x - a)(x - b)` is the mean square of `x - truth` for any
//! picture `x`, and even a few rays give an unbiased measure. Against `a` alone, or against the
//! mean of both, the noise of the truth would be counted as an error of `x`.

use render::film::{Crop, Pattern, PixelFilter};
use render::filter::Filter;
use render::{Picture, Prepared, Sampling, Settings, render};

/// The seeds of the two pictures.
const SEEDS: [u64; 2] = [1, 2];

/// Two pictures of one scene, rendered with two seeds.
#[derive(Debug, Clone)]
pub struct Pair {
    /// Pixels of both pictures, row by row, linear RGB.
    pub pictures: [Picture; 2],
}

impl Pair {
    /// Renders the part `crop` of a picture of `width` x `height` pixels twice. Each pixel gets
    /// `samples * samples` rays, with `samples` at most [`render::film::MOST_SAMPLES`]. `progress` is
    /// called with the work done so far and the total.
    ///
    /// Runs on the threads of the current rayon pool. The result is the same for any number of threads.
    #[must_use]
    pub fn render(
        scene: &Prepared<'_>,
        (width, height): (u32, u32),
        crop: Crop,
        samples: u32,
        progress: &(dyn Fn(usize, usize) + Sync),
    ) -> Self {
        let settings = Settings::new(width, height, Filter::Bilinear);
        Self::of(scene, &Settings { crop: Some(crop), ..settings }, samples, progress)
    }

    /// Renders pictures as [`Pair::render`] does, with the size, the part and the camera of these settings. Filter and
    /// sampling are replaced.
    #[must_use]
    pub fn of(
        scene: &Prepared<'_>,
        settings: &Settings,
        samples: u32,
        progress: &(dyn Fn(usize, usize) + Sync),
    ) -> Self {
        let mut half = 0;
        let pictures = SEEDS.map(|seed| {
            let pattern = Pattern::Jitter { seed };
            let sampling = Sampling::Grid { samples, pattern, pixel_filter: PixelFilter::Box };
            let settings = Settings { sampling, filter: Filter::Bilinear, ..settings.clone() };
            let (picture, _) = render(scene, &settings, &|done, total| {
                progress(half * total + done, 2 * total);
            });
            half += 1;
            picture
        });
        Self { pictures }
    }

    /// Returns the mean of both pictures.
    #[must_use]
    pub fn mean(&self) -> Picture {
        let [first, second] = &self.pictures;
        let pairs = first.pixels.iter().zip(&second.pixels);
        let mean = |(a, b): (&[f32; 3], &[f32; 3])| std::array::from_fn(|k| 0.5 * (a[k] + b[k]));
        Picture { pixels: pairs.map(mean).collect(), ..first.clone() }
    }

    /// Returns the root mean square error of a picture of the same size, in linear light (white is 1). The
    /// mean is over the three channels of the pixels whose index `among` accepts. Returns `None` if `among`
    /// accepts no pixel.
    ///
    /// The noise of the truth hides small errors. A mean square below its own standard error counts as
    /// this standard error, so that no error is reported as 0 only because noise hides it.
    #[must_use]
    pub fn error_of(&self, picture: &Picture, among: impl Fn(usize) -> bool) -> Option<f64> {
        let [first, second] = &self.pictures;
        let (mut sum, mut squares, mut count) = (0.0, 0.0, 0_u32);
        for place in (0..picture.pixels.len()).filter(|&place| among(place)) {
            let (x, a, b) = (picture.pixels[place], first.pixels[place], second.pixels[place]);
            let product = |k: usize| {
                let x = f64::from(x[k]);
                (x - f64::from(a[k])) * (x - f64::from(b[k]))
            };
            // Channels of one pixel share their noise. A pixel is therefore one observation.
            let of_pixel = (0..3).map(product).sum::<f64>() / 3.0;
            sum += of_pixel;
            squares += of_pixel * of_pixel;
            count += 1;
        }
        let count = f64::from(count);
        let mean = sum / count;
        let standard_error = ((squares / count - mean * mean).max(0.0) / count).sqrt();
        (count > 0.0).then(|| mean.max(standard_error).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::Rng;
    use proptest::test_runner::{RngAlgorithm, TestRng};

    /// Noise of standard deviation 0.1 around 0.5, and a picture that is 0.02 too bright. Against
    /// either noisy picture, or against the mean of both, the error would come out four or five times
    /// as large.
    #[test]
    fn noise_of_the_truth_is_not_counted() {
        let mut random = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
        let (side, sigma) = (200, 0.1);
        let mut noisy = || {
            let mut picture = Picture::black(side, side);
            for light in picture.pixels.as_flattened_mut() {
                let uniform = f64::from(random.next_u32()) / f64::from(u32::MAX) - 0.5;
                *light = (0.5 + sigma * 12.0_f64.sqrt() * uniform) as f32;
            }
            picture
        };
        let truth = Pair { pictures: [noisy(), noisy()] };
        let mut bright = Picture::black(side, side);
        bright.pixels.fill([0.52; 3]);
        let error = truth.error_of(&bright, |_| true).unwrap();
        // The mean square has a standard deviation of about sigma^2 / sqrt(120000) = 3e-5.
        assert!((error * error - 0.0004).abs() < 1.5e-4, "{error}");
        let naive = (f64::from(0.02_f32).powi(2) + sigma * sigma / 2.0).sqrt();
        assert!(naive > 3.0 * error);
        assert_eq!(truth.error_of(&bright, |_| false), None);
        let half = truth.error_of(&truth.mean(), |place| place < 5000).unwrap();
        // The mean lies between the two pictures, so no product is above 0. The difference of the two has a
        // variance of 2 sigma^2. The mean of three products has a deviation of about sigma^2 / 3. The root
        // of its standard error over 5000 pixels is then about 0.07 sigma.
        assert!(half > 0.0 && half < 0.1 * sigma, "{half}");
    }
}
