//! The samples of a rectangle of cells before any cell is split.

use super::Area;
use super::compare::{pair, step};
use super::leaf::Leaf;
use super::sampler::Sampler;
use crate::color::Color;
use crate::ray::Hit;
use crate::shape::Charts;
use glam::DVec2;
use std::ops::Range;

/// Part of the error of two cells that touch at a corner. An edge between their middles cuts at most
/// an eighth of a cell, where it cuts up to a half between cells that share a side.
///
/// Without it, an edge that cuts a corner is not seen.
const DIAGONAL: f32 = 0.35;

/// Side of the blocks of cells whose first rays are traced together, in cells. A block has as many rays
/// as a group.
const BLOCK: usize = 8;

/// Estimated errors of a cell, root mean square of linear RGB.
#[derive(Debug, Clone, Copy, Default)]
pub struct Estimate {
    /// The error.
    pub error: f32,
    /// The part of the error that an edge between the cell's middle and that of a neighbour causes.
    pub edge: f32,
}

impl Estimate {
    fn raise(&mut self, error: f32, edge: f32) {
        *self = Self { error: self.error.max(error), edge: self.edge.max(edge) };
    }
}

/// Samples of a rectangle of cells, row by row.
pub struct Samples {
    columns: Range<i64>,
    rows: Range<i64>,
    /// Colours of the cells, linear RGB.
    colors: Vec<Color>,
    leaves: Vec<Leaf>,
    /// For each cell the end of its leaves in `leaves`, after a 0.
    ends: Vec<usize>,
}

impl Samples {
    /// Traces and shades the cells in these columns and rows. Once the picture does not go on, the rows that follow are
    /// black.
    pub fn take(
        area: Area,
        columns: Range<i64>,
        rows: Range<i64>,
        sampler: &mut Sampler<'_, '_>,
    ) -> Self {
        let count = ((columns.end - columns.start) * (rows.end - rows.start)) as usize;
        let mut samples = Self {
            columns,
            rows,
            colors: Vec::with_capacity(count),
            leaves: Vec::with_capacity(2 * count),
            ends: Vec::with_capacity(count + 1),
        };
        samples.ends.push(0);
        let firsts = samples.first_hits(area, sampler);
        for y in samples.rows.clone() {
            let goes_on = (sampler.shared.go_on)();
            for x in samples.columns.clone() {
                if !goes_on {
                    samples.colors.push(Color::ZERO);
                    samples.ends.push(samples.leaves.len());
                    continue;
                }
                let first = Some(firsts[samples.index(x, y)]);
                let (cell, leaves) = (area.cell(x, y), &mut samples.leaves);
                let color = sampler.sample_from(cell, DVec2::ZERO, first, leaves);
                samples.colors.push(color);
                samples.ends.push(samples.leaves.len());
            }
        }
        samples
    }

    /// Returns the closest hits of the rays through the middles of all cells. Rays of square blocks of
    /// cells are traced together.
    fn first_hits(&self, area: Area, sampler: &Sampler<'_, '_>) -> Vec<Option<Hit>> {
        let mut hits = vec![
            None;
            ((self.columns.end - self.columns.start) as usize)
                * (self.rows.end - self.rows.start) as usize
        ];
        let (mut rays, mut places) = (Vec::new(), Vec::new());
        let mut found = Vec::new();
        for top in self.rows.clone().step_by(BLOCK) {
            for left in self.columns.clone().step_by(BLOCK) {
                rays.clear();
                places.clear();
                for y in top..(top + BLOCK as i64).min(self.rows.end) {
                    for x in left..(left + BLOCK as i64).min(self.columns.end) {
                        let ray = sampler.shared.ray(area.cell(x, y).middle);
                        rays.push((ray, f64::INFINITY));
                        places.push(self.index(x, y));
                    }
                }
                found.resize(rays.len(), None);
                sampler.shared.shader.accel.closest_of(&rays, &mut found);
                for (place, hit) in places.iter().zip(&found) {
                    hits[*place] = *hit;
                }
            }
        }
        hits
    }

    /// Returns the index of the cell in column `x` and row `y`.
    pub fn index(&self, x: i64, y: i64) -> usize {
        let across = (self.columns.end - self.columns.start) as usize;
        (y - self.rows.start) as usize * across + (x - self.columns.start) as usize
    }

    /// Returns the colour of a cell, linear RGB.
    pub fn color(&self, index: usize) -> Color {
        self.colors[index]
    }

    /// Returns the estimated error of each cell from its neighbours. The outermost cells miss a
    /// neighbour, and their estimates mean nothing.
    pub fn errors(&self, charts: &[Charts]) -> Vec<Estimate> {
        let mut errors = vec![Estimate::default(); self.colors.len()];
        let across = (self.columns.end - self.columns.start) as usize;
        // Changes of light from the cells above, column by column, and from the cell to the left.
        let mut from_above = vec![[0.0; 3]; across];
        for row in 0..self.colors.len() / across {
            let mut from_left = [0.0; 3];
            for (column, from_above) in from_above.iter_mut().enumerate() {
                let own = row * across + column;
                let mut compare = |other: usize, direction: DVec2, part: f32| {
                    let found = pair(self.of(own), self.of(other), direction, charts);
                    errors[own].raise(part * found.errors[0], part * found.edge);
                    errors[other].raise(part * found.errors[1], part * found.edge);
                    found.light
                };
                let right = (column + 1 < across).then(|| compare(own + 1, DVec2::X, 1.0));
                let below = own + across;
                let down = (below < self.colors.len()).then(|| {
                    if column > 0 {
                        compare(below - 1, DVec2::new(-1.0, 1.0), DIAGONAL);
                    }
                    if column + 1 < across {
                        compare(below + 1, DVec2::ONE, DIAGONAL);
                    }
                    compare(below, DVec2::Y, 1.0)
                });
                for (before, after) in [(&mut from_left, right), (from_above, down)] {
                    if let Some(after) = after {
                        let bend = step(*before, after);
                        errors[own].raise(bend, bend);
                        *before = after;
                    }
                }
            }
        }
        errors
    }

    /// The leaves of a cell.
    fn of(&self, index: usize) -> &[Leaf] {
        &self.leaves[self.ends[index]..self.ends[index + 1]]
    }
}
