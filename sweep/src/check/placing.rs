//! Contours that lie far from where the trajectory carries them, frames that spin, and ends that stay open.

use super::{Finding, Severity, short};
use crate::curve::cut::Stop;
use crate::sampling::Sweep;
use crate::spec::{Frame, Spec};
use crate::surface::profile::Column;
use glam::{DVec2, DVec3};

/// A contour whose middle is this many times its size from its origin is swept beside the trajectory.
const FAR: f64 = 3.0;

/// Largest turn of a frame about the trajectory within the width of the contour, in degrees.
const SPIN_DEG: f64 = 45.0;

/// Samples of the trajectory.
const SAMPLES: usize = 2048;

/// Samples of the contour.
const COLUMNS: usize = 256;

/// A profile whose distance from the axis is below this fraction of its largest one was meant to meet the axis.
const NEARLY: f64 = 1e-2;

/// Returns the findings about the position of a contour, and about the frames. A hollow or a hole is not the `first` loop
/// of its spec, and its outside may face the axis.
#[must_use]
pub fn findings(spec: &Spec, sweep: &Sweep, first: bool) -> Vec<Finding> {
    let stops: Vec<Stop> = (0..=COLUMNS).map(|i| Stop::after(i as f64 / COLUMNS as f64)).collect();
    let columns = sweep.shape.columns_at(&stops);
    let points: Vec<DVec2> = columns.iter().map(|column| column.first.point).collect();
    let rotation = sweep.shape.trajectory.is_rotation();
    let mut found = Vec::new();
    if rotation {
        found.extend(downward(sweep, &points).filter(|_| first));
        found.extend(almost_on_axis(sweep, &points));
    } else {
        found.extend(far(&points));
        found.extend(spins(spec, sweep, &columns));
    }
    found
}

fn bounds(points: &[DVec2]) -> [DVec2; 2] {
    points
        .iter()
        .fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], &p| [low.min(p), high.max(p)])
}

fn far(points: &[DVec2]) -> Option<Finding> {
    let [low, high] = bounds(points);
    let (size, away) = ((high - low).max_element(), (0.5 * (low + high)).length());
    let message = format!(
        "the contour lies {} from its origin, {} times its size, so that it is swept beside the trajectory: \
         `\"center\": true` in the contour moves its middle to the origin",
        short(away),
        short(away / size)
    );
    (away > FAR * size).then(|| Finding::new(Severity::Hint, "contour", message))
}

/// Returns a remark about an open profile whose outside faces the axis.
fn downward(sweep: &Sweep, points: &[DVec2]) -> Option<Finding> {
    let [first, .., last] = points else { return None };
    if sweep.contour().closed() || last.y >= first.y {
        return None;
    }
    // A profile that returns on itself has an outside by its own area.
    let [low, high] = bounds(points);
    let falls = first.y - last.y > 0.5 * (high.y - low.y);
    let message = "the profile is drawn downward, so that its outside faces the axis: drawn upward it faces away";
    falls.then(|| Finding::new(Severity::Remark, "contour", message))
}

fn almost_on_axis(sweep: &Sweep, points: &[DVec2]) -> Option<Finding> {
    let [first, .., last] = points else { return None };
    if sweep.contour().closed() {
        return None;
    }
    let most = points.iter().map(|point| point.x).fold(0.0, f64::max);
    let end = [first, last].into_iter().find(|end| end.x > 0.0 && end.x < NEARLY * most)?;
    let message = format!(
        "the profile ends {} from the axis, at the height {}, and leaves a hole there: x = 0 closes the surface",
        short(end.x),
        short(end.y)
    );
    Some(Finding::new(Severity::Hint, "contour", message))
}

/// Returns a hint about the position at which an upright frame turns most about the trajectory.
fn spins(spec: &Spec, sweep: &Sweep, columns: &[Column]) -> Option<Finding> {
    let Some(Frame::Up(up)) = &spec.frame else { return None };
    let shape = &sweep.shape;
    let width = columns
        .iter()
        .map(|column| shape.section(Stop::after(0.0)).local_point(column).length())
        .fold(0.0, f64::max);
    let part = (2.0 * width / shape.trajectory.length()).min(0.5);
    let turn = |v: f64| {
        let [from, to] = [v, v + part].map(|v| shape.trajectory.station(v).frame);
        // The turn beyond the least rotation that takes one tangent to the other.
        let axis = from.tangent.cross(to.tangent);
        let carried = match axis.try_normalize() {
            Some(axis) => {
                let angle =
                    axis.dot(from.tangent.cross(to.tangent)).atan2(from.tangent.dot(to.tangent));
                glam::DQuat::from_axis_angle(axis, angle) * from.normal
            }
            None => from.normal,
        };
        carried.cross(to.normal).dot(to.tangent).atan2(carried.dot(to.normal)).to_degrees().abs()
    };
    let steps = (0..SAMPLES).map(|i| (1.0 - part) * i as f64 / (SAMPLES - 1) as f64);
    let (angle, v) = steps
        .map(|v| (turn(v), v))
        .fold((0.0, 0.0), |most, next| if next.0 > most.0 { next } else { most });
    let tangent = shape.trajectory.station(v + 0.5 * part).frame.tangent;
    let up = DVec3::from_array(*up).normalize_or_zero();
    let off = tangent.dot(up).abs().min(1.0).acos().to_degrees();
    let message = format!(
        "the frame turns by {} degrees within the contour's width at v {}, where the trajectory is within {} degrees of \
         `up`: `start` or `guide` in place of `up` does not turn there",
        short(angle),
        short(v),
        short(off.ceil())
    );
    (angle > SPIN_DEG).then(|| Finding::new(Severity::Hint, "frame.up", message))
}
