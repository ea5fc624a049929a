//! Validates a mesh and lists its faults.

use crate::TriMesh;
use crate::diagonal::is_flat;

/// Complaints of one kind that are written out; the rest are counted.
const SPELLED_OUT: usize = 3;
/// Largest allowed difference between the length of a normal and 1: the rounding of a dozen f32
/// operations.
const UNIT: f32 = 1e-5;

impl TriMesh {
    /// Returns complaints about the mesh; the list is empty when there are none.
    ///
    /// The checks find indices out of range, numbers that are not finite, normals that are not of
    /// unit length, triangles without area, and directed edges used twice. A directed edge is used
    /// twice where two neighbouring triangles face opposite sides, and where an edge has three
    /// triangles. So a mesh of a one-sided surface must fail this check. Edges used once, as on the
    /// boundary of an open surface, are valid.
    #[must_use]
    pub fn validate(&self) -> Vec<String> {
        let mut complaints = Complaints::default();
        let counts = [self.positions.len(), self.uvs.len(), self.normals.len()];
        for (i, triangle) in self.triangles.iter().enumerate() {
            let indices = [triangle.position, triangle.uv, triangle.normal];
            for ((what, count), corners) in
                ["position", "picture coordinate", "normal"].iter().zip(counts).zip(indices)
            {
                if let Some(wild) = corners.iter().find(|&&index| index as usize >= count) {
                    complaints.add(format!(
                        "triangle {i}: found {what} {wild}, expected less than {count}"
                    ));
                }
            }
        }
        let wild = complaints.close("indices out of range");

        for (what, arrays) in [
            ("position", self.positions.iter().map(<[f32; 3]>::as_slice).collect::<Vec<_>>()),
            ("picture coordinate", self.uvs.iter().map(<[f32; 2]>::as_slice).collect()),
            ("normal", self.normals.iter().map(<[f32; 3]>::as_slice).collect()),
        ] {
            for (i, numbers) in arrays.iter().enumerate() {
                if !numbers.iter().all(|x| x.is_finite()) {
                    complaints
                        .add(format!("{what} {i}: found {numbers:?}, expected finite numbers"));
                }
            }
        }
        complaints.close("numbers that are not finite");

        for (i, [x, y, z]) in self.normals.iter().enumerate() {
            let length = (x * x + y * y + z * z).sqrt();
            if (length - 1.0).abs() > UNIT {
                complaints.add(format!("normal {i}: found the length {length}, expected 1"));
            }
        }
        complaints.close("normals that are not of unit length");

        // The checks below look up positions, so every index must be in range.
        if wild {
            return complaints.all;
        }
        for (i, triangle) in self.triangles.iter().enumerate() {
            let [a, b, c] = triangle.position.map(|index| self.positions[index as usize]);
            if is_flat(a, b, c) {
                complaints.add(format!("triangle {i}: found no area at {a:?}, {b:?}, {c:?}"));
            }
        }
        complaints.close("triangles without area");

        let mut edges = self.directed_edges();
        edges.sort_unstable();
        for pair in edges.windows(2).filter(|pair| pair[0] == pair[1]) {
            let [from, to] = pair[0];
            complaints.add(format!("found the edge from {from} to {to} twice, expected it once"));
        }
        complaints.close("directed edges used twice");
        complaints.all
    }

    /// Returns the three edges of each triangle as pairs of position indices, start and end.
    #[must_use]
    pub fn directed_edges(&self) -> Vec<[u32; 2]> {
        let of_one = |[a, b, c]: [u32; 3]| [[a, b], [b, c], [c, a]];
        self.triangles.iter().flat_map(|triangle| of_one(triangle.position)).collect()
    }
}

/// A list of complaints with at most [`SPELLED_OUT`] of each kind.
#[derive(Default)]
struct Complaints {
    all: Vec<String>,
    /// Complaints of the current kind so far.
    found: usize,
}

impl Complaints {
    fn add(&mut self, complaint: String) {
        self.found += 1;
        if self.found <= SPELLED_OUT {
            self.all.push(complaint);
        }
    }

    /// Ends a kind of complaint, and returns whether there were any of that kind.
    fn close(&mut self, kind: &str) -> bool {
        if self.found > SPELLED_OUT {
            self.all.push(format!("and {} more {kind}", self.found - SPELLED_OUT));
        }
        std::mem::take(&mut self.found) > 0
    }
}

#[cfg(test)]
mod tests {
    use super::UNIT;
    use crate::{TriMesh, Triangle};

    /// Returns the two triangles of a square.
    fn square() -> TriMesh {
        let triangle = |corners| Triangle { position: corners, uv: corners, normal: [0; 3] };
        TriMesh {
            positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
            uvs: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
            normals: vec![[0.0, 0.0, 1.0]],
            triangles: vec![triangle([0, 1, 2]), triangle([0, 2, 3])],
            ..TriMesh::default()
        }
    }

    /// Returns a mesh of these triangles with positions in general position.
    fn faces(faces: &[[u32; 3]]) -> TriMesh {
        let triangle = |&corners| Triangle { position: corners, uv: [0; 3], normal: [0; 3] };
        let count = faces.iter().flatten().max().map_or(0, |most| most + 1);
        // A curve no four points of which lie in a plane.
        let point = |k: u32| [k as f32, (k * k) as f32, (k * k * k) as f32];
        TriMesh {
            positions: (0..count).map(point).collect(),
            uvs: vec![[0.0, 0.0]],
            normals: vec![[0.0, 0.0, 1.0]],
            triangles: faces.iter().map(triangle).collect(),
            ..TriMesh::default()
        }
    }

    #[test]
    fn sound_meshes_at_the_limits_of_each_check_have_no_complaints() {
        let mut repeated = square();
        repeated.uvs[2] = [7.5, -3.0];
        let mut rounded = square();
        rounded.normals[0] = [0.0, 0.0, 1.0 - 0.9 * UNIT];
        let mut unused = square();
        unused.positions.push([9.0; 3]);
        let mut narrow = square();
        narrow.positions[1] = [0.5, 0.5 - f32::EPSILON, 0.0];
        let closed = faces(&[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]);
        // Two tetrahedra with one vertex in common.
        let pinched = faces(&[
            [0, 2, 1],
            [0, 1, 3],
            [0, 3, 2],
            [1, 2, 3],
            [0, 5, 4],
            [0, 4, 6],
            [0, 6, 5],
            [4, 5, 6],
        ]);
        let sound =
            [TriMesh::default(), square(), repeated, rounded, unused, narrow, closed, pinched];
        for mesh in sound {
            assert_eq!(mesh.validate(), Vec::<String>::new(), "{mesh:?}");
        }
    }

    #[test]
    fn a_surface_with_one_side_has_an_edge_that_is_followed_twice() {
        // A Moebius band of five triangles: each has an edge in common with the next.
        let band = faces(&[[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 0, 4], [4, 0, 1]]);
        let complaints = band.validate();
        assert_eq!(complaints, ["found the edge from 0 to 1 twice, expected it once"]);
    }

    #[test]
    fn every_kind_of_harm_is_found() {
        type Harm = fn(&mut TriMesh);
        let harms: [(Harm, &str); 7] = [
            (
                |m| m.triangles[1].position[2] = 4,
                "triangle 1: found position 4, expected less than 4",
            ),
            (|m| m.triangles[0].normal[0] = 9, "triangle 0: found normal 9, expected less than 1"),
            (|m| m.uvs[2][1] = f32::NAN, "picture coordinate 2: found [1.0, NaN]"),
            (|m| m.normals[0] = [0.0, 0.0, 0.5], "normal 0: found the length 0.5, expected 1"),
            (|m| m.positions[1] = [0.5, 0.5, 0.0], "triangle 0: found no area"),
            (|m| m.triangles[1].position = [0, 3, 2], "edge from 2 to 0 twice"),
            (|m| m.triangles.push(m.triangles[0]), "edge from 0 to 1 twice"),
        ];
        for (harm, expected) in harms {
            let mut mesh = square();
            harm(&mut mesh);
            let complaints = mesh.validate();
            assert!(complaints.iter().any(|c| c.contains(expected)), "{expected}: {complaints:?}");
        }
    }
}
