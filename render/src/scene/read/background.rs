//! The background of a scene file.

use super::ranges::Ranges;
use super::textures::Kind;
use super::{Reader, SceneError};
use crate::color::Color;
use crate::scene::file::BackgroundFile;
use crate::scene::{Background, Environment, Scene};
use files::json::Document;

/// Reads the background: a colour or a sky. A picture stays black until [`Reader::environment`] reads it.
pub(super) fn read(
    document: &Document<'_>,
    file: &BackgroundFile,
) -> Result<Background, SceneError> {
    match file {
        BackgroundFile::Nothing => Ok(Background::Uniform(Color::ZERO)),
        BackgroundFile::Uniform(color) => {
            document.color("background", *color).map(Background::Uniform)
        }
        BackgroundFile::Sky(sky) => {
            let ramp =
                document.colors_by_angle("background.by_elevation", &sky.by_elevation, -90.0)?;
            Ok(Background::ByElevation(ramp))
        }
        BackgroundFile::Picture(picture) => {
            document.within("background.turn_deg", picture.turn_deg, -1e6, 1e6)?;
            Ok(Background::Uniform(Color::ZERO))
        }
    }
}

impl Reader<'_> {
    /// Reads the picture of the background, if it has one, as the scene's last texture.
    pub(super) fn environment(
        &self,
        file: &BackgroundFile,
        scene: &mut Scene,
    ) -> Result<(), SceneError> {
        let BackgroundFile::Picture(file) = file else { return Ok(()) };
        let path = self.folder.join(&file.picture);
        let texels = self.texels("background.picture", &path, Kind::default())?;
        scene.background = Background::Picture(Environment {
            texture: scene.textures.len(),
            turn: file.turn_deg.to_radians(),
        });
        scene.textures.push(texels);
        scene.names.textures.push("of the background".into());
        Ok(())
    }
}
