//! Mirror and refraction directions, total internal reflection and Fresnel's equations.
//!
//! The thesis's conventions (4.5.3) apply. The incident direction `I` points *at* the surface, and
//! the normal `N` lies on the incident side. Both are unit vectors. `eta` is the index of
//! refraction on the incident side over the index on the transmitted side. Other books reverse one
//! or both of these conventions.

pub mod thin_film;

use glam::DVec3;

/// Returns the unit mirrored direction, `R = I + 2 c1 N` (thesis eq. 4.1). Both arguments are unit.
#[must_use]
pub fn reflect(incident: DVec3, normal: DVec3) -> DVec3 {
    (incident - 2.0 * incident.dot(normal) * normal).normalize()
}

/// Returns the unit refracted direction, or `None` if all light is reflected (thesis eq. 4.6-4.8).
/// Both vectors are unit, and `eta` is positive.
///
/// Between equal media the direction stays unchanged to the last bit.
#[must_use]
pub fn refract(incident: DVec3, normal: DVec3, eta: f64) -> Option<DVec3> {
    if eta == 1.0 {
        // There is no boundary. The formula below would bend the ray by its rounding errors, which
        // are large at grazing angles.
        return Some(incident);
    }
    let c1 = -incident.dot(normal);
    let c2 = transmitted_cosine(c1, eta)?;
    Some((eta * incident + (eta * c1 - c2) * normal).normalize())
}

/// Returns Fresnel's reflectance in `[0, 1]`: the share of unpolarized light that a smooth boundary
/// of two dielectrics reflects.
///
/// `c1` is the cosine of the angle of incidence, [0, 1]. The rest of the light is transmitted. The
/// reflectance is exactly 1 beyond the critical angle, and exactly 0 between equal media.
#[must_use]
pub fn fresnel(c1: f64, eta: f64) -> f64 {
    if eta == 1.0 {
        return 0.0;
    }
    let Some(c2) = transmitted_cosine(c1, eta) else { return 1.0 };
    // With eta = n1/n2 both amplitude ratios are independent of the absolute indices.
    let perpendicular = (eta * c1 - c2) / (eta * c1 + c2);
    let parallel = (c1 - eta * c2) / (c1 + eta * c2);
    let share = 0.5 * (perpendicular * perpendicular + parallel * parallel);
    // 0/0 when both cosines vanish: grazing light is reflected.
    if share.is_finite() { share.min(1.0) } else { 1.0 }
}

/// Returns the cosine of the transmitted angle (thesis eq. 4.7), or `None` beyond the critical
/// angle (4.8).
fn transmitted_cosine(c1: f64, eta: f64) -> Option<f64> {
    let c2_sq = 1.0 - eta * eta * (1.0 - c1 * c1);
    (c2_sq >= 0.0).then(|| c2_sq.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Returns the direction that meets the plane z = 0 from above at `angle` radians from its
    /// normal.
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
            // Brackets the last cosine that is reflected and the first that is refracted; ten ulps
            // on each side.
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
        // Perpendicular incidence on glass: ((n - 1)/(n + 1))^2.
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
