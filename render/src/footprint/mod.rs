//! The part of a texture that a pixel sees.
//!
//! A [`Footprint`] separates tracing from texture filtering. Tracing knows nothing of textures, and
//! filtering knows nothing of rays. A sampling method computes a footprint from the nodes of
//! intersection trees. A filter averages a texture over the footprint. [`neighbours`] is the
//! thesis's sampling method. Another method adds a file to this module and, if it needs a new
//! shape, a variant of [`Footprint`].

pub mod neighbours;

use glam::DVec2;

/// A part of a texture, in texture coordinates. A texture fills the unit square, with `x` across
/// and `y` up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Footprint {
    /// One point. A filter still smooths the texture by the filter's smallest width.
    Point(DVec2),
    /// An axis-parallel rectangle.
    Rectangle {
        /// Middle of the rectangle.
        center: DVec2,
        /// Half the width and half the height of the rectangle, 0 or more.
        half: DVec2,
    },
}
