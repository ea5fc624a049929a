//! Observers that follow the shading of intersection trees.
//!
//! The shader reports every branch that it shades to an observer. The observer `()` ignores all
//! reports and costs nothing. The pixel inspector ([`crate::inspect`]) records them all, so its
//! output cannot differ from the rendered picture.

use crate::color::Color;
use crate::footprint::Footprint;
use crate::footprint::neighbours::Neighbourhood;

/// How a branch continues the path of light at its parent node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// The branch starts with the ray that its parent node mirrors.
    Reflected,
    /// The branch starts with the ray that passes through its parent node.
    Refracted,
}

/// The contribution of a texture to a surface's colour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Textured {
    /// The part of the texture that the node sees.
    pub footprint: Footprint,
    /// Average of the texture over the footprint, linear RGB.
    pub average: Color,
}

/// The colour of a surface itself, without the reflected and refracted light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Local {
    /// The picture texture's contribution, if one was averaged.
    pub textured: Option<Textured>,
    /// The surface's own colour, linear RGB.
    pub color: Color,
}

/// A branch that has been shaded.
#[derive(Debug)]
pub struct Seen<'a> {
    /// The branch and its neighbours; the branch is the middle one.
    pub around: &'a Neighbourhood<'a>,
    /// Colour of the surface that the branch hits, if the branch hits one.
    pub local: Option<Local>,
    /// Colour that the branch returns to its parent node, linear RGB, not yet multiplied by its
    /// weight.
    pub color: Color,
}

/// Receives the branches of a tree in the order of shading: depth first, from the root.
pub trait Observer {
    /// Called before a child of the current node is shaded.
    fn follow(&mut self, way: Way);
    /// Called when the current branch has its colour. The root is reported too, as the last branch.
    fn leave(&mut self, seen: &Seen<'_>);
}

impl Observer for () {
    fn follow(&mut self, _: Way) {}
    fn leave(&mut self, _: &Seen<'_>) {}
}
