//! The samples of a rectangle of cells before any cell is split.

use super::Area;
use super::compare::{pair, step};
use super::leaf::Leaf;
use super::sampler::Sampler;
use crate::color::Color;
use crate::shape::Charts;
use glam::DVec2;
use std::ops::Range;

/// Part of the error of two cells that touch at a corner. An edge between their middles cuts at most
/// an eighth of a cell, where it cuts up to a half between cells that share a side.
///
/// Without it, an edge that cuts a corner is not seen.
const DIAGONAL: f32 = 0.5;

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
    /// Traces and shades the cells in these columns and rows.
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
        for y in samples.rows.clone() {
            for x in samples.columns.clone() {
                let color = sampler.sample(area.cell(x, y), DVec2::ZERO, &mut samples.leaves);
                samples.colors.push(color);
                samples.ends.push(samples.leaves.len());
            }
        }
        samples
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

    /// Returns the estimated error of each cell from its neighbours, as the root mean square of
    /// linear RGB. The outermost cells miss a neighbour, and their estimates mean nothing.
    pub fn errors(&self, charts: &[Charts]) -> Vec<f32> {
        let mut errors = vec![0.0_f32; self.colors.len()];
        let across = (self.columns.end - self.columns.start) as usize;
        // Changes of light from the cells above, column by column, and from the cell to the left.
        let mut from_above = vec![[0.0; 3]; across];
        for row in 0..self.colors.len() / across {
            let mut from_left = [0.0; 3];
            for column in 0..across {
                let own = row * across + column;
                if column + 1 < across {
                    let found = pair(self.of(own), self.of(own + 1), DVec2::X, charts);
                    errors[own] =
                        errors[own].max(found.errors[0]).max(step(from_left, found.light));
                    errors[own + 1] = errors[own + 1].max(found.errors[1]);
                    from_left = found.light;
                }
                if own + across < self.colors.len() {
                    let found = pair(self.of(own), self.of(own + across), DVec2::Y, charts);
                    let bend = step(from_above[column], found.light);
                    errors[own] = errors[own].max(found.errors[0]).max(bend);
                    errors[own + across] = errors[own + across].max(found.errors[1]);
                    from_above[column] = found.light;
                    for (step, there) in [(-1.0, column.checked_sub(1)), (1.0, Some(column + 1))] {
                        let Some(there) = there.filter(|&there| there < across) else { continue };
                        let other = own + across - column + there;
                        let found =
                            pair(self.of(own), self.of(other), DVec2::new(step, 1.0), charts);
                        errors[own] = errors[own].max(DIAGONAL * found.errors[0]);
                        errors[other] = errors[other].max(DIAGONAL * found.errors[1]);
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
