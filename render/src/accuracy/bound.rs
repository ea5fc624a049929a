//! The mean of weighted squared errors, and an upper bound of it.
//!
//! A bound by the normal distribution is wrong here. Most squared errors are tiny and a few are
//! large, so that a sample with a small mean has a small deviation as well. The bound is that of a
//! bet: a gambler stakes a part of the capital, again and again, on values below a supposed mean.
//! If the supposed mean is true, the capital exceeds `1 / a` with a chance of at most `a` (Ville's
//! inequality; I. Waudby-Smith and A. Ramdas, "Estimating means of bounded random variables by
//! betting", 2024, section 4). A supposed mean at which the best constant stake would have won more
//! than `1 / a` is therefore refused, and the bound is the largest mean that is not refused. The
//! logarithm of the capital is the dual form of the empirical likelihood (A. Owen, "Empirical
//! Likelihood Ratio Confidence Regions", 1990), whose usual threshold is lower by about a half.
//!
//! The best stake is known only afterwards, which no gambler could use. In exchange, the bound
//! knows of no value larger than those that it saw. `docs/accuracy.md` lists how often the bound
//! held.

/// Returns the mean of values, or 0 without values.
#[must_use]
pub fn mean(values: &[f64]) -> f64 {
    if values.is_empty() { 0.0 } else { values.iter().sum::<f64>() / values.len() as f64 }
}

/// Returns an estimate of the standard deviation of the mean of values, or 0 without values.
#[must_use]
pub fn deviation(values: &[f64]) -> f64 {
    let (mean, count) = (mean(values), values.len().max(1) as f64);
    let squares = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>();
    squares.sqrt() / count
}

/// Returns an upper bound of the mean of the distribution that `values` were drawn from. The bound
/// fails with a chance of about `risk`, in (0, 1).
///
/// The bound is at least the mean of the values and at most the largest value.
#[must_use]
pub fn upper(values: &[f64], risk: f64) -> f64 {
    let limit = (1.0 / risk).ln();
    let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let (mut held, mut refused) = (mean(values), largest);
    if values.is_empty() || held >= refused {
        return held;
    }
    // Each step halves the interval; 60 steps reach the precision of the numbers.
    for _ in 0..60 {
        let supposed = 0.5 * (held + refused);
        if capital(values, supposed, largest) > limit {
            refused = supposed;
        } else {
            held = supposed;
        }
    }
    refused
}

/// Returns the logarithm of the capital of the best constant stake, if the mean is supposed to be
/// `supposed`. It lies above the mean of the values and below `largest`, the largest of them.
fn capital(values: &[f64], supposed: f64, largest: f64) -> f64 {
    // A value above the supposed mean must not take more than the capital.
    let (mut low, mut high) = (0.0, 1.0 / (largest - supposed));
    // The logarithm is concave in the stake: the best one is where the slope is 0.
    for _ in 0..50 {
        let stake = 0.5 * (low + high);
        let slope: f64 = values
            .iter()
            .map(|value| (supposed - value) / (1.0 + stake * (supposed - value)))
            .sum();
        if slope > 0.0 {
            low = stake;
        } else {
            high = stake;
        }
    }
    values.iter().map(|value| (low * (supposed - value)).ln_1p()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::pattern::{fraction, mixed};
    use proptest::prelude::*;

    /// The variance of 0 and 2 is 1, and the mean of 400 such values has a deviation of 1 / 20.
    #[test]
    fn a_mean_deviates_less_than_its_values() {
        let values: Vec<f64> = (0..400).map(|k| f64::from(2 * (k % 2))).collect();
        assert!((deviation(&values) - 0.05).abs() < 1e-12);
        assert_eq!(deviation(&[]), 0.0);
    }

    #[test]
    fn one_value_is_its_own_bound() {
        assert_eq!(upper(&[0.5; 7], 0.05), 0.5);
        assert_eq!(upper(&[], 0.05), 0.0);
    }

    /// `n - 1` zeros and a one. A stake `s` against a supposed mean `p` gains the logarithm of `1 + s p`
    /// for each zero and that of `1 - s (1 - p)` for the one. The sum is largest at
    /// `s = (p - 1/n) / (p (1 - p))`: the divergence of two coins. The bound is the `p` at which `n` times
    /// the divergence of `1/n` from `p` is ln 20.
    #[test]
    fn the_bound_of_coins_is_that_of_chernoff() {
        let n = 200;
        let mut values = vec![0.0; n];
        values[3] = 1.0;
        let p = upper(&values, 0.05);
        let q = 1.0 / n as f64;
        let divergence = q * (q / p).ln() + (1.0 - q) * ((1.0 - q) / (1.0 - p)).ln();
        assert!((n as f64 * divergence - 20.0_f64.ln()).abs() < 1e-6, "{p}");
    }

    /// Draws from three heavy tails with known means. The bound fails in at most a twentieth of 400
    /// trials: with a true chance of a twentieth, more than 38 failures have a chance of 1e-4.
    #[test]
    fn the_bound_holds_for_heavy_tails() {
        type Tail = fn(f64) -> f64;
        let tails: [(&str, f64, Tail); 3] = [
            ("a rare large value", 0.01, |u| if u < 0.01 { 1.0 } else { 0.0 }),
            ("the square of an exponential", 2.0, |u| (1.0 - u).ln().powi(2)),
            ("the fourth power", 0.2, |u| u.powi(4)),
        ];
        for (name, true_mean, of) in tails {
            let fails = (0..400_u64).filter(|&trial| {
                let values: Vec<f64> =
                    (0..1000_u64).map(|k| of(fraction(mixed(mixed(trial) ^ k)))).collect();
                upper(&values, 0.05) < true_mean
            });
            let fails = fails.count();
            assert!(fails <= 38, "{name}: {fails} of 400");
        }
    }

    proptest! {
        /// A smaller risk gives a larger bound; the bound moves and grows with the values.
        #[test]
        fn bounds_are_ordered(values in prop::collection::vec(-1.0..3.0_f64, 2..60)) {
            let wide = upper(&values, 0.01);
            let narrow = upper(&values, 0.1);
            let largest = values.iter().copied().fold(f64::MIN, f64::max);
            prop_assert!(mean(&values) <= narrow && narrow <= wide && wide <= largest);
            let moved: Vec<f64> = values.iter().map(|x| 2.0 * x + 1.0).collect();
            // Sixty halvings leave the roundings of sums of sixty values.
            prop_assert!((upper(&moved, 0.01) - (2.0 * wide + 1.0)).abs() < 1e-9);
        }
    }
}
