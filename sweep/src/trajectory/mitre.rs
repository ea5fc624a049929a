//! Mitres: sections sheared into the planes that halve the corners of a trajectory.
//!
//! On a straight leg with the direction `T` a point `q` of the section lies at
//!
//! ```text
//!     S = P + q1 w1 + q2 w2 + (m.q) T,    m = -(n.w1, n.w2) / (n.T) at a corner with the normal n
//! ```
//!
//! of the halving plane. Between the ends of a leg `m` changes linearly; at an end that is no corner it is 0.
//! The frame after a corner is the frame before it, reflected in the plane, so both legs have the same
//! section there.

use crate::curve::cut::{Side, Stop};
use crate::frame::Frame;
use glam::{DVec2, DVec3};

/// The mitres of a trajectory, most often none.
#[derive(Debug, Clone, Default)]
pub struct Mitres {
    /// Corners, rising: fraction of the length, and arc length.
    corners: Vec<(f64, f64)>,
    /// The fractions of `corners` alone.
    breaks: Vec<f64>,
    legs: Vec<Leg>,
    length: f64,
}

/// A straight piece between two knots, with the shears at its ends.
#[derive(Debug, Clone, Copy)]
struct Leg {
    from: f64,
    to: f64,
    start: DVec2,
    end: DVec2,
}

impl Mitres {
    /// Finds the shear at the ends of each leg next to a corner.
    ///
    /// `corners` are rising arc lengths, with 0 for the start of a closed curve. `knots` are the arc lengths
    /// between straight pieces. `frame` returns the frame on a side of an arc length.
    pub fn new(corners: &[f64], knots: &[f64], frame: impl Fn(f64, Side) -> Frame) -> Self {
        let length = knots.last().copied().unwrap_or(0.0);
        let shears = |s: f64| {
            let end = if s == 0.0 { length } else { s };
            let (before, after) = (frame(end, Side::Before), frame(s, Side::After));
            let normal = (before.tangent + after.tangent).normalize_or_zero();
            [shear(&before, normal), shear(&after, normal)]
        };
        let is_corner =
            |s: f64| corners.contains(&s) || (s == length && corners.first() == Some(&0.0));
        let legs = knots
            .windows(2)
            .filter(|ends| is_corner(ends[0]) || is_corner(ends[1]))
            .map(|ends| {
                let (from, to) = (ends[0], ends[1]);
                let start = if is_corner(from) { shears(from)[1] } else { DVec2::ZERO };
                let last = if to == length && !corners.contains(&to) { 0.0 } else { to };
                let end = if is_corner(to) { shears(last)[0] } else { DVec2::ZERO };
                Leg { from, to, start, end }
            })
            .collect();
        let corners: Vec<_> = corners.iter().map(|&s| (s / length, s)).collect();
        let breaks = corners.iter().map(|corner| corner.0).collect();
        Self { corners, breaks, legs, length }
    }

    /// Returns the positions of the corners as fractions of the length, rising.
    pub fn breaks(&self) -> &[f64] {
        &self.breaks
    }

    /// Returns the exact arc length of a stop at a corner; the whole length for the side before the start.
    /// `None` for a stop at no corner.
    pub fn arc_length(&self, stop: Stop) -> Option<f64> {
        let found = self.breaks.binary_search_by(|corner| corner.total_cmp(&stop.at)).ok()?;
        let (_, s) = self.corners[found];
        Some(if s == 0.0 && stop.side == Side::Before { self.length } else { s })
    }

    /// Returns the shear at arc length `s`, and its derivative by arc length.
    pub fn at(&self, s: f64, side: Side) -> (DVec2, DVec2) {
        let after = match side {
            Side::Before => self.legs.partition_point(|leg| leg.from < s),
            Side::After => self.legs.partition_point(|leg| leg.from <= s),
        };
        let Some(leg) = after.checked_sub(1).map(|leg| self.legs[leg]).filter(|leg| s <= leg.to)
        else {
            return (DVec2::ZERO, DVec2::ZERO);
        };
        let part = (s - leg.from) / (leg.to - leg.from);
        // In this form both ends are met exactly.
        let shear = leg.start * (1.0 - part) + leg.end * part;
        (shear, (leg.end - leg.start) / (leg.to - leg.from))
    }
}

fn shear(frame: &Frame, normal: DVec3) -> DVec2 {
    -DVec2::new(frame.normal.dot(normal), frame.binormal.dot(normal)) / frame.tangent.dot(normal)
}
