//! Exposure of one tile: its samples are traced row by row, shaded and summed into pixels.

use super::crop::Crop;
use super::layer::Layer;
use super::sampling::{Sampling, Supersample};
use super::{Picture, Settings};
use crate::color::Color;
use crate::footprint::neighbours::{ALL, Neighbourhood};
use crate::shade::observer::Observer;
use crate::shade::{ShadeCounts, Shader};
use crate::stats::Stats;
use crate::trace::rows::RowWindow;
use crate::trace::tree::IntersectionTree;
use crate::trace::{RayCounts, Tracer};
use glam::DVec2;
use std::ops::Range;

/// The data that all tiles share.
pub struct Exposure<'a> {
    pub tracer: Tracer<'a>,
    pub shader: Shader<'a>,
    pub settings: &'a Settings,
    /// Whether footprints need the neighbours of each sample.
    pub halo: bool,
}

/// The exposed pixels of a tile.
pub struct Exposed {
    /// Pixels row by row, linear RGB.
    pixels: Vec<Color>,
    /// For each pixel the values of all channels of all layers.
    layers: Vec<Vec<f32>>,
    rays: RayCounts,
    shading: ShadeCounts,
}

/// Observes the exposure of a tile: which samples are shaded, and all steps of their shading.
pub trait Witness: Observer {
    /// Called before the sample in column `x` and row `y` of the film's lattice is shaded.
    fn sample(&mut self, x: i64, y: i64);
}

impl Witness for () {
    fn sample(&mut self, _: i64, _: i64) {}
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
}

impl Film {
    pub fn new(crop: Crop, layers: &[Layer], stats: Stats) -> Self {
        let picture = Picture::with_layers(crop.width, crop.height, layers);
        Self { picture, stats, crop, done: 0 }
    }

    /// Copies a tile into the picture and returns the number of tiles collected so far.
    pub fn take(&mut self, tile: &Crop, exposed: &Exposed) -> usize {
        let (x, y) = (tile.x - self.crop.x, tile.y - self.crop.y);
        self.picture.place(x, y, tile.width, &exposed.pixels);
        self.picture.place_layers(x, y, tile.width, &exposed.layers);
        self.stats.add(&exposed.rays, &exposed.shading);
        self.done += 1;
        self.done
    }
}

impl Exposure<'_> {
    /// Exposes a rectangle of pixels.
    pub fn expose<W: Witness>(&self, tile: &Crop, witness: &mut W) -> Exposed {
        let pixels = tile.width as usize * tile.height as usize;
        let layers = if self.settings.layers.is_empty() { 0 } else { pixels };
        let mut exposed = Exposed {
            pixels: vec![Color::ZERO; pixels],
            layers: vec![Vec::new(); layers],
            rays: RayCounts::default(),
            shading: ShadeCounts::default(),
        };
        match self.settings.sampling {
            Sampling::Supersample(Supersample::Rays) => {
                self.expose_nine(tile, &mut exposed, witness);
            }
            _ => self.expose_rows(tile, &mut exposed, witness),
        }
        let whole = (self.settings.sampling.whole() as f64).powi(2);
        exposed.pixels.iter_mut().for_each(|pixel| *pixel /= whole);
        exposed
    }

    /// Exposes a tile one row of samples at a time.
    fn expose_rows<W: Witness>(&self, tile: &Crop, exposed: &mut Exposed, witness: &mut W) {
        let columns = self.settings.sampling.under(tile.columns());
        let rows = self.settings.sampling.under(tile.rows());
        let mut colors = vec![Color::ZERO; (columns.end - columns.start) as usize];
        if self.halo {
            let mut window = RowWindow::new(colors.len() + 2);
            for y in rows.start - 1..=rows.end {
                self.trace_row(columns.start - 1, y, window.advance(), &mut exposed.rays);
                // The first two rows only fill the window.
                if y > rows.start {
                    for (k, x) in columns.clone().enumerate() {
                        let around = Neighbourhood::of(window.around(k + 1));
                        colors[k] = self.shade(tile, [x, y - 1], &around, exposed, witness);
                    }
                    self.gather(tile, y - 1, &columns, &colors, &mut exposed.pixels);
                }
            }
        } else {
            let mut tree = IntersectionTree::default();
            for y in rows {
                for (k, x) in columns.clone().enumerate() {
                    self.trace(x, y, &mut tree, &mut exposed.rays);
                    let around = Neighbourhood::alone(&tree);
                    colors[k] = self.shade(tile, [x, y], &around, exposed, witness);
                }
                self.gather(tile, y, &columns, &colors, &mut exposed.pixels);
            }
        }
    }

    /// Adds a row of samples to the pixels in which it has a weight.
    fn gather(
        &self,
        tile: &Crop,
        y: i64,
        columns: &Range<i64>,
        colors: &[Color],
        pixels: &mut [Color],
    ) {
        let sampling = self.settings.sampling;
        for (row, pixels) in tile.rows().zip(pixels.chunks_exact_mut(tile.width as usize)) {
            let down = sampling.weight(row, y);
            if down == 0 {
                continue;
            }
            for (column, pixel) in tile.columns().zip(pixels) {
                for x in sampling.under(column..column + 1) {
                    let weight = (down * sampling.weight(column, x)) as f64;
                    *pixel += weight * colors[(x - columns.start) as usize];
                }
            }
        }
    }

    /// Exposes a tile by shading all nine rays of each pixel. Of the three rows of trees, the last
    /// is the first for the next row of pixels.
    fn expose_nine<W: Witness>(&self, tile: &Crop, exposed: &mut Exposed, witness: &mut W) {
        let sampling = self.settings.sampling;
        let columns = sampling.under(tile.columns());
        let mut window = RowWindow::new((columns.end - columns.start) as usize);
        let first = sampling.under(tile.rows()).start;
        self.trace_row(columns.start, first, window.advance(), &mut exposed.rays);
        for (down, row) in tile.rows().enumerate() {
            let y = sampling.middle(row);
            for (trees, y) in window.advance_by_two().iter_mut().zip(y..) {
                self.trace_row(columns.start, y, trees, &mut exposed.rays);
            }
            for (across, column) in tile.columns().enumerate() {
                let x = sampling.middle(column);
                let trees = window.around((x - columns.start) as usize);
                let mut sum = Color::ZERO;
                for k in 0..ALL {
                    let [x, y] = [x - 1 + (k % 3) as i64, y - 1 + (k / 3) as i64];
                    let around = if self.halo {
                        Neighbourhood::of(trees).seen_by(k)
                    } else {
                        Neighbourhood::alone(trees[k])
                    };
                    let weight = (sampling.weight(row, y) * sampling.weight(column, x)) as f64;
                    sum += weight * self.shade(tile, [x, y], &around, exposed, witness);
                }
                exposed.pixels[down * tile.width as usize + across] = sum;
            }
        }
    }

    /// Shades the sample in the middle of `around` and returns its linear RGB colour. Stores the
    /// values of all layers if the sample is the middle one of its pixel.
    fn shade<W: Witness>(
        &self,
        tile: &Crop,
        [x, y]: [i64; 2],
        around: &Neighbourhood<'_>,
        exposed: &mut Exposed,
        witness: &mut W,
    ) -> Color {
        if !exposed.layers.is_empty()
            && let Some(column) = self.pixel_of_middle(x, &tile.columns())
            && let Some(row) = self.pixel_of_middle(y, &tile.rows())
        {
            let values = &mut exposed.layers[row * tile.width as usize + column];
            for layer in &self.settings.layers {
                layer.push(around, &self.shader, values);
            }
        }
        witness.sample(x, y);
        self.shader.shade(around, &mut exposed.shading, witness)
    }

    /// Index within `pixels` of the pixel whose middle sample lies in column `x`, if any. Rows
    /// follow the same rule.
    fn pixel_of_middle(&self, x: i64, pixels: &Range<u32>) -> Option<usize> {
        let sampling = self.settings.sampling;
        let pixel = u32::try_from(x / i64::from(sampling.per_pixel())).ok()?;
        let stands = x >= 0 && pixels.contains(&pixel) && sampling.middle(pixel) == x;
        stands.then(|| (pixel - pixels.start) as usize)
    }

    /// Traces row `y` of samples into `trees`, starting at column `x`.
    fn trace_row(&self, x: i64, y: i64, trees: &mut [IntersectionTree], rays: &mut RayCounts) {
        for (tree, x) in trees.iter_mut().zip(x..) {
            self.trace(x, y, tree, rays);
        }
    }

    /// Traces the ray of the sample in column `x` and row `y`.
    fn trace(&self, x: i64, y: i64, tree: &mut IntersectionTree, rays: &mut RayCounts) {
        let Settings { width, height, sampling, .. } = *self.settings;
        let size = DVec2::new(f64::from(width), f64::from(height));
        let place = sampling.place(x, y);
        self.tracer.trace(&self.tracer.scene.camera.ray(place, size), tree, rays);
    }
}
