//! Reads the motions of a whole part.

use super::Reader;
use crate::error::SweepError;
use crate::spec::Place;
use crate::surface::place::Placement;
use glam::{DQuat, DVec3};

impl Reader<'_> {
    /// Returns the motions of a part as one.
    pub(super) fn placement(&self, place: &[Place]) -> Result<Placement, SweepError> {
        let mut all = Placement::default();
        for (i, motion) in place.iter().enumerate() {
            let path = format!("place[{i}]");
            let next = match motion {
                Place::Translate(by) => {
                    self.point(&format!("{path}.translate"), by)?;
                    Placement { translation: DVec3::from_array(*by), ..Placement::default() }
                }
                Place::RotateDeg(turn) => {
                    let key = format!("{path}.rotate_deg");
                    self.point(&format!("{key}.axis"), &turn.axis)?;
                    self.number(&format!("{key}.angle"), turn.angle)?;
                    let Some(axis) = DVec3::from_array(turn.axis).try_normalize() else {
                        let message = "found a vector without length, expected an axis";
                        return Err(self.fault(&format!("{key}.axis"), message));
                    };
                    // The remainder keeps the digits of an angle of many turns.
                    let angle = (turn.angle % 360.0).to_radians();
                    let rotation = DQuat::from_axis_angle(axis, angle);
                    Placement { rotation, ..Placement::default() }
                }
                Place::Scale(factor) => {
                    self.positive(&format!("{path}.scale"), *factor)?;
                    Placement { scale: *factor, ..Placement::default() }
                }
            };
            all = all.then(next);
        }
        self.positive("place", all.scale)?;
        self.point("place", &all.translation.to_array())?;
        Ok(all)
    }
}
