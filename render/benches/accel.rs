//! Measures how fast a tree, the grids and brute force find hits.
//!
//! Run it with `cargo bench -p topobook-render --bench accel`. The scene is a torus of about 10 000 or about
//! 100 000 triangles over a floor, which stands apart. Each round times all structures on the same
//! rays, one after the other, on one thread and in small batches. The fastest round of each batch
//! counts, so that other work on the machine has little influence. docs/acceleration.md has a run.
//!
//! The number of rounds and the side of the picture in pixels may follow: `-- 9 512`.

use glam::{DVec2, DVec3};
use render::accel::{Accel, Structure};
use render::ray::Ray;
use render::shape::mesh::{Mesh, NONE, Triangle};
use render::shape::{Quad, Shape};
use std::error::Error;
use std::f64::consts::TAU;
use std::hint::black_box;
use std::io::Write;
use std::time::Instant;

const STRUCTURES: [(&str, Structure); 3] =
    [("bvh", Structure::Bvh), ("grid", Structure::Grid), ("none", Structure::None)];

/// Number of rays that are timed together.
const FEW: usize = 509;

/// Creates a torus about y whose circles have `rows` and `cols` points, slightly lumpy.
fn torus(rows: u32, cols: u32) -> Mesh {
    let at = |r: u32, c: u32| (r % rows) * cols + c % cols;
    let cells: Vec<(u32, u32)> = (0..rows).flat_map(|r| (0..cols).map(move |c| (r, c))).collect();
    let positions = cells.iter().map(|&(r, c)| {
        let (v, u) = (TAU * f64::from(r) / f64::from(rows), TAU * f64::from(c) / f64::from(cols));
        let tube = 0.4 + 0.05 * (5.0 * v).sin();
        let out = 1.0 + tube * u.cos();
        [out * v.cos(), tube * u.sin() + 0.2 * (3.0 * v).sin(), out * v.sin()].map(|x| x as f32)
    });
    let triangles = cells.iter().flat_map(|&(r, c)| {
        let [a, b, d, e] = [at(r, c), at(r + 1, c), at(r, c + 1), at(r + 1, c + 1)];
        [[a, b, e], [a, e, d]].map(|position| Triangle {
            position,
            uv: [NONE; 3],
            normal: [NONE; 3],
            surface: 0,
        })
    });
    Mesh {
        positions: positions.collect(),
        triangles: triangles.collect(),
        surfaces: vec![String::new()],
        ..Mesh::default()
    }
}

/// Returns rays from the eye through every pixel, rays mirrored at their hits, and rays from the
/// hits to a light. Each ray has the distance at which it ends.
fn rays(accel: &Accel<'_>, side: u32) -> [Vec<(Ray, f64)>; 3] {
    let (eye, light) = (DVec3::new(1.2, 2.0, 3.0), DVec3::new(-2.0, 5.0, 2.0));
    let forward = -eye.normalize();
    let right = forward.cross(DVec3::Y).normalize();
    let up = right.cross(forward);
    let mut sets = [Vec::new(), Vec::new(), Vec::new()];
    for y in 0..side {
        for x in 0..side {
            let place = |k: u32| (f64::from(k) + 0.5) / f64::from(side) - 0.5;
            let direction = (forward + 0.9 * (place(x) * right - place(y) * up)).normalize();
            let ray = Ray::from_eye(eye, direction);
            sets[0].push((ray, f64::INFINITY));
            if let Some(hit) = accel.closest(&ray, f64::INFINITY) {
                let point = accel.surface_point(&ray, &hit);
                let normal = point.geometric_normal;
                let mirrored = direction - 2.0 * direction.dot(normal) * normal;
                sets[1].push((Ray::leaving(hit.piece, point.position, mirrored), f64::INFINITY));
                let toward = light - point.position;
                sets[2].push((
                    Ray::leaving(hit.piece, point.position, toward.normalize()),
                    toward.length(),
                ));
            }
        }
    }
    sets
}

/// Times each batch of rays and keeps in `best` the shortest time per ray, in seconds. Brute force
/// traces one ray of each batch.
fn time(accel: &Accel<'_>, rays: &[(Ray, f64)], brute: bool, best: &mut Vec<f64>) {
    best.resize(rays.len().div_ceil(FEW), f64::INFINITY);
    for (few, best) in rays.chunks(FEW).zip(best) {
        let few = if brute { &few[..1] } else { few };
        let started = Instant::now();
        for (ray, t_max) in few {
            if t_max.is_finite() {
                accel.any(ray, *t_max, |hit| {
                    black_box(hit);
                    true
                });
            } else {
                black_box(accel.closest(ray, f64::INFINITY));
            }
        }
        *best = best.min(started.elapsed().as_secs_f64() / few.len() as f64);
    }
}

/// Counts the rays that start inside the tube, aim at vertices and points of edges, and get out.
fn leaks(accel: &Accel<'_>, mesh: &Mesh, rows: u32, count: usize) -> usize {
    let corner = |k: u32| DVec3::from(mesh.positions[k as usize].map(f64::from));
    let aimed = (0..count).map(|k| {
        let triangle = &mesh.triangles[k * 7919 % mesh.triangles.len()];
        let [a, b, _] = triangle.position.map(corner);
        let part = if k % 2 == 0 { 0.0 } else { (k as f64 * 0.618_034).fract() };
        let v = TAU * f64::from(triangle.position[0] / (mesh.positions.len() as u32 / rows))
            / f64::from(rows);
        let eye = DVec3::new(v.cos(), 0.2 * (3.0 * v).sin(), v.sin()) + 0.01 * (k as f64).sin();
        Ray::from_eye(eye, (a + part * (b - a) - eye).normalize())
    });
    aimed.filter(|ray| accel.closest(ray, f64::INFINITY).is_none()).count()
}

/// Returns the speed in millions of rays per second.
fn rate(seconds: &[f64]) -> f64 {
    1e-6 * seconds.len() as f64 / seconds.iter().sum::<f64>()
}

fn main() -> Result<(), Box<dyn Error>> {
    // Cargo adds the argument --bench.
    let numbers: Vec<usize> = std::env::args().filter_map(|word| word.parse().ok()).collect();
    let rounds = numbers.first().copied().unwrap_or(7);
    let side = numbers.get(1).copied().unwrap_or(256) as u32;
    let mut out = std::io::stdout().lock();
    for (rows, cols) in [(100, 50), (320, 160)] {
        let mesh = torus(rows, cols);
        let floor = Quad::new(
            DVec3::new(-30.0, -0.8, -30.0),
            DVec3::new(0.0, 0.0, 60.0),
            DVec3::new(60.0, 0.0, 0.0),
            DVec2::ONE,
            false,
        )
        .ok_or("a floor has an area")?;
        let shapes = [Shape::Mesh(mesh.clone()), Shape::Quad(floor)];
        let build = |structure| Accel::build(shapes.iter().collect(), structure);
        let accels = STRUCTURES.map(|(_, structure)| build(structure));
        let sets = rays(&accels[0], side);
        // Times by structure and kind of ray.
        let mut best: [[Vec<f64>; 3]; 3] = Default::default();
        let mut build_time = [f64::INFINITY; 3];
        for _ in 0..rounds {
            for (kind, set) in sets.iter().enumerate() {
                for (k, accel) in accels.iter().enumerate() {
                    time(accel, set, k == 2, &mut best[k][kind]);
                }
            }
            for (k, (_, structure)) in STRUCTURES.iter().enumerate() {
                let started = Instant::now();
                black_box(build(*structure));
                build_time[k] = build_time[k].min(started.elapsed().as_secs_f64());
            }
        }
        let triangles = mesh.triangles.len();
        writeln!(
            out,
            "{triangles} triangles, million rays a second (beside bvh), {rounds} rounds"
        )?;
        writeln!(out, "| | build ms | bytes each | from the eye | mirrored | to a light |")?;
        for (k, (name, _)) in STRUCTURES.iter().enumerate() {
            write!(out, "| {name} | {:.1} ", 1e3 * build_time[k])?;
            write!(out, "| {:.0} ", accels[k].bytes() as f64 / triangles as f64)?;
            for (own, tree) in best[k].iter().zip(&best[0]) {
                write!(out, "| {:.4} ({:.4}) ", rate(own), rate(own) / rate(tree))?;
            }
            writeln!(out, "|")?;
        }
        if let Some([cells, filled, listed]) = accels[1].cells() {
            let [part, mean] = [filled as f64 / cells as f64, listed as f64 / filled as f64];
            writeln!(out, "{cells} voxels, {part:.3} of them list {mean:.2} triangles on average")?;
        }
        let count = 300_000;
        let [tree, grid] = [0, 1].map(|k| leaks(&accels[k], &mesh, rows, count));
        writeln!(
            out,
            "of {count} rays aimed at vertices and edges {tree} leak (bvh), {grid} (grid)\n"
        )?;
    }
    Ok(())
}
