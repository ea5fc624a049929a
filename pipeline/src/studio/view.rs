//! The view of a picture: its size, its requested error, and the method of the thesis beside it.

use render::accuracy;
use render::film::{PixelFilter, THRESHOLD};
use render::filter::Filter;
use render::{Sampling, Settings};
use serde::{Deserialize, Serialize};

/// Smallest and largest side of a picture, in pixels.
const SIDES: [u32; 2] = [16, 2048];

/// The view of a picture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct View {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The requested error, root mean square in linear light; `None` for a picture of one ray per pixel that is divided
    /// at edges.
    pub error: Option<f64>,
    /// The method of the picture beside it, if there is one.
    pub beside: Option<Method>,
}

/// A method of the thesis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Textures at points, one ray per pixel.
    Point,
    /// Textures prefiltered under a tent, one ray per pixel.
    Prefiltered,
    /// Textures prefiltered under a tent, nine rays per pixel.
    Supersampled,
}

impl Default for View {
    fn default() -> Self {
        Self { size: [512, 512], error: Some(0.01), beside: None }
    }
}

impl View {
    /// Checks the numbers of a view.
    ///
    /// # Errors
    /// When a number is out of its range. The error is a sentence.
    pub fn check(&self) -> Result<(), String> {
        let [least, most] = SIDES;
        if !self.size.iter().all(|side| (least..=most).contains(side)) {
            return Err(format!(
                "found a picture of {:?}, expected sides of {least} to {most}",
                self.size
            ));
        }
        self.error.map_or(Ok(()), accuracy::check)
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn pixels(&self) -> (u32, u32) {
        (self.size[0], self.size[1])
    }

    /// Returns the settings of the whole picture without a requested error.
    #[must_use]
    pub fn settings(&self) -> Settings {
        let (width, height) = self.pixels();
        let (pixel_filter, threshold) = (PixelFilter::Box, Some(THRESHOLD));
        let sampling = Sampling::Area { samples: 1, pixel_filter, threshold };
        Settings { sampling, ..Settings::new(width, height, Filter::Exact) }
    }
}

impl Method {
    /// Returns the filter and the sampling of the method.
    #[must_use]
    pub fn settings(self, (width, height): (u32, u32)) -> Settings {
        let (filter, samples) = match self {
            Self::Point => (Filter::Point, 1),
            Self::Prefiltered => (Filter::Tent, 1),
            Self::Supersampled => (Filter::Tent, 3),
        };
        Settings::new(width, height, filter).with_samples(samples)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_errors_have_limits() {
        let view = View::default();
        assert!(view.check().is_ok());
        assert!(View { size: [512, 4096], ..view.clone() }.check().is_err());
        assert!(View { error: Some(0.0), ..view.clone() }.check().is_err());
        assert!(View { error: None, ..view }.check().is_ok());
    }
}
