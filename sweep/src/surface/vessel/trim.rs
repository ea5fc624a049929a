//! Loops of a chain of cubics, cut off.
//!
//! Walking from the start, the first crossing of the chain with a later part of itself starts a loop, which is left out
//! up to the last passage through that point. The remaining chain does not cross itself.

use super::Fault;
use crate::curve::Cubic;
use glam::{DMat2, DVec2};

/// Straight pieces of a cubic that are tested for crossings.
const PIECES: usize = 8;

/// Largest number of cubics whose crossings are searched. All pairs of their boxes are compared.
const MOST: usize = 6000;

/// Newton steps from the crossing of two chords to that of their cubics.
const STEPS: usize = 12;

/// A passage of a chain through a crossing: the index of a cubic and the parameter on it.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
struct Place {
    cubic: usize,
    t: f64,
}

/// Returns a chain without its loops.
///
/// # Errors
/// [`Fault::Long`] if the chain has too many pieces.
pub(super) fn without_loops(chain: Vec<Cubic<DVec2>>) -> Result<Vec<Cubic<DVec2>>, Fault> {
    if chain.len() > MOST {
        return Err(Fault::Long(chain.len()));
    }
    let mut crossings = crossings(&chain);
    crossings.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
    let mut kept: Vec<Cubic<DVec2>> = Vec::with_capacity(chain.len());
    let mut from = Place { cubic: 0, t: 0.0 };
    let mut joint: Option<DVec2> = None;
    for [enters, leaves] in crossings {
        if enters < from {
            continue;
        }
        push(&chain, from, enters, &mut joint, &mut kept);
        let point = chain[enters.cubic].point(enters.t);
        if let Some(last) = kept.last_mut() {
            last.0[3] = point;
        }
        joint = Some(point);
        from = leaves;
    }
    let end = Place { cubic: chain.len() - 1, t: 1.0 };
    push(&chain, from, end, &mut joint, &mut kept);
    Ok(kept)
}

/// Appends the part of a chain between two places. `joint` is the point at which the part starts, if it is known.
fn push(
    chain: &[Cubic<DVec2>],
    from: Place,
    to: Place,
    joint: &mut Option<DVec2>,
    kept: &mut Vec<Cubic<DVec2>>,
) {
    for (i, cubic) in chain.iter().enumerate().take(to.cubic + 1).skip(from.cubic) {
        let start = if i == from.cubic { from.t } else { 0.0 };
        let end = if i == to.cubic { to.t } else { 1.0 };
        if end <= start {
            continue;
        }
        let mut part = if (start, end) == (0.0, 1.0) { *cubic } else { cubic.part(start, end) };
        if let Some(joint) = joint.take() {
            part.0[0] = joint;
        }
        kept.push(part);
    }
}

/// Returns the crossings of a chain, each with its earlier and its later place.
fn crossings(chain: &[Cubic<DVec2>]) -> Vec<[Place; 2]> {
    let bounds = |points: &[DVec2]| {
        points.iter().fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], &p| {
            [low.min(p), high.max(p)]
        })
    };
    let boxes: Vec<[DVec2; 2]> = chain.iter().map(|cubic| bounds(&cubic.0)).collect();
    let chords: Vec<Vec<DVec2>> = chain
        .iter()
        .map(|cubic| (0..=PIECES).map(|i| cubic.point(i as f64 / PIECES as f64)).collect())
        .collect();
    let mut found: Vec<[Place; 2]> = Vec::new();
    for i in 0..chain.len() {
        for j in i..chain.len() {
            let apart =
                boxes[i][0].cmpgt(boxes[j][1]).any() || boxes[i][1].cmplt(boxes[j][0]).any();
            if apart {
                continue;
            }
            for a in 0..PIECES {
                let first = if i == j { a + 2 } else { 0 };
                for b in first..PIECES {
                    // Neighbours share an end.
                    if j == i + 1 && a + 1 == PIECES && b == 0 {
                        continue;
                    }
                    let ends = [[chords[i][a], chords[i][a + 1]], [chords[j][b], chords[j][b + 1]]];
                    if let Some([s, t]) = crossing(ends) {
                        let start = [(a as f64 + s), (b as f64 + t)].map(|t| t / PIECES as f64);
                        let [s, t] = refined([&chain[i], &chain[j]], start);
                        found.push([Place { cubic: i, t: s }, Place { cubic: j, t }]);
                    }
                }
            }
        }
    }
    found
}

/// Returns the parameters at which two straight pieces cross.
fn crossing([[a, b], [c, d]]: [[DVec2; 2]; 2]) -> Option<[f64; 2]> {
    let matrix = DMat2::from_cols(b - a, c - d);
    if matrix.determinant() == 0.0 {
        return None;
    }
    let at = matrix.inverse() * (c - a);
    // A half-open piece lets a crossing at a shared end count once.
    let within = |t: f64| (0.0..1.0).contains(&t);
    (within(at.x) && within(at.y)).then_some([at.x, at.y])
}

/// Returns the parameters at which two cubics cross, by Newton's method from parameters near them.
fn refined([a, b]: [&Cubic<DVec2>; 2], start: [f64; 2]) -> [f64; 2] {
    let mut at = DVec2::from_array(start);
    for _ in 0..STEPS {
        let matrix = DMat2::from_cols(a.velocity(at.x), -b.velocity(at.y));
        if matrix.determinant() == 0.0 {
            break;
        }
        let step = matrix.inverse() * (b.point(at.y) - a.point(at.x));
        let next = (at + step).clamp(DVec2::ZERO, DVec2::ONE);
        if !next.is_finite() || next == at {
            break;
        }
        at = next;
    }
    at.to_array()
}

/// Returns a chain whose ends lie on the axis x = 0 if they should, cut or lengthened.
///
/// # Errors
/// [`Fault::Fills`] where the rest of the chain crosses the axis.
pub(super) fn right_of_axis(
    mut chain: Vec<Cubic<DVec2>>,
    ends: [bool; 2],
    on_axis: f64,
) -> Result<Vec<Cubic<DVec2>>, Fault> {
    if ends[0] {
        chain = from_axis(chain, on_axis);
    }
    if ends[1] {
        let backward = |chain: Vec<Cubic<DVec2>>| -> Vec<Cubic<DVec2>> {
            chain.iter().rev().map(Cubic::reversed).collect()
        };
        chain = backward(from_axis(backward(chain), on_axis));
    }
    let beyond = chain
        .iter()
        .flat_map(|cubic| (0..=PIECES).map(|i| cubic.point(i as f64 / PIECES as f64)))
        .find(|point| point.x < -on_axis);
    match beyond {
        Some(point) => Err(Fault::Fills(point.y)),
        None => Ok(chain),
    }
}

/// Returns a chain whose start lies on the axis.
fn from_axis(mut chain: Vec<Cubic<DVec2>>, on_axis: f64) -> Vec<Cubic<DVec2>> {
    let Some(first) = chain.first() else { return chain };
    let start = first.0[0];
    if start.x.abs() <= on_axis {
        chain[0].0[0].x = 0.0;
        return chain;
    }
    if start.x > 0.0 {
        let tangent = first.tangent(0.0);
        // A steep side is not lengthened far up or down.
        let back =
            if tangent.x > 0.5 { tangent * (start.x / tangent.x) } else { DVec2::X * start.x };
        let foot = DVec2::new(0.0, (start - back).y);
        chain.insert(0, Cubic::line(foot, start));
        return chain;
    }
    // The part left of the axis is cut off.
    let Some(i) = chain.iter().position(|cubic| cubic.0[3].x > 0.0) else { return Vec::new() };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle: f64 = 0.5 * (low + high);
        if chain[i].point(middle).x > 0.0 { high = middle } else { low = middle }
    }
    let mut part = chain[i].part(high, 1.0);
    part.0[0].x = 0.0;
    let mut cut = vec![part];
    cut.extend_from_slice(&chain[i + 1..]);
    cut
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chain(points: &[[f64; 2]]) -> Vec<Cubic<DVec2>> {
        let points: Vec<DVec2> = points.iter().copied().map(DVec2::from_array).collect();
        points.windows(2).map(|ends| Cubic::line(ends[0], ends[1])).collect()
    }

    fn corners(chain: &[Cubic<DVec2>]) -> Vec<[f64; 2]> {
        let ends = chain.iter().map(|cubic| cubic.0[3].to_array());
        std::iter::once(chain[0].0[0].to_array()).chain(ends).collect()
    }

    #[test]
    fn a_loop_is_cut_off_at_its_crossing() {
        let crossed = chain(&[[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 2.0], [2.0, -3.0]]);
        let kept = corners(&without_loops(crossed).unwrap());
        assert_eq!(kept, [[0.0, 0.0], [2.0, 0.0], [2.0, -3.0]]);
        let plain = chain(&[[0.0, 0.0], [4.0, 0.0], [4.0, 2.0]]);
        assert_eq!(without_loops(plain.clone()).unwrap(), plain);
    }

    #[test]
    fn ends_are_brought_to_the_axis() {
        let to_axis = |points: &[[f64; 2]]| {
            right_of_axis(chain(points), [true, false], 1e-9).map(|chain| corners(&chain))
        };
        assert_eq!(to_axis(&[[-1.0, 0.0], [1.0, 2.0]]).unwrap(), [[0.0, 1.0], [1.0, 2.0]]);
        let lengthened = to_axis(&[[1.0, 1.0], [2.0, 2.0]]).unwrap();
        assert!((lengthened[0][1]).abs() < 1e-15 && lengthened[0][0] == 0.0);
        let fills = to_axis(&[[0.0, 0.0], [1.0, 1.0], [-1.0, 2.0]]);
        assert_eq!(fills, Err(Fault::Fills(1.625)));
    }
}
