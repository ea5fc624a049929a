//! Layers of an EXR file: values of a pixel besides its colour.

use crate::footprint::Footprint;
use crate::footprint::neighbours::Neighbourhood;
use crate::shade::Shader;
use std::str::FromStr;

/// A value of the first hit of each pixel's middle ray.
///
/// If a pixel has several rays, a layer holds the value of the middle ray. If no ray is in the
/// middle, it holds the value of the first ray to the right and below. Nothing is averaged, so an
/// object's number always belongs to an object, and a normal is always a unit vector.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Layer {
    /// The unit normal used for shading, in scene space, on the side that is seen. It is 0 where
    /// the ray hits nothing.
    Normal,
    /// The distance from the eye along the ray, in scene units. It is infinite where the ray hits
    /// nothing.
    Depth,
    /// Texture coordinates. They are 0 where the ray hits nothing.
    Uv,
    /// The object's index in the scene's list, from 0. It is -1 where the ray hits nothing.
    Object,
    /// Width and height of the rectangle of texture that is averaged, in texture coordinates. They
    /// are 0 for a point and where the ray hits nothing. They are 0 everywhere if no neighbours are
    /// traced: no texture is shown, or the filter averages over points only.
    Footprint,
}

impl Layer {
    /// All layers.
    pub const ALL: [Self; 5] = [Self::Normal, Self::Depth, Self::Uv, Self::Object, Self::Footprint];

    /// Name of the layer, as in settings.
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

    /// Names of the layer's channels in the file.
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

    /// Appends the values of the layer's channels for the root of the tree in the middle of
    /// `around`.
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
