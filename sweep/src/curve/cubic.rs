//! One cubic Bezier segment, in two dimensions or in three.
//!
//! ```text
//!     P(t) = (1-t)^3 p0 + 3 (1-t)^2 t p1 + 3 (1-t) t^2 p2 + t^3 p3,     t in [0, 1]
//! ```
//!
//! Derivatives are formed from differences of the control points, so a direction is right to its last digits
//! even where the speed is very small. Where the speed is zero, the direction is that of the first derivative
//! that is not zero.

use super::vector::Vector;
use kurbo::common::solve_cubic;

/// A speed below this fraction of the segment's largest counts as zero.
///
/// A handle this short bends the curve only over a billionth of its length, less than a picture can show.
/// With a much smaller value, a cusp whose control points are rounded to decimals would be missed.
pub const ZERO_SPEED: f64 = 1e-9;

/// Smallest difference of the parameters of two cusps, and of a cusp and an end. A cusp found twice differs by rounding;
/// a segment shorter than this part of another has no digits for a direction.
const APART: f64 = 1e-6;

/// A cubic Bezier segment, given by its four control points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cubic<V>(pub [V; 4]);

impl<V: Vector> Cubic<V> {
    /// Returns the straight segment from `a` to `b` with constant speed.
    pub fn line(a: V, b: V) -> Self {
        let third = (b - a) * (1.0 / 3.0);
        Self([a, a + third, b - third, b])
    }

    /// Returns the point at `t`: exactly the first control point at 0 and the last at 1.
    pub fn point(&self, t: f64) -> V {
        let [p0, p1, p2, p3] = self.0;
        let s = 1.0 - t;
        p0 * (s * s * s) + p1 * (3.0 * s * s * t) + p2 * (3.0 * s * t * t) + p3 * (t * t * t)
    }

    /// Returns the first derivative by `t`.
    pub fn velocity(&self, t: f64) -> V {
        let [d0, d1, d2] = self.differences();
        let s = 1.0 - t;
        (d0 * (s * s) + d1 * (2.0 * s * t) + d2 * (t * t)) * 3.0
    }

    /// Returns the second derivative by `t`.
    pub fn acceleration(&self, t: f64) -> V {
        let [d0, d1, d2] = self.differences();
        ((d1 - d0) * (1.0 - t) + (d2 - d1) * t) * 6.0
    }

    /// Returns the unit tangent at `t`, one-sided at the ends; the zero vector for a segment of no size.
    ///
    /// Where the speed is zero, the tangent is the direction in which the segment leaves its nearer end.
    pub fn tangent(&self, t: f64) -> V {
        let velocity = self.velocity(t);
        let slow = 3.0 * ZERO_SPEED * self.size();
        if velocity.length() > slow {
            return velocity * (1.0 / velocity.length());
        }
        let [d0, d1, d2] = self.differences();
        let candidates = if t < 0.5 { [d0, d1, d2] } else { [d2, d1, d0] };
        candidates
            .into_iter()
            .find(|d| 3.0 * d.length() > slow)
            .map_or(V::ZERO, |d| d * (1.0 / d.length()))
    }

    /// Returns the curvature vector at `t`: the derivative of the unit tangent by arc length.
    ///
    /// The zero vector where the speed is zero, although the curvature is unbounded there.
    pub fn curvature(&self, t: f64) -> V {
        let velocity = self.velocity(t);
        let speed = velocity.length();
        if speed <= 3.0 * ZERO_SPEED * self.size() {
            return V::ZERO;
        }
        let tangent = velocity * (1.0 / speed);
        let acceleration = self.acceleration(t) * (1.0 / speed);
        (acceleration - tangent * acceleration.dot(tangent)) * (1.0 / speed)
    }

    /// Returns the derivative of the curvature by arc length; the zero vector where the speed is zero.
    pub fn third(&self, t: f64) -> V {
        let velocity = self.velocity(t);
        let speed = velocity.length();
        if speed <= 3.0 * ZERO_SPEED * self.size() {
            return V::ZERO;
        }
        let tangent = velocity * (1.0 / speed);
        let curvature = self.curvature(t);
        let [d0, d1, d2] = self.differences();
        let jerk = ((d2 - d1) - (d1 - d0)) * (6.0 / speed);
        let across = jerk - tangent * jerk.dot(tangent);
        let lag = self.acceleration(t).dot(tangent) / speed;
        (across * (1.0 / speed) - curvature * (3.0 * lag)) * (1.0 / speed)
            - tangent * curvature.dot(curvature)
    }

    /// Returns the length of the longest side of the control polygon.
    pub fn size(&self) -> f64 {
        self.differences().into_iter().map(Vector::length).fold(0.0, f64::max)
    }

    /// Returns the segment in the opposite direction.
    pub fn reversed(&self) -> Self {
        let [p0, p1, p2, p3] = self.0;
        Self([p3, p2, p1, p0])
    }

    /// Returns the part between two parameters.
    pub fn part(&self, from: f64, to: f64) -> Self {
        if (from, to) == (0.0, 1.0) {
            return *self;
        }
        let width = (to - from) / 3.0;
        let (start, end) = (self.point(from), self.point(to));
        let (leaving, reaching) = (self.velocity(from), self.velocity(to));
        Self([start, start + leaving * width, end - reaching * width, end])
    }

    /// Returns whether the inner control points lie on the line between the ends. `part` is the tolerance as
    /// a fraction of that line's length. The rounding of coordinates far from the origin is added to the
    /// tolerance.
    pub fn is_straight(&self, part: f64) -> bool {
        let [p0, p1, p2, p3] = self.0;
        let chord = p3 - p0;
        let length = chord.length();
        let rounding = 4.0 * f64::EPSILON * p0.length().max(p3.length());
        [p1 - p0, p2 - p0].into_iter().all(|d| {
            let along = d.dot(chord) / (length * length);
            let off = (d - chord * along).length();
            (0.0..=1.0).contains(&along) && off <= part * length + rounding
        })
    }

    /// Splits the segment at each inner point where the speed is zero.
    ///
    /// The parts meet there with handles of no length, so each part has its own tangent.
    pub fn split_at_cusps(&self) -> Vec<Self> {
        let mut parts = vec![*self];
        let mut before = 0.0;
        for t in self.cusps() {
            let Some(last) = parts.pop() else { break };
            parts.extend(last.split((t - before) / (1.0 - before)));
            before = t;
        }
        parts
    }

    /// Returns the parameters inside the segment where the speed is zero, rising.
    fn cusps(&self) -> Vec<f64> {
        let size = self.size();
        if size == 0.0 {
            return Vec::new();
        }
        // The velocity is a + b t + c t^2, in units of the size.
        let [d0, d1, d2] = self.differences().map(|d| d * (1.0 / size));
        let (a, b, c) = (d0, (d1 - d0) * 2.0, d0 - d1 * 2.0 + d2);
        // The speed is least where half the derivative of its square is zero.
        let [k0, k1, k2, k3] =
            [a.dot(b), b.dot(b) + 2.0 * a.dot(c), 3.0 * b.dot(c), 2.0 * c.dot(c)];
        let slope = |t: f64| ((k3 * t + k2) * t + k1) * t + k0;
        let slope_change = |t: f64| (3.0 * k3 * t + 2.0 * k2) * t + k1;
        let mut found: Vec<f64> = solve_cubic(k0, k1, k2, k3)
            .into_iter()
            .map(|t| {
                // The closed form loses half its digits; at a cusp the root is simple, so Newton's method
                // restores them.
                (0..4).fold(t, |t, _| {
                    let step = slope(t) / slope_change(t);
                    if step.is_finite() { t - step } else { t }
                })
            })
            .filter(|&t| t > APART && t < 1.0 - APART)
            .filter(|&t| (a + b * t + c * (t * t)).length() <= ZERO_SPEED)
            .collect();
        found.sort_by(f64::total_cmp);
        found.dedup_by(|later, earlier| *later - *earlier < APART);
        found
    }

    /// Returns the parts before and after the cusp at `t`.
    fn split(&self, t: f64) -> [Self; 2] {
        let mix = |a: V, b: V| a * (1.0 - t) + b * t;
        let [p0, p1, p2, p3] = self.0;
        let (a, b, c) = (mix(p0, p1), mix(p1, p2), mix(p2, p3));
        let middle = mix(mix(a, b), mix(b, c));
        [Self([p0, a, middle, middle]), Self([middle, middle, c, p3])]
    }

    fn differences(&self) -> [V; 3] {
        let [p0, p1, p2, p3] = self.0;
        [p1 - p0, p2 - p1, p3 - p2]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec2, DVec3};

    fn arch() -> Cubic<DVec3> {
        Cubic([
            DVec3::ZERO,
            DVec3::new(1.0, 2.0, 0.5),
            DVec3::new(3.0, 2.0, -1.0),
            DVec3::new(4.0, 0.0, 0.3),
        ])
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let (curve, h) = (arch(), 1e-5);
        for i in 1..10 {
            let t = f64::from(i) / 10.0;
            let velocity = (curve.point(t + h) - curve.point(t - h)) / (2.0 * h);
            assert!((velocity - curve.velocity(t)).length() < 1e-8);
            let acceleration = (curve.velocity(t + h) - curve.velocity(t - h)) / (2.0 * h);
            assert!((acceleration - curve.acceleration(t)).length() < 1e-8);
            let turning = (curve.tangent(t + h) - curve.tangent(t - h)) / (2.0 * h);
            let curvature = turning / curve.velocity(t).length();
            assert!((curvature - curve.curvature(t)).length() < 1e-8);
            let bending = (curve.curvature(t + h) - curve.curvature(t - h)) / (2.0 * h);
            let third = bending / curve.velocity(t).length();
            assert!((third - curve.third(t)).length() < 1e-8);
        }
    }

    #[test]
    fn a_part_runs_along_the_whole() {
        let part = arch().part(0.3, 0.8);
        for i in 0..=10 {
            let t = f64::from(i) / 10.0;
            assert!((part.point(t) - arch().point(0.3 + 0.5 * t)).length() < 1e-15 * 8.0);
        }
        assert!(!arch().is_straight(1e-9));
        assert!(Cubic::line(DVec3::ONE, DVec3::X * 9.0).part(0.1, 0.4).is_straight(1e-15));
    }

    #[test]
    fn a_handle_of_no_length_has_the_tangent_of_the_next() {
        let (o, a, b) = (DVec2::ZERO, DVec2::new(1.0, 1.0), DVec2::new(2.0, 0.0));
        let start = Cubic([o, o, a, b]);
        assert!((start.tangent(0.0) - a.normalize()).length() < 1e-15);
        assert!((start.tangent(1e-12) - a.normalize()).length() < 1e-9);
        let end = start.reversed();
        assert!((end.tangent(1.0) + a.normalize()).length() < 1e-15);
        let both = Cubic([o, o, b, b]);
        assert_eq!(both.tangent(0.0), DVec2::X);
        assert_eq!(both.tangent(1.0), DVec2::X);
        assert_eq!(Cubic([a; 4]).tangent(0.5), DVec2::ZERO);
    }

    #[test]
    fn a_cusp_is_split_into_parts_with_their_own_tangents() {
        // Handles that cross exactly: the speed is zero in the middle.
        let cusp = Cubic([
            DVec2::new(0.0, 0.0),
            DVec2::new(1.0, 1.0),
            DVec2::new(0.0, 1.0),
            DVec2::new(1.0, 0.0),
        ]);
        let parts = cusp.split_at_cusps();
        assert_eq!(parts.len(), 2);
        assert!((parts[0].0[3] - DVec2::new(0.5, 0.75)).length() < 1e-15);
        assert!((parts[0].tangent(1.0) - DVec2::Y).length() < 1e-12);
        assert!((parts[1].tangent(0.0) + DVec2::Y).length() < 1e-12);
        assert_eq!(arch().split_at_cusps(), [arch()]);
    }

    #[test]
    fn a_line_that_turns_back_twice_has_two_cusps() {
        let x = |v: f64| DVec2::new(v, 0.0);
        let parts = Cubic([x(0.0), x(3.0), x(-2.0), x(1.0)]).split_at_cusps();
        let directions: Vec<f64> = parts.iter().map(|part| part.tangent(0.5).x.round()).collect();
        assert_eq!(directions, [1.0, -1.0, 1.0]);
    }
}
