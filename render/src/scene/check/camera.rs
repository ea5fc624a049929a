//! An eye inside an object, and objects outside the picture.

use super::solid;
use super::subject::{Item, Subject};
use super::{Finding, Severity, short};
use glam::DVec3;

/// An eye counts as on a surface if its distance is at most this fraction of its distance to the target.
/// A smaller fraction would miss an eye that rounding moved off the surface. A larger fraction would
/// report an eye close to a floor.
const ON: f64 = 1e-6;

/// Returns the findings about the camera.
#[must_use]
pub fn findings(subject: &Subject<'_>) -> Vec<Finding> {
    let mut found: Vec<Finding> =
        subject.items.iter().filter_map(|item| stands(subject, item)).collect();
    found.extend(unseen(subject));
    found
}

/// Finds an eye inside an object or on its surface.
fn stands(subject: &Subject<'_>, item: &Item<'_>) -> Option<Finding> {
    let eye = subject.eye();
    let near = ON * eye.distance(subject.camera.target.into());
    let said = |severity, message: String| {
        Some(Finding::new(
            severity,
            "camera.eye",
            format!("{message} {} ({})", item.path, item.kind),
        ))
    };
    if solid::height(item, eye).is_some_and(|height| height <= near) {
        return said(Severity::Hint, "the eye is on the surface of".into());
    }
    if solid::contains(item, eye) == Some(true) {
        let (severity, why) = if subject.is_clear(item) {
            (Severity::Remark, "the eye is inside")
        } else {
            (Severity::Hint, "the eye sees only the inside of")
        };
        return said(severity, why.into());
    }
    None
}

/// Finds objects of which no part is in the picture.
fn unseen(subject: &Subject<'_>) -> Vec<Finding> {
    let sides = View::of(subject);
    let mut found = Vec::new();
    let mut seen = false;
    let mut items = &*subject.items;
    while let Some((item, others)) = items.split_first() {
        let count = others.iter().take_while(|other| other.placement > 0).count();
        let misses = |item: &Item<'_>| solid::bounds(item).and_then(|bounds| sides.misses(bounds));
        // A mesh with instances is seen if one of its placements is.
        let all_missed = others[..count].iter().all(|other| misses(other).is_some());
        items = &others[count..];
        match misses(item).filter(|_| all_missed) {
            Some(_) if count > 0 => {
                let message = format!(
                    "none of the {} placements is in the picture: only mirrors and shadows show them",
                    count + 1
                );
                found.push(Finding::new(Severity::Remark, &item.path, message));
            }
            Some(Miss::Behind(distance)) => {
                let message = format!(
                    "the whole object is behind the camera, at a distance of {}: only mirrors and shadows show it",
                    short(distance)
                );
                found.push(Finding::new(Severity::Remark, &item.path, message));
            }
            Some(Miss::Beside) => {
                let message =
                    "the whole object is outside the picture: only mirrors and shadows show it";
                found.push(Finding::new(Severity::Remark, &item.path, message));
            }
            None => seen = true,
        }
    }
    if !seen && !subject.items.is_empty() {
        let message = "found no object in front of the camera, expected at least one: the picture \
                       shows only the background";
        found.push(Finding::new(Severity::Wrong, "camera", message));
    }
    found
}

/// The position of a box outside the picture.
enum Miss {
    /// Behind the eye, with the distance of the nearest corner along the view, in scene units.
    Behind(f64),
    /// On the far side of one of the four sides.
    Beside,
}

/// The front and the four sides of the view. The sides of a pinhole camera pass through the eye.
struct View {
    eye: DVec3,
    forward: DVec3,
    /// Normal of each side, and its distance from the eye times the length of the normal.
    inward: [(DVec3, f64); 4],
}

impl View {
    fn of(subject: &Subject<'_>) -> Self {
        let camera = subject.camera;
        let eye = subject.eye();
        let forward = (DVec3::from(camera.target) - eye).normalize_or(DVec3::NEG_Z);
        let right = forward.cross(camera.up.into()).normalize_or(DVec3::X);
        let up = right.cross(forward);
        let high = match camera.height {
            Some(height) => 0.5 * height,
            None => (0.5 * camera.angle_deg().to_radians()).tan(),
        };
        let wide = high * subject.aspect;
        let sides = [(wide, -right), (wide, right), (high, -up), (high, up)];
        let inward = sides.map(|(reach, normal)| match camera.height {
            Some(_) => (normal, reach),
            None => (reach * forward + normal, 0.0),
        });
        Self { eye, forward, inward }
    }

    /// Returns the position of a box that is certainly outside the picture: all its corners are behind
    /// the eye, or on the far side of one of the sides.
    fn misses(&self, [low, high]: [DVec3; 2]) -> Option<Miss> {
        let corner = |k: usize| {
            let pick = |bit: usize, low: f64, high: f64| if k >> bit & 1 == 0 { low } else { high };
            DVec3::new(pick(0, low.x, high.x), pick(1, low.y, high.y), pick(2, low.z, high.z))
                - self.eye
        };
        let corners: [DVec3; 8] = std::array::from_fn(corner);
        let most =
            |axis: DVec3| corners.iter().map(|c| c.dot(axis)).fold(f64::NEG_INFINITY, f64::max);
        let front = most(self.forward);
        if front < 0.0 {
            return Some(Miss::Behind(-front));
        }
        let beside = |&(side, reach): &(DVec3, f64)| most(side) + reach < 0.0;
        self.inward.iter().any(beside).then_some(Miss::Beside)
    }
}
