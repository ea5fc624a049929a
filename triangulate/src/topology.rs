//! What a mesh is like as a surface, whatever its shape.
//!
//! Positions are the vertices: where two positions have the same numbers and different indices,
//! the surface is not joined there. All answers come from the edges, sorted:
//!
//! - *Orientable*: neighbours over an edge of two triangles must run along it in opposite directions,
//!   or one of them be turned over. That is spread over all such edges; the surface is orientable
//!   when nothing comes back turned. So it does not matter how the triangles are turned now:
//!   [`Topology::oriented`] tells that.
//! - *Manifold*: no edge has three triangles, and around each vertex its triangles are one fan, open
//!   or closed. Two corners of a vertex belong to one fan when their triangles share an edge there;
//!   there must be as many fans as vertices.
//! - *Boundary loops*: edges of one triangle, joined end to end through the fan between them. So
//!   two triangles that touch at a point have two loops. Where an edge has three triangles, fans
//!   end without a boundary, and these are chains rather than loops.
//!
//! Source: any text on combinatorial surfaces. Triangles are taken to have three different
//! corners, as those of a grid do.

use crate::TriMesh;
use crate::forest::Forest;

/// What a mesh is like as a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Topology {
    /// Positions that triangles use.
    pub vertices: usize,
    /// Different pairs of them along the sides of triangles.
    pub edges: usize,
    /// Triangles.
    pub faces: usize,
    /// Rims: 0 for a closed surface, 2 for a tube.
    pub boundary_loops: usize,
    /// Whether its triangles can be turned so that all neighbours agree.
    pub orientable: bool,
    /// Whether they agree as they are.
    pub oriented: bool,
    /// Whether it looks like a disk, or half a disk, around every point.
    pub manifold: bool,
    /// Whether there are triangles, and none has a side without a neighbour.
    pub closed: bool,
}

/// A side of a triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Side {
    /// The positions at its ends, the lower number first.
    pub ends: [u32; 2],
    /// Its number among all sides, three to a triangle: it leads from the corner of that number to
    /// the next one of the triangle.
    number: usize,
    /// Whether it leads from the higher position to the lower.
    downward: bool,
}

impl Topology {
    /// Looks at a mesh.
    #[must_use]
    pub fn of(mesh: &TriMesh) -> Self {
        Self::of_sides(mesh, &sides(mesh))
    }

    /// Vertices - edges + faces: 2 for a sphere, 0 for a torus, a tube, a Klein bottle.
    #[must_use]
    pub fn euler(&self) -> i64 {
        self.vertices as i64 - self.edges as i64 + self.faces as i64
    }

    /// Looks at the [`sides`] of a mesh.
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
    /// The numbers of its corners, that of the lower position first.
    fn corners(self) -> [usize; 2] {
        let first = self.number;
        let next = if first % 3 == 2 { first - 2 } else { first + 1 };
        if self.downward { [next, first] } else { [first, next] }
    }
}

/// All sides of all triangles, those of an edge side by side.
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

/// Sorted sides edge by edge.
pub(crate) fn edges_of(sides: &[Side]) -> impl Iterator<Item = &[Side]> {
    sides.chunk_by(|a, b| a.ends == b.ends)
}

/// How many positions triangles use.
fn used(mesh: &TriMesh) -> usize {
    let mut used = vec![false; mesh.positions.len()];
    for index in mesh.triangles.iter().flat_map(|triangle| triangle.position) {
        used[index as usize] = true;
    }
    used.into_iter().filter(|&used| used).count()
}

/// How many loops the sides on the boundary make, joined where they are ends of one fan.
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
