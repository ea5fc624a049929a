//! Reads the wall of a spec.

use super::Reader;
use crate::error::SweepError;
use crate::law::Law;
use crate::spec::{self, SeamKind, Spec, WallSide};
use crate::surface::Shape;
use crate::surface::contour::Contour;
use crate::surface::wall::Wall;
use crate::trajectory::Trajectory;

impl Reader<'_> {
    /// Returns the wall of a spec; `shape` is the sheet in the middle of the wall.
    pub(super) fn wall(&self, spec: &Spec, shape: &Shape) -> Result<Option<Wall>, SweepError> {
        let Some(written) = spec.wall.as_ref().filter(|_| spec.seam == Some(SeamKind::Mirror))
        else {
            return Ok(None);
        };
        let spec::Wall::Thickness(thickness) = *written else {
            let message = "found an object, expected a number, since the wall of a mirrored surface has no side";
            return Err(self.fault("wall", message));
        };
        self.positive("wall", thickness)?;
        let refused = |message: &str| Err(self.geometry("wall", message));
        if !shape.contour.closed() {
            return refused("found a wall of a surface with a rim, expected a closed contour");
        }
        if !(shape.row_breaks().is_empty() && shape.contour.breaks().is_empty()) {
            return refused("found a wall of a surface with edges or poles, expected a smooth one");
        }
        if !spec.areas.is_empty() {
            return refused("found a wall and areas, expected one of them");
        }
        Ok(Some(Wall { half: 0.5 * thickness }))
    }

    /// Returns the distances of the outer and of the inner surface of a hollow sweep from its contour, each along the
    /// normal that points out of the wall; `None` for a sweep that is not hollow.
    pub(super) fn hollow(
        &self,
        spec: &Spec,
        contours: &[Contour],
        trajectory: &Trajectory,
    ) -> Result<Option<[Law; 2]>, SweepError> {
        let Some(wall) = spec.wall.as_ref().filter(|_| spec.seam != Some(SeamKind::Mirror)) else {
            return Ok(None);
        };
        let (thickness, side) = match wall {
            spec::Wall::Thickness(number) => {
                self.positive("wall", *number)?;
                (Law::constant(*number), WallSide::Inward)
            }
            spec::Wall::Keys(keys) => (self.law("wall.thickness", &keys.thickness)?, keys.side),
        };
        let (low, _) = thickness.range();
        if low <= 0.0 {
            let message =
                format!("found a thickness that falls to {low:?}, expected a number above 0");
            return Err(self.fault("wall.thickness", message));
        }
        self.ends_meet("wall.thickness", &thickness, trajectory)?;
        let refused = |message: &str| Err(self.geometry("wall", message));
        let [contour] = contours else {
            return refused(
                "found a wall of several loops, expected one loop, or loops without a wall",
            );
        };
        if !contour.closed() {
            return refused("found a wall of an open contour, expected a closed contour");
        }
        if !contour.has_straight_sides() {
            return refused(
                "found a wall of a contour with corners and bent sides, expected a smooth contour, or corners \
                 between straight sides",
            );
        }
        if matches!(spec.contour, spec::Contour::Sections(_)) {
            return refused("found a wall of sections, expected one contour");
        }
        for (key, given) in [
            ("caps", spec.caps.is_some()),
            ("depth", spec.depth.is_some()),
            ("areas", !spec.areas.is_empty()),
            ("seam", spec.seam.is_some()),
        ] {
            if given {
                let message = format!("found a wall and `{key}`, expected one of the two");
                return Err(self.geometry("wall", message));
            }
        }
        let thickness = thickness.snapped(trajectory.breaks());
        let nothing = Law::constant(0.0);
        Ok(Some(match side {
            WallSide::Inward => [nothing, thickness],
            WallSide::Outward => [thickness, nothing],
            WallSide::Center => [thickness.clone().halved(), thickness.halved()],
        }))
    }
}

#[cfg(test)]
mod tests {
    use crate::read::tests::complaint;
    use files::Exit;

    #[test]
    fn what_has_no_smooth_mirrored_sheet_has_no_wall() {
        let eight = "{\"free\": {\"closed\": true, \"points\": [[0,0],[0.4,0.2],[0.4,-0.2],[0,0],\
                     [-0.4,0.2],[-0.4,-0.2]]}}";
        for (contour, keys, message, exit) in [
            (
                "{\"circle\": 0.2}",
                "\"wall\": 0",
                "wall: found 0.0, expected a number above 0",
                Exit::Malformed,
            ),
            (
                "{\"svg\": \"M-0.2 0H0.2\"}",
                "\"wall\": 0.1, \"seam\": \"mirror\"",
                "wall: found a wall of a surface with a rim",
                Exit::Geometry,
            ),
            (
                "{\"svg\": \"M0 0L0.4 0.2V-0.2L-0.4 0.2V-0.2Z\"}",
                "\"wall\": 0.1, \"seam\": \"mirror\"",
                "wall: found a wall of a surface with edges",
                Exit::Geometry,
            ),
            (
                eight,
                "\"wall\": 0.02, \"seam\": \"mirror\", \"twist\": {\"total\": 180}, \"areas\": [{\"rows\": [0, 4], \"cols\": [0, 8], \"texture\": 2}]",
                "wall: found a wall and areas",
                Exit::Geometry,
            ),
        ] {
            let (found, code) = complaint("{\"circle\": 0.25}", &format!("{contour}, {keys}"));
            assert!(found.contains(message), "{found}");
            assert_eq!(code, exit, "{found}");
        }
    }
}
