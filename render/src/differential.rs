//! Derivatives of rays and hits with respect to the position on the film.
//!
//! Source: H. Igehy, "Tracing Ray Differentials", SIGGRAPH 1999. A [`RayDifferential`] says how a
//! ray changes when its position on the film moves by one unit across or down. It follows the ray
//! through reflections and refractions. A [`Spread`] says the same of a hit. All derivatives are in
//! closed form. The unit of the film is that of the ray's start: a pixel, or a cell of a pixel.

use glam::{DMat2, DVec2, DVec3};

/// Inverse of the variance of a number that is spread evenly over a range of length 1.
const PER_SIDE: f64 = 12.0;

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
    /// footprint; a tangent of an angle, squared. The changes of the normal do not contain it.
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
    /// The roughness widens it.
    #[must_use]
    pub fn reflected(&self, incident: DVec3, normal: DVec3) -> RayDifferential {
        let cosine = incident.dot(normal);
        let turned = |of_incident: DVec3, of_normal: DVec3| {
            let change = of_incident.dot(normal) + incident.dot(of_normal);
            of_incident - 2.0 * (cosine * of_normal + change * normal)
        };
        let along = incident - 2.0 * cosine * normal;
        self.turned(along, normal, turned)
    }

    /// Returns the differential of the ray that a surface refracts (Igehy, eq. 18). `incident` is
    /// the unit direction of the ray that hits, `normal` is the unit normal that refracts it, on
    /// the side of the ray, and `eta` is the index of refraction on that side over the other one.
    /// The roughness widens it.
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
        let turned = |of_incident: DVec3, of_normal: DVec3| {
            let change = -(of_incident.dot(normal) + incident.dot(of_normal));
            let of_factor = (eta - eta * eta * c1 / c2) * change;
            eta * of_incident + factor * of_normal + of_factor * normal
        };
        let along = eta * incident + factor * normal;
        self.turned(along, normal, turned)
    }

    /// Returns the differential of a ray that leaves in the direction `along`. `turned` returns the
    /// change of this direction for changes of the incident direction and of the normal.
    fn turned(
        &self,
        along: DVec3,
        normal: DVec3,
        turned: impl Fn(DVec3, DVec3) -> DVec3,
    ) -> RayDifferential {
        let direction = [0, 1].map(|k| turned(self.incident[k], self.normal[k]));
        let direction = if self.roughness > 0.0 {
            let (one, other) = normal.any_orthonormal_pair();
            let tilts = [one, other].map(|tangent| turned(DVec3::ZERO, tangent));
            widened(direction, along, tilts.map(|tilt| tilt * self.roughness.sqrt()))
        } else {
            direction
        };
        RayDifferential { origin: self.position, direction }
    }

    /// Returns the variance of the normal along a tangent within the spread, as a mean over both
    /// tangents: the roughness and the share of the normal's changes. It is at least 0, and infinite
    /// where a change has no bound.
    #[must_use]
    pub fn normal_variance(&self) -> f64 {
        let changes: f64 = self.normal.iter().map(|change| change.length_squared()).sum();
        let variance = self.roughness + 0.5 * changes / PER_SIDE;
        if variance.is_nan() { f64::INFINITY } else { variance }
    }
}

/// Returns the changes of a direction whose covariance is that of `changes` plus that of two
/// independent deviations of one standard deviation each. All are perpendicular to `along`, a unit
/// vector.
///
/// The two changes `J` span a parallelogram, over which directions have the covariance
/// `J J^T / 12`. The new changes `K` have `K K^T = J J^T + 12 C`. Among the matrices with this
/// product, `K` is the nearest to `J`.
fn widened(changes: [DVec3; 2], along: DVec3, deviations: [DVec3; 2]) -> [DVec3; 2] {
    let (across, down) = along.any_orthonormal_pair();
    let flat = |pair: [DVec3; 2]| {
        let [one, other] = pair.map(|v| DVec2::new(across.dot(v), down.dot(v)));
        DMat2::from_cols(one, other)
    };
    let (j, c) = (flat(changes), flat(deviations));
    let square = j * j.transpose() + PER_SIDE * (c * c.transpose());
    // The square root of a symmetric matrix of two rows, by the theorem of Cayley and Hamilton.
    let root_of_determinant = square.determinant().max(0.0).sqrt();
    let trace = square.x_axis.x + square.y_axis.y + 2.0 * root_of_determinant;
    let root =
        (square + DMat2::from_diagonal(DVec2::splat(root_of_determinant))) * trace.sqrt().recip();
    let widened = root * nearest_orthogonal(root * j);
    if !widened.is_finite() {
        return changes;
    }
    [widened.x_axis, widened.y_axis].map(|v| v.x * across + v.y * down)
}

/// Returns the rotation or mirroring nearest to a matrix.
fn nearest_orthogonal(m: DMat2) -> DMat2 {
    let [a, b, c, d] = m.to_cols_array();
    let mirrors = m.determinant() < 0.0;
    let (cosine, sine) = if mirrors { (a - d, b + c) } else { (a + d, b - c) };
    let length = cosine.hypot(sine);
    if length == 0.0 {
        return DMat2::IDENTITY;
    }
    let (cosine, sine) = (cosine / length, sine / length);
    let sign = if mirrors { -1.0 } else { 1.0 };
    DMat2::from_cols_array(&[cosine, sine, -sign * sine, sign * cosine])
}

/// Returns the changes of a unit vector from those of the vector `v` of which it is the direction.
#[must_use]
pub fn normalized(v: DVec3, changes: [DVec3; 2]) -> [DVec3; 2] {
    let length = v.length();
    let unit = v / length;
    changes.map(|change| (change - change.dot(unit) * unit) / length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat3;
    use proptest::prelude::*;

    fn vector() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-1.0..1.0f64).prop_map(DVec3::from)
    }

    fn unit() -> impl Strategy<Value = DVec3> {
        vector().prop_filter("a direction", |v| v.length() > 0.1).prop_map(DVec3::normalize)
    }

    /// The sum of the products of each vector with itself.
    fn square(vectors: &[DVec3]) -> DMat3 {
        vectors.iter().map(|&v| DMat3::from_cols(v * v.x, v * v.y, v * v.z)).sum()
    }

    proptest! {
        /// The covariances add, and little roughness changes little.
        #[test]
        fn roughness_adds_its_covariance(
            along in unit(), all in prop::array::uniform4(vector()), size in 0.0..3.0f64,
        ) {
            let flat = all.map(|v| v - v.dot(along) * along);
            let changes = [flat[0], flat[1]];
            let deviations = [size * flat[2], size * flat[3]];
            let found = widened(changes, along, deviations);
            let truth = square(&changes) + 12.0 * square(&deviations);
            // The root of a matrix with a small eigenvalue loses half of its digits.
            prop_assert!(square(&found).abs_diff_eq(truth, 1e-6), "{found:?}");
            let less = widened(changes, along, deviations.map(|v| 1e-9 * v));
            prop_assert!((0..2).all(|k| less[k].abs_diff_eq(changes[k], 1e-6)));
        }

        /// A mirror that is tilted by its roughness along either tangent sends the ray to a place that
        /// the wider differential contains as one standard deviation.
        #[test]
        fn a_rough_mirror_spreads_as_tilted_mirrors_do(incident in unit(), normal in unit()) {
            prop_assume!(incident.dot(normal) < -0.1);
            let roughness = 1e-8;
            let spread = Spread { roughness, ..Spread::default() };
            let (one, other) = normal.any_orthonormal_pair();
            let tilted = |tangent: DVec3| {
                let tilted = (normal + f64::sqrt(roughness) * tangent).normalize();
                mirrored(incident, tilted) - mirrored(incident, normal)
            };
            let found = spread.reflected(incident, normal).direction;
            let truth = 12.0 * square(&[tilted(one), tilted(other)]);
            // Second-order terms are the share 1e-4 of the first-order ones.
            prop_assert!(square(&found).abs_diff_eq(truth, 1e-3 * 48.0 * roughness));
        }
    }

    fn mirrored(incident: DVec3, normal: DVec3) -> DVec3 {
        incident - 2.0 * incident.dot(normal) * normal
    }
}
