//! Derivatives of rays and hits with respect to the position on the film.
//!
//! Source: H. Igehy, "Tracing Ray Differentials", SIGGRAPH 1999. A [`RayDifferential`] says how a
//! ray changes when its position on the film moves by one unit across or down. It follows the ray
//! through reflections and refractions. A [`Spread`] says the same of a hit. All derivatives are in
//! closed form. The unit of the film is that of the ray's start: a pixel, or a cell of a pixel.

use glam::{DVec2, DVec3};

/// How the origin and the direction of a ray change across and down the film.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct RayDifferential {
    /// Change of the origin, in scene units.
    pub origin: [DVec3; 2],
    /// Change of the unit direction, perpendicular to it.
    pub direction: [DVec3; 2],
}

/// How a hit changes across and down the film.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Spread {
    /// Change of the position along the surface, in scene units.
    pub position: [DVec3; 2],
    /// Change of the texture coordinates.
    pub uv: [DVec2; 2],
    /// Change of the unit normal for shading.
    pub normal: [DVec3; 2],
    /// Change of the unit direction of the ray that hits.
    pub incident: [DVec3; 2],
    /// Variance of the normal along each tangent of the surface, from relief that is finer than the
    /// footprint; a tangent of an angle, squared.
    pub roughness: f64,
}

impl RayDifferential {
    /// Returns the change of the point at which the ray meets a surface: `t` is the distance to the
    /// surface, and `normal` is the normal of its tangent plane (Igehy, eq. 10 and 12).
    #[must_use]
    pub fn transferred(&self, direction: DVec3, t: f64, normal: DVec3) -> [DVec3; 2] {
        let along = normal / direction.dot(normal);
        [0, 1].map(|k| {
            let moved = self.origin[k] + t * self.direction[k];
            moved - moved.dot(along) * direction
        })
    }
}

impl Spread {
    /// Returns the differential of the ray that a mirror reflects (Igehy, eq. 15). `incident` is
    /// the unit direction of the ray that hits, and `normal` is the unit normal that mirrors it.
    #[must_use]
    pub fn reflected(&self, incident: DVec3, normal: DVec3) -> RayDifferential {
        let cosine = incident.dot(normal);
        let direction = [0, 1].map(|k| {
            let change = self.incident[k].dot(normal) + incident.dot(self.normal[k]);
            self.incident[k] - 2.0 * (cosine * self.normal[k] + change * normal)
        });
        RayDifferential { origin: self.position, direction }
    }

    /// Returns the differential of the ray that a surface refracts (Igehy, eq. 18). `incident` is
    /// the unit direction of the ray that hits, `normal` is the unit normal that refracts it, on
    /// the side of the ray, and `eta` is the index of refraction on that side over the other one.
    ///
    /// The derivative has no bound near the critical angle. At the angle itself it is infinite or
    /// NaN.
    #[must_use]
    pub fn refracted(&self, incident: DVec3, normal: DVec3, eta: f64) -> RayDifferential {
        if eta == 1.0 {
            return RayDifferential { origin: self.position, direction: self.incident };
        }
        let c1 = -incident.dot(normal);
        let c2 = (1.0 - eta * eta * (1.0 - c1 * c1)).sqrt();
        let factor = eta * c1 - c2;
        let direction = [0, 1].map(|k| {
            let change = -(self.incident[k].dot(normal) + incident.dot(self.normal[k]));
            let of_factor = (eta - eta * eta * c1 / c2) * change;
            eta * self.incident[k] + factor * self.normal[k] + of_factor * normal
        });
        RayDifferential { origin: self.position, direction }
    }
}

/// Returns the changes of a unit vector from those of the vector `v` of which it is the direction.
#[must_use]
pub fn normalized(v: DVec3, changes: [DVec3; 2]) -> [DVec3; 2] {
    let length = v.length();
    let unit = v / length;
    changes.map(|change| (change - change.dot(unit) * unit) / length)
}
