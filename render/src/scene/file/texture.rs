//! `textures` of a scene file.

use crate::texture::{Values, Wrap};
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::PathBuf;

/// A picture for surfaces.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TextureFile {
    /// A PNG or JPEG file of 8 or 16 bits; its path counts from this file's folder.
    pub image: PathBuf,
    /// What lies beyond its edges; `repeat` if left out.
    #[serde(default)]
    pub wrap: Wrap,
    /// What its codes mean; `srgb` if left out.
    #[serde(default)]
    pub values: Values,
}
