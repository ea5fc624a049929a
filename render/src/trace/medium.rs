//! What a ray is in: the volumes that it has entered and not left.
//!
//! A boundary lies between what the ray was in and what it comes into, so that glass filled with
//! water bends light at their common boundary by the indices of both. Volumes may overlap: of those
//! that a place lies in, the one with the highest [`Material::priority`] is there, and of equals the
//! one that was entered last (after Schmidt and Budge, "Simple Nested Dielectrics in Ray Traced
//! Images", 2002). A boundary of any other is hidden; rays pass it as if it were not there.
//!
//! Whether a ray enters or leaves is read off the side that it meets, and not off the list: so a
//! crossing that was missed (at an edge, within rounding) is set right at the next one.

use crate::scene::Material;
use std::iter::once;

/// The inside of an object.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Medium {
    /// Which object, an index into the scene's.
    pub object: u32,
    /// What it is made of, an index into the scene's.
    pub material: u32,
}

/// The volumes that a ray is in, in the order in which it entered them.
///
/// Lists of the rays that led to a ray lie before its own, so that following one and coming back
/// asks for no memory.
#[derive(Debug, Clone, Default)]
pub struct Media {
    lists: Vec<Medium>,
    /// Where the list of this ray begins.
    begin: usize,
}

/// A state of [`Media`] to come back to.
#[derive(Debug, Clone, Copy)]
pub struct Mark {
    begin: usize,
    end: usize,
}

/// A surface between two media, as a ray meets it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Boundary {
    /// What the ray came through, an index into the scene's materials; nothing for free space.
    pub before: Option<u32>,
    /// What is behind the surface.
    pub behind: Option<u32>,
    /// False when another volume hides it.
    pub seen: bool,
}

impl Boundary {
    /// Index of refraction before over that behind: the thesis's eta.
    #[must_use]
    pub fn eta(&self, materials: &[Material]) -> f64 {
        let index = |side: Option<u32>| {
            side.map_or(1.0, |material| materials[material as usize].index_of_refraction)
        };
        index(self.before) / index(self.behind)
    }
}

impl Media {
    /// The volumes, in the order in which they were entered.
    #[must_use]
    pub fn entered(&self) -> &[Medium] {
        &self.lists[self.begin..]
    }

    /// Makes these the same volumes as `other`, and keeps the memory.
    pub fn start_in(&mut self, other: &Self) {
        self.lists.clear();
        self.lists.extend(other.entered());
        self.begin = 0;
    }

    /// The state now.
    #[must_use]
    pub fn mark(&self) -> Mark {
        Mark { begin: self.begin, end: self.lists.len() }
    }

    /// Goes back to an earlier state.
    pub fn back_to(&mut self, mark: Mark) {
        self.begin = mark.begin;
        self.lists.truncate(mark.end);
    }

    /// The material that the ray is in; nothing for free space.
    #[must_use]
    pub fn current(&self, materials: &[Material]) -> Option<u32> {
        there(self.entered().iter().copied(), materials).map(|medium| medium.material)
    }

    /// The boundary of a closed volume, met from its inside or from outside.
    #[must_use]
    pub fn boundary(&self, own: Medium, inside: bool, materials: &[Material]) -> Boundary {
        if self.entered().is_empty() {
            // Nearly all rays are in free space.
            return self.sheet(own.material, inside, materials);
        }
        let others = || self.entered().iter().copied().filter(|other| other.object != own.object);
        let outer = there(others(), materials);
        // Left, it is where it was entered; if that was missed, it was entered last.
        let inner = if inside && self.entered().iter().any(|m| m.object == own.object) {
            let place = |m: &Medium| if m.object == own.object { own } else { *m };
            there(self.entered().iter().map(place), materials)
        } else {
            there(others().chain(once(own)), materials)
        };
        let seen = inner == Some(own);
        let [inner, outer] = [inner, outer].map(|side| side.map(|medium| medium.material));
        if inside {
            Boundary { before: inner, behind: outer, seen }
        } else {
            Boundary { before: outer, behind: inner, seen }
        }
    }

    /// The surface of an object that has no inside: what is behind it lasts no longer than the
    /// surface itself. `inside` says that its back was met.
    #[must_use]
    pub fn sheet(&self, material: u32, inside: bool, materials: &[Material]) -> Boundary {
        let (own, outer) = (Some(material), self.current(materials));
        let (before, behind) = if inside { (own, outer) } else { (outer, own) };
        Boundary { before, behind, seen: true }
    }

    /// Crosses the boundary of a volume.
    pub fn cross(&mut self, own: Medium, inside: bool) {
        let before = self.begin..self.lists.len();
        self.begin = before.end;
        for place in before {
            let other = self.lists[place];
            if other.object != own.object {
                self.lists.push(other);
            }
        }
        if !inside {
            self.lists.push(own);
        }
    }
}

/// Of volumes that overlap the one that is there: of the highest priority, the last.
fn there(media: impl Iterator<Item = Medium>, materials: &[Material]) -> Option<Medium> {
    media.max_by_key(|medium| materials[medium.material as usize].priority)
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

    /// The boundaries of these crossings, from free space.
    fn walk(crossings: &[(Medium, bool)], materials: &[Material]) -> Vec<(f64, bool)> {
        let mut media = Media::default();
        let step = |&(own, inside)| {
            let boundary = media.boundary(own, inside, materials);
            media.cross(own, inside);
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
        // Leaving what was never entered, and entering what was never left.
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
                media.cross(Medium { object, ..WATER }, false);
                mark
            })
            .collect();
        for (object, &mark) in (0..1000).zip(&marks).rev() {
            assert_eq!(media.entered().len(), object as usize + 1);
            let boundary = media.boundary(Medium { object, ..WATER }, true, &materials);
            let behind = (object > 0).then_some(1);
            assert_eq!(boundary, Boundary { before: Some(1), behind, seen: true });
            media.back_to(mark);
        }
        assert_eq!(media.current(&materials), None);
    }

    #[test]
    fn a_sheet_lies_in_what_is_around_it() {
        let materials = materials([0; 3]);
        let mut media = Media::default();
        assert_eq!(media.sheet(0, false, &materials).eta(&materials), 1.0 / 1.5);
        media.cross(WATER, false);
        assert_eq!(media.sheet(0, true, &materials).eta(&materials), 1.5 / 1.33);
        assert_eq!(media.sheet(2, false, &materials).eta(&materials), 1.33);
        media.cross(AIR, false);
        assert_eq!(media.current(&materials), Some(2));
    }
}
