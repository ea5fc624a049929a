//! Slow pans over a fine texture, as scenes: seen directly, in a curved mirror, and through glass.
//!
//! In each frame the camera is a small step further to the right, and so is the point that it looks at. Nothing else
//! moves. The texture is the one of the scenes on which other renderers were measured: checks of high contrast, which
//! repeat. The surfaces are unlit, so that all light is that of the texture. They fill the film, so that the border of no
//! object is seen: all errors are those of the texture.

use crate::{PipelineError, pages};
use files::json::Document;
use glam::DVec3;
use render::Scene;
use render::scene::{Camera, MeshSource, read};
use std::path::Path;

/// A slow pan.
#[derive(Debug)]
pub struct Pan {
    /// Its name, for files and tables.
    pub name: &'static str,
    /// Its title.
    pub title: &'static str,
    /// The scene with the camera of the first frame.
    pub scene: Scene,
    camera: Track,
}

/// The path of a camera.
#[derive(Debug, Clone, Copy)]
struct Track {
    eye: [f64; 3],
    target: [f64; 3],
    fov_deg: f64,
    /// Length of the step between two frames, along x, in scene units.
    step: f64,
}

/// A floor that is seen at a slant, from 3.3 to 20 units away. A pixel of 96 x 64 holds a fifth of a check in front, and more than
/// three checks behind. The step is an eighth of a pixel in the middle of the picture.
const DIRECT: Track =
    Track { eye: [0.0, 1.5, 0.0], target: [0.0, 0.0, -5.6], fov_deg: 22.0, step: 0.005 };

/// A mirror sphere, which shows a wall behind the camera. A pixel in the middle holds a check, and the step is an eighth of it.
const MIRROR: Track =
    Track { eye: [-0.06, 0.0, 3.0], target: [-0.06, 0.0, 0.0], fov_deg: 26.0, step: 0.005 };

/// A glass sphere before a wall. A pixel in the middle holds half a check, and the step is an eighth of a pixel.
const GLASS: Track =
    Track { eye: [-0.3, 0.0, 3.0], target: [-0.3, 0.0, 0.0], fov_deg: 26.0, step: 0.025 };

/// Returns all pans.
///
/// # Errors
/// None, as long as the scenes can be read, which a test checks.
pub fn all() -> Result<Vec<Pan>, PipelineError> {
    let floor = plane([0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]);
    // Both walls face the sphere between them.
    let behind = plane([0.0, 0.0, 5.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let ahead = plane([0.0, 0.0, -8.5], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let sphere = |material: &str| {
        format!(
            r#"{{ "sphere": {{ "center": [0, 0, -4], "radius": 4, "material": "{material}" }} }}"#
        )
    };
    Ok(vec![
        pan("direct", "A floor, seen directly", DIRECT, &[floor])?,
        pan("mirror", "A wall, seen in a mirror sphere", MIRROR, &[behind, sphere("mirror")])?,
        pan("glass", "A wall, seen through a glass sphere", GLASS, &[ahead, sphere("glass")])?,
    ])
}

/// Returns a plane of checks that are an eighth of a unit wide: a texture has eight checks a side, and a side of one unit.
fn plane(point: [f64; 3], edge_u: [f64; 3], edge_v: [f64; 3]) -> String {
    format!(
        r#"{{ "plane": {{ "point": {point:?}, "edge_u": {edge_u:?}, "edge_v": {edge_v:?},
        "material": "unlit", "texture": "checks" }} }}"#
    )
}

/// Makes a pan of objects.
fn pan(
    name: &'static str,
    title: &'static str,
    camera: Track,
    objects: &[String],
) -> Result<Pan, PipelineError> {
    let Track { eye, target, fov_deg, .. } = camera;
    let objects = objects.join(", ");
    let text = format!(
        r#"{{ "format": "tb-scene", "version": 1,
        "camera": {{ "eye": {eye:?}, "target": {target:?}, "fov_deg": {fov_deg} }},
        "background": 0.5, "ambient": 1, "max_depth": 12,
        "textures": {{ "checks": {{ "image": "peer-checker.png", "values": "linear" }} }},
        "materials": {{
            "unlit": {{ "ambient": 1, "diffuse": 0 }},
            "mirror": {{ "ambient": 0, "diffuse": 0, "reflectivity": 1 }},
            "glass": {{ "ambient": 0, "diffuse": 0, "reflectivity": 1, "transparency": 1,
                        "index_of_refraction": 1.5, "fresnel": true }} }},
        "objects": [ {objects} ] }}"#
    );
    let source = format!("pan {name}");
    let document = Document::new(&source, text.as_bytes())?;
    let file = read::parse(&document)?;
    let folder = Path::new("examples/textures");
    let scene = read::resolve(&document, &file, folder, &pages::FILES, MeshSource::new())?;
    Ok(Pan { name, title, scene, camera })
}

impl Pan {
    /// Returns the camera of a frame, counted from 0. It is `steps` times as far from the first one as in
    /// the pan itself. Returns `None` only if there is no such camera, which cannot happen for the pans of [`all`].
    #[must_use]
    pub fn camera(&self, frame: u32, steps: f64) -> Option<Camera> {
        let Track { eye, target, fov_deg, step } = self.camera;
        let moved = DVec3::X * (f64::from(frame) * steps * step);
        let [eye, target] = [eye, target].map(|point| DVec3::from(point) + moved);
        Camera::new(eye, target, DVec3::Y, fov_deg.to_radians())
    }

    /// Length of the step between two frames, in scene units. The texture repeats after one unit.
    #[must_use]
    pub fn step(&self) -> f64 {
        self.camera.step
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_camera_of_the_first_frame_is_that_of_the_scene() {
        for pan in all().unwrap() {
            let camera = pan.camera(0, 1.0).unwrap();
            assert_eq!(camera, pan.scene.camera, "{}", pan.name);
            let moved = pan.camera(3, 1.0).unwrap().eye() - camera.eye();
            assert!((moved - DVec3::new(3.0 * pan.step(), 0.0, 0.0)).length() < 1e-12);
        }
    }
}
