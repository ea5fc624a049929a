//! Turntables: a camera that goes round the objects of a scene.
//!
//! The camera turns about an axis, so that the objects seem to turn counter-clockwise as seen from the tip of the
//! axis, and the lights stay with the objects. Nothing but the camera changes, so that meshes, trees and tables are
//! made once.

use super::{FPS_RANGE, MOST_FRAMES, within};
use files::JsonError;
use files::json::Document;
use files::schema::range;
use glam::{DQuat, DVec3};
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::Value;

/// Frames of a turntable unless a job states them.
pub const FRAMES: u32 = 48;

/// A turn of the camera about the objects of the scene. Nothing but the camera changes.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Turntable")]
pub struct TurntableFile {
    /// Number of frames, without `animate`; 48 if left out.
    #[serde(default)]
    #[schemars(transform = range(1..=MOST_FRAMES))]
    pub frames: Option<u32>,
    /// Frames per second, without `animate`; 24 if left out.
    #[serde(default)]
    #[schemars(transform = range(FPS_RANGE))]
    pub fps: Option<f64>,
    /// A point of the axis; the camera's target if left out.
    #[serde(default)]
    #[schemars(transform = range(-LARGEST..=LARGEST))]
    about: Option<[f64; 3]>,
    /// Direction of the axis; up if left out.
    #[serde(default = "up")]
    #[schemars(transform = range(-LARGEST..=LARGEST))]
    axis: [f64; 3],
    /// Number of turns over all frames, negative for clockwise; 1 if left out.
    #[serde(default = "once")]
    #[schemars(transform = range(-LARGEST..=LARGEST))]
    turns: f64,
}

fn up() -> [f64; 3] {
    [0.0, 1.0, 0.0]
}

fn once() -> f64 {
    1.0
}

/// A checked turntable.
#[derive(Debug, Clone, PartialEq)]
pub struct Turntable {
    about: Option<DVec3>,
    /// Unit vector.
    axis: DVec3,
    turns: f64,
}

/// Largest coordinate and number of turns.
const LARGEST: f64 = 1e6;

impl Turntable {
    /// Checks a turntable.
    ///
    /// # Errors
    /// When a number is out of its range, or the axis has no length.
    pub fn read(document: &Document<'_>, file: TurntableFile) -> Result<Self, JsonError> {
        let vector = |key: &str, vector: [f64; 3]| -> Result<DVec3, JsonError> {
            for (k, x) in vector.into_iter().enumerate() {
                within(document, &format!("turntable.{key}[{k}]"), x, -LARGEST..=LARGEST)?;
            }
            Ok(DVec3::from(vector))
        };
        let about = file.about.map(|about| vector("about", about)).transpose()?;
        let Some(axis) = vector("axis", file.axis)?.try_normalize() else {
            let message = "found an axis without a length, expected a direction such as [0, 1, 0]";
            return Err(document.fault("turntable.axis", message));
        };
        let turns = within(document, "turntable.turns", file.turns, -LARGEST..=LARGEST)?;
        Ok(Self { about, axis, turns })
    }

    /// Returns the camera's vectors at a time from 0 to 1, by their keys. `scene` is the text of the scene. A camera
    /// without an eye or a target stays as it is, and the reader of the scene says what it lacks.
    pub(super) fn camera(&self, scene: &[u8], time: f64) -> Vec<(&'static str, Vec<f64>)> {
        let scene: Value = serde_json::from_slice(scene).unwrap_or_default();
        let vector = |key: &str| {
            let three = |k: usize| scene["camera"][key].get(k)?.as_f64();
            Some(DVec3::new(three(0)?, three(1)?, three(2)?))
        };
        let (Some(eye), Some(target)) = (vector("eye"), vector("target")) else {
            return Vec::new();
        };
        let up = vector("up").unwrap_or(DVec3::Y);
        // Whole turns are left out, so that the first frame is that of the scene exactly.
        let turns = (self.turns * time).fract();
        if turns == 0.0 {
            return Vec::new();
        }
        let turn = DQuat::from_axis_angle(self.axis, -turns * std::f64::consts::TAU);
        let about = self.about.unwrap_or(target);
        let moved = |point: DVec3| (about + turn * (point - about)).to_array().to_vec();
        let turned = (turn * up).to_array().to_vec();
        vec![("eye", moved(eye)), ("target", moved(target)), ("up", turned)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &[u8] = br#"{"camera": {"eye": [3, 2, 5], "target": [1, 0, 0]}}"#;

    fn vectors(turntable: &Turntable, time: f64) -> Vec<DVec3> {
        let vectors = turntable.camera(SCENE, time).into_iter();
        vectors.map(|(_, vector)| DVec3::new(vector[0], vector[1], vector[2])).collect()
    }

    /// A quarter turn of the camera about the y axis leads from +z toward -x: the objects turn the other round.
    #[test]
    fn the_camera_goes_round_an_axis() {
        let about = Some(DVec3::new(1.0, 7.0, 0.0));
        let turntable = Turntable { about, axis: DVec3::Y, turns: 1.0 };
        let found = vectors(&turntable, 0.25);
        let truth = [DVec3::new(-4.0, 2.0, 2.0), DVec3::new(1.0, 0.0, 0.0), DVec3::Y];
        for (found, truth) in found.iter().zip(truth) {
            assert!(found.abs_diff_eq(truth, 1e-12), "{found} {truth}");
        }
        assert_eq!(vectors(&turntable, 0.0), []);
        let twice = Turntable { turns: -3.0, ..turntable.clone() };
        for (a, b) in vectors(&twice, 0.25).iter().zip(&found) {
            assert!(a.abs_diff_eq(*b, 1e-12));
        }
        // Without a point the target stays.
        let own = Turntable { about: None, axis: DVec3::X, turns: 1.0 };
        let [eye, target, up] = vectors(&own, 0.5)[..] else { panic!("three vectors") };
        assert!(target.abs_diff_eq(DVec3::X, 1e-12) && up.abs_diff_eq(DVec3::NEG_Y, 1e-12));
        assert!(eye.abs_diff_eq(DVec3::new(3.0, -2.0, -5.0), 1e-12), "{eye}");
    }
}
