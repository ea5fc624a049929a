//! Rays in the space of an instance.
//!
//! A ray is transformed to the instance's own space, where the mesh and its structure are, and its hits
//! are transformed back. All structures find the same hits, since the conditions of a hit do not depend
//! on them: the ray crosses the box of the instance, and meets a triangle in own space. Where both
//! roundings disagree, the box decides that no hit lies before it.

use super::Accel;
use super::leaf::Probe;
use super::slabs::SlabRay;
use crate::ray::{Hit, Ray};
use crate::shape::Instance;

/// A ray in the space of an instance.
#[derive(Debug, Clone, Copy)]
pub struct OwnRay {
    /// The ray, with a unit direction.
    pub ray: Ray,
    /// Largest absolute coordinate of the mesh, in own units.
    pub extent: f64,
    /// Own units of one scene unit along the ray.
    length: f64,
    /// Distance at which the ray enters the box of the instance, in scene units.
    enter: f64,
    /// Distance from the start within which a surface coincides with the start, in own units.
    skin: f64,
}

impl OwnRay {
    /// Transforms a ray, or returns `None` if the ray misses the box of the instance, or enters it beyond
    /// `t_max`. `slabs` are those of the ray in the scene.
    #[must_use]
    #[inline]
    pub fn new(
        accel: &Accel<'_>,
        (object, instance): (u32, &Instance),
        ray: &Ray,
        slabs: &SlabRay,
        t_max: f64,
    ) -> Option<Self> {
        let bounds = accel.bounds[object as usize]?;
        let [enter, _] = slabs.crosses(bounds)?;
        if enter > t_max {
            return None;
        }
        let (origin, direction, length) = instance.own_ray(ray.origin, ray.direction);
        let skin = instance.own_length(Probe::new(accel, ray).skin(accel, object));
        let ray = Ray { origin, direction, leaving: ray.leaving };
        Some(Self { ray, extent: instance.shared().extent(), length, enter, skin })
    }

    /// Returns the ray prepared for tests in own space.
    #[must_use]
    #[inline(always)]
    pub fn probe(&self) -> Probe<'_> {
        Probe::within(&self.ray, self.extent, self.skin)
    }

    /// Returns a distance in own space beyond which no hit lies within `t_max` in the scene.
    #[must_use]
    #[inline(always)]
    pub fn limit(&self, t_max: f64) -> f64 {
        // The product and the quotient of a hit's distance are rounded once each.
        t_max * self.length * (1.0 + 4.0 * f64::EPSILON)
    }

    /// Returns a hit in own space as a hit in the scene, if it lies in `(0, t_max]` there.
    #[must_use]
    #[inline(always)]
    pub fn in_scene(&self, hit: Hit, t_max: f64) -> Option<Hit> {
        let t = (hit.t / self.length).max(self.enter);
        (t > 0.0 && t <= t_max).then_some(Hit { t, ..hit })
    }
}
