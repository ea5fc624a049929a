//! The closing of a surface whose columns do not meet themselves.
//!
//! Where a trajectory ends at its start, a motion of their common plane takes the last section onto
//! the first. A contour with a symmetry may then close with its columns *shifted*: `u` of the end
//! continues at `u + u0` of the start. Or it closes with its columns *mirrored*, at `u0 - u`. A
//! mirrored surface has one side: it is a Moebius band if the contour is open, or a Klein bottle. A
//! surface closes mirrored in two cases. Either the contour returns turned onto its own reverse (a
//! segment after half a turn). Or the trajectory returns against its own direction, as that of
//! Klein's bottle does.
//!
//! The turn that the contour still needs to fit is added evenly along the whole length. Among all fits, the
//! one is taken that turns the contour least against a rotation-minimizing frame.

use crate::curve::cut::{SAME_POSITION, Side, Stop};
use crate::grid::Seam;
use glam::DVec2;

/// Samples around a contour; the denominators in `PARTS` divide this number.
pub(crate) const SAMPLES: usize = 840;

/// Denominators of the offsets that are tried, as fractions of the contour. They cover its symmetries and
/// possible starts on an axis of symmetry.
const PARTS: [usize; 10] = [1, 2, 3, 4, 5, 6, 7, 8, 10, 12];

/// Sections whose points differ by at most this fraction of their size coincide.
const SAME: f64 = 1e-6;

/// Turns that differ by less than this fraction of a full turn are equal. The turns come from sums over [`SAMPLES`]
/// points, so rounding must choose neither among closings nor the sign of half a turn.
const SAME_TURN: f64 = 1e-9;

/// How the columns at the end continue as columns at the start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closing {
    /// True if the columns continue in reverse order.
    pub(crate) mirrored: bool,
    /// The `u` of the start at which `u = 0` of the end continues, as a fraction `(p, q)`.
    pub(crate) offset: (usize, usize),
    /// Total turn that makes the contour fit, as a fraction of a full turn.
    pub(crate) turn: f64,
    /// True if the surface has an edge where it closes.
    pub(crate) edge: bool,
}

/// Two sections on the frame axes of the start, sampled at `u = i / SAMPLES`; open ones also at 1.
pub(crate) struct Ends<'a> {
    pub start: &'a [DVec2],
    pub end: &'a [DVec2],
    /// True if the contour is closed.
    pub closed: bool,
    /// True if the trajectory ends against the direction of its start. A turn to the left at the
    /// end is then a turn to the right at the start.
    pub against: bool,
    /// Turn that already brought the frame back at the end, as a fraction of a full turn.
    pub turned: f64,
}

impl Ends<'_> {
    /// Returns the closing with the smallest total turn. If `turn_free` is false, the end may not be turned.
    ///
    /// The error is the smallest distance by which any offset misses, as a fraction of the contour's size.
    pub fn close(&self, mirrored: bool, turn_free: bool) -> Result<Closing, f64> {
        let mut best: Option<Closing> = None;
        let mut missed = f64::INFINITY;
        let total = |closing: &Closing| (self.turned + closing.turn).abs();
        for offset in self.offsets(mirrored) {
            let (turn, miss) = self.fit(mirrored, offset, turn_free);
            missed = missed.min(miss);
            let found = Closing { mirrored, offset, turn, edge: false };
            // Among closings that differ by rounding, the first is taken.
            if miss <= SAME && best.is_none_or(|best| total(&found) < total(&best) - SAME_TURN) {
                best = Some(found);
            }
        }
        best.ok_or(missed)
    }

    fn offsets(&self, mirrored: bool) -> Vec<(usize, usize)> {
        if !self.closed {
            // A closed seam joins an open contour to itself; a mirrored one joins it end to end.
            return vec![(usize::from(mirrored), 1)];
        }
        let of = |&q: &usize| (0..q).filter(move |&p| (p == 0) == (q == 1)).map(move |p| (p, q));
        PARTS.iter().flat_map(of).filter(|&(p, q)| p == 0 || gcd(p, q) == 1).collect()
    }

    /// Returns the turn of the end that fits best, as a fraction of a full turn about the end's direction,
    /// and the distance by which it misses.
    fn fit(&self, mirrored: bool, (p, q): (usize, usize), turn_free: bool) -> (f64, f64) {
        let shift = SAMPLES * p / q;
        let led = |i: usize| match (self.closed, mirrored) {
            (true, false) => (i + shift) % SAMPLES,
            (true, true) => (shift + SAMPLES - i) % SAMPLES,
            (false, false) => i,
            (false, true) => SAMPLES - i,
        };
        let pairs = || self.end.iter().enumerate().map(|(i, &e)| (e, self.start[led(i)]));
        let sum: DVec2 = pairs().map(|(e, s)| DVec2::new(e.dot(s), e.perp_dot(s))).sum();
        let turn = sum.try_normalize().filter(|_| turn_free).unwrap_or(DVec2::X);
        let size = self.start.iter().map(|s| s.length()).fold(0.0, f64::max);
        let miss = pairs().map(|(e, s)| (turn.rotate(e) - s).length()).fold(0.0, f64::max);
        let angle = turn.to_angle() / std::f64::consts::TAU;
        // Half a turn left and half a turn right are equal; rounding must not decide between them.
        let angle = if angle < -0.5 + SAME_TURN { 0.5 } else { angle };
        (if self.against { -angle } else { angle }, miss / size)
    }
}

impl Closing {
    /// Returns the stop of the start at which a stop of the end continues.
    pub(crate) fn leads_to(&self, closed: bool, stop: Stop) -> Stop {
        let offset = self.offset.0 as f64 / self.offset.1 as f64;
        let at = if self.mirrored { offset - stop.at } else { offset + stop.at };
        let side = match (self.mirrored, stop.side) {
            (false, side) => side,
            (true, Side::Before) => Side::After,
            (true, Side::After) => Side::Before,
        };
        Stop { at: if closed { at.rem_euclid(1.0) } else { at }, side }
    }

    /// Returns the positions, besides breaks, where a contour must be cut so that cuts continue as cuts.
    pub(crate) fn anchors(&self, breaks: &[f64], closed: bool) -> Vec<f64> {
        let mut anchors: Vec<f64> = Vec::new();
        for at in breaks.iter().copied().chain([0.0]) {
            let mut stop = Stop::after(at);
            // A mirror image of a mirror image is the first one.
            let steps = if self.mirrored { 2 } else { self.offset.1.max(2) };
            for _ in 0..steps {
                if !anchors.iter().any(|&other| same_position(other, stop.at, closed)) {
                    anchors.push(stop.at);
                }
                stop = self.leads_to(closed, stop);
            }
        }
        anchors.sort_by(f64::total_cmp);
        anchors
    }

    /// Returns the seam and its shift in columns, for columns at these stops. `None` if the columns do not
    /// continue as columns.
    pub(crate) fn seam(
        &self,
        stops: &[Stop],
        breaks: &[f64],
        closed: bool,
    ) -> Option<(Seam, usize)> {
        let seam = if self.mirrored { Seam::Mirror } else { Seam::Closed };
        let first = self.leads_to(closed, stops[0]);
        let is_break = |at: f64| breaks.iter().any(|&other| same_position(other, at, closed));
        let meet = |a: &Stop, b: Stop| {
            same_position(a.at, b.at, closed) && (a.side == b.side || !is_break(a.at))
        };
        let shift = stops.iter().position(|stop| meet(stop, first))?;
        let all = stops.iter().enumerate().all(|(col, &stop)| {
            let led = seam.leads_to(col, shift, stops.len());
            meet(&stops[led], self.leads_to(closed, stop))
        });
        all.then_some((seam, shift))
    }
}

/// Returns whether two positions on a contour coincide up to rounding.
fn same_position(a: f64, b: f64, closed: bool) -> bool {
    let apart = (a - b).abs();
    apart < SAME_POSITION || (closed && apart > 1.0 - SAME_POSITION)
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::cut;
    use crate::curve::turn;

    fn sampled(closed: bool, curve: impl Fn(f64) -> DVec2) -> Vec<DVec2> {
        let count = SAMPLES + usize::from(!closed);
        (0..count).map(|i| curve(i as f64 / SAMPLES as f64)).collect()
    }

    fn close(
        curve: impl Fn(f64) -> DVec2,
        end: impl Fn(DVec2) -> DVec2,
        (closed, mirrored): (bool, bool),
    ) -> Result<Closing, f64> {
        let start = sampled(closed, &curve);
        let end: Vec<DVec2> = start.iter().map(|&p| end(p)).collect();
        let ends = Ends { start: &start, end: &end, closed, against: false, turned: 0.0 };
        ends.close(mirrored, true)
    }

    #[test]
    fn a_segment_closes_mirrored_after_half_a_turn() {
        let found = close(|u| DVec2::X * (u - 0.5), |p| p, (false, true)).unwrap();
        assert_eq!((found.offset, found.turn), ((1, 1), 0.5));
        let found = close(|u| DVec2::X * (u - 0.5), |p| -p, (false, true)).unwrap();
        assert_eq!(found.turn, 0.0);
        assert!(close(|u| DVec2::X * (u - 0.4), |p| p, (false, true)).is_err());
    }

    #[test]
    fn a_figure_of_eight_closes_mirrored_after_half_a_turn() {
        let eight = |u: f64| DVec2::new(turn(u).x, turn(2.0 * u).y);
        let found = close(eight, |p| -p, (true, true)).unwrap();
        assert_eq!((found.offset, found.turn), ((1, 2), 0.0));
    }

    #[test]
    fn a_clover_closes_with_the_nearest_of_its_leaves() {
        let clover = |u: f64| turn(u) * (1.0 + 0.2 * turn(3.0 * u).x);
        let by = |degrees: f64| {
            close(clover, |p| turn(degrees / 360.0).rotate(p), (true, false)).unwrap()
        };
        let found = by(100.0);
        assert_eq!(found.offset, (1, 3));
        assert!((found.turn * 360.0 - 20.0).abs() < 1e-9);
        let found = by(-100.0);
        assert_eq!(found.offset, (2, 3));
        assert!((found.turn * 360.0 + 20.0).abs() < 1e-9);
    }

    #[test]
    fn columns_lead_to_columns() {
        let mirror = Closing { mirrored: true, offset: (1, 2), turn: 0.0, edge: false };
        let anchors = mirror.anchors(&[], true);
        assert_eq!(anchors, [0.0, 0.5]);
        let stops = cut::between(&[], true, 7, &anchors);
        assert_eq!(stops.len(), 8, "an odd number is made even");
        assert_eq!(mirror.seam(&stops, &[], true), Some((Seam::Mirror, 4)));
        let thirds = Closing { mirrored: false, offset: (1, 3), turn: 0.0, edge: false };
        let stops = cut::between(&[0.1], true, 30, &thirds.anchors(&[0.1], true));
        assert_eq!(thirds.seam(&stops, &[0.1], true), None, "a crease without its like");
        let breaks = [0.0, 1.0 / 3.0, 2.0 / 3.0];
        let stops = cut::between(&breaks, true, 30, &thirds.anchors(&breaks, true));
        assert_eq!(stops.len(), 33);
        assert_eq!(thirds.seam(&stops, &breaks, true), Some((Seam::Closed, 11)));
        let ends = Closing { mirrored: true, offset: (1, 1), turn: 0.5, edge: false };
        let stops = cut::between(&[0.3, 0.7], false, 10, &ends.anchors(&[0.3, 0.7], false));
        assert_eq!(ends.seam(&stops, &[0.3, 0.7], false), Some((Seam::Mirror, 12)));
    }
}
