//! Normals for the triangles of a mesh that have none.
//!
//! The normal of a corner is the mean of the normals of the triangles around its vertex, each weighted
//! by its angle there (G. Thürmer and C. Wüthrich, "Computing Vertex Normals from Polygonal Facets",
//! 1998). It does not depend on how flat parts are divided into triangles.

use super::mesh::NONE;
use super::weld::bits;
use super::{Mesh, Weld};
use glam::DVec3;
use std::ops::Range;

/// Largest number of triangles around a vertex for which creases are found. The time grows with its
/// square. Around a vertex of more, all triangles of a group are averaged.
const MOST_AROUND: usize = 512;

/// Adds normals to the triangles that lack them.
///
/// `groups` is the smoothing group of each triangle, or empty. Only triangles of the same group are
/// averaged, and group 0 stays flat. With a `crease`, an angle in radians, triangles are averaged up to
/// this angle between their planes. If `groups` is empty or names no group at all, a crease averages all
/// triangles.
pub fn smooth(mesh: &mut Mesh, groups: &[u32], crease: Option<f64>) {
    let count = mesh.triangles.len();
    let named = groups.iter().any(|&group| group != 0);
    let group = |k: usize| if named { groups[k] } else { u32::from(crease.is_some()) };
    let wanted: Vec<usize> =
        (0..count).filter(|&k| mesh.triangles[k].normal[0] == NONE && group(k) != 0).collect();
    let weld = Weld::new(&mesh.positions);
    let around = Around::new(mesh, &wanted, &weld);
    let least_cosine = crease.map(f64::cos);
    let mut made = Made { of: vec![NONE; around.corners.len()], zero: None };
    for &k in &wanted {
        let own = mesh.normal(k as u32);
        let normals = weld.corners(mesh.triangles[k].position).map(|vertex| {
            let range = around.starts[vertex as usize]..around.starts[vertex as usize + 1];
            let faces = &around.corners[range.clone()];
            let is_of_group = |corner: &&u32| group(wanted[**corner as usize / 3]) == group(k);
            let sharp =
                least_cosine.filter(|_| faces.iter().filter(is_of_group).count() <= MOST_AROUND);
            let first = faces.iter().position(|corner| is_of_group(&corner));
            // Without a crease, all corners of a group at a vertex have the same normal.
            if let (None, Some(first)) = (sharp, first)
                && made.of[range.start + first] != NONE
            {
                return made.of[range.start + first];
            }
            let near = |normal: DVec3| sharp.is_none_or(|cosine| normal.dot(own) >= cosine - 1e-9);
            let faces = faces.iter().filter(is_of_group).map(|&corner| around.part(corner));
            let faces = faces.filter(|&(normal, _)| near(normal));
            let sum = faces.map(|(normal, angle)| angle * normal).sum::<DVec3>();
            let normal = sum.normalize_or_zero().as_vec3().to_array();
            let places = match (sharp, first) {
                (None, Some(first)) => range.start + first..range.start + first + 1,
                _ => range,
            };
            made.index(normal, places, &mut mesh.normals)
        });
        mesh.triangles[k].normal = normals;
    }
}

/// The triangles around each vertex of a mesh.
struct Around {
    /// Corners of triangles, three for each, ordered by vertex. A corner is 3 k + c in triangle `k` of
    /// those that are averaged. Triangles without area are left out.
    corners: Vec<u32>,
    /// The first corner of each vertex, and the end.
    starts: Vec<usize>,
    /// Unit normals of the triangles.
    normals: Vec<DVec3>,
    /// Angles at the corners of the triangles.
    angles: Vec<[f64; 3]>,
}

impl Around {
    fn new(mesh: &Mesh, wanted: &[usize], weld: &Weld) -> Self {
        let (mut normals, mut angles) = (Vec::new(), Vec::new());
        for &k in wanted {
            let corners = mesh.corners(k as u32).map(|corner| DVec3::from(corner.map(f64::from)));
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            normals.push(normal.normalize_or_zero());
            angles.push([0, 1, 2].map(|c| {
                let [next, last] = [1, 2].map(|step| corners[(c + step) % 3] - corners[c]);
                next.angle_between(last)
            }));
        }
        // Each corner is put behind those of smaller vertices, and of earlier triangles.
        let vertices = |w: usize| weld.corners(mesh.triangles[wanted[w]].position);
        let has_area = |w: &usize| normals[*w] != DVec3::ZERO;
        let mut starts = vec![0; mesh.positions.len() + 1];
        for vertex in (0..wanted.len()).filter(has_area).flat_map(vertices) {
            starts[vertex as usize + 1] += 1;
        }
        for vertex in 1..starts.len() {
            starts[vertex] += starts[vertex - 1];
        }
        let mut next = starts.clone();
        let mut corners = vec![0; *starts.last().unwrap_or(&0)];
        for w in (0..wanted.len()).filter(has_area) {
            for (c, vertex) in (0..).zip(vertices(w)) {
                corners[next[vertex as usize]] = 3 * w as u32 + c;
                next[vertex as usize] += 1;
            }
        }
        Self { corners, starts, normals, angles }
    }

    /// Returns the normal of a corner's triangle, and the angle there.
    fn part(&self, corner: u32) -> (DVec3, f64) {
        let (w, c) = (corner as usize / 3, corner as usize % 3);
        (self.normals[w], self.angles[w][c])
    }
}

/// The normals made so far.
struct Made {
    /// Indices of the normals of each vertex, at the places of its corners; [`NONE`] behind them.
    of: Vec<u32>,
    /// Index of the normal of vertices whose triangles have no area.
    zero: Option<u32>,
}

impl Made {
    /// Returns the index of a normal, which is added unless it is at one of the places.
    fn index(
        &mut self,
        normal: [f32; 3],
        places: Range<usize>,
        normals: &mut Vec<[f32; 3]>,
    ) -> u32 {
        let same = |index: u32| bits(normals[index as usize]) == bits(normal);
        let of_vertex = &self.of[places.clone()];
        let known = of_vertex.iter().copied().take_while(|&index| index != NONE).find(|&k| same(k));
        if let Some(index) = known.or(self.zero.filter(|_| places.is_empty())) {
            return index;
        }
        let free = of_vertex.iter().position(|&index| index == NONE);
        let index = normals.len() as u32;
        normals.push(normal);
        match free {
            Some(free) => self.of[places.start + free] = index,
            None if places.is_empty() => self.zero = Some(index),
            None => {}
        }
        index
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::mesh::Triangle;

    /// A cube of side 2 around the origin, whose corners are shared or written for each face.
    fn cube(shared: bool) -> Mesh {
        let mut mesh = Mesh { surfaces: vec![String::new()], ..Mesh::default() };
        for (axis, side) in (0..3).flat_map(|axis| [(axis, -1.0), (axis, 1.0)]) {
            let corner = |u: f32, v: f32| {
                let mut at = [side; 3];
                (at[(axis + 1) % 3], at[(axis + 2) % 3]) = (u, side * v);
                at
            };
            let ring = [corner(-1., -1.), corner(1., -1.), corner(1., 1.), corner(-1., 1.)];
            let indices = ring.map(|at| {
                let old = mesh.positions.iter().position(|&other| shared && other == at);
                old.unwrap_or_else(|| {
                    mesh.positions.push(at);
                    mesh.positions.len() - 1
                }) as u32
            });
            for [b, c] in [[1, 2], [2, 3]] {
                let position = [indices[0], indices[b], indices[c]];
                mesh.triangles.push(Triangle {
                    position,
                    uv: [NONE; 3],
                    normal: [NONE; 3],
                    surface: 0,
                });
            }
        }
        mesh
    }

    /// Three squares meet at each corner with equal angles, however they are divided.
    #[test]
    fn a_cube_as_one_group_has_its_diagonals_as_normals() {
        for shared in [false, true] {
            for (groups, crease) in [(vec![3; 12], None), (vec![], Some(100f64.to_radians()))] {
                let mut mesh = cube(shared);
                smooth(&mut mesh, &groups, crease);
                assert_eq!(mesh.normals.len(), 8);
                for triangle in &mesh.triangles {
                    for (corner, normal) in triangle.position.into_iter().zip(triangle.normal) {
                        let at = DVec3::from(mesh.positions[corner as usize].map(f64::from));
                        let normal = DVec3::from(mesh.normals[normal as usize].map(f64::from));
                        assert!(normal.abs_diff_eq(at.normalize(), 1e-6), "{normal} at {at}");
                    }
                }
            }
        }
    }

    #[test]
    fn creases_and_groups_keep_edges() {
        let flat = |mesh: &Mesh| {
            (0..12).all(|k| {
                let own = mesh.normal(k).as_vec3().to_array();
                let normals = mesh.triangles[k as usize].normal;
                normals.iter().all(|&index| {
                    let found = mesh.normals[index as usize];
                    found.iter().zip(own).all(|(a, b)| (a - b).abs() < 1e-6)
                })
            })
        };
        let mut creased = cube(true);
        smooth(&mut creased, &[], Some(30f64.to_radians()));
        assert!(flat(&creased), "{:?}", creased.normals);
        // Each face is a group of its own.
        let mut grouped = cube(true);
        smooth(&mut grouped, &[1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6], None);
        assert!(flat(&grouped));
        let mut off = cube(true);
        smooth(&mut off, &[0; 12], None);
        assert!(off.triangles.iter().all(|triangle| triangle.normal == [NONE; 3]));
    }
}
