//! Topology of a mesh: the properties of its surface that do not depend on its shape.
//!
//! Vertices are positions. Two positions with equal coordinates and different indices are two vertices,
//! and the surface is not joined there. All answers come from the sorted edges:
//!
//! - *Orientable*: two triangles that share an edge must run along it in opposite directions, or one of
//!   the two must be turned over. This condition is spread over all edges of two triangles. The surface
//!   is orientable when no triangle must both be turned and not be turned. The present winding of the
//!   triangles does not matter; [`Topology::oriented`] describes the present winding.
//! - *Manifold*: no edge has three triangles, and the triangles around each vertex form one fan, open
//!   or closed. Two corners at a vertex belong to one fan when their triangles share an edge there. The
//!   number of fans must equal the number of vertices.
//! - *Boundary loops*: edges of one triangle, joined end to end through the fan between them. So two
//!   triangles that touch in one point have two loops. Where an edge has three triangles, fans end
//!   without a boundary edge, and the joined edges are chains rather than loops.
//!
//! Source: any text on combinatorial surfaces. Triangles are assumed to have three different corners,
//! as those of a grid do.

use crate::TriMesh;
use crate::forest::Forest;

/// Topology of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Topology {
    /// Number of positions that triangles use.
    pub vertices: usize,
    /// Number of different pairs of positions along the sides of triangles.
    pub edges: usize,
    /// Number of triangles.
    pub faces: usize,
    /// Number of boundary loops: 0 for a closed surface, 2 for a tube.
    pub boundary_loops: usize,
    /// True if triangles can be turned over so that all neighbours have the same winding.
    pub orientable: bool,
    /// True if all neighbours have the same winding already.
    pub oriented: bool,
    /// True if the surface is a disk, or half a disk, around every point.
    pub manifold: bool,
    /// True if there are triangles and every side has a neighbour.
    pub closed: bool,
}

/// A side of a triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Side {
    /// The positions at the two ends, the lower index first.
    pub ends: [u32; 2],
    /// The number of the side among all sides, three to a triangle. The corner at which the side
    /// starts has this number too; the side ends at the next corner of the triangle.
    number: usize,
    /// True if the side leads from the higher position index to the lower.
    downward: bool,
}

impl Topology {
    /// Computes the topology of a mesh.
    #[must_use]
    pub fn of(mesh: &TriMesh) -> Self {
        Self::of_sides(mesh, &sides(mesh))
    }

    /// Returns vertices - edges + faces: 2 for a sphere, 0 for a torus, a tube, a Klein bottle.
    #[must_use]
    pub fn euler(&self) -> i64 {
        self.vertices as i64 - self.edges as i64 + self.faces as i64
    }

    /// Computes the topology from the [`sides`] of a mesh.
    pub(crate) fn of_sides(mesh: &TriMesh, sides: &[Side]) -> Self {
        let (faces, corners) = (mesh.triangles.len(), sides.len());
        let (mut turns, mut fans) = (Forest::new(faces), Forest::new(corners));
        let (mut orientable, mut oriented, mut manifold) = (true, true, true);
        let mut edges = 0;
        let mut boundary = Vec::new();
        for edge in edges_of(sides) {
            edges += 1;
            match edge {
                [one] => boundary.push(*one),
                [one, two] => {
                    let agree = one.downward != two.downward;
                    oriented &= agree;
                    orientable &= turns.join(one.number / 3, two.number / 3, !agree);
                    for (a, b) in one.corners().into_iter().zip(two.corners()) {
                        fans.join(a, b, false);
                    }
                }
                more => {
                    manifold = false;
                    let downward = more.iter().filter(|side| side.downward).count();
                    oriented &= downward <= 1 && more.len() - downward <= 1;
                }
            }
        }
        let vertices = used(mesh);
        Self {
            vertices,
            edges,
            faces,
            boundary_loops: loops(&boundary, &mut fans),
            orientable,
            oriented,
            manifold: manifold && fans.groups() == vertices,
            closed: faces > 0 && boundary.is_empty(),
        }
    }
}

impl Side {
    /// Returns the numbers of the two corners of the side, that of the lower position first.
    fn corners(self) -> [usize; 2] {
        let first = self.number;
        let next = if first % 3 == 2 { first - 2 } else { first + 1 };
        if self.downward { [next, first] } else { [first, next] }
    }
}

/// Returns the sides of all triangles, sorted so that the sides of one edge are adjacent.
pub(crate) fn sides(mesh: &TriMesh) -> Vec<Side> {
    let of_one = |(index, [a, b, c]): (usize, [u32; 3])| {
        [(0, a, b), (1, b, c), (2, c, a)].map(|(side, from, to)| Side {
            ends: [from.min(to), from.max(to)],
            number: 3 * index + side,
            downward: from > to,
        })
    };
    let corners = mesh.triangles.iter().map(|triangle| triangle.position);
    let mut sides: Vec<Side> = corners.enumerate().flat_map(of_one).collect();
    sides.sort_unstable();
    sides
}

/// Splits sorted sides into groups, one for each edge.
pub(crate) fn edges_of(sides: &[Side]) -> impl Iterator<Item = &[Side]> {
    sides.chunk_by(|a, b| a.ends == b.ends)
}

/// Returns the number of positions that triangles use.
fn used(mesh: &TriMesh) -> usize {
    let mut used = vec![false; mesh.positions.len()];
    for index in mesh.triangles.iter().flat_map(|triangle| triangle.position) {
        used[index as usize] = true;
    }
    used.into_iter().filter(|&used| used).count()
}

/// Returns the number of loops of the boundary sides. Sides are joined when they end in one fan.
fn loops(boundary: &[Side], fans: &mut Forest) -> usize {
    let ends =
        |(index, side): (usize, &Side)| side.corners().map(|corner| (fans.root(corner).0, index));
    let mut ends: Vec<(usize, usize)> = boundary.iter().enumerate().flat_map(ends).collect();
    ends.sort_unstable();
    let mut chains = Forest::new(boundary.len());
    for pair in ends.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        chains.join(pair[0].1, pair[1].1, false);
    }
    chains.groups()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Triangle;

    fn topology(count: usize, triangles: &[[u32; 3]]) -> Topology {
        let of = |&position: &[u32; 3]| Triangle { position, uv: [0; 3], normal: [0; 3] };
        let positions = (0..count).map(|i| [i as f32, (i * i) as f32, 0.0]).collect();
        let triangles = triangles.iter().map(of).collect();
        Topology::of(&TriMesh { positions, triangles, ..TriMesh::default() })
    }

    #[test]
    fn one_triangle_is_a_disk() {
        let found = topology(4, &[[0, 2, 1]]);
        let expected = Topology {
            vertices: 3,
            edges: 3,
            faces: 1,
            boundary_loops: 1,
            orientable: true,
            oriented: true,
            manifold: true,
            closed: false,
        };
        assert_eq!((found, found.euler()), (expected, 1));
    }

    #[test]
    fn triangles_that_touch_at_a_point_are_no_manifold_and_have_two_rims() {
        let found = topology(5, &[[0, 1, 2], [0, 3, 4]]);
        assert!(!found.manifold && found.orientable && !found.closed);
        assert_eq!((found.boundary_loops, found.euler()), (2, 1));
    }

    #[test]
    fn three_triangles_at_an_edge_are_no_manifold() {
        let found = topology(5, &[[0, 1, 2], [1, 0, 3], [0, 1, 4]]);
        assert!(!found.manifold && !found.oriented && !found.closed);
    }

    #[test]
    fn a_triangle_turned_over_leaves_the_surface_orientable() {
        // A tetrahedron; the last one is turned.
        let found = topology(4, &[[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 2, 3]]);
        assert!(found.orientable && !found.oriented && found.manifold && found.closed);
        assert_eq!((found.boundary_loops, found.euler()), (0, 2));
    }

    #[test]
    fn nothing_is_not_closed() {
        let found = topology(3, &[]);
        assert!(!found.closed && found.orientable && found.manifold);
        assert_eq!((found.vertices, found.euler(), found.boundary_loops), (0, 0, 0));
    }
}
