//! The samplings among which the search for an accuracy chooses, from the cheapest to the finest.

use crate::film::{PixelFilter, Sampling};

/// Cells along each side of a pixel, and the threshold at which they split; 0 for no splits.
///
/// Below a threshold of 0.03, pixels split for bends of footprints that filters average well. Four
/// cells in each pixel then cost less for the same error.
const RUNGS: [(u32, f64); 17] = [
    (1, 0.0),
    (1, 0.8),
    (1, 0.4),
    (1, 0.2),
    (1, 0.1),
    (1, 0.05),
    (1, 0.03),
    (2, 0.06),
    (2, 0.02),
    (3, 0.03),
    (4, 0.02),
    (6, 0.02),
    (8, 0.01),
    (12, 0.01),
    (16, 0.005),
    (24, 0.005),
    (32, 0.005),
];

/// The rung at which the search starts, for errors from this one up.
const STARTS: [(f64, usize); 6] =
    [(0.05, 2), (0.02, 3), (0.01, 5), (0.005, 7), (0.0025, 9), (0.0, 11)];

/// The samplings with one pixel filter, from the cheapest to the finest.
#[must_use]
pub fn rungs(pixel_filter: PixelFilter) -> Vec<Sampling> {
    let sampling = |(samples, threshold): (u32, f64)| {
        let threshold = (threshold > 0.0).then_some(threshold);
        Sampling::Area { samples, pixel_filter, threshold }
    };
    RUNGS.map(sampling).into()
}

/// Returns the rung at which the search for an error starts.
#[must_use]
pub fn start(error: f64) -> usize {
    STARTS.iter().find(|(from, _)| error >= *from).map_or(RUNGS.len() - 1, |(_, rung)| *rung)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smaller_errors_start_at_finer_rungs() {
        let starts = [0.5, 0.05, 0.03, 0.01, 0.007, 0.003, 0.001, 1e-5].map(start);
        assert!(starts.is_sorted(), "{starts:?}");
        let all = rungs(PixelFilter::Tent);
        assert!(starts.iter().all(|&rung| rung < all.len()));
        let cells = |sampling: &Sampling| match *sampling {
            Sampling::Area { samples, pixel_filter: PixelFilter::Tent, .. } => samples,
            _ => 0,
        };
        assert!(all.iter().map(cells).is_sorted() && cells(&all[0]) == 1);
    }
}
