//! Exposure of one tile of a lattice: its samples are traced row by row, shaded and summed into
//! pixels.

use super::{Lattice, Weights};
use crate::color::Color;
use crate::film::Crop;
use crate::film::exposure::{Exposed, Exposure, Method, Sample, Witness};
use crate::film::sampling::Supersample;
use crate::footprint::neighbours::ALL;
use crate::footprint::{Alone, Neighbourhood, Sight};
use crate::trace::RayCounts;
use crate::trace::rows::RowWindow;
use crate::trace::tree::IntersectionTree;
use glam::DVec2;
use std::ops::Range;

/// The sample in column `x` and row `y` of a lattice.
struct LatticeSample {
    lattice: Lattice,
    x: i64,
    y: i64,
}

impl Sample for LatticeSample {
    fn name(&self) -> String {
        format!("{},{}", self.x, self.y)
    }

    fn position(&self) -> DVec2 {
        self.lattice.position(self.x, self.y)
    }

    fn represents(&self, (column, row): (u32, u32)) -> bool {
        self.lattice.middle(column) == self.x && self.lattice.middle(row) == self.y
    }

    fn weight(&self, (column, row): (u32, u32)) -> (f64, f64) {
        let weight = self.lattice.weight(column, self.x) * self.lattice.weight(row, self.y);
        (weight as f64, self.lattice.whole().pow(2) as f64)
    }
}

impl Method for Lattice {
    fn tile_side(&self, samples: u32) -> u32 {
        Lattice::tile_side(*self, samples)
    }

    fn expose<W: Witness>(
        &self,
        shared: &Exposure<'_>,
        tile: &Crop,
        exposed: &mut Exposed,
        witness: &mut W,
    ) {
        let mut work = Work { lattice: *self, shared, tile, exposed, witness };
        match self.weights {
            Weights::Supersample(Supersample::Rays) => work.expose_nine(),
            Weights::Supersample(Supersample::Image)
            | Weights::Even
            | Weights::Tent
            | Weights::Gaussian => {
                work.expose_rows();
            }
        }
        let whole = (self.whole() as f64).powi(2);
        exposed.pixels.iter_mut().for_each(|pixel| *pixel /= whole);
    }
}

/// One tile in work.
struct Work<'a, 'b, W> {
    lattice: Lattice,
    shared: &'a Exposure<'b>,
    tile: &'a Crop,
    exposed: &'a mut Exposed,
    witness: &'a mut W,
}

impl<W: Witness> Work<'_, '_, W> {
    /// Exposes the tile one row of samples at a time.
    fn expose_rows(&mut self) {
        let columns = self.lattice.under(self.tile.columns());
        let rows = self.lattice.under(self.tile.rows());
        let weights = self.lattice.weights();
        let mut colors = vec![Color::ZERO; (columns.end - columns.start) as usize];
        if self.shared.shader.wants_area {
            let mut window = RowWindow::new(colors.len() + 2);
            for y in rows.start - 1..=rows.end {
                self.trace_row(columns.start - 1, y, window.advance());
                // The first two rows only fill the window.
                if y > rows.start {
                    for (k, x) in columns.clone().enumerate() {
                        colors[k] =
                            self.shade([x, y - 1], &Neighbourhood::of(window.around(k + 1)));
                    }
                    let down = (y - 1 - rows.start) as usize;
                    self.gather(down, &weights, &colors);
                }
            }
        } else {
            let mut tree = IntersectionTree::default();
            for (down, y) in rows.enumerate() {
                for (k, x) in columns.clone().enumerate() {
                    trace(self.lattice, self.shared, [x, y], &mut tree, &mut self.exposed.rays);
                    colors[k] = self.shade([x, y], &Alone::of(&tree));
                }
                self.gather(down, &weights, &colors);
            }
        }
    }

    /// Adds row `down` of the tile's samples to its pixels.
    fn gather(&mut self, down: usize, weights: &[i64], colors: &[Color]) {
        self.lattice.gather(down, self.tile, weights, colors, &mut self.exposed.pixels);
    }

    /// Exposes the tile by shading all nine rays of each pixel. Of the three rows of trees, the last
    /// is the first for the next row of pixels.
    fn expose_nine(&mut self) {
        let lattice = self.lattice;
        let columns = lattice.under(self.tile.columns());
        let mut window = RowWindow::new((columns.end - columns.start) as usize);
        let first = lattice.under(self.tile.rows()).start;
        self.trace_row(columns.start, first, window.advance());
        for (down, row) in self.tile.rows().enumerate() {
            let y = lattice.middle(row);
            for (trees, y) in window.advance_by_two().iter_mut().zip(y..) {
                self.trace_row(columns.start, y, trees);
            }
            for (across, column) in self.tile.columns().enumerate() {
                let x = lattice.middle(column);
                let trees = window.around((x - columns.start) as usize);
                let mut sum = Color::ZERO;
                for (k, tree) in trees.iter().enumerate().take(ALL) {
                    let at = [x - 1 + (k % 3) as i64, y - 1 + (k / 3) as i64];
                    let color = if self.shared.shader.wants_area {
                        self.shade(at, &Neighbourhood::seen_by(trees, k))
                    } else {
                        self.shade(at, &Alone::of(tree))
                    };
                    let weight = lattice.weight(row, at[1]) * lattice.weight(column, at[0]);
                    sum += weight as f64 * color;
                }
                self.exposed.pixels[down * self.tile.width as usize + across] = sum;
            }
        }
    }

    /// Shades the sample in column `x` and row `y` and returns its linear RGB colour. Stores the
    /// values of all layers if the sample is the middle one of its pixel.
    fn shade<S: Sight>(&mut self, [x, y]: [i64; 2], sight: &S) -> Color {
        let Self { lattice, shared, tile, .. } = *self;
        if !shared.settings.layers.is_empty()
            && let Some(column) = lattice.pixel_of_middle(x, &tile.columns())
            && let Some(row) = lattice.pixel_of_middle(y, &tile.rows())
        {
            self.exposed.keep_layers(shared, row * tile.width as usize + column, sight);
        }
        self.witness.sample(&LatticeSample { lattice, x, y });
        shared.shader.shade(sight, &mut self.exposed.shading, self.witness)
    }

    /// Traces row `y` of samples into `trees`, starting at column `x`.
    fn trace_row(&mut self, x: i64, y: i64, trees: &mut [IntersectionTree]) {
        for (tree, x) in trees.iter_mut().zip(x..) {
            trace(self.lattice, self.shared, [x, y], tree, &mut self.exposed.rays);
        }
    }
}

/// Traces the ray of the sample in column `x` and row `y`.
fn trace(
    lattice: Lattice,
    shared: &Exposure<'_>,
    [x, y]: [i64; 2],
    tree: &mut IntersectionTree,
    rays: &mut RayCounts,
) {
    shared.trace(lattice.position(x, y), tree, rays);
}

impl Lattice {
    /// Index within `pixels` of the pixel whose middle sample lies in column `x`, if any. Rows
    /// follow the same rule.
    fn pixel_of_middle(self, x: i64, pixels: &Range<u32>) -> Option<usize> {
        let pixel = u32::try_from(x / self.per_pixel).ok()?;
        let stands = x >= 0 && pixels.contains(&pixel) && self.middle(pixel) == x;
        stands.then(|| (pixel - pixels.start) as usize)
    }
}
