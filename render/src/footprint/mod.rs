//! Which piece of a texture a pixel sees.
//!
//! This is the seam of the renderer. Tracing knows nothing of textures, filters nothing of rays: a
//! way of sampling looks at the nodes of an intersection tree and makes a [`Footprint`], and a
//! filter averages a texture over it. [`neighbours`] is the thesis's way; another way adds a file
//! here and, if its shape is new, a variant below.

pub mod neighbours;

use glam::DVec2;

/// A piece of texture, in texture coordinates: across and up, a texture fills the unit square.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Footprint {
    /// One point; a filter still smooths it by its smallest width.
    Point(DVec2),
    /// An axis-parallel rectangle.
    Rectangle {
        /// Its middle.
        center: DVec2,
        /// Half its width and height, not negative.
        half: DVec2,
    },
}
