//! A profile moved along its normals.
//!
//! Let `c(u)` be the profile, `T` its tangent, `n` the normal to the right and `k` its curvature, all by arc length `s`.
//! Then the moved profile and its derivative are
//!
//! ```text
//!     p = c + d n,    p_s = (1 + d k) T + d_s n
//! ```
//!
//! so that cubics with these points and derivatives at their ends are near it. Around a corner an arc about the corner
//! joins the moved sides, and inside a corner a line, whose loop is cut off later. Sides at different distances, as those
//! of a floor, are lengthened until they meet.

use super::{Vessel, arc};
use crate::curve::cut::{Side, Stop};
use crate::curve::{Cubic, hermite};
use glam::{DVec2, DVec3};

/// Largest distance of the cubics from the moved profile, as a fraction of its size: the rounding of a mesh's f32.
pub(super) const NEAR: f64 = 6e-8;

/// Cubics of a piece between two knots, before any is halved.
const PIECES: usize = 2;

/// Sines of a turn below this number are those of a straight profile.
const STRAIGHT: f64 = 1e-9;

/// Returns the profile moved by a part of the thickness, to the right if the part is above 0, as a chain of cubics.
pub(super) fn moved(vessel: &Vessel<'_>, part: f64) -> Vec<Cubic<DVec2>> {
    let profile = vessel.profile;
    let mut ends: Vec<f64> = [0.0].into_iter().chain(profile.breaks()).chain([1.0]).collect();
    ends.dedup();
    let pieces = ends.len() - 1;
    let on_axis = vessel.on_axis();
    let mut chain: Vec<Cubic<DVec2>> = Vec::new();
    let mut before: Option<Local> = None;
    for piece in 0..pieces {
        let range = [ends[piece], ends[piece + 1]];
        let floor = (piece == 0 && on_axis[0] || piece + 1 == pieces && on_axis[1]) && pieces > 1;
        let of = |stop: Stop| local(vessel, part, vessel.floor.filter(|_| floor), stop);
        let start = of(Stop::after(range[0]));
        if let Some(last) = &before {
            chain.extend(join(last, &start));
        }
        chain.extend(side(vessel, range, &of));
        before = Some(of(Stop::before(range[1])));
    }
    chain
}

/// A point of the profile and of the moved profile.
struct Local {
    corner: DVec2,
    tangent: DVec2,
    point: DVec2,
    /// Derivative of the moved point by the fraction of the length.
    slope: DVec2,
    /// Distance to the right.
    distance: f64,
    straight: bool,
}

fn local(vessel: &Vessel<'_>, part: f64, floor: Option<f64>, stop: Stop) -> Local {
    let here = vessel.profile.at(stop);
    let (thickness, change) = floor.map_or_else(|| vessel.thickness.on(stop), |floor| (floor, 0.0));
    let (distance, change) = (part * thickness, part * change);
    let normal = -here.tangent.perp();
    let length = 1.0 / here.pace;
    let bend = here.curvature * distance;
    Local {
        corner: here.point,
        tangent: here.tangent,
        point: here.point + normal * distance,
        slope: here.tangent * (length * (1.0 + bend)) + normal * change,
        distance,
        straight: here.curvature * length == 0.0 && change == 0.0,
    }
}

/// Returns the chain between two sides at a corner.
fn join(before: &Local, after: &Local) -> Vec<Cubic<DVec2>> {
    let turn = before.tangent.angle_to(after.tangent);
    if turn.abs() < STRAIGHT && before.point.distance(after.point) == 0.0 {
        return Vec::new();
    }
    if before.distance != after.distance {
        return stepped(before, after);
    }
    // To the right of a turn to the left the moved sides leave a gap.
    let gap = turn * before.distance > 0.0;
    if gap {
        let radius = before.distance.abs();
        let joined = arc(before.corner, radius, before.point - before.corner, turn);
        return closed_up(joined, before.point, after.point);
    }
    vec![Cubic::line(before.point, after.point)]
}

/// Returns the chain between two sides at different distances from a corner: both are lengthened to the point where they
/// meet, or beyond it, so that they cross there.
fn stepped(before: &Local, after: &Local) -> Vec<Cubic<DVec2>> {
    let (p, q) = (before.point, after.point);
    let (u, v) = (before.tangent, after.tangent);
    let across = u.perp_dot(v);
    if across.abs() < STRAIGHT {
        return vec![Cubic::line(p, q)];
    }
    let ahead = (q - p).perp_dot(v) / across;
    let back = -(q - p).perp_dot(u) / across;
    if ahead >= 0.0 && back >= 0.0 {
        let corner = p + u * ahead;
        return vec![Cubic::line(p, corner), Cubic::line(corner, q)];
    }
    let beyond = p.distance(q);
    let [a, b] = [p + u * (ahead.max(0.0) + beyond), q - v * (back.max(0.0) + beyond)];
    vec![Cubic::line(p, a), Cubic::line(a, b), Cubic::line(b, q)]
}

/// Moves the ends of a chain to their points, which differ by rounding.
fn closed_up(mut chain: Vec<Cubic<DVec2>>, from: DVec2, to: DVec2) -> Vec<Cubic<DVec2>> {
    if let Some(first) = chain.first_mut() {
        first.0[0] = from;
    }
    if let Some(last) = chain.last_mut() {
        last.0[3] = to;
    }
    chain
}

/// Returns the moved piece of the profile between two corners.
fn side(
    vessel: &Vessel<'_>,
    [from, to]: [f64; 2],
    of: &dyn Fn(Stop) -> Local,
) -> Vec<Cubic<DVec2>> {
    let profile = vessel.profile;
    let inside = |at: &f64| *at > from && *at < to;
    let mut ends: Vec<f64> = [from, to]
        .into_iter()
        .chain(profile.knots().into_iter().filter(inside))
        .chain(vessel.thickness.kinks().into_iter().filter(inside))
        .collect();
    ends.sort_by(f64::total_cmp);
    ends.dedup_by(|later, earlier| *later - *earlier < 1e-9 * (to - from));
    let at = |t: f64, side: Side| {
        let stop = if t >= to { Stop::before(to) } else { Stop { at: t.max(from), side } };
        of(stop)
    };
    let mut chain = Vec::new();
    for span in ends.windows(2) {
        let middle = 0.5 * (span[0] + span[1]);
        let probes = [0.07, 0.31, 0.5, 0.77, 0.93].map(|part| span[0] + part * (span[1] - span[0]));
        if probes.iter().all(|&t| at(t, Side::After).straight) {
            let ends = [at(span[0], Side::After).point, at(span[1], Side::Before).point];
            chain.push(Cubic::line(ends[0], ends[1]));
            continue;
        }
        let curve = |t: f64| {
            let here = at(t, if t > middle { Side::Before } else { Side::After });
            [here.point.extend(0.0), here.slope.extend(0.0)]
        };
        let cubics = hermite::between(curve, span, PIECES, NEAR).unwrap_or_default();
        chain.extend(cubics.into_iter().map(|cubic| Cubic(cubic.0.map(DVec3::truncate))));
    }
    chain
}
