//! Cubic segments joined end to end, with points located by arc length.

use super::arc_length::ArcLength;
use super::cubic::Cubic;
use super::vector::{Vector, angle_between, extent};
use super::{Curve3, Local3};
use glam::DVec3;

/// Segments smaller than this fraction of the curve are repeated points and are dropped.
///
/// Coordinates carry 16 digits, and a curve may lie at some distance from the origin. A segment smaller than
/// this has no reliable direction.
const COINCIDENT: f64 = 1e-12;

/// A curve of cubic segments, open or closed.
#[derive(Debug, Clone)]
pub struct Path<V> {
    segments: Vec<Segment<V>>,
    closed: bool,
    length: f64,
}

#[derive(Debug, Clone)]
struct Segment<V> {
    cubic: Cubic<V>,
    /// Index of the given segment that this segment is, or is a part of.
    source: usize,
    /// Length of the curve before this segment.
    start: f64,
    lengths: ArcLength<V>,
}

/// A point on a path: a segment and the parameter on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Position {
    segment: usize,
    t: f64,
}

/// A joint of a path, where one segment leads into the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// Arc length from the start of the path; 0 for the joint that closes it.
    pub s: f64,
    /// The end of the segment before.
    pub before: Position,
    /// The start of the segment after.
    pub after: Position,
    /// Angle by which the tangent turns here, in radians from 0 to pi.
    pub angle: f64,
    /// Indices of the given segments before and after; both are the same at a cusp inside one segment.
    pub sources: [usize; 2],
}

impl<V: Vector> Path<V> {
    /// Joins segments, each of which starts where the one before it ends.
    ///
    /// Segments whose points coincide are dropped, and segments are split at inner cusps. `None` if no length
    /// is left.
    pub fn new(given: &[Cubic<V>], closed: bool) -> Option<Self> {
        let size = extent(given.iter().flat_map(|cubic| cubic.0));
        let mut segments = Vec::with_capacity(given.len());
        let mut start = 0.0;
        for (source, whole) in given.iter().enumerate() {
            if whole.size() <= COINCIDENT * size {
                continue;
            }
            for cubic in whole.split_at_cusps() {
                let lengths = ArcLength::new(cubic);
                let length = lengths.total();
                segments.push(Segment { cubic, source, start, lengths });
                start += length;
            }
        }
        (start > 0.0 && start.is_finite()).then_some(Self { segments, closed, length: start })
    }

    /// Returns the length of the whole path.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Returns whether the path leads back to its start.
    pub fn closed(&self) -> bool {
        self.closed
    }

    /// Returns the segments of the path: without dropped ones, and with cusps split.
    pub fn cubics(&self) -> impl Iterator<Item = &Cubic<V>> {
        self.segments.iter().map(|segment| &segment.cubic)
    }

    /// Returns the start of the path.
    pub fn start(&self) -> Position {
        Position { segment: 0, t: 0.0 }
    }

    /// Returns the end of the path.
    pub fn end(&self) -> Position {
        Position { segment: self.segments.len() - 1, t: 1.0 }
    }

    /// Returns the position at arc length `s` from the start; `s` outside the path gives its ends.
    ///
    /// At a joint, returns the start of the segment after.
    pub fn locate(&self, s: f64) -> Position {
        let after = self.segments.partition_point(|segment| segment.start <= s);
        let index = after.max(1) - 1;
        let segment = &self.segments[index];
        Position { segment: index, t: segment.lengths.parameter_at(s - segment.start) }
    }

    /// Returns the position at arc length `s`, as [`Path::locate`] does, but at a joint the end of the segment
    /// before.
    pub fn locate_before(&self, s: f64) -> Position {
        let after = self.segments.partition_point(|segment| segment.start < s);
        let index = after.max(1) - 1;
        let segment = &self.segments[index];
        let last = self.segments.get(index + 1).is_some_and(|next| next.start <= s);
        let t = if last { 1.0 } else { segment.lengths.parameter_at(s - segment.start) };
        Position { segment: index, t }
    }

    /// Returns the segment that contains a position.
    pub fn cubic(&self, position: Position) -> &Cubic<V> {
        &self.segments[position.segment].cubic
    }

    /// Returns the cubics between two arc lengths.
    pub fn part(&self, from: f64, to: f64) -> Vec<Cubic<V>> {
        let (first, last) = (self.locate(from), self.locate_before(to));
        (first.segment..=last.segment)
            .map(|segment| {
                let start = if segment == first.segment { first.t } else { 0.0 };
                let end = if segment == last.segment { last.t } else { 1.0 };
                self.segments[segment].cubic.part(start, end)
            })
            .collect()
    }

    /// Returns the position at the parameter `t` of a segment.
    pub(crate) fn position(&self, segment: usize, t: f64) -> Position {
        Position { segment, t }
    }

    /// Returns the arc lengths between which the path is smooth, rising.
    pub(crate) fn knots(&self) -> Vec<f64> {
        self.starts().chain([self.length]).collect()
    }

    /// Returns the parameter of a position along the whole path, from 0 to 1. Every segment has an equal share.
    pub fn parameter(&self, position: Position) -> f64 {
        (position.segment as f64 + position.t) / self.segments.len() as f64
    }

    /// Returns the length of the path before a position.
    pub fn length_to(&self, position: Position) -> f64 {
        let segment = &self.segments[position.segment];
        segment.start + segment.lengths.length_to(position.t)
    }

    /// Returns the point at a position.
    pub fn point(&self, position: Position) -> V {
        self.segments[position.segment].cubic.point(position.t)
    }

    /// Returns the unit tangent at a position.
    pub fn tangent(&self, position: Position) -> V {
        self.segments[position.segment].cubic.tangent(position.t)
    }

    /// Returns the derivative of the tangent by arc length; zero where the speed is zero.
    pub fn curvature(&self, position: Position) -> V {
        self.segments[position.segment].cubic.curvature(position.t)
    }

    /// Returns the derivative of the curvature by arc length; zero where the speed is zero.
    pub fn third(&self, position: Position) -> V {
        self.segments[position.segment].cubic.third(position.t)
    }

    /// Returns all joints by rising `s`; in a closed path the first is the joint that closes it.
    pub fn joints(&self) -> impl Iterator<Item = Joint> {
        let first = usize::from(!self.closed);
        (first..self.segments.len()).map(|index| {
            let last = self.segments.len() - 1;
            let before = Position { segment: if index == 0 { last } else { index - 1 }, t: 1.0 };
            let after = Position { segment: index, t: 0.0 };
            Joint {
                s: self.segments[index].start,
                before,
                after,
                angle: angle_between(self.tangent(before), self.tangent(after)),
                sources: [before, after].map(|position| self.segments[position.segment].source),
            }
        })
    }

    /// Returns the arc length at which each segment starts.
    fn starts(&self) -> impl Iterator<Item = f64> {
        self.segments.iter().map(|segment| segment.start)
    }
}

impl Curve3 for Path<DVec3> {
    fn length(&self) -> f64 {
        self.length
    }

    fn closed(&self) -> bool {
        self.closed
    }

    fn knots(&self) -> Vec<f64> {
        self.knots()
    }

    fn at(&self, s: f64) -> Local3 {
        self.local(self.locate(s))
    }

    fn before(&self, s: f64) -> Local3 {
        self.local(self.locate_before(s))
    }
}

impl Path<DVec3> {
    /// Returns the point at a position, with its derivatives.
    pub fn local(&self, position: Position) -> Local3 {
        Local3 {
            position: self.point(position),
            tangent: self.tangent(position),
            curvature: self.curvature(position),
            third: self.third(position),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;
    use std::f64::consts::FRAC_PI_2;

    fn square() -> Vec<Cubic<DVec2>> {
        let corners = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y, DVec2::ZERO];
        corners.windows(2).map(|ends| Cubic::line(ends[0], ends[1])).collect()
    }

    #[test]
    fn a_square_is_located_by_length_and_has_four_corners() {
        let path = Path::new(&square(), true).unwrap();
        assert!((path.length() - 4.0).abs() < 1e-14);
        let point = path.point(path.locate(2.25));
        assert!((point - DVec2::new(0.75, 1.0)).length() < 1e-14);
        let joints: Vec<Joint> = path.joints().collect();
        assert_eq!(joints.len(), 4);
        assert_eq!(joints[0].s, 0.0);
        assert_eq!(joints[0].sources, [3, 0]);
        assert!(joints.iter().all(|joint| (joint.angle - FRAC_PI_2).abs() < 1e-14));
        assert_eq!(Path::new(&square(), false).unwrap().joints().count(), 3);
    }

    #[test]
    fn the_ends_are_met_exactly() {
        let path = Path::new(&square()[..3], false).unwrap();
        assert_eq!(path.point(path.start()), DVec2::ZERO);
        assert_eq!(path.point(path.end()), DVec2::Y);
        assert_eq!(path.point(path.locate(1e9)), DVec2::Y);
        assert_eq!(path.point(path.locate(-1.0)), DVec2::ZERO);
        let position = path.locate(1.7);
        assert!((path.length_to(position) - 1.7).abs() < 1e-15);
    }

    #[test]
    fn points_given_twice_are_passed_over() {
        let mut given = square();
        given.insert(1, Cubic([DVec2::X; 4]));
        let path = Path::new(&given, true).unwrap();
        assert_eq!(path.joints().count(), 4);
        assert_eq!(path.joints().nth(1).unwrap().sources, [0, 2]);
        assert!(Path::new(&[Cubic([DVec2::X; 4])], true).is_none());
        assert!(Path::<DVec2>::new(&[], true).is_none());
    }

    #[test]
    fn a_cusp_inside_a_segment_is_a_joint_of_half_a_turn() {
        let p = DVec2::new;
        let cusp = Cubic([p(0.0, 0.0), p(1.0, 1.0), p(0.0, 1.0), p(1.0, 0.0)]);
        let path = Path::new(&[cusp], false).unwrap();
        let joint = path.joints().next().unwrap();
        assert!((joint.angle - 2.0 * FRAC_PI_2).abs() < 1e-9);
        assert_eq!(joint.sources, [0, 0]);
    }
}
