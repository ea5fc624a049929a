//! What checks need to know of shapes: boxes, insides, and how meshes hang together.

use super::subject::Item;
use crate::shape::{Mesh, Shape};
use glam::DVec3;
use std::collections::HashMap;
use std::f64::consts::PI;

/// What the edges of a mesh say of its surface; corners at the same place are one.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Skin {
    /// Edges with triangles on one side only.
    pub rims: usize,
    /// Edges whose triangles do not agree on the outside.
    pub flips: usize,
    /// The volume inside; negative when the triangles face inward. Of closed meshes only.
    pub volume: f64,
    /// Triangles without an area.
    pub flat: usize,
    /// Triangles whose corners are those of one before.
    pub doubled: usize,
}

impl Skin {
    /// Looks at a mesh.
    #[must_use]
    pub fn of(mesh: &Mesh) -> Self {
        let mut places: HashMap<[u32; 3], u32> = HashMap::new();
        let ids: Vec<u32> = mesh
            .positions
            .iter()
            // Minus zero is the same place as zero.
            .map(|p| p.map(|x| (x + 0.0).to_bits()))
            .map(|bits| {
                let next = places.len() as u32;
                *places.entry(bits).or_insert(next)
            })
            .collect();
        let mut skin = Self::default();
        // For each edge from the smaller to the larger id: triangles that run along it, and against.
        let mut edges: HashMap<[u32; 2], [u32; 2]> = HashMap::new();
        let mut seen: HashMap<[u32; 3], ()> = HashMap::new();
        for (number, triangle) in mesh.triangles.iter().enumerate() {
            let corners = triangle.position.map(|index| ids[index as usize]);
            let points = mesh.corners(number as u32).map(as_dvec3);
            if (points[1] - points[0]).cross(points[2] - points[0]) == DVec3::ZERO {
                skin.flat += 1;
            }
            let [a, b, c] = corners;
            if a == b || b == c || c == a {
                continue;
            }
            let mut sorted = corners;
            sorted.sort_unstable();
            skin.doubled += usize::from(seen.insert(sorted, ()).is_some());
            skin.volume += points[0].dot(points[1].cross(points[2])) / 6.0;
            for [from, to] in [[a, b], [b, c], [c, a]] {
                let way = usize::from(from > to);
                edges.entry([from.min(to), from.max(to)]).or_default()[way] += 1;
            }
        }
        for [along, against] in edges.into_values() {
            if (along + against) % 2 == 1 {
                skin.rims += 1;
            } else if along != against {
                skin.flips += 1;
            }
        }
        skin
    }

    /// Whether it has an inside.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.rims == 0 && self.flips == 0
    }
}

/// The box around an item; nothing for what has no end.
#[must_use]
pub fn bounds(item: &Item<'_>) -> Option<[DVec3; 2]> {
    item.object.shape.bounds()
}

/// Whether a point is inside a closed item; nothing for one that is open.
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
        _ => None,
    }
}

/// How often a mesh goes around a point: the sum of its triangles' solid angles (Van Oosterom and
/// Strackee 1983), over that of the whole sphere.
fn winding(mesh: &Mesh, point: DVec3) -> f64 {
    let angle = |triangle: u32| {
        let [a, b, c] = mesh.corners(triangle).map(|corner| as_dvec3(corner) - point);
        let lengths = [a.length(), b.length(), c.length()];
        let below = lengths[0] * lengths[1] * lengths[2]
            + a.dot(b) * lengths[2]
            + b.dot(c) * lengths[0]
            + c.dot(a) * lengths[1];
        2.0 * a.dot(b.cross(c)).atan2(below)
    };
    (0..mesh.triangles.len() as u32).map(angle).sum::<f64>() / (4.0 * PI)
}

/// How far a point is from the surface of an item, where it is right above, below or on it.
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
                .filter_map(|triangle| above(mesh.corners(triangle).map(as_dvec3), point));
            heights.min_by(f64::total_cmp)
        }
        Shape::Cuboid(_) | Shape::Superquadric(_) | Shape::Placed(_) => None,
    }
}

/// The distance of a point from a triangle that it is right above or below.
fn above([a, b, c]: [DVec3; 3], point: DVec3) -> Option<f64> {
    let across = (b - a).cross(c - a);
    let normal = across.try_normalize()?;
    let inside = |from: DVec3, to: DVec3| (to - from).cross(point - from).dot(normal) >= 0.0;
    (inside(a, b) && inside(b, c) && inside(c, a)).then(|| (point - a).dot(normal).abs())
}

/// Coordinates of a mesh as the arithmetic has them.
#[must_use]
pub fn as_dvec3(v: [f32; 3]) -> DVec3 {
    DVec3::from(v.map(f64::from))
}
