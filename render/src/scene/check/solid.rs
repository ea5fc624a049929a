//! Bounding boxes, insides and heights of shapes, for the checks.

use super::subject::Item;
use crate::shape::{Mesh, Shape};
use glam::DVec3;
use std::f64::consts::PI;

/// Returns the lower and upper corner of an item's bounding box; `None` for an infinite plane.
#[must_use]
pub fn bounds(item: &Item<'_>) -> Option<[DVec3; 2]> {
    match &item.object.shape {
        Shape::Instance(instance) => Some(instance.box_of_mesh()),
        shape => shape.bounds(),
    }
}

/// Returns whether a point is inside a closed item. Returns `None` for an open item, and for a kind
/// of shape whose inside is not computed.
#[must_use]
pub fn contains(item: &Item<'_>, point: DVec3) -> Option<bool> {
    match &item.object.shape {
        Shape::Sphere(sphere) => Some(point.distance(sphere.center) < sphere.radius),
        Shape::Cuboid(cuboid) => {
            let [low, high] = cuboid.bounds();
            Some(point.cmpgt(low).all() && point.cmplt(high).all())
        }
        Shape::Mesh(mesh) => {
            let closed = item.skin.is_some_and(|skin| skin.is_closed());
            closed.then(|| winding(mesh, point).abs() > 0.5)
        }
        Shape::Instance(instance) => {
            let [low, high] = instance.bounds();
            let near = point.cmpge(low).all() && point.cmple(high).all();
            let own = || instance.placement().to_own().transform_point3(point);
            let closed = item.skin.is_some_and(|skin| skin.is_closed());
            closed.then(|| near && winding(instance.mesh(), own()).abs() > 0.5)
        }
        Shape::Quad(_) | Shape::Superquadric(_) | Shape::Placed(_) => None,
    }
}

/// Returns the winding number of a mesh around a point: the sum of its triangles' solid angles (Van
/// Oosterom and Strackee 1983), divided by 4 pi.
fn winding(mesh: &Mesh, point: DVec3) -> f64 {
    let angle = |triangle: u32| {
        let [a, b, c] = mesh.places(triangle).map(|corner| corner - point);
        let lengths = [a.length(), b.length(), c.length()];
        let below = lengths[0] * lengths[1] * lengths[2]
            + a.dot(b) * lengths[2]
            + b.dot(c) * lengths[0]
            + c.dot(a) * lengths[1];
        2.0 * a.dot(b.cross(c)).atan2(below)
    };
    (0..mesh.triangles.len() as u32).map(angle).sum::<f64>() / (4.0 * PI)
}

/// Returns the distance of a point from the surface of an item, in scene units, if the point has a
/// perpendicular foot on the surface. Returns `None` for a kind of shape whose feet are not computed.
#[must_use]
pub fn height(item: &Item<'_>, point: DVec3) -> Option<f64> {
    match &item.object.shape {
        Shape::Sphere(sphere) => Some((point.distance(sphere.center) - sphere.radius).abs()),
        Shape::Quad(quad) => {
            let foot = quad.surface_point(point).position;
            let slack = f64::EPSILON * 64.0 * (foot.abs().max_element() + 1.0);
            let within = |[low, high]: [DVec3; 2]| {
                (foot + slack).cmpge(low).all() && (foot - slack).cmple(high).all()
            };
            quad.bounds().is_none_or(within).then(|| foot.distance(point))
        }
        Shape::Mesh(mesh) => {
            let heights = (0..mesh.triangles.len() as u32)
                .filter_map(|triangle| above(mesh.places(triangle), point));
            heights.min_by(f64::total_cmp)
        }
        Shape::Cuboid(_) | Shape::Superquadric(_) | Shape::Placed(_) | Shape::Instance(_) => None,
    }
}

/// Returns the distance of a point from a triangle, if its perpendicular foot lies in the triangle.
fn above([a, b, c]: [DVec3; 3], point: DVec3) -> Option<f64> {
    let across = (b - a).cross(c - a);
    let normal = across.try_normalize()?;
    let inside = |from: DVec3, to: DVec3| (to - from).cross(point - from).dot(normal) >= 0.0;
    (inside(a, b) && inside(b, c) && inside(c, a)).then(|| (point - a).dot(normal).abs())
}
