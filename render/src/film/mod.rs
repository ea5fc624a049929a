//! Makes the picture: tiles of rows of trees, shaded and averaged into pixels.
//!
//! A tile traces its samples row by row. With a filter that looks at areas it keeps three rows and
//! shades the middle one, and traces one sample more on each side than it shades (a halo): so each
//! tile has all it needs, and the picture does not depend on how it is cut or on who works on it.

pub mod encode;
pub mod picture;

pub use picture::Picture;

use crate::accel::Accel;
use crate::color::Color;
use crate::filter::{Filter, FilteredTexture};
use crate::footprint::neighbours::Neighbourhood;
use crate::scene::Scene;
use crate::shade::{ShadeCounts, Shader};
use crate::shape::Shape;
use crate::stats::Stats;
use crate::trace::rows::RowWindow;
use crate::trace::tree::IntersectionTree;
use crate::trace::{RayCounts, Tracer};
use glam::DVec2;
use rayon::prelude::*;
use std::time::Instant;

/// Samples along the side of a tile.
///
/// Smaller, and the halo of two samples a row is a larger part of the work (6 % of the rays at 64);
/// larger, and the last tiles leave cores idle.
const TILE_SAMPLES: u32 = 64;

/// What is asked of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Settings {
    /// Pixels across, at least 1.
    pub width: u32,
    /// Pixels down, at least 1.
    pub height: u32,
    /// Rays along each side of a pixel, at least 1: `samples * samples` rays in each pixel, on a
    /// regular grid, with equal weights.
    pub samples: u32,
    /// How textures are averaged.
    pub filter: Filter,
}

/// Pixels of one picture at most: 3 GB of them, and as much again while tiles come together.
const MOST_PIXELS: u64 = 1 << 28;

/// Reads a size in pixels, such as `640x480`.
///
/// # Errors
/// When the text is not two numbers from 1 to 65536 with an `x` between them, or asks for more
/// pixels than memory should be expected to hold.
pub fn size(text: &str) -> Result<(u32, u32), String> {
    let side = |text: &str| text.parse().ok().filter(|side| (1..=65536).contains(side));
    let (width, height): (u32, u32) = text
        .split_once(['x', 'X'])
        .and_then(|(width, height)| Some((side(width)?, side(height)?)))
        .ok_or("expected WIDTHxHEIGHT in pixels, each 1 to 65536")?;
    if u64::from(width) * u64::from(height) > MOST_PIXELS {
        return Err(format!("expected at most {MOST_PIXELS} pixels in all"));
    }
    Ok((width, height))
}

/// Renders a scene. `progress` is told after each tile how many of how many are done.
///
/// Runs on the threads of the current rayon pool; the result is the same for any number of them.
pub fn render(
    scene: &Scene,
    settings: &Settings,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> (Picture, Stats) {
    let started = Instant::now();
    let accel = Accel::build(scene.objects.iter().map(|object| &object.shape).collect());
    let accel_time = started.elapsed();

    let started = Instant::now();
    let shader = ready_shader(scene, &accel, settings.filter);
    let table_time = started.elapsed();

    let started = Instant::now();
    let exposure = Exposure {
        tracer: Tracer { scene, accel: &accel },
        halo: settings.filter.wants_area() && shader.textures.iter().any(Option::is_some),
        shader,
        settings: *settings,
    };
    let tiles = exposure.tiles();
    let done = std::sync::atomic::AtomicUsize::new(0);
    let exposed: Vec<Exposed> = tiles
        .par_iter()
        .map(|tile| {
            let exposed = exposure.expose(tile);
            let done = 1 + done.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
            progress(done, tiles.len());
            exposed
        })
        .collect();
    let mut picture = Picture::black(settings.width, settings.height);
    let mut stats = Stats { accel_time, table_time, ..Stats::default() };
    for (tile, exposed) in tiles.iter().zip(&exposed) {
        picture.place(tile.x, tile.y, tile.width, &exposed.pixels);
        stats.add(&exposed.rays, &exposed.shading);
    }
    stats.tables = exposure.shader.tables();
    stats.table_bytes = exposure.shader.table_bytes();
    stats.not_finite = picture.remove_not_finite();
    stats.picture_time = started.elapsed();
    (picture, stats)
}

/// Prepares the textures that surfaces show, and no others.
fn ready_shader<'a>(scene: &'a Scene, accel: &'a Accel<'a>, filter: Filter) -> Shader<'a> {
    let mut shown = vec![false; scene.textures.len()];
    for surface in scene.objects.iter().flat_map(|object| &object.parts) {
        if let Some(texture) = surface.texture
            && scene.materials[surface.material].shows_color()
        {
            shown[texture] = true;
        }
    }
    let textures = scene
        .textures
        .par_iter()
        .zip(&shown)
        .map(|(texture, &shown)| shown.then(|| FilteredTexture::new(texture, filter)))
        .collect();
    let seams = scene
        .objects
        .iter()
        .map(|object| match &object.shape {
            // Only neighbours that are averaged need to be unwrapped.
            _ if !filter.wants_area() || object.parts.iter().all(|part| part.texture.is_none()) => {
                DVec2::ZERO
            }
            Shape::Sphere(sphere) => sphere.seam(),
            Shape::Quad(_) => DVec2::ZERO,
            Shape::Mesh(mesh) => mesh.seam(),
        })
        .collect();
    Shader { scene, accel, textures, seams }
}

/// All that the tiles share.
struct Exposure<'a> {
    tracer: Tracer<'a>,
    shader: Shader<'a>,
    settings: Settings,
    /// Whether neighbours are looked at.
    halo: bool,
}

/// A rectangle of pixels.
struct Tile {
    x: u32,
    y: u32,
    width: u32,
    height: u32,
}

/// What came of a tile.
struct Exposed {
    /// Row by row.
    pixels: Vec<Color>,
    rays: RayCounts,
    shading: ShadeCounts,
}

impl Exposure<'_> {
    fn tiles(&self) -> Vec<Tile> {
        let Settings { width, height, samples, .. } = self.settings;
        let side = (TILE_SAMPLES / samples).max(1);
        let columns = (0..width).step_by(side as usize);
        let rows = (0..height).step_by(side as usize);
        rows.flat_map(|y| columns.clone().map(move |x| (x, y)))
            .map(|(x, y)| Tile { x, y, width: side.min(width - x), height: side.min(height - y) })
            .collect()
    }

    fn expose(&self, tile: &Tile) -> Exposed {
        let samples = i64::from(self.settings.samples);
        let mut exposed = Exposed {
            pixels: vec![Color::ZERO; (tile.width * tile.height) as usize],
            rays: RayCounts::default(),
            shading: ShadeCounts::default(),
        };
        // Sample coordinates: `samples` to a pixel, over the whole picture.
        let columns = i64::from(tile.x) * samples..i64::from(tile.x + tile.width) * samples;
        let rows = i64::from(tile.y) * samples..i64::from(tile.y + tile.height) * samples;
        let mut add = |x: i64, y: i64, color: Color| {
            let (column, row) = ((x - columns.start) / samples, (y - rows.start) / samples);
            exposed.pixels[row as usize * tile.width as usize + column as usize] += color;
        };
        if self.halo {
            let mut window = RowWindow::new((columns.end - columns.start) as usize + 2);
            for y in rows.start - 1..=rows.end {
                for (tree, x) in window.advance().iter_mut().zip(columns.start - 1..) {
                    self.trace(x, y, tree, &mut exposed.rays);
                }
                // The first two rows only fill the window.
                if y > rows.start {
                    for (k, x) in columns.clone().enumerate() {
                        let around = Neighbourhood::of(window.around(k + 1));
                        add(x, y - 1, self.shader.shade(&around, &mut exposed.shading));
                    }
                }
            }
        } else {
            let mut tree = IntersectionTree::default();
            for y in rows.clone() {
                for x in columns.clone() {
                    self.trace(x, y, &mut tree, &mut exposed.rays);
                    let around = Neighbourhood::alone(&tree);
                    add(x, y, self.shader.shade(&around, &mut exposed.shading));
                }
            }
        }
        let weight = 1.0 / (samples * samples) as f64;
        exposed.pixels.iter_mut().for_each(|pixel| *pixel *= weight);
        exposed
    }

    /// Traces the ray through the middle of a sample.
    fn trace(&self, x: i64, y: i64, tree: &mut IntersectionTree, rays: &mut RayCounts) {
        let Settings { width, height, samples, .. } = self.settings;
        let place = (DVec2::new(x as f64, y as f64) + 0.5) / f64::from(samples);
        let size = DVec2::new(f64::from(width), f64::from(height));
        self.tracer.trace(&self.tracer.scene.camera.ray(place, size), tree, rays);
    }
}
