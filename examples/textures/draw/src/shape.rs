//! Signed distances to flat shapes: negative inside, zero on the outline.
//!
//! Near a smooth outline the distances are exact. Beyond a sharp tip they are too small, which does
//! not affect lines drawn inside the outline. Only square roots are taken, no angles, so that all
//! machines compute the same bits.

use glam::DVec2;

/// The sine of a sixteenth of a turn.
pub const SIN_22_5: f64 = 0.382_683_432_365_089_8;
/// The cosine of a sixteenth of a turn.
pub const COS_22_5: f64 = 0.923_879_532_511_286_7;

/// Returns the distance to a disc around the origin.
pub fn disc(p: DVec2, radius: f64) -> f64 {
    p.length() - radius
}

/// Returns the distance to the nearest of the parallel lines at all multiples of a pitch, for a
/// coordinate `x` across them; never negative.
pub fn to_multiple(x: f64, pitch: f64) -> f64 {
    (x - (x / pitch).round() * pitch).abs()
}

/// Returns the distance to a line of this width along the outline of another shape.
pub fn stroke(distance: f64, width: f64) -> f64 {
    distance.abs() - width / 2.0
}

/// Returns the distance to a lens, pointed at `(0, -half_length)` and `(0, half_length)`: the
/// overlap of two discs.
pub fn lens(p: DVec2, half_length: f64, half_width: f64) -> f64 {
    let radius = (half_length * half_length + half_width * half_width) / (2.0 * half_width);
    DVec2::new(p.x.abs() + radius - half_width, p.y).length() - radius
}

/// Returns the distance to a pointed arch, open below. Its sides are straight up to `spring`. From
/// there half a lens rises to the tip at `spring + rise`.
pub fn arch(p: DVec2, half_width: f64, spring: f64, rise: f64) -> f64 {
    if p.y < spring {
        p.x.abs() - half_width
    } else {
        lens(p - DVec2::new(0.0, spring), rise, half_width)
    }
}

/// Returns the distance to a square standing on a corner, `reach` from its middle to each corner.
pub fn diamond(p: DVec2, reach: f64) -> f64 {
    (p.x.abs() + p.y.abs() - reach) * std::f64::consts::FRAC_1_SQRT_2
}

/// Returns `p` relative to `origin`, with the y axis turned into `direction` (any length but zero)
/// and the x axis to its right.
pub fn seen_along(p: DVec2, origin: DVec2, direction: DVec2) -> DVec2 {
    let y = direction.normalize();
    let from = p - origin;
    DVec2::new(from.dot(DVec2::new(y.y, -y.x)), from.dot(y))
}

/// Folds the plane eightfold: all eight petals of a rosette fall on the petal along the positive y
/// axis.
pub fn fold_eight(p: DVec2) -> DVec2 {
    let p = p.abs();
    let p = if p.x > p.y { DVec2::new(p.y, p.x) } else { p };
    let across = DVec2::new(COS_22_5, -SIN_22_5);
    p - 2.0 * p.dot(across).max(0.0) * across
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lens_ends_at_its_length_and_width() {
        assert!(lens(DVec2::new(0.0, 5.0), 5.0, 2.0).abs() < 1e-12);
        assert!(lens(DVec2::new(-2.0, 0.0), 5.0, 2.0).abs() < 1e-12);
        assert!((lens(DVec2::ZERO, 5.0, 2.0) + 2.0).abs() < 1e-12);
    }

    #[test]
    fn the_sides_of_an_arch_meet_its_curve() {
        let below = arch(DVec2::new(1.5, 3.0 - 1e-9), 2.0, 3.0, 4.0);
        let above = arch(DVec2::new(1.5, 3.0 + 1e-9), 2.0, 3.0, 4.0);
        assert!((below - above).abs() < 1e-8);
        assert!(arch(DVec2::new(0.0, 7.0), 2.0, 3.0, 4.0).abs() < 1e-12);
    }

    #[test]
    fn all_eight_petals_fold_onto_one() {
        let petal = DVec2::new(0.2, 3.0);
        let eighth = DVec2::splat(std::f64::consts::FRAC_1_SQRT_2);
        let mut p = petal;
        for _ in 0..8 {
            let folded = fold_eight(p);
            assert!((folded - petal).length() < 1e-12, "{p} folds to {folded}");
            p = p.rotate(eighth);
        }
    }

    #[test]
    fn a_point_ahead_is_seen_on_the_y_axis() {
        let seen = seen_along(DVec2::new(4.0, 6.0), DVec2::new(1.0, 2.0), DVec2::new(3.0, 4.0));
        assert!((seen - DVec2::new(0.0, 5.0)).length() < 1e-12);
    }
}
