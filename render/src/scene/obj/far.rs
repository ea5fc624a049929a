//! Vertices far from the origin, which are read again with all their digits.

use crate::scene::text::{keyword, words};
use crate::shape::Mesh;
use crate::shape::mesh::as_dvec3;
use crate::shape::offset;
use glam::DVec3;

/// Returns all vertices of a text in `f64` if the triangles of the mesh lie far from the origin, where
/// `f32` would show steps. `mesh` is the mesh read from the text, with all vertices.
pub(super) fn positions(text: &str, mesh: &Mesh) -> Option<Vec<DVec3>> {
    let used = mesh.triangles.iter().flat_map(|triangle| triangle.position);
    let places = used.map(|index| as_dvec3(mesh.positions[index as usize]));
    let [low, high] = places.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], at| {
        [low.min(at), high.max(at)]
    });
    if !offset::is_far((high - low).max_element(), low.abs().max(high.abs()).max_element()) {
        return None;
    }
    let vertices = text.lines().map(keyword).filter(|(keyword, _)| *keyword == "v");
    let position = |(_, rest)| {
        let mut numbers = words(rest).map(|word| word.parse().unwrap_or(f64::NAN));
        let mut next = || numbers.next().unwrap_or(f64::NAN);
        DVec3::new(next(), next(), next())
    };
    Some(vertices.map(position).collect())
}

/// Gives a mesh these positions, which are those of all its vertices, and the offset that they need.
pub(super) fn set(mesh: &mut Mesh, positions: &[DVec3]) {
    let used = mesh.triangles.iter().flat_map(|triangle| triangle.position);
    mesh.offset = offset::of(used.map(|index| positions[index as usize]));
    mesh.positions = positions.iter().map(|&at| (at - mesh.offset).as_vec3().to_array()).collect();
}

#[cfg(test)]
mod tests {
    use crate::scene::obj::read;
    use glam::DVec3;

    #[test]
    fn a_mesh_in_metres_of_a_national_grid_keeps_its_millimetres() {
        let vertex = |k: usize| {
            let part = (0.3 * k as f64).sin_cos();
            DVec3::new(512_340.5 + part.0, 45.0 + 0.1 * k as f64, 5_843_210.25 + part.1)
        };
        let line = |k| {
            let DVec3 { x, y, z } = vertex(k);
            format!("v {x:.4} {y:.4} {z:.4}\n")
        };
        // A vertex that no face uses changes nothing.
        let lines: String = (0..9).map(line).collect();
        let text = format!("v 0 0 0\n{lines}f 2 3 4 5\nf 5 6 7\nf 8 9 10\n");
        let mesh = read("a.obj", text.as_bytes()).unwrap();
        assert_eq!(mesh.positions.len(), 9);
        for (triangle, first) in [(2, 3), (3, 6)] {
            for (found, k) in mesh.places(triangle).into_iter().zip(first..) {
                assert!(found.distance(vertex(k)) < 1e-4, "{found} {}", vertex(k));
            }
        }
        let near = read("a.obj", b"v 1 2 3\nv 1 3 3\nv 2 2 3\nf 1 2 3\n").unwrap();
        assert_eq!(near.offset, DVec3::ZERO);
    }
}
