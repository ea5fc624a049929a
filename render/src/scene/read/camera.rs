//! The camera of a scene file.

use super::SceneError;
use super::ranges::{Ranges, number};
use crate::scene::Camera;
use crate::scene::file::CameraFile;
use files::json::Document;

/// Reads the camera and checks that its three directions span space.
pub(super) fn read(document: &Document<'_>, file: &CameraFile) -> Result<Camera, SceneError> {
    let fault = |path: &str, message: String| Err(document.fault(path, message).into());
    let eye = document.vector("camera.eye", file.eye)?;
    let target = document.vector("camera.target", file.target)?;
    let up = document.vector("camera.up", file.up)?;
    let camera = match (file.fov_deg, file.height) {
        (Some(angle), None) => {
            if !(angle > 0.0 && angle < 180.0) {
                let found = number(angle);
                let message = format!("found {found}, expected an angle between 0 and 180");
                return fault("camera.fov_deg", message);
            }
            Camera::new(eye, target, up, angle.to_radians())
        }
        (None, Some(height)) => {
            let height = document.above_zero("camera.height", height)?;
            Camera::orthographic(eye, target, up, height)
        }
        (found, _) => {
            let found = if found.is_some() { "both" } else { "neither" };
            let message = format!(
                "found {found} of fov_deg and height, expected fov_deg for a pinhole camera, or height \
                 for parallel rays"
            );
            return fault("camera", message);
        }
    };
    match camera {
        Some(camera) => Ok(camera),
        None => fault(
            "camera",
            "found an eye at its target, or an up along the view; expected an eye apart from its \
             target, and an up across the view"
                .into(),
        ),
    }
}
