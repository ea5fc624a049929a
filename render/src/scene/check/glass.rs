//! Transparent objects: those that are open or inside out, and lines of sight through more of them
//! than a ray passes.

use super::solid;
use super::subject::{Item, Subject};
use super::{Finding, Severity, count};
use crate::shape::Shape;
use glam::DVec3;

/// Returns the findings about transparent objects.
#[must_use]
pub fn findings(subject: &Subject<'_>) -> Vec<Finding> {
    let bent = subject.items.iter().filter(|item| subject.bends(item));
    let mut found: Vec<Finding> = bent.filter_map(open_or_inward).collect();
    found.extend(too_deep(subject));
    found
}

/// Finds a refracting object without an inside, or with its inside outside.
fn open_or_inward(item: &Item<'_>) -> Option<Finding> {
    let said = |severity, message: String| Some(Finding::new(severity, &item.path, message));
    if let Shape::Quad(_) = item.object.shape {
        let message = "the surface refracts and has no inside: light behind the surface stays refracted, as \
                       if all space there were glass; use an index of refraction of 1, or a closed object";
        return said(Severity::Hint, message.into());
    }
    let skin = item.skin?;
    if skin.rims > 0 {
        let message = format!(
            "the mesh refracts and is not closed ({} with triangles on one side only): it has no inside \
             and absorbs nothing",
            count(skin.rims, "edge", "edges")
        );
        return said(Severity::Wrong, message);
    }
    if skin.flips > 0 {
        let message = format!(
            "the mesh refracts and its triangles do not agree on the outside ({})",
            count(skin.flips, "edge", "edges")
        );
        return said(Severity::Wrong, message);
    }
    let message = "the mesh refracts and its triangles face inward, so that its inside counts as outside; \
                   reverse the order of their corners";
    if skin.volume < 0.0 { said(Severity::Wrong, message.into()) } else { None }
}

/// Largest number of tests of a line of sight against a box, unless [`LINES`] lines need more. A larger
/// number would make scenes of thousands of transparent objects slow. A smaller number would miss the
/// deepest line of such a scene more often.
const MOST_HELD: usize = 1 << 22;

/// Smallest number of lines of sight in a scene with many transparent objects.
const LINES: usize = 64;

/// Finds lines of sight through more transparent surfaces than a ray is followed through. The lines end
/// in the middles of the bounding boxes of transparent objects, and count the boxes that they meet. Of
/// very many boxes, only some, evenly chosen, are targets.
fn too_deep(subject: &Subject<'_>) -> Option<Finding> {
    let clear = subject.items.iter().filter(|item| subject.is_clear(item));
    let boxes: Vec<([DVec3; 2], usize)> = clear
        .filter_map(|item| {
            let surfaces = match item.object.shape {
                Shape::Quad(_) => 1,
                Shape::Sphere(_)
                | Shape::Mesh(_)
                | Shape::Cuboid(_)
                | Shape::Superquadric(_)
                | Shape::Placed(_) => 2,
            };
            Some((solid::bounds(item)?, surfaces))
        })
        .collect();
    let eye = subject.eye();
    let crossed = |target: DVec3| -> usize {
        let direction = target - eye;
        let met = boxes.iter().filter(|(bounds, _)| meets(eye, direction, *bounds));
        met.map(|(_, surfaces)| surfaces).sum()
    };
    let looked_at = boxes.iter().step_by(step(boxes.len()));
    let most = looked_at.map(|([low, high], _)| crossed(low.midpoint(*high))).max()?;
    let deepest = subject.scene.max_depth as usize;
    let message = format!(
        "a line of sight passes through {most} transparent surfaces or more, and rays are bent by \
         {deepest} only: what lies behind is black, or is not bent"
    );
    (most > deepest).then(|| Finding::new(Severity::Hint, "max_depth", message))
}

/// Returns the step between boxes that are targets of lines of sight, among `count` boxes.
fn step(count: usize) -> usize {
    let lines = (MOST_HELD / count.max(1)).max(LINES);
    count.div_ceil(lines).max(1)
}

/// Returns whether a ray from `eye` meets a box, by the box's three slabs.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_sight_are_all_looked_at_of_few_boxes_and_bounded_of_many() {
        let held = |count: usize| count * count.div_ceil(step(count));
        assert_eq!((step(0), step(1), step(2000)), (1, 1, 1));
        for count in [10_000, 100_000, 1_000_000] {
            assert!(held(count) <= MOST_HELD.max(LINES * count), "{count}");
        }
        let many = 1_000_000;
        assert!(held(2 * many) <= 2 * held(many) + 2 * many);
    }
}
