//! The parts of the errors of a film: the part that stays from frame to frame, and the part that changes.
//!
//! The error e of a channel of a pixel in a frame is the picture minus the truth of the same frame. The motion of the
//! picture itself is therefore no part of e: the truth moves alike. Over all frames f and channels c of pixels,
//!
//! ```text
//! error^2    = mean over c and f of e(c, f)^2
//! steady^2   = mean over c of (mean over f of e(c, f))^2
//! changing^2 = error^2 - steady^2     the variance of e over the frames, averaged over all channels
//! step^2     = mean over c and f of (e(c, f + 1) - e(c, f))^2 / 2
//! ```
//!
//! `step` compares each frame with the next one. It equals `changing` if the errors of two successive frames have
//! nothing in common, and is smaller if errors change slowly.
//!
//! The truth has noise. It consists of two pictures a and b whose noise is independent, so each square above is a
//! product of a factor with a and the same factor with b ([`crate::truth`]). The mean of such products has no part of
//! the noise.

use crate::truth::Pair;
use render::Picture;

/// The parts of the errors of a film: root mean squares in linear light, where white is 1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Parts {
    /// All errors.
    pub error: Part,
    /// The mean over the frames.
    pub steady: Part,
    /// The difference from the mean over the frames.
    pub changing: Part,
    /// The difference between one frame and the next, divided by the root of 2.
    pub step: Part,
}

/// A root mean square with its uncertainty.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Part {
    /// The root mean square, at least `least`.
    pub rms: f64,
    /// The root of the standard error of the mean square. A smaller root mean square cannot be measured. Pixels count as
    /// independent.
    pub least: f64,
}

/// Sums over the frames of a film, for each channel.
#[derive(Debug, Clone, Default)]
pub struct Sums {
    frames: u32,
    channels: Vec<Channel>,
}

/// Sums of one channel of a pixel. `a` and `b` are the differences of a picture from the two pictures of its truth.
#[derive(Debug, Clone, Copy, Default)]
struct Channel {
    /// Sums of a, of b, and of their product.
    a: f64,
    b: f64,
    product: f64,
    /// The differences in the latest frame.
    latest: [f64; 2],
    /// Sum of the products of the steps of a and of b.
    steps: f64,
}

/// Bytes for the sums of one pixel.
pub const BYTES_PER_PIXEL: u64 = 3 * size_of::<Channel>() as u64;

impl Sums {
    /// Adds the next frame. All pictures of a film have the same size.
    pub fn add(&mut self, picture: &Picture, truth: &Pair) {
        let channels = picture.pixels.as_flattened();
        self.channels.resize(channels.len(), Channel::default());
        let [a, b] = &truth.pictures;
        let truths = a.pixels.as_flattened().iter().zip(b.pixels.as_flattened());
        for ((sums, &light), (&a, &b)) in self.channels.iter_mut().zip(channels).zip(truths) {
            let [a, b] = [a, b].map(|truth| f64::from(light) - f64::from(truth));
            sums.a += a;
            sums.b += b;
            sums.product += a * b;
            if self.frames > 0 {
                sums.steps += (a - sums.latest[0]) * (b - sums.latest[1]);
            }
            sums.latest = [a, b];
        }
        self.frames += 1;
    }

    /// Returns the parts over all frames so far. All are 0 without frames.
    #[must_use]
    pub fn parts(&self) -> Parts {
        let frames = f64::from(self.frames.max(1));
        let steps = f64::from(self.frames.saturating_sub(1).max(1));
        let error = |own: &Channel| own.product / frames;
        let steady = |own: &Channel| own.a * own.b / (frames * frames);
        Parts {
            error: self.part(error),
            steady: self.part(steady),
            changing: self.part(|own| error(own) - steady(own)),
            step: self.part(|own| own.steps / (2.0 * steps)),
        }
    }

    /// Returns the root of the mean of some squares over all channels.
    fn part(&self, square: impl Fn(&Channel) -> f64) -> Part {
        let (mut sum, mut squares) = (0.0, 0.0);
        // Channels of one pixel share their noise. A pixel is therefore one observation.
        for pixel in self.channels.chunks_exact(3) {
            let value = pixel.iter().map(&square).sum::<f64>() / 3.0;
            sum += value;
            squares += value * value;
        }
        let count = (self.channels.len() / 3).max(1) as f64;
        let mean = sum / count;
        let standard_error = ((squares / count - mean * mean).max(0.0) / count).sqrt();
        Part { rms: mean.max(standard_error).sqrt(), least: standard_error.sqrt() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use render::film::pattern::{fraction, mixed};

    const SIDE: u32 = 40;

    fn picture(light: impl Fn(u64) -> f64) -> Picture {
        let mut picture = Picture::black(SIDE, SIDE);
        for (k, own) in (0_u64..).zip(picture.pixels.as_flattened_mut()) {
            *own = light(k) as f32;
        }
        picture
    }

    /// A truth of 0.5 with noise of this standard deviation, of a seed for each frame.
    fn truth(sigma: f64, frame: u64) -> Pair {
        let uniform = |seed: u64, k: u64| fraction(mixed(mixed(seed) ^ k)) - 0.5;
        let noisy = |seed| picture(|k| 0.5 + sigma * 12.0_f64.sqrt() * uniform(seed, k));
        Pair { pictures: [noisy(2 * frame + 1), noisy(2 * frame + 2)] }
    }

    /// The parts of errors that a closed form describes, over 8 frames.
    fn parts(sigma: f64, error: impl Fn(u64, u64) -> f64) -> Parts {
        let mut sums = Sums::default();
        for frame in 0..8 {
            sums.add(&picture(|k| 0.5 + error(frame, k)), &truth(sigma, frame));
        }
        sums.parts()
    }

    fn assert_near(parts: &Parts, truth: [f64; 4], tolerance: f64) {
        let found = [parts.error, parts.steady, parts.changing, parts.step].map(|part| part.rms);
        for (found, truth) in found.iter().zip(truth) {
            assert!((found - truth).abs() < tolerance, "{parts:?}, expected {truth}");
        }
    }

    /// An error that stays, one that changes its sign in each frame, one that changes it once, and a sum of two.
    #[test]
    fn parts_are_those_of_known_errors() {
        // The rounding of `f32` near 0.5 is 3e-8.
        let exact = 1e-6;
        let sign = |k: u64| if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        let stays = |_, k| 0.1 * sign(k);
        assert_near(&parts(0.0, stays), [0.1, 0.1, 0.0, 0.0], exact);
        let flickers = |frame, k: u64| 0.1 * sign(frame + k);
        let root = 2.0_f64.sqrt();
        assert_near(&parts(0.0, flickers), [0.1, 0.0, 0.1, 0.1 * root], exact);
        let once = |frame, _| if frame < 4 { 0.1 } else { -0.1 };
        assert_near(&parts(0.0, once), [0.1, 0.0, 0.1, 0.1 * (2.0_f64 / 7.0).sqrt()], exact);
        let both = |frame, _| 0.03 + 0.04 * sign(frame);
        assert_near(&parts(0.0, both), [0.05, 0.03, 0.04, 0.04 * root], exact);
        assert_eq!(Sums::default().parts(), Parts::default());
    }

    /// The noise of the truth is ten times the error, and is not counted.
    #[test]
    fn noise_of_the_truth_is_not_counted() {
        let both = |frame: u64, _| 0.03 + if frame.is_multiple_of(2) { 0.04 } else { -0.04 };
        let found = parts(0.3, both);
        let truth = [0.05, 0.03, 0.04, 0.04 * 2.0_f64.sqrt()];
        let all = [found.error, found.steady, found.changing, found.step];
        for (part, truth) in all.iter().zip(truth) {
            // Five standard errors of the mean square.
            assert!(
                (part.rms.powi(2) - truth * truth).abs() < 5.0 * part.least.powi(2),
                "{found:?}"
            );
            assert!(part.least < 0.1, "the noise itself is 0.3: {found:?}");
        }
    }

    /// Any errors: the squares of the steady and of the changing part add up to the square of the error.
    #[test]
    fn squares_of_the_parts_add_up() {
        let found = parts(0.0, |frame, k| 0.2 * fraction(mixed(frame * 100_000 + k)));
        let [error, steady, changing] =
            [found.error, found.steady, found.changing].map(|part| part.rms.powi(2));
        assert!((error - steady - changing).abs() < 1e-15);
    }
}
