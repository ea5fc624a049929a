//! Parts of a scene, which `include` adds, and the lists that scenes and parts have in common.

use super::{LightFile, MaterialFile, ObjectFile, SceneFile, TextureFile, VERSION};
use files::names::each_name_once;
use files::note::Note;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The value of `format` in a part of a scene.
pub const FORMAT: &str = "tb-scene-part";

/// The contents of a part of a scene, of which only the types are checked.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PartFile {
    /// Address of this file's JSON Schema, for editors; ignored by the program.
    #[serde(rename = "$schema")]
    pub schema: Option<String>,
    /// Format of this file: `tb-scene-part`.
    #[schemars(extend("const" = FORMAT))]
    pub format: String,
    /// Version of the format: 1.
    #[schemars(extend("const" = VERSION))]
    pub version: u32,
    /// Sentences for people; ignored by the program.
    pub note: Option<Note>,
    /// Other parts, added before the contents of this one; relative to this file's folder.
    #[serde(default)]
    pub include: Vec<PathBuf>,
    /// Lights of the part; none if left out.
    #[serde(default)]
    pub lights: Vec<LightFile>,
    /// Textures of surfaces, pictures or solids, by names of your choice; none if left out.
    #[serde(default, deserialize_with = "each_name_once")]
    pub textures: BTreeMap<String, TextureFile>,
    /// Materials of surfaces, by names of your choice; none if left out.
    #[serde(default, deserialize_with = "each_name_once")]
    pub materials: BTreeMap<String, MaterialFile>,
    /// Objects of the part; none if left out.
    #[serde(default)]
    pub objects: Vec<ObjectFile>,
}

/// The lists that a scene and its parts have in common.
#[derive(Debug, Clone, Copy)]
pub struct Lists<'a> {
    /// The files to include.
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
    /// Returns the lists that the scene has in common with parts.
    #[must_use]
    pub fn lists(&self) -> Lists<'_> {
        let Self { include, lights, textures, materials, objects, .. } = self;
        Lists { include, lights, textures, materials, objects }
    }
}

impl PartFile {
    /// Returns the lists that the part has in common with scenes.
    #[must_use]
    pub fn lists(&self) -> Lists<'_> {
        let Self { include, lights, textures, materials, objects, .. } = self;
        Lists { include, lights, textures, materials, objects }
    }
}
