//! Textures that are computed and not looked up (thesis chapter 2).
//!
//! A solid texture gives every point of space a colour, as if objects were carved out of it. A bump
//! gives every point a height and perturbs normals as if the surface had this relief. Both use one
//! `noise` on a lattice ([`lattice`], [`noise`]), sums of this noise ([`turbulence`]) and patterns
//! without noise ([`blocks`]). Textures are evaluated in the object's own space, so that they move
//! with the object. They are evaluated at the point that a ray hits: the thesis filters pictures
//! only.

mod averaged;
pub mod blocks;
pub mod bump;
pub mod clouds;
mod curvature;
mod dnoise;
pub mod grains;
pub mod granite;
pub mod heights;
pub mod lattice;
pub mod marble;
mod moments;
pub mod noise;
pub mod placement;
mod probes;
pub mod ramp;
pub mod slopes;
#[cfg(test)]
mod tests;
pub mod turbulence;
pub mod wall;
pub mod wood;

pub use averaged::{AveragedNormal, PlaceChanges};
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
    /// Solid textures; surfaces refer to them by index.
    pub solids: Vec<Solid>,
    /// Bumps; materials refer to them by index.
    pub bumps: Vec<Bump>,
    /// The lattice of random values that all noises share, if any is used.
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
    /// Position of the texture in the object.
    pub placement: Placement,
}

/// The pattern of a solid texture, defined in the texture's own space.
///
/// A new pattern provides, and the compiler leads to each `match`:
///
/// - a file in this folder with the pattern and its `color`, a linear RGB that is finite at every
///   point, also far from the origin;
/// - a variant here, and its arm in [`Solid::color`];
/// - its keys in scene files: a struct in `scene/file/solid.rs` and a variant of
///   [`TextureKind`](crate::scene::file::TextureKind), which states what a new key provides;
/// - tests: the pattern against its formula (`tests.rs` of this folder), and its complaints
///   (`render/tests/solid_complaints.rs`); a texture in examples/scenes shows the pattern.
#[derive(Debug, Clone, PartialEq)]
pub enum Pattern {
    /// Veined stone.
    Marble(Marble),
    /// Crystals of several minerals.
    Granite(Granite),
    /// Rings around the axis y.
    Wood(Wood),
    /// Clamped slow noise plus fast noise.
    Wall(WallPaint),
    /// A sum of octaves.
    Clouds(Clouds),
    /// Cubes of two alternating colours.
    Checker(Checker),
    /// Repeating layers along x.
    Stripes(Stripes),
    /// Brickwork.
    Brick(Brick),
}

impl Solid {
    /// Returns the colour at `point`, a point of the scene, linear RGB. `to_own_space` maps the
    /// scene to the object's own space.
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
