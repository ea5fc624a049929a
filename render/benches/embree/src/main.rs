//! Compares the rays of `render` with those of Embree on one thread, and counts leaks.
//!
//! ```text
//! cargo run --release --manifest-path render/benches/embree/Cargo.toml -- LIBRARY [ROUNDS] [SIDE] [RAYS]
//! ```
//!
//! `LIBRARY` is a shared library of Embree 4.4, for example `libembree4.so.4`. Each round times all
//! candidates on the same rays, one after the other, in batches. The processor time of the fastest
//! round of each batch counts, so that other work on the machine has little influence. `SIDE` is the
//! side of the picture in pixels. `RAYS` is the number of rays of the leak count.
//!
//! Our rays are in `f64` and their hits are complete in `f64`. Embree's are in `f32`.

mod embree;
#[path = "../../../tests/leaks/mod.rs"]
mod leaks;
mod meshes;
mod sets;

use cpu_time::ThreadTime;
use embree::{Embree, EmbreeScene};
use leaks::surfaces;
use render::accel::{Accel, Structure};
use render::ray::Ray;
use render::shape::Shape;
use render::shape::mesh::Mesh;
use sets::Rays;
use std::error::Error;
use std::hint::black_box;
use std::path::Path;

/// Number of rays that are timed together.
const BATCH: usize = 4096;

/// Number of rays of a group.
const GROUP: usize = 64;

/// One candidate on one set of rays: the shortest time of each batch, in seconds.
struct Best(Vec<f64>);

impl Best {
    fn new(rays: usize) -> Self {
        Self(vec![f64::INFINITY; rays.div_ceil(BATCH)])
    }

    fn time<T>(&mut self, rays: &[T], mut trace: impl FnMut(&[T])) {
        for (batch, best) in rays.chunks(BATCH).zip(&mut self.0) {
            let started = ThreadTime::now();
            trace(batch);
            *best = best.min(started.elapsed().as_secs_f64());
        }
    }

    /// Million rays per second.
    fn rate(&self, rays: usize) -> f64 {
        1e-6 * rays as f64 / self.0.iter().sum::<f64>()
    }
}

fn ours(accel: &Accel<'_>, shadow: bool, rays: &[(Ray, f64)]) {
    for (ray, end) in rays {
        if shadow {
            black_box(accel.any(ray, *end, |_| true));
        } else {
            black_box(accel.closest(ray, *end));
        }
    }
}

fn theirs(scene: &EmbreeScene, shadow: bool, rays: &[embree::RtcRay]) {
    for ray in rays {
        if shadow {
            black_box(scene.any(ray));
        } else {
            black_box(scene.closest(ray));
        }
    }
}

/// Counts the rays for which one library finds a hit and the other does not.
fn differences(accel: &Accel<'_>, scene: &EmbreeScene, rays: &Rays) -> usize {
    let hits = rays.ours.iter().zip(&rays.embree);
    hits.filter(|((ray, end), own)| {
        accel.closest(ray, *end).is_some() != (scene.closest(own).1 != embree::NONE)
    })
    .count()
}

/// The ratios of all cells.
#[derive(Default)]
struct Ratios {
    closest: Vec<f64>,
    shadow: Vec<f64>,
    group: Vec<f64>,
}

fn compare(
    embree: &Embree,
    name: &str,
    mesh: Mesh,
    rounds: usize,
    side: u32,
    ratios: &mut Ratios,
) -> Result<(), Box<dyn Error>> {
    let mesh = meshes::with_floor(mesh);
    let corners: Vec<[u32; 3]> = mesh.triangles.iter().map(|t| t.position).collect();
    let count = corners.len();
    let positions = mesh.positions.clone();
    let shape = Shape::Mesh(mesh);
    let mut build = [f64::INFINITY; 2];
    for _ in 0..3 {
        let started = ThreadTime::now();
        embree.free(embree.build(&positions, &corners, true)?)?;
        build[0] = build[0].min(started.elapsed().as_secs_f64());
        let started = std::time::Instant::now();
        black_box(Accel::build(vec![&shape], Structure::Bvh));
        build[1] = build[1].min(started.elapsed().as_secs_f64());
    }
    let accel = Accel::build(vec![&shape], Structure::Bvh);
    let robust = embree.build(&positions, &corners, true)?;
    let fast = embree.build(&positions, &corners, false)?;
    println!(
        "{name}: {count} triangles; bytes for each: ours {:.1}, Embree {:.1}; build: ours {:.4} s (two \
         threads), Embree {:.4} s (one thread)",
        accel.bytes() as f64 / count as f64,
        robust.bytes as f64 / count as f64,
        build[1],
        build[0],
    );
    let sets = sets::sets(&accel, side);
    for (kind, rays) in sets.iter().enumerate() {
        let shadow = kind == 2;
        let mut best = [0; 3].map(|_| Best::new(rays.ours.len()));
        for _ in 0..rounds {
            best[0].time(&rays.ours, |batch| ours(&accel, shadow, batch));
            best[1].time(&rays.embree, |batch| theirs(&robust, shadow, batch));
            best[2].time(&rays.embree, |batch| theirs(&fast, shadow, batch));
        }
        let [own, robust_rate, fast_rate] = best.map(|best| best.rate(rays.ours.len()));
        let ratio = own / robust_rate;
        if shadow { &mut ratios.shadow } else { &mut ratios.closest }.push(ratio);
        println!(
            "{name} {}: ours {own:.2}, Embree robust {robust_rate:.2} ({ratio:.3}), default \
             {fast_rate:.2} ({:.3}); {} of {} rays differ",
            sets::NAMES[kind],
            own / fast_rate,
            differences(&accel, &robust, rays),
            rays.ours.len(),
        );
    }
    let rays = sets::sub_pixels(side);
    let mut best = [0; 3].map(|_| Best::new(rays.ours.len()));
    let mut hits = vec![None; GROUP];
    for _ in 0..rounds {
        best[0].time(&rays.ours, |batch| {
            for group in batch.chunks(GROUP) {
                accel.closest_of(group, &mut hits[..group.len()]);
                black_box(&hits);
            }
        });
        best[1].time(&rays.embree, |batch| theirs(&robust, false, batch));
        best[2].time(&rays.ours, |batch| ours(&accel, false, batch));
    }
    let [group, single, own] = best.map(|best| best.rate(rays.ours.len()));
    ratios.group.push(group / single);
    println!(
        "{name} groups: ours {group:.2} (single {own:.2}), Embree robust single {single:.2} ({:.3})",
        group / single
    );
    embree.free(robust)?;
    embree.free(fast)
}

fn geometric_mean(ratios: &[f64]) -> f64 {
    (ratios.iter().map(|ratio| ratio.ln()).sum::<f64>() / ratios.len() as f64).exp()
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let library = words.next().ok_or("expected the path of a shared Embree library")?;
    let mut number = |other: u64| words.next().map_or(Ok(other), |word| word.parse());
    let (rounds, side, rays) = (number(5)?, number(512)?, number(1_000_000)?);
    let embree = Embree::load(Path::new(&library))?;
    println!("Embree {}; {rounds} rounds; million rays per second, one thread", embree.version()?);
    let mut ratios = Ratios::default();
    for (rows, cols) in [(125, 40), (400, 125), (1250, 400)] {
        let meshes = [
            ("tube", surfaces::tube(rows, cols, glam::DVec3::ZERO).mesh),
            ("klein", meshes::klein(rows, cols).mesh),
        ];
        for (name, mesh) in meshes {
            let name = format!("{name} {}", 2 * rows * cols);
            compare(&embree, &name, mesh, rounds as usize, side as u32, &mut ratios)?;
        }
    }
    let mut leaks = 0;
    for (name, count, own) in leaks::leaks(rays) {
        println!("{name}: {own} of {count} aimed rays leak");
        leaks += own;
    }
    println!(
        "geomean closest {:.3} shadow {:.3} group {:.3} leaks {leaks}",
        geometric_mean(&ratios.closest),
        geometric_mean(&ratios.shadow),
        geometric_mean(&ratios.group),
    );
    Ok(())
}
