//! Reads the profile of a spec: one contour, or sections.

use super::Reader;
use super::wall::Hollow;
use crate::error::SweepError;
use crate::law::Law;
use crate::spec::contour::Sections;
use crate::spec::{self, Spec};
use crate::surface::contour::Contour;
use crate::surface::profile::{Blend, Profile};
use crate::surface::shape::ON_AXIS;
use crate::surface::vessel::TightBend;
use crate::trajectory::Trajectory;

/// Largest number of sections. Each column of the grid stores a point on every section.
const MOST_SECTIONS: usize = 1000;

/// A profile of a sweep: its only one, or one of its loops.
pub(super) struct Loop {
    pub profile: Profile,
    /// Positions of several contours on the trajectory.
    pub blend: Option<Blend>,
    /// Distance of the surface from the contour, for a side of a wall.
    pub offset: Option<Law>,
    /// The part that a relief covers.
    pub face: Face,
    /// The bend of the profile that is tighter than the wall of a vessel.
    pub bend: Option<TightBend>,
}

/// The part of a loop that a relief covers.
#[derive(Debug, Clone)]
pub(super) enum Face {
    /// All of it.
    Whole,
    /// The outer side of a wall of this least thickness, as fractions of the length.
    Part { range: [f64; 2], thickness: f64 },
    /// All of it, as the outer side of a tube whose wall has this thickness along the trajectory.
    Skin(Law),
    /// Nothing.
    Bare,
}

impl Reader<'_> {
    /// Returns the profiles, one for each loop, and the positions of the contours of a single profile on the trajectory if
    /// there are several.
    pub(super) fn profiles(
        &self,
        spec: &Spec,
        trajectory: &Trajectory,
    ) -> Result<Vec<Loop>, SweepError> {
        let contour = &spec.contour;
        if let spec::Contour::Sections(sections) = contour {
            let (profile, blend) = self.sections(sections, trajectory)?;
            if trajectory.is_rotation() {
                self.right_of_axis(&profile)?;
                self.off_axis("contour.sections", &profile)?;
            }
            let hollow = self.hollow(spec, &[], trajectory)?;
            debug_assert!(hollow.is_none(), "sections have no wall");
            let blend = Some(blend);
            return Ok(vec![Loop { profile, blend, offset: None, face: Face::Whole, bend: None }]);
        }
        let mut contours = self.loops("contour", contour)?;
        if let (Some(wall), [contour], true) = (&spec.wall, &contours[..], trajectory.is_rotation())
            && !contour.closed()
        {
            let high = self.right_of_axis(&Profile::single(contour.clone()))?;
            return self.vessel(spec, wall, contour, high);
        }
        let mut sides = vec![(None, Face::Whole); contours.len()];
        if let Some(Hollow { outer, inner, thickness }) =
            self.hollow(spec, &contours, trajectory)?
        {
            let contour = contours.remove(0);
            contours.extend([contour.clone(), contour.backward()]);
            sides = vec![(Some(outer), Face::Skin(thickness)), (Some(inner), Face::Bare)];
        }
        let of_loop = |(contour, (offset, face)): (Contour, (Option<Law>, Face))| {
            let mut profile = Profile::single(contour.clone());
            if trajectory.is_rotation() {
                let high = self.right_of_axis(&profile)?;
                profile = Profile::single(contour.rotated(ON_AXIS * high));
            }
            Ok(Loop { profile, blend: None, offset, face, bend: None })
        };
        contours.into_iter().zip(sides).map(of_loop).collect()
    }

    /// Returns the largest distance from the axis of a rotation; refuses a profile that crosses the axis.
    fn right_of_axis(&self, profile: &Profile) -> Result<f64, SweepError> {
        let (low, high) = profile.x_range();
        if low < -ON_AXIS * high.max(-low) {
            return Err(self.geometry(
                "contour",
                format!(
                    "found a contour that reaches x = {low:?}, expected x of at least 0, \
                     the distance from the axis of the rotation"
                ),
            ));
        }
        if high <= 0.0 {
            return Err(self.geometry(
                "contour",
                "found a contour on the axis of the rotation, expected some x above 0",
            ));
        }
        Ok(high)
    }

    fn sections(
        &self,
        given: &Sections,
        trajectory: &Trajectory,
    ) -> Result<(Profile, Blend), SweepError> {
        let path = "contour.sections";
        let count = given.sections.len();
        if !(2..=MOST_SECTIONS).contains(&count) {
            let message = format!("found {count}, expected from 2 to {MOST_SECTIONS} sections");
            return Err(self.fault(path, message));
        }
        let mut at: Vec<f64> = Vec::with_capacity(count);
        let mut contours: Vec<Contour> = Vec::with_capacity(count);
        for (i, section) in given.sections.iter().enumerate() {
            let path = format!("{path}[{i}]");
            let key = format!("{path}.at");
            if !(0.0..=1.0).contains(&section.at) {
                let message =
                    format!("found {:?}, expected a part of the length from 0 to 1", section.at);
                return Err(self.fault(&key, message));
            }
            if let Some(before) = at.last()
                && section.at <= *before
            {
                let message = format!(
                    "found {:?}, expected more than {before:?}, where the section before lies",
                    section.at
                );
                return Err(self.fault(&key, message));
            }
            let contour = self.contour(&format!("{path}.contour"), &section.contour)?;
            if let Some(first) = contours.first()
                && first.closed() != contour.closed()
            {
                let kind = |closed| if closed { "a closed" } else { "an open" };
                let message = format!(
                    "found {} contour, expected {} one like the first section's",
                    kind(contour.closed()),
                    kind(first.closed())
                );
                return Err(self.geometry(&format!("{path}.contour"), message));
            }
            at.push(section.at);
            contours.push(contour);
        }
        let wraps = trajectory.closed();
        if wraps && at.first() == Some(&0.0) && at.last() == Some(&1.0) {
            if given.sections[0].contour != given.sections[count - 1].contour {
                let message = "found another contour at 1 than at 0, expected the same, since the \
                               trajectory is closed";
                return Err(self.geometry(&format!("{path}[{}].contour", count - 1), message));
            }
            at.pop();
            contours.pop();
        }
        let profile = Profile::blended(contours, given.align);
        Ok((profile, Blend { at, ease: given.blend, wraps }))
    }
}

#[cfg(test)]
mod tests {
    use crate::read::tests::contour_complaint;
    use files::Exit;

    #[test]
    fn sections_have_their_complaints() {
        const A: &str = "{\"at\": 0, \"contour\": {\"circle\": 1}}";
        let open = "{\"at\": 1, \"contour\": {\"svg\": \"M0 0H1\"}}";
        let nested = format!("{{\"at\": 1, \"contour\": {{\"sections\": [{A}]}}}}");
        for (sections, message, exit) in [
            (A.to_owned(), "2:25: contour.sections: found 1, expected from 2 to 1000", 3),
            (format!("{A}, {A}"), "sections[1].at: found 0.0, expected more than 0.0", 3),
            (
                format!("{A}, {{\"at\": 1.5, \"contour\": {{\"circle\": 1}}}}"),
                "sections[1].at: found 1.5, expected a part of the length from 0 to 1",
                3,
            ),
            (
                format!("{A}, {{\"at\": 1, \"contour\": {{\"circle\": -1}}}}"),
                "sections[1].contour.circle: found -1.0, expected a number above 0",
                3,
            ),
            (format!("{A}, {{\"at\": 1}}"), "missing key `contour`", 3),
            (format!("{A}, {nested}"), "contour.sections: found sections inside a section", 3),
            (format!("{A}, {open}"), "sections[1].contour: found an open contour", 4),
            (
                format!("{A}, {{\"at\": 1, \"contour\": {{\"circle\": 2}}}}"),
                "sections[1].contour: found another contour at 1 than at 0",
                4,
            ),
        ] {
            let (found, code) = contour_complaint(&format!("{{\"sections\": [{sections}]}}"));
            assert!(found.starts_with("a.json:2:") && found.contains(message), "{found}");
            let expected = if exit == 3 { Exit::Malformed } else { Exit::Geometry };
            assert_eq!(code, expected, "{found}");
        }
        let (found, _) = contour_complaint("{\"circle\": 1, \"blend\": \"smooth\"}");
        assert!(found.contains("contour: found `blend` without `sections`"), "{found}");
    }
}
