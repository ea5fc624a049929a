//! Lights that light little or nothing.

use super::solid;
use super::subject::Subject;
use super::{Finding, Severity};
use crate::scene::{Light, PointLight};
use glam::DVec3;

/// What the places of the lights show.
#[must_use]
pub fn findings(subject: &Subject<'_>) -> Vec<Finding> {
    let lights = subject.scene.lights.iter().zip(&subject.lights);
    let mut found: Vec<Finding> =
        lights.filter_map(|(light, path)| shut_in(subject, light, path)).collect();
    found.extend(dark(subject));
    found
}

/// A light inside an opaque object that the eye is outside of.
fn shut_in(subject: &Subject<'_>, light: &Light, path: &str) -> Option<Finding> {
    let Light::Point(PointLight { position, .. }) = *light else { return None };
    let around = subject.items.iter().find(|item| {
        !subject.is_clear(item)
            && solid::contains(item, position) == Some(true)
            && solid::contains(item, subject.eye()) == Some(false)
    })?;
    let message = format!(
        "the light is inside {} ({}), which is closed and opaque: outside it lights nothing",
        around.path, around.kind
    );
    Some(Finding::new(Severity::Hint, path, message))
}

/// Neither lights nor ambient light, so that all surfaces are black.
fn dark(subject: &Subject<'_>) -> Option<Finding> {
    let scene = subject.scene;
    let none = scene.lights.iter().all(|light| light.color() == DVec3::ZERO);
    let message = "there are no lights and no ambient light: all surfaces are black";
    (none && scene.ambient == DVec3::ZERO && !scene.objects.is_empty())
        .then(|| Finding::new(Severity::Hint, "lights", message))
}
