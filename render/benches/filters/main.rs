//! Speed of each filter as a ratio to bilinear interpolation, and its error, on one set of footprints.
//!
//! `cargo bench -p render --bench filters -- docs/measured` writes `filters.csv` and `filters.svg`
//! to that folder. Without a folder it only prints. docs/filters.md describes the measurement.

#![expect(clippy::print_stdout, reason = "a bench is read on the terminal")]

mod floor;
mod report;
mod textures;

use floor::{ANGLES, BREADTHS, Pixel, SCALES};
use glam::DVec3;
use render::filter::{Filter, FilteredTexture};
use render::footprint::Footprint;
use render::texture::Texture;
use std::error::Error;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

/// Number of times that every method passes over a chunk of footprints, in turn with the others.
const ROUNDS: usize = 15;

/// Footprints of a chunk. A pass over a chunk is shorter than the time slices of a shared machine.
/// The number divides the footprints of a scale.
const CHUNK: usize = 32;

/// Number of kinds of footprints, by texture, angle and breadth.
const CELLS: usize = 4 * ANGLES.len() * BREADTHS.len();

/// A method that is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// A filter over the box around nine neighbours, as in the renderer.
    Filter(Filter),
    /// The box filter over half that box along each axis: about one pixel.
    BoxOfOnePixel,
    /// The mean of bilinear interpolation at N x N positions in the pixel.
    Samples(u32),
}

impl Method {
    /// Returns the name of the method in tables.
    pub fn name(self) -> String {
        match self {
            Self::Filter(filter) => filter.to_string(),
            Self::BoxOfOnePixel => "box, 1 px".into(),
            Self::Samples(n) => format!("bilinear, {n} x {n}"),
        }
    }
}

/// The measured values of a method.
#[derive(Debug)]
pub struct Line {
    /// The method.
    pub method: Method,
    /// Time of one average, in nanoseconds.
    pub time: f64,
    /// Time divided by that of bilinear interpolation.
    pub ratio: f64,
    /// Ratios by scale.
    pub ratios: [f64; 3],
    /// Root mean square errors of a texture from 0 to 1, against the pixel's box and tent.
    pub error: [f64; 2],
    /// Errors against the box, by texture.
    pub by_texture: [f64; 4],
    /// Errors against the box, by angle.
    pub by_angle: [f64; 3],
    /// Errors against the box, by the short side of the footprint.
    pub by_breadth: [f64; 3],
    /// Memory besides the textures, in bytes.
    pub bytes: u64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().skip(1).find(|argument| !argument.starts_with('-'));
    let textures = textures::all();
    let pixels = floor::pixels(textures.len());
    let truths: Vec<[DVec3; 2]> =
        pixels.iter().map(|pixel| pixel.truth(&textures[pixel.texture].1)).collect();
    let noise = floor::noise(&pixels, &textures, &truths);
    let methods: Vec<Method> = Filter::ALL
        .map(Method::Filter)
        .into_iter()
        .chain([Method::BoxOfOnePixel])
        .chain([2, 4, 8].map(Method::Samples))
        .collect();
    let times = times(&methods, &textures, &pixels);
    let lines: Vec<Line> = methods
        .iter()
        .zip(&times)
        .map(|(&method, own)| line(method, own, &times[1], &textures, &pixels, &truths))
        .collect();
    println!("{} footprints, noise of the truth {noise:.1e}", pixels.len());
    print!("{}", report::csv(&lines));
    if let Some(folder) = folder {
        // Benches run in the folder of their package.
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(folder);
        std::fs::write(folder.join("filters.csv"), report::csv(&lines))?;
        std::fs::write(folder.join("filters.svg"), report::svg(&lines)?)?;
    }
    Ok(())
}

fn prepared(method: Method, texture: &Texture) -> FilteredTexture<'_> {
    let filter = match method {
        Method::Filter(filter) => filter,
        Method::BoxOfOnePixel => Filter::Box,
        Method::Samples(_) => Filter::Bilinear,
    };
    FilteredTexture::new(texture, filter)
}

/// Returns the footprint over which a method averages.
fn footprint(method: Method, pixel: &Pixel) -> Footprint {
    match method {
        Method::Filter(filter) if filter.wants_area() => {
            Footprint::Rectangle { center: pixel.center, half: pixel.half }
        }
        Method::BoxOfOnePixel => {
            Footprint::Rectangle { center: pixel.center, half: 0.5 * pixel.half }
        }
        Method::Filter(_) | Method::Samples(_) => Footprint::Point(pixel.uv(0.0, 0.0)),
    }
}

/// Returns the median time of the rounds in seconds, by scale and chunk of footprints. In each
/// round every method passes over the chunk twice, and the second pass counts. Tables are then in
/// the cache as they would be after a pixel's neighbours.
fn times(
    methods: &[Method],
    textures: &[(&str, Texture)],
    pixels: &[Pixel],
) -> Vec<[Vec<f64>; SCALES.len()]> {
    let mut times = vec![[(); SCALES.len()].map(|()| Vec::new()); methods.len()];
    for (k, (_, texture)) in textures.iter().enumerate() {
        let ready: Vec<FilteredTexture<'_>> =
            methods.iter().map(|&method| prepared(method, texture)).collect();
        let seen: Vec<&Pixel> = pixels.iter().filter(|pixel| pixel.texture == k).collect();
        for chunk in seen.chunks(CHUNK) {
            let mut rounds = vec![Vec::with_capacity(ROUNDS); methods.len()];
            for _ in 0..ROUNDS {
                for (at, &method) in methods.iter().enumerate() {
                    let prints: Vec<Footprint> =
                        chunk.iter().map(|pixel| footprint(method, pixel)).collect();
                    pass(method, &ready[at], texture, chunk, &prints);
                    let started = Instant::now();
                    pass(method, &ready[at], texture, chunk, &prints);
                    rounds[at].push(started.elapsed().as_secs_f64());
                }
            }
            for (at, rounds) in rounds.into_iter().enumerate() {
                times[at][chunk[0].scale].push(median(rounds));
            }
        }
    }
    times
}

fn pass(
    method: Method,
    ready: &FilteredTexture<'_>,
    texture: &Texture,
    chunk: &[&Pixel],
    prints: &[Footprint],
) {
    if let Method::Samples(n) = method {
        chunk.iter().for_each(|pixel| {
            black_box(pixel.samples(texture, n));
        });
        return;
    }
    for print in prints {
        black_box(ready.average(black_box(print)));
    }
}

fn line(
    method: Method,
    own: &[Vec<f64>; 3],
    bilinear: &[Vec<f64>; 3],
    textures: &[(&str, Texture)],
    pixels: &[Pixel],
    truths: &[[DVec3; 2]],
) -> Line {
    let sum = |times: &[Vec<f64>]| times.iter().flatten().sum::<f64>();
    let mut squares = [[0.0; 2]; CELLS];
    let mut counts = [0; CELLS];
    let mut bytes = 0;
    for (k, (_, texture)) in textures.iter().enumerate() {
        let ready = prepared(method, texture);
        bytes += ready.table_bytes() as u64;
        for (pixel, truth) in pixels.iter().zip(truths).filter(|(pixel, _)| pixel.texture == k) {
            let found = match method {
                Method::Samples(n) => pixel.samples(texture, n),
                _ => ready.average(&footprint(method, pixel)),
            };
            let cell = (k * ANGLES.len() + pixel.angle) * BREADTHS.len() + pixel.breadth(texture);
            counts[cell] += 1;
            for (sum, truth) in squares[cell].iter_mut().zip(truth) {
                *sum += (found.x - truth.x).powi(2);
            }
        }
    }
    let rms = |truth: usize, seen: &dyn Fn(usize) -> bool| {
        let cells = || (0..CELLS).filter(|&cell| seen(cell));
        let sum: f64 = cells().map(|cell| squares[cell][truth]).sum();
        (sum / cells().map(|cell| counts[cell]).sum::<usize>() as f64).sqrt()
    };
    Line {
        method,
        time: 1e9 * sum(own) / pixels.len() as f64,
        ratio: sum(own) / sum(bilinear),
        ratios: [0, 1, 2].map(|scale| sum(&own[scale..=scale]) / sum(&bilinear[scale..=scale])),
        error: [0, 1].map(|truth| rms(truth, &|_| true)),
        by_texture: [0, 1, 2, 3].map(|texture| rms(0, &|cell| cell / 9 == texture)),
        by_angle: [0, 1, 2].map(|angle| rms(0, &|cell| cell / 3 % 3 == angle)),
        by_breadth: [0, 1, 2].map(|breadth| rms(0, &|cell| cell % 3 == breadth)),
        bytes,
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
