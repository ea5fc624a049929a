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
    if !(file.fov_deg > 0.0 && file.fov_deg < 180.0) {
        let found = number(file.fov_deg);
        let message = format!("found {found}, expected an angle between 0 and 180");
        return fault("camera.fov_deg", message);
    }
    match Camera::new(eye, target, up, file.fov_deg.to_radians()) {
        Some(camera) => Ok(camera),
        None => fault(
            "camera",
            "found an eye at its target, or an up along the view; expected an eye apart from its \
             target, and an up across the view"
                .into(),
        ),
    }
}
