//! Rays from inside closed meshes, aimed at vertices and at points of edges. The comparison with Embree
//! (`render/benches/embree/`) uses the same rays and surfaces.

pub mod surfaces;

use glam::DVec3;
use rayon::prelude::*;
use render::accel::{Accel, Structure};
use render::ray::Ray;
use render::shape::Shape;
use render::shape::mesh::Mesh;
use std::f64::consts::TAU;
use surfaces::{Surface, middle_line};

/// A number in [0, 1) that depends on `k` only.
pub fn hash(k: u64) -> f64 {
    let mut x = k.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((x ^ (x >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

/// A closed mesh and the starts of rays inside of it.
struct Set {
    name: &'static str,
    mesh: Mesh,
    /// Returns the start of ray `k`, and a vertex that the start sees, or `None` for any vertex.
    start: Box<dyn Fn(u64) -> (DVec3, Option<u32>) + Sync>,
}

fn of_tube(name: &'static str, surface: Surface, shift: DVec3) -> Set {
    let Surface { mesh, rows, cols } = surface;
    let start = move |k: u64| {
        let pick = |what: u64, of: u32| (hash(8 * k + what) * f64::from(of)) as u32;
        let row = pick(0, rows);
        let jitter = DVec3::new(hash(8 * k + 1), hash(8 * k + 2), hash(8 * k + 3)) - 0.5;
        let middle = middle_line(TAU * f64::from(row) / f64::from(rows));
        let start = (shift + middle + 0.2 * jitter).as_vec3().as_dvec3();
        let ring = (row + rows + pick(4, 3) - 1) % rows;
        (start, Some(ring * cols + pick(5, cols)))
    };
    Set { name, mesh, start: Box::new(start) }
}

fn sets() -> Vec<Set> {
    let far = DVec3::new(300.0, -200.0, 100.0);
    let lattice = |k: u64| {
        let place = [0, 1, 2].map(|axis| (hash(8 * k + axis) * 31.0).floor() - 15.0);
        (DVec3::from(place), None)
    };
    let thin = |k: u64| (DVec3::new(0.0, 0.0, hash(8 * k) - 0.5), None);
    vec![
        of_tube("tube 10k", surfaces::tube(125, 40, DVec3::ZERO), DVec3::ZERO),
        of_tube("tube 100k", surfaces::tube(400, 125, DVec3::ZERO), DVec3::ZERO),
        of_tube("tube 100k, 370 units away", surfaces::tube(400, 125, far), far),
        Set { name: "lattice cube", mesh: surfaces::lattice_cube(16), start: Box::new(lattice) },
        Set { name: "needles", mesh: surfaces::spindle(48), start: Box::new(thin) },
    ]
}

/// Returns the aimed ray `k`: half of them aim at vertices, half at points of edges, and those of the
/// lattice also run along axes.
fn aimed(set: &Set, around: &[Vec<u32>], k: u64) -> Ray {
    let corner = |vertex: u32| DVec3::from(set.mesh.positions[vertex as usize].map(f64::from));
    let (start, vertex) = (set.start)(k);
    let any = (hash(8 * k + 6) * set.mesh.positions.len() as f64) as u32;
    let vertex = vertex.unwrap_or(any);
    let neighbours = &around[vertex as usize];
    let other = neighbours[(hash(8 * k + 7) * neighbours.len() as f64) as usize];
    let part = if k.is_multiple_of(2) { 0.0 } else { hash(k.wrapping_mul(31) + 5) };
    let target = corner(vertex) + part * (corner(other) - corner(vertex));
    let mut direction = target - start;
    if set.name == "lattice cube" && k % 4 >= 2 {
        let axis = (k / 4 % 3) as usize;
        let along = if (k / 12).is_multiple_of(2) { 1.0 } else { -1.0 };
        direction = DVec3::AXES[axis] * along;
    }
    Ray::from_eye(start, direction.normalize())
}

/// Returns for each set its name, the number of rays, and the number of rays that leave the mesh.
/// All sets together have about `count` rays.
pub fn leaks(count: u64) -> Vec<(&'static str, u64, u64)> {
    let sets = sets();
    let each = count.div_ceil(sets.len() as u64);
    let leaks = sets.into_iter().map(|set| {
        let mut around = vec![Vec::new(); set.mesh.positions.len()];
        for triangle in &set.mesh.triangles {
            let [a, b, c] = triangle.position;
            for (from, to) in [(a, b), (b, c), (c, a)] {
                around[from as usize].push(to);
            }
        }
        let shape = Shape::Mesh(set.mesh.clone());
        let accel = Accel::build(vec![&shape], Structure::Bvh);
        let leaks = (0..each)
            .into_par_iter()
            .filter(|&k| accel.closest(&aimed(&set, &around, k), f64::INFINITY).is_none())
            .count();
        (set.name, each, leaks as u64)
    });
    leaks.collect()
}

#[test]
fn of_a_million_aimed_rays_none_leaks() {
    for (name, count, leaks) in leaks(1_000_000) {
        assert_eq!(leaks, 0, "of {count} rays inside the {name}");
    }
}
