//! Probes along the longer axis of a parallelogram (J. `McCormack` et al., "Feline", 1999).

use glam::DVec2;

/// Largest number of probes in units of a part's width. A part that is longer is widened. With fewer
/// probes, relief seen at a grazing angle blurs. With more, a lookup costs more.
pub const MOST_PROBES: f64 = 16.0;

/// Returns the positions and weights of the probes along a part that is `ratio` times as long as it
/// is wide, in units of the width. Each stands for a piece as long as the width; those at the ends
/// have the weight of the piece that lies inside, so that the probes change gradually.
pub fn probes(ratio: f64) -> impl Iterator<Item = (f64, f64)> {
    let half = 0.5 * if ratio > 1.0 { ratio } else { 1.0 };
    let outermost = (half - 0.5).ceil() as i32;
    (-outermost..=outermost).map(move |k| {
        let k = f64::from(k);
        let inside = (half.min(k.abs() + 0.5) - (k.abs() - 0.5)).min(1.0);
        (k, if k == 0.0 { (2.0 * half).min(1.0) } else { inside } / (2.0 * half))
    })
}

/// Returns the longer axis of the parallelogram with these sides, as a vector of its length, and its
/// width across. Length and width are the singular values of the matrix of the sides. A parallelogram
/// without finite size, as at a horizon, is returned as wide as possible.
pub fn axes([a, b]: [DVec2; 2]) -> (DVec2, f64) {
    let squares = a * a + b * b;
    let mixed = a.x * a.y + b.x * b.y;
    let half = 0.5 * (squares.x - squares.y);
    let length = (0.5 * (squares.x + squares.y) + half.hypot(mixed)).sqrt();
    if !length.is_finite() {
        return (DVec2::ZERO, f64::MAX);
    }
    let direction = DVec2::from_angle(0.5 * f64::atan2(mixed, half));
    let width = if length > 0.0 { a.perp_dot(b).abs() / length } else { 0.0 };
    (length * direction, width)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector() -> impl Strategy<Value = DVec2> {
        prop::array::uniform2(-9.0..9.0f64).prop_map(DVec2::from)
    }

    proptest! {
        /// Length and width are the singular values: their squares sum to those of the sides, and their
        /// product is the area. The axis is the direction in which the sides extend farthest.
        #[test]
        fn axes_are_those_of_the_ellipse(a in vector(), b in vector()) {
            let (long, width) = axes([a, b]);
            let squares = a.length_squared() + b.length_squared();
            prop_assert!((long.length_squared() + width * width - squares).abs() < 1e-10);
            prop_assert!((long.length() * width - a.perp_dot(b).abs()).abs() < 1e-10);
            let extent = |axis: DVec2| a.dot(axis).hypot(b.dot(axis));
            prop_assert!((extent(long.normalize()) - long.length()).abs() < 1e-10);
        }

        /// Weights sum to 1, and the pieces of the probes cover the part.
        #[test]
        fn probes_cover_the_part(ratio in 0.0..16.0f64) {
            let all: Vec<(f64, f64)> = probes(ratio).collect();
            let spread: f64 = all.iter().map(|(off, weight)| weight * off * off).sum();
            let total: f64 = all.iter().map(|(_, weight)| weight).sum();
            prop_assert!((total - 1.0).abs() < 1e-14);
            // The variance of a part of this length is its square over 12. Probes at the middle of
            // whole pieces deviate by less than a piece.
            let truth = (ratio.max(1.0).powi(2) - 1.0) / 12.0;
            prop_assert!((spread - truth).abs() < 0.35 * ratio.max(1.0), "{spread} {truth}");
        }
    }
}
