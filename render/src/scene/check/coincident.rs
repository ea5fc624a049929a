//! Surfaces in the same place, of which only one is seen.

use super::solid::as_dvec3;
use super::subject::{Item, Subject};
use super::{Finding, Severity, count};
use crate::shape::{Mesh, Quad, Shape};
use glam::DVec3;

/// Points of one surface are computed this near to another that coincides with it, in parts of the
/// largest coordinate: what a ray takes for the same place.
const NEAR: f64 = 64.0 * f64::EPSILON;

/// Every flat object against every other and against the triangles of every mesh.
#[must_use]
pub fn findings(subject: &Subject<'_>) -> Vec<Finding> {
    let flat: Vec<(&Item<'_>, &Quad)> = subject
        .items
        .iter()
        .filter_map(|item| match &item.object.shape {
            Shape::Quad(quad) => Some((item, quad)),
            _ => None,
        })
        .collect();
    let mut found = Vec::new();
    for (k, &(item, quad)) in flat.iter().enumerate() {
        for &(other, before) in &flat[..k] {
            if coplanar(quad, before) && overlap(quad, before) {
                let first = format!("{} ({})", other.path, other.kind);
                found.push(pair(
                    subject,
                    item,
                    other,
                    &format!("it lies in {first}, which is seen"),
                ));
            }
        }
        for other in &subject.items {
            let Some(mesh) = other.mesh() else { continue };
            let triangles = standing(mesh, quad);
            if triangles > 0 {
                let message = format!(
                    "{} exactly on {} ({})",
                    count(triangles, "triangle lies", "triangles lie"),
                    item.path,
                    item.kind
                );
                found.push(pair(subject, other, item, &message));
            }
        }
    }
    found
}

/// What to say of two surfaces that coincide; worse when light should go from one to the other.
fn pair(subject: &Subject<'_>, item: &Item<'_>, other: &Item<'_>, what: &str) -> Finding {
    if subject.is_clear(item) || subject.is_clear(other) {
        let message = format!(
            "{what}; of the two the first in the scene is seen, and no light goes from one into \
             the other: leave a small gap"
        );
        return Finding::new(Severity::Hint, &item.path, message);
    }
    let message = format!("{what}; of the two only the first in the scene is seen");
    Finding::new(Severity::Remark, &item.path, message)
}

fn normal(quad: &Quad) -> DVec3 {
    quad.surface_point(quad.corner()).geometric_normal
}

fn coplanar(a: &Quad, b: &Quad) -> bool {
    let size = a.corner().abs().max_element() + b.corner().abs().max_element();
    let apart = (b.corner() - a.corner()).dot(normal(a)).abs();
    normal(a).cross(normal(b)).length() < NEAR && apart <= NEAR * size
}

/// Whether two parallelograms in one plane share an area: no side of either has all of the other
/// beyond it.
fn overlap(a: &Quad, b: &Quad) -> bool {
    let (Some(a_corners), Some(b_corners)) = (a.corners(), b.corners()) else {
        return true;
    };
    let across = normal(a);
    let apart = |from: &[DVec3; 4], other: &[DVec3; 4]| {
        (0..4).any(|k| {
            let axis = (from[(k + 1) % 4] - from[k]).cross(across);
            let range = |points: &[DVec3; 4]| {
                let along = points.map(|p| p.dot(axis));
                [
                    along.into_iter().fold(f64::INFINITY, f64::min),
                    along.into_iter().fold(f64::NEG_INFINITY, f64::max),
                ]
            };
            let ([low, high], [other_low, other_high]) = (range(from), range(other));
            let slack = 1e-9 * (high - low);
            high <= other_low + slack || other_high <= low + slack
        })
    };
    !apart(&a_corners, &b_corners) && !apart(&b_corners, &a_corners)
}

/// How many triangles of a mesh lie in a quad.
fn standing(mesh: &Mesh, quad: &Quad) -> usize {
    let (corner, up) = (quad.corner(), normal(quad));
    let near = |p: DVec3| {
        let size = p.abs().max_element() + corner.abs().max_element();
        (p - corner).dot(up).abs() <= NEAR * size
    };
    let within = |[a, b, c]: [DVec3; 3]| {
        quad.bounds().is_none_or(|[low, high]| {
            let middle = (a + b + c) / 3.0;
            let foot = middle - (middle - corner).dot(up) * up;
            let slack = NEAR * (foot.abs().max_element() + 1.0);
            (foot + slack).cmpge(low).all() && (foot - slack).cmple(high).all()
        })
    };
    let triangles = (0..mesh.triangles.len() as u32).map(|n| mesh.corners(n).map(as_dvec3));
    triangles.filter(|&corners| corners.into_iter().all(near) && within(corners)).count()
}
