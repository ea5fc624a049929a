//! The offset of a mesh that lies far from the origin.

use glam::DVec3;

/// Distance from the origin, in sizes of the mesh, beyond which a mesh has an offset.
///
/// At this distance `f32` has steps of four millionths of the size. If smaller, meshes at ordinary
/// distances have an offset too. If larger, the steps begin to show.
const FAR: f64 = 64.0;

/// Returns the offset of a mesh with these positions, in scene space; zero for a mesh near the origin.
///
/// The offset is a multiple of a power of two that is not less than the size of the mesh. Differences
/// from it are therefore exact in `f64`, and are at most two sizes.
#[must_use]
pub fn of(positions: impl Iterator<Item = DVec3>) -> DVec3 {
    let [low, high] = positions.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], at| {
        [low.min(at), high.max(at)]
    });
    let (size, far) = ((high - low).max_element(), low.abs().max(high.abs()).max_element());
    // A single point has no size, and nothing to lose.
    if !(is_far(size, far) && size > 0.0 && size < f64::INFINITY) {
        return DVec3::ZERO;
    }
    let unit = size.max(far * f64::EPSILON).log2().ceil().exp2();
    unit * (low.midpoint(high) / unit).round()
}

/// Returns whether a mesh of this size lies far from the origin: its largest coordinate is `far`.
#[must_use]
pub fn is_far(size: f64, far: f64) -> bool {
    far > FAR * size
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn far_meshes_keep_all_digits() {
        let corner = DVec3::new(512_340.5, 45.0, 5_843_210.25);
        let positions = [corner, corner + 0.125, corner + DVec3::new(3.0, 1e-6, -2.0)];
        let offset = of(positions.into_iter());
        for at in positions {
            let own = at - offset;
            assert!(own.abs().max_element() <= 6.0, "{own}");
            // Rounding to `f32` costs less than a millionth of a unit.
            assert!((own.as_vec3().as_dvec3() + offset).abs_diff_eq(at, 1e-6));
        }
        let near = [DVec3::ZERO, DVec3::new(10.0, 1.0, 0.0)];
        assert_eq!(of(near.into_iter()), DVec3::ZERO);
        assert_eq!(of([DVec3::NAN].into_iter()), DVec3::ZERO);
        assert_eq!(of([corner].into_iter()), DVec3::ZERO);
        assert_eq!(of(std::iter::empty()), DVec3::ZERO);
    }
}
