//! `textures` of a scene file.

use crate::texture::{Values, Wrap};
use serde::Deserialize;
use std::path::PathBuf;

/// One of `textures`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "see SceneFile")]
pub struct TextureFile {
    pub image: PathBuf,
    #[serde(default)]
    pub wrap: Wrap,
    #[serde(default)]
    pub values: Values,
}
