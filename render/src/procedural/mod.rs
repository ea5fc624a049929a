//! Textures that are computed and not looked up (thesis chapter 2).
//!
//! A solid texture gives every point of space a colour, as if objects were carved out of it. A bump
//! gives every point a height and perturbs normals as if the surface had this relief. Both use one
//! `noise` on a lattice ([`lattice`], [`noise`]), sums of this noise ([`turbulence`]) and patterns
//! without noise ([`blocks`]). Textures are evaluated in the object's own space, so that they move
//! with the object.
//!
//! The thesis evaluates them at the point that a ray hits; it filters pictures only. If a sampling
//! method knows the part of the surface that a ray stands for, solid textures are averaged over
//! this part ([`Solid::average`]).

mod averaged;
pub mod blocks;
mod blocks_average;
mod blur;
pub mod bump;
pub mod clouds;
mod convex;
mod curvature;
mod dnoise;
pub mod grains;
pub mod granite;
pub mod heights;
pub mod laid;
pub mod lattice;
pub mod marble;
mod moments;
pub mod noise;
mod noise_average;
pub mod normal_map;
mod patch;
pub mod placement;
mod probes;
pub mod ramp;
pub mod slopes;
#[cfg(test)]
mod tests;
pub mod turbulence;
pub mod wall;
mod wave;
pub mod wood;

pub use averaged::{AveragedNormal, PlaceChanges};
pub use bump::{Bump, Place, Relief};
pub use heights::Heights;
pub use lattice::NoiseLattice;
pub use noise::{Interpolation, Noise};
pub use normal_map::NormalMap;
pub use placement::Placement;
pub use ramp::Ramp;
pub use turbulence::Octaves;

use crate::color::Color;
use blocks::{Brick, Checker, Stripes};
use clouds::Clouds;
use glam::{DAffine3, DVec3};
use granite::Granite;
use marble::Marble;
use patch::Patch;
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
/// - an `average` over a patch, which is `color` if the patch is a point, and whose work is bounded;
/// - a variant here, and its arms in [`Solid::color`] and [`Solid::average`];
/// - its keys in scene files: a struct in `scene/file/solid.rs` and a variant of
///   [`TextureKind`](crate::scene::file::TextureKind), which states what a new key provides;
/// - tests: the pattern against its formula (`tests.rs` of this folder), its average
///   (`render/tests/solid_averages.rs`) and its complaints (`render/tests/solid_complaints.rs`);
/// - a texture in examples/scenes that shows the pattern.
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

    /// Returns the average colour over a parallelogram of the scene, linear RGB. `point` is its
    /// middle, and `steps` are two sides that meet at a corner. `to_own_space` maps the scene to
    /// the object's own space.
    ///
    /// Over a single point the average is [`Solid::color`]. If a step is infinite or NaN, the
    /// average is the mean over all space.
    #[must_use]
    pub fn average(&self, to_own_space: &DAffine3, point: DVec3, steps: [DVec3; 2]) -> Color {
        let own = Patch::mapped(to_own_space, point, steps);
        let patch = Patch::mapped(self.placement.map(), own.center, own.steps);
        if patch.is_point() || !patch.center.is_finite() {
            return self.color(to_own_space, point);
        }
        match &self.pattern {
            Pattern::Checker(checker) if patch.is_finite() => checker.average(&patch),
            Pattern::Checker(checker) => checker.mean(),
            Pattern::Stripes(stripes) if patch.is_finite() => stripes.average(&patch),
            Pattern::Stripes(stripes) => stripes.mean(),
            Pattern::Brick(brick) if patch.is_finite() => brick.average(&patch),
            Pattern::Brick(brick) => brick.mean(),
            Pattern::Marble(marble) => over_parts(&patch, OF_NOISE, |part| marble.average(part)),
            Pattern::Granite(granite) => {
                over_parts(&patch, OF_CRYSTALS, |part| granite.average(part))
            }
            Pattern::Wood(wood) => over_parts(&patch, OF_NOISE, |part| wood.average(part)),
            Pattern::Wall(wall) => over_parts(&patch, OF_NOISE, |part| wall.average(part)),
            Pattern::Clouds(clouds) => over_parts(&patch, OF_NOISE, |part| clouds.average(part)),
        }
    }
}

/// Lengths of a step, in units of the texture, from which a patch of noise is divided into this many
/// parts. More parts are more exact and cost time in proportion. From the last length on the
/// texture is nearly its mean.
const OF_NOISE: &[(f64, u32)] = &[(0.0, 1), (0.35, 2), (1.4, 3), (12.0, 1)];

/// Lengths as in [`OF_NOISE`] for crystals, whose edges are sharp in patches of any size.
const OF_CRYSTALS: &[(f64, u32)] = &[(0.0, 1), (0.05, 2), (0.8, 3), (6.0, 2), (12.0, 1)];

/// Returns the mean of the averages over the parts of a patch. A step that is not finite is
/// replaced by a very long one.
fn over_parts(patch: &Patch, finer: &[(f64, u32)], average: impl Fn(&Patch) -> Color) -> Color {
    let steps = patch.steps.map(|step| if step.is_finite() { step } else { FAR });
    let (patch, _) = Patch { steps, ..*patch }.cut(FAR.x);
    let (sum, count) = patch
        .parts(finer)
        .fold((Color::ZERO, 0.0), |(sum, count), part| (sum + average(&part), count + 1.0));
    sum / count
}

/// Step over which all noise of a texture averages out.
const FAR: DVec3 = DVec3::splat(1e6);
