//! Observers that follow the shading of intersection trees.
//!
//! The shader reports every branch that it shades to an observer. The observer `()` ignores all
//! reports and costs nothing. The pixel inspector ([`crate::inspect`]) records them all, so its
//! output cannot differ from the rendered picture.

use crate::color::Color;
use crate::footprint::{Footprint, Sight};
use crate::trace::tree::{Child, Node};

/// The contribution of a texture to a surface's colour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Textured {
    /// The part of the texture that the node sees.
    pub footprint: Footprint,
    /// Average of the texture over the footprint, linear RGB.
    pub average: Color,
    /// Estimate of how much the average of a moved footprint differs, 0 to 1; see
    /// [`crate::filter::FilteredTexture::average_and_contrast`].
    pub contrast: f64,
}

/// The colour of a surface itself, without the reflected and refracted light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Local {
    /// The picture texture's contribution, if one was averaged.
    pub textured: Option<Textured>,
    /// The surface's own colour, linear RGB.
    pub color: Color,
    /// The surface's own colour if all its textures were white, linear RGB.
    pub plain: Color,
    /// The part of the footprint that a mask leaves of the surface, [0, 1]; 1 without a mask. Both colours
    /// are multiplied by it.
    pub coverage: f64,
}

/// A branch that has been shaded.
#[derive(Debug)]
pub struct Seen<'a, S> {
    /// The branch, and the rays near it.
    pub sight: &'a S,
    /// Colour of the surface that the branch hits, if the branch hits one.
    pub local: Option<Local>,
    /// Colour that the branch returns to its parent node, linear RGB, not yet multiplied by its
    /// weight.
    pub color: Color,
}

/// Receives the branches of a tree in the order of shading: depth first, from the root.
pub trait Observer {
    /// Called before a child of `node`, the current node, is shaded. `share` is the weight of the
    /// child's light in that of the node, linear RGB.
    fn follow(&mut self, node: &Node, child: Child, share: Color);
    /// Called when the current branch has its colour. The root is reported too, as the last branch.
    fn leave<S: Sight>(&mut self, seen: &Seen<'_, S>);
}

impl Observer for () {
    fn follow(&mut self, _: &Node, _: Child, _: Color) {}
    fn leave<S: Sight>(&mut self, _: &Seen<'_, S>) {}
}
