//! Rims, folded sides and volume of a mesh.

use crate::shape::mesh::as_dvec3;
use crate::shape::{Mesh, Shape, Weld};
use glam::DVec3;
use std::collections::{HashMap, HashSet};

/// Properties of a mesh's surface, counted over its edges and triangles. Corners at equal positions
/// count as one corner.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Skin {
    /// Number of edges with an odd number of triangles.
    pub rims: usize,
    /// Number of edges whose triangles do not agree on the outside.
    pub flips: usize,
    /// Enclosed volume, in cubic scene units; negative if the triangles face inward. It has no meaning
    /// for an open mesh.
    pub volume: f64,
    /// Number of triangles without an area.
    pub flat: usize,
    /// Number of triangles whose corners are those of an earlier triangle.
    pub doubled: usize,
}

/// The skins of meshes that several objects share, each examined once.
#[derive(Debug, Default)]
pub struct Skins {
    shared: HashMap<usize, Skin>,
}

impl Skins {
    /// Returns the skin of a shape in scene space, if the shape is a mesh.
    pub fn of(&mut self, shape: &Shape) -> Option<Skin> {
        let Shape::Instance(instance) = shape else { return shape.mesh().map(Skin::of) };
        let known = self.shared.entry(instance.key());
        let own = known.or_insert_with(|| Skin::of(instance.mesh()));
        // A placement that mirrors keeps the outside, and with it the sign of the volume.
        let growth = instance.placement().to_scene().matrix3.determinant().abs();
        Some(Skin { volume: growth * own.volume, ..*own })
    }
}

impl Skin {
    /// Examines a mesh.
    #[must_use]
    pub fn of(mesh: &Mesh) -> Self {
        let weld = Weld::new(&mesh.positions);
        let mut skin = Self::default();
        // For each edge, with its smaller corner first: numbers of triangles that run along the edge
        // and against it.
        let mut edges: HashMap<[u32; 2], [u32; 2]> = HashMap::new();
        let mut seen: HashSet<[u32; 3]> = HashSet::new();
        for (number, triangle) in mesh.triangles.iter().enumerate() {
            let corners = weld.corners(triangle.position);
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
            skin.doubled += usize::from(!seen.insert(sorted));
            skin.volume += points[0].dot(points[1].cross(points[2])) / 6.0;
            for [from, to] in [[a, b], [b, c], [c, a]] {
                let against = usize::from(from > to);
                edges.entry([from.min(to), from.max(to)]).or_default()[against] += 1;
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

    /// Returns whether the mesh has an inside.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.rims == 0 && self.flips == 0
    }
}
