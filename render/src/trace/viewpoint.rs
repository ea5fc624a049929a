//! Another camera for a tracer.

use super::Tracer;
use crate::scene::Camera;

impl Tracer<'_> {
    /// Returns the tracer with another camera than that of the scene, if there is one.
    #[must_use]
    pub fn seen_by(self, camera: Option<Camera>) -> Self {
        let Some(camera) = camera else { return self };
        let around_eye = self.volumes.around(self.scene, self.accel, camera.eye());
        Self { camera, around_eye, ..self }
    }
}
