//! Looking on while trees are shaded.
//!
//! Shading tells an observer of every branch that it follows. `()` looks at nothing and costs
//! nothing; what prints a pixel looks at everything, and so cannot differ from what is rendered.

use crate::color::Color;
use crate::footprint::Footprint;
use crate::footprint::neighbours::Neighbourhood;

/// How light comes along a branch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// Mirrored at the node before.
    Reflected,
    /// Through the node before.
    Refracted,
}

/// A texture's share in a colour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Textured {
    /// What was seen of it.
    pub footprint: Footprint,
    /// Its average there.
    pub average: Color,
}

/// The colour of a surface itself, without what it mirrors and lets through.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Local {
    /// The texture, if one was looked at.
    pub textured: Option<Textured>,
    /// The colour.
    pub color: Color,
}

/// What came along a branch.
#[derive(Debug)]
pub struct Seen<'a> {
    /// The branch, in the middle of its neighbours.
    pub around: &'a Neighbourhood<'a>,
    /// The colour of the surface that it came to, if it came to one.
    pub local: Option<Local>,
    /// The colour that is handed up.
    pub color: Color,
}

/// Is told of the branches of a tree, from the root down and back.
pub trait Observer {
    /// A branch of the node that was come to last, and is not left, is followed.
    fn follow(&mut self, way: Way);
    /// The branch that was followed last, and is not left, has its colour; the root too.
    fn leave(&mut self, seen: &Seen<'_>);
}

impl Observer for () {
    fn follow(&mut self, _: Way) {}
    fn leave(&mut self, _: &Seen<'_>) {}
}
