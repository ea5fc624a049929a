//! Mirror and refraction directions, total internal reflection and Fresnel's equations.
//!
//! The thesis's conventions (4.5.3): the incident direction `I` points *at* the surface, the normal
//! `N` lies on the incident side, both are unit, and `eta` is the index on the incident side over
//! that on the transmitted side. Other books turn one or both round.

pub mod thin_film;

use glam::DVec3;

/// The mirrored direction, `R = I + 2 c1 N` (thesis eq. 4.1), unit when its arguments are.
#[must_use]
pub fn reflect(incident: DVec3, normal: DVec3) -> DVec3 {
    (incident - 2.0 * incident.dot(normal) * normal).normalize()
}

/// The refracted direction, or nothing when all light is reflected (thesis eq. 4.6-4.8).
///
/// Between equal media the direction stays as it is, to the last bit.
#[must_use]
pub fn refract(incident: DVec3, normal: DVec3, eta: f64) -> Option<DVec3> {
    if eta == 1.0 {
        // No boundary at all; by the formula below the way would bend by its roundings, which at
        // grazing angles are many.
        return Some(incident);
    }
    let c1 = -incident.dot(normal);
    let c2 = transmitted_cosine(c1, eta)?;
    Some((eta * incident + (eta * c1 - c2) * normal).normalize())
}

/// The share of unpolarized light that a smooth boundary of two dielectrics reflects, in `[0, 1]`.
///
/// `c1` is the cosine of the angle of incidence. The rest is transmitted; beyond the critical
/// angle the share is exactly 1, and between equal media exactly 0.
#[must_use]
pub fn fresnel(c1: f64, eta: f64) -> f64 {
    if eta == 1.0 {
        return 0.0;
    }
    let Some(c2) = transmitted_cosine(c1, eta) else { return 1.0 };
    // With eta = n1/n2 both amplitude ratios are free of the absolute indices.
    let perpendicular = (eta * c1 - c2) / (eta * c1 + c2);
    let parallel = (c1 - eta * c2) / (c1 + eta * c2);
    let share = 0.5 * (perpendicular * perpendicular + parallel * parallel);
    // 0/0 when both cosines vanish: grazing light is reflected.
    if share.is_finite() { share.min(1.0) } else { 1.0 }
}

/// The cosine of the transmitted angle (thesis eq. 4.7); nothing beyond the critical angle (4.8).
fn transmitted_cosine(c1: f64, eta: f64) -> Option<f64> {
    let c2_sq = 1.0 - eta * eta * (1.0 - c1 * c1);
    (c2_sq >= 0.0).then(|| c2_sq.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The direction that comes down on the plane z = 0 at `angle` from its normal.
    fn down_at(angle: f64) -> DVec3 {
        DVec3::new(angle.sin(), 0.0, -angle.cos())
    }

    proptest! {
        #[test]
        fn refraction_obeys_snell_and_stays_unit_and_coplanar(
            angle in 0.0..1.55, eta in 0.4..2.5
        ) {
            let incident = down_at(angle);
            match refract(incident, DVec3::Z, eta) {
                Some(transmitted) => {
                    let sine = (1.0 - transmitted.z * transmitted.z).max(0.0).sqrt();
                    prop_assert!((sine - eta * angle.sin()).abs() < 1e-7);
                    prop_assert!((transmitted.length() - 1.0).abs() < 1e-14);
                    prop_assert!(transmitted.y == 0.0 && transmitted.z <= 0.0);
                }
                None => prop_assert!(eta * angle.sin() > 1.0),
            }
        }

        #[test]
        fn fresnel_is_a_share_and_is_the_same_from_both_sides(angle in 0.0..1.55, eta in 0.4..1.0) {
            let c1 = f64::cos(angle);
            let share = fresnel(c1, eta);
            prop_assert!((0.0..=1.0).contains(&share));
            let c2 = transmitted_cosine(c1, eta).unwrap();
            prop_assert!((share - fresnel(c2, 1.0 / eta)).abs() < 1e-12);
        }
    }

    #[test]
    fn light_turns_back_beyond_the_critical_angle() {
        let critical = f64::asin(1.0 / 1.5);
        assert!(refract(down_at(critical - 1e-9), DVec3::Z, 1.5).is_some());
        assert!(refract(down_at(critical + 1e-9), DVec3::Z, 1.5).is_none());
        assert_eq!(fresnel((critical + 1e-9).cos(), 1.5), 1.0);
    }

    #[test]
    fn at_the_critical_angle_fresnels_share_has_no_step() {
        for eta in [1.1, 1.33, 1.5, 2.4] {
            // The last cosine that passes and the first that does not, and ten ulps on each side.
            let mut low = f64::sqrt(1.0 - 1.0 / (eta * eta)).to_bits() - 1000;
            let mut high = low + 2000;
            while high - low > 1 {
                let middle = u64::midpoint(low, high);
                let passes = transmitted_cosine(f64::from_bits(middle), eta).is_some();
                if passes { high = middle } else { low = middle }
            }
            for bits in high - 10..high + 10 {
                let c1 = f64::from_bits(bits);
                let share = fresnel(c1, eta);
                assert!((0.0..=1.0).contains(&share) && 1.0 - share < 1e-6, "{eta} {c1} {share}");
                let sine = (1.0 - c1 * c1).sqrt();
                let refracted = refract(DVec3::new(sine, 0.0, -c1), DVec3::Z, eta);
                assert_eq!(refracted.is_some(), bits >= high, "{eta} {c1}");
                assert!(refracted.is_none_or(DVec3::is_normalized));
            }
        }
    }

    #[test]
    fn known_values() {
        // Straight on glass: ((n - 1)/(n + 1))^2.
        assert!((fresnel(1.0, 1.0 / 1.5) - 0.04).abs() < 1e-15);
        assert_eq!(fresnel(0.0, 1.0 / 1.5), 1.0);
        assert_eq!((fresnel(0.3, 1.0), fresnel(0.0, 1.0)), (0.0, 0.0));
        let incident = down_at(0.7);
        assert_eq!(refract(incident, DVec3::Z, 1.0), Some(incident));
        assert!(
            reflect(incident, DVec3::Z)
                .abs_diff_eq(DVec3::new(0.7f64.sin(), 0.0, 0.7f64.cos()), 1e-15)
        );
    }
}
