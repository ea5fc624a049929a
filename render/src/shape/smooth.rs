//! Normals for the triangles of a mesh that have none.
//!
//! The normal of a corner is the mean of the normals of the triangles around its vertex, each weighted
//! by its angle there (G. Thürmer and C. Wüthrich, "Computing Vertex Normals from Polygonal Facets",
//! 1998). It does not depend on how flat parts are divided into triangles.

use super::mesh::NONE;
use super::{Mesh, Weld};
use glam::DVec3;
use std::collections::HashMap;

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
    // The triangles around each vertex in each group, with their unit normals, and their angles there.
    let mut around: HashMap<(u32, u32), Vec<(DVec3, f64)>> = HashMap::new();
    for &k in &wanted {
        let corners = mesh.corners(k as u32).map(|corner| DVec3::from(corner.map(f64::from)));
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let Some(normal) = normal.try_normalize() else { continue };
        for (c, vertex) in weld.corners(mesh.triangles[k].position).into_iter().enumerate() {
            let [next, last] = [1, 2].map(|step| corners[(c + step) % 3] - corners[c]);
            around.entry((vertex, group(k))).or_default().push((normal, next.angle_between(last)));
        }
    }
    let least_cosine = crease.map(f64::cos);
    let mut known: HashMap<[u32; 3], u32> = HashMap::new();
    for &k in &wanted {
        let own = mesh.normal(k as u32);
        let vertices = weld.corners(mesh.triangles[k].position);
        let normals = vertices.map(|vertex| {
            let faces = around.get(&(vertex, group(k))).map_or(&[][..], Vec::as_slice);
            let sharp = least_cosine.filter(|_| faces.len() <= MOST_AROUND);
            let near = |normal: DVec3| sharp.is_none_or(|cosine| normal.dot(own) >= cosine - 1e-9);
            let near = faces.iter().filter(|(normal, _)| near(*normal));
            near.map(|&(normal, angle)| angle * normal).sum::<DVec3>().normalize_or_zero()
        });
        mesh.triangles[k].normal = normals.map(|normal| {
            let normal = normal.as_vec3().to_array();
            *known.entry(super::weld::bits(normal)).or_insert_with(|| {
                mesh.normals.push(normal);
                mesh.normals.len() as u32 - 1
            })
        });
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
