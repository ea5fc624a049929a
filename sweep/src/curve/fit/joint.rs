//! Joints where two pieces meet: a point and the directions there.

use super::Run;
use crate::curve::vector::Vector;
use glam::DMat3;

/// With at most this many points to a side, noise cannot be judged.
const FEW: usize = 4;

/// Errors of at most this fraction of the tolerance do not matter.
const SMALL: f64 = 0.05;

/// An end of a piece.
#[derive(Debug, Clone, Copy)]
pub struct Joint<V> {
    /// Position of the joint.
    pub point: V,
    /// Unit direction in which the piece before arrives.
    pub before: V,
    /// Unit direction in which the piece after leaves; equal to `before` unless the joint is a corner.
    pub after: V,
}

impl<V: Vector> Run<'_, V> {
    /// Returns the joint at point `i`.
    pub(super) fn joint(&self, i: usize) -> Joint<V> {
        let [before, after] = self.around(i);
        let end = before == 0 || after == 0;
        if end || self.corners.contains(&i) {
            let point = self.point(i);
            let side = |steps: [usize; 2]| self.parabola(i, steps, true).1;
            let leaving = if after > 0 { side([0, after]) } else { side([before, 0]) };
            let reaching = if before > 0 { side([before, 0]) } else { leaving };
            return Joint { point, before: reaching, after: leaving };
        }
        let (point, direction) = self.parabola(i, [before, after], false);
        Joint { point, before: direction, after: direction }
    }

    /// Returns the number of points before and after point `i`, up to corners and ends. In a closed sequence
    /// each number is at most a third of all points.
    fn around(&self, i: usize) -> [usize; 2] {
        let count = self.points.len();
        let most = count / 3;
        let next = self.corners.partition_point(|&corner| corner <= i);
        let previous = self.corners.partition_point(|&corner| corner < i);
        if !self.closed {
            let before = previous.checked_sub(1).map_or(0, |at| self.corners[at]);
            let after = self.corners.get(next).copied().unwrap_or(count - 1);
            return [i - before, after - i];
        }
        match self.corners[..] {
            [] => [most.max(1); 2],
            [first, .., last] | [first @ last] => {
                let before = previous
                    .checked_sub(1)
                    .map_or_else(|| i + count - last, |at| i - self.corners[at]);
                let after = self.corners.get(next).map_or(first + count - i, |&corner| corner - i);
                [before.min(most.max(1)), after.min(most.max(1))]
            }
        }
    }

    /// Returns the point and the unit direction, at point `i`, of a parabola fitted to the points around it,
    /// at most `most` before and after.
    ///
    /// The reach of the parabola is doubled as long as the result is good; the last good parabola is taken. A
    /// good parabola is within half the tolerance of all its points, and its error is noise, not much larger
    /// than that of the narrower one. A much larger error would mean that the parabola misses the curve.
    fn parabola(&self, i: usize, most: [usize; 2], fixed: bool) -> (V, V) {
        let mut best: Option<(f64, V, V)> = None;
        let mut steps = 1;
        loop {
            // At an end the only side takes one point more, so that the parabola can bend.
            let reach = if most.contains(&0) { steps + 1 } else { steps };
            let [before, after] = most.map(|most| most.min(reach));
            let found = self.through(i, [before, after], fixed);
            match found {
                Some(next) if best.is_none_or(|last| self.is_good(steps, last.0, next.0)) => {
                    best = found;
                }
                _ => break,
            }
            if [before, after] == most {
                break;
            }
            steps *= 2;
        }
        best.map(|(_, point, direction)| (point, direction)).unwrap_or_else(|| {
            let count = self.points.len();
            let from = self.point(i + count - most[0].min(1));
            let to = self.point(i + most[1].min(1));
            let ahead = if to == from { self.point(i + 1) - self.point(i) } else { to - from };
            (self.point(i), ahead.unit().unwrap_or(ahead))
        })
    }

    /// Returns whether a parabola with error `next` is preferable to a narrower one with error `last`.
    fn is_good(&self, steps: usize, last: f64, next: f64) -> bool {
        let noise = steps <= FEW || next <= SMALL * self.tolerance || next <= 2.0 * last;
        next <= 0.5 * self.tolerance && noise
    }

    /// Fits a parabola over chord length to the points around point `i` by least squares. Returns the largest
    /// distance of a point from it, and its point and direction at point `i`. A `fixed` parabola passes
    /// through point `i`.
    fn through(&self, i: usize, [before, after]: [usize; 2], fixed: bool) -> Option<(f64, V, V)> {
        if before + after < 2 {
            return None;
        }
        let count = self.points.len();
        let origin = self.point(i);
        let offsets: Vec<V> =
            (0..=before + after).map(|k| self.point(i + count + k - before) - origin).collect();
        let mut lengths = vec![0.0];
        for ends in offsets.windows(2) {
            let length = lengths.last().copied().unwrap_or(0.0);
            lengths.push(length + (ends[0] - ends[1]).length());
        }
        let (middle, whole) = (lengths[before], lengths[before + after]);
        let positions: Vec<f64> = lengths.iter().map(|length| (length - middle) / whole).collect();
        let (mut sums, mut moments) = ([0.0; 5], [V::ZERO; 3]);
        for (s, offset) in positions.iter().zip(&offsets) {
            let mut power = 1.0;
            for (k, sum) in sums.iter_mut().enumerate() {
                if let Some(moment) = moments.get_mut(k) {
                    *moment = *moment + *offset * power;
                }
                *sum += power;
                power *= s;
            }
        }
        let [s0, s1, s2, s3, s4] = sums;
        let [m0, m1, m2] = moments;
        let [c0, c1, c2] = if fixed {
            let det = s2 * s4 - s3 * s3;
            [V::ZERO, (m1 * s4 - m2 * s3) / det, (m2 * s2 - m1 * s3) / det]
        } else {
            let inverse = DMat3::from_cols_array(&[s0, s1, s2, s1, s2, s3, s2, s3, s4]).inverse();
            [0, 1, 2].map(|k| {
                let row = inverse.row(k);
                m0 * row.x + m1 * row.y + m2 * row.z
            })
        };
        let direction = c1.unit()?;
        let error = positions
            .iter()
            .zip(&offsets)
            .map(|(&s, &offset)| (c0 + c1 * s + c2 * (s * s) - offset).length())
            .fold(0.0, f64::max);
        (error.is_finite() && c0.length().is_finite()).then_some((error, origin + c0, direction))
    }
}
