//! Reads the relief of a spec and checks it against both curves.

use super::Reader;
use super::profile::Face;
use crate::curve::cut::Stop;
use crate::error::SweepError;
use crate::grid::Across;
use crate::spec::{self, DepthMode, DepthTerm};
use crate::surface::depth::{Depth, Mode, Term};
use crate::surface::fade::Cover;
use crate::surface::profile::Profile;
use crate::surface::shape::ON_AXIS;
use crate::trajectory::Trajectory;
use std::sync::Arc;

/// Length of the fade of a relief, as a fraction of the contour's, if the spec states none.
const FADE: f64 = 0.05;

/// Steps along a contour at which its relief is compared with the distance from the axis.
const SAMPLES: usize = 2048;

/// Largest number of waves along a curve. Even a mesh of the largest number of cells shows fewer.
const MOST_WAVES: f64 = 1e6;

impl Reader<'_> {
    pub(super) fn depth(
        &self,
        depth: &spec::Depth,
        across: Across,
        contour: &Profile,
        face: &Face,
        trajectory: &Trajectory,
    ) -> Result<Depth, SweepError> {
        if depth.terms.is_empty() && depth.image.is_none() {
            return Err(self.fault("depth", "found no terms, expected at least one, or an image"));
        }
        let mode = match depth.mode {
            DepthMode::Factor => Mode::Factor,
            DepthMode::Offset => Mode::Offset,
        };
        let terms: Result<Vec<Term>, _> = depth
            .terms
            .iter()
            .enumerate()
            .map(|(i, term)| self.term(&format!("depth.terms[{i}]"), term, contour, trajectory))
            .collect();
        let terms = terms?;
        let heights = match &depth.image {
            Some(image) => Some(Arc::new(self.heights(image, across, contour, trajectory)?)),
            None => None,
        };
        let path = if terms.is_empty() { "depth.image.amp" } else { "depth.terms" };
        let cover = self.cover(depth, mode, contour, face, trajectory)?;
        let depth = Depth { mode, terms, heights, cover };
        let most = depth.most();
        if mode == Mode::Factor && most >= 1.0 {
            let message = format!(
                "found heights that add up to {most:?}, expected less than 1, so that the factor \
                 stays above 0"
            );
            return Err(self.geometry(path, message));
        }
        if trajectory.is_rotation() && mode == Mode::Offset {
            self.above_axis(path, &depth, contour)?;
        }
        if let Face::Part { thickness, .. } = *face {
            let size = if mode == Mode::Offset { 1.0 } else { contour.x_range().1 };
            let deepest = -depth.range()[0] * size;
            if deepest >= thickness {
                let message = format!(
                    "found a relief up to {deepest:?} deep in a wall of {thickness:?}, expected less; a `zero` of the \
                     darkest grey raises the relief above the wall"
                );
                return Err(self.geometry(path, message));
            }
        }
        Ok(depth)
    }

    /// Returns where the relief covers the contour, and where it fades; `None` if it covers all of it evenly.
    fn cover(
        &self,
        depth: &spec::Depth,
        mode: Mode,
        contour: &Profile,
        face: &Face,
        trajectory: &Trajectory,
    ) -> Result<Option<Arc<Cover>>, SweepError> {
        if let Some(fade) = depth.fade {
            self.positive("depth.fade", fade)?;
        }
        let length = contour.length();
        let fade = depth.fade.unwrap_or(FADE * length) / length;
        let asked = depth.fade.is_some();
        let (range, rims) = match *face {
            Face::Part { range, .. } => (range, true),
            Face::Whole | Face::Skin(_) | Face::Bare => ([0.0, 1.0], asked && !contour.closed()),
        };
        let on_axis = ON_AXIS * contour.x_range().1;
        let at_axis = |stop: Stop| {
            let axis = trajectory.is_rotation() && !contour.closed();
            axis && contour.columns(&[stop])[0].first.point.x <= on_axis
        };
        let ends = [rims || at_axis(Stop::after(0.0)), rims || at_axis(Stop::before(1.0))];
        let corners = if mode == Mode::Offset || asked { contour.breaks() } else { &[] };
        let cover = Cover::new(range, corners, ends, contour.closed(), fade);
        Ok((cover.fades() || range != [0.0, 1.0]).then(|| Arc::new(cover)))
    }

    /// Refuses a relief that reaches the axis of a rotation.
    fn above_axis(&self, path: &str, depth: &Depth, contour: &Profile) -> Result<(), SweepError> {
        let [low, high] = depth.range();
        let stops: Vec<Stop> =
            (0..=SAMPLES).map(|i| Stop::after(i as f64 / SAMPLES as f64)).collect();
        let on_axis = ON_AXIS * contour.x_range().1;
        for column in contour.columns(&stops) {
            for local in std::iter::once(&column.first).chain(&column.others) {
                let factor = match &depth.cover {
                    Some(cover) => cover.at(column.u).map_or(0.0, |covered| covered.factor),
                    None => 1.0,
                };
                let outward = -local.tangent.perp().x * factor;
                let x = local.point.x;
                if x > on_axis && x + (low * outward).min(high * outward) <= 0.0 {
                    let message = format!(
                        "found heights from {low:?} to {high:?}, expected less than {x:?}, the distance from the axis of the \
                         rotation at the height {:?}",
                        local.point.y
                    );
                    return Err(self.geometry(path, message));
                }
            }
        }
        Ok(())
    }

    fn term(
        &self,
        path: &str,
        term: &DepthTerm,
        contour: &Profile,
        trajectory: &Trajectory,
    ) -> Result<Term, SweepError> {
        self.number(&format!("{path}.amp"), term.amp)?;
        self.number(&format!("{path}.phase_deg"), term.phase_deg)?;
        let directions = [
            ("u", term.u, contour.closed(), "contour"),
            ("v", term.v, trajectory.closed(), "trajectory"),
        ];
        for (key, waves, closed, curve) in directions {
            let path = format!("{path}.{key}");
            if closed && waves.fract() != 0.0 {
                let message = format!(
                    "found {waves:?} waves, expected a whole number, since the {curve} is closed"
                );
                return Err(self.fault(&path, message));
            }
            if waves.abs() > MOST_WAVES {
                let message = format!("found {waves:?} waves, expected at most {MOST_WAVES:?}");
                return Err(self.fault(&path, message));
            }
        }
        let along_path = format!("{path}.along");
        let along = self.law(&along_path, &term.along)?;
        self.ends_meet(&along_path, &along, trajectory)?;
        let along = along.snapped(trajectory.breaks());
        Ok(Term { amp: term.amp, u: term.u, v: term.v, phase: term.phase_deg / 360.0, along })
    }
}

#[cfg(test)]
mod tests {
    use crate::read::tests::complaint;
    use files::Exit;

    #[test]
    fn each_key_of_a_relief_has_its_complaint() {
        let malformed = [
            ("\"terms\": []", "4:10: depth: found no terms"),
            ("\"terms\": [{}]", "depth.terms[0]"),
            ("\"terms\": [{\"amp\": 1e61}]", "4:47: depth.terms[0].amp: found 1e61"),
            ("\"terms\": [{\"amp\": 0.1, \"u\": 2.5}]", "4:57: depth.terms[0].u: found 2.5 waves"),
            ("\"terms\": [{\"amp\": 0.1, \"v\": 0.5}]", "4:57: depth.terms[0].v: found 0.5 waves"),
            ("\"terms\": [{\"amp\": 0.1, \"u\": 1e7}]", "depth.terms[0].u: found 10000000.0 waves"),
            ("\"terms\": [{\"amp\": 0.1, \"w\": 1}]", "unknown key `w`"),
            ("\"terms\": [{\"amp\": 0.1, \"along\": {\"keys\": []}}]", "along.keys: found no keys"),
            ("\"image\": {\"amp\": 0.1}", "4:38: depth.image: missing key `file`"),
        ];
        let geometry = [
            ("\"terms\": [{\"amp\": -0.6}, {\"amp\": 0.5}]", "heights that add up to 1.1"),
            (
                "\"terms\": [{\"amp\": 0.1, \"along\": {\"total\": 1}}]",
                "along: found 0.0 at the start",
            ),
        ];
        for (cases, expected) in
            [(&malformed[..], Exit::Malformed), (&geometry[..], Exit::Geometry)]
        {
            for (terms, message) in cases {
                let keys = format!("\"depth\": {{\"mode\": \"factor\", {terms}}}, \"mesh\"");
                let (found, code) = complaint("\"mesh\"", &keys);
                assert!(found.starts_with("a.json:4:") && found.contains(message), "{found}");
                assert_eq!(code, expected, "{found}");
            }
        }
        let (found, _) = complaint("\"mesh\"", "\"depth\": {\"mode\": \"deep\"}, \"mesh\"");
        assert!(found.contains("depth.mode"), "{found}");
    }
}
