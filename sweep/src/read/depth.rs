//! Reads the relief of a spec and checks it against both curves.

use super::Reader;
use crate::error::SweepError;
use crate::grid::Across;
use crate::spec::{self, DepthMode, DepthTerm};
use crate::surface::depth::{Depth, Mode, Term};
use crate::surface::profile::Profile;
use crate::trajectory::Trajectory;
use std::sync::Arc;

/// Largest number of waves along a curve. Even a mesh of the largest number of cells shows fewer.
const MOST_WAVES: f64 = 1e6;

impl Reader<'_> {
    pub(super) fn depth(
        &self,
        depth: &spec::Depth,
        across: Across,
        contour: &Profile,
        trajectory: &Trajectory,
    ) -> Result<Depth, SweepError> {
        if depth.terms.is_empty() && depth.image.is_none() {
            return Err(self.fault("depth", "found no terms, expected at least one, or an image"));
        }
        let mode = match depth.mode {
            DepthMode::Factor => Mode::Factor,
            DepthMode::Offset => Mode::Offset,
        };
        if mode == Mode::Offset && contour.creases() > 0 {
            let message = format!(
                "found an offset of a contour with {} corners, which it would tear, expected a \
                 smooth contour or a factor",
                contour.creases()
            );
            return Err(self.geometry("depth.mode", message));
        }
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
        let depth = Depth { mode, terms, heights };
        let most = depth.most();
        if mode == Mode::Factor && most >= 1.0 {
            let message = format!(
                "found heights that add up to {most:?}, expected less than 1, so that the factor \
                 stays above 0"
            );
            return Err(self.geometry(path, message));
        }
        if trajectory.is_rotation() {
            self.off_axis("depth", contour)?;
            let (low, _) = contour.x_range();
            if mode == Mode::Offset && most >= low {
                let message = format!(
                    "found heights that add up to {most:?}, expected less than {low:?}, the \
                     distance from the axis of the rotation"
                );
                return Err(self.geometry(path, message));
            }
        }
        Ok(depth)
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

    #[test]
    fn an_offset_wants_a_smooth_contour() {
        let square = "{\"svg\": \"M1 1H-1V-1H1Z\"}, \"depth\": \
                      {\"mode\": \"offset\", \"terms\": [{\"amp\": 0.1}]}";
        let (found, exit) = complaint("{\"circle\": 0.25}", square);
        assert!(
            found.contains("depth.mode: found an offset of a contour with 4 corners"),
            "{found}"
        );
        assert_eq!(exit, Exit::Geometry);
    }
}
