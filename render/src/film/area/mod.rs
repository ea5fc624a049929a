//! Area sampling: one ray for each cell of the film, whose differential spans the footprints, and
//! cells that split where their neighbours disagree.
//!
//! A cell is a pixel, or a part of a pixel if the settings request more rays or a pixel filter that
//! reaches beyond a pixel. A ray through the middle of the cell is traced with its differential.
//! Its footprints are parallelograms, and a filter averages over all of each. The footprints need
//! no neighbours.
//!
//! One ray does not show where a cell is cut by an edge: a silhouette, the edge of a shadow, a bent
//! mirror. The samples of neighbouring cells differ there ([`compare`]). A cell is split into four
//! cells with rays of their own ([`split`]) if its estimated error, times its area in pixels, is
//! above a threshold. Its parts are split by the same rule.
//!
//! The samples of a tile include one cell around those that the tile shows, for the comparison.
//! Whether a cell is split does therefore not depend on the tiles.

mod compare;
mod leaf;
mod sampler;
mod samples;
mod split;

use super::exposure::{Exposed, Exposure, Method, Sample, Witness, Work};
use super::lattice::Lattice;
use super::sampling::PixelFilter;
use super::{Crop, Pattern};
use crate::color::Color;
use crate::shade::View;
use glam::DVec2;
use sampler::{Sampler, Shot};
use samples::{Estimate, Samples};
use split::Splitter;
use std::ops::Range;

/// A square of the film that one ray stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Cell {
    /// Middle of the cell, in pixels from the upper left corner of the film.
    middle: DVec2,
    /// Side of the cell, in pixels.
    side: f64,
}

/// A first cell is split as well if its error in the codes of an sRGB picture, with white as 1, is
/// above this part of the threshold.
///
/// With a larger part, dark outlines and the edges of faint shadows show steps. With a smaller one,
/// pixels are split for differences that nobody sees.
const VISIBLE: f64 = 0.2;

/// Steepest slope of the codes of an sRGB picture, at black.
const STEEPEST: f64 = 12.92;

/// A cell counts as cut by an edge if the edge causes this part of its estimated error.
const MOSTLY_EDGE: f32 = 0.5;

/// A method of exposing tiles by areas.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Area {
    /// Positions and weights of the cells.
    cells: Lattice,
    /// Estimated error, in linear light times the part of a pixel, above which a cell is split;
    /// `None` if no cell is split.
    threshold: Option<f64>,
}

impl Area {
    /// `samples * samples` cells in each pixel, or twice as many along each side for a filter that
    /// reaches beyond the pixel.
    pub fn new(samples: u32, pixel_filter: PixelFilter, threshold: Option<f64>) -> Self {
        let per_pixel = match pixel_filter {
            PixelFilter::Box => samples,
            PixelFilter::Tent | PixelFilter::Gaussian => 2 * samples,
        };
        Self { cells: Lattice::grid(per_pixel, Pattern::Regular, pixel_filter), threshold }
    }

    /// Positions and weights of the cells.
    pub fn cells(self) -> Lattice {
        self.cells
    }

    /// Returns whether a first cell is split. `error` is its estimated error, root mean square of
    /// linear RGB, and `color` is the colour of its own sample.
    fn splits(self, cell: Cell, error: f32, color: Color) -> bool {
        let Some(threshold) = self.threshold else { return false };
        let error = f64::from(error) * cell.side * cell.side;
        // The steps of a dark edge are seen though its error is small.
        let visible = || error * slope_of_codes(color) > VISIBLE * threshold;
        error > threshold || error * STEEPEST > VISIBLE * threshold && visible()
    }

    fn cell(self, x: i64, y: i64) -> Cell {
        Cell { middle: self.cells.position(x, y), side: 1.0 / self.cells.per_pixel() as f64 }
    }
}

/// The samples of the cells under a tile before any cell is split.
///
/// Any part of the tile can be developed from them, with any threshold.
#[derive(Debug)]
pub struct Base {
    columns: Range<i64>,
    rows: Range<i64>,
    /// Colours of the cells, row by row, linear RGB.
    colors: Vec<Color>,
    /// Estimated errors of the cells; empty if they were not wanted.
    estimates: Vec<Estimate>,
}

impl Base {
    /// Bytes of a cell.
    pub const OF_CELL: u64 = (size_of::<Color>() + size_of::<Estimate>()) as u64;

    fn index(&self, x: i64, y: i64) -> usize {
        let across = (self.columns.end - self.columns.start) as usize;
        (y - self.rows.start) as usize * across + (x - self.columns.start) as usize
    }
}

impl Area {
    /// Traces and shades one ray for each cell under a tile. With `estimates`, the cells around them
    /// are traced too, and errors are estimated.
    pub fn base(
        self,
        shared: &Exposure<'_>,
        tile: &Crop,
        exposed: &mut Exposed,
        estimates: bool,
    ) -> Base {
        let (columns, rows) = (self.cells.under(tile.columns()), self.cells.under(tile.rows()));
        let halo = i64::from(estimates);
        let widened = |range: &Range<i64>| range.start - halo..range.end + halo;
        let mut sampler = Sampler::new(shared, exposed);
        let samples = Samples::take(self, widened(&columns), widened(&rows), &mut sampler);
        let errors = if estimates { samples.errors(shared.shader.charts) } else { Vec::new() };
        let count = ((columns.end - columns.start) * (rows.end - rows.start)) as usize;
        let mut base = Base {
            colors: Vec::with_capacity(count),
            estimates: Vec::with_capacity(if estimates { count } else { 0 }),
            columns: columns.clone(),
            rows: rows.clone(),
        };
        for y in rows {
            for index in columns.clone().map(|x| samples.index(x, y)) {
                base.colors.push(samples.color(index));
                base.estimates.extend(errors.get(index));
            }
        }
        base
    }

    /// Splits the cells under a tile and sums them into its pixels. `base` is that of the tile, or of
    /// one that contains it.
    pub fn develop<W: Witness>(
        self,
        shared: &Exposure<'_>,
        base: &Base,
        tile: &Crop,
        exposed: &mut Exposed,
        witness: &mut W,
    ) {
        let (columns, rows) = (self.cells.under(tile.columns()), self.cells.under(tile.rows()));
        let mut colors = vec![Color::ZERO; (columns.end - columns.start) as usize];
        let weights = self.cells.weights();
        let mut sampler = Sampler::new(shared, exposed);
        for (down, y) in rows.enumerate() {
            if !(shared.go_on)() {
                break;
            }
            for (color, x) in colors.iter_mut().zip(columns.clone()) {
                let (cell, index) = (self.cell(x, y), base.index(x, y));
                let estimate = base.estimates.get(index).copied().unwrap_or_default();
                let own = base.colors[index];
                let mut shots = W::LISTENS.then(Vec::new);
                let before = sampler.exposed.rays.primary;
                // Pictures of colour and of coverage split alike, whatever their own colours are.
                let is_whole = shared.settings.view == View::Whole;
                let seen = if is_whole { own } else { Color::ONE };
                let splits = self.splits(cell, estimate.error, seen);
                let left;
                (*color, left) = match self.threshold.filter(|_| splits) {
                    Some(threshold) => Splitter::new(threshold, &mut sampler, shots.as_mut())
                        .split(cell, own, estimate.edge),
                    None => {
                        let offset = DVec2::ZERO;
                        shots.iter_mut().for_each(|s| s.push(Shot { cell, offset, weight: 1.0 }));
                        (own, f64::from(estimate.error) * cell.side * cell.side)
                    }
                };
                let rays = 1 + sampler.exposed.rays.primary - before;
                let error_squared = left * left;
                let beside = estimate.edge >= MOSTLY_EDGE * estimate.error && estimate.edge > 0.0;
                let edge_squared = if beside { error_squared } else { 0.0 };
                let work = Work { error_squared, edge_squared, rays };
                sampler.exposed.spend(tile, cell.middle, work);
                for shot in shots.into_iter().flatten() {
                    witness.sample(&AreaSample { area: self, at: [x, y], shot });
                    sampler.show(&shot, witness);
                }
            }
            self.cells.gather(down, tile, &weights, &colors, &mut sampler.exposed.pixels);
        }
        if shared.settings.layers.iter().any(|layer| layer.is_of_hit()) {
            for (down, y) in tile.rows().enumerate() {
                for (across, x) in tile.columns().enumerate() {
                    let middle = DVec2::new(f64::from(x), f64::from(y)) + 0.5;
                    sampler.keep_layers(down * tile.width as usize + across, middle);
                }
            }
        }
        let whole = (self.cells.whole() as f64).powi(2);
        exposed.pixels.iter_mut().for_each(|pixel| *pixel /= whole);
    }
}

impl Method for Area {
    fn tile_side(&self, samples: u32) -> u32 {
        self.cells.tile_side(samples)
    }

    fn expose<W: Witness>(
        &self,
        shared: &Exposure<'_>,
        tile: &Crop,
        exposed: &mut Exposed,
        witness: &mut W,
    ) {
        let base = self.base(shared, tile, exposed, self.threshold.is_some());
        self.develop(shared, &base, tile, exposed, witness);
    }
}

/// A sample of a first cell, in column and row `at`, or of one of its parts.
struct AreaSample {
    area: Area,
    at: [i64; 2],
    shot: Shot,
}

impl Sample for AreaSample {
    fn name(&self) -> String {
        let [x, y] = self.at;
        let first = self.area.cell(x, y);
        let parts = (first.side / self.shot.cell.side).round();
        if parts == 1.0 {
            return format!("{x},{y}");
        }
        let corner = first.middle - 0.5 * first.side;
        let part = ((self.shot.cell.middle - corner) / self.shot.cell.side).floor();
        format!("{x},{y} part {},{} of {parts}x{parts}", part.x, part.y)
    }

    fn position(&self) -> DVec2 {
        self.shot.cell.middle + self.shot.cell.side * self.shot.offset
    }

    fn represents(&self, (column, row): (u32, u32)) -> bool {
        let [x, y] = self.at;
        let whole = self.shot.cell == self.area.cell(x, y);
        whole && self.area.cells.middle(column) == x && self.area.cells.middle(row) == y
    }

    fn weight(&self, (column, row): (u32, u32)) -> (f64, f64) {
        let [x, y] = self.at;
        let cell = self.area.cells.weight(column, x) * self.area.cells.weight(row, y);
        (cell as f64 * self.shot.weight, self.area.cells.whole().pow(2) as f64)
    }
}

/// Returns the slope of the codes of an sRGB picture, with white as 1, at the brightest channel of a
/// linear colour.
fn slope_of_codes(color: Color) -> f64 {
    let light = color.max_element().clamp(0.0031308, 1.0);
    1.055 / 2.4 * light.powf(1.0 / 2.4 - 1.0)
}
