//! Arc length of one cubic segment, and the inverse function.
//!
//! The length from the start is a table over equal cells of the parameter, plus an adaptive Gauss-Legendre
//! integral inside one cell. The inverse finds its cell in the table and continues with Newton's method
//! inside a bracket that every step narrows. A step that would leave the bracket (near a cusp the speed is
//! almost zero) is replaced by a bisection. The iteration stops by the length at the parameter found, because
//! the parameter itself is ill-defined where the speed vanishes.

use super::cubic::Cubic;
use super::quadrature::integrate;
use super::vector::Vector;

/// Cells of the table. With more cells the inverse starts nearer and the table takes longer to build. With 16
/// cells, smooth curves need two or three Newton steps.
const CELLS: usize = 16;

/// Tolerance of the integral, as a fraction of the control polygon's length.
const TOLERANCE: f64 = 1e-14;

/// Most steps of the inverse; bisection alone needs 53.
const STEPS: usize = 128;

/// The length of a cubic segment as a function of its parameter.
#[derive(Debug, Clone)]
pub struct ArcLength<V> {
    cubic: Cubic<V>,
    tolerance: f64,
    /// Length from the start of the segment to the parameter `i / CELLS`.
    table: [f64; CELLS + 1],
}

impl<V: Vector> ArcLength<V> {
    /// Measures the segment.
    pub fn new(cubic: Cubic<V>) -> Self {
        let mut lengths =
            Self { cubic, tolerance: TOLERANCE * 3.0 * cubic.size(), table: [0.0; CELLS + 1] };
        for cell in 0..CELLS {
            lengths.table[cell + 1] =
                lengths.table[cell] + lengths.between(knot(cell), knot(cell + 1));
        }
        lengths
    }

    /// Returns the length of the whole segment.
    pub fn total(&self) -> f64 {
        self.table[CELLS]
    }

    /// Returns the length from the start to the parameter `t` in `[0, 1]`.
    pub fn length_to(&self, t: f64) -> f64 {
        let cell = ((t * CELLS as f64) as usize).min(CELLS - 1);
        self.table[cell] + self.between(knot(cell), t)
    }

    /// Returns the parameter in `[0, 1]` at length `s` from the start; `s` outside the segment gives its ends.
    pub fn parameter_at(&self, s: f64) -> f64 {
        if s.is_nan() || s <= 0.0 {
            return 0.0;
        }
        if s >= self.total() {
            return 1.0;
        }
        let cell = self.table.partition_point(|&length| length <= s).clamp(1, CELLS) - 1;
        let (from, to) = (self.table[cell], self.table[cell + 1]);
        let (mut low, mut high) = (knot(cell), knot(cell + 1));
        let mut t = low + (high - low) * ((s - from) / (to - from));
        for _ in 0..STEPS {
            let excess = from + self.between(knot(cell), t) - s;
            if excess.abs() <= 2.0 * f64::EPSILON * self.total() {
                break;
            }
            if excess > 0.0 {
                high = t;
            } else {
                low = t;
            }
            let newton = t - excess / self.cubic.velocity(t).length();
            t = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if t <= low || t >= high {
                break;
            }
        }
        t
    }

    fn between(&self, a: f64, b: f64) -> f64 {
        integrate(&|t| self.cubic.velocity(t).length(), a, b, self.tolerance)
    }
}

/// Returns the parameter at which a cell begins.
fn knot(cell: usize) -> f64 {
    cell as f64 / CELLS as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec2, DVec3};

    /// Returns the largest `|s(t(s)) - s|`, as a fraction of the length.
    fn inverse_error<V: Vector>(points: [V; 4]) -> f64 {
        let lengths = ArcLength::new(Cubic(points));
        let total = lengths.total();
        (0..=1000)
            .map(|i| total * f64::from(i) / 1000.0)
            .map(|s| (lengths.length_to(lengths.parameter_at(s)) - s).abs() / total)
            .fold(0.0, f64::max)
    }

    #[test]
    fn a_parabola_has_its_length() {
        // y = x^2 over [0, 1], as a cubic.
        let third = 1.0 / 3.0;
        let parabola = Cubic([
            DVec2::ZERO,
            DVec2::new(third, 0.0),
            DVec2::new(2.0 * third, third),
            DVec2::ONE,
        ]);
        let truth = 0.5 * 5_f64.sqrt() + 0.25 * 2_f64.asinh();
        let error = ArcLength::new(parabola).total() / truth - 1.0;
        assert!(error.abs() < 1e-15, "{error:e}");
    }

    #[test]
    fn a_line_is_measured_exactly() {
        let lengths = ArcLength::new(Cubic::line(DVec3::ZERO, DVec3::new(2.0, 3.0, 6.0)));
        assert!((lengths.total() - 7.0).abs() < 1e-14);
        assert!((lengths.parameter_at(1.75) - 0.25).abs() < 1e-15);
    }

    #[test]
    fn a_line_with_handles_of_no_length_has_a_cubic_length() {
        let (a, b) = (DVec3::ZERO, DVec3::X);
        let lengths = ArcLength::new(Cubic([a, a, b, b]));
        for i in 0..=100 {
            let t = f64::from(i) / 100.0;
            assert!((lengths.length_to(t) - t * t * (3.0 - 2.0 * t)).abs() < 1e-15);
        }
        assert!(inverse_error([a, a, b, b]) < 1e-15);
    }

    #[test]
    fn a_semicubical_cusp_has_its_length() {
        // (t^2, t^3) from -1 to 1.1 in closed form. The cusp does not lie at the end of a table cell.
        let shift = 0.1;
        let (from, to) = (-1.0, 1.0 + shift);
        let half = |t: f64| ((4.0 + 9.0 * t * t).powf(1.5) - 8.0) / 27.0;
        let cubic = Cubic(blossom(from, to));
        let truth = half(from) + half(to);
        let error = ArcLength::new(cubic).total() / truth - 1.0;
        assert!(error.abs() < 1e-12, "{error:e}");
    }

    /// Returns the control points of (t^2, t^3) over an interval.
    fn blossom(a: f64, b: f64) -> [DVec2; 4] {
        let at = |x: f64, y: f64, z: f64| DVec2::new((x * y + y * z + z * x) / 3.0, x * y * z);
        [at(a, a, a), at(a, a, b), at(a, b, b), at(b, b, b)]
    }

    #[test]
    fn the_inverse_holds_on_nasty_curves() {
        let p = DVec2::new;
        let (o, e) = (DVec2::ZERO, DVec2::X);
        let smooth = [o, p(1.0, 2.0), p(2.0, -2.0), p(3.0, 0.0)];
        assert!(inverse_error(smooth) < 1e-15, "{:e}", inverse_error(smooth));
        for gap in [0.0, 1e-12, 1e-9, 1e-6, 1e-4, 1e-2] {
            let cusp = [o, p(1.0 - gap, 1.0), p(gap, 1.0), e];
            assert!(inverse_error(cusp) < 1e-12, "gap {gap}: {:e}", inverse_error(cusp));
            let off_center = [o, p(1.0 - gap, 1.0), p(gap, 0.9), p(1.0, 0.1)];
            assert!(inverse_error(off_center) < 1e-12);
        }
        for short in [0.0, 1e-300, 1e-12, 1e-6] {
            let ends = [o, p(short, 0.0), p(1.0, 1.0 - short), DVec2::ONE];
            assert!(inverse_error(ends) < 1e-12);
        }
        assert!(inverse_error([o, e * 3.0, e * -2.0, e]) < 1e-12, "turning back");
        assert!(inverse_error([o, e * 1e6, e, e]) < 1e-12, "a long handle");
    }

    #[test]
    fn a_segment_of_no_size_does_not_hang() {
        let lengths = ArcLength::new(Cubic([DVec2::ONE; 4]));
        assert_eq!(lengths.total(), 0.0);
        assert_eq!(lengths.parameter_at(0.5), 1.0);
        assert_eq!(lengths.parameter_at(f64::NAN), 0.0);
    }
}
