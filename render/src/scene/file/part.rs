//! A part of a scene, taken in by `include`, and what scenes and parts have in common.

use super::{LightFile, MaterialFile, ObjectFile, SceneFile, TextureFile, VERSION};
use files::names::each_name_once;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The value of `format` in a part of a scene.
pub const FORMAT: &str = "tb-scene-part";

/// A part of a scene as its file says it; nothing is checked but its types.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PartFile {
    /// Where an editor finds the schema of this file; passed over.
    #[serde(rename = "$schema")]
    pub schema: Option<String>,
    /// `tb-scene-part`.
    #[schemars(extend("const" = FORMAT))]
    pub format: String,
    /// 1.
    #[schemars(extend("const" = VERSION))]
    pub version: u32,
    /// Other parts, taken in before this one's own; paths count from this file's folder.
    #[serde(default)]
    pub include: Vec<PathBuf>,
    /// The lights; none if left out.
    #[serde(default)]
    pub lights: Vec<LightFile>,
    /// Pictures for surfaces, by names of one's choice.
    #[serde(default, deserialize_with = "each_name_once")]
    pub textures: BTreeMap<String, TextureFile>,
    /// What surfaces are made of, by names of one's choice.
    #[serde(default, deserialize_with = "each_name_once")]
    pub materials: BTreeMap<String, MaterialFile>,
    /// What there is to see; none if left out.
    #[serde(default)]
    pub objects: Vec<ObjectFile>,
}

/// What a scene and its parts have in common.
#[derive(Debug, Clone, Copy)]
pub struct Lists<'a> {
    /// The files to take in.
    pub include: &'a [PathBuf],
    /// The lights.
    pub lights: &'a [LightFile],
    /// The textures by name.
    pub textures: &'a BTreeMap<String, TextureFile>,
    /// The materials by name.
    pub materials: &'a BTreeMap<String, MaterialFile>,
    /// The objects.
    pub objects: &'a [ObjectFile],
}

impl SceneFile {
    /// What it has in common with parts.
    #[must_use]
    pub fn lists(&self) -> Lists<'_> {
        let Self { include, lights, textures, materials, objects, .. } = self;
        Lists { include, lights, textures, materials, objects }
    }
}

impl PartFile {
    /// What it has in common with scenes.
    #[must_use]
    pub fn lists(&self) -> Lists<'_> {
        let Self { include, lights, textures, materials, objects, .. } = self;
        Lists { include, lights, textures, materials, objects }
    }
}
