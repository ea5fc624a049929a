//! Reads the caps of a spec.

use super::Reader;
use crate::curve::cut::{self, Stop};
use crate::error::SweepError;
use crate::spec::{Cap as Written, Caps};
use crate::surface::cap::{Cap, Form, center_of};
use crate::surface::modulation::Modulation;
use crate::surface::profile::Profile;
use crate::trajectory::Trajectory;
use glam::DVec2;

/// Number of points of a section that a cap's centre must see, besides its corners.
const LOOKED_AT: usize = 720;

/// A section with less area than this fraction of its squared size cannot be the rim of a cap.
const NO_AREA: f64 = 1e-9;

impl Reader<'_> {
    pub(super) fn caps(
        &self,
        caps: Option<Caps>,
        contour: &Profile,
        trajectory: &Trajectory,
        modulation: &Modulation,
    ) -> Result<[Option<Cap>; 2], SweepError> {
        let Some(Caps { start, end }) = caps else {
            return Ok([None, None]);
        };
        if !contour.closed() || trajectory.closed() || trajectory.is_rotation() {
            let found = if trajectory.is_rotation() {
                "a rotation, whose ends close where the contour meets the axis"
            } else if trajectory.closed() {
                "a closed trajectory"
            } else {
                "an open contour"
            };
            let message =
                format!("found {found}, expected an open trajectory and a closed contour");
            return Err(self.geometry("caps", message));
        }
        let stops = cut::evenly(contour.breaks(), true, LOOKED_AT);
        let columns = contour.columns(&stops);
        let cap = |key: &str, cap: Option<Written>, stop: Stop| {
            let section = modulation.section(trajectory, stop);
            let polygon: Vec<DVec2> =
                columns.iter().map(|column| section.local_point(column)).collect();
            cap.map(|cap| self.cap(&format!("caps.{key}"), cap, &polygon)).transpose()
        };
        Ok([cap("start", start, Stop::after(0.0))?, cap("end", end, Stop::before(1.0))?])
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
                let message = "found a cap on a section that is not star-shaped, expected a \
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
