//! Traces and shades one cell, and keeps its leaves.

use super::Cell;
use super::leaf::{Leaf, Recorder};
use crate::color::Color;
use crate::film::exposure::{Exposed, Exposure, Witness};
use crate::footprint::Beam;
use crate::ray::Hit;
use crate::trace::tree::IntersectionTree;
use glam::DVec2;

/// A ray of a cell, and its weight among the samples of the first cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shot {
    /// The cell that the ray stands for.
    pub cell: Cell,
    /// Position of the ray from the middle of the cell, in units of its side.
    pub offset: DVec2,
    /// Weight of the sample, [0, 1]. The weights of all samples of a first cell sum to 1.
    pub weight: f64,
}

/// Traces and shades cells of one tile.
pub struct Sampler<'a, 'b> {
    /// Data of all tiles.
    pub shared: &'a Exposure<'b>,
    /// Counts, and layers.
    pub exposed: &'a mut Exposed,
    tree: IntersectionTree,
    open: Vec<(u64, Color)>,
}

impl<'a, 'b> Sampler<'a, 'b> {
    /// Starts a tile.
    pub fn new(shared: &'a Exposure<'b>, exposed: &'a mut Exposed) -> Self {
        Self { shared, exposed, tree: IntersectionTree::default(), open: Vec::new() }
    }

    /// Returns the colour of a cell, linear RGB, and appends its leaves to `leaves`. The ray is at
    /// `offset` from the middle of the cell, in units of its side.
    pub fn sample(&mut self, cell: Cell, offset: DVec2, leaves: &mut Vec<Leaf>) -> Color {
        self.sample_from(cell, offset, None, leaves)
    }

    /// Returns the colour of a cell as [`Sampler::sample`] does. `first` is the ray's closest hit, if it is
    /// known whether there is one.
    pub fn sample_from(
        &mut self,
        cell: Cell,
        offset: DVec2,
        first: Option<Option<Hit>>,
        leaves: &mut Vec<Leaf>,
    ) -> Color {
        self.trace(cell, offset, first);
        let Self { shared, exposed, tree, open } = self;
        let mut recorder = Recorder::new(&shared.shader, tree.through, leaves, open);
        shared.shader.shade(&Beam::of(tree, offset), &mut exposed.shading, &mut recorder)
    }

    /// Shows a sample to a witness.
    pub fn show<W: Witness>(&mut self, shot: &Shot, witness: &mut W) {
        self.trace(shot.cell, shot.offset, None);
        let Self { shared, exposed, tree, .. } = self;
        // The colour is known already.
        let _ = shared.shader.shade(&Beam::of(tree, shot.offset), &mut exposed.shading, witness);
    }

    /// Keeps the layers of a pixel, with the index `pixel` in the tile, from a ray through its middle.
    pub fn keep_layers(&mut self, pixel: usize, middle: DVec2) {
        self.trace(Cell { middle, side: 1.0 }, DVec2::ZERO, None);
        let Self { shared, exposed, tree, .. } = self;
        exposed.keep_layers(shared, pixel, &Beam::of(tree, DVec2::ZERO));
    }

    fn trace(&mut self, cell: Cell, offset: DVec2, first: Option<Option<Hit>>) {
        let position = cell.middle + cell.side * offset;
        let Self { shared, exposed, tree, .. } = self;
        shared.trace_spread(position, cell.side, first, tree, &mut exposed.rays);
    }
}
