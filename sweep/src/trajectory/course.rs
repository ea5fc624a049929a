//! The curves that a trajectory or a guide can be.
//!
//! A new curve must provide:
//!
//! - its JSON: a variant of [`spec::Trajectory`](crate::spec::Trajectory), read in `read/trajectory.rs`, which
//!   checks its numbers against the limits;
//! - a variant of [`Course`] with an arm in each method of this file. The compiler names them, since no `match` here has
//!   a wildcard arm;
//! - as [`Curve3`]: its length, whether it is closed, the knots between which it is smooth, and at each arc length its
//!   position, unit tangent and curvature;
//! - its corners if it can have any, its own parameter, its detail in cells, and its frame if a closed form is known;
//! - its drawing for `--check`, in `check/drawing.rs`, if points of the file can coincide.
//!
//! A rotation is no curve: see [`Trajectory`](super::Trajectory).

use super::{Flat, Helix};
use crate::curve::{Curve3, Local3, Path, turn};
use crate::frame::Frame;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// Most knots of a helix. A helix with more than 65536 eighths of a turn has knots further apart than an
/// eighth of a turn.
const MOST_KNOTS: f64 = 65536.0;

/// A joint of a trajectory that turns by more than this, in degrees, is a corner.
pub const CORNER_DEG: f64 = 1.0;

/// A curve in space by arc length.
#[derive(Debug, Clone)]
pub enum Course {
    /// A straight line, from the origin of its frame.
    Line {
        /// The constant frame of the line, at its start.
        start: Frame,
        /// The end of the line.
        end: DVec3,
    },
    /// A circle about the line through the frame's origin, its centre, in the direction of the frame's `w2`.
    Circle {
        /// The frame at the centre. The circle starts at the side of `w1`, in the direction `T`.
        start: Frame,
        /// The radius, above 0.
        radius: f64,
        /// The fraction of a full turn, above 0; at 1 the circle is closed.
        fraction: f64,
    },
    /// A helix.
    Helix(Helix),
    /// Joined cubic segments.
    Path(Path<DVec3>),
    /// A plane curve with a height.
    Flat(Flat),
}

impl Course {
    /// Returns the arc lengths of the corners, which are mitred, rising; 0 for the start of a closed curve.
    #[must_use]
    pub fn corners(&self) -> Vec<f64> {
        match self {
            Self::Path(path) => path
                .joints()
                .filter(|joint| joint.angle.to_degrees() > CORNER_DEG)
                .map(|joint| joint.s)
                .collect(),
            Self::Line { .. } | Self::Circle { .. } | Self::Helix(_) | Self::Flat(_) => Vec::new(),
        }
    }

    /// Returns the curve's own parameter, from 0 to 1, at the fraction `v` of its length.
    pub(super) fn parameter(&self, v: f64) -> f64 {
        match self {
            Self::Path(path) if v >= 1.0 => path.parameter(path.end()),
            Self::Path(path) => path.parameter(path.locate(v * path.length())),
            Self::Line { .. } | Self::Circle { .. } | Self::Helix(_) | Self::Flat(_) => v,
        }
    }

    /// Returns the number of cells that resolves the curve: eight for each segment or quarter turn.
    pub(super) fn detail(&self) -> f64 {
        match self {
            Self::Line { .. } => 1.0,
            Self::Circle { fraction, .. } => 32.0 * fraction,
            Self::Helix(helix) => 32.0 * helix.turns.abs(),
            Self::Path(path) => 8.0 * path.cubics().count() as f64,
            Self::Flat(flat) => 8.0 * flat.knots().len() as f64,
        }
    }

    /// Returns the rotation-minimizing frame at `v`, a fraction of the length, and the curvature there on its
    /// `(w1, w2)`. `None` if the curve has no closed form for them.
    pub(super) fn own_frame(&self, v: f64) -> Option<(Frame, DVec2)> {
        match self {
            Self::Line { start, end } => {
                Some((Frame { origin: start.origin.lerp(*end, v), ..*start }, DVec2::ZERO))
            }
            Self::Circle { start, radius, fraction } => {
                let angle = turn(fraction * v);
                let normal = start.normal * angle.x + start.tangent * angle.y;
                let tangent = start.tangent * angle.x - start.normal * angle.y;
                let origin = start.origin + normal * *radius;
                let frame = Frame { origin, normal, tangent, ..*start };
                Some((frame, -DVec2::X / *radius))
            }
            Self::Helix(helix) => Some(helix.at(v)),
            Self::Path(_) | Self::Flat(_) => None,
        }
    }
}

impl Curve3 for Course {
    fn length(&self) -> f64 {
        match self {
            Self::Line { start, end } => (*end - start.origin).length(),
            Self::Circle { radius, fraction, .. } => TAU * fraction * radius,
            Self::Helix(helix) => helix.length(),
            Self::Path(path) => path.length(),
            Self::Flat(flat) => flat.length(),
        }
    }

    fn closed(&self) -> bool {
        match self {
            Self::Line { .. } | Self::Helix(_) => false,
            Self::Circle { fraction, .. } => *fraction == 1.0,
            Self::Path(path) => path.closed(),
            Self::Flat(flat) => flat.closed(),
        }
    }

    fn knots(&self) -> Vec<f64> {
        let pieces = match self {
            Self::Line { .. } => 1.0,
            Self::Circle { fraction, .. } => (8.0 * fraction).ceil(),
            Self::Helix(helix) => (8.0 * helix.turns.abs()).ceil().min(MOST_KNOTS),
            Self::Path(path) => return Curve3::knots(path),
            Self::Flat(flat) => return flat.knots(),
        };
        (0..=pieces as usize).map(|i| self.length() * (i as f64 / pieces)).collect()
    }

    fn at(&self, s: f64) -> Local3 {
        match self {
            Self::Line { start, end } => {
                let v = (s / self.length()).clamp(0.0, 1.0);
                Local3::straight(start.origin.lerp(*end, v), start.tangent)
            }
            Self::Circle { start, radius, fraction } => {
                let angle = turn(fraction * (s / self.length()).clamp(0.0, 1.0));
                let outward = start.normal * angle.x + start.tangent * angle.y;
                let tangent = start.tangent * angle.x - start.normal * angle.y;
                Local3 {
                    position: start.origin + outward * *radius,
                    tangent,
                    curvature: -outward / *radius,
                    third: -tangent / (radius * radius),
                }
            }
            Self::Helix(helix) => helix.local((s / self.length()).clamp(0.0, 1.0)),
            Self::Path(path) => path.at(s),
            Self::Flat(flat) => flat.at(s),
        }
    }

    fn before(&self, s: f64) -> Local3 {
        match self {
            Self::Path(path) => path.before(s),
            Self::Flat(flat) => flat.before(s),
            Self::Line { .. } | Self::Circle { .. } | Self::Helix(_) => self.at(s),
        }
    }
}
