//! Rotation-minimizing frames along a whole curve.
//!
//! The frames are found once, on nodes of their own. A frame between two nodes is carried from the node
//! before by one more double reflection. So a frame does not depend on the number of rows. Along a closed
//! curve the frame returns turned by some angle; this turn is removed evenly over the length.
//!
//! Nodes are so dense that the total error is about 1e-13 radians. With larger errors, finite differences of
//! the surface, which divide by their step, would show where nodes lie.

use super::Frame;
use crate::curve::cut::Side;
use crate::curve::vector::angle_between;
use crate::curve::{Curve3, Local3};
use std::f64::consts::{PI, TAU};

/// Steps from knot to knot before any is halved.
const STEPS: usize = 8;

/// Approximate largest number of nodes of one curve, which limits curves of very many segments or very sharp
/// bends.
const MOST_NODES: usize = 1 << 20;

/// Approximate largest number of steps before any is halved. A curve of more knots has short pieces, and the error of
/// a step decides alone.
const FEW_NODES: usize = 1 << 17;

/// A step that turns the tangent by more than this, in radians, is halved.
///
/// Below this turn the error of a step falls with the fifth power of its length, so the error can be
/// estimated.
const LARGEST_TURN: f64 = 0.1;

/// A step is halved until it and its two halves agree to this, in radians.
///
/// The two halves together are off by a fifteenth of the difference. This error is removed at the nodes and
/// remains between two nodes. With a smaller value, rounding would be mistaken for the error; with a larger
/// value, finite differences of the surface would show the nodes.
const AGREED: f64 = 1e-13;

/// Most halvings of one step. A sharper bend is in effect a corner.
const MOST_HALVINGS: u32 = 24;

/// An angle within this of half a turn backward, in radians, counts as half a turn forward.
const HALF_TURN: f64 = 1e-9;

/// Rotation-minimizing frames along a curve.
#[derive(Debug, Clone)]
pub struct Frames {
    /// Arc lengths of the nodes, rising, with the frames there. A joint has one node for each side.
    nodes: Vec<(f64, Frame)>,
    /// Extra turn that closes a closed curve, in radians per length; 0 for an open curve.
    spin: f64,
}

impl Frames {
    /// Finds the frames along `curve`, starting with the frame `first`.
    pub fn new(curve: &impl Curve3, first: Frame) -> Self {
        let nodes = nodes_of(curve, first);
        let spin = match nodes.last() {
            Some((length, last)) if curve.closed() => {
                // The last step returns exactly to the first point and tangent.
                -closing(first.angle_to(last.carried_to(&curve.at(0.0)).normal)) / length
            }
            _ => 0.0,
        };
        Self { nodes, spin }
    }

    /// Returns the turn of the frames beyond rotation-minimizing ones, in radians per length. With it a
    /// closed curve ends with the frame it starts with; 0 for an open curve.
    pub fn spin(&self) -> f64 {
        self.spin
    }

    /// Returns the frame at arc length `s`. `local` is the curve at `s`; `side` selects the node if `s` is a
    /// joint.
    pub fn at(&self, s: f64, local: &Local3, side: Side) -> Frame {
        let after = match side {
            Side::Before => self.nodes.partition_point(|node| node.0 < s),
            Side::After => self.nodes.partition_point(|node| node.0 <= s),
        };
        let (_, node) = &self.nodes[after.max(1) - 1];
        node.carried_to(local).turned(self.spin * s)
    }
}

/// Returns the angle by which a frame is turned when it returns to the start. Half a turn backward
/// becomes half a turn forward.
///
/// The sign of half a turn is ambiguous. The angle about the tangent is equal in both directions of
/// travel. So the surface is equal too if both directions choose one sign.
fn closing(angle: f64) -> f64 {
    if angle < HALF_TURN - PI { angle + TAU } else { angle }
}

/// Returns the nodes of a curve by arc length, each with its frame.
fn nodes_of(curve: &impl Curve3, first: Frame) -> Vec<(f64, Frame)> {
    let knots = curve.knots();
    let steps = (FEW_NODES / knots.len().max(1)).clamp(1, STEPS);
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

/// Adds the node at `s`, after at least one node between, and as many as the accuracy needs.
fn extend_to(
    curve: &impl Curve3,
    s: f64,
    local: &Local3,
    halvings: u32,
    nodes: &mut Vec<(f64, Frame)>,
) {
    let Some(&(from, last)) = nodes.last() else { return };
    let half = 0.5 * (from + s);
    let middle = curve.at(half);
    let turned = angle_between(last.tangent, local.tangent);
    let between = last.carried_to(&middle);
    let there = between.carried_to(local);
    // Points far from the origin are rounded, which tilts their chord by the rounding over its length.
    let tilt = f64::EPSILON * last.origin.length() / (local.position - last.origin).length();
    let agreed = AGREED + 4.0 * tilt.min(1.0) * turned;
    let apart = last.carried_to(local).angle_to(there.normal);
    if halvings > 0 && nodes.len() < MOST_NODES && (turned > LARGEST_TURN || apart.abs() > agreed) {
        extend_to(curve, half, &middle, halvings - 1, nodes);
        extend_to(curve, s, local, halvings - 1, nodes);
        return;
    }
    // Richardson extrapolation: the error falls with the fifth power of the step.
    nodes.push((half, between.turned(apart / 30.0)));
    nodes.push((s, there.turned(apart / 15.0)));
}

#[cfg(test)]
mod tests;
