//! Textures that are computed and not looked up (thesis chapter 2).
//!
//! A solid texture gives every point of space a colour, and an object is carved out of it. A bump
//! gives every point a height, and turns normals as if the surface had it. Both are made from one
//! `noise` on a lattice ([`lattice`], [`noise`]), from sums of it ([`turbulence`]) and from what
//! needs no noise ([`blocks`]). They are looked up in the object's own space, so that they move
//! with it, at the point that a ray hits: the thesis filters pictures only.

pub mod blocks;
pub mod bump;
pub mod clouds;
mod dnoise;
pub mod grains;
pub mod granite;
pub mod heights;
pub mod lattice;
pub mod marble;
pub mod noise;
pub mod placement;
pub mod ramp;
#[cfg(test)]
mod tests;
pub mod turbulence;
pub mod wall;
pub mod wood;

pub use bump::{Bump, Place, Relief};
pub use heights::Heights;
pub use lattice::NoiseLattice;
pub use noise::{Interpolation, Noise};
pub use placement::Placement;
pub use ramp::Ramp;
pub use turbulence::Octaves;

use crate::color::Color;
use blocks::{Brick, Checker, Stripes};
use clouds::Clouds;
use glam::{DAffine3, DVec3};
use granite::Granite;
use marble::Marble;
use std::sync::Arc;
use wall::WallPaint;
use wood::Wood;

/// All procedural textures of a scene.
#[derive(Debug, Clone, Default)]
pub struct Procedural {
    /// Solid textures; surfaces name them by their index.
    pub solids: Vec<Solid>,
    /// Bumps; materials name them by their index.
    pub bumps: Vec<Bump>,
    /// The random values that they share, if any of them needs noise.
    pub lattice: Option<Arc<NoiseLattice>>,
}

impl Procedural {
    /// Memory of the noise lattice, in bytes; 0 when there is none.
    #[must_use]
    pub fn lattice_bytes(&self) -> u64 {
        self.lattice.as_ref().map_or(0, |lattice| lattice.bytes() as u64)
    }
}

/// A texture that fills space.
#[derive(Debug, Clone, PartialEq)]
pub struct Solid {
    /// The pattern.
    pub pattern: Pattern,
    /// Where it lies in the object.
    pub placement: Placement,
}

/// What a solid texture shows, described in the texture's own space.
#[derive(Debug, Clone, PartialEq)]
pub enum Pattern {
    /// Veined stone.
    Marble(Marble),
    /// Crystals of several minerals.
    Granite(Granite),
    /// Rings around y.
    Wood(Wood),
    /// Clamped slow noise and fast noise.
    Wall(WallPaint),
    /// A sum of octaves.
    Clouds(Clouds),
    /// Cubes of two colours.
    Checker(Checker),
    /// Layers.
    Stripes(Stripes),
    /// Brickwork.
    Brick(Brick),
}

impl Solid {
    /// The colour at a point of the scene on an object with this way to its own space.
    #[must_use]
    pub fn color(&self, to_own_space: &DAffine3, point: DVec3) -> Color {
        let at = self.placement.to_texture(to_own_space.transform_point3(point));
        match &self.pattern {
            Pattern::Marble(marble) => marble.color(at),
            Pattern::Granite(granite) => granite.color(at),
            Pattern::Wood(wood) => wood.color(at),
            Pattern::Wall(wall) => wall.color(at),
            Pattern::Clouds(clouds) => clouds.color(at),
            Pattern::Checker(checker) => checker.color(at),
            Pattern::Stripes(stripes) => stripes.color(at),
            Pattern::Brick(brick) => brick.color(at),
        }
    }
}
