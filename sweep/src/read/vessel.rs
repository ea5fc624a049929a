//! Reads the wall of a rotation with an open contour: a vessel.

use super::Reader;
use super::profile::{Face, Loop};
use crate::error::SweepError;
use crate::law::Law;
use crate::spec::{self, Rim, Spec, WallKeys, WallSide};
use crate::surface::contour::Contour;
use crate::surface::profile::Profile;
use crate::surface::shape::ON_AXIS;
use crate::surface::vessel::{self, Fault, Vessel};
use files::check::short;

impl Reader<'_> {
    /// Returns the outlines of the wall of a vessel. `high` is the largest distance of its profile from the axis.
    pub(super) fn vessel(
        &self,
        spec: &Spec,
        wall: &spec::Wall,
        profile: &Contour,
        high: f64,
    ) -> Result<Vec<Loop>, SweepError> {
        let (path, keys) = match wall {
            spec::Wall::Thickness(number) => {
                self.positive("wall", *number)?;
                let thickness = spec::Law::Number(*number);
                let keys =
                    WallKeys { thickness, side: WallSide::Inward, rim: Rim::Flat, floor: None };
                ("wall", keys)
            }
            spec::Wall::Keys(keys) => ("wall.thickness", keys.clone()),
        };
        let thickness = match &keys.thickness {
            spec::Law::Number(number) => Law::constant(*number),
            law => self.law(path, law)?,
        };
        let thickness = thickness.snapped(&profile.breaks());
        let (low, _) = thickness.range();
        self.positive(path, low)?;
        let on_axis = ON_AXIS * high;
        let wall = Vessel {
            profile,
            thickness: &thickness,
            floor: keys.floor,
            parts: match keys.side {
                WallSide::Inward => [0.0, 1.0],
                WallSide::Outward => [1.0, 0.0],
                WallSide::Center => [0.5, 0.5],
            },
            rim: match keys.rim {
                Rim::Flat => vessel::Rim::Flat,
                Rim::Round => vessel::Rim::Round,
            },
            on_axis,
        };
        if let Some(floor) = keys.floor {
            self.positive("wall.floor", floor)?;
            if !wall.on_axis().contains(&true) || profile.creases() == 0 {
                let message = "found a floor of a profile without a corner between the axis and its side, expected \
                               a profile that starts on the axis and has a corner";
                return Err(self.geometry("wall.floor", message));
            }
        }
        for (key, given) in [("caps", spec.caps.is_some()), ("seam", spec.seam.is_some())] {
            if given {
                let message = format!("found a wall and `{key}`, expected one of the two");
                return Err(self.geometry("wall", message));
            }
        }
        let outlines = wall.outlines().map_err(|fault| {
            let message = match fault {
                Fault::Fills(height) => format!(
                    "found a wall that reaches the axis at the height {}, expected a thinner one, or a wider profile",
                    short(height)
                ),
                Fault::Long(count) => format!(
                    "found a profile of {count} pieces, expected at most 6000 for a wall; `free` with `fit` takes fewer"
                ),
                Fault::Empty => "found a wall without an inner side, expected a thinner one".into(),
            };
            self.geometry("wall", message)
        })?;
        let bend = wall.tightest();
        let one = |outline: vessel::Outline| Loop {
            // A hollow keeps its direction, in which the wall lies to the left.
            profile: Profile::single(Contour::drawn(outline.path)),
            blend: None,
            offset: None,
            face: match outline.face {
                Some(range) => Face::Part { range, thickness: low },
                None => Face::Bare,
            },
            bend,
        };
        Ok(outlines.into_iter().map(one).collect())
    }
}
