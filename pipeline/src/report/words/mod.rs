//! Turns the numbers of a report into sentences.
//!
//! Every sentence is derived from measurements, and is left out where the numbers do not support it.
//! [`AS_NEAR`] and [`AS_FAST`] define "as near" and "as fast".

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

/// Two errors count as equal if the larger is at most this times the smaller.
///
/// The noise of the truth changes an error of five times its size by 2 % at most.
pub const AS_NEAR: f64 = 1.05;

/// Two times count as equal if the longer is at most this times the shorter. Two runs on a machine that
/// does other work differ by about as much.
pub const AS_FAST: f64 = 1.1;

/// Returns whether an error is at most as large as another, within [`AS_NEAR`].
fn as_near(error: f64, other: f64) -> bool {
    error <= AS_NEAR * other
}

/// Returns whether an error is smaller than another by more than [`AS_NEAR`].
fn nearer(error: f64, other: f64) -> bool {
    AS_NEAR * error < other
}

/// A filter helps where its error is at most this fraction of that of bilinear interpolation.
pub const HELPS: f64 = 0.8;

/// No filter helps where even the best leaves more than this fraction of the error of bilinear
/// interpolation.
pub const NO_HELP: f64 = 0.9;

/// The subject of a sentence.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Topic {
    /// The method that is nearest within a time.
    Budget,
    /// The method that reaches an error fastest.
    Aim,
    /// The number of bilinear rays that one ray with the thesis's filter is worth.
    OneRay,
    /// Another method that is nearer in no more time.
    Beaten,
    /// The effect of the filters in a region.
    Region,
    /// Mip-mapping in comparison to the tent.
    Mip,
    /// The effect of the filter that remains with many rays.
    ManyRays,
    /// The orders of repeated integration in comparison to each other.
    Orders,
    /// The thesis's supersampling in comparison to as many evenly spread rays.
    Supersampling,
    /// Footprints at a slant to the texture.
    Rotated,
    /// Footprints narrower than texels.
    Thin,
    /// The memory of the tables.
    Memory,
    /// A truth that is not exact enough.
    Noise,
}

/// The conclusion of a sentence.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The sentence advises a method.
    Use,
    /// The thesis's method is better.
    Wins,
    /// The methods do not differ.
    Even,
    /// The thesis's method is worse.
    Loses,
    /// The measurement itself is in doubt.
    Doubt,
}

/// A sentence with its subject and conclusion.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claim {
    /// The subject of the sentence.
    pub topic: Topic,
    /// The conclusion of the sentence.
    pub verdict: Verdict,
    /// The page that the sentence is about; `None` for all pages.
    pub page: Option<String>,
    /// The text of the sentence.
    pub text: String,
}

impl Claim {
    fn general(topic: Topic, verdict: Verdict, text: String) -> Self {
        Self { topic, verdict, page: None, text }
    }
}

/// Returns all sentences on the pages, and on the filters by themselves, which are in the table
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
