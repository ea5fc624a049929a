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
use crate::trace::volume::Volumes;
use crate::trace::{RayCounts, Tracer};
use glam::DVec2;
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};
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

/// Pixels of one picture at most: 3 GB of them.
const MOST_PIXELS: u64 = 1 << 28;

/// Rays along each side of a pixel at most: more would show in no 16-bit file.
pub const MOST_SAMPLES: u32 = 256;

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
    render_in_tiles(scene, settings, TILE_SAMPLES, progress)
}

fn render_in_tiles(
    scene: &Scene,
    settings: &Settings,
    tile_samples: u32,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> (Picture, Stats) {
    let started = Instant::now();
    let accel = Accel::build(scene.objects.iter().map(|object| &object.shape).collect());
    let accel_time = started.elapsed();

    let started = Instant::now();
    let volumes = Volumes::of(scene);
    let shader = ready_shader(scene, &accel, &volumes, settings.filter);
    let table_time = started.elapsed();

    let started = Instant::now();
    let exposure = Exposure {
        tracer: Tracer::new(scene, &accel, &volumes),
        halo: settings.filter.wants_area() && shader.textures.iter().any(Option::is_some),
        shader,
        settings: *settings,
    };
    let tiles = exposure.tiles(tile_samples);
    let film = Mutex::new(Film {
        picture: Picture::black(settings.width, settings.height),
        stats: Stats { accel_time, table_time, ..Stats::default() },
        done: 0,
    });
    tiles.par_iter().for_each(|tile| {
        let exposed = exposure.expose(tile);
        let done = film.lock().unwrap_or_else(PoisonError::into_inner).take(tile, &exposed);
        progress(done, tiles.len());
    });
    let Film { mut picture, mut stats, .. } =
        film.into_inner().unwrap_or_else(PoisonError::into_inner);
    stats.tables = exposure.shader.tables();
    stats.table_bytes = exposure.shader.table_bytes();
    stats.not_finite = picture.remove_not_finite();
    stats.picture_time = started.elapsed();
    (picture, stats)
}

/// Prepares the textures that surfaces show, and no others.
fn ready_shader<'a>(
    scene: &'a Scene,
    accel: &'a Accel<'a>,
    volumes: &'a Volumes,
    filter: Filter,
) -> Shader<'a> {
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
    let around_lights = volumes.around_lights(scene, accel);
    Shader { scene, accel, textures, seams, volumes, around_lights }
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

/// Where tiles come together, in any order: they do not overlap, and counts are whole numbers.
struct Film {
    picture: Picture,
    stats: Stats,
    /// Tiles that are there.
    done: usize,
}

impl Film {
    /// Puts a tile in its place and says how many there are now.
    fn take(&mut self, tile: &Tile, exposed: &Exposed) -> usize {
        self.picture.place(tile.x, tile.y, tile.width, &exposed.pixels);
        self.stats.add(&exposed.rays, &exposed.shading);
        self.done += 1;
        self.done
    }
}

impl Exposure<'_> {
    fn tiles(&self, tile_samples: u32) -> Vec<Tile> {
        let Settings { width, height, samples, .. } = self.settings;
        let side = (tile_samples / samples).max(1);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Camera, Light, Material, Object, PointLight, Surface};
    use crate::shape::{Quad, Sphere};
    use crate::texture::{Texture, Wrap};
    use glam::{DAffine3, DVec3};

    /// A glass sphere on a textured floor.
    fn scene() -> Scene {
        let texels = (0..64u16).map(|k| [k * 1000, 60000 - k * 900, (k % 8) * 8000]).collect();
        let texture = Texture { width: 8, height: 8, wrap: Wrap::Repeat, texels, white: u16::MAX };
        let plain = Material { diffuse: 0.5, ..Material::default() };
        let glass = Material {
            ambient: 0.0,
            diffuse: 0.0,
            reflectivity: 1.0,
            transparency: 1.0,
            fresnel: true,
            ..Material::default()
        };
        let floor = Quad::new(DVec3::ZERO, DVec3::Z, DVec3::X, DVec2::ONE, false).unwrap();
        let ball = Sphere { center: DVec3::new(0.0, 1.2, 0.0), radius: 1.0 };
        let object = |shape, material, texture| Object {
            shape,
            parts: vec![Surface { material, texture }],
            to_own_space: DAffine3::IDENTITY,
        };
        let eye = DVec3::new(0.3, 1.5, 5.0);
        Scene {
            camera: Camera::new(eye, DVec3::Y, DVec3::Y, 0.7).unwrap(),
            background: Color::splat(0.2),
            ambient: Color::splat(0.5),
            lights: vec![Light::Point(PointLight {
                position: DVec3::new(3.0, 5.0, 4.0),
                color: Color::ONE,
                falloff: None,
            })],
            materials: vec![plain, glass],
            textures: vec![texture],
            objects: vec![
                object(Shape::Quad(floor), 0, Some(0)),
                object(Shape::Sphere(ball), 1, None),
            ],
            max_depth: 8,
            min_weight: 0.0,
        }
    }

    #[test]
    fn the_picture_does_not_depend_on_how_it_is_cut_into_tiles() {
        let scene = scene();
        for (filter, samples) in [(Filter::Tent, 1), (Filter::Box, 2), (Filter::Point, 2)] {
            let settings = Settings { width: 37, height: 29, samples, filter };
            let cut = |side| render_in_tiles(&scene, &settings, side, &|_, _| {}).0;
            let whole = cut(1000);
            for side in [1, 6, 16, 64] {
                assert!(cut(side) == whole, "{filter:?} in tiles of {side} samples");
            }
        }
    }

    #[test]
    fn rays_that_count_for_little_are_left_out() {
        let settings = Settings { width: 16, height: 16, samples: 1, filter: Filter::Point };
        let mut scene = scene();
        let (all, cost) = render(&scene, &settings, &|_, _| {});
        scene.min_weight = 1e-3;
        let (most, less) = render(&scene, &settings, &|_, _| {});
        assert!(less.refracted_rays < cost.refracted_rays);
        // A pixel lacks at most as many branches as it has surfaces on its way, 8 here.
        for (a, b) in all.pixels.iter().flatten().zip(most.pixels.iter().flatten()) {
            assert!((a - b).abs() <= 8e-3 && b <= a, "{a} {b}");
        }
    }

    #[test]
    fn sizes_are_two_numbers() {
        assert_eq!(size("640x480"), Ok((640, 480)));
        for bad in ["640", "0x9", "9x", "65537x1", "-1x4", "1x1x1"] {
            assert!(size(bad).unwrap_err().contains("WIDTHxHEIGHT"), "{bad}");
        }
        assert!(size("65536x65536").unwrap_err().contains("268435456 pixels"));
    }
}
