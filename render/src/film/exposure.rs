//! The interface of a method of exposing tiles, and what all methods share.
//!
//! A [`Method`] decides which rays are traced for the pixels of a tile, which sight each of them is
//! shaded with, and how their colours are weighted. [`super::lattice`] is the thesis's method.
//! Another method adds its own files, a variant of [`Sampling`] and an arm to the two matches
//! below. It provides, in an [`Exposed`]:
//!
//! - the colour of each pixel, linear RGB: a weighted sum of samples whose weights sum to 1. The
//!   colour may depend only on the pixel and the settings, not on the tile or the thread.
//! - the layers of each pixel ([`Exposed::keep_layers`]), from the sight of one ray near its middle,
//! - the counts of all rays that it traces, and of all shading,
//! - a call of [`Witness::sample`] before each sample is shaded, with the witness as the observer.

use super::area::Area;
use super::course::GoOn;
use super::crop::Crop;
use super::lattice::Lattice;
use super::layer::{Layer, MOST_CHANNELS};
use super::sampling::Sampling;
use super::{Picture, Settings};
use crate::color::Color;
use crate::footprint::Sight;
use crate::ray::{Hit, Ray};
use crate::shade::observer::Observer;
use crate::shade::{ShadeWork, Shader};
use crate::stats::Stats;
use crate::trace::tree::IntersectionTree;
use crate::trace::{RayCounts, Tracer};
use glam::DVec2;
use std::fmt;

/// A method of exposing a tile.
pub trait Method {
    /// Returns a side of tiles, in pixels, at which about `samples` samples lie along it.
    fn tile_side(&self, samples: u32) -> u32;

    /// Exposes a rectangle of pixels.
    fn expose<W: Witness>(
        &self,
        shared: &Exposure<'_>,
        tile: &Crop,
        exposed: &mut Exposed,
        witness: &mut W,
    );
}

/// A sample that is shaded, as a witness sees it.
pub trait Sample {
    /// Name of the sample in messages, unique in the picture.
    fn name(&self) -> String;

    /// Position on the film, in pixels from the upper left corner.
    fn position(&self) -> DVec2;

    /// Returns whether the layers of this pixel show the sample.
    fn represents(&self, pixel: (u32, u32)) -> bool;

    /// Returns the sample's weight in a pixel, and the sum of the weights of all samples in it.
    fn weight(&self, pixel: (u32, u32)) -> (f64, f64);
}

/// Observes the exposure of a tile: which samples are shaded, and all steps of their shading.
pub trait Witness: Observer {
    /// False if the witness ignores all reports, so that a method need not prepare them.
    const LISTENS: bool = true;

    /// Called before a sample is shaded.
    fn sample(&mut self, sample: &impl Sample);
}

impl Witness for () {
    const LISTENS: bool = false;

    fn sample(&mut self, _: &impl Sample) {}
}

/// The data that all tiles share.
pub struct Exposure<'a> {
    pub tracer: Tracer<'a>,
    pub shader: Shader<'a>,
    pub settings: &'a Settings,
    /// Asked before each row of an area sampled tile. After false, the tile is of no use.
    pub go_on: &'a GoOn<'a>,
}

impl fmt::Debug for Exposure<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Exposure").field("settings", self.settings).finish_non_exhaustive()
    }
}

/// The exposed pixels of a tile.
pub struct Exposed {
    /// Pixels row by row, linear RGB.
    pub pixels: Vec<Color>,
    pub rays: RayCounts,
    pub shading: ShadeWork,
    /// Number of channels of all layers.
    channels: usize,
    /// Pixel by pixel the values of all channels of all layers.
    layers: Vec<f32>,
    /// The work of each pixel.
    pub work: Vec<Work>,
}

/// The rays of a pixel, and the error that they leave.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Work {
    /// Square of the estimated error, linear light; 0 for methods without an estimate.
    pub error_squared: f64,
    /// The part of `error_squared` of cells that an edge cuts, or that lie beside one.
    pub edge_squared: f64,
    /// Rays from the eye whose cells have their middle in the pixel.
    pub rays: u64,
}

/// Collects the tiles of a picture, in any order. The order does not matter, since tiles do not
/// overlap and counts are whole numbers.
pub struct Film {
    pub picture: Picture,
    pub stats: Stats,
    /// The part of the whole picture that is exposed.
    crop: Crop,
    /// Number of tiles collected.
    done: usize,
    /// Number of pixels that were not collected yet.
    left: u64,
}

impl Film {
    /// Starts with a picture of the crop's size, whose pixels are replaced tile by tile.
    pub fn new(crop: Crop, picture: Picture, stats: Stats) -> Self {
        let left = picture.pixels.len() as u64;
        Self { picture, stats, crop, done: 0, left }
    }

    /// Returns the picture and its counts.
    pub fn developed(mut self) -> (Picture, Stats) {
        self.stats.unfinished = self.left;
        (self.picture, self.stats)
    }

    /// Copies a tile into the picture and returns the number of tiles collected so far.
    pub fn take(&mut self, tile: &Crop, exposed: &Exposed) -> usize {
        let (x, y) = (tile.x - self.crop.x, tile.y - self.crop.y);
        self.picture.place(x, y, tile.width, &exposed.pixels);
        self.picture.place_layers(x, y, tile.width, &exposed.layers);
        self.stats.add(&exposed.rays, &exposed.shading.counts);
        self.left -= exposed.pixels.len() as u64;
        self.done += 1;
        self.done
    }
}

impl Exposure<'_> {
    /// Returns a side of tiles, in pixels, at which about `samples` samples lie along it.
    pub fn tile_side(&self, samples: u32) -> u32 {
        match self.settings.sampling {
            Sampling::Grid { samples: n, pattern, pixel_filter } => {
                Lattice::grid(n, pattern, pixel_filter).tile_side(samples)
            }
            Sampling::Supersample(method) => Lattice::supersample(method).tile_side(samples),
            Sampling::Area { samples: n, pixel_filter, threshold } => {
                Area::new(n, pixel_filter, threshold).tile_side(samples)
            }
        }
    }

    /// Exposes a rectangle of pixels by the method that the settings choose.
    pub fn expose<W: Witness>(&self, tile: &Crop, witness: &mut W) -> Exposed {
        let mut exposed = self.unexposed(tile);
        match self.settings.sampling {
            Sampling::Grid { samples, pattern, pixel_filter } => {
                let lattice = Lattice::grid(samples, pattern, pixel_filter);
                lattice.expose(self, tile, &mut exposed, witness);
                exposed.spend_evenly(lattice);
            }
            Sampling::Supersample(method) => {
                let lattice = Lattice::supersample(method);
                lattice.expose(self, tile, &mut exposed, witness);
                exposed.spend_evenly(lattice);
            }
            Sampling::Area { samples, pixel_filter, threshold } => {
                let area = Area::new(samples, pixel_filter, threshold);
                area.expose(self, tile, &mut exposed, witness);
            }
        }
        exposed.keep_work(self.settings);
        exposed
    }

    /// Returns a tile before its exposure.
    pub fn unexposed(&self, tile: &Crop) -> Exposed {
        let pixels = tile.width as usize * tile.height as usize;
        let channels = self.settings.layers.iter().map(|layer| layer.channels().len()).sum();
        Exposed {
            pixels: vec![Color::ZERO; pixels],
            rays: RayCounts::default(),
            shading: ShadeWork::default(),
            channels,
            layers: vec![0.0; channels * pixels],
            work: vec![Work::default(); pixels],
        }
    }

    /// Traces the ray through a position on the film, in pixels from the upper left corner.
    pub fn trace(&self, position: DVec2, tree: &mut IntersectionTree, rays: &mut RayCounts) {
        self.tracer.trace(&self.tracer.camera.ray(position, self.size()), tree, rays);
    }

    /// Returns the ray through a position on the film.
    pub fn ray(&self, position: DVec2) -> Ray {
        self.tracer.camera.ray(position, self.size())
    }

    /// Traces the ray through a position on the film, with its differential for a step of `side`
    /// pixels. `first` is the ray's closest hit, if it is known whether there is one.
    pub fn trace_spread(
        &self,
        position: DVec2,
        side: f64,
        first: Option<Option<Hit>>,
        tree: &mut IntersectionTree,
        rays: &mut RayCounts,
    ) {
        let ray = self.ray(position);
        let differential = self.tracer.camera.differential(position, self.size(), side);
        match first {
            Some(first) => {
                self.tracer.trace_spread_from(&ray, &differential, first, tree, rays);
            }
            None => self.tracer.trace_spread(&ray, &differential, tree, rays),
        }
    }

    /// Size of the film, in pixels.
    fn size(&self) -> DVec2 {
        DVec2::new(f64::from(self.settings.width), f64::from(self.settings.height))
    }
}

impl Exposed {
    /// Stores the values of all layers of a pixel: those of the root of a sight. `pixel` is the
    /// pixel's index in the tile, row by row.
    pub fn keep_layers<S: Sight>(&mut self, shared: &Exposure<'_>, pixel: usize, sight: &S) {
        let sight = &shared.shader.behind_cutouts(*sight);
        let mut rest = &mut self.layers[pixel * self.channels..][..self.channels];
        for layer in &shared.settings.layers {
            let values: [f32; MOST_CHANNELS] =
                layer.values(sight, (&shared.shader, &shared.tracer.camera));
            let count = layer.channels().len();
            let (own, others) = rest.split_at_mut(count);
            own.copy_from_slice(&values[..count]);
            rest = others;
        }
    }

    /// Adds a cell to the work of the pixel that contains its middle, if the pixel is in the tile. Errors
    /// are those of the cell times its area in pixels.
    pub fn spend(&mut self, tile: &Crop, middle: DVec2, of_cell: Work) {
        let corner = DVec2::new(f64::from(tile.x), f64::from(tile.y));
        let (across, down) = ((middle - corner).x.floor(), (middle - corner).y.floor());
        let (width, height) = (f64::from(tile.width), f64::from(tile.height));
        if (0.0..width).contains(&across) && (0.0..height).contains(&down) {
            let work = &mut self.work[down as usize * tile.width as usize + across as usize];
            work.error_squared += of_cell.error_squared;
            work.edge_squared += of_cell.edge_squared;
            work.rays += of_cell.rays;
        }
    }

    /// Gives each pixel the rays of a lattice.
    fn spend_evenly(&mut self, lattice: Lattice) {
        let rays = lattice.per_pixel().unsigned_abs().pow(2);
        self.work.fill(Work { rays, ..Work::default() });
    }

    /// Stores the layers that show the work of each pixel.
    pub fn keep_work(&mut self, settings: &Settings) {
        let mut first = 0;
        for layer in &settings.layers {
            for (values, work) in self.layers.chunks_exact_mut(self.channels).zip(&self.work) {
                match layer {
                    Layer::Error => values[first] = work.error_squared.sqrt() as f32,
                    Layer::Rays => values[first] = work.rays as f32,
                    Layer::Normal | Layer::Depth | Layer::Uv | Layer::Object | Layer::Footprint => {
                    }
                }
            }
            first += layer.channels().len();
        }
    }
}
