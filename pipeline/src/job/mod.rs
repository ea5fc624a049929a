//! The job file: JSON, format `tb-job`, version 1.
//!
//! ```json
//! {
//!   "format": "tb-job", "version": 1,
//!   "title": "A porcelain vase on tiles",
//!   "caption": "Look at the far tiles, and at the lines on the neck.",
//!   "crops": [ { "title": "the far tiles", "at": [0.2, 0.45] } ],
//!   "meshes": { "vase": { "spec": "../curves/vase.json", "texture": 2, "surface": 0,
//!                         "mesh": { "rows": 60, "cols": 60 } } },
//!   "scene": "../scenes/vase.json",
//!   "modes": [
//!     { "name": "exact" },
//!     { "name": "accurate", "error": 0.005 },
//!     { "name": "fine", "samples": 2, "split": 0.01, "pixel_filter": "gaussian" },
//!     { "name": "point", "filter": "point", "sampling": "thesis" },
//!     { "name": "jittered", "filter": "tent", "sampling": "thesis", "samples": 4,
//!       "pattern": "jitter", "seed": 7, "pixel_filter": "tent" },
//!     { "name": "nine", "filter": "tent", "sampling": "thesis", "supersample": "image",
//!       "figure": "A.4", "thesis_minutes": 90 }
//!   ]
//! }
//! ```
//!
//! `meshes` names the spec of each mesh that the scene names, and the texture and surface ids of
//! its triangles. Ids that are left out are those of the spec, or 0. `mesh` holds keys that replace
//! those of the spec's resolution ([`sweep::spec::Resolution`]). The scene is rendered once in each
//! mode; without `modes`, once in a mode `exact`. Relative paths start at the job file's folder.
//!
//! The keys of a mode are flags of `render`. All but `name` may be left out:
//!
//! | key | values | default |
//! |---|---|---|
//! | `filter` | a texture filter, such as `exact` or `tent` | `exact` |
//! | `sampling` | `area`, or `thesis` for the thesis's lattice of rays | `area` |
//! | `error` | of `area`, instead of `samples` and `split`: a number or `"8bit"`, the error below which the picture must be | |
//! | `samples` | rays along each side of a pixel, 1 to 256 | 1 |
//! | `pixel_filter` | `box`, `tent` or `gaussian` | `box` |
//! | `split` | of `area`: a threshold from 0.0001 to 1 above which pixels are split, or `none` | 0.1 |
//! | `pattern`, `seed` | of `thesis`: `regular`, or `jitter` with a seed | `regular` |
//! | `supersample` | of `thesis`, instead of the other keys: `image` or `rays` | |
//! | `accel` | the acceleration structure: `bvh`, `grid` or `none` | `bvh` |
//!
//! `figure` names the figure of the thesis that the mode reproduces. The command line can request
//! the mode by this figure, which no other mode has. `thesis_minutes` is the time of that figure in
//! the thesis, in minutes.
//!
//! `animate` and `turntable` make a picture for each of many frames ([`crate::animation`]).
//!
//! `caption` and `crops` are for the book. Crops are positions, as fractions of width and height,
//! whose pixels are worth a close look.

use crate::animation::Animation;
use file::JobFile;
use files::json::Document;
use files::{JsonError, Source};
use serde::Deserialize;
use serde_json::json;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use sweep::spec;
use triangulate::Options;

pub mod figure;
mod file;
pub mod mode;
mod parts;
mod requested;
mod sampling;
mod select;

pub use file::{Place, schema};
pub use mode::Mode;
pub use parts::Parts;

use crate::PipelineError;

/// A job, checked. The files that the job names are not yet read.
#[derive(Debug, Clone)]
pub struct Job {
    /// The name of the job's files: the job file's name without its extension.
    pub name: String,
    /// The title of the job, one line.
    pub title: String,
    /// A few sentences about the picture, for its viewers; empty if the job has none.
    pub caption: String,
    /// Positions whose pixels are worth a close look.
    pub crops: Vec<Place>,
    /// The meshes to make, by the names that the scene gives them.
    pub meshes: Vec<MeshJob>,
    /// The scene file.
    pub scene: PathBuf,
    /// Values of the scene that the command line sets, as `PATH=VALUE`, for the texts in picture files.
    pub set: Vec<String>,
    /// The modes in which the scene is rendered, at least one.
    pub modes: Vec<Mode>,
    /// True if these are all modes of the job file. Otherwise the pictures are not put side by
    /// side.
    pub whole: bool,
    /// A further mode, whose picture is not put beside the others.
    pub further: Option<Mode>,
    /// The animation, if the job has one.
    pub animation: Option<Animation>,
    /// The frame of the animation whose pictures are made, from 1; `None` for the pictures without it.
    pub frame: Option<u32>,
    /// The parts in which each picture is made; `None` if it is made at once.
    pub parts: Option<Parts>,
}

/// A mesh to make.
#[derive(Debug, Clone)]
pub struct MeshJob {
    /// The name of the mesh in the scene.
    pub name: String,
    /// The curve spec.
    pub spec: PathBuf,
    /// The ids of its triangles.
    pub options: Options,
    /// Keys that replace those of the spec's resolution.
    pub resolution: spec::Resolution,
    /// The text of the job file, for the positions of complaints.
    text: Arc<JobText>,
}

/// The text of a job file, kept for complaints that arise only when its meshes are made.
#[derive(Debug)]
struct JobText {
    /// The file as the user named it.
    file: String,
    bytes: Vec<u8>,
}

impl MeshJob {
    /// Makes a complaint about the resolution that the job states for this mesh.
    ///
    /// The text is parsed for the position here, and not for each mesh of a job.
    pub(crate) fn resolution_fault(&self, message: String) -> JsonError {
        let path = format!("meshes.{}.mesh", self.name);
        match Document::new(&self.text.file, &self.text.bytes) {
            Ok(document) => document.fault(&path, message),
            Err(error) => error,
        }
    }
}

impl Job {
    /// Reads the job file at `path` in `source`. A scene file stands for the job of that scene alone.
    ///
    /// # Errors
    /// When the file cannot be read or is not a job of this version.
    pub fn read(path: &Path, source: &dyn Source) -> Result<Self, PipelineError> {
        let bytes = of_scene(path, source.read_json(path)?);
        let name = path.display().to_string();
        let folder = path.parent().unwrap_or(Path::new(""));
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        Ok(Self::parse(&name, &bytes, &stem, folder)?)
    }

    /// Returns the modes in which the scene is rendered, with the further one.
    pub fn all_modes(&self) -> impl Iterator<Item = &Mode> {
        self.modes.iter().chain(&self.further)
    }

    /// Returns the numbers of the thesis's figures that the job shows, ascending.
    #[must_use]
    pub fn figures(&self) -> Vec<u8> {
        let mut numbers: Vec<u8> = self.modes.iter().filter_map(Mode::figure_number).collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers
    }

    /// Returns the names of all files that the job writes; with `keep` also those of its grids and
    /// OBJ files.
    #[must_use]
    pub fn files(&self, keep: bool) -> Vec<String> {
        let kept = self.meshes.iter().filter(|_| keep);
        kept.flat_map(|mesh| [self.grid_file(mesh), self.obj_file(mesh)])
            .chain(self.all_modes().map(|mode| self.picture_file(mode)))
            .chain(self.strip_file())
            .collect()
    }

    /// Returns the file name of a mode's picture; the numbers of a frame and of a part stand before the extension.
    pub(crate) fn picture_file(&self, mode: &Mode) -> String {
        let frame = self.frame.map(|frame| format!(".{frame:04}")).unwrap_or_default();
        let tile = self.parts.and_then(Parts::tile);
        let part = tile.map(|tile| format!(".{}-of-{}", tile.number, tile.count));
        format!("{}-{}{frame}{}.png", self.name, mode.name, part.unwrap_or_default())
    }

    /// Returns the file name of all pictures side by side, if there are several.
    pub(crate) fn strip_file(&self) -> Option<String> {
        (self.whole && self.modes.len() > 1 && self.frame.is_none() && self.parts.is_none())
            .then(|| format!("{}.png", self.name))
    }

    /// Returns the file name of a mesh's grid.
    pub(crate) fn grid_file(&self, mesh: &MeshJob) -> String {
        format!("{}-{}.grid", self.name, mesh.name)
    }

    /// Returns the file name of a mesh's triangles.
    pub(crate) fn obj_file(&self, mesh: &MeshJob) -> String {
        format!("{}-{}.obj", self.name, mesh.name)
    }

    /// Reads a job from the bytes of a file. Relative paths start at `folder`.
    fn parse(file: &str, bytes: &[u8], name: &str, folder: &Path) -> Result<Self, JsonError> {
        let document = &Document::new(file, bytes)?;
        let text = Arc::new(JobText { file: file.into(), bytes: bytes.into() });
        document.expect("tb-job", 1)?;
        let file: JobFile = document.parse()?;
        for mesh in file.meshes.keys() {
            check_word(document, &format!("meshes.{mesh}"), mesh)?;
        }
        for (k, place) in file.crops.iter().enumerate() {
            if !place.at.iter().all(|fraction| (0.0..=1.0).contains(fraction)) {
                let message = format!("found {:?}, expected two fractions from 0 to 1", place.at);
                return Err(document.fault(&format!("crops[{k}].at"), message));
            }
        }
        let names: Vec<&str> = file.meshes.keys().map(String::as_str).collect();
        let animation = Animation::read(document, file.animate, file.turntable, &names)?;
        let meshes = file.meshes.into_iter().map(|(name, mesh)| MeshJob {
            text: Arc::clone(&text),
            name,
            spec: folder.join(mesh.spec),
            options: Options { texture: mesh.texture, surface: mesh.surface },
            resolution: mesh.mesh,
        });
        Ok(Self {
            name: name.into(),
            title: file.title,
            caption: file.caption,
            crops: file.crops,
            meshes: meshes.collect(),
            scene: folder.join(file.scene),
            set: Vec::new(),
            modes: mode::modes(document, file.modes)?,
            whole: true,
            further: None,
            animation,
            frame: None,
            parts: None,
        })
    }
}

/// Returns the text of the job of a scene alone, if the text at `path` is that of a scene, or else the text itself.
pub(crate) fn of_scene(path: &Path, text: Vec<u8>) -> Vec<u8> {
    #[derive(Deserialize)]
    struct Head {
        format: String,
    }
    let head: Option<Head> = serde_json::from_slice(&text).ok();
    let (Some(_), Some(name)) = (head.filter(|head| head.format == "tb-scene"), path.file_name())
    else {
        return text;
    };
    let job = json!({ "format": "tb-job", "version": 1, "scene": name.to_string_lossy() });
    job.to_string().into_bytes()
}

/// Checks a name that becomes part of file names.
fn check_word(document: &Document<'_>, path: &str, name: &str) -> Result<(), JsonError> {
    let plain = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | '.');
    if !name.is_empty() && !name.starts_with('.') && name.chars().all(plain) {
        return Ok(());
    }
    let message = format!("found name {name:?}, expected letters, digits, - and _");
    Err(document.fault(path, message))
}

#[cfg(test)]
mod tests {
    use super::*;
    use render::Sampling;
    use render::film::{Pattern, PixelFilter, Supersample};
    use render::filter::Filter;

    fn parse(text: &str) -> Result<Job, JsonError> {
        Job::parse("a.json", text.as_bytes(), "a", Path::new("jobs"))
    }

    #[test]
    fn the_example_on_this_page_is_a_job() {
        let page = include_str!("mod.rs");
        let lines = page.lines().skip_while(|line| *line != "//! ```json").skip(1);
        let text: String = lines
            .take_while(|line| *line != "//! ```")
            .map(|line| line.trim_start_matches("//!").to_string() + "\n")
            .collect();
        let job = parse(&text).unwrap();
        assert_eq!(job.meshes[0].options, Options { texture: Some(2), surface: Some(0) });
        assert_eq!(job.scene, Path::new("jobs/../scenes/vase.json"));
        let filters: Vec<Filter> = job.modes.iter().map(|mode| mode.filter).collect();
        let (exact, tent) = (Filter::Exact, Filter::Tent);
        assert_eq!(filters, [exact, exact, exact, Filter::Point, tent, tent]);
        let fine = PixelFilter::Gaussian;
        let fine = Sampling::Area { samples: 2, pixel_filter: fine, threshold: Some(0.01) };
        let pattern = Pattern::Jitter { seed: 7 };
        let jittered = Sampling::Grid { samples: 4, pattern, pixel_filter: PixelFilter::Tent };
        let nine = Sampling::Supersample(Supersample::Image);
        let samplings: Vec<Sampling> = job.modes.iter().map(|mode| mode.sampling).collect();
        let exact = Mode::exact();
        let whole = exact.sampling;
        assert_eq!(samplings, [whole, whole, fine, Sampling::regular(1), jittered, nine]);
        assert_eq!(job.modes[1].error, Some(0.005));
        assert_eq!(
            (job.modes[5].figure.as_deref(), job.modes[5].thesis_minutes),
            (Some("A.4"), Some(90))
        );
        assert_eq!(job.meshes[0].resolution.rows, Some(60));
        assert_eq!(job.crops[0].at, [0.2, 0.45]);
    }

    #[test]
    fn without_modes_the_scene_is_rendered_exactly() {
        let job = |modes: &str| {
            let start = "{\"format\": \"tb-job\", \"version\": 1, \"scene\": \"s.json\"";
            parse(&format!("{start}{modes}}}")).unwrap().modes
        };
        assert_eq!(job(""), [Mode::exact()]);
        // A mode without keys differs from the default mode only in its name.
        let named = Mode { name: "a".into(), ..Mode::exact() };
        assert_eq!(job(", \"modes\": [{\"name\": \"a\"}]"), [named]);
    }

    #[test]
    fn what_is_wrong_has_its_place() {
        let job = |rest: &str| {
            let text = format!("{{\"format\": \"tb-job\", \"version\": 1, {rest}}}");
            parse(&text).unwrap_err().to_string()
        };
        let scene = "\"scene\": \"s.json\"";
        for (rest, expected) in [
            (format!("{scene}, \"modes\": []"), "modes: found no modes"),
            (format!("{scene}, \"mods\": []"), "did you mean `modes`?"),
            (
                format!("{scene}, \"crops\": [{{\"title\": \"\", \"at\": [0, 1.5]}}]"),
                "crops[0].at: found [0.0, 1.5], expected two fractions",
            ),
            (
                format!(
                    "{scene}, \"meshes\": {{\"a\": {{\"spec\": \"b\"}}, \"a\": {{\"spec\": \"c\"}}}}"
                ),
                "meshes: duplicate key `a`",
            ),
            ("\"title\": \"no scene\"".into(), "missing key `scene`"),
        ] {
            let complaint = job(&rest);
            assert!(complaint.starts_with("a.json:1:"), "{complaint}");
            assert!(complaint.contains(expected), "{complaint}");
        }
        for (mode, expected) in [
            (r#""name": "../x""#, "modes[0].name: found name \"../x\""),
            (r#""name": "a", "filter": "tend""#, "did you mean `tent`?"),
            (r#""name": "a", "accel": "grids""#, "did you mean `grid`?"),
            (r#""name": "a", "samples": 0"#, "modes[0].samples: found 0, expected 1 to 256"),
            (r#""name": "a", "seed": 1"#, "modes[0].seed: found seed, expected it beside"),
            (r#""name": "a", "figure": "A.05""#, "modes[0].figure: found \"A.05\", expected a"),
        ] {
            let mode = format!("{{{mode}}}");
            let complaint = job(&format!("{scene}, \"modes\": [{mode}]"));
            assert!(complaint.contains(expected), "{complaint}");
        }
        let other = parse("{\"format\": \"tb-scene\", \"version\": 1, \"scene\": \"\"}");
        assert!(other.unwrap_err().to_string().contains("expected \"tb-job\""));
    }
}
