//! Rotation-minimizing frames along a whole curve.
//!
//! The frames are found once, on nodes of their own; a frame between two nodes is one more double
//! reflection from the one before. So a frame does not depend on how many rows are asked for. Along
//! a closed curve the frame comes back turned by some angle; the turn is undone evenly in length.
//!
//! Nodes are as dense as the error asks, some 1e-13 radians over all: differences of the surface, which
//! divide by their step, are not to see where nodes lie.

use super::Frame;
use crate::curve::vector::angle_between;
use crate::curve::{Curve3, Local3};
use crate::cut::Side;
use std::f64::consts::{PI, TAU};

/// Steps from knot to knot, before any is halved.
const STEPS: usize = 8;

/// Nodes of one curve, more or less, for curves of very many segments or very sharp bends.
const MOST_NODES: usize = 1 << 20;

/// A step that turns the tangent further than this, in radians, is halved.
///
/// Below it the error of a step falls with the fifth power of its length, and can be judged.
const LARGEST_TURN: f64 = 0.1;

/// A step is halved until it and its halves agree to this, in radians.
///
/// The halves are off by a fifteenth of that together, which is taken out at the nodes; between two
/// nodes it stays. Smaller, and rounding would be taken for the error; larger, and differences of the
/// surface would see the nodes.
const AGREED: f64 = 1e-13;

/// Halvings of one step at most; a bend sharper than that is a corner to all purposes.
const MOST_HALVINGS: u32 = 24;

/// An angle this near to half a turn backward, in radians, is half a turn forward.
const HALF_TURN: f64 = 1e-9;

/// Rotation-minimizing frames along a curve.
#[derive(Debug, Clone)]
pub struct Frames {
    /// Arc lengths of the nodes and the frames there; a joint has one for each side.
    nodes: Vec<(f64, Frame)>,
    /// Turn by length that closes a closed curve, in radians; 0 for an open one.
    spin: f64,
}

impl Frames {
    /// Finds the frames, from the frame at the start of the curve onward.
    pub fn new(curve: &impl Curve3, first: Frame) -> Self {
        let nodes = nodes_of(curve, first);
        let spin = match nodes.last() {
            Some((length, last)) if curve.closed() => {
                // The last step leads back onto the very first point and tangent.
                -closing(first.angle_to(last.carried_to(&curve.at(0.0)).normal)) / length
            }
            _ => 0.0,
        };
        Self { nodes, spin }
    }

    /// By how much the frames turn more than they must, in radians by length, so that a closed
    /// curve ends with the frame it began with.
    pub fn spin(&self) -> f64 {
        self.spin
    }

    /// The frame at a place of the curve, that of arc length `s` and of a side if it is a joint.
    pub fn at(&self, s: f64, place: &Local3, side: Side) -> Frame {
        let after = match side {
            Side::Before => self.nodes.partition_point(|node| node.0 < s),
            Side::After => self.nodes.partition_point(|node| node.0 <= s),
        };
        let (_, node) = &self.nodes[after.max(1) - 1];
        node.carried_to(place).turned(self.spin * s)
    }
}

/// The angle by which a frame has come back turned, from which half a turn backward is taken out.
///
/// Half a turn has no sign of its own. About the tangent the angle is the same whichever way the curve
/// is run through, and so is the surface, if the choice is.
fn closing(angle: f64) -> f64 {
    if angle < HALF_TURN - PI { angle + TAU } else { angle }
}

/// The nodes of a curve by arc length, each with its frame.
fn nodes_of(curve: &impl Curve3, first: Frame) -> Vec<(f64, Frame)> {
    let knots = curve.knots();
    let steps = (MOST_NODES / knots.len().max(1)).clamp(4, STEPS);
    let mut nodes = vec![(0.0, first)];
    for ends in knots.windows(2) {
        if let Some(&(s, last)) = nodes.last()
            && s > 0.0
        {
            nodes.push((s, last.carried_to(&curve.at(s))));
        }
        for step in 1..=steps {
            let s = ends[0] + (ends[1] - ends[0]) * (step as f64 / steps as f64);
            if step == steps {
                extend_to(curve, ends[1], &curve.before(ends[1]), MOST_HALVINGS, &mut nodes);
            } else {
                extend_to(curve, s, &curve.at(s), MOST_HALVINGS, &mut nodes);
            }
        }
    }
    nodes
}

/// Adds the node at `s`, and before it those that its accuracy needs; at least one.
fn extend_to(
    curve: &impl Curve3,
    s: f64,
    place: &Local3,
    halvings: u32,
    nodes: &mut Vec<(f64, Frame)>,
) {
    let Some(&(from, last)) = nodes.last() else { return };
    let half = 0.5 * (from + s);
    let middle = curve.at(half);
    let turned = angle_between(last.tangent, place.tangent);
    let between = last.carried_to(&middle);
    let there = between.carried_to(place);
    // Points far from the origin are rounded, and their chord is tilted by as much of its length.
    let tilt = f64::EPSILON * last.origin.length() / (place.position - last.origin).length();
    let agreed = AGREED + 4.0 * tilt.min(1.0) * turned;
    let apart = last.carried_to(place).angle_to(there.normal);
    if halvings > 0 && nodes.len() < MOST_NODES && (turned > LARGEST_TURN || apart.abs() > agreed) {
        extend_to(curve, half, &middle, halvings - 1, nodes);
        extend_to(curve, s, place, halvings - 1, nodes);
        return;
    }
    // The error falls with the fifth power of the step (Richardson).
    nodes.push((half, between.turned(apart / 30.0)));
    nodes.push((s, there.turned(apart / 15.0)));
}

#[cfg(test)]
mod tests;
