//! Normal maps: pictures whose colours are normals in tangent space.
//!
//! A texel `(x, y, z)` is the normal of a surface over the tangents `T`, along which the first texture
//! coordinate rises, and `B`, along which the second one rises (green up, as of OpenGL and glTF). This is
//! the normal of a relief with the slopes `-x / z` and `-y / z` along both tangents. Slopes are interpolated
//! linearly between the middles of texels, and averaged as the slopes of heights are. The tangents are those
//! of the texture coordinates on the surface, projected onto it. Where tangents are at right angles, `T x +
//! B y + N z` is the normal of the map exactly.
//!
//! Source: M. Olano and D. Baker, "LEAN Mapping", 2010, for slopes in place of normals.

use super::heights::index;
use super::laid::Laid;
use super::moments::{self, Moments, SurfaceSlope};
use glam::{DMat2, DVec2, DVec3};
use std::sync::OnceLock;

/// Smallest third component of a normal, in relation to its length. Normals that are lower are raised to
/// it, so that slopes are bounded. A larger number makes steep normals less steep. A smaller one lets single
/// texels outweigh all others in an average.
const LOWEST: f64 = 1.0 / 64.0;

/// A map of normals over texture coordinates.
#[derive(Debug, Clone)]
pub struct NormalMap {
    /// Slopes to the right and up, row by row from the top.
    slopes: Vec<[f32; 2]>,
    laid: Laid,
    /// Moments of the slopes, built when slopes are first averaged.
    moments: OnceLock<Moments>,
}

impl PartialEq for NormalMap {
    /// Compares the slopes and their place. Moments follow from them.
    fn eq(&self, other: &Self) -> bool {
        self.laid == other.laid && self.slopes == other.slopes
    }
}

impl NormalMap {
    /// Creates a map from normals of any positive length, row by row from the top, `width` in each row.
    /// The map is laid `repeat` times over the unit square of texture coordinates and repeats beyond it.
    ///
    /// Returns `None` unless there is at least one row and all rows are complete.
    #[must_use]
    pub fn new(normals: Vec<DVec3>, width: usize, repeat: DVec2) -> Option<Self> {
        if normals.is_empty() || width == 0 || !normals.len().is_multiple_of(width) {
            return None;
        }
        let height = normals.len() / width;
        let slopes = normals.into_iter().map(slopes_of).collect();
        Some(Self { slopes, laid: Laid::new([width, height], repeat), moments: OnceLock::new() })
    }

    /// Returns the map moved against texture coordinates by `offset` copies of the picture.
    #[must_use]
    pub fn moved(mut self, offset: DVec2) -> Self {
        self.laid.offset = offset;
        self
    }

    /// Returns the slopes along both tangents at texture coordinates.
    #[must_use]
    pub fn slopes(&self, uv: DVec2) -> DVec2 {
        self.interpolated(self.laid.at(uv)).0 * self.signs()
    }

    /// Returns the slope along both tangents over the parallelogram of texture coordinates with these two
    /// sides. Its curvature is the change by texture coordinates.
    #[must_use]
    pub fn slope(&self, uv: DVec2, sides: [DVec2; 2]) -> SurfaceSlope {
        let (rate, signs) = (self.laid.rate(), self.signs());
        let moments = || self.moments.get_or_init(|| self.moments());
        let slope = moments::averaged(
            self.laid.at(uv),
            sides.map(|side| side * rate),
            |at| self.interpolated(at),
            moments,
        );
        let signed = |column: DVec2| column * signs;
        SurfaceSlope {
            mean: signed(slope.mean),
            curvature: DMat2::from_cols(
                signed(slope.curvature.x_axis) * rate.x,
                signed(slope.curvature.y_axis) * rate.y,
            ),
            covariance: DMat2::from_cols(
                signed(slope.covariance.x_axis) * signs.x,
                signed(slope.covariance.y_axis) * signs.y,
            ),
        }
    }

    /// Memory of the moments, in bytes, which exist once slopes have been averaged.
    #[must_use]
    pub fn moments_bytes(&self) -> u64 {
        let [width, height] = self.laid.size;
        Moments::bytes(width, height)
    }

    /// A mirrored map has mirrored normals.
    fn signs(&self) -> DVec2 {
        self.laid.repeat.signum()
    }

    fn moments(&self) -> Moments {
        let [width, height] = self.laid.size;
        // Rows are counted from the top.
        Moments::new(width, height, false, |x, y| {
            self.interpolated(DVec2::new(x, height as f64 - y)).0
        })
    }

    /// Returns slopes and their derivatives by texels, at a position in texels to the right and up.
    fn interpolated(&self, at: DVec2) -> (DVec2, DMat2) {
        let [width, height] = self.laid.size;
        let at = if at.is_finite() { at } else { DVec2::ZERO };
        let place = DVec2::new(at.x, height as f64 - at.y) - 0.5;
        let first = place.floor();
        let part = place - first;
        let (column, row) = (first.x as i64, first.y as i64);
        let columns = [column, column.saturating_add(1)].map(|x| index(x, width, false));
        let [upper, lower] = [row, row.saturating_add(1)].map(|y| {
            let row = index(y, height, false) * width;
            columns.map(|x| DVec2::from(self.slopes[row + x].map(f64::from)))
        });
        let along = |[left, right]: [DVec2; 2]| left.lerp(right, part.x);
        let mean = along(upper).lerp(along(lower), part.y);
        let right = (upper[1] - upper[0]).lerp(lower[1] - lower[0], part.y);
        // Rows count down.
        let up = along(upper) - along(lower);
        (mean, DMat2::from_cols(right, up))
    }
}

/// Returns the slopes of a relief with this normal.
fn slopes_of(normal: DVec3) -> [f32; 2] {
    let unit = normal.try_normalize().unwrap_or(DVec3::Z);
    let height = unit.z.max(LOWEST);
    [-unit.x / height, -unit.y / height].map(|slope| slope as f32)
}

/// Returns the unit tangents along which one texture coordinate rises and the other one stays, from the
/// gradients of both; zero where the coordinates have none.
#[must_use]
pub fn tangents([of_u, of_v]: [DVec3; 2]) -> [DVec3; 2] {
    let across = of_u.cross(of_v);
    [of_v.cross(across), across.cross(of_u)].map(DVec3::normalize_or_zero)
}

/// Returns the changes of [`tangents`] for changes of the gradients.
#[must_use]
pub fn tangent_changes([of_u, of_v]: [DVec3; 2], [change_u, change_v]: [DVec3; 2]) -> [DVec3; 2] {
    let across = of_u.cross(of_v);
    let turned = change_u.cross(of_v) + of_u.cross(change_v);
    let unit = |vector: DVec3, change: DVec3| {
        let Some(direction) = vector.try_normalize() else { return DVec3::ZERO };
        let change = (change - change.dot(direction) * direction) / vector.length();
        if change.is_finite() { change } else { DVec3::ZERO }
    };
    [
        unit(of_v.cross(across), change_v.cross(across) + of_v.cross(turned)),
        unit(across.cross(of_u), turned.cross(of_u) + across.cross(change_u)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::procedural::{Bump, Heights, Place, Placement, Relief};
    use glam::DAffine3;
    use std::f64::consts::TAU;

    /// A normal of the map, at each texel, on a plane on which the picture lies once.
    #[test]
    fn the_normal_of_a_texel_is_the_normal_of_the_surface() {
        let normals: Vec<DVec3> = (0..12)
            .map(|k| {
                DVec3::new((f64::from(k) * 0.7).sin(), (f64::from(k) * 1.3).cos(), 1.5).normalize()
            })
            .collect();
        let relief = Relief::Normals(NormalMap::new(normals.clone(), 4, DVec2::ONE).unwrap());
        let placement = Placement::default();
        let bump = Bump { relief, strength: 1.0, placement };
        // The coordinates rise along y and along -x, on a plane of any size.
        let (tangent, other, normal) = (DVec3::Y, DVec3::NEG_X, DVec3::Z);
        for (k, expected) in normals.iter().enumerate() {
            let uv = DVec2::new(((k % 4) as f64 + 0.5) / 4.0, 1.0 - ((k / 4) as f64 + 0.5) / 3.0);
            let uv_gradients = [tangent / 7.0, other / 0.3];
            let place = Place { point: DVec3::ONE, normal, uv, uv_gradients };
            let expected = expected.x * tangent + expected.y * other + expected.z * normal;
            let found = bump.normal(&DAffine3::IDENTITY, &place);
            // Slopes are stored in single precision.
            assert!(found.abs_diff_eq(expected, 1e-6), "{k}: {found} {expected}");
        }
    }

    /// The same waves as heights and as normals, over a point and over parts of a texel to the whole map.
    #[test]
    fn normals_of_a_relief_bump_as_its_heights_do() {
        let size = 64;
        let at = |k: usize| (k as f64 + 0.5) / size as f64;
        let wave = |x: f64, y: f64| 0.02 * ((TAU * x).sin() + (2.0 * TAU * (1.0 - y)).cos());
        let texels = || (0..size * size).map(|k| (at(k % size), at(k / size)));
        let heights = texels().map(|(x, y)| wave(x, y)).collect();
        let heights = Heights::new(heights, size, DVec2::ONE, false).unwrap();
        let normal = |(x, y): (f64, f64)| {
            let by_u = 0.02 * TAU * (TAU * x).cos();
            let by_v = -0.04 * TAU * (2.0 * TAU * (1.0 - y)).sin();
            DVec3::new(-by_u, -by_v, 1.0)
        };
        let map = NormalMap::new(texels().map(normal).collect(), size, DVec2::ONE).unwrap();
        for k in 0..20 {
            let uv = DVec2::new(0.137 * f64::from(k), 0.291 * f64::from(k));
            for side in [0.0, 0.01, 0.1, 1.0] {
                let sides = [side * DVec2::X, side * DVec2::Y];
                let (found, truth) = (map.slope(uv, sides), heights.slope(uv, sides));
                // Slopes are up to 0.25, and linear between 32 texels of a wave.
                assert!(found.mean.abs_diff_eq(truth.mean, 2e-3), "{side}: {found:?} {truth:?}");
                assert!(
                    found.covariance.abs_diff_eq(truth.covariance, 5e-4),
                    "{side}: {found:?} {truth:?}"
                );
                // Curvatures are up to 3.2. Between texels each of both is off by up to half a texel times the third
                // derivative, 0.02 (4 pi)^3 / 128 = 0.31.
                assert!(
                    found.curvature.abs_diff_eq(truth.curvature, 0.62),
                    "{side}: {found:?} {truth:?}"
                );
            }
        }
    }

    #[test]
    fn a_map_is_laid_several_times_moved_and_mirrored() {
        let normals: Vec<DVec3> = (0..12)
            .map(|k| DVec3::new(f64::from(k) / 12.0, f64::from(k * k % 5) / 7.0, 1.0))
            .collect();
        let map = |repeat| NormalMap::new(normals.clone(), 4, repeat).unwrap();
        let plain = map(DVec2::ONE);
        let laid = map(DVec2::new(-2.0, 3.0)).moved(DVec2::new(0.25, 0.5));
        for k in 0..30 {
            let uv = DVec2::new(0.137 * f64::from(k), 0.291 * f64::from(k));
            let own = DVec2::new(0.25 - 2.0 * uv.x, 0.5 + 3.0 * uv.y);
            let mirrored = DVec2::new(-1.0, 1.0);
            assert!(laid.slopes(uv).abs_diff_eq(plain.slopes(own) * mirrored, 1e-12));
        }
        assert_eq!(NormalMap::new(normals, 5, DVec2::ONE), None);
    }

    #[test]
    fn changes_of_tangents_agree_with_differences() {
        let vector = |k: f64| DVec3::new((2.1 * k).sin(), (0.7 * k).cos(), (1.3 * k + 1.0).sin());
        for k in 0..40 {
            let k = f64::from(k);
            let (from, change) = ([vector(k), vector(k + 0.4)], [vector(k + 0.8), vector(2.0 * k)]);
            let step = 1e-6;
            let at = |t: f64| tangents([0, 1].map(|i| from[i] + t * change[i]));
            let (ahead, behind, found) = (at(step), at(-step), tangent_changes(from, change));
            for i in 0..2 {
                let expected = (ahead[i] - behind[i]) / (2.0 * step);
                assert!(found[i].abs_diff_eq(expected, 1e-6 * expected.length().max(1.0)));
            }
        }
        assert_eq!(tangents([DVec3::ZERO; 2]), [DVec3::ZERO; 2]);
        assert_eq!(tangent_changes([DVec3::ZERO; 2], [DVec3::ONE; 2]), [DVec3::ZERO; 2]);
    }

    #[test]
    fn a_normal_below_the_surface_is_raised() {
        let lowest = slopes_of(DVec3::new(1.0, 0.0, -1.0));
        assert!((f64::from(lowest[0]) + 64.0 / 2.0_f64.sqrt()).abs() < 1e-4 && lowest[1] == 0.0);
        assert_eq!(slopes_of(DVec3::ZERO), [0.0, 0.0]);
    }
}
