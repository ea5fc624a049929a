//! The background of a scene file.

use super::SceneError;
use super::ranges::Ranges;
use crate::scene::Background;
use crate::scene::file::BackgroundFile;
use files::json::Document;

/// Reads the background: a colour or a sky.
pub(super) fn read(
    document: &Document<'_>,
    file: &BackgroundFile,
) -> Result<Background, SceneError> {
    match file {
        BackgroundFile::Uniform(color) => {
            document.color("background", *color).map(Background::Uniform)
        }
        BackgroundFile::Sky(sky) => {
            let ramp =
                document.colors_by_angle("background.by_elevation", &sky.by_elevation, -90.0)?;
            Ok(Background::ByElevation(ramp))
        }
    }
}
