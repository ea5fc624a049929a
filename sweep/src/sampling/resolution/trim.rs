//! Fewer cells by small steps from a cut that keeps the tolerance: rows and columns taken away, or exchanged.
//!
//! The error of a warped cell is that of its width times its height. So any proportion of rows to columns needs equally
//! many cells, but for whole numbers and for narrow pieces, which have one column in every proportion. Only trials find
//! the best one. They start from even rows and columns, which a plate that is warped evenly needs.

use super::demand::Density;
use super::search::{Plan, Rounds, SAFETY, Search, Tried};

/// Cells that thinning may measure, in addition to `TRIMMED_TIMES` times the number of cells.
const TRIMMED: usize = 150_000;

/// Multiple of the number of cells that thinning may measure.
const TRIMMED_TIMES: usize = 2;

/// Factor by which rows are fewer and columns more in each trial of another proportion, or the reverse.
const TILT: f64 = 1.19;

/// Largest number of cells for which even ones are tried. Whole numbers decide little among more cells.
const MOST_EVENED: usize = 10_000;

/// Trials of one proportion before it is given up. Each has rows by the load of the one before.
const TRIALS: usize = 4;

/// A cut with at least this load needs no fewer rows.
const ENOUGH: f64 = 0.97;

/// Trials of further proportions after one that did not take fewer cells: the next whole number may.
const PATIENCE: usize = 2;

/// An even cut is thinned if it has at most this multiple of the cells of the best one. Thinning seldom takes away more.
const NEARLY: f64 = 1.15;

impl Search<'_> {
    /// Removes columns and rows from a cut as long as the tolerance is kept.
    pub(super) fn thinned(&self, mut best: Tried, rounds: &mut Rounds<'_>) -> Tried {
        let mut left = TRIMMED + TRIMMED_TIMES * best.field.quads();
        let mut steps = [0.06; 2];
        let mut stuck = [false; 2];
        while !(stuck[0] && stuck[1]) {
            for at in 0..2 {
                if stuck[at] || best.field.quads() > left {
                    stuck[at] = true;
                    continue;
                }
                let (density, factor) = (&best.plan.densities[at], best.plan.factors[at]);
                let Some(fewer) = self.directions[at].fewer(density, factor) else {
                    stuck[at] = true;
                    continue;
                };
                let single = factor * (1.0 - steps[at]) >= fewer;
                let mut plan = best.plan.clone();
                plan.factors[at] = fewer.min(factor * (1.0 - steps[at]));
                let tried = self.tried(plan, rounds);
                left = left.saturating_sub(tried.field.quads());
                if tried.worst <= 1.0 {
                    best = tried;
                } else if single {
                    stuck[at] = true;
                } else {
                    steps[at] *= 0.4;
                }
            }
        }
        best
    }

    /// Tries even rows and columns, and exchanges one for the other as long as this takes fewer cells.
    pub(super) fn evened(&self, mut best: Tried, rounds: &mut Rounds<'_>) -> Tried {
        if best.field.quads() > MOST_EVENED {
            return best;
        }
        let counts = self.counts(&best.plan);
        let densities =
            counts.map(|count| Density { positions: vec![0.0, 1.0], cells: vec![count as f64] });
        let nearly = |tried: &Tried, best: &Tried| {
            tried.field.quads() as f64 <= NEARLY * best.field.quads() as f64
        };
        let even = self.with_rows(&densities, [1.0; 2], rounds);
        let Some(even) = even.filter(|even| nearly(even, &best)) else { return best };
        for by in [1.0 / TILT, TILT] {
            let mut factors = even.plan.factors;
            let mut since = 0;
            while since < PATIENCE {
                since += 1;
                factors = [factors[0] * by, factors[1] / by];
                let tried = self.with_rows(&densities, factors, rounds);
                let Some(tried) = tried.filter(|tried| nearly(tried, &best)) else { continue };
                let thinned = self.thinned(tried, rounds);
                if thinned.field.quads() < best.field.quads() {
                    factors = thinned.plan.factors;
                    (best, since) = (thinned, 0);
                }
            }
        }
        best
    }

    /// Returns the cut with the fewest rows that keeps the tolerance, of a few trials with these columns; `None` if none
    /// keeps it. The load of a warped cell is proportional to its height.
    fn with_rows(
        &self,
        densities: &[Density; 2],
        factors: [f64; 2],
        rounds: &mut Rounds<'_>,
    ) -> Option<Tried> {
        let mut plan = Plan { densities: densities.clone(), factors };
        let mut kept: Option<Tried> = None;
        for _ in 0..TRIALS {
            let tried = self.tried(plan.clone(), rounds);
            let worst = tried.worst;
            let fewer = kept.as_ref().is_none_or(|kept| tried.field.quads() < kept.field.quads());
            if worst <= 1.0 && fewer {
                kept = Some(tried);
            }
            if worst <= 1.0 && worst > ENOUGH {
                break;
            }
            plan.factors[0] *= worst.clamp(0.25, 2.0) * if worst > 1.0 { SAFETY } else { 1.0 };
        }
        kept
    }
}
