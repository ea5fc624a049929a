//! Speed of each filter as a ratio to bilinear interpolation, and its error, on one set of footprints.
//!
//! `cargo bench -p topobook-render --bench filters -- docs/measured` writes `filters.csv` and `filters.svg`
//! to that folder. Without a folder it only prints. docs/filters.md describes the measurement. With
//! `--full` it prints the errors against the box over 110 592 footprints instead of 9216, without times. With
//! `--only=exact` only methods whose names begin so are measured, beside bilinear interpolation.

#![expect(clippy::print_stdout, reason = "a bench is read on the terminal")]

mod floor;
mod report;
mod textures;

use floor::{ANGLES, BREADTHS, FULL, Pixel, SCALES, SMALL, STRETCHES};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
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

/// Numbers of kinds of footprints, by texture, angle, breadth and stretch.
const KINDS: [usize; 4] = [4, ANGLES.len(), BREADTHS.len(), STRETCHES.len()];

/// A method that is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// A filter over the box around nine neighbours, or over the pixel's quadrilateral if the filter
    /// averages over any shape.
    Filter(Filter),
    /// The exact filter over the parallelogram of the pixel's derivatives.
    Parallelogram,
    /// The mean of the exact filter over N x N parts of the pixel.
    Parts(u32),
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
            Self::Parallelogram => "exact, parallelogram".into(),
            Self::Parts(n) => format!("exact, {n} x {n}"),
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
    /// Largest error against the box.
    pub largest: f64,
    /// Errors against the box, by texture.
    pub by_texture: Vec<f64>,
    /// Errors against the box, by angle.
    pub by_angle: Vec<f64>,
    /// Errors against the box, by the short side of the footprint.
    pub by_breadth: Vec<f64>,
    /// Errors against the box, by anisotropy.
    pub by_stretch: Vec<f64>,
    /// Memory besides the textures, in bytes.
    pub bytes: u64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().skip(1).find(|argument| !argument.starts_with('-'));
    let textures = textures::all();
    let set = if std::env::args().any(|argument| argument == "--full") { FULL } else { SMALL };
    let pixels = floor::pixels(textures.len(), set);
    let truths: Vec<[DVec3; 2]> =
        pixels.par_iter().map(|pixel| pixel.truth(&textures[pixel.texture].1, set)).collect();
    let noise = floor::noise(&pixels, &textures, &truths, set);
    let only =
        std::env::args().find_map(|argument| Some(argument.strip_prefix("--only=")?.to_owned()));
    let wanted = |method: &Method| {
        let bilinear = *method == Method::Filter(Filter::Bilinear);
        bilinear || only.as_ref().is_none_or(|only| method.name().starts_with(only))
    };
    let methods: Vec<Method> = Filter::ALL
        .map(Method::Filter)
        .into_iter()
        .chain([Method::BoxOfOnePixel, Method::Parallelogram])
        .chain([2, 4].map(Method::Parts))
        .chain([2, 4, 8].map(Method::Samples))
        .filter(wanted)
        .collect();
    let bilinear = methods.iter().position(|&method| method == Method::Filter(Filter::Bilinear));
    let timed = if set.places == SMALL.places { pixels.as_slice() } else { &[] };
    let times = times(&methods, &textures, timed);
    let lines: Vec<Line> = methods
        .iter()
        .zip(&times)
        .map(|(&method, own)| {
            line(method, own, &times[bilinear.unwrap_or(0)], &textures, &pixels, &truths)
        })
        .collect();
    if !timed.is_empty() {
        println!(
            "exact: three channels take {:.2} times as long as one",
            channels(&textures, timed)
        );
    }
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

/// Returns the time of the exact filter on coloured textures, by that on the same ones in grey.
fn channels(textures: &[(&str, Texture)], pixels: &[Pixel]) -> f64 {
    let colored = textures.iter().map(|(name, texture)| {
        let texels = texture.texels.iter().map(|&[grey, ..]| [grey, u16::MAX - grey, grey / 2]);
        (*name, Texture { texels: texels.collect(), ..texture.clone() })
    });
    let colored: Vec<(&str, Texture)> = colored.collect();
    let time = |textures: &[(&str, Texture)]| {
        let methods = [Method::Filter(Filter::Exact)];
        times(&methods, textures, pixels)[0].iter().flatten().sum::<f64>()
    };
    time(&colored) / time(textures)
}

fn prepared(method: Method, texture: &Texture) -> FilteredTexture<'_> {
    let filter = match method {
        Method::Filter(filter) => filter,
        Method::BoxOfOnePixel => Filter::Box,
        Method::Parallelogram | Method::Parts(_) => Filter::Exact,
        Method::Samples(_) => Filter::Bilinear,
    };
    FilteredTexture::new(texture, filter)
}

/// Returns the footprint over which a method averages.
fn footprint(method: Method, pixel: &Pixel) -> Footprint {
    match method {
        Method::Filter(
            Filter::Exact | Filter::Ewa8 | Filter::Ewa16 | Filter::Ewa64 | Filter::Probes,
        ) => Footprint::Quadrilateral(pixel.corners(DVec2::splat(-0.5), DVec2::splat(0.5))),
        Method::Parallelogram => {
            Footprint::Parallelogram { center: pixel.uv(0.0, 0.0), sides: pixel.sides() }
        }
        Method::Filter(filter) if filter.wants_area() => {
            Footprint::Rectangle { center: pixel.center, half: pixel.half }
        }
        Method::BoxOfOnePixel => {
            Footprint::Rectangle { center: pixel.center, half: 0.5 * pixel.half }
        }
        Method::Filter(_) | Method::Parts(_) | Method::Samples(_) => {
            Footprint::Point(pixel.uv(0.0, 0.0))
        }
    }
}

/// Returns the result of a method whose footprint for this pixel is `print`.
fn average(
    method: Method,
    ready: &FilteredTexture<'_>,
    texture: &Texture,
    pixel: &Pixel,
    print: &Footprint,
) -> DVec3 {
    match method {
        Method::Samples(n) => pixel.samples(texture, n),
        Method::Parts(n) => {
            let side = 1.0 / f64::from(n);
            let parts = (0..n).flat_map(|i| (0..n).map(move |j| DVec2::new(i.into(), j.into())));
            let part = |at: DVec2| {
                let low = at * side - 0.5;
                ready.average(&Footprint::Quadrilateral(pixel.corners(low, low + side)))
            };
            parts.map(part).sum::<DVec3>() * side * side
        }
        _ => ready.average(print),
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
    for (pixel, print) in chunk.iter().zip(prints) {
        black_box(average(method, ready, texture, pixel, black_box(print)));
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
    let mut errors: Vec<([usize; 4], [f64; 2])> = Vec::with_capacity(pixels.len());
    let mut bytes = 0;
    for (k, (_, texture)) in textures.iter().enumerate() {
        let ready = prepared(method, texture);
        bytes += ready.table_bytes() as u64;
        let own: Vec<_> = pixels
            .par_iter()
            .zip(truths)
            .filter(|(pixel, _)| pixel.texture == k)
            .map(|(pixel, truth)| {
                let found = average(method, &ready, texture, pixel, &footprint(method, pixel));
                let kind = [k, pixel.angle, pixel.breadth(texture), pixel.stretch()];
                (kind, truth.map(|truth| found.x - truth.x))
            })
            .collect();
        errors.extend(own);
    }
    let rms = |truth: usize, seen: &dyn Fn(&[usize; 4]) -> bool| {
        let of_kind = || errors.iter().filter(|(kind, _)| seen(kind));
        let sum: f64 = of_kind().map(|(_, error)| error[truth] * error[truth]).sum();
        (sum / of_kind().count() as f64).sqrt()
    };
    let by = |at: usize| -> Vec<f64> {
        (0..KINDS[at]).map(|value| rms(0, &|kind| kind[at] == value)).collect()
    };
    let [by_texture, by_angle, by_breadth, by_stretch] = [0, 1, 2, 3].map(by);
    Line {
        method,
        time: 1e9 * sum(own) / pixels.len() as f64,
        ratio: sum(own) / sum(bilinear),
        ratios: [0, 1, 2].map(|scale| sum(&own[scale..=scale]) / sum(&bilinear[scale..=scale])),
        error: [0, 1].map(|truth| rms(truth, &|_| true)),
        largest: errors.iter().fold(0.0, |most, (_, error)| f64::max(most, error[0].abs())),
        by_texture,
        by_angle,
        by_breadth,
        by_stretch,
        bytes,
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
