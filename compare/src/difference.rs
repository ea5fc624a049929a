//! Errors between two pictures, in linear light.

use super::error::{CompareError, check_finite, check_sizes, place};
use render::Picture;
use serde::Serialize;

/// Differences between the pixels of two pictures, or of a part of both, in linear light where white is
/// 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Difference {
    /// Number of pixels compared.
    pub pixels: usize,
    /// Root mean square over all pixels and the three channels.
    pub rmse: f64,
    /// The largest difference in any channel of any pixel.
    pub max: f64,
    /// The 99.9th percentile of the pixels' errors, where the error of a pixel is its largest
    /// difference in a channel. By nearest rank: the value number `ceil(0.999 * pixels)` in rising
    /// order. With fewer than 1000 pixels this is the largest error.
    pub p999: f64,
    /// The mean of first minus second over pixels and channels. Above 0 where the first picture is
    /// brighter.
    pub bias: f64,
}

impl Difference {
    /// Compares `first` with `second` over the pixels for which `mask` is true, or over all pixels.
    ///
    /// Sums are compensated and added row by row from the top. So the result is the same for any number
    /// of threads, and its relative error is a few units in the last place.
    ///
    /// # Errors
    /// When the sizes differ (that of the mask too), when no pixel is left, or when a compared pixel is
    /// not finite.
    pub fn between(
        first: &Picture,
        second: &Picture,
        mask: Option<&[bool]>,
    ) -> Result<Self, CompareError> {
        check_sizes(first, second)?;
        let expected = first.pixels.len();
        if let Some(found) = mask.map(<[bool]>::len).filter(|&found| found != expected) {
            return Err(CompareError::Mask { found, expected });
        }
        let (mut squares, mut sum) = (Sum::default(), Sum::default());
        let mut largest = Vec::with_capacity(expected);
        for (index, pair) in first.pixels.iter().zip(&second.pixels).enumerate() {
            if mask.is_some_and(|mask| !mask[index]) {
                continue;
            }
            check_finite("first", first.width, index, pair.0)?;
            check_finite("second", first.width, index, pair.1)?;
            for difference in channels(pair) {
                squares.add(difference * difference);
                sum.add(difference);
            }
            largest.push(magnitude(pair));
        }
        let pixels = largest.len();
        if pixels == 0 {
            return Err(CompareError::NoPixels);
        }
        let values = 3.0 * pixels as f64;
        let max = largest.iter().copied().fold(0.0, f64::max);
        Ok(Self {
            pixels,
            rmse: (squares.total() / values).sqrt(),
            max,
            p999: permille_999(&mut largest),
            bias: sum.total() / values,
        })
    }
}

/// Returns the column and row, from 0, of the pixel with the largest difference in a channel. Of
/// several pixels with equal differences, the first one row by row is returned. Returns `None` for
/// equal pictures.
///
/// # Errors
/// When the sizes differ or there are no pixels.
pub fn farthest(first: &Picture, second: &Picture) -> Result<Option<(u32, u32)>, CompareError> {
    check_sizes(first, second)?;
    let (mut found, mut most) = (None, 0.0);
    for (k, pair) in first.pixels.iter().zip(&second.pixels).enumerate() {
        let magnitude = magnitude(pair);
        if magnitude > most {
            (found, most) = (Some(k), magnitude);
        }
    }
    Ok(found.map(|index| place(first.width, index)))
}

/// Returns first minus second in each channel.
fn channels((first, second): (&[f32; 3], &[f32; 3])) -> [f64; 3] {
    std::array::from_fn(|k| f64::from(first[k]) - f64::from(second[k]))
}

/// Returns the error of a pixel: the largest absolute difference among its channels.
pub(crate) fn magnitude(pair: (&[f32; 3], &[f32; 3])) -> f64 {
    channels(pair).iter().fold(0.0, |most, difference| difference.abs().max(most))
}

/// Returns the 99.9th percentile of at least one value, by nearest rank.
fn permille_999(values: &mut [f64]) -> f64 {
    // ceil(0.999 n) = n - floor(n / 1000), counted from 1.
    let rank = values.len() - values.len() / 1000;
    *values.select_nth_unstable_by(rank - 1, f64::total_cmp).1
}

/// A compensated sum, which keeps the rounding errors in `lost` (Neumaier 1974).
#[derive(Debug, Clone, Copy, Default)]
struct Sum {
    sum: f64,
    lost: f64,
}

impl Sum {
    fn add(&mut self, value: f64) {
        let sum = self.sum + value;
        self.lost += if self.sum.abs() >= value.abs() {
            (self.sum - sum) + value
        } else {
            (value - sum) + self.sum
        };
        self.sum = sum;
    }

    fn total(self) -> f64 {
        self.sum + self.lost
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn picture(width: u32, pixels: Vec<[f32; 3]>) -> Picture {
        let height = pixels.len() as u32 / width;
        Picture { pixels, ..Picture::black(width, height) }
    }

    fn between(first: &Picture, second: &Picture) -> Difference {
        Difference::between(first, second, None).unwrap()
    }

    #[test]
    fn an_even_offset_is_all_five_numbers() {
        let grey = picture(40, vec![[0.25, 0.5, 1.5]; 2000]);
        let lighter = picture(40, vec![[0.375, 0.625, 1.625]; 2000]);
        // Eighths are exact in f32 and their squares in f64.
        let expected =
            Difference { pixels: 2000, rmse: 0.125, max: 0.125, p999: 0.125, bias: 0.125 };
        assert_eq!(between(&lighter, &grey), expected);
        assert_eq!(between(&grey, &lighter), Difference { bias: -0.125, ..expected });
        let none = Difference { pixels: 2000, rmse: 0.0, max: 0.0, p999: 0.0, bias: 0.0 };
        assert_eq!(between(&grey, &grey), none);
    }

    #[test]
    fn one_channel_of_one_pixel_is_found() {
        let black = Picture::black(10, 10);
        let mut dot = black.clone();
        dot.pixels[47][1] = -3.0;
        let found = between(&dot, &black);
        // 9 over 300 values.
        assert!((found.rmse - 0.03f64.sqrt()).abs() < 1e-15, "{found:?}");
        assert_eq!((found.max, found.p999, found.bias), (3.0, 3.0, -0.01));
        assert_eq!(farthest(&dot, &black), Ok(Some((7, 4))));
        assert_eq!(farthest(&black, &black), Ok(None));
    }

    #[test]
    fn the_percentile_is_a_nearest_rank() {
        // Pixel k has the error k. Of 2000 pixels, number 1998 in rising order, counted from 1, has the
        // error 1997.
        for (count, expected) in [(1u32, 0), (999, 998), (1000, 998), (1999, 1997), (2000, 1997)] {
            // 7919 is prime and divides none of the counts, so every k occurs once, out of order.
            let pixels = (0..count).map(|k| [(k * 7919 % count) as f32, 0.0, 0.0]).collect();
            let found = between(&picture(count, pixels), &Picture::black(count, 1));
            assert_eq!(found.p999, f64::from(expected), "{count} pixels");
            assert_eq!(found.max, f64::from(count - 1));
        }
    }

    #[test]
    fn small_errors_beside_large_ones_are_not_lost() {
        // The exact sum is 3 * 4096; added one by one in f64, every 1 beside 2^60 is lost.
        let mut pixels = vec![[1.0; 3]; 4096];
        pixels.insert(0, [1.152_921_5e18; 3]);
        pixels.push([-1.152_921_5e18; 3]);
        let found = between(&picture(1, pixels), &Picture::black(1, 4098));
        assert_eq!(found.bias, 4096.0 / 4098.0);
    }

    #[test]
    fn what_cannot_be_compared_is_refused() {
        let two = Picture::black(2, 1);
        let complaint = |first: &Picture, second: &Picture, mask: Option<&[bool]>| {
            Difference::between(first, second, mask).unwrap_err().to_string()
        };
        assert_eq!(
            complaint(&two, &Picture::black(1, 2), None),
            "the first picture is 2x1 and the second 1x2: expected the same size"
        );
        assert_eq!(complaint(&two, &two, Some(&[true])), "found a mask of 1 pixels, expected 2");
        let nothing = "found no pixels to compare, expected at least one";
        assert_eq!(complaint(&two, &two, Some(&[false, false])), nothing);
        assert_eq!(complaint(&Picture::black(0, 0), &Picture::black(0, 0), None), nothing);
        let mut broken = two.clone();
        broken.pixels[1][2] = f32::NAN;
        assert_eq!(
            complaint(&two, &broken, None),
            "pixel 1,0 of the second picture is NaN in channel 2: expected a finite number"
        );
        assert!(Difference::between(&two, &broken, Some(&[true, false])).is_ok());
    }

    fn pictures() -> impl Strategy<Value = [Picture; 3]> {
        let pixels = || prop::collection::vec(prop::array::uniform3(-2.0..4.0f32), 24);
        [pixels(), pixels(), pixels()].prop_map(|each| each.map(|pixels| picture(6, pixels)))
    }

    proptest! {
        #[test]
        fn it_is_a_distance([a, b, c] in pictures()) {
            let [ab, ba, bc, ac] = [(&a, &b), (&b, &a), (&b, &c), (&a, &c)].map(|(x, y)| between(x, y));
            prop_assert_eq!(ab, Difference { bias: -ba.bias, ..ba });
            // Both norms satisfy the triangle inequality; 1e-12 allows for their rounding.
            prop_assert!(ac.rmse <= ab.rmse + bc.rmse + 1e-12);
            prop_assert!(ac.max <= ab.max + bc.max + 1e-12);
            prop_assert!((ac.bias - ab.bias - bc.bias).abs() < 1e-12);
            prop_assert!(ab.bias.abs() <= ab.rmse + 1e-12 && ab.rmse <= ab.max + 1e-12);
        }

        /// The sums of squares of both halves add up to that of the whole.
        #[test]
        fn masks_divide_the_whole(
            [a, b, _] in pictures(), mask in prop::collection::vec(any::<bool>(), 24),
        ) {
            let whole = between(&a, &b);
            prop_assert_eq!(Difference::between(&a, &b, Some(&[true; 24])), Ok(whole));
            let others: Vec<bool> = mask.iter().map(|set| !set).collect();
            let halves = [&mask, &others].map(|mask| Difference::between(&a, &b, Some(mask)));
            let halves: Vec<Difference> = halves.into_iter().flatten().collect();
            let pixels: usize = halves.iter().map(|half| half.pixels).sum();
            let squares: f64 = halves.iter().map(|half| half.rmse.powi(2) * half.pixels as f64).sum();
            let bias: f64 = halves.iter().map(|half| half.bias * half.pixels as f64).sum();
            prop_assert_eq!(pixels, 24);
            prop_assert!((squares / 24.0 - whole.rmse.powi(2)).abs() < 1e-12);
            prop_assert!((bias / 24.0 - whole.bias).abs() < 1e-12);
            prop_assert_eq!(halves.iter().map(|half| half.max).fold(0.0, f64::max), whole.max);
        }
    }
}
