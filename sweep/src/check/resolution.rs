//! Numbers of cells that were raised, and cells that are too coarse for the surface.

use super::{Finding, Severity, relief, short};
use crate::curve::cut::{self, Stop};
use crate::curve::vector::angle_between;
use crate::sampling::Sweep;
use crate::sampling::resolution::Resolution;
use crate::surface::profile::Column;

/// Largest turn or twist of a surface from one row or column to the next, in degrees. Beyond it the cells are visible
/// instead of the surface.
const COARSE_DEG: f64 = 60.0;

/// Angles that differ by less than this, in degrees, are equal. The angles of even steps differ by rounding.
const ROUNDING: f64 = 1e-6;

/// Returns the findings about the numbers of cells.
#[must_use]
pub fn findings(sweep: &Sweep) -> Vec<Finding> {
    let (columns, rows) = sweep.lines();
    let closed_v = sweep.shape.closed();
    let made = [cut::cells(&rows, closed_v), sweep.cols()];
    let mut found = Vec::new();
    if let Resolution::Cells { rows, cols } = *sweep.resolution() {
        found.extend(counts(sweep, "rows", rows, made[0]));
        found.extend(counts(sweep, "cols", cols, made[1]));
    }
    found.extend(aliases(sweep));
    found.extend(bends(sweep, &rows, closed_v));
    found.extend(turns(sweep, &columns));
    found
}

/// Returns findings about twists and waves that rows and columns sample too coarsely, so that they show another surface.
#[must_use]
pub fn aliases(sweep: &Sweep) -> Vec<Finding> {
    let mut found = relief::coarse(sweep);
    found.extend(twist(sweep, &sweep.row_stops(), sweep.shape.closed()));
    found
}

/// Returns a remark if the number of cells differs from the requested number.
fn counts(sweep: &Sweep, key: &str, asked: usize, made: usize) -> Option<Finding> {
    let why = match (key, &sweep.shape.closing) {
        ("cols", Some(closing)) if closing.mirrored => {
            "so that columns meet over the mirrored seam"
        }
        ("cols", Some(_)) => "so that columns meet over the shifted seam",
        ("cols", None) => "for the pieces between creases",
        _ => "for corners, poles and caps",
    };
    let message = format!("found {asked}, made {made} {why}");
    (asked != made).then(|| Finding::new(Severity::Remark, format!("mesh.{key}"), message))
}

/// Returns the intervals between neighbouring positions; in a closed direction also from the last to 1.
fn steps(positions: &[f64], closed: bool) -> Vec<[f64; 2]> {
    let end = closed.then_some(1.0);
    let next = positions.iter().copied().skip(1).chain(end);
    positions.iter().copied().zip(next).filter(|(a, b)| a < b).map(|(a, b)| [a, b]).collect()
}

/// Returns the number of cells that would reduce an angle to the largest smooth one.
fn enough(cells: usize, angle_deg: f64) -> usize {
    (cells as f64 * angle_deg / COARSE_DEG - ROUNDING).ceil() as usize
}

/// Returns the first step with the largest angle, if this angle is too large.
fn coarsest(angles: impl Iterator<Item = (f64, f64)>) -> Option<(f64, f64)> {
    let larger = |largest: (f64, f64), next: (f64, f64)| {
        if next.0 > largest.0 + ROUNDING { next } else { largest }
    };
    let largest = angles.fold((0.0, 0.0), larger);
    (largest.0 > COARSE_DEG + ROUNDING).then_some(largest)
}

fn row_steps(sweep: &Sweep, rows: &[Stop], closed: bool) -> Vec<[f64; 2]> {
    let positions: Vec<f64> =
        rows.iter().filter(|stop| sweep.shape.along(**stop).is_some()).map(|s| s.at).collect();
    steps(&positions, closed)
}

fn twist(sweep: &Sweep, rows: &[Stop], closed: bool) -> Option<Finding> {
    let law = sweep.shape.modulation.twist.as_ref();
    let degrees = |stop: Stop| {
        let at = sweep.shape.along(stop).unwrap_or(0.0);
        law.map_or(0.0, |law| law.at(at).0) + 360.0 * sweep.shape.modulation.turn * at
    };
    let angles = row_steps(sweep, rows, closed)
        .into_iter()
        .map(|[a, b]| ((degrees(Stop::before(b)) - degrees(Stop::after(a))).abs(), a));
    let (angle, v) = coarsest(angles)?;
    let message = format!(
        "the twist turns the contour by {} degrees from one row to the next at v {}: {} rows \
         would reduce the angle to {COARSE_DEG}",
        short(angle),
        short(v),
        enough(sweep.rows(), angle)
    );
    Some(Finding::new(Severity::Hint, if law.is_some() { "twist" } else { "mesh.rows" }, message))
}

fn bends(sweep: &Sweep, rows: &[Stop], closed: bool) -> Option<Finding> {
    let direction = |stop: Stop| sweep.shape.section(stop).frame().tangent;
    let angles = row_steps(sweep, rows, closed).into_iter().map(|[a, b]| {
        // The sum over the middle also finds a turn of more than half.
        let middle = direction(Stop::after(0.5 * (a + b)));
        let [from, to] = [direction(Stop::after(a)), direction(Stop::before(b))];
        ((angle_between(from, middle) + angle_between(middle, to)).to_degrees(), a)
    });
    let (angle, v) = coarsest(angles)?;
    let message = format!(
        "the trajectory turns by {} degrees from one row to the next at v {}: {} rows would \
         reduce the angle to {COARSE_DEG}",
        short(angle),
        short(v),
        enough(sweep.rows(), angle)
    );
    Some(Finding::new(Severity::Hint, "mesh.rows", message))
}

fn turns(sweep: &Sweep, columns: &[Column]) -> Option<Finding> {
    let tangents = |column: &Column| -> Vec<_> {
        std::iter::once(column.first.tangent)
            .chain(column.others.iter().map(|o| o.tangent))
            .collect()
    };
    let us: Vec<f64> = columns.iter().map(|column| column.u).collect();
    let angles = steps(&us, sweep.shape.contour.closed()).into_iter().map(|[a, b]| {
        let stops = [Stop::after(a), Stop::after(0.5 * (a + b)), Stop::before(b)];
        let sampled = sweep.shape.contour.columns(&stops);
        let [from, middle, to] = [0, 1, 2].map(|i| tangents(&sampled[i]));
        let turn = |i: usize| angle_between(from[i], middle[i]) + angle_between(middle[i], to[i]);
        ((0..from.len()).map(turn).fold(0.0, f64::max).to_degrees(), a)
    });
    let (angle, u) = coarsest(angles)?;
    let message = format!(
        "the contour turns by {} degrees from one column to the next at u {}: {} cols would \
         reduce the angle to {COARSE_DEG}",
        short(angle),
        short(u),
        enough(sweep.cols(), angle)
    );
    Some(Finding::new(Severity::Hint, "mesh.cols", message))
}
