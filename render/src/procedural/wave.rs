//! Waves with two values, and the averages of their products over a patch.
//!
//! Checkers and bricks are products of waves along three axes. The average over a patch is
//! computed on the square of a [`Form`]. The square is split into strips along the axis on which
//! the fewest cells are crossed. The remaining two axes `y` and `x` are integrated along the edges
//! of each strip. By Green's theorem the integral of `v(y) w(x)` over a polygon is
//!
//! ```text
//!   sum over edges of the integral of v(y) W(x) dy, divided by dx dy / da db,   W' = w
//! ```
//!
//! Where this divisor is small, strips are split along `y` too, and the divergence theorem gives
//! the integral of `w(x)` alone:
//!
//! ```text
//!   sum over edges of (mean of W on the edge) (gradient x edge) / |gradient|^2
//! ```
//!
//! where `gradient` is that of `x` on the square. `W` is the sum of a linear and a periodic
//! function. The mean of the periodic function follows from its own periodic integral.

use super::convex::Convex;
use super::patch::Form;
use glam::DVec2;

/// Extent in periods from which the last axis is integrated in closed form. Below it the polygon is
/// split as along the other axes. The closed form divides by the extent, so its rounding grows
/// where the extent is small. A larger number splits more and costs time.
const CLOSED_FROM: f64 = 1.0;

/// Divisor of Green's theorem, in square periods, from which two axes are integrated along edges.
/// Below it the rounding of the quotient grows, and splitting costs little.
const GREEN_FROM: f64 = 1.0;

/// Difference of two positions, in periods, below which the mean between them is the value in their
/// middle. The mean's error is at most this difference. A smaller number lets the rounding of a
/// quotient grow.
const SAME: f64 = 1e-8;

/// A function of period 1 with two values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wave {
    /// End of the interval from 0 on which the wave has the first value; 0 to 1.
    pub width: f64,
    /// Value from 0 to `width`, and from there to 1.
    pub values: [f64; 2],
}

impl Wave {
    /// Returns the value 1 from 0 to `width`, and 0 from there to 1.
    #[must_use]
    pub fn pulse(width: f64) -> Self {
        Self { width, values: [1.0, 0.0] }
    }

    /// Calls `visit` for each part of the polygon on which the wave is constant and not 0, with the
    /// value and the number of the period that contains the part.
    pub fn strips(&self, form: &Form, polygon: &Convex, visit: &mut impl FnMut(&Convex, f64, f64)) {
        let [low, high] = polygon.range(form);
        let mut rest = *polygon;
        let mut period = low.floor();
        // NaN ends the loop: an empty polygon has no strips.
        while period <= high {
            let ends = [(period + self.width, self.values[0]), (period + 1.0, self.values[1])];
            for (end, value) in ends {
                if end > low && end < high {
                    let [strip, above] = rest.split(form, end);
                    if value != 0.0 {
                        visit(&strip, value, period);
                    }
                    rest = above;
                } else if end >= high {
                    if value != 0.0 {
                        visit(&rest, value, period);
                    }
                    return;
                }
            }
            period += 1.0;
        }
    }

    /// Returns the integral over a polygon in closed form. The form's slopes may not both be 0.
    fn integral(&self, form: &Form, polygon: &Convex) -> f64 {
        let sum: f64 = polygon
            .edges()
            .map(|[from, to]| {
                let across = form.slopes.perp_dot(to - from);
                across * self.mean_primitive(form.at(from), form.at(to))
            })
            .sum();
        sum / form.slopes.length_squared()
    }

    /// Returns the integral of `self(y) W(x) dy` along an edge, where `W` is an integral of
    /// `inner`. Points of the edge are `(x, y)`.
    fn along(&self, inner: &Self, [from, to]: [DVec2; 2]) -> f64 {
        let ([low, high], sign) =
            if from.y <= to.y { ([from, to], 1.0) } else { ([to, from], -1.0) };
        let slope = (high.x - low.x) / (high.y - low.y);
        let (mut sum, mut start) = (0.0, low);
        let mut period = low.y.floor();
        while period <= high.y {
            let ends = [(period + self.width, self.values[0]), (period + 1.0, self.values[1])];
            for (end, value) in ends {
                if end <= start.y {
                    continue;
                }
                let last = end >= high.y;
                let stop = if last { high } else { DVec2::new(low.x + slope * (end - low.y), end) };
                if value != 0.0 {
                    sum += value * (stop.y - start.y) * inner.mean_primitive(start.x, stop.x);
                }
                if last {
                    return sign * sum;
                }
                start = stop;
            }
            period += 1.0;
        }
        sign * sum
    }

    /// Returns the average over the whole square.
    #[must_use]
    pub fn alone(&self, form: &Form) -> f64 {
        average([(*form, *self)])
    }

    /// Returns the mean, between two positions, of an integral of the wave.
    fn mean_primitive(&self, from: f64, to: f64) -> f64 {
        let [inside, outside] = self.values;
        let middle = 0.5 * (from + to);
        let periodic = if (to - from).abs() < SAME {
            self.periodic(middle)
        } else {
            (self.second(to) - self.second(from)) / (to - from)
        };
        (outside + (inside - outside) * self.width) * middle + (inside - outside) * periodic
    }

    /// Returns the periodic part of the pulse's integral, less its mean.
    fn periodic(&self, at: f64) -> f64 {
        let (f, t) = (self.width, at - at.floor());
        let slope = if t < f { t * (1.0 - f) } else { f * (1.0 - t) };
        slope - 0.5 * f * (1.0 - f)
    }

    /// Returns an integral of [`Wave::periodic`], which is periodic too.
    fn second(&self, at: f64) -> f64 {
        let (f, t) = (self.width, at - at.floor());
        if t < f {
            0.5 * (1.0 - f) * t * (t - f)
        } else {
            let left = 1.0 - t;
            0.5 * f * left * (1.0 - f - left)
        }
    }
}

/// Returns the average, over the whole square, of the product of waves. Each wave comes with its
/// argument, whose middle is replaced by 0 if it is not finite.
#[must_use]
pub fn average<const N: usize>(mut factors: [(Form, Wave); N]) -> f64 {
    for (form, _) in &mut factors {
        form.middle -= form.middle.floor();
        if form.middle.is_nan() {
            form.middle = 0.0;
        }
    }
    factors.sort_by(|(a, _), (b, _)| a.extent().total_cmp(&b.extent()));
    integral(&Convex::square(), &factors)
}

/// Returns the integral over a polygon of the product of waves.
fn integral(polygon: &Convex, factors: &[(Form, Wave)]) -> f64 {
    match factors {
        [] => polygon.area(),
        [(form, wave)] if form.extent() >= CLOSED_FROM => wave.integral(form, polygon),
        [(y, outer), (x, inner)] if y.slopes.perp_dot(x.slopes).abs() >= GREEN_FROM => {
            let edges = polygon.edges().map(|edge| edge.map(|at| DVec2::new(x.at(at), y.at(at))));
            let sum: f64 = edges.map(|edge| outer.along(inner, edge)).sum();
            sum / x.slopes.perp_dot(y.slopes)
        }
        [(form, wave), rest @ ..] => {
            let mut sum = 0.0;
            wave.strips(form, polygon, &mut |strip, value, _| {
                sum += value * integral(strip, rest);
            });
            sum
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The integral by splitting along all axes, without any closed form.
    fn split(polygon: &Convex, factors: &[(Form, Wave)]) -> f64 {
        let [(form, wave), rest @ ..] = factors else { return polygon.area() };
        let mut sum = 0.0;
        wave.strips(form, polygon, &mut |strip, value, _| sum += value * split(strip, rest));
        sum
    }

    fn any_factor() -> impl Strategy<Value = (Form, Wave)> {
        let form = (0.0..1.0f64, -4.0..4.0f64, -4.0..4.0f64);
        let wave = (0.0..=1.0f64, -1.0..1.0f64, -1.0..1.0f64);
        (form, wave).prop_map(|((middle, a, b), (width, inside, outside))| {
            let wave = Wave { width, values: [inside, outside] };
            (Form { middle, slopes: DVec2::new(a, b) }, wave)
        })
    }

    proptest! {
        /// Positions are rounded to 1e-15 and differ by at least 1e-8 where one divides by their
        /// difference. An area of 1 divides a perimeter of up to 16 periods.
        #[test]
        fn closed_forms_are_sums_of_parts(factors in prop::array::uniform3(any_factor())) {
            let square = Convex::square();
            prop_assert!((average(factors) - split(&square, &factors)).abs() < 1e-5);
            let two = [factors[0], factors[1]];
            prop_assert!((average(two) - split(&square, &two)).abs() < 1e-5);
            let one = [factors[0]];
            prop_assert!((factors[0].1.alone(&factors[0].0) - split(&square, &one)).abs() < 1e-5);
        }

        /// An integral grows by the wave's value; both values are tested beside their interval.
        #[test]
        fn a_primitive_is_an_integral(from in -3.0..3.0f64, length in 0.0..2.0f64, width in 0.0..1.0f64) {
            let wave = Wave { width, values: [0.7, -0.4] };
            // At one position the mean of the primitive is its value.
            let primitive = |at: f64| wave.mean_primitive(at, at);
            let steps = 2000;
            let value = |k: u32| {
                let at = from + length * (f64::from(k) + 0.5) / f64::from(steps);
                if at.rem_euclid(1.0) < width { 0.7 } else { -0.4 }
            };
            let sum = (0..steps).map(value).sum::<f64>() * length / f64::from(steps);
            // Up to six jumps of 1.1 are each misplaced by half a step of 0.001.
            prop_assert!((primitive(from + length) - primitive(from) - sum).abs() < 4e-3);
        }
    }
}
