//! The watertight ray-triangle test.
//!
//! Woop, Benthin, Wald: *Watertight Ray/Triangle Intersection*, JCGT 2(1), 2013. The triangle is
//! sheared into a space where the ray runs along z. The three edge functions are then signed areas
//! in the plane. Two triangles that share an edge compute the function of that edge from the same
//! two sheared points, with the factors exchanged. Their results are exact opposites, so no ray
//! slips between the triangles. This holds only if products are rounded one by one (no fused
//! multiply-add). An edge function of exactly zero counts as inside on both sides.

use glam::{DVec3, DVec4, Vec4Swizzles};

/// A ray prepared for tests against many triangles.
#[derive(Debug, Clone, Copy)]
pub struct ShearedRay {
    origin: DVec3,
    order: Order,
    shear: [f64; 3],
}

/// The order of the axes after shearing. The direction's largest component comes last. The first
/// two axes are exchanged where that component is negative. The exchange keeps the winding, so that
/// the sign of the area gives the side.
#[derive(Debug, Clone, Copy)]
enum Order {
    Xyz,
    Yxz,
    Yzx,
    Zyx,
    Zxy,
    Xzy,
}

impl Order {
    #[inline(always)]
    fn of(direction: DVec3) -> Self {
        let size = direction.abs();
        if size.x > size.y && size.x > size.z {
            if direction.x < 0.0 { Self::Zyx } else { Self::Yzx }
        } else if size.y > size.z {
            if direction.y < 0.0 { Self::Xzy } else { Self::Zxy }
        } else if direction.z < 0.0 {
            Self::Yxz
        } else {
            Self::Xyz
        }
    }

    #[inline]
    fn axes(self) -> [usize; 3] {
        // In the order of the variants.
        const AXES: [[usize; 3]; 6] =
            [[0, 1, 2], [1, 0, 2], [1, 2, 0], [2, 1, 0], [2, 0, 1], [0, 2, 1]];
        AXES[self as usize]
    }
}

/// Distance of a hit in scene units, and the weights of the second and third corner.
pub type TriangleHit = (f64, [f64; 2]);

impl ShearedRay {
    /// Prepares the ray that starts at `origin`; `direction` is unit.
    #[must_use]
    #[inline(always)]
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        Self::with_inverse(origin, direction, direction.recip())
    }

    /// Prepares a ray as [`ShearedRay::new`] does. `inverse` is one over the direction along its largest
    /// component.
    #[must_use]
    #[inline(always)]
    pub fn with_inverse(origin: DVec3, direction: DVec3, inverse: DVec3) -> Self {
        let order = Order::of(direction);
        let [x, y, z] = order.axes();
        let over = inverse[z];
        Self { origin, order, shear: [direction[x] * over, direction[y] * over, over] }
    }

    /// Returns the axes after shearing of a ray with this direction: the last is that of the largest
    /// component.
    #[must_use]
    #[inline(always)]
    pub fn axes_of(direction: DVec3) -> [usize; 3] {
        Order::of(direction).axes()
    }

    /// Returns the hit with a distance above 0, from either side, and the sum of the edge functions.
    /// The test misses triangles of zero area as seen along the ray, and triangles whose corners all
    /// lie farther along the ray than `limit`.
    #[must_use]
    #[inline(always)]
    pub fn intersect(&self, corners: &Corners, limit: f64) -> Option<(TriangleHit, f64)> {
        let [x, y, z] = self.order.axes();
        let from = |axis: usize| corners[axis] - DVec4::splat(self.origin[axis]);
        // Distances of the corners along the axis of depth, before shearing.
        let depths = from(z);
        let along = self.shear[2] * depths;
        if (along.x > limit) & (along.y > limit) & (along.z > limit) {
            return None;
        }
        let x = from(x) - self.shear[0] * depths;
        let y = from(y) - self.shear[1] * depths;
        let edges = x.zxyx() * y.yzxy() - y.zxyx() * x.yzxy();
        let (a, b, c) = (edges.x, edges.y, edges.z);
        if ((a < 0.0) | (b < 0.0) | (c < 0.0)) & ((a > 0.0) | (b > 0.0) | (c > 0.0)) {
            return None;
        }
        let area = a + b + c;
        if area == 0.0 {
            return None;
        }
        let weights = edges / area;
        let parts = weights * along;
        let t = parts.x + parts.y + parts.z;
        (t > 0.0).then_some(((t, [weights.y, weights.z]), area))
    }

    /// Returns whether the ray starts within `skin` of the triangle's plane, in scene units.
    #[must_use]
    pub fn starts_on(&self, [x, y, z]: &Corners, skin: f64) -> bool {
        let a = DVec3::new(x.x, y.x, z.x) - self.origin;
        let b = DVec3::new(x.y, y.y, z.y) - self.origin;
        let c = DVec3::new(x.z, y.z, z.z) - self.origin;
        let across = (b - a).cross(c - a);
        a.dot(across).abs() <= skin * across.length()
    }

    /// Returns whether [`ShearedRay::starts_on`] is certainly false for a triangle that the ray meets
    /// at the distance `t`. `area` is the sum of the edge functions, and `size` the diagonal of the
    /// triangle's box.
    ///
    /// The start has a distance from the plane of `t` times the cosine between ray and normal. The sum
    /// of the edge functions is that cosine times twice the triangle's area, over the direction's
    /// largest component; and twice the area is below the square of the diagonal.
    #[must_use]
    #[inline(always)]
    pub fn starts_off(&self, t: f64, area: f64, size: DVec4, skin: f64) -> bool {
        t * area.abs() > START_OFF * skin * size.length_squared() * self.shear[2].abs()
    }
}

/// Factor of the skin in [`ShearedRay::starts_off`]. It exceeds all roundings, since a skin is above four
/// roundings of the largest coordinate.
pub const START_OFF: f64 = 32.0;

/// Corners of a triangle, along each axis: first, second, third, and the first again.
pub type Corners = [DVec4; 3];

/// Returns corners that are given one by one, each from `offset`.
#[must_use]
#[inline]
pub fn by_axis([a, b, c]: &[[f32; 3]; 3], offset: DVec3) -> Corners {
    let along = |axis: usize| {
        let (a, b, c) = (f64::from(a[axis]), f64::from(b[axis]), f64::from(c[axis]));
        // A sum with -0 keeps the sign of a -0.
        let offset = if offset[axis] == 0.0 { -0.0 } else { offset[axis] };
        DVec4::new(a, b, c, a) + offset
    };
    [along(0), along(1), along(2)]
}

/// Returns whether two of a triangle's corners are equal.
///
/// No ray meets such a triangle: two of its edge functions are exact opposites and the third is
/// exactly zero, so that [`ShearedRay::intersect`] misses. A triangle of three different corners on
/// a line may be met, since rounding leaves it an area.
#[must_use]
pub fn is_segment([a, b, c]: &[[f32; 3]; 3]) -> bool {
    a == b || b == c || c == a
}

/// Lower and upper corner of a triangle's bounding box.
#[must_use]
pub fn bounds(corners: &[[f32; 3]; 3]) -> [DVec3; 2] {
    let [a, b, c] = corners.map(|corner| DVec3::from(corner.map(f64::from)));
    [a.min(b).min(c), a.max(b).max(c)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn both_sides_are_seen_and_the_weights_are_barycentric() {
        let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
        for (z, direction) in [(2.0, DVec3::NEG_Z), (-2.0, DVec3::Z)] {
            let ray = ShearedRay::new(DVec3::new(1.0, 2.0, z), direction);
            let ((t, weights), _) =
                ray.intersect(&by_axis(&corners, DVec3::ZERO), f64::INFINITY).unwrap();
            assert_eq!((t, weights), (2.0, [0.25, 0.5]));
            assert!(ray.intersect(&by_axis(&corners, DVec3::ZERO), 1.9).is_none());
        }
    }

    proptest! {
        /// The structures omit only triangles that no ray meets.
        #[test]
        fn no_ray_meets_a_triangle_of_two_corners(
            a in prop::array::uniform3(any::<f32>()), b in prop::array::uniform3(-1.0..1.0f32),
            eye in prop::array::uniform3(-2.0..2.0f64), toward in prop::array::uniform3(-1.0..1.0f64),
            at_corner in any::<bool>(), which in 0usize..3, near in any::<bool>(),
        ) {
            let a = if near { a.map(|x| if x.is_finite() { x.fract() } else { 0.0 }) } else { a };
            let mut corners = [a; 3];
            corners[which] = b;
            prop_assert!(is_segment(&corners));
            let eye = DVec3::from(eye);
            let aimed = DVec3::from(b.map(f64::from)) - eye;
            let direction = if at_corner { aimed } else { DVec3::from(toward) };
            let ray = ShearedRay::new(eye, direction.normalize_or(DVec3::X));
            prop_assert_eq!(ray.intersect(&by_axis(&corners, DVec3::ZERO), f64::INFINITY), None);
        }

        /// A ray aimed at a corner or an edge of a closed fan never slips through.
        #[test]
        fn no_ray_slips_through_a_fan(
            eye in (-1.5..1.5f64, -1.5..1.5f64, prop_oneof![4.0..5.0f64, -5.0..-4.0f64]),
            hub in prop::array::uniform3(-0.3..0.3f32),
            spoke in 0usize..5, along in prop_oneof![Just(0.0), 0.0..0.9f64],
        ) {
            // From here no triangle of the fan is seen edge on.
            let eye = DVec3::from(eye);
            let rim = |k: usize| {
                let angle = 1.3 * (k % 5) as f32;
                [3.0 * angle.cos(), 3.0 * angle.sin(), 0.1 * (k % 5) as f32]
            };
            let target: Vec<f64> = (0..3)
                .map(|i| f64::from(hub[i]) + along * f64::from(rim(spoke)[i] - hub[i]))
                .collect();
            let direction = (DVec3::from_slice(&target) - eye).normalize();
            let ray = ShearedRay::new(eye, direction);
            let hits = (0..5)
                .filter(|&k| {
                    ray.intersect(&by_axis(&[hub, rim(k), rim(k + 1)], DVec3::ZERO), f64::INFINITY).is_some()
                })
                .count();
            prop_assert!(hits >= 1);
        }
    }
}
