//! Integration by adaptive halving with the eight-point Gauss-Legendre rule.

/// Most halvings of one interval: a kink is then confined to 2^-48 of it.
const DEEPEST: u32 = 48;

/// Nodes in (0, 1), mirrored about 0, with their weights.
const RULE: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

/// Returns the integral of `f` from `a` to `b`.
///
/// An interval is halved until the sum of its halves agrees with the whole to `tolerance`, an absolute
/// number. The sum of the halves is returned, so the error is far smaller where `f` is smooth.
pub fn integrate(f: &impl Fn(f64) -> f64, a: f64, b: f64, tolerance: f64) -> f64 {
    refine(f, a, b, gauss(f, a, b), tolerance, DEEPEST)
}

fn refine(f: &impl Fn(f64) -> f64, a: f64, b: f64, whole: f64, tolerance: f64, left: u32) -> f64 {
    let middle = 0.5 * (a + b);
    let (first, second) = (gauss(f, a, middle), gauss(f, middle, b));
    let sum = first + second;
    let change = (sum - whole).abs();
    if left == 0 || change <= tolerance || change.is_nan() {
        return sum;
    }
    refine(f, a, middle, first, tolerance, left - 1)
        + refine(f, middle, b, second, tolerance, left - 1)
}

fn gauss(f: &impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
    let (center, half) = (0.5 * (a + b), 0.5 * (b - a));
    let sum: f64 = RULE
        .iter()
        .map(|&(x, weight)| weight * (f(center - half * x) + f(center + half * x)))
        .sum();
    half * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_up_to_degree_fifteen_are_exact() {
        let integral = gauss(&|x: f64| 16.0 * x.powi(15), 0.0, 1.0);
        assert!((integral - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_kink_is_found() {
        let at = 0.3_f64.sqrt();
        let integral = integrate(&|x: f64| (x - at).abs(), 0.0, 1.0, 1e-14);
        let truth = 0.5 * (at * at + (1.0 - at) * (1.0 - at));
        assert!((integral - truth).abs() < 1e-14);
    }

    #[test]
    fn what_is_not_a_number_comes_back_as_such() {
        assert!(integrate(&|_| f64::NAN, 0.0, 1.0, 1e-14).is_nan());
    }
}
