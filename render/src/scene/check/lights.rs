//! Lights that light little or nothing.

use super::boxes::{Boxes, touch};
use super::solid;
use super::subject::{Item, Subject};
use super::{Finding, Severity};
use crate::scene::{Light, PointLight, SpotLight};
use glam::DVec3;
use std::ops::ControlFlow;

/// Returns the findings about lights.
#[must_use]
pub fn findings(subject: &Subject<'_>) -> Vec<Finding> {
    let lights = subject.scene.lights.iter().zip(&subject.lights);
    let enclosures = Enclosures::of(subject);
    let mut found: Vec<Finding> =
        lights.filter_map(|(light, path)| enclosures.shut_in(light, path)).collect();
    found.extend(dark(subject));
    found
}

/// The opaque objects, any of which may enclose a light.
struct Enclosures<'a> {
    items: Vec<&'a Item<'a>>,
    tree: Boxes,
    eye: DVec3,
}

impl<'a> Enclosures<'a> {
    fn of(subject: &'a Subject<'_>) -> Self {
        let mut items = Vec::new();
        let mut bounds = Vec::new();
        for item in subject.items.iter().filter(|item| !subject.is_clear(item)) {
            if let Some([low, high]) = solid::bounds(item) {
                // Widened, so that rounding excludes no light.
                let slack = 1e-9 * (low.abs().max(high.abs()).max_element() + 1.0);
                items.push(item);
                bounds.push([low - slack, high + slack]);
            }
        }
        Self { items, tree: Boxes::new(bounds), eye: subject.eye() }
    }

    /// Finds the first opaque object that contains the light and not the eye.
    fn shut_in(&self, light: &Light, path: &str) -> Option<Finding> {
        let position = match *light {
            Light::Point(PointLight { position, .. })
            | Light::Spot(SpotLight { point: PointLight { position, .. }, .. }) => position,
            Light::Directional(_) => return None,
        };
        let mut around: Option<u32> = None;
        self.tree.search(
            |bounds| touch(bounds, &[position; 2]),
            |number| {
                let item = self.items[number as usize];
                let first = around.is_none_or(|around| number < around);
                if first
                    && solid::contains(item, position) == Some(true)
                    && solid::contains(item, self.eye) == Some(false)
                {
                    around = Some(number);
                }
                ControlFlow::Continue(())
            },
        );
        let around = self.items[around? as usize];
        let message = format!(
            "the light is inside {} ({}), which is closed and opaque: outside it lights nothing",
            around.path, around.kind
        );
        Some(Finding::new(Severity::Hint, path, message))
    }
}

/// Finds a scene that has neither lights nor ambient light.
fn dark(subject: &Subject<'_>) -> Option<Finding> {
    let scene = subject.scene;
    let none = scene.lights.iter().all(|light| light.color() == DVec3::ZERO);
    let emits = scene.materials.iter().any(|material| material.emission != DVec3::ZERO);
    let message = "there are no lights and no ambient light: all surfaces are black";
    (none && !emits && scene.ambient == DVec3::ZERO && !scene.objects.is_empty())
        .then(|| Finding::new(Severity::Hint, "lights", message))
}
