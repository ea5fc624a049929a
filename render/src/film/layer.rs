//! What a pixel shows, besides its colour: layers of an EXR file.

use crate::footprint::Footprint;
use crate::footprint::neighbours::Neighbourhood;
use crate::shade::Shader;
use std::str::FromStr;

/// A kind of value that is kept of what each pixel's middle ray hits first.
///
/// Where a pixel has several rays, a layer holds the value of the one in its middle, or the first
/// right of it and below: nothing is averaged, so an object's number is that of an object and a
/// normal is unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Layer {
    /// The unit normal that is shaded with, in the scene's space, on the side that is seen; 0
    /// where there is nothing.
    Normal,
    /// The distance from the eye along the ray, in the scene's units; infinite where there is
    /// nothing.
    Depth,
    /// Texture coordinates; 0 where there is nothing.
    Uv,
    /// The number of the object in the scene's list, from 0; -1 where there is nothing.
    Object,
    /// Width and height of the rectangle of texture that is averaged, in texture coordinates; 0
    /// for a point, where there is nothing, and everywhere if no neighbours are looked at (no
    /// texture is shown, or the filter looks at points).
    Footprint,
}

impl Layer {
    /// Every layer there is.
    pub const ALL: [Self; 5] = [Self::Normal, Self::Depth, Self::Uv, Self::Object, Self::Footprint];

    /// What it is called.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Normal => "normal",
            Self::Depth => "depth",
            Self::Uv => "uv",
            Self::Object => "object",
            Self::Footprint => "footprint",
        }
    }

    /// What its channels are called in the file.
    #[must_use]
    pub fn channels(self) -> &'static [&'static str] {
        match self {
            Self::Normal => &["normal.X", "normal.Y", "normal.Z"],
            Self::Depth => &["depth.Z"],
            Self::Uv => &["uv.U", "uv.V"],
            Self::Object => &["object.id"],
            Self::Footprint => &["footprint.W", "footprint.H"],
        }
    }

    /// Adds the values of its channels for the root of a tree.
    pub(super) fn push(self, around: &Neighbourhood<'_>, shader: &Shader<'_>, to: &mut Vec<f32>) {
        let Some(node) = around.node() else {
            let nothing = match self {
                Self::Depth => f32::INFINITY,
                Self::Object => -1.0,
                _ => 0.0,
            };
            to.extend(self.channels().iter().map(|_| nothing));
            return;
        };
        match self {
            Self::Normal => to.extend(node.normal.as_vec3().to_array()),
            Self::Depth => {
                to.push((node.position - shader.scene.camera.eye()).length() as f32);
            }
            Self::Uv => to.extend(node.uv.as_vec2().to_array()),
            Self::Object => to.push(node.piece.object as f32),
            Self::Footprint => {
                let charts = &shader.charts[node.piece.object as usize];
                let size = match around.footprint(node, charts) {
                    Footprint::Point(_) => [0.0; 2],
                    Footprint::Rectangle { half, .. } => (2.0 * half).as_vec2().to_array(),
                };
                to.extend(size);
            }
        }
    }
}

impl FromStr for Layer {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        Self::ALL.into_iter().find(|layer| layer.name() == name).ok_or_else(|| {
            let names = Self::ALL.map(Self::name).join(", ");
            format!("expected some of {names}, with commas between them")
        })
    }
}
