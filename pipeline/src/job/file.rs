//! The job file as it is written, and its JSON Schema.

use super::requested::Requested;
use super::sampling::Split;
use crate::animation::AnimateFile;
use crate::animation::turntable::TurntableFile;
use files::names::each_name_once;
use files::note::Note;
use files::schema::range;
use render::accel::Structure;
use render::film::{MOST_SAMPLES, PatternName, PixelFilter, SamplingMethod, Supersample};
use render::filter::Filter;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::PathBuf;
use sweep::spec;

/// Largest bound of numbers that have none of their own.
const LARGEST: f64 = 1e30;

/// A job: a scene, the meshes in it, and the modes in which it is rendered.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Job")]
pub(super) struct JobFile {
    /// Path or URL of this file's JSON Schema, for editors; ignored by the reader.
    #[serde(rename = "$schema", default)]
    #[expect(dead_code, reason = "read by editors only")]
    pub schema: Option<String>,
    /// The format, `tb-job`.
    #[expect(dead_code, reason = "looked at by Document::expect, and must be there")]
    #[schemars(extend("const" = "tb-job"))]
    pub format: String,
    /// The version of the format, 1.
    #[expect(dead_code, reason = "looked at by Document::expect, and must be there")]
    #[schemars(extend("const" = 1))]
    pub version: u32,
    /// Sentences for people; ignored by the reader.
    #[serde(default)]
    #[expect(dead_code, reason = "for people")]
    pub note: Option<Note>,
    /// The title of the picture, one line.
    #[serde(default)]
    pub title: String,
    /// A few sentences about the picture, for the book.
    #[serde(default)]
    pub caption: String,
    /// Positions whose pixels are worth a close look, for the book.
    #[serde(default)]
    pub crops: Vec<Place>,
    /// The meshes to make, by the names that the scene gives them. A name becomes part of file names.
    #[serde(default, deserialize_with = "each_name_once")]
    pub meshes: BTreeMap<String, MeshFile>,
    /// The scene file; its path is relative to the job's folder.
    pub scene: PathBuf,
    /// The modes in which the scene is rendered, at least one; if left out, one mode `exact`.
    #[serde(default)]
    #[schemars(length(min = 1))]
    pub modes: Option<Vec<ModeFile>>,
    /// Values of the scene and of specs that change from frame to frame.
    #[serde(default)]
    pub animate: Option<AnimateFile>,
    /// A turn of the camera about the objects.
    #[serde(default)]
    pub turntable: Option<TurntableFile>,
}

/// A position in a picture.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// Description of the picture at this position.
    pub title: String,
    /// The middle, as fractions of the width from the left and of the height from the top, both in
    /// [0, 1].
    #[schemars(transform = range(0.0..=1.0))]
    pub at: [f64; 2],
}

/// A mesh that is made from a spec.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "MeshOfJob")]
pub(super) struct MeshFile {
    /// The spec of the mesh; its path is relative to the job's folder.
    pub spec: PathBuf,
    /// Texture id of the triangles; if left out, that of the spec, or 0.
    #[serde(default)]
    #[schemars(transform = range(0..=u32::MAX))]
    pub texture: Option<u32>,
    /// Surface id of the triangles; if left out, that of the spec, or 0.
    #[serde(default)]
    #[schemars(transform = range(0..=u32::MAX))]
    pub surface: Option<u32>,
    /// Keys that replace those of the spec's `mesh`.
    #[serde(default)]
    #[schemars(schema_with = "overrides")]
    pub mesh: spec::Resolution,
}

/// A mode: settings by which the scene is rendered once. The keys are flags of `render`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Mode")]
pub(super) struct ModeFile {
    /// The name of the mode: letters, digits, `-`, `_` and `.`, not `.` first. The picture file is named after it.
    #[schemars(length(min = 1))]
    pub name: String,
    /// The filter that averages textures; `exact` if left out.
    #[serde(default)]
    pub filter: Option<Filter>,
    /// The structure that finds the hits. All structures give the same picture.
    #[serde(default)]
    pub accel: Structure,
    /// `area`, or `thesis` for the thesis's lattice of rays; `area` if left out.
    #[serde(default)]
    pub sampling: Option<SamplingMethod>,
    /// The error below which the picture must be, root mean square in linear light, instead of `samples` and `split`.
    #[serde(default)]
    pub error: Option<Requested>,
    /// Rays along each side of a pixel; 1 if left out.
    #[serde(default)]
    #[schemars(transform = range(1..=MOST_SAMPLES))]
    pub samples: Option<u32>,
    /// Of `area`: the threshold above which pixels are split, or `none`; 0.1 if left out.
    #[serde(default)]
    pub split: Option<Split>,
    /// Of `thesis`: the positions of the rays in their cells; `regular` if left out.
    #[serde(default)]
    pub pattern: Option<PatternName>,
    /// Of the pattern `jitter`: the seed of its hash; 0 if left out.
    #[serde(default)]
    pub seed: Option<u64>,
    /// Weights of the rays in a pixel; `box` if left out. Of `thesis`, the others need `samples` of at least 2.
    #[serde(default)]
    pub pixel_filter: Option<PixelFilter>,
    /// Of `thesis`, instead of `samples`, `pattern`, `seed` and `pixel_filter`: nine rays for each pixel.
    #[serde(default)]
    pub supersample: Option<Supersample>,
    /// The figure of the thesis that the mode reproduces, such as `A.5`. The command line can request the mode by it.
    #[serde(default)]
    pub figure: Option<String>,
    /// The time of that figure in the thesis, in minutes.
    #[serde(default)]
    #[schemars(transform = range(0..=u32::MAX))]
    pub thesis_minutes: Option<u32>,
}

/// Returns the schema of the keys of a resolution, which need not be a whole resolution here.
fn overrides(generator: &mut SchemaGenerator) -> Schema {
    let mut schema = spec::Resolution::json_schema(generator);
    // A resolution states these keywords about its keys together.
    let whole = schema.ensure_object();
    for keyword in ["oneOf", "anyOf", "allOf", "required", "dependentRequired", "not"] {
        whole.remove(keyword);
    }
    schema
}

/// Returns the JSON Schema of jobs.
#[must_use]
pub fn schema() -> Value {
    let mut generator = files::schema::generator(LARGEST);
    let job = generator.subschema_for::<JobFile>();
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "tb-job",
        "description": "A job of `pipeline`: a scene, the specs of its meshes, and the modes in which it is rendered. \
                        Paths are relative to the folder of the file.",
        "type": "object",
        "allOf": [job],
        "$defs": generator.take_definitions(true),
    })
}
