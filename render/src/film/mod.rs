//! Renders the picture: traces and shades tiles of samples and averages the samples into pixels.
//!
//! A tile of the thesis's lattice traces its samples row by row. With a filter that averages over
//! areas, it keeps three rows of trees and shades the middle one. It then also traces one sample
//! more on each side than it shades (a halo). Where pixels share samples, a tile shades the shared
//! samples of its neighbours too. Each tile is therefore complete by itself, and the picture does
//! not depend on the tiles or on the threads. `exposure.rs` is the interface for other methods.

pub mod alpha;
mod area;
mod base;
mod bytes;
pub mod command;
pub mod course;
pub mod crop;
pub mod encode;
mod exposure;
pub mod join;
mod lattice;
pub mod layer;
pub mod memory;
pub mod pattern;
pub mod picture;
mod points;
pub mod sampling;

pub use base::{BasePicture, Pixel, aperture};
pub use course::{Course, GoOn};
pub use crop::Crop;
pub use exposure::{Sample, Witness};
pub use layer::Layer;
pub use pattern::{Pattern, PatternName};
pub use picture::Picture;
pub use points::{PointWork, Points};
pub use sampling::{
    MOST_SAMPLES, PixelFilter, SPLITS, Sampling, SamplingMethod, Supersample, THRESHOLD,
};

use crate::accel::Structure;
use crate::filter::Filter;
use crate::prepared::Prepared;
use crate::scene::Camera;
use crate::shade::View;
use crate::stats::Stats;
use crate::trace::Tracer;
use exposure::{Exposure, Film};
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// Samples along the side of a tile.
///
/// A smaller tile makes the halo of two samples a row a larger part of the work (6 % of the rays at
/// 64). A larger tile leaves more cores idle while the last tiles are rendered.
const TILE_SAMPLES: u32 = 64;

/// The size, the sampling and the parts of a picture to render.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Pixels across, at least 1.
    pub width: u32,
    /// Pixels down, at least 1.
    pub height: u32,
    /// Number, position and weight of the rays of a pixel.
    pub sampling: Sampling,
    /// Filter that averages textures.
    pub filter: Filter,
    /// Part of the picture to render, within the picture; `None` renders all of it. The pixels of
    /// the part equal those of the whole picture to the last bit.
    pub crop: Option<Crop>,
    /// Layers to keep besides the colour, in this order.
    pub layers: Vec<Layer>,
    /// Structure that finds the hits.
    pub accel: Structure,
    /// Least weight of a ray in its cell that is worth following, [0, 1]; `None` leaves the choice to
    /// the sampling. The scene's own least weight holds in any case.
    pub least_weight: Option<f64>,
    /// The part of the light that the picture shows.
    pub view: View,
    /// Another camera than that of the scene. The data that a [`Prepared`] scene keeps do not depend on it.
    pub camera: Option<Camera>,
}

impl Settings {
    /// Settings with one ray in the middle of each pixel. `width` and `height` are in pixels, at
    /// least 1.
    #[must_use]
    pub fn new(width: u32, height: u32, filter: Filter) -> Self {
        let sampling = Sampling::regular(1);
        let accel = Structure::default();
        let (crop, layers, least_weight, view, camera) =
            (None, Vec::new(), None, View::Whole, None);
        Self { width, height, sampling, filter, crop, layers, accel, least_weight, view, camera }
    }

    /// Returns these settings with `samples * samples` rays in each pixel, evenly spread and of
    /// equal weight.
    #[must_use]
    pub fn with_samples(self, samples: u32) -> Self {
        Self { sampling: Sampling::regular(samples), ..self }
    }
}

/// Largest number of pixels in a picture; such a picture takes 3 GB.
const MOST_PIXELS: u64 = 1 << 28;

/// Reads a size in pixels, such as `640x480`: width, then height.
///
/// # Errors
/// If the text is not two numbers from 1 to 65536 with an `x` between them, or if they make more
/// than 2^28 pixels.
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

/// Renders a scene. Calls `progress` after each tile with the number of finished tiles and the
/// number of all tiles.
///
/// Builds the structures and tables that the settings need and `prepared` lacks, and keeps them in
/// `prepared`. The statistics count only what was built for this picture. Runs on the threads of
/// the current rayon pool. The picture is the same for any number of threads.
pub fn render(
    prepared: &Prepared<'_>,
    settings: &Settings,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> (Picture, Stats) {
    render_while(prepared, settings, &Course::told(progress))
}

/// Renders a scene as [`render`] does, and leaves out the tiles that follow once the course does not go on.
/// Their pixels are black, and [`Stats::unfinished`] is their number.
pub fn render_while(
    prepared: &Prepared<'_>,
    settings: &Settings,
    course: &Course<'_>,
) -> (Picture, Stats) {
    let under = Picture::of(settings);
    render_in_tiles(prepared, settings, (TILE_SAMPLES, under), course)
}

/// Renders a scene as [`render_while`] does, over a picture of the same size. Tiles that are left out
/// keep the pixels of that picture.
fn render_in_tiles(
    prepared: &Prepared<'_>,
    settings: &Settings,
    (tile_samples, under): (u32, Picture),
    course: &Course<'_>,
) -> (Picture, Stats) {
    with_exposure(prepared, settings, course.go_on, |exposure, stats| {
        let started = Instant::now();
        let crop = Crop::of(settings);
        let tiles = crop.tiles(exposure.tile_side(tile_samples));
        let film = Mutex::new(Film::new(crop, under, stats));
        // One tile per task. In longer runs, which one core takes as a whole, the last run would
        // leave the other cores idle.
        tiles.par_iter().with_max_len(1).filter(|_| (course.go_on)()).for_each(|tile| {
            let exposed = exposure.expose(tile, &mut ());
            // A tile that was left in the middle is not finished.
            if !(course.go_on)() {
                return;
            }
            course.show(tile, &exposed);
            let done = film.lock().unwrap_or_else(PoisonError::into_inner).take(tile, &exposed);
            (course.progress)(done, tiles.len());
        });
        let (mut picture, mut stats) =
            film.into_inner().unwrap_or_else(PoisonError::into_inner).developed();
        stats.not_finite = picture.remove_not_finite();
        stats.picture_time = started.elapsed();
        (picture, stats)
    })
}

/// Renders one pixel of a scene and reports all of its samples to a witness.
///
/// The pixel is exposed as a tile of its own, by the code that exposes all other tiles. Its colour
/// therefore equals that of the picture to the last bit. The pixel must lie in the picture.
pub fn expose_pixel<W: Witness>(
    prepared: &Prepared<'_>,
    settings: &Settings,
    (x, y): (u32, u32),
    witness: &mut W,
) -> Picture {
    with_exposure(prepared, settings, &|| true, |exposure, stats| {
        let tile = Crop { x, y, width: 1, height: 1 };
        let mut film = Film::new(tile, Picture::with_layers(1, 1, &settings.layers), stats);
        film.take(&tile, &exposure.expose(&tile, witness));
        film.picture.remove_not_finite();
        film.picture
    })
}

/// Takes the data that the tiles share from a prepared scene and starts the picture's statistics.
fn with_exposure<T>(
    prepared: &Prepared<'_>,
    settings: &Settings,
    go_on: &GoOn<'_>,
    work: impl FnOnce(&Exposure<'_>, Stats) -> T,
) -> T {
    let scene = prepared.scene();
    let (mut shader, built) = prepared.shader(settings.accel, settings.filter);
    shader.view = settings.view;
    let stats = Stats {
        structures: built.structures,
        accel_time: built.structure_time,
        accel_bytes: shader.accel.bytes() as u64,
        tables: built.tables,
        table_time: built.table_time,
        table_bytes: shader.table_bytes(),
        lattice_bytes: scene.procedural.lattice_bytes(),
        ..Stats::default()
    };
    let tracer = Tracer::new(scene, shader.accel, shader.volumes);
    let mut tracer = tracer.seen_by(settings.camera);
    let least = settings.least_weight.unwrap_or(settings.sampling.least_weight());
    tracer.min_weight = tracer.min_weight.max(least);
    work(&Exposure { tracer, shader, settings, go_on }, stats)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Color;
    use crate::procedural::Procedural;
    use crate::scene::{
        Background, Camera, Light, Material, Names, Object, PointLight, Scene, Surface,
        SurfaceTexture,
    };
    use crate::shape::{Quad, Shape, Sphere};
    use crate::texture::Texture;
    use glam::{DAffine3, DVec2, DVec3};

    /// A glass sphere on a textured floor.
    pub(super) fn scene() -> Scene {
        let texels = (0..64u16).map(|k| [k * 1000, 60000 - k * 900, (k % 8) * 8000]).collect();
        let texture =
            Texture { width: 8, height: 8, texels, white: u16::MAX, ..Texture::default() };
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
            background: Background::Uniform(Color::splat(0.2)),
            is_transparent: false,
            ambient: Color::splat(0.5),
            lights: vec![Light::Point(PointLight {
                position: DVec3::new(3.0, 5.0, 4.0),
                color: Color::ONE,
                falloff: None,
            })],
            materials: vec![plain, glass],
            textures: vec![texture],
            procedural: Procedural::default(),
            objects: vec![
                object(Shape::Quad(floor), 0, Some(SurfaceTexture::Picture(0))),
                object(Shape::Sphere(ball), 1, None),
            ],
            max_depth: 8,
            min_weight: 0.0,
            names: Names::default(),
            remarks: Vec::new(),
        }
    }

    #[test]
    fn the_picture_does_not_depend_on_how_it_is_cut_into_tiles() {
        let scene = scene();
        let prepared = Prepared::new(&scene);
        for settings in every_kind() {
            let cut = |side| {
                let under = Picture::of(&settings);
                render_in_tiles(&prepared, &settings, (side, under), &Course::told(&|_, _| {})).0
            };
            let whole = cut(1000);
            for side in [1, 10, 64] {
                assert!(cut(side) == whole, "{settings:?} in tiles of {side} samples");
            }
        }
    }

    #[test]
    fn a_crop_is_that_part_of_the_whole() {
        let scene = scene();
        for settings in every_kind() {
            let (whole, _) = render(&Prepared::new(&scene), &settings, &|_, _| {});
            for crop in [
                Crop { x: 0, y: 0, width: 1, height: 1 },
                Crop { x: 11, y: 7, width: 13, height: 9 },
                Crop { x: 36, y: 0, width: 1, height: 29 },
                Crop::whole(37, 29),
            ] {
                let settings = Settings { crop: Some(crop), ..settings.clone() };
                let (part, _) = render(&Prepared::new(&scene), &settings, &|_, _| {});
                assert!(part == cut_out(&whole, crop), "{settings:?}");
            }
        }
    }

    /// Cuts a rectangle out of a picture, with its layers.
    fn cut_out(whole: &Picture, crop: Crop) -> Picture {
        let mut part = Picture::black(crop.width, crop.height);
        let places =
            || crop.rows().flat_map(|y| crop.columns().map(move |x| (y * 37 + x) as usize));
        part.pixels = places().map(|k| whole.pixels[k]).collect();
        part.channels = whole.channels.clone();
        for channel in &mut part.channels {
            channel.values = places().map(|k| channel.values[k]).collect();
        }
        part
    }

    /// Settings of every kind.
    fn every_kind() -> Vec<Settings> {
        let grid =
            |samples, pattern, pixel_filter| Sampling::Grid { samples, pattern, pixel_filter };
        let area =
            |samples, pixel_filter, threshold| Sampling::Area { samples, pixel_filter, threshold };
        let jitter = Pattern::Jitter { seed: 5 };
        [
            (Filter::Tent, area(1, PixelFilter::Box, Some(THRESHOLD))),
            (Filter::Tent, area(1, PixelFilter::Box, None)),
            (Filter::Bilinear, area(2, PixelFilter::Box, Some(0.002))),
            (Filter::Tent, area(1, PixelFilter::Tent, Some(THRESHOLD))),
            (Filter::Mip, area(1, PixelFilter::Gaussian, Some(THRESHOLD))),
            (Filter::Tent, Sampling::regular(1)),
            (Filter::Box, Sampling::regular(2)),
            (Filter::Point, Sampling::regular(2)),
            (Filter::Tent, grid(3, Pattern::Regular, PixelFilter::Tent)),
            (Filter::Point, grid(2, Pattern::Regular, PixelFilter::Tent)),
            (Filter::Box, grid(2, jitter, PixelFilter::Tent)),
            (Filter::Tent, grid(1, jitter, PixelFilter::Box)),
            (Filter::Tent, Sampling::Supersample(Supersample::Image)),
            (Filter::Tent, Sampling::Supersample(Supersample::Rays)),
            (Filter::Bilinear, Sampling::Supersample(Supersample::Rays)),
        ]
        .map(|(filter, sampling)| Settings {
            sampling,
            layers: Layer::ALL.into(),
            ..Settings::new(37, 29, filter)
        })
        .into()
    }

    #[test]
    fn rays_that_count_for_little_are_left_out() {
        let settings = Settings::new(16, 16, Filter::Point);
        let mut scene = scene();
        let (all, cost) = render(&Prepared::new(&scene), &settings, &|_, _| {});
        scene.min_weight = 1e-3;
        let (most, less) = render(&Prepared::new(&scene), &settings, &|_, _| {});
        assert!(less.refracted_rays < cost.refracted_rays);
        // A pixel lacks at most one branch for each of the surfaces on its path, 8 here.
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
