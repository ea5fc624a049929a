//! The listeners of the work on a picture, one of which may end the work early.

use super::Crop;
use super::exposure::Exposed;
use super::picture::Picture;
use std::fmt;

/// Asked before each tile, and before each row of an area sampled tile: false once the picture should be ended early.
/// After false it stays false.
pub type GoOn<'p> = dyn Fn() -> bool + Sync + 'p;

/// Told the finished tiles and all tiles of the picture.
pub type Told<'p> = dyn Fn(usize, usize) + Sync + 'p;

/// Shown each finished tile: its place in the whole picture, and its pixels, row by row, linear RGB. A tile that is made
/// again, with more rays, is shown again.
pub type Shown<'p> = dyn Fn(&Crop, &[[f32; 3]]) + Sync + 'p;

/// The listeners of the work on a picture. They are called from several threads.
#[derive(Clone, Copy)]
pub struct Course<'c> {
    /// Told after each tile.
    pub progress: &'c Told<'c>,
    /// Asked whether the work goes on.
    pub go_on: &'c GoOn<'c>,
    /// Shown each tile, if somebody watches.
    pub tile: Option<&'c Shown<'c>>,
}

impl<'c> Course<'c> {
    /// A course with a listener of its progress, which is never ended early.
    #[must_use]
    pub fn told(progress: &'c Told<'c>) -> Self {
        Self { progress, go_on: &|| true, tile: None }
    }

    /// Shows a tile as it is in the picture: a pixel that is not finite is black.
    pub(super) fn show(&self, tile: &Crop, exposed: &Exposed) {
        if let Some(shown) = self.tile {
            let mut alone = Picture::black(tile.width, tile.height);
            alone.place(0, 0, tile.width, &exposed.pixels);
            alone.remove_not_finite();
            shown(tile, &alone.pixels);
        }
    }
}

impl fmt::Debug for Course<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Course").finish_non_exhaustive()
    }
}
