//! The B-spline kernels of the filters, computed directly.

/// Returns the integral of the B-spline of order `n` (1 to 3) and step 1 from minus infinity to
/// `z`, in [0, 1]. The kernel's middle is 0 and its support is `-n/2` to `n/2`.
#[must_use]
pub fn integral(n: usize, z: f64) -> f64 {
    let reach = 0.5 * n as f64;
    let z = z.clamp(-reach, reach);
    // Distance to the nearer end of the support.
    let rest = reach - z.abs();
    let below = match n {
        1 => rest,
        2 => 0.5 * rest * rest,
        _ if rest <= 1.0 => rest * rest * rest / 6.0,
        _ => 0.5 - z.abs() * (0.75 - z * z / 3.0),
    };
    if z < 0.0 { below } else { 1.0 - below }
}

/// Lists the texels under the B-spline of order `n` and this step centred at `x`, in texels. Each
/// has as its weight the kernel's integral over it.
#[cfg(test)]
pub fn weights(n: usize, x: f64, step: f64) -> impl Iterator<Item = (i64, f64)> {
    let reach = (0.5 * n as f64 * step) as i64 + 2;
    let up_to = move |i: i64| integral(n, (i as f64 - x) / step);
    (x as i64 - reach..=x as i64 + reach).map(move |i| (i, up_to(i + 1) - up_to(i)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_order_is_the_one_below_under_a_box() {
        // The integral of order n at z is the mean of the integral of order n - 1 over a unit
        // around z.
        for n in 2..=3 {
            for k in -40..=40 {
                let z = 0.05 * f64::from(k);
                let parts = 2000;
                let mean = (0..parts)
                    .map(|part| {
                        integral(n - 1, z - 0.5 + (f64::from(part) + 0.5) / f64::from(parts))
                    })
                    .sum::<f64>()
                    / f64::from(parts);
                // The midpoint rule with 2000 parts has this error.
                assert!((mean - integral(n, z)).abs() < 1e-6, "n {n}, z {z}");
            }
        }
    }

    #[test]
    fn it_begins_at_nothing_and_ends_at_one() {
        for n in 1..=3 {
            assert_eq!([-9.0, 0.0, 9.0].map(|z| integral(n, z)), [0.0, 0.5, 1.0]);
        }
    }
}
