//! Animations of a job: values of its scene and of its specs that change from frame to frame.
//!
//! ```json
//! {
//!   "frames": 240, "fps": 24,
//!   "set": {
//!     "scene.camera.eye": { "keys": [[0, [4, 2, 5]], [1, [-4, 2, 5]]], "ease": "smooth" },
//!     "scene.lights[0].point.color": { "bezier": [[[0, 0], [0.5, 0], [0.5, 1], [1, 1]]] },
//!     "specs.knot.twist": { "total": 360 },
//!     "scene.camera.target": [0, { "total": 1 }, 0]
//!   },
//!   "loop": false
//! }
//! ```
//!
//! This is the key `animate` of a job file. A path of `set` is one of the command line's `-D`: in the
//! scene behind `scene.`, or in the spec of a mesh behind `specs.NAME.`. Its value is a number or a
//! list of numbers by a law ([`law`]) of the time, which runs from 0 in the first frame to 1 in the last one. With
//! `"loop": true` it ends a frame before 1, so that the first frame can follow the last.
//!
//! ```json
//! { "frames": 48, "fps": 24, "about": [0, 1, 0], "axis": [0, 1, 0], "turns": 1 }
//! ```
//!
//! This is the key `turntable`: the camera goes round the axis through `about`, so that the objects seem to turn
//! ([`turntable`]). With `animate` beside it, `frames` and `fps` are those of `animate`.
//!
//! Each frame is a job of its own, whose values are set: it has the same picture wherever and whenever it is made.

pub mod digest;
pub mod film;
pub mod frames;
pub mod law;
mod schema;
pub mod turntable;

use crate::{Job, PipelineError};
use files::json::Document;
use files::names::each_name_once;
use files::schema::range;
use files::{JsonError, Setting, Source};
use law::Law;
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::ops::RangeInclusive;
use turntable::{Turntable, TurntableFile};

/// Most frames of an animation.
pub const MOST_FRAMES: u32 = 1_000_000;

/// Frames per second unless a job states them.
const FPS: f64 = 24.0;

/// Range of frames per second.
const FPS_RANGE: RangeInclusive<f64> = 1e-3..=1e3;

/// The animation of a job, checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Animation {
    /// The number of frames, 1 to [`MOST_FRAMES`]. Frames are numbered from 1.
    pub frames: u32,
    /// Frames per second, 0.001 to 1000.
    pub fps: f64,
    /// True if the first frame follows the last.
    loops: bool,
    /// Paths with their laws.
    set: Vec<(String, Law)>,
    turntable: Option<Turntable>,
    /// True if the names of files have the number of their frame.
    is_numbered: bool,
}

/// Values of the scene and of specs that change from frame to frame.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Animation")]
pub struct AnimateFile {
    /// Number of frames.
    #[schemars(transform = range(1..=MOST_FRAMES))]
    frames: u32,
    /// Frames per second; 24 if left out.
    #[serde(default)]
    #[schemars(transform = range(FPS_RANGE))]
    fps: Option<f64>,
    /// Values by their paths, which are `scene.` and a path in the scene, or `specs.NAME.` and a path in the spec of
    /// a mesh, as `-D` takes them.
    #[serde(default, deserialize_with = "each_name_once")]
    #[schemars(with = "BTreeMap<String, schema::OverTime>")]
    set: BTreeMap<String, Value>,
    /// True if the first frame follows the last, which is then a step before the end.
    #[serde(default, rename = "loop")]
    loops: bool,
}

impl Animation {
    /// Checks the keys `animate` and `turntable` of a job. Returns `None` if it has none of them.
    ///
    /// # Errors
    /// With the position of a number out of its range, of a path that no setting can have, or of a law that is none.
    pub fn read(
        document: &Document<'_>,
        animate: Option<AnimateFile>,
        turntable: Option<TurntableFile>,
        meshes: &[&str],
    ) -> Result<Option<Self>, JsonError> {
        let (at, frames, fps) = match (&animate, &turntable) {
            (None, None) => return Ok(None),
            (Some(animate), Some(TurntableFile { frames: None, fps: None, .. }) | None) => {
                ("animate", animate.frames, animate.fps)
            }
            (Some(_), Some(turntable)) => {
                let key = if turntable.frames.is_some() { "frames" } else { "fps" };
                let message = format!("found {key} beside `animate`, expected it only there");
                return Err(document.fault(&format!("turntable.{key}"), message));
            }
            (None, Some(file)) => ("turntable", file.frames.unwrap_or(turntable::FRAMES), file.fps),
        };
        if !(1..=MOST_FRAMES).contains(&frames) {
            let message = format!("found {frames}, expected 1 to {MOST_FRAMES}");
            return Err(document.fault(&format!("{at}.frames"), message));
        }
        let fps = within(document, &format!("{at}.fps"), fps.unwrap_or(FPS), FPS_RANGE)?;
        let mut set = Vec::new();
        let loops = animate.as_ref().is_some_and(|animate| animate.loops);
        for (path, value) in animate.map(|animate| animate.set).unwrap_or_default() {
            let fault = |message: String| document.fault(&format!("animate.set.{path}"), message);
            check_path(&path, meshes).map_err(fault)?;
            set.push((path.clone(), Law::read(&value).map_err(fault)?));
        }
        let turntable = turntable.map(|file| Turntable::read(document, file)).transpose()?;
        Ok(Some(Self { frames, fps, loops, set, turntable, is_numbered: true }))
    }

    /// Returns the animation of a picture that does not change, with one frame, whose file has no number.
    #[must_use]
    pub fn still() -> Self {
        let (set, turntable) = (Vec::new(), None);
        Self { frames: 1, fps: FPS, loops: false, set, turntable, is_numbered: false }
    }

    /// Returns the time of a frame, from 0 to 1.
    fn time(&self, frame: u32) -> f64 {
        let steps = if self.loops { self.frames } else { self.frames - 1 };
        if steps == 0 { 0.0 } else { f64::from(frame - 1) / f64::from(steps) }
    }

    /// Returns the values that are set in a frame, without those of the turntable.
    fn laws(&self, frame: u32) -> Vec<Setting> {
        let time = self.time(frame);
        self.set.iter().filter_map(|(path, law)| setting(path, &law.at(time))).collect()
    }

    /// Returns all values that are set in a frame. `seen` returns the text of the job's scene with these
    /// settings; the turntable turns the camera of this scene.
    ///
    /// # Errors
    /// When the scene cannot be read.
    pub fn settings(
        &self,
        frame: u32,
        seen: impl FnOnce(&[Setting]) -> Result<Vec<u8>, PipelineError>,
    ) -> Result<Vec<Setting>, PipelineError> {
        let mut settings = self.laws(frame);
        if let Some(turntable) = &self.turntable {
            let text = seen(&settings)?;
            // A turn ends a frame before its start, which follows the last frame.
            let time = f64::from(frame - 1) / f64::from(self.frames);
            for (key, vector) in turntable.camera(&text, time) {
                settings.extend(setting(&format!("scene.camera.{key}"), &Value::from(vector)));
            }
        }
        Ok(settings)
    }

    /// Returns whether only the camera differs between frames.
    #[must_use]
    pub fn moves_camera_only(&self) -> bool {
        self.set.iter().all(|(path, _)| path.starts_with("scene.camera."))
    }

    /// Returns the job of a frame, with its own files.
    #[must_use]
    pub fn job(&self, job: &Job, frame: u32, settings: &[Setting]) -> Job {
        let own = settings.iter().filter_map(|setting| Some(setting.below("scene")?.text()));
        Job {
            set: job.set.iter().cloned().chain(own).collect(),
            frame: self.is_numbered.then_some(frame),
            further: None,
            ..job.clone()
        }
    }
}

/// Checks that a number is in a range. Returns the number.
fn within(
    document: &Document<'_>,
    path: &str,
    number: f64,
    range: RangeInclusive<f64>,
) -> Result<f64, JsonError> {
    if range.contains(&number) {
        return Ok(number);
    }
    let (low, high) = range.into_inner();
    Err(document.fault(path, format!("found {number}, expected {low} to {high}")))
}

/// Returns the setting of a value.
fn setting(path: &str, value: &Value) -> Option<Setting> {
    format!("{path}={value}").parse().ok()
}

/// Checks that a path names a value of the scene or of a spec.
fn check_path(path: &str, meshes: &[&str]) -> Result<(), String> {
    const EXPECTED: &str = "expected a path in the scene, such as scene.camera.eye, or in the spec of a \
                            mesh, such as specs.NAME.twist";
    let Ok(setting) = format!("{path}=0").parse::<Setting>() else {
        return Err(format!("found {path:?}, {EXPECTED}"));
    };
    if setting.below("scene").is_some() {
        return Ok(());
    }
    let (first, rest) = path.split_once('.').unwrap_or((path, ""));
    if first != "specs" {
        let near = files::json::nearest(first, ["scene", "specs"].into_iter());
        let near = near.map(|near| format!(" (did you mean `{near}`?)")).unwrap_or_default();
        return Err(format!("found {first:?}{near}, {EXPECTED}"));
    }
    let of_mesh =
        |name: &&str| setting.below("specs").is_some_and(|setting| setting.below(name).is_some());
    if meshes.iter().any(of_mesh) {
        return Ok(());
    }
    let name = rest.split(['.', '[']).next().unwrap_or_default();
    if meshes.contains(&name) {
        return Err(format!("found {path:?}, {EXPECTED}"));
    }
    let near = files::json::nearest(name, meshes.iter().copied());
    let near = near.map(|near| format!(" (did you mean `{near}`?)")).unwrap_or_default();
    let known = if meshes.is_empty() { "none".into() } else { meshes.join(", ") };
    Err(format!("found no mesh {name:?} of the job{near}, expected one of its meshes: {known}"))
}

/// Returns the text of a job's scene as `source` gives it.
///
/// # Errors
/// When the scene cannot be read.
pub fn scene_text(job: &Job, source: &dyn Source) -> Result<Vec<u8>, PipelineError> {
    Ok(source.read_json(&job.scene)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reads the contents of a job from its animation on.
    fn read(text: &str) -> Result<Animation, String> {
        #[derive(Deserialize)]
        struct Keys {
            animate: Option<AnimateFile>,
            turntable: Option<TurntableFile>,
        }
        let document = Document::new("a.json", text.as_bytes()).unwrap();
        let keys: Keys = document.parse().map_err(|error| error.to_string())?;
        let read = Animation::read(&document, keys.animate, keys.turntable, &["knot", "vase"]);
        read.map(Option::unwrap).map_err(|error| error.to_string())
    }

    /// The examples of the module's page, in their order.
    fn examples() -> [String; 2] {
        let page = include_str!("mod.rs");
        let mut parts = page.split("//! ```json\n").skip(1);
        [(); 2].map(|()| {
            let lines = parts.next().unwrap().lines().take_while(|line| *line != "//! ```");
            lines.map(|line| line.trim_start_matches("//!").to_string() + "\n").collect()
        })
    }

    fn texts(animation: &Animation, frame: u32) -> Vec<String> {
        animation.laws(frame).iter().map(Setting::text).collect()
    }

    #[test]
    fn the_examples_on_this_page_are_animations() {
        let [animate, turntable] = examples();
        let animation = read(&format!("{{\"animate\": {animate}}}")).unwrap();
        assert_eq!((animation.frames, animation.fps), (240, 24.0));
        let ends = [
            ["scene.camera.eye=[4,2,5]", "scene.camera.target=[0,0,0]"],
            ["scene.camera.eye=[-4,2,5]", "scene.camera.target=[0,1,0]"],
        ];
        let others = [
            ["scene.lights[0].point.color=0", "specs.knot.twist=0"],
            ["scene.lights[0].point.color=1", "specs.knot.twist=360"],
        ];
        for (k, frame) in [1, 240].into_iter().enumerate() {
            assert_eq!(texts(&animation, frame), [ends[k], others[k]].concat());
        }
        assert!(!animation.moves_camera_only());
        let animation = read(&format!("{{\"turntable\": {turntable}}}")).unwrap();
        assert_eq!((animation.frames, animation.moves_camera_only()), (48, true));
    }

    #[test]
    fn a_loop_ends_before_its_start() {
        let text =
            r#"{"animate": {"frames": 4, "set": {"scene.ambient": {"total": 1}}, "loop": LOOP}}"#;
        let at = |loops: &str, frame: u32| {
            texts(&read(&text.replace("LOOP", loops)).unwrap(), frame).remove(0)
        };
        assert_eq!([at("true", 1), at("true", 4)], ["scene.ambient=0", "scene.ambient=0.75"]);
        assert_eq!([at("false", 1), at("false", 4)], ["scene.ambient=0", "scene.ambient=1"]);
        let one = read(r#"{"animate": {"frames": 1, "set": {"scene.ambient": {"total": 1}}}}"#);
        assert_eq!(texts(&one.unwrap(), 1), ["scene.ambient=0"]);
    }

    #[test]
    fn what_is_wrong_has_its_place() {
        let set = |set: &str| format!(r#"{{"animate": {{"frames": 2, "set": {{{set}}}}}}}"#);
        for (text, parts) in [
            (
                r#"{"animate": {"frames": 0}}"#.to_string(),
                ["animate.frames: found 0", "1 to 1000000"],
            ),
            (
                r#"{"animate": {"frames": 2, "fps": 0}}"#.into(),
                ["animate.fps: found 0", "0.001 to"],
            ),
            (r#"{"animate": {"frame": 2}}"#.into(), ["frame", "did you mean `frames`?"]),
            (
                r#"{"animate": {"frames": 2}, "turntable": {"fps": 25}}"#.into(),
                ["turntable.fps: found fps beside `animate`", "expected it only there"],
            ),
            (r#"{"turntable": {"axis": [0, 0, 0]}}"#.into(), ["turntable.axis", "length"]),
            (set(r#""scenes.ambient": 1"#), ["did you mean `scene`?", "expected a path"]),
            (set(r#""scene": 1"#), ["found \"scene\"", "expected a path"]),
            (set(r#""specs.knit.mesh.rows": 1"#), ["(did you mean `knot`?)", "knot, vase"]),
            (set(r#""specs.knot": 1"#), ["found \"specs.knot\"", "expected a path"]),
            (set(r#""scene..eye": 1"#), ["found \"scene..eye\"", "expected a path"]),
            (set(r#""scene.ambient": "x""#), ["animate.set.scene.ambient: found \"x\"", "a law"]),
        ] {
            let said = read(&text).unwrap_err();
            assert!(
                said.starts_with("a.json:1:") && parts.iter().all(|part| said.contains(part)),
                "{said}"
            );
        }
    }
}
