//! What is behind everything, and colours by an angle.

use super::{Reader, SceneError};
use crate::scene::file::{BackgroundFile, ColorFile};
use crate::scene::{AngleRamp, Background};

impl Reader<'_> {
    pub(super) fn background(&self, file: &BackgroundFile) -> Result<Background, SceneError> {
        match file {
            BackgroundFile::Uniform(color) => {
                self.color("background", *color).map(Background::Uniform)
            }
            BackgroundFile::Sky(sky) => {
                let ramp =
                    self.colors_by_angle("background.by_elevation", &sky.by_elevation, -90.0)?;
                Ok(Background::ByElevation(ramp))
            }
        }
    }

    /// Colours at angles from `least` to 90 degrees.
    pub(super) fn colors_by_angle(
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
