//! Cells that are split into four.

use super::Cell;
use super::compare::{pair, step};
use super::leaf::Leaf;
use super::sampler::{Sampler, Shot};
use crate::color::Color;
use glam::DVec2;

/// Largest number of times that a cell is split. The smallest cells have a side of 1/16 of the
/// first.
const DEEPEST: u32 = 4;

/// Distance of the four rays from the middles of their cells, in units of the cells' sides. The
/// rays then have four different positions along each axis (a rotated grid), so that edges which
/// are nearly upright or level get five shades and not three.
const TURNED: f64 = 0.25;

/// Part of the error of an edge that is left if all four parts of a cell agree: the edge then cuts at
/// most an eighth of the cell, or passes beside it.
const OF_HIDDEN: f64 = 0.5;

/// Weight of a cell's own sample beside those of its four parts, where no part is split again. It
/// is a fifth sample.
const OF_WHOLE: f64 = 0.2;

/// Positions of the four parts of a cell from its middle, in halves of its side, with the positions
/// of their rays from the middles of the parts, in units of [`TURNED`].
const PARTS: [(DVec2, DVec2); 4] = [
    (DVec2::new(-0.5, -0.5), DVec2::new(1.0, -1.0)),
    (DVec2::new(0.5, -0.5), DVec2::new(1.0, 1.0)),
    (DVec2::new(-0.5, 0.5), DVec2::new(-1.0, -1.0)),
    (DVec2::new(0.5, 0.5), DVec2::new(-1.0, 1.0)),
];

/// Neighbours among the four parts: two indices, and the distance from the first to the second.
const NEIGHBOURS: [(usize, usize, DVec2); 4] =
    [(0, 1, DVec2::X), (2, 3, DVec2::X), (0, 2, DVec2::Y), (1, 3, DVec2::Y)];

/// Splits cells of one tile.
pub struct Splitter<'s, 'a, 'b> {
    /// Estimated error times area, in pixels, above which a cell is split.
    threshold: f64,
    sampler: &'s mut Sampler<'a, 'b>,
    /// The samples and their weights, if they are wanted.
    shots: Option<&'s mut Vec<Shot>>,
    /// Leaves of the four parts of the cell in work, one part after the other.
    leaves: Vec<Leaf>,
    /// Sum of the squares of the estimated errors times area of all parts that are not split.
    left: f64,
}

impl<'s, 'a, 'b> Splitter<'s, 'a, 'b> {
    /// Starts a first cell. Adds all samples with a weight to `shots`, if given.
    pub fn new(
        threshold: f64,
        sampler: &'s mut Sampler<'a, 'b>,
        shots: Option<&'s mut Vec<Shot>>,
    ) -> Self {
        Self { threshold, sampler, shots, leaves: Vec::new(), left: 0.0 }
    }

    /// Returns the colour of a first cell from its parts, linear RGB, and the estimated error that is
    /// left, times area in pixels. `own` is the colour of the cell's own sample. `edge` is the error
    /// that an edge beside the cell's middle causes, root mean square of linear RGB.
    pub fn split(mut self, cell: Cell, own: Color, edge: f32) -> (Color, f64) {
        let first = Shot { cell, offset: DVec2::ZERO, weight: 1.0 };
        let color = self.divided(&first, own, 1, f64::from(edge) * cell.side * cell.side);
        (color, self.left.sqrt())
    }

    /// Returns the colour of a cell from its four parts. `whole` is the cell's own sample with the
    /// weight of the cell, and `depth` is the depth of its parts. `edge` is the error times area of
    /// an edge that is known to cut the cell or to pass beside it.
    fn divided(&mut self, whole: &Shot, own: Color, depth: u32, edge: f64) -> Color {
        let side = 0.5 * whole.cell.side;
        self.leaves.clear();
        let mut colors = [own; 4];
        let mut ends = [0; 5];
        let parts = PARTS.map(|(from_middle, ray)| {
            let middle = whole.cell.middle + side * from_middle;
            Shot { cell: Cell { middle, side }, offset: TURNED * ray, weight: 0.25 * whole.weight }
        });
        for (k, part) in parts.iter().enumerate() {
            colors[k] = self.sampler.sample(part.cell, part.offset, &mut self.leaves);
            ends[k + 1] = self.leaves.len();
        }
        let errors = self.errors(&ends);
        let splits =
            errors.map(|error| depth < DEEPEST && f64::from(error) * side * side > self.threshold);
        // All parts agree, though the cell's neighbours see an edge. It may cut a corner or a side of
        // the cell.
        let hidden = OF_HIDDEN * edge > self.threshold && !splits.contains(&true);
        let splits = if hidden { [true; 4] } else { splits };
        for (k, part) in parts.iter().enumerate() {
            if splits[k] {
                colors[k] = self.divided(part, colors[k], depth + 1, 0.0);
            } else {
                self.left += (f64::from(errors[k]) * side * side).powi(2);
            }
        }
        let mean = 0.25 * (colors[0] + colors[1] + colors[2] + colors[3]);
        let of_whole = if splits.contains(&true) { 0.0 } else { OF_WHOLE };
        if let Some(shots) = &mut self.shots {
            let unsplit = parts.iter().zip(splits).filter(|(_, splits)| !splits);
            let weighted =
                |(part, _): (&Shot, bool)| Shot { weight: part.weight * (1.0 - of_whole), ..*part };
            shots.extend(unsplit.map(weighted));
            let rest = Shot { weight: of_whole * whole.weight, ..*whole };
            shots.extend((of_whole > 0.0 || depth == 1).then_some(rest));
        }
        // Equal colours keep their value to the last bit.
        own + (1.0 - of_whole) * (mean - own)
    }

    /// Returns the estimated errors of the four parts, root mean square of linear RGB. `ends` are
    /// the ends of their leaves, after a 0.
    fn errors(&self, ends: &[usize; 5]) -> [f32; 4] {
        let of = |k: usize| &self.leaves[ends[k]..ends[k + 1]];
        let mut errors = [0.0_f32; 4];
        for (a, b, across) in NEIGHBOURS {
            let found = pair(of(a), of(b), across, self.sampler.shared.shader.charts);
            // Two samples do not tell a step of the light from an even change.
            let light = step([0.0; 3], found.light);
            errors[a] = errors[a].max(found.errors[0]).max(light);
            errors[b] = errors[b].max(found.errors[1]).max(light);
        }
        errors
    }
}
