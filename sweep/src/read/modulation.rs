//! Reads the changes of a spec's contour along the trajectory, and checks them against both curves.

use super::Reader;
use super::measured::PointLaws;
use super::profile::Face;
use crate::error::SweepError;
use crate::law::Law;
use crate::spec::{self, Scale, SeamKind, Spec};
use crate::surface::modulation::{Modulation, Signs};
use crate::surface::profile::Profile;
use crate::surface::shape::ON_AXIS;
use crate::trajectory::Trajectory;
use glam::DVec2;

/// Ends of a law that differ by at most this fraction of their size are equal.
const SAME: f64 = 1e-9;

impl Reader<'_> {
    pub(super) fn modulation(
        &self,
        spec: &Spec,
        laws: &PointLaws,
        contour: &Profile,
        face: &Face,
        trajectory: &Trajectory,
    ) -> Result<(Modulation, Option<DVec2>), SweepError> {
        let (scales, twists) = (laws.scale.clone(), laws.twist.clone());
        if trajectory.is_rotation() && spec.scale.is_some() {
            self.off_axis("scale", contour)?;
        }
        let scale =
            spec.scale.as_ref().map(|scale| self.scale(scale, trajectory)).transpose()?.or(scales);
        let mut poles = Vec::new();
        let mut mirror = None;
        let scale = match scale {
            Some(laws) => {
                let signs = Signs::of(&laws);
                self.outside_out(&signs)?;
                let [x, y] = laws.map(|law| law.snapped(trajectory.breaks()));
                let first = signs.first();
                let laws = if first.x * first.y < 0.0 {
                    mirror = Some(first);
                    if first.x < 0.0 { [x.negated(), y] } else { [x, y.negated()] }
                } else {
                    [x, y]
                };
                poles = Signs::of(&laws).poles(trajectory.closed());
                Some(laws)
            }
            None => None,
        };
        let twist = spec
            .twist
            .as_ref()
            .map(|twist| self.twist(twist, trajectory, spec.seam))
            .transpose()?
            .or(twists)
            .map(|twist| twist.snapped(trajectory.breaks()));
        let depth = spec
            .depth
            .as_ref()
            .filter(|_| !matches!(face, Face::Bare))
            .map(|depth| self.depth(depth, spec.uv.across, contour, face, trajectory))
            .transpose()?;
        if let (Some(depth), Face::Skin(thickness)) = (&depth, face) {
            self.relief_in_wall("depth", depth, contour, scale.as_ref(), thickness)?;
        }
        Ok((
            Modulation { blend: None, scale, poles, twist, depth, offset: None, turn: 0.0 },
            mirror,
        ))
    }

    /// Refuses a contour that touches the axis of a rotation, where the change named by `path` would move the
    /// pole.
    pub(super) fn off_axis(&self, path: &str, contour: &Profile) -> Result<(), SweepError> {
        let (low, high) = contour.x_range();
        if low > ON_AXIS * high {
            return Ok(());
        }
        let message = "found a contour that touches the axis of the rotation, expected a contour \
                       that does not touch the axis, since all rows share the pole there";
        Err(self.geometry(path, message))
    }

    /// Refuses a scale that mirrors the contour in one part of the trajectory only.
    fn outside_out(&self, signs: &Signs) -> Result<(), SweepError> {
        let Some(at) = signs.inside_out() else {
            return Ok(());
        };
        let message = format!(
            "found factors of x and y of which only one passes 0 at {at:?}, which would mirror the \
             contour there and turn the surface inside out, expected both to pass 0 or none"
        );
        Err(self.geometry("scale", message))
    }

    fn scale(&self, scale: &Scale, trajectory: &Trajectory) -> Result<[Law; 2], SweepError> {
        Ok(match scale {
            Scale::Both(law) => {
                let law = self.factor("scale", law, trajectory)?;
                [law.clone(), law]
            }
            Scale::Each([x, y]) => {
                [self.factor("scale[0]", x, trajectory)?, self.factor("scale[1]", y, trajectory)?]
            }
        })
    }

    /// Reads the law of one axis of the scale.
    fn factor(
        &self,
        path: &str,
        law: &spec::Law,
        trajectory: &Trajectory,
    ) -> Result<Law, SweepError> {
        let law = self.law(path, law)?;
        let (low, high) = law.range();
        if low == 0.0 && high == 0.0 {
            return Err(self.fault(path, "found a scale of 0 everywhere, expected another number"));
        }
        if trajectory.is_rotation() {
            let x = path != "scale[1]";
            if x && low <= 0.0 {
                let message = format!(
                    "found a scale that falls to {low:?}, expected one above 0 about the axis of a \
                     rotation"
                );
                return Err(self.geometry(path, message));
            }
            if low <= 0.0 && high >= 0.0 {
                let message = "found a scale that reaches 0, expected a scale of one sign about \
                               the axis of a rotation";
                return Err(self.geometry(path, message));
            }
        }
        self.ends_meet(path, &law, trajectory)?;
        Ok(law)
    }

    fn twist(
        &self,
        law: &spec::Law,
        trajectory: &Trajectory,
        seam: Option<SeamKind>,
    ) -> Result<Law, SweepError> {
        if trajectory.is_rotation() {
            let message = "found a twist of a rotation, whose contour would leave the plane of its \
                           axis, expected none";
            return Err(self.geometry("twist", message));
        }
        let law = self.law("twist", law)?;
        if trajectory.closed() && seam.is_none() {
            let [start, end] = law.ends();
            let turns = (end - start) / 360.0;
            if (turns - turns.round()).abs() > SAME * turns.abs().max(1.0) {
                let message = format!(
                    "found a turn of {:?} degrees along a closed trajectory, expected a multiple \
                     of 360, so that each column meets itself, or a `seam`",
                    end - start
                );
                return Err(self.geometry("twist", message));
            }
        }
        Ok(law)
    }

    /// Refuses a law that ends with another value than it starts with, if the trajectory is closed.
    pub(super) fn ends_meet(
        &self,
        path: &str,
        law: &Law,
        trajectory: &Trajectory,
    ) -> Result<(), SweepError> {
        let [start, end] = law.ends();
        if !trajectory.closed() || (end - start).abs() <= SAME * start.abs().max(end.abs()) {
            return Ok(());
        }
        let message = format!(
            "found {start:?} at the start and {end:?} at the end, expected the same at both, since \
             the trajectory is closed"
        );
        Err(self.geometry(path, message))
    }
}

#[cfg(test)]
mod tests {
    use crate::read::tests::complaint;
    use crate::sampling::Sweep;
    use files::json::Document;
    use files::{Exit, Failure};

    #[test]
    fn laws_have_their_complaints() {
        for (keys, message, exit) in [
            (
                "\"scale\": [1, {\"keys\": [[0, 1], [0.5, -1], [1, 1]]}]",
                "4:10: scale: found factors of x and y of which only one passes 0 at 0.25",
                4,
            ),
            ("\"scale\": 0", "4:10: scale: found a scale of 0 everywhere", 3),
            ("\"scale\": 1e61", "4:10: scale: found 1e61, expected a number of at most", 3),
            ("\"scale\": \"big\"", "4:10: scale: ", 3),
            ("\"scale\": [1]", "4:10: scale: ", 3),
            ("\"scale\": [1, 1, 1]", "scale", 3),
            ("\"scale\": [1, {\"keys\": []}]", "4:23: scale[1].keys: found no keys", 3),
            (
                "\"twist\": {\"keys\": [[0, 1], [0, 2]]}",
                "4:28: twist.keys[1]: found a key at 0.0",
                3,
            ),
            ("\"twist\": {\"keys\": [[0, 1], [1.5, 2]]}", "4:29: twist.keys[1][0]: found 1.5", 3),
            ("\"twist\": {\"keys\": [[0, 1]], \"ease\": \"slow\"}", "twist.ease: ", 3),
            ("\"twist\": {\"total\": 1, \"ease\": \"linear\"}", "found `ease` without `keys`", 3),
            ("\"twist\": {\"totl\": 1}", "did you mean `total`?", 3),
            ("\"twist\": {}", "twist: found no law, expected one of keys, bezier, total", 3),
            ("\"twist\": {\"total\": 1, \"bezier\": []}", "found both `bezier` and `total`", 3),
            ("\"twist\": {\"bezier\": []}", "twist.bezier: found no segments", 3),
            (
                "\"twist\": {\"bezier\": [[[0,0],[1.5,0],[0,0],[1,0]]]}",
                "4:30: twist.bezier[0][1][0]: found 1.5, expected a part of the length",
                3,
            ),
            (
                "\"twist\": {\"bezier\": [[[0.5,0],[0,0],[0,0],[1,0]]]}",
                "4:22: twist.bezier[0]: found a segment that turns back",
                3,
            ),
            (
                "\"twist\": {\"bezier\": [[[0,0],[0,0],[0,0],[0.5,0]], [[0.5,1],[1,0],[1,0],[1,0]]]}",
                "twist.bezier[1][0]: found [0.5, 1.0], expected [0.5, 0.0]",
                3,
            ),
            (
                "\"twist\": {\"total\": 90}",
                "4:10: twist: found a turn of 90.0 degrees along a closed",
                4,
            ),
            (
                "\"scale\": [{\"keys\": [[0, 1], [1, 2]]}, 1]",
                "4:11: scale[0]: found 1.0 at the start and 2.0 at the end",
                4,
            ),
        ] {
            let (found, code) = complaint("\"mesh\"", &format!("{keys}, \"mesh\""));
            assert!(found.starts_with("a.json:4:") && found.contains(message), "{keys}: {found}");
            let expected = if exit == 3 { Exit::Malformed } else { Exit::Geometry };
            assert_eq!(code, expected, "{keys}");
        }
    }

    #[test]
    fn a_rotation_is_not_twisted_and_its_scale_wants_a_contour_off_the_axis() {
        for (keys, contour, message) in [
            ("\"twist\": 3", "M1 0V-1", "twist: found a twist of a rotation"),
            (
                "\"scale\": -1",
                "M1 0V-1",
                "scale: found a scale that falls to -1.0, expected one above 0",
            ),
            ("\"scale\": 2", "M0 0H1V-1", "scale: found a contour that touches the axis"),
            (
                "\"scale\": {\"keys\": [[0, 1], [0.5, 0], [1, 1]]}",
                "M1 0V-1",
                "scale: found a scale that falls to 0.0, expected one above 0",
            ),
        ] {
            let text = format!(
                r#"{{"format": "tb-sweep", "version": 1, "name": "bowl", {keys},
                "contour": {{"svg": "{contour}"}}, "trajectory": {{"rotation": {{}}}},
                "mesh": {{"rows": 9, "cols": 8}}}}"#
            );
            let document = Document::new("a.json", text.as_bytes()).unwrap();
            let error = Sweep::read(&document).unwrap_err();
            assert!(error.to_string().contains(message), "{error}");
            assert_eq!(error.exit(), Exit::Geometry);
        }
    }
}
