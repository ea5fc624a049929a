//! Reads the caps of a spec.

use super::Reader;
use crate::curve::cut::{self, Stop};
use crate::error::SweepError;
use crate::spec::{Cap as Written, Caps};
use crate::surface::cap::{Cap, Form, center_of};
use crate::surface::lid::filled;
use crate::surface::modulation::Modulation;
use crate::surface::profile::Profile;
use crate::surface::shape::ON_AXIS;
use crate::trajectory::Trajectory;
use glam::DVec2;

/// Number of points of a section that a cap's centre must see, besides its corners.
const LOOKED_AT: usize = 720;

/// A section with less area than this fraction of its squared size cannot be the rim of a cap.
const NO_AREA: f64 = 1e-9;

impl Reader<'_> {
    /// Reads the caps of a sweep: those that shrink a section to a point, and for each end whether a lid closes it. `alone`
    /// is false for an outline with holes, whose ends only lids close.
    pub(super) fn caps(
        &self,
        caps: Option<Caps>,
        alone: bool,
        contour: &Profile,
        trajectory: &Trajectory,
        modulation: &Modulation,
    ) -> Result<([Option<Cap>; 2], [bool; 2]), SweepError> {
        let Some(Caps { start, end }) = caps else {
            return Ok(([None, None], [false; 2]));
        };
        let on_axis = trajectory.is_rotation() && Self::ends_on_axis(contour);
        if !(contour.closed() || on_axis) || trajectory.closed() {
            let found = if trajectory.is_rotation() && trajectory.closed() {
                "a rotation of a full turn, which has no ends"
            } else if trajectory.closed() {
                "a closed trajectory"
            } else {
                "an open contour"
            };
            let message =
                format!("found {found}, expected an open trajectory and a closed contour");
            return Err(self.geometry("caps", message));
        }
        let stops = cut::evenly(contour.breaks(), contour.closed(), LOOKED_AT);
        let columns = contour.columns(&stops);
        let cap = |key: &str, cap: Option<Written>, stop: Stop| {
            let Some(cap) = cap else { return Ok((None, false)) };
            let path = format!("caps.{key}");
            if !alone || trajectory.is_rotation() {
                if cap == Written::Flat {
                    return Ok((None, true));
                }
                let what = if alone { "a rotation" } else { "a section with holes" };
                let message = format!("found a cap on {what} that is not flat, expected `flat`");
                return Err(self.geometry(&path, message));
            }
            let section = modulation.section(trajectory, stop);
            let polygon: Vec<DVec2> =
                columns.iter().map(|column| section.local_point(column)).collect();
            let found = self.cap(&path, cap, &polygon);
            match found {
                Err(_)
                    if cap == Written::Flat && filled(std::slice::from_ref(&polygon)).is_some() =>
                {
                    Ok((None, true))
                }
                found => found.map(|cap| (Some(cap), false)),
            }
        };
        let (start, start_lid) = cap("start", start, Stop::after(0.0))?;
        let (end, end_lid) = cap("end", end, Stop::before(1.0))?;
        Ok(([start, end], [start_lid, end_lid]))
    }

    /// Returns whether an open contour starts and ends on the axis of a rotation.
    fn ends_on_axis(contour: &Profile) -> bool {
        let on_axis = ON_AXIS * contour.x_range().1;
        let ends = contour.columns(&[Stop::after(0.0), Stop::before(1.0)]);
        !contour.closed() && ends.iter().all(|end| end.first.point.x <= on_axis)
    }

    fn cap(&self, path: &str, cap: Written, polygon: &[DVec2]) -> Result<Cap, SweepError> {
        match cap {
            Written::Dome(height) => self.positive(&format!("{path}.dome"), height)?,
            Written::Pole(height) => self.positive(&format!("{path}.pole"), height)?,
            Written::Flat | Written::Round => {}
        }
        let size = polygon.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        let (center, _) = center_of(polygon)
            .filter(|(_, area)| area.abs() > NO_AREA * size * size)
            .ok_or_else(|| {
                let message = "found a cap on a section that is not star-shaped, expected `flat`, or a \
                               section whose outline is visible from one point inside";
                self.geometry(path, message)
            })?;
        let closing = polygon.iter().cycle().skip(1);
        let (mut length_along, mut moment) = (0.0, 0.0);
        for (from, to) in polygon.iter().zip(closing) {
            let length = from.distance(*to);
            length_along += length;
            moment += length * 0.5 * (from.distance(center) + to.distance(center));
        }
        let radius = moment / length_along;
        let form = match cap {
            Written::Flat => Form::Flat,
            Written::Round => Form::Dome(radius),
            Written::Dome(height) => Form::Dome(height),
            Written::Pole(height) => Form::Pole(height),
        };
        Ok(Cap { center, radius, form })
    }
}
