//! The light of rays that leave the scene.

use super::{Shader, View};
use crate::color::Color;
use crate::footprint::Footprint;
use crate::scene::Background;
use crate::trace::tree::Away;

impl Shader<'_> {
    /// Returns the light of the background along a ray, linear RGB, and the light that is reported to
    /// observers. `through` is true if the background shows behind the scene, and false if surfaces
    /// mirror it. A transparent background is reported as white, whatever lies before it.
    pub(super) fn background(&self, away: Away, through: bool) -> [Color; 2] {
        match (self.view, through) {
            (View::Foreground, true) => [Color::ZERO, Color::ONE],
            (View::Coverage, true) => [Color::ONE; 2],
            (View::Coverage, false) => [Color::ZERO, self.background_light(away)],
            (View::Whole, _) | (View::Foreground, false) => [self.background_light(away); 2],
        }
    }

    /// Returns the light of the background, averaged over the directions that the ray stands for if the
    /// background is a picture.
    fn background_light(&self, away: Away) -> Color {
        let Background::Picture(environment) = &self.scene.background else {
            return self.scene.background.toward(away.direction);
        };
        let Some(texture) = self.textures[environment.texture].as_ref() else { return Color::ZERO };
        let (center, sides) =
            environment.coordinates(away.direction, away.changes.unwrap_or_default());
        let known = away.changes.is_some() && sides.iter().all(|side| side.is_finite());
        let footprint = if known {
            Footprint::Parallelogram { center, sides }
        } else {
            Footprint::Point(center)
        };
        texture.average(&texture.between_poles(footprint))
    }
}
