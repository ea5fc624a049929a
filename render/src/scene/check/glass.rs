//! What light goes through: whether it has an inside, and whether a ray may follow it far enough.

use super::solid;
use super::subject::{Item, Subject};
use super::{Finding, Severity, count};
use crate::shape::Shape;
use glam::DVec3;

/// What the transparent objects show.
#[must_use]
pub fn findings(subject: &Subject<'_>) -> Vec<Finding> {
    let bent = subject.items.iter().filter(|item| subject.bends(item));
    let mut found: Vec<Finding> = bent.filter_map(open_or_inward).collect();
    found.extend(too_deep(subject));
    found
}

/// Glass that has no inside, or has it outside.
fn open_or_inward(item: &Item<'_>) -> Option<Finding> {
    let said = |severity, message: String| Some(Finding::new(severity, &item.path, message));
    if let Shape::Quad(_) = item.object.shape {
        let message = "it refracts and has no inside: light that goes through stays bent, as if \
                       all behind it were glass; give it the index of refraction 1, or a thickness";
        return said(Severity::Hint, message.into());
    }
    let skin = item.skin?;
    if skin.rims > 0 {
        let message = format!(
            "it refracts and is not closed ({} with triangles on one side only): light does not \
             come out of it again",
            count(skin.rims, "edge", "edges")
        );
        return said(Severity::Wrong, message);
    }
    if skin.flips > 0 {
        let message = format!(
            "it refracts and its triangles do not agree on the outside ({})",
            count(skin.flips, "edge", "edges")
        );
        return said(Severity::Wrong, message);
    }
    let message = "it refracts and its triangles face inward, so that its inside counts as outside; \
                   turn the order of their corners";
    if skin.volume < 0.0 { said(Severity::Wrong, message.into()) } else { None }
}

/// Lines of sight to the corners and the middle of each transparent box, and how many surfaces of
/// transparent boxes they cross at least.
fn too_deep(subject: &Subject<'_>) -> Option<Finding> {
    let clear: Vec<_> = subject.items.iter().filter(|item| subject.is_clear(item)).collect();
    let boxes: Vec<([DVec3; 2], usize)> = clear
        .iter()
        .filter_map(|item| {
            let surfaces = if matches!(item.object.shape, Shape::Quad(_)) { 1 } else { 2 };
            Some((solid::bounds(item)?, surfaces))
        })
        .collect();
    let eye = subject.eye();
    let crossed = |target: DVec3| -> usize {
        let direction = target - eye;
        let met = boxes.iter().filter(|(bounds, _)| meets(eye, direction, *bounds));
        met.map(|(_, surfaces)| surfaces).sum()
    };
    let most = boxes.iter().map(|([low, high], _)| crossed(low.midpoint(*high))).max()?;
    let deepest = subject.scene.max_depth as usize;
    let message = format!(
        "a line of sight goes through {most} transparent surfaces or more, and a ray is followed \
         through {deepest} only: behind them is black"
    );
    (most > deepest).then(|| Finding::new(Severity::Hint, "max_depth", message))
}

/// Whether a line from `eye` meets a box, by its slabs.
fn meets(eye: DVec3, direction: DVec3, [low, high]: [DVec3; 2]) -> bool {
    let (mut near, mut far) = (0.0f64, f64::INFINITY);
    for k in 0..3 {
        if direction[k] == 0.0 {
            if !(low[k]..=high[k]).contains(&eye[k]) {
                return false;
            }
            continue;
        }
        let [a, b] = [low[k], high[k]].map(|side| (side - eye[k]) / direction[k]);
        near = near.max(a.min(b));
        far = far.min(a.max(b));
    }
    near <= far
}
