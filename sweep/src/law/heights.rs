//! The integral of a law.

use super::Law;
use crate::curve::cut::Stop;

/// Cells of the table. Between two of its positions the integral is that of a cubic with the law's own values.
const CELLS: usize = 2048;

/// The integral of a law from 0, times a factor.
#[derive(Debug)]
pub(crate) struct Heights<'a> {
    law: &'a Law,
    factor: f64,
    /// Positions, rising from 0 to 1, with all keys and joints of the law.
    at: Vec<f64>,
    /// The integral up to each position.
    sums: Vec<f64>,
}

impl<'a> Heights<'a> {
    /// Integrates a law.
    pub(crate) fn new(law: &'a Law, factor: f64) -> Self {
        let evenly = (0..=CELLS).map(|i| i as f64 / CELLS as f64);
        let mut at: Vec<f64> = evenly.chain(law.joints()).collect();
        at.sort_by(f64::total_cmp);
        at.dedup();
        let mut sums = vec![0.0];
        for ends in at.windows(2) {
            let before = sums[sums.len() - 1];
            sums.push(before + simpson(law, ends[0], ends[1]));
        }
        Self { law, factor, at, sums }
    }

    /// Returns the integral up to a position, and the law there, both times the factor.
    pub(crate) fn at(&self, at: f64) -> (f64, f64) {
        let next = self.at.partition_point(|&position| position <= at).clamp(1, self.at.len() - 1);
        let rest = simpson(self.law, self.at[next - 1], at);
        (self.factor * (self.sums[next - 1] + rest), self.factor * self.law.at(at).0)
    }
}

/// Returns the integral of a law between two positions by Simpson's rule, which is exact for cubics.
fn simpson(law: &Law, from: f64, to: f64) -> f64 {
    let middle = law.at(0.5 * (from + to)).0;
    let [start, end] = [law.on(Stop::after(from)).0, law.on(Stop::before(to)).0];
    (to - from) * (start + 4.0 * middle + end) / 6.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::Ease;

    #[test]
    fn integrals_of_keys_are_exact() {
        let law = Law::keys(vec![[0.1, 2.0], [0.4, 5.0], [1.0, -1.0]], Ease::Smooth);
        // A smooth step has the mean of its ends.
        let expected = 0.1 * 2.0 + 0.3 * 3.5 + 0.6 * 2.0;
        assert!((Heights::new(&law, 3.0).at(1.0).0 - 3.0 * expected).abs() < 1e-12);
        let ramp = Law::total(4.0);
        assert!((Heights::new(&ramp, 1.0).at(0.3).0 - 0.18).abs() < 1e-15);
    }
}
