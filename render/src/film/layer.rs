//! Layers of an EXR file: values of a pixel besides its colour.

use crate::footprint::Sight;
use crate::scene::Camera;
use crate::shade::Shader;
use std::str::FromStr;

/// Largest number of channels of a layer.
pub(super) const MOST_CHANNELS: usize = 3;

/// A value of each pixel besides its colour: of the first hit of its middle ray, or of the work that
/// was spent on it.
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
    /// The error that the method estimates for the pixel, root mean square of linear RGB. It steers
    /// the work and is no bound. It is 0 with the thesis's sampling, which estimates no error.
    Error,
    /// The number of rays from the eye that the pixel received.
    Rays,
}

impl Layer {
    /// All layers.
    pub const ALL: [Self; 7] = [
        Self::Normal,
        Self::Depth,
        Self::Uv,
        Self::Object,
        Self::Footprint,
        Self::Error,
        Self::Rays,
    ];

    /// Returns whether the layer shows the first hit of a ray, and not the work of the pixel.
    pub(super) fn is_of_hit(self) -> bool {
        match self {
            Self::Normal | Self::Depth | Self::Uv | Self::Object | Self::Footprint => true,
            Self::Error | Self::Rays => false,
        }
    }

    /// Name of the layer, as in settings.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Normal => "normal",
            Self::Depth => "depth",
            Self::Uv => "uv",
            Self::Object => "object",
            Self::Footprint => "footprint",
            Self::Error => "error",
            Self::Rays => "rays",
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
            Self::Error => &["error.V"],
            Self::Rays => &["rays.N"],
        }
    }

    /// Returns the values of the layer's channels for the root of a sight, followed by zeros. A layer
    /// of the pixel's work gives zeros.
    pub(super) fn values<S: Sight>(
        self,
        sight: &S,
        (shader, camera): (&Shader<'_>, &Camera),
    ) -> [f32; MOST_CHANNELS] {
        let Some(node) = sight.node() else {
            return match self {
                Self::Depth => [f32::INFINITY, 0.0, 0.0],
                Self::Object => [-1.0, 0.0, 0.0],
                Self::Normal | Self::Uv | Self::Footprint | Self::Error | Self::Rays => {
                    [0.0; MOST_CHANNELS]
                }
            };
        };
        match self {
            Self::Normal => node.normal.as_vec3().to_array(),
            Self::Depth => {
                let depth = camera.distance(node.position);
                [depth as f32, 0.0, 0.0]
            }
            Self::Uv => node.uv.as_vec2().extend(0.0).to_array(),
            Self::Object => [node.piece.object as f32, 0.0, 0.0],
            Self::Footprint => {
                let charts = &shader.charts[node.piece.object as usize];
                let (_, half) = sight.footprint(node, charts).bounds();
                (2.0 * half).as_vec2().extend(0.0).to_array()
            }
            // The work is known when the pixel is complete.
            Self::Error | Self::Rays => [0.0; MOST_CHANNELS],
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
