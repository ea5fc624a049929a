//! Computes the structural similarity of two pictures (Wang, Bovik, Sheikh and Simoncelli 2004).
//!
//! The measure compares luma: the weighted sum of the sRGB codes, as a screen shows them. The
//! measure models the eye and was fitted to codes. (Its authors take the luminance of 8-bit
//! pictures; here codes are not rounded.) Light beyond white counts as white.
//!
//! Means, variances and the covariance are weighted by a Gaussian window of 11 x 11 pixels. As in the
//! authors' own program, only windows that lie entirely in the picture count, and pictures are not
//! downsampled first. This module exists because crates that offer SSIM use other windows
//! (`image-compare`: squares of 8 x 8 pixels) or newer measures (`dssim-core` and `ssimulacra2`, at
//! several scales). Their numbers cannot be compared with published ones.

use super::error::{CompareError, check_finite, check_sizes};
use render::Picture;
use render::color::Encoding;

/// Side of the window in pixels.
pub const WINDOW: usize = 11;

/// Standard deviation of the window in pixels.
const SIGMA: f64 = 1.5;

/// Stabilises the division in dark areas: `(K1 L)^2` with `K1 = 0.01` and a range `L` of 1.
const C1: f64 = 0.01 * 0.01;

/// Stabilises the division in even areas: `(K2 L)^2` with `K2 = 0.03` and a range `L` of 1.
const C2: f64 = 0.03 * 0.03;

/// Weights of red, green and blue codes in luma (ITU-R BT.709).
const LUMA: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// Returns the mean structural similarity of two pictures, at most 1. Equal pictures have 1. Returns
/// `None` for pictures in which no window of [`WINDOW`] pixels fits.
///
/// # Errors
/// When the sizes differ, there are no pixels, or a pixel is not finite.
pub fn ssim(first: &Picture, second: &Picture) -> Result<Option<f64>, CompareError> {
    check_sizes(first, second)?;
    let (x, y) = (luma("first", first)?, luma("second", second)?);
    let (width, height) = (first.width as usize, first.height as usize);
    if width < WINDOW || height < WINDOW {
        return Ok(None);
    }
    let product =
        |a: &[f64], b: &[f64]| -> Vec<f64> { a.iter().zip(b).map(|(a, b)| a * b).collect() };
    let mean = |values: &[f64]| blurred(values, width, height);
    let (mean_x, mean_y) = (mean(&x), mean(&y));
    let squares_x = mean(&product(&x, &x));
    let squares_y = mean(&product(&y, &y));
    let products = mean(&product(&x, &y));
    let windows = mean_x.len();
    let sum: f64 = (0..windows)
        .map(|k| {
            let (mx, my) = (mean_x[k], mean_y[k]);
            let (vx, vy) = (squares_x[k] - mx * mx, squares_y[k] - my * my);
            let covariance = products[k] - mx * my;
            let same = (2.0 * mx * my + C1) * (2.0 * covariance + C2);
            same / ((mx * mx + my * my + C1) * (vx + vy + C2))
        })
        .sum();
    Ok(Some(sum / windows as f64))
}

/// Returns the luma of each pixel, in `[0, 1]`.
fn luma(name: &'static str, picture: &Picture) -> Result<Vec<f64>, CompareError> {
    let pixels = picture.pixels.iter().enumerate();
    pixels
        .map(|(index, pixel)| {
            check_finite(name, picture.width, index, pixel)?;
            let codes = pixel.map(|light| Encoding::Srgb.encode(f64::from(light)));
            Ok(LUMA[0] * codes[0] + LUMA[1] * codes[1] + LUMA[2] * codes[2])
        })
        .collect()
}

/// Returns the weighted mean in every window that lies in the picture, row by row. The window is a
/// product of two one-dimensional weights, so rows are averaged first and columns second.
fn blurred(values: &[f64], width: usize, height: usize) -> Vec<f64> {
    let weights = weights();
    let (across, down) = (width + 1 - WINDOW, height + 1 - WINDOW);
    let rows: Vec<f64> = values
        .chunks_exact(width)
        .flat_map(|row| row.windows(WINDOW))
        .map(|window| window.iter().zip(&weights).map(|(value, weight)| value * weight).sum())
        .collect();
    (0..down * across)
        .map(|k| weights.iter().enumerate().map(|(i, weight)| weight * rows[k + i * across]).sum())
        .collect()
}

/// Returns the weights of the Gaussian along one axis; their sum is 1.
fn weights() -> [f64; WINDOW] {
    let middle = (WINDOW / 2) as f64;
    let bell: [f64; WINDOW] =
        std::array::from_fn(|k| (-(k as f64 - middle).powi(2) / (2.0 * SIGMA * SIGMA)).exp());
    let sum: f64 = bell.iter().sum();
    bell.map(|weight| weight / sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Makes a picture of grey codes.
    fn codes(width: u32, height: u32, code: impl Fn(u32, u32) -> f64) -> Picture {
        let mut picture = Picture::black(width, height);
        for (k, pixel) in (0..).zip(&mut picture.pixels) {
            *pixel = [Encoding::Srgb.decode(code(k % width, k / width)) as f32; 3];
        }
        picture
    }

    /// Codes in [0, 1] without a visible pattern.
    fn noise(seed: u32) -> impl Fn(u32, u32) -> f64 {
        move |x, y| {
            let mixed = (x * 7919 + y * 104_729 + seed).wrapping_mul(2_654_435_761);
            f64::from(mixed >> 16) / 65535.0
        }
    }

    fn of(first: &Picture, second: &Picture) -> f64 {
        ssim(first, second).unwrap().unwrap()
    }

    /// Computes the measure as its paper writes it, window by window, with variances as sums of
    /// squared deviations (equations 13 to 17).
    fn by_the_paper(first: &Picture, second: &Picture) -> f64 {
        let (x, y) = (luma("first", first).unwrap(), luma("second", second).unwrap());
        let (width, height) = (first.width as i64, first.height as i64);
        let bell = |i: i64, j: i64| (-((i * i + j * j) as f64) / (2.0 * 1.5 * 1.5)).exp();
        let offsets: Vec<(i64, i64)> =
            (-5..=5).flat_map(|j| (-5..=5).map(move |i| (i, j))).collect();
        let whole: f64 = offsets.iter().map(|&(i, j)| bell(i, j)).sum();
        let mut all = Vec::new();
        for row in 5..height - 5 {
            for column in 5..width - 5 {
                let mean = |value: &dyn Fn(usize) -> f64| -> f64 {
                    let at = |i: i64, j: i64| ((row + j) * width + column + i) as usize;
                    offsets.iter().map(|&(i, j)| bell(i, j) / whole * value(at(i, j))).sum()
                };
                let (mx, my) = (mean(&|k| x[k]), mean(&|k| y[k]));
                let vx = mean(&|k| (x[k] - mx).powi(2));
                let vy = mean(&|k| (y[k] - my).powi(2));
                let vxy = mean(&|k| (x[k] - mx) * (y[k] - my));
                let (c1, c2) = (0.0001, 0.0009);
                all.push(
                    (2.0 * mx * my + c1) * (2.0 * vxy + c2)
                        / ((mx * mx + my * my + c1) * (vx + vy + c2)),
                );
            }
        }
        all.iter().sum::<f64>() / all.len() as f64
    }

    #[test]
    fn it_is_what_the_paper_writes() {
        let first = codes(23, 17, noise(1));
        for second in [codes(23, 17, noise(2)), codes(23, 17, |x, y| 0.5 * noise(1)(x, y) + 0.2)] {
            let (ours, papers) = (of(&first, &second), by_the_paper(&first, &second));
            // Variances as differences of squares lose about 1e-16 beside 9e-4.
            assert!((ours - papers).abs() < 1e-12, "{ours} {papers}");
            assert!(ours < 0.99);
        }
    }

    #[test]
    fn even_pictures_have_a_similarity_in_closed_form() {
        let (a, b) = (0.25, 0.75);
        let expected = (2.0 * a * b + C1) / (a * a + b * b + C1);
        let found = of(&codes(12, 15, |_, _| a), &codes(12, 15, |_, _| b));
        // Linear light is kept in f32.
        assert!((found - expected).abs() < 1e-7, "{found} {expected}");
    }

    #[test]
    fn equal_pictures_have_1_and_order_does_not_matter() {
        let (first, second) = (codes(30, 20, noise(3)), codes(30, 20, noise(4)));
        assert_eq!(of(&first, &first), 1.0);
        assert_eq!(of(&first, &second), of(&second, &first));
        let negative = codes(30, 20, |x, y| 1.0 - noise(3)(x, y));
        assert!(of(&first, &negative) < -0.5, "what is turned over is less than unlike");
    }

    #[test]
    fn beyond_white_is_white() {
        let white = codes(11, 11, |_, _| 1.0);
        let burnt = Picture { pixels: vec![[7.0; 3]; 121], ..white.clone() };
        assert_eq!(of(&white, &burnt), 1.0);
    }

    #[test]
    fn small_pictures_have_none_and_broken_ones_are_refused() {
        assert_eq!(ssim(&Picture::black(10, 11), &Picture::black(10, 11)), Ok(None));
        let mut broken = Picture::black(11, 11);
        broken.pixels[12][0] = f32::INFINITY;
        let error = ssim(&broken, &Picture::black(11, 11)).unwrap_err().to_string();
        assert!(error.starts_with("pixel 1,1 of the first picture is inf"), "{error}");
    }
}
