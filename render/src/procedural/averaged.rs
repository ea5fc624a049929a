//! Bumps averaged over the part of a surface that a ray stands for.
//!
//! The mean of a bump's slopes perturbs the normal. The variance that the mean leaves out makes the
//! surface rougher (M. Olano and D. Baker, "LEAN Mapping", 2010). A bump that is seen from afar
//! therefore widens highlights and reflections instead of sparkling.

use super::bump::{Bump, Place, Relief};
use super::moments::SurfaceSlope;
use super::normal_map::{tangent_changes, tangents};
use glam::{DAffine3, DMat3, DVec2, DVec3};

/// Inverse of the variance of a number that is spread evenly over a range of length 1.
const PER_SIDE: f64 = 12.0;

/// Changes of a [`Place`] across and down the part of the surface that a ray stands for, in scene
/// space. The part is the parallelogram that the two changes of the position span.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PlaceChanges {
    /// Changes of the position.
    pub point: [DVec3; 2],
    /// Changes of the unit normal.
    pub normal: [DVec3; 2],
    /// Changes of the texture coordinates.
    pub uv: [DVec2; 2],
    /// Changes of the gradients of both texture coordinates, as `[change][coordinate]`. Only
    /// pictures use them.
    pub uv_gradients: [[DVec3; 2]; 2],
}

/// The perturbed normal over a part of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AveragedNormal {
    /// Unit normal of the mean slopes, in scene space.
    pub normal: DVec3,
    /// Changes of this normal across and down the part.
    pub changes: [DVec3; 2],
    /// Variance of the normal along each tangent that neither the normal nor its changes show; a
    /// tangent of an angle, squared.
    pub roughness: f64,
}

/// `Np` of eq. 2.1 over a part of a surface, in own space.
struct Perturbation {
    mean: DVec3,
    /// Changes of the mean across and down the part.
    changes: [DVec3; 2],
    /// The share of the relief in these changes.
    of_relief: [DVec3; 2],
    /// Covariance of `Np` within the part.
    covariance: DMat3,
}

impl Bump {
    /// Returns the perturbed normal over a part of the surface, in scene space. Over a point it is
    /// that of [`Bump::normal`], to the last bit.
    #[must_use]
    pub fn averaged(
        &self,
        to_own_space: &DAffine3,
        place: &Place,
        changes: &PlaceChanges,
    ) -> AveragedNormal {
        let to_scene = to_own_space.matrix3.transpose();
        let (own, own_changes) = in_own_space(to_own_space, &to_scene, place, changes);
        let np = self.averaged_perturbation(&own, &own_changes);
        let sum = to_scene * (own.normal + self.strength * np.mean);
        let Some(normal) = sum.try_normalize() else {
            return AveragedNormal {
                normal: place.normal,
                changes: changes.normal,
                roughness: 0.0,
            };
        };
        let per_length = sum.length().recip();
        // Change of the unit normal for a change of the sum in own space.
        let turned = |own: DVec3| {
            let change = to_scene * own;
            (change - change.dot(normal) * normal) * per_length
        };
        let of_normal =
            [0, 1].map(|k| turned(own_changes.normal[k] + self.strength * np.changes[k]));
        // Trace of the covariance of the normal. The part that its changes show is subtracted.
        let all: f64 =
            (0..3).map(|k| turned(np.covariance.col(k)).dot(turned(DVec3::AXES[k]))).sum();
        let shown: f64 = np.of_relief.iter().map(|&change| turned(change).length_squared()).sum();
        let roughness = 0.5 * self.strength * self.strength * (all - shown / PER_SIDE);
        AveragedNormal { normal, changes: of_normal, roughness: roughness.max(0.0) }
    }

    /// Computes `Np` of eq. 2.1 over a part of a surface.
    fn averaged_perturbation(&self, place: &Place, changes: &PlaceChanges) -> Perturbation {
        let at = self.placement.to_texture(place.point);
        let steps = changes.point.map(|step| self.placement.step_to_texture(step));
        let width = longest(steps);
        let slope = match &self.relief {
            Relief::Noise(octaves) => octaves.fractal_slope(at, width),
            Relief::Turbulence(octaves) => octaves.turbulence_slope(at, width),
            Relief::Wall(wall) => wall.slope(at, width),
            Relief::Dnoise(noise) => {
                let kept = super::slopes::kept(width);
                let direction = self.placement.gradient(noise.dnoise(at)).normalize_or_zero();
                let differences = self.placement.gradient(noise.differences(at));
                let length = differences.length();
                let bend = noise.differences_change(at);
                let of_relief = steps.map(|step| {
                    let change = self.placement.gradient(bend * step) / length;
                    let change = kept * (change - change.dot(direction) * direction);
                    if change.is_finite() { change } else { DVec3::ZERO }
                });
                // All directions are about equally frequent.
                let covariance = DMat3::IDENTITY * ((1.0 - kept * kept) / 3.0);
                return Perturbation {
                    mean: kept * direction,
                    changes: of_relief,
                    of_relief,
                    covariance,
                };
            }
            Relief::Picture(heights) => {
                let slope = heights.slope(place.uv, changes.uv);
                return over_coordinates(
                    place,
                    changes,
                    &slope,
                    place.uv_gradients,
                    changes.uv_gradients,
                );
            }
            Relief::Normals(map) => {
                let slope = map.slope(place.uv, changes.uv);
                let along = tangents(place.uv_gradients);
                let of_along =
                    changes.uv_gradients.map(|change| tangent_changes(place.uv_gradients, change));
                return over_coordinates(place, changes, &slope, along, of_along);
            }
        };
        let gradient = self.placement.gradient(slope.mean);
        let of_relief = steps.map(|step| {
            let change = self.placement.gradient(slope.curvature * step);
            // A horizon has steps without bound, over which nothing is left of the mean.
            if change.is_finite() { change } else { DVec3::ZERO }
        });
        // The slopes of the relief vary alike in all directions of its own space.
        let stretch = self.placement.map().matrix3;
        let covariance = stretch.transpose() * stretch * slope.variance;
        along_surface(place.normal, changes.normal, gradient, (of_relief, of_relief), covariance)
    }
}

/// Returns the perturbation of a picture with this slope. `along` are the vectors by which slopes
/// are multiplied, and `of_along` their changes, as `[change][coordinate]`.
fn over_coordinates(
    place: &Place,
    changes: &PlaceChanges,
    slope: &SurfaceSlope,
    along: [DVec3; 2],
    of_along: [[DVec3; 2]; 2],
) -> Perturbation {
    let [along_u, along_v] = along;
    let gradient = slope.mean.x * along_u + slope.mean.y * along_v;
    let of_relief = changes.uv.map(|step| {
        let change = slope.curvature * step;
        change.x * along_u + change.y * along_v
    });
    let all = [0, 1].map(|k| {
        let [of_u, of_v] = of_along[k];
        of_relief[k] + slope.mean.x * of_u + slope.mean.y * of_v
    });
    let by_uv = [slope.covariance.x_axis, slope.covariance.y_axis];
    let [by_u, by_v] = by_uv.map(|column| column.x * along_u + column.y * along_v);
    let covariance = outer(by_u, along_u) + outer(by_v, along_v);
    along_surface(place.normal, changes.normal, gradient, (all, of_relief), covariance)
}

/// Returns a place and its changes in own space, as [`Bump::normal`] does.
fn in_own_space(
    to_own_space: &DAffine3,
    to_scene: &DMat3,
    place: &Place,
    changes: &PlaceChanges,
) -> (Place, PlaceChanges) {
    let to_own = to_scene.inverse();
    let normal = to_own * place.normal;
    let own = Place {
        point: to_own_space.transform_point3(place.point),
        normal: normal.normalize_or_zero(),
        uv: place.uv,
        uv_gradients: place.uv_gradients.map(|gradient| to_own * gradient),
    };
    let own_changes = PlaceChanges {
        point: changes.point.map(|step| to_own_space.transform_vector3(step)),
        normal: changes.normal.map(|change| {
            let change = to_own * change;
            (change - change.dot(own.normal) * own.normal) / normal.length()
        }),
        uv: changes.uv,
        uv_gradients: changes.uv_gradients.map(|pair| pair.map(|gradient| to_own * gradient)),
    };
    (own, own_changes)
}

/// Returns minus the part of a gradient along the surface. `changes` are those of the gradient, and
/// the share of the relief in them.
fn along_surface(
    normal: DVec3,
    normal_changes: [DVec3; 2],
    gradient: DVec3,
    (changes, of_relief): ([DVec3; 2], [DVec3; 2]),
    covariance: DMat3,
) -> Perturbation {
    let flat = |vector: DVec3| normal * normal.dot(vector) - vector;
    let changes = [0, 1].map(|k| {
        let turned = normal_changes[k];
        flat(changes[k]) + turned * normal.dot(gradient) + normal * turned.dot(gradient)
    });
    // The projection is symmetric, so it acts on the columns and then on the rows.
    let half =
        DMat3::from_cols(flat(covariance.x_axis), flat(covariance.y_axis), flat(covariance.z_axis))
            .transpose();
    let covariance = DMat3::from_cols(flat(half.x_axis), flat(half.y_axis), flat(half.z_axis));
    Perturbation { mean: flat(gradient), changes, of_relief: of_relief.map(flat), covariance }
}

/// Returns the product of a column and a row.
fn outer(column: DVec3, row: DVec3) -> DMat3 {
    DMat3::from_cols(column * row.x, column * row.y, column * row.z)
}

/// Returns the largest singular value of the matrix of two columns, about the longest extent of the
/// parallelogram that they span.
fn longest([a, b]: [DVec3; 2]) -> f64 {
    let (aa, bb, ab) = (a.length_squared(), b.length_squared(), a.dot(b));
    (0.5 * (aa + bb) + (0.5 * (aa - bb)).hypot(ab)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::procedural::wall::Wall;
    use crate::procedural::{
        Heights, Interpolation, Noise, NoiseLattice, NormalMap, Octaves, Placement,
    };
    use glam::{DQuat, EulerRot};
    use proptest::prelude::*;
    use std::sync::Arc;

    /// A bump of each relief.
    fn bumps() -> [Bump; 6] {
        let noise =
            Noise { lattice: Arc::new(NoiseLattice::new()), interpolation: Interpolation::Smooth };
        let octaves = Octaves { noise: noise.clone(), count: 3 };
        let wall = Wall { clamp: [-0.2, 0.3], rough: 0.2, frequency: 4.0, noise: noise.clone() };
        let values = (0..35).map(|i| f64::from(i * i * 37 % 101) / 100.0).collect();
        let heights = Heights::new(values, 7, DVec2::new(2.0, 3.0), false).unwrap();
        let code = |k: i32| f64::from(k * k * 37 % 101) / 101.0;
        let normal = |k: i32| DVec3::new(code(k) - 0.5, code(k + 1) - 0.5, 1.0);
        let normals = (0..35).map(normal).collect();
        let normals = NormalMap::new(normals, 7, DVec2::new(2.0, -3.0)).unwrap();
        [
            Relief::Noise(octaves.clone()),
            Relief::Turbulence(octaves),
            Relief::Wall(wall),
            Relief::Dnoise(noise),
            Relief::Picture(heights),
            Relief::Normals(normals),
        ]
        .map(|relief| {
            let placement = {
                let turn = DQuat::from_euler(EulerRot::XYZ, 0.1, 0.2, 0.3);
                let scale = DVec3::new(0.3, 0.25, 0.35);
                let to_own = DAffine3::from_scale_rotation_translation(scale, turn, DVec3::ONE);
                Placement::new(to_own.inverse())
            };
            Bump { relief, strength: 0.1, placement }
        })
    }

    fn vector() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-1.0..1.0f64).prop_map(DVec3::from)
    }

    /// A place on a plane across the normal, with edges that span the texture, and a map to own space.
    fn place() -> impl Strategy<Value = (DAffine3, Place)> {
        let linear = (vector(), vector(), vector());
        (linear, vector(), vector()).prop_filter_map("not flat", |((x, y, z), point, normal)| {
            let map = DAffine3::from_mat3_translation(DMat3::from_cols(x, y, z), normal);
            let normal = normal.try_normalize()?;
            let (u, v) = normal.any_orthonormal_pair();
            let uv = DVec2::new(point.dot(u), point.dot(v));
            let place = Place { point, normal, uv, uv_gradients: [u, v] };
            (map.matrix3.determinant().abs() > 0.05).then_some((map, place))
        })
    }

    /// A square of this side around a place.
    fn square(place: &Place, side: f64) -> PlaceChanges {
        let [u, v] = place.uv_gradients;
        let uv = [side * DVec2::X, side * DVec2::Y];
        PlaceChanges { point: [side * u, side * v], uv, ..PlaceChanges::default() }
    }

    proptest! {
        /// Over a point the normal is that of the bump, to the last bit, and nothing is rough.
        #[test]
        fn over_a_point_the_normal_is_exact((map, place) in place()) {
            for bump in bumps() {
                let found = bump.averaged(&map, &place, &square(&place, 0.0));
                prop_assert_eq!(found.normal, bump.normal(&map, &place));
                prop_assert_eq!((found.changes, found.roughness), ([DVec3::ZERO; 2], 0.0));
            }
        }

        /// The changes are those of the normal when the part moves by its own sides.
        #[test]
        fn changes_agree_with_differences((map, place) in place(), side in 0.0..0.3f64) {
            for bump in bumps() {
                let changes = square(&place, side);
                let moved = |k: usize, by: f64| {
                    let (point, uv) = (place.point + by * changes.point[k], place.uv + by * changes.uv[k]);
                    bump.averaged(&map, &Place { point, uv, ..place }, &changes)
                };
                let step = 1e-5;
                let found = moved(0, 0.0);
                for k in 0..2 {
                    let (ahead, behind) = (moved(k, step), moved(k, -step));
                    let expected = (ahead.normal - behind.normal) / (2.0 * step);
                    // Slopes or their changes jump where two pieces of a relief meet.
                    let creased = !ahead.changes[k].abs_diff_eq(behind.changes[k], 1e-2)
                        || (ahead.normal - behind.normal).length() > 1e-2;
                    prop_assert!(creased || found.changes[k].abs_diff_eq(expected, 1e-3 * expected.length().max(1.0)));
                }
            }
        }

        /// Over a part of any size, also without bound, the normal is a unit vector and the roughness
        /// is finite.
        #[test]
        fn over_a_part_of_any_size_all_is_finite((map, place) in place(), power in -20..300i32) {
            for bump in bumps() {
                for side in [10f64.powi(power), f64::INFINITY, f64::NAN] {
                    let found = bump.averaged(&map, &place, &square(&place, side));
                    prop_assert!((found.normal.length() - 1.0).abs() < 1e-12);
                    prop_assert!(found.roughness.is_finite() && found.roughness >= 0.0);
                }
            }
        }
    }
}
