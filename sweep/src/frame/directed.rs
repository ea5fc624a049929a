//! Frames fixed by a direction: an upright direction, the centre of curvature or a guide curve.
//!
//! Let `D(s)` be the direction and `d = D - (D.T) T` its part across the trajectory. Then
//!
//! ```text
//!     n = d / |d|,   b = T x n,   spin = n'.b = (D'.b - (D.T)(K.b)) / |d|
//! ```
//!
//! with the curvature vector `K = T'`. An upright direction is constant. The direction of Frenet's frame is
//! `K` itself, and its spin is the torsion. The direction of a guide leads from the trajectory to the guide's
//! point at the same fraction of its length. The direction away from an axis is the part of `P - O` across that axis, and
//! changes by the part of `T` across it. `w1 = n`, except for an upright frame, where `w2 = n`; both have
//! the same spin.
//!
//! Where `d` is 0 there is no frame. [`Directed::lack`] searches for such points. It samples the curve
//! between its knots and halves steps until `n` turns by less than half a radian in each. Where `n` reverses,
//! no halving achieves this. The search then finds the minimum in every valley of `|d|`.

use super::Frame;
use crate::curve::cut::Side;
use crate::curve::vector::angle_between;
use crate::curve::{Curve3, Local3};
use glam::DVec3;

/// A direction whose part across the trajectory is at most this counts as parallel to it. The number is a
/// sine for an upright direction, the curvature times the trajectory's length for Frenet's frame, and a
/// distance over that length for a guide.
const NONE: f64 = 1e-9;

/// Samples from knot to knot; fewer if there are very many knots.
const SAMPLES: usize = 64;

/// Approximate largest number of samples of one curve, which limits curves of very many knots.
const MOST_SAMPLES: usize = 1 << 20;

/// Largest turn of `n` from sample to sample, in radians; a step with a larger turn is halved.
const LARGEST_TURN: f64 = 0.5;

/// Most halvings of a step. If `n` still turns too far, it reverses within a trillionth of the step.
const MOST_HALVINGS: u32 = 40;

/// Golden-section steps toward the minimum of a valley; each leaves 0.62 of the interval.
const GOLDEN_STEPS: usize = 90;

/// Largest turn of a frame at a joint, in radians: one degree, as for the tangent.
const SMOOTH: f64 = std::f64::consts::PI / 180.0;

/// The direction that fixes the frames along a trajectory.
#[derive(Debug, Clone)]
pub enum Directed<C> {
    /// `w2` is as near to this unit vector as the trajectory allows.
    Up(DVec3),
    /// `w1` points to the centre of curvature.
    Frenet,
    /// `w1` points to the guide's point at the same fraction of the length.
    Guide(Box<C>),
    /// `w1` points away from the line through `origin` along the unit vector `axis`.
    Away {
        /// A point of the line.
        origin: DVec3,
        /// Direction of the line, a unit vector.
        axis: DVec3,
    },
}

/// A reason why a curve has no frame at some point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Lack {
    /// The direction is parallel to the trajectory, at this fraction of the length.
    Along(f64),
    /// The direction jumps at a joint: the fraction of the length and the angle in radians.
    Jump(f64, f64),
}

impl<C: Curve3> Directed<C> {
    /// Returns the frame at arc length `s` of a curve of this `length`, and its spin in radians per length.
    ///
    /// `local` is the curve at `s`, on the given side. `None` where the direction is parallel to the tangent.
    pub fn at(&self, s: f64, length: f64, local: &Local3, side: Side) -> Option<(Frame, f64)> {
        let (wanted, change) = self.direction(s, length, local, side);
        let along = wanted.dot(local.tangent);
        let across = wanted - local.tangent * along;
        let normal = across.try_normalize()?;
        let frame = Frame::new(local, normal);
        let (b, size) = (frame.binormal, across.length());
        let spin = (change.dot(b) - along * local.curvature.dot(b)) / size;
        Some(match self {
            Self::Up(_) => (Frame { normal: -b, binormal: normal, ..frame }, spin),
            Self::Guide(_) | Self::Frenet | Self::Away { .. } => (frame, spin),
        })
    }

    /// Searches for a point without a frame and returns the first one found.
    pub fn lack(&self, curve: &impl Curve3) -> Option<Lack> {
        let (length, knots) = (curve.length(), curve.knots());
        let mut search = Search { directed: self, curve, length, samples: Vec::new() };
        let steps = (MOST_SAMPLES / knots.len().max(1)).clamp(8, SAMPLES);
        for ends in knots.windows(2) {
            search.samples.clear();
            let first = search.look(ends[0], Side::After);
            search.samples.push(first);
            for step in 1..=steps {
                let last = step == steps;
                let part = ends[0] + (ends[1] - ends[0]) * (step as f64 / steps as f64);
                let (s, side) = if last { (ends[1], Side::Before) } else { (part, Side::After) };
                let next = search.look(s, side);
                if let Err(s) = search.extend_to(next, MOST_HALVINGS) {
                    return Some(Lack::Along(s / length));
                }
            }
            if let Some(s) = search.bottom() {
                return Some(Lack::Along(s / length));
            }
        }
        let inner = if curve.closed() { 0..knots.len() - 1 } else { 1..knots.len() - 1 };
        inner
            .map(|knot| (knots[knot], self.jump(curve, knots[knot])))
            .find(|&(_, jump)| jump > SMOOTH)
            .map(|(s, jump)| Lack::Jump(s / length, jump))
    }

    /// Returns the angle in radians by which the frame jumps at the joint at `s`, beyond the turn
    /// of the tangent there. The angle is pi if a side has no frame.
    pub fn jump(&self, curve: &impl Curve3, s: f64) -> f64 {
        let length = curve.length();
        let end = if s == 0.0 { length } else { s };
        let (last, next) = (curve.before(end), curve.at(s));
        let before = self.at(end, length, &last, Side::Before);
        let after = self.at(s, length, &next, Side::After);
        match (before, after) {
            (Some((before, _)), Some((after, _))) => {
                before.carried_to(&next).angle_to(after.normal).abs()
            }
            _ => std::f64::consts::PI,
        }
    }

    /// Returns the direction and its derivative by arc length.
    fn direction(&self, s: f64, length: f64, local: &Local3, side: Side) -> (DVec3, DVec3) {
        match self {
            Self::Up(up) => (*up, DVec3::ZERO),
            Self::Away { origin, axis } => {
                let across = |v: DVec3| v - *axis * v.dot(*axis);
                (across(local.position - *origin), across(local.tangent))
            }
            Self::Frenet => {
                // A curve that ends straight, as a natural spline does, has a limit of the direction. A cubic
                // that is straight at one point lies in a plane, and there the limit is the third derivative.
                let straight = local.curvature.length() * length <= NONE;
                if straight && s <= 0.0 {
                    (local.third, DVec3::ZERO)
                } else if straight && s >= length {
                    (-local.third, DVec3::ZERO)
                } else {
                    (local.curvature, local.third)
                }
            }
            Self::Guide(guide) => {
                let whole = guide.length();
                let at = whole * (s / length);
                let there = match side {
                    Side::Before => guide.before(at),
                    Side::After => guide.at(at),
                };
                let pace = whole / length;
                (there.position - local.position, there.tangent * pace - local.tangent)
            }
        }
    }

    /// Returns the part of the direction across the trajectory, scaled so that [`NONE`] applies to its
    /// length.
    fn across(&self, s: f64, length: f64, local: &Local3, side: Side) -> DVec3 {
        let (wanted, _) = self.direction(s, length, local, side);
        let across = wanted - local.tangent * wanted.dot(local.tangent);
        match self {
            Self::Up(_) => across,
            Self::Frenet
                if local.curvature.length() * length <= NONE && wanted != local.curvature =>
            {
                // At a straight end only the direction of this vector matters.
                across.normalize_or_zero() * (2.0 * NONE)
            }
            Self::Frenet => across * length,
            Self::Guide(_) | Self::Away { .. } => across / length,
        }
    }
}

/// A search for points without a frame along one curve.
struct Search<'a, C, D> {
    directed: &'a Directed<C>,
    curve: &'a D,
    length: f64,
    /// Samples of one smooth piece, by rising `s`.
    samples: Vec<Sample>,
}

#[derive(Clone, Copy)]
struct Sample {
    s: f64,
    across: DVec3,
}

impl<C: Curve3, D: Curve3> Search<'_, C, D> {
    fn look(&self, s: f64, side: Side) -> Sample {
        let local = match side {
            Side::Before => self.curve.before(s),
            Side::After => self.curve.at(s),
        };
        Sample { s, across: self.directed.across(s, self.length, &local, side) }
    }

    /// Adds a sample, after as many samples in between as its turn needs. The error is the arc length of a
    /// point without a direction.
    fn extend_to(&mut self, next: Sample, halvings: u32) -> Result<(), f64> {
        let Some(&last) = self.samples.last() else {
            self.samples.push(next);
            return Ok(());
        };
        let (Some(from), Some(to)) = (last.direction(), next.direction()) else {
            return Err(if last.direction().is_none() { last.s } else { next.s });
        };
        if angle_between(from, to) > LARGEST_TURN {
            if halvings == 0 {
                return Err(next.s);
            }
            let middle = self.look(0.5 * (last.s + next.s), Side::After);
            self.extend_to(middle, halvings - 1)?;
            return self.extend_to(next, halvings - 1);
        }
        self.samples.push(next);
        Ok(())
    }

    /// Returns the arc length of the first minimum of `|d|` at which there is no direction.
    fn bottom(&self) -> Option<f64> {
        self.samples.windows(3).find_map(|three| {
            let [a, b, c] = [three[0], three[1], three[2]].map(|sample| sample.across.length());
            if b > a || b > c {
                return None;
            }
            let golden = 0.5 * (5_f64.sqrt() - 1.0);
            let size = |s: f64| self.look(s, Side::After).across.length();
            let (mut low, mut high) = (three[0].s, three[2].s);
            for _ in 0..GOLDEN_STEPS {
                let step = golden * (high - low);
                let (left, right) = (high - step, low + step);
                if size(left) < size(right) {
                    high = right;
                } else {
                    low = left;
                }
            }
            let s = 0.5 * (low + high);
            (size(s) <= NONE).then_some(s)
        })
    }
}

impl Sample {
    fn direction(&self) -> Option<DVec3> {
        (self.across.length() > NONE).then(|| self.across.normalize())
    }
}
