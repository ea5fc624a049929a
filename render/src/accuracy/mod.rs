//! Measures the error of a picture, and makes pictures of a requested error.
//!
//! [`audit`] judges any picture, whatever method made it. A sample of its pixels ([`chances`]) is
//! compared with their true colours by brute force ([`truth`]). The result is an unbiased estimate
//! of the mean squared error and an upper bound that holds with a stated confidence ([`bound`]).
//! [`Request::reach`] tries samplings ([`ladder`]) on such a sample until the bound is below a requested
//! error (`search.rs`).
//!
//! [`census`] finds the true colours of all pixels, by which audits are checked.
//!
//! A crop is audited as a picture of its own: its error is that of its pixels, and a request holds
//! for the crop alone.

pub mod bound;
pub mod census;
pub mod chances;
pub mod ladder;
pub mod meshes;
mod plan;
pub mod request;
pub mod sample;
mod search;
pub mod sources;
pub mod statement;
pub mod truth;

pub use meshes::apart;
pub use request::{Progress, Reached, Request};
pub use sources::Sources;
pub use statement::Statement;

use crate::film::{Picture, Settings};
use crate::prepared::Prepared;
use crate::stats::Stats;
use bound::{deviation, mean, upper};
use chances::Chances;
use sample::Sample;
use std::time::Instant;

/// The chance with which a stated bound holds.
pub const CONFIDENCE: f64 = 0.95;

/// Half a step of a 16-bit texel. Textures hold nothing finer.
pub const LEAST: f64 = 0.5 / 65535.0;

/// Half of the mean step between neighbouring codes of an 8-bit sRGB picture, in linear light.
pub const OF_8BIT: f64 = 0.5 / 255.0;

/// Draws of a first, small sample, which finds the noise that an audit may have.
const FIRST: usize = 250;

/// Returns the number of pixels that are drawn for errors near `error`.
///
/// With fewer, the bound lies far above the error. With more, the audit costs more than it saves.
fn draws(error: f64) -> usize {
    if error >= 0.01 { 1000 } else { 1500 }
}

/// Reads a requested error: a number between 0 and 1 in linear light, or `8bit`.
///
/// # Errors
/// If the text is neither, or if the number is below [`LEAST`].
pub fn error(text: &str) -> Result<f64, String> {
    if text == "8bit" {
        return Ok(OF_8BIT);
    }
    let number =
        text.parse().map_err(|_| "expected a number, such as 0.01, or 8bit".to_string())?;
    check(number)?;
    Ok(number)
}

/// Checks a requested error.
///
/// # Errors
/// If it is not a number between 0 and 1, or if it is below [`LEAST`].
pub fn check(number: f64) -> Result<(), String> {
    if !(number > 0.0 && number < 1.0) {
        return Err("expected a number above 0 and below 1, in linear light, or 8bit".into());
    }
    if number < LEAST {
        return Err(format!(
            "expected at least {LEAST:.7}: texels of 16 bits represent nothing finer"
        ));
    }
    Ok(())
}

/// Audits a picture that was rendered with `settings`. The true colours have the pixel filter of the
/// sampling. Counts and time of the audit are added to `stats`, those of the picture.
///
/// Runs on the threads of the current rayon pool. The statement is the same for any number of
/// threads.
#[must_use]
pub fn audit(
    prepared: &Prepared<'_>,
    settings: &Settings,
    picture: &Picture,
    stats: &mut Stats,
) -> Statement {
    let started = Instant::now();
    let chances = Chances::new(picture, None);
    let rough = Sample::take(prepared, settings, &chances, (FIRST, 1), 0.02);
    let values = rough.values_of(picture);
    // Neither an accidental 0 nor a single large value decides the noise.
    let accuracy = mean(&values).max(0.0).sqrt().clamp(0.0025, 0.05);
    // Nothing announces the errors of an unknown method, so more pixels are drawn than in a search.
    let sample = Sample::take(prepared, settings, &chances, (2 * draws(accuracy), 0), accuracy);
    let values = sample.values_of(picture);
    let bound = upper(&values, 1.0 - CONFIDENCE).max(0.0).sqrt();
    let bound = bound.max(search::LEAST_BOUND * accuracy);
    stats.audit_rays += rough.rays() + sample.rays();
    stats.audit_time += started.elapsed();
    stated(&values, bound, None, stats, picture.pixels.len())
}

/// Returns the statement on a picture of this many pixels.
fn stated(
    values: &[f64],
    bound: f64,
    missed: Option<f64>,
    stats: &Stats,
    pixels: usize,
) -> Statement {
    let per_pixel = |rays: u64| rays as f64 / pixels.max(1) as f64;
    Statement {
        // An error that noise hides is not stated as 0.
        error: mean(values).max(deviation(values)).sqrt().min(bound),
        bound,
        confidence: CONFIDENCE,
        rays: per_pixel(stats.primary_rays),
        audit: per_pixel(stats.audit_rays),
        missed,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requests_are_numbers_or_8bit() {
        assert_eq!(error("0.01"), Ok(0.01));
        assert_eq!(error("8bit"), Ok(1.0 / 510.0));
        for (bad, expected) in [
            ("0", "above 0 and below 1"),
            ("-0.1", "above 0"),
            ("1", "below 1"),
            ("NaN", "above 0"),
            ("inf", "below 1"),
            ("1e-6", "at least 0.0000076"),
            ("16bit", "expected a number"),
        ] {
            assert!(error(bad).unwrap_err().contains(expected), "{bad}");
        }
    }
}
