//! The ranges of a scene file's numbers, checked where the file states them.

use super::SceneError;
use crate::color::Color;
use crate::scene::AngleRamp;
use crate::scene::file::ColorFile;
use crate::scene::limits::{LARGEST, SMALLEST};
use files::json::Document;
use glam::DVec3;

/// Checks of the values that one JSON document holds. `path` is the JSON path of the value; an error
/// names the file, line and column of this path.
pub(super) trait Ranges {
    /// The document that holds the values.
    fn document(&self) -> &Document<'_>;

    /// Fails with a message about the value at `path`.
    fn fault<T>(&self, path: &str, message: impl Into<String>) -> Result<T, SceneError> {
        Err(Document::fault(self.document(), path, message).into())
    }

    /// Returns the value if it lies in the closed range from `low` to `high`.
    fn within(&self, path: &str, value: f64, low: f64, high: f64) -> Result<f64, SceneError> {
        if (low..=high).contains(&value) {
            return Ok(value);
        }
        let range = if high == LARGEST && low == 0.0 {
            format!("at least 0 and at most {LARGEST:e}")
        } else {
            format!("{low} to {high}")
        };
        self.fault(path, format!("found {}, expected {range}", number(value)))
    }

    /// Returns the value if it lies between [`SMALLEST`] and [`LARGEST`].
    fn above_zero(&self, path: &str, value: f64) -> Result<f64, SceneError> {
        if (SMALLEST..=LARGEST).contains(&value) {
            return Ok(value);
        }
        let range = format!("more than 0: {SMALLEST:e} to {LARGEST:e}");
        self.fault(path, format!("found {}, expected {range}", number(value)))
    }

    /// Returns a point or a direction if no coordinate exceeds [`LARGEST`], whatever its sign.
    fn vector(&self, path: &str, coordinates: [f64; 3]) -> Result<DVec3, SceneError> {
        let too_large = |x: &f64| !(-LARGEST..=LARGEST).contains(x);
        match coordinates.iter().position(too_large) {
            None => Ok(coordinates.into()),
            Some(k) => {
                let found = number(coordinates[k]);
                let message = format!("found {found}, expected {:e} to {LARGEST:e}", -LARGEST);
                self.fault(&format!("{path}[{k}]"), message)
            }
        }
    }

    /// Returns a colour, linear RGB, if each channel lies between 0 and [`LARGEST`].
    fn color(&self, path: &str, color: ColorFile) -> Result<Color, SceneError> {
        for channel in color.0 {
            self.within(path, channel, 0.0, LARGEST)?;
        }
        Ok(Color::from(color.0))
    }

    /// Returns colours at ascending angles from `least` to 90 degrees.
    fn colors_by_angle(
        &self,
        at: &str,
        file: &[(f64, ColorFile)],
        least: f64,
    ) -> Result<AngleRamp, SceneError> {
        let mut stops = Vec::with_capacity(file.len());
        for (k, &(angle, color)) in file.iter().enumerate() {
            let angle = self.within(&format!("{at}[{k}][0]"), angle, least, 90.0)?;
            stops.push((angle, self.color(&format!("{at}[{k}][1]"), color)?));
        }
        match AngleRamp::new(stops) {
            Some(ramp) => Ok(ramp),
            None => self.fault(
                at,
                format!(
                    "found no angles, or angles that do not ascend; expected [degrees, colour] from \
                     {least} to 90, each angle larger than the one before"
                ),
            ),
        }
    }
}

impl Ranges for Document<'_> {
    fn document(&self) -> &Document<'_> {
        self
    }
}

/// Writes a number for a message: whole numbers without a point, very large and very small numbers
/// with a power of ten.
pub(super) fn number(value: f64) -> String {
    let usual = value == 0.0 || (1e-5..1e16).contains(&value.abs());
    if usual { value.to_string() } else { format!("{value:?}") }
}
