//! Reads the wall of a spec.

use super::Reader;
use crate::curve::cut::Stop;
use crate::error::SweepError;
use crate::law::Law;
use crate::spec::{self, SeamKind, Spec, WallSide};
use crate::surface::Shape;
use crate::surface::contour::Contour;
use crate::surface::depth::{Depth, Mode};
use crate::surface::profile::{Column, Profile};
use crate::surface::wall::Wall;
use crate::trajectory::Trajectory;
use files::check::short;

/// Steps along the contour and along the trajectory at which a relief is compared with its wall.
const SAMPLES: usize = 1024;

/// The sides of a hollow sweep.
pub(super) struct Hollow {
    /// Distance of the outer side from the contour, along the outer normal.
    pub outer: Law,
    /// Distance of the inner side from the contour, against the outer normal.
    pub inner: Law,
    /// Thickness of the wall: the sum of both.
    pub thickness: Law,
}

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

    /// Returns the sides of a hollow sweep; `None` for a sweep that is not hollow.
    pub(super) fn hollow(
        &self,
        spec: &Spec,
        contours: &[Contour],
        trajectory: &Trajectory,
    ) -> Result<Option<Hollow>, SweepError> {
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
        let [outer, inner] = match side {
            WallSide::Inward => [nothing, thickness.clone()],
            WallSide::Outward => [thickness.clone(), nothing],
            WallSide::Center => [thickness.clone().halved(), thickness.clone().halved()],
        };
        Ok(Some(Hollow { outer, inner, thickness }))
    }

    /// Refuses a relief on the outer side of a wall that reaches the inner side.
    pub(super) fn relief_in_wall(
        &self,
        path: &str,
        depth: &Depth,
        contour: &Profile,
        scale: Option<&[Law; 2]>,
        thickness: &Law,
    ) -> Result<(), SweepError> {
        let [low, high] = depth.range();
        // A factor moves a point along the normal by the distance of its tangent from the origin.
        let inward = match depth.mode {
            Mode::Offset => -low,
            Mode::Factor => {
                let stops: Vec<Stop> =
                    (0..SAMPLES).map(|i| Stop::after(i as f64 / SAMPLES as f64)).collect();
                let out = |column: &Column| -column.first.tangent.perp().dot(column.first.point);
                let moved = contour.columns(&stops).into_iter().map(|column| out(&column));
                moved.fold(0.0, |most: f64, out| most.max((-low * out).max(-high * out)))
            }
        };
        for i in 0..=SAMPLES {
            let v = i as f64 / SAMPLES as f64;
            let factor = scale
                .map_or(1.0, |laws| laws.iter().map(|law| law.at(v).0.abs()).fold(0.0, f64::max));
            let (deepest, wall) = (inward * factor, thickness.at(v).0);
            if deepest >= wall {
                let [deepest, wall, v] = [deepest, wall, v].map(short);
                let message = format!(
                    "found a relief up to {deepest} deep in a wall of {wall} at {v} of the trajectory, expected \
                     less; a `zero` of the darkest grey, or a thicker wall, keeps the relief above the inner side"
                );
                return Err(self.geometry(path, message));
            }
        }
        Ok(())
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
