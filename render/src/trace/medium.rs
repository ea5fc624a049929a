//! The media of a ray: the volumes that it has entered and not left.
//!
//! A boundary lies between the medium before it and the medium behind it. Glass filled with water
//! therefore bends light at their common boundary by the indices of both. Volumes may overlap. Of
//! the volumes that contain a point, the one with the highest [`Material::priority`] is the medium
//! there. Of equal priorities, the volume that was entered last is the medium (after Schmidt and
//! Budge, "Simple Nested Dielectrics in Ray Traced Images", 2002). The boundaries of the other
//! volumes are hidden, and rays pass them unchanged.
//!
//! The side of the surface that a ray meets decides whether the ray enters or leaves; the list does
//! not. A crossing that was missed, at an edge or within rounding, is therefore corrected at the
//! next crossing.

use super::ranked::{Rank, Ranked};
use crate::scene::Material;
use std::sync::Arc;

/// The inside of an object.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Medium {
    /// Index of the object in the scene.
    pub object: u32,
    /// Index of the object's material in the scene.
    pub material: u32,
}

/// The volumes that contain the current point of a ray.
///
/// Each crossing is recorded and can be undone. Following a ray and returning takes as many steps
/// as the ray crossed boundaries, however many volumes there are.
#[derive(Debug, Clone, Default)]
pub struct Media {
    inside: Ranked,
    /// The volumes around the ray's start, shared by all rays that start there; `None` for free
    /// space.
    start: Option<Arc<Ranked>>,
    changes: Vec<Change>,
    /// Order of the volume that is entered next.
    next: u64,
}

/// A recorded crossing, which can be undone.
#[derive(Debug, Clone, Copy)]
enum Change {
    /// The volume of an object was entered.
    Entered(u32),
    /// A volume was left.
    Left(Rank, Medium),
}

/// A state of [`Media`] to which it can return: the number of changes that led to it.
#[derive(Debug, Clone, Copy)]
pub struct Mark(usize);

/// A surface between two media, as a ray meets it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Boundary {
    /// Material in front of the surface, an index into the scene's materials; `None` for free
    /// space.
    pub before: Option<u32>,
    /// Material behind the surface, an index into the scene's materials; `None` for free space.
    pub behind: Option<u32>,
    /// False if another volume hides the surface.
    pub seen: bool,
}

impl Boundary {
    /// Returns the index of refraction in front of the surface over the index behind it: the
    /// thesis's eta.
    #[must_use]
    pub fn eta(&self, materials: &[Material]) -> f64 {
        let index = |side: Option<u32>| {
            side.map_or(1.0, |material| materials[material as usize].index_of_refraction)
        };
        index(self.before) / index(self.behind)
    }
}

impl Media {
    /// Creates the media of a point that lies in these volumes, entered in this order.
    #[must_use]
    pub fn within(volumes: impl IntoIterator<Item = Medium>, materials: &[Material]) -> Self {
        let mut media = Self::default();
        for own in volumes {
            media.cross(own, false, materials);
        }
        media.changes.clear();
        media.start = (!media.inside.is_empty()).then(|| Arc::new(media.inside.clone()));
        media
    }

    /// Number of volumes.
    #[must_use]
    pub fn count(&self) -> usize {
        self.inside.len()
    }

    /// Starts in the volumes of `other`, which was made by [`Media::within`], and keeps the memory.
    /// Nothing is copied if the last ray started in the same volumes.
    pub fn start_in(&mut self, other: &Self) {
        self.back_to(Mark(0));
        let same = match (&self.start, &other.start) {
            (None, None) => true,
            (Some(own), Some(other)) => Arc::ptr_eq(own, other),
            _ => false,
        };
        if !same {
            self.inside.clone_from(&other.inside);
            self.start.clone_from(&other.start);
        }
        self.next = other.next;
    }

    /// Returns the current state.
    #[must_use]
    pub fn mark(&self) -> Mark {
        Mark(self.changes.len())
    }

    /// Returns to an earlier state.
    pub fn back_to(&mut self, mark: Mark) {
        for change in self.changes.drain(mark.0..).rev() {
            match change {
                Change::Entered(object) => {
                    self.inside.remove(object);
                }
                Change::Left(rank, medium) => self.inside.insert(rank, medium),
            }
        }
    }

    /// Material at the current point of the ray; `None` for free space.
    #[must_use]
    pub fn current(&self) -> Option<u32> {
        self.inside.first().map(|(_, medium)| medium.material)
    }

    /// Returns the boundary at the surface of a closed volume. `inside` is true if the ray meets
    /// the surface from the inside.
    #[must_use]
    pub fn boundary(&self, own: Medium, inside: bool, materials: &[Material]) -> Boundary {
        if self.inside.is_empty() {
            // Nearly all rays are in free space.
            return self.sheet(own.material, inside);
        }
        let outer = self.inside.first_but(own.object);
        // A volume that is left keeps the rank of its entry. A volume that is entered, or whose
        // entry was missed, ranks as the last one entered.
        let entered = if inside { self.inside.rank_of(own.object) } else { None };
        let order = entered.map_or(u64::MAX, |rank| rank.order);
        let rank = Rank { priority: materials[own.material as usize].priority, order };
        let seen = outer.is_none_or(|(other, _)| other < rank);
        let outer = outer.map(|(_, medium)| medium.material);
        let inner = if seen { Some(own.material) } else { outer };
        if inside {
            Boundary { before: inner, behind: outer, seen }
        } else {
            Boundary { before: outer, behind: inner, seen }
        }
    }

    /// Returns the boundary at a surface of an object that has no inside. The medium on its back is
    /// the object's own material, and has no thickness. `inside` is true if the ray meets the back.
    #[must_use]
    pub fn sheet(&self, material: u32, inside: bool) -> Boundary {
        let (own, outer) = (Some(material), self.current());
        let (before, behind) = if inside { (own, outer) } else { (outer, own) };
        Boundary { before, behind, seen: true }
    }

    /// Crosses the boundary of a volume. `inside` is true if the ray meets the boundary from the
    /// inside and leaves.
    pub fn cross(&mut self, own: Medium, inside: bool, materials: &[Material]) {
        if let Some((rank, medium)) = self.inside.remove(own.object) {
            self.changes.push(Change::Left(rank, medium));
        }
        if !inside {
            let priority = materials[own.material as usize].priority;
            self.inside.insert(Rank { priority, order: self.next }, own);
            self.next += 1;
            self.changes.push(Change::Entered(own.object));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GLASS: Medium = Medium { object: 0, material: 0 };
    const WATER: Medium = Medium { object: 1, material: 1 };
    const AIR: Medium = Medium { object: 2, material: 2 };

    fn materials(priorities: [u8; 3]) -> Vec<Material> {
        let material = |(index_of_refraction, priority)| Material {
            index_of_refraction,
            priority,
            ..Material::default()
        };
        [1.5, 1.33, 1.0].into_iter().zip(priorities).map(material).collect()
    }

    /// Returns eta and visibility of the boundaries of these crossings, starting in free space.
    fn walk(crossings: &[(Medium, bool)], materials: &[Material]) -> Vec<(f64, bool)> {
        let mut media = Media::default();
        let step = |&(own, inside)| {
            let boundary = media.boundary(own, inside, materials);
            media.cross(own, inside, materials);
            (boundary.eta(materials), boundary.seen)
        };
        crossings.iter().map(step).collect()
    }

    #[test]
    fn water_in_glass_bends_by_both_indices() {
        let materials = materials([0; 3]);
        let walked =
            walk(&[(GLASS, false), (WATER, false), (WATER, true), (GLASS, true)], &materials);
        let truth = [1.0 / 1.5, 1.5 / 1.33, 1.33 / 1.5, 1.5];
        assert_eq!(walked, truth.map(|eta| (eta, true)));
    }

    #[test]
    fn left_in_the_wrong_order_the_last_entered_stays() {
        let materials = materials([0; 3]);
        let walked =
            walk(&[(GLASS, false), (WATER, false), (GLASS, true), (WATER, true)], &materials);
        // The overlap is water, so that the glass ends where the water begins.
        let truth = [(1.0 / 1.5, true), (1.5 / 1.33, true), (1.0, false), (1.33, true)];
        assert_eq!(walked, truth);
    }

    #[test]
    fn by_priority_an_overlap_is_the_same_from_both_sides() {
        let materials = materials([1, 0, 0]);
        let down =
            walk(&[(GLASS, false), (WATER, false), (GLASS, true), (WATER, true)], &materials);
        let truth = [(1.0 / 1.5, true), (1.0, false), (1.5 / 1.33, true), (1.33, true)];
        assert_eq!(down, truth);
        let up = walk(&[(WATER, false), (GLASS, false), (WATER, true), (GLASS, true)], &materials);
        let truth = [(1.0 / 1.33, true), (1.33 / 1.5, true), (1.0, false), (1.5, true)];
        assert_eq!(up, truth);
    }

    #[test]
    fn a_crossing_that_was_missed_is_set_right() {
        let materials = materials([0; 3]);
        let met = |crossings: &[(Medium, bool)]| walk(crossings, &materials).pop().unwrap();
        // The first crossing leaves a volume that was never entered. The others enter volumes again
        // that were never left.
        assert_eq!(met(&[(GLASS, true)]), (1.5, true));
        assert_eq!(met(&[(WATER, false), (GLASS, true)]), (1.5 / 1.33, true));
        assert_eq!(met(&[(GLASS, false), (GLASS, false)]), (1.0 / 1.5, true));
    }

    #[test]
    fn a_thousand_volumes_are_left_as_they_were_entered() {
        let materials = materials([0; 3]);
        let mut media = Media::default();
        let marks: Vec<Mark> = (0..1000)
            .map(|object| {
                let mark = media.mark();
                media.cross(Medium { object, ..WATER }, false, &materials);
                mark
            })
            .collect();
        for (object, &mark) in (0..1000).zip(&marks).rev() {
            assert_eq!(media.count(), object as usize + 1);
            let boundary = media.boundary(Medium { object, ..WATER }, true, &materials);
            let behind = (object > 0).then_some(1);
            assert_eq!(boundary, Boundary { before: Some(1), behind, seen: true });
            media.back_to(mark);
        }
        assert_eq!(media.current(), None);
    }

    #[test]
    fn a_ray_starts_in_what_is_around_its_start_whatever_was_followed_before() {
        let materials = materials([0; 3]);
        let around = Media::within([GLASS, WATER], &materials);
        let mut media = Media::default();
        for _ in 0..2 {
            media.start_in(&around);
            assert_eq!((media.count(), media.current()), (2, Some(1)));
            media.cross(WATER, true, &materials);
            media.cross(AIR, false, &materials);
            assert_eq!((media.count(), media.current()), (2, Some(2)));
        }
        media.start_in(&Media::default());
        assert_eq!((media.count(), media.current()), (0, None));
    }

    #[test]
    fn what_is_written_down_is_in_proportion_to_the_boundaries_crossed() {
        let materials = materials([0; 3]);
        let changes = |count: u32| {
            let around =
                Media::within((0..count).map(|object| Medium { object, ..AIR }), &materials);
            let mut media = Media::default();
            media.start_in(&around);
            let start = media.mark();
            for object in 0..count {
                media.cross(Medium { object, ..AIR }, true, &materials);
            }
            let changes = media.changes.len();
            assert_eq!(media.count(), 0);
            media.back_to(start);
            assert_eq!(media.count(), count as usize);
            changes
        };
        assert_eq!((changes(1000), changes(2000)), (1000, 2000));
    }

    #[test]
    fn a_sheet_lies_in_what_is_around_it() {
        let materials = materials([0; 3]);
        let mut media = Media::default();
        assert_eq!(media.sheet(0, false).eta(&materials), 1.0 / 1.5);
        media.cross(WATER, false, &materials);
        assert_eq!(media.sheet(0, true).eta(&materials), 1.5 / 1.33);
        assert_eq!(media.sheet(2, false).eta(&materials), 1.33);
        media.cross(AIR, false, &materials);
        assert_eq!(media.current(), Some(2));
    }
}
