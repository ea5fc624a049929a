//! What the numbers say, in words.
//!
//! Every sentence is worked out from what was measured, and is left out where the numbers do not
//! bear it. What "as near" and "as fast" mean is said by [`AS_NEAR`] and [`AS_FAST`].

mod advice;
mod footprints;
pub mod numbers;
mod pages;
mod pool;
mod regions;
mod samples;
#[cfg(test)]
mod tests;

use super::measured::Measured;

/// Errors of which the larger is at most this times the smaller count as the same.
///
/// The noise of the truth changes an error of five times its size by 2 % at most.
pub const AS_NEAR: f64 = 1.05;

/// Times of which the longer is at most this times the shorter count as the same: about what two
/// runs on a machine that does other work differ by.
pub const AS_FAST: f64 = 1.1;

/// Whether an error is as small as another, or smaller.
fn as_near(error: f64, other: f64) -> bool {
    error <= AS_NEAR * other
}

/// Whether an error is smaller than another, and not just as small.
fn nearer(error: f64, other: f64) -> bool {
    AS_NEAR * error < other
}

/// A filter helps where its error is at most this part of that of bilinear interpolation.
pub const HELPS: f64 = 0.8;

/// No filter helps where the best has more than this part of that error.
pub const NO_HELP: f64 = 0.9;

/// What a sentence is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Topic {
    /// Which method is nearest within a time.
    Budget,
    /// Which method is fastest to an error.
    Aim,
    /// What one ray with the thesis's filter is worth in bilinear rays.
    OneRay,
    /// That another method is nearer in no more time.
    Beaten,
    /// What the filters do in a region.
    Region,
    /// Mip-mapping against the tent.
    Mip,
    /// What is left of the filter when there are many rays.
    ManyRays,
    /// The orders of repeated integration against each other.
    Orders,
    /// The thesis's supersampling against as many rays evenly spread.
    Supersampling,
    /// Footprints at a slant to the texture.
    Rotated,
    /// Footprints narrower than texels.
    Thin,
    /// What the tables take.
    Memory,
    /// That a truth is not good enough.
    Noise,
}

/// For whom a sentence speaks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// It says what to use.
    Use,
    /// The thesis's method is better.
    Wins,
    /// It makes no difference.
    Even,
    /// The thesis's method is worse.
    Loses,
    /// The measurement itself is in doubt.
    Doubt,
}

/// A sentence, and what it says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claim {
    /// What it is about.
    pub topic: Topic,
    /// For whom it speaks.
    pub verdict: Verdict,
    /// The page it is about; all of them if none.
    pub page: Option<String>,
    /// The sentence.
    pub text: String,
}

impl Claim {
    fn general(topic: Topic, verdict: Verdict, text: String) -> Self {
        Self { topic, verdict, page: None, text }
    }
}

/// All that can be said of the pages and of the filters by themselves, which are in the table
/// `filters`.
#[must_use]
pub fn claims(measured: &Measured) -> Vec<Claim> {
    let pages = &measured.pages;
    let mut claims = advice::claims(pages);
    claims.extend(pages::claims(pages));
    claims.extend(regions::claims(pages));
    claims.extend(samples::claims(pages));
    let floor = measured.tables.iter().find(|table| table.name == "filters");
    claims.extend(floor.map(footprints::claims).unwrap_or_default());
    claims
}
