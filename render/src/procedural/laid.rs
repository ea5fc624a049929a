//! The place of a picture of heights or normals over texture coordinates.

use glam::DVec2;

/// A picture that is laid over texture coordinates and continues beyond the unit square.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Laid {
    /// Texels across and down.
    pub size: [usize; 2],
    /// Number of copies of the picture over the unit square, across and up. A negative number mirrors
    /// the picture.
    pub repeat: DVec2,
    /// Offset in copies of the picture, across and up.
    pub offset: DVec2,
}

impl Laid {
    /// Returns the place of a picture of this size that is laid `repeat` times from the origin.
    #[must_use]
    pub fn new(size: [usize; 2], repeat: DVec2) -> Self {
        Self { size, repeat, offset: DVec2::ZERO }
    }

    /// Number of texels per unit of texture coordinates.
    #[must_use]
    pub fn rate(&self) -> DVec2 {
        self.texels() * self.repeat
    }

    /// Converts texture coordinates to a position in texels, to the right and up from the lower left corner
    /// of a copy.
    #[must_use]
    pub fn at(&self, uv: DVec2) -> DVec2 {
        uv * self.rate() + self.offset * self.texels()
    }

    fn texels(&self) -> DVec2 {
        let [width, height] = self.size;
        DVec2::new(width as f64, height as f64)
    }
}
