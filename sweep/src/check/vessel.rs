//! Walls of vessels that cross themselves, or that are thicker than their profile is round.
//!
//! Where the moved side of a wall crosses itself, its loop was cut off; there the wall has an edge. A side that crosses
//! another side of the wall encloses a part of space twice. For such a wall the check looks for the thickest one that
//! does not cross, by bisection: it reads the spec again with a part of the thickness.

use super::chain::{Crossings, crossings};
use super::{Finding, Severity, short};
use crate::curve::cut::Stop;
use crate::sampling::{Object, Sweep};
use crate::spec::{FORMAT, Law, Resolution, Spec, Trajectory, VERSION, Wall};
use crate::surface::contour::Contour;
use files::json::Document;
use glam::DVec2;

/// Straight pieces of an outline between two of its joints.
const PIECES: usize = 16;

/// Halvings of the range of thicknesses. The stated thickness is smaller than the largest by at most a part in 1000.
const HALVINGS: usize = 10;

/// Cells of a contour that is read only for its outline.
const CELLS: usize = 10_000;

/// Returns the findings about the wall of a vessel. `outlines` are the sweeps of one spec.
#[must_use]
pub fn findings(spec: &Spec, outlines: &[Sweep]) -> Vec<Finding> {
    if spec.wall.is_none() || !matches!(spec.trajectory, Trajectory::Rotation(_)) {
        return Vec::new();
    }
    let mut found = Vec::new();
    let crossed = crossed(outlines);
    if let Some(place) = crossed.first {
        let places = match (crossed.count, crossed.more) {
            (1, false) => "one place".to_owned(),
            (count, false) => format!("{count} places"),
            (count, true) => format!("at least {count} places"),
        };
        let remedy = match (thickest(spec), constant(spec)) {
            (Some(part), Some(whole)) => {
                format!("a wall of {} does not", short(part * whole))
            }
            (Some(part), None) => format!("a wall of {} of this thickness does not", short(part)),
            (None, _) => {
                "so does the thinnest one, since the profile crosses or touches itself".into()
            }
        };
        let message = format!(
            "the wall crosses itself in {places}, the first {} from the axis at the height {}: {remedy}",
            short(place.x),
            short(place.y)
        );
        found.push(Finding::new(Severity::Wrong, "wall", message));
    }
    if let Some(bend) = outlines.iter().find_map(|sweep| sweep.bend) {
        let message = format!(
            "the wall is {} thick where the profile bends with a radius of {}, {} from the axis at the height {}: one \
             side of the wall has an edge there; a thickness of up to {} on that side, or a rounder profile, has none",
            short(bend.thickness),
            short(bend.radius),
            short(bend.point.x),
            short(bend.point.y),
            short(bend.radius)
        );
        found.push(Finding::new(Severity::Hint, "wall", message));
    }
    found
}

/// Returns the crossings of outlines with themselves and each other. An outline that ends on the axis is followed along
/// the axis by the next.
fn crossed(outlines: &[Sweep]) -> Crossings {
    let mut chain: Vec<DVec2> = Vec::new();
    let mut closed = false;
    for sweep in outlines {
        let contour = &sweep.shape.contour;
        closed = contour.closed();
        let mut ends = contour.as_contour().map(Contour::knots).unwrap_or_default();
        ends.extend([0.0, 1.0]);
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        let pieces = |ends: &[f64]| -> Vec<Stop> {
            let part = |i: usize| ends[0] + (ends[1] - ends[0]) * (i as f64 / PIECES as f64);
            (0..PIECES).map(|i| Stop::after(part(i))).collect()
        };
        let mut stops: Vec<Stop> = ends.windows(2).flat_map(pieces).collect();
        if !closed {
            stops.push(Stop::before(1.0));
        }
        chain.extend(contour.columns(&stops).iter().map(|column| column.first.point));
    }
    if closed && let Some(&first) = chain.first() {
        chain.push(first);
    }
    crossings(&chain, closed)
}

/// Returns the thickness of a wall that has one thickness.
fn constant(spec: &Spec) -> Option<f64> {
    match spec.wall.as_ref()? {
        Wall::Thickness(thickness) => Some(*thickness),
        Wall::Keys(keys) => match keys.thickness {
            Law::Number(number) if keys.floor.is_none() => Some(number),
            _ => None,
        },
    }
}

/// Returns the largest part of the thickness whose wall does not cross itself; `None` if every wall does.
fn thickest(spec: &Spec) -> Option<f64> {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if passes(spec, middle) { low = middle } else { high = middle }
    }
    (low > 0.0).then_some(low)
}

/// Returns whether a spec has a wall that does not cross itself with a part of its thickness.
fn passes(spec: &Spec, part: f64) -> bool {
    let own = Spec {
        format: Some(FORMAT.into()),
        version: Some(VERSION),
        wall: spec.wall.clone().map(|wall| thinned(wall, part)),
        depth: None,
        areas: Vec::new(),
        deform: Vec::new(),
        resolution: Resolution { rows: Some(3), cols: Some(CELLS), ..Resolution::default() },
        ..spec.clone()
    };
    let read = || {
        let text = serde_json::to_vec(&own).ok()?;
        let document = Document::new("wall", &text).ok()?;
        Object::read(&document, "".as_ref(), &files::Disk, &Resolution::default()).ok()
    };
    read().is_some_and(|object| crossed(object.parts()).first.is_none())
}

fn thinned(wall: Wall, part: f64) -> Wall {
    let pair = |[at, value]: [f64; 2]| [at, value * part];
    match wall {
        Wall::Thickness(thickness) => Wall::Thickness(thickness * part),
        Wall::Keys(mut keys) => {
            keys.floor = keys.floor.map(|floor| floor * part);
            keys.thickness = match keys.thickness {
                Law::Number(number) => Law::Number(number * part),
                Law::Keys { keys, ease } => {
                    Law::Keys { keys: keys.into_iter().map(pair).collect(), ease }
                }
                Law::Bezier { bezier } => Law::Bezier {
                    bezier: bezier.into_iter().map(|cubic| cubic.map(pair)).collect(),
                },
                Law::Total { total } => Law::Total { total: total * part },
            };
            Wall::Keys(keys)
        }
    }
}
