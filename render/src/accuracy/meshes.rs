//! The part of the error that meshes cause.

use super::bound::mean;
use super::chances::{Chances, Estimates};
use super::request::Request;
use super::sample::Sample;
use crate::film::{BasePicture, Course};

/// Draws by which two scenes are compared.
const DRAWS: usize = 1000;

/// Estimates the mean squared difference, over all pixels, of the light in the two scenes of a request:
/// that of its picture and that of its truth. They differ only in their meshes. The noise suits errors
/// near `error`.
///
/// Both scenes are looked at by the same rays, so that the difference has little noise. Runs on the
/// threads of the current rayon pool.
#[must_use]
pub fn apart(request: &Request<'_, '_>, error: f64) -> f64 {
    let &Request { prepared, truth, settings, pixel_filter, go_on, .. } = request;
    let course = Course { go_on, ..Course::told(&|_, _| {}) };
    let base = BasePicture::new(prepared, settings, pixel_filter, &course);
    let estimates = Estimates { errors: &base.errors, requested: error };
    let chances = Chances::new(&base.picture, Some(estimates));
    let sample = Sample::take(truth, base.settings(), &chances, (DRAWS, 0), error);
    let own = sample.again(prepared, base.settings(), DRAWS);
    let found = sample.first(DRAWS).zip(&own);
    let values = found.map(|((draw, truth), own)| draw.weight * own.squared_distance(truth));
    mean(&values.collect::<Vec<f64>>()).max(0.0)
}
