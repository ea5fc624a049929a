//! A C2 cubic spline through free points, given as Bezier segments.
//!
//! The knots are centripetal: a chord's interval is the square root of its length (E. T. Y. Lee,
//! "Choosing nodes in parametric curve interpolation", 1989). Such knots keep the curve close to
//! unevenly spaced points. An open curve has no curvature at its ends (the natural spline). A
//! closed curve has the same tangent and curvature on both sides of its start.

use super::cubic::Cubic;
use super::vector::Vector;

/// Returns the spline through `points`, in their order; neighbours must differ.
///
/// A closed spline needs three points and has as many segments as points. An open spline needs two points and
/// has one segment fewer than points. With fewer points there are no segments.
pub fn through<V: Vector>(points: &[V], closed: bool) -> Vec<Cubic<V>> {
    let count = points.len();
    if count < if closed { 3 } else { 2 } {
        return Vec::new();
    }
    let segments = if closed { count } else { count - 1 };
    let chords: Vec<V> = (0..segments).map(|i| points[(i + 1) % count] - points[i]).collect();
    // Only ratios of intervals matter; the largest interval is 1.
    let longest = chords.iter().map(|chord| chord.length()).fold(0.0, f64::max);
    let steps: Vec<f64> = chords.iter().map(|chord| (chord.length() / longest).sqrt()).collect();
    let slopes: Vec<V> =
        chords.iter().zip(&steps).map(|(&chord, &step)| chord * (1.0 / step)).collect();
    let derivatives = if closed { periodic(&steps, &slopes) } else { natural(&steps, &slopes) };
    (0..segments)
        .map(|i| {
            let (from, to) = (points[i], points[(i + 1) % count]);
            let third = steps[i] / 3.0;
            let end = (i + 1) % count;
            Cubic([from, from + derivatives[i] * third, to - derivatives[end] * third, to])
        })
        .collect()
}

/// Returns the derivatives at the points of an open spline without curvature at its ends.
fn natural<V: Vector>(steps: &[f64], slopes: &[V]) -> Vec<V> {
    let last = steps.len();
    let mut rows = Vec::with_capacity(last + 1);
    rows.push(Row { lower: 0.0, middle: 2.0, upper: 1.0, right: slopes[0] * 3.0 });
    rows.extend((1..last).map(|i| smooth_at(steps, slopes, i - 1, i)));
    rows.push(Row { lower: 1.0, middle: 2.0, upper: 0.0, right: slopes[last - 1] * 3.0 });
    solve(&rows)
}

/// Returns the derivatives at the points of a closed spline.
///
/// The two elements in the corners of the matrix are separated as a product of two vectors (Sherman and
/// Morrison). Two tridiagonal systems remain.
fn periodic<V: Vector>(steps: &[f64], slopes: &[V]) -> Vec<V> {
    let count = steps.len();
    let mut rows: Vec<Row<V>> =
        (0..count).map(|i| smooth_at(steps, slopes, (i + count - 1) % count, i)).collect();
    let (top, bottom) = (rows[0].lower, rows[count - 1].upper);
    let shift = -rows[0].middle;
    rows[0].middle -= shift;
    rows[count - 1].middle -= top * bottom / shift;
    let plain = solve(&rows);
    let mut corner: Vec<Row<f64>> = rows
        .iter()
        .map(|row| Row { lower: row.lower, middle: row.middle, upper: row.upper, right: 0.0 })
        .collect();
    corner[0].right = shift;
    corner[count - 1].right = bottom;
    let corner = solve(&corner);
    let ratio = top / shift;
    let scale = 1.0 / (1.0 + corner[0] + ratio * corner[count - 1]);
    let excess = (plain[0] + plain[count - 1] * ratio) * scale;
    plain.iter().zip(&corner).map(|(&value, &part)| value - excess * part).collect()
}

/// One equation: `lower x[i-1] + middle x[i] + upper x[i+1] = right`.
struct Row<V> {
    lower: f64,
    middle: f64,
    upper: f64,
    right: V,
}

/// Returns the equation that the second derivatives before and after a point agree.
fn smooth_at<V: Vector>(steps: &[f64], slopes: &[V], before: usize, after: usize) -> Row<V> {
    let (h, k) = (steps[before], steps[after]);
    Row {
        lower: k,
        middle: 2.0 * (h + k),
        upper: h,
        right: (slopes[before] * k + slopes[after] * h) * 3.0,
    }
}

/// Solves a tridiagonal system whose middle elements dominate.
fn solve<V: Vector>(rows: &[Row<V>]) -> Vec<V> {
    let mut uppers = Vec::with_capacity(rows.len());
    let mut values: Vec<V> = Vec::with_capacity(rows.len());
    let (mut upper, mut value) = (0.0, V::ZERO);
    for row in rows {
        let pivot = 1.0 / (row.middle - row.lower * upper);
        value = (row.right - value * row.lower) * pivot;
        upper = row.upper * pivot;
        uppers.push(upper);
        values.push(value);
    }
    for i in (0..rows.len().saturating_sub(1)).rev() {
        values[i] = values[i] - values[i + 1] * uppers[i];
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::turn;
    use glam::{DVec2, DVec3};

    fn uneven() -> Vec<DVec3> {
        [[0.0, 0.0, 0.0], [1.0, 0.3, 0.0], [1.2, 1.0, 0.4], [3.0, 1.0, 1.0], [2.0, -2.0, 0.5]]
            .map(DVec3::from_array)
            .to_vec()
    }

    /// Returns the second derivative by the spline's own parameter.
    fn second(cubic: &Cubic<DVec3>, t: f64, points: &[DVec3], i: usize) -> DVec3 {
        let step = (points[(i + 1) % points.len()] - points[i]).length();
        cubic.acceleration(t) / step
    }

    #[test]
    fn it_goes_through_its_points_with_two_derivatives() {
        let points = uneven();
        for closed in [false, true] {
            let spline = through(&points, closed);
            assert_eq!(spline.len(), if closed { 5 } else { 4 });
            let joints = if closed { 0..5 } else { 1..4 };
            for i in joints {
                let before = (i + spline.len() - 1) % spline.len();
                let (left, right) = (&spline[before], &spline[i]);
                assert_eq!(left.point(1.0), points[i]);
                assert_eq!(right.point(0.0), points[i]);
                let step = |j: usize| (points[(j + 1) % 5] - points[j]).length().sqrt();
                let jump = left.velocity(1.0) / step(before) - right.velocity(0.0) / step(i);
                assert!(jump.length() < 1e-12, "velocity {i}: {jump}");
                let jump = second(left, 1.0, &points, before) - second(right, 0.0, &points, i);
                assert!(jump.length() < 1e-11, "acceleration {i}: {jump}");
            }
        }
    }

    #[test]
    fn an_open_spline_ends_straight() {
        let spline = through(&uneven(), false);
        assert!(spline[0].acceleration(0.0).length() < 1e-12);
        assert!(spline[3].acceleration(1.0).length() < 1e-12);
    }

    #[test]
    fn two_points_give_a_line_and_too_few_nothing() {
        let line = through(&[DVec2::ZERO, DVec2::X * 3.0], false);
        assert!((line[0].0[1] - DVec2::X).length() < 1e-15);
        assert!(through(&[DVec2::ZERO], false).is_empty());
        assert!(through(&[DVec2::ZERO, DVec2::X], true).is_empty());
    }

    #[test]
    fn a_circle_is_met_with_order_four() {
        let error = |count: u32| {
            let at = |i: u32| turn(f64::from(i) / f64::from(count));
            let points: Vec<DVec2> = (0..count).map(at).collect();
            let spline = through(&points, true);
            spline.iter().map(|cubic| (cubic.point(0.5).length() - 1.0).abs()).fold(0.0, f64::max)
        };
        assert!(error(16) < 1e-4);
        assert!(error(16) / error(32) > 14.0);
    }
}
