//! The thesis's map from a triangle to a right triangle (3.2, eq. 3.5 to 3.16, fig. 3.4), without
//! any change.
//!
//! Rendering does not use the map. In exact arithmetic it equals the barycentric map. In floating
//! point it has gaps that the barycentric map does not have. The map is kept as a reference, so
//! that both can be compared with the truth; `docs/mapping.md` reports the result.
//!
//! ```text
//!        B1                          B2 ---X--- J_BA ---- A2
//!       /  \                          |    |
//!   I_BA    I_BC                      Y -- H2
//!     /  H1  \                        |
//!   A1 ------- C1                   J_BC
//!                                     |
//!                                    C2
//! ```
//!
//! The ray hits the triangle at `H1`. The lines from `C1` and from `A1` through `H1` cut the
//! opposite sides in the ratios `r_BA` and `r_BC`. The legs of the right triangle are cut in the
//! same ratios. The lines from these points back to `C2` and `A2` meet in `H2`.

use glam::{DVec2, DVec3};

/// The case of the thesis to which a hit belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Case {
    /// Eq. 3.8 to 3.14.
    General,
    /// The hit is the corner `A1` or `C1`, which is mapped to its counterpart.
    Corner,
    /// Both ratios are 1, so the hit is on the side `A1 C1`: eq. 3.15 and 3.16.
    Hypotenuse,
}

/// The result of mapping a hit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mapped {
    /// `|B2 X|` along the leg `B2 A2` and `|B2 Y|` along the leg `B2 C2`. The values are NaN or
    /// infinite where the formula divides zero by zero.
    pub place: DVec2,
    /// The case that applied.
    pub case: Case,
}

/// Maps the point `hit` on the triangle with the corners `A1`, `B1`, `C1` to the right triangle
/// with the legs `legs = (|B2 A2|, |B2 C2|)`.
///
/// No case is added to the cases of the thesis, which lacks three. They give NaN, except the last:
///
/// - A hit on the side `A1 B1`, where eq. 3.9 divides by `r_BC = 0`.
/// - A triangle perpendicular to the x-y plane that is not parallel to another coordinate plane.
///   Eq. 3.14 sees this triangle only as a line.
/// - The corner `C1`, where `r_BA` is 0/0, as `r_BC` is at `A1`. It is treated as the thesis treats
///   `A1`.
pub fn map(corners: [DVec3; 3], hit: DVec3, legs: DVec2) -> Mapped {
    let [a, b, c] = corners;
    if hit == a {
        return Mapped { place: DVec2::new(legs.x, 0.0), case: Case::Corner };
    }
    if hit == c {
        return Mapped { place: DVec2::new(0.0, legs.y), case: Case::Corner };
    }
    let axes = axes(corners);
    let [a, b, c, hit] = [a, b, c, hit].map(|p| DVec2::new(p[axes[0]], p[axes[1]]));
    let r_bc = ratio(b, c, a, hit);
    let r_ba = ratio(b, a, c, hit);
    if r_bc == 1.0 && r_ba == 1.0 {
        // On the side itself the line from B1 gives the ratio, counted from A1.
        let r_ac = ratio(a, c, b, hit);
        let place = DVec2::new((1.0 - r_ac) * legs.x, r_ac * legs.y);
        return Mapped { place, case: Case::Hypotenuse };
    }
    let j_bc = r_bc * legs.y;
    let j_ba = r_ba * legs.x;
    let y = legs.y * j_bc * (j_ba - legs.x) / (j_ba * j_bc - legs.y * legs.x);
    let x = legs.x * (j_bc - y) / j_bc;
    Mapped { place: DVec2::new(x, y), case: Case::General }
}

/// Returns the coordinates in which eq. 3.13 is written: x and y. z replaces x if all x are equal,
/// and replaces y if all y are equal.
fn axes([a, b, c]: [DVec3; 3]) -> [usize; 2] {
    let same = |axis: usize| a[axis] == b[axis] && b[axis] == c[axis];
    if same(0) {
        [2, 1]
    } else if same(1) {
        [0, 2]
    } else {
        [0, 1]
    }
}

/// Eq. 3.14: returns the fraction of the side from `from` to `to` at which the line from `opposite`
/// through `hit` meets the side. It is `r_BC` as printed; the other ratios exchange corners.
fn ratio(from: DVec2, to: DVec2, opposite: DVec2, hit: DVec2) -> f64 {
    let ahead = hit - opposite;
    let rest = to - hit;
    let side = from - to;
    1.0 - (ahead.x * rest.y - ahead.y * rest.x) / (ahead.y * side.x - ahead.x * side.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const A: DVec3 = DVec3::new(1.0, 0.0, 2.0);
    const B: DVec3 = DVec3::new(4.0, 2.0, 1.0);
    const C: DVec3 = DVec3::new(2.0, 5.0, 3.0);
    const LEGS: DVec2 = DVec2::new(3.0, 2.0);

    fn at(weights: [f64; 3]) -> DVec3 {
        weights[0] * A + weights[1] * B + weights[2] * C
    }

    #[test]
    fn ratios_of_one_half_are_the_centre_of_gravity() {
        let flat = |p: DVec3| DVec2::new(p.x, p.y);
        let [a, b, c] = [A, B, C].map(flat);
        let hit = at([1.0 / 3.0; 3]);
        assert!((ratio(b, c, a, flat(hit)) - 0.5).abs() < 1e-15);
        assert!((ratio(b, a, c, flat(hit)) - 0.5).abs() < 1e-15);
        let mapped = map([A, B, C], hit, LEGS);
        assert!(mapped.place.abs_diff_eq(LEGS / 3.0, 1e-15), "{mapped:?}");
    }

    #[test]
    fn the_side_opposite_the_right_angle_and_its_corners_are_cases_of_their_own() {
        let case = |hit| map([A, B, C], hit, LEGS);
        assert_eq!(case(A), Mapped { place: DVec2::new(3.0, 0.0), case: Case::Corner });
        assert_eq!(case(C), Mapped { place: DVec2::new(0.0, 2.0), case: Case::Corner });
        let on_side = case(at([0.75, 0.0, 0.25]));
        assert_eq!(on_side.case, Case::Hypotenuse);
        assert_eq!(on_side.place, DVec2::new(2.25, 0.5));
    }

    #[test]
    fn what_the_thesis_leaves_out_is_zero_by_zero() {
        // On A1 B1, and at B1, eq. 3.9 is 0/0.
        assert!(map([A, B, C], at([0.5, 0.5, 0.0]), LEGS).place.x.is_nan());
        assert!(map([A, B, C], B, LEGS).place.x.is_nan());
        // The upright triangle x = y lies in no coordinate plane, and x and y do not determine z.
        let upright = [DVec3::ZERO, DVec3::new(4.0, 4.0, 0.0), DVec3::new(2.0, 2.0, 4.0)];
        let hit = DVec3::new(2.0, 2.0, 1.0);
        assert!(!map(upright, hit, LEGS).place.is_finite());
    }

    proptest! {
        /// In the open triangle the map is the barycentric map, also if the triangle lies in a
        /// coordinate plane.
        #[test]
        fn it_is_the_barycentric_map(
            a in 0.05..1.0f64, b in 0.05..1.0f64, c in 0.05..1.0f64, flat in 0usize..4,
        ) {
            let corners = [A, B, C].map(|mut p| {
                if flat < 3 {
                    p[flat] = 1.5;
                }
                p
            });
            let weights = [a, b, c].map(|weight| weight / (a + b + c));
            let hit = (0..3).map(|k| weights[k] * corners[k]).sum();
            let mapped = map(corners, hit, LEGS);
            let truth = DVec2::new(weights[0] * LEGS.x, weights[2] * LEGS.y);
            prop_assert_eq!(mapped.case, Case::General);
            // A weight of 0.02 costs two digits.
            prop_assert!(mapped.place.abs_diff_eq(truth, 1e-12), "{mapped:?} {truth}");
        }
    }
}
