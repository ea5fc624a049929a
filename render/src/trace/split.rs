//! How light divides at a surface, into a mirrored and a refracted ray.

use crate::optics;
use crate::scene::Material;
use glam::DVec3;

/// How light divides at a surface.
#[derive(Debug, Clone, Copy)]
pub struct Split {
    /// What the mirrored ray counts for.
    pub reflect_weight: f64,
    /// What the refracted ray counts for.
    pub refract_weight: f64,
    /// Where the refracted ray goes, if there is one.
    pub refracted: Option<DVec3>,
}

impl Split {
    /// At a surface between two media; `eta` is the index of refraction on the side that the ray
    /// came from over that on the other. Both normals are on the side that the ray came from.
    #[must_use]
    pub fn at(
        material: &Material,
        incident: DVec3,
        normal: DVec3,
        geometric_normal: DVec3,
        eta: f64,
    ) -> Self {
        let Material { reflectivity, transparency, .. } = *material;
        let mirror_only =
            Self { reflect_weight: reflectivity, refract_weight: 0.0, refracted: None };
        if transparency == 0.0 && !material.fresnel {
            return mirror_only;
        }
        let share =
            if material.fresnel { optics::fresnel(-incident.dot(normal), eta) } else { 1.0 };
        if transparency == 0.0 {
            return Self { reflect_weight: reflectivity * share, ..mirror_only };
        }
        // Where the interpolated normal would keep the ray on this side, the facet's does not.
        let refracted = optics::refract(incident, normal, eta).and_then(|direction| {
            if direction.dot(geometric_normal) < 0.0 {
                Some(direction)
            } else {
                optics::refract(incident, geometric_normal, eta)
            }
        });
        match refracted {
            Some(direction) if material.fresnel => Self {
                reflect_weight: reflectivity * share,
                refract_weight: transparency * (1.0 - share),
                refracted: Some(direction),
            },
            Some(direction) => Self {
                reflect_weight: reflectivity,
                refract_weight: transparency,
                refracted: Some(direction),
            },
            // Total internal reflection. Fresnel's share has grown to 1 on the way here, so that
            // nothing jumps.
            None if material.fresnel => Self { reflect_weight: reflectivity, ..mirror_only },
            // Without it, what would have passed is mirrored as well.
            None => Self { reflect_weight: reflectivity.max(transparency), ..mirror_only },
        }
    }
}

/// The mirrored direction; about the facet itself where the interpolated normal would send the
/// ray through the surface.
#[must_use]
pub fn mirror(incident: DVec3, normal: DVec3, geometric_normal: DVec3) -> DVec3 {
    let direction = optics::reflect(incident, normal);
    if direction.dot(geometric_normal) > 0.0 {
        direction
    } else {
        optics::reflect(incident, geometric_normal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn unit() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-1.0..1.0f64)
            .prop_map(DVec3::from)
            .prop_filter("a direction", |v| v.length() > 0.1)
            .prop_map(DVec3::normalize)
    }

    proptest! {
        /// However wrong the interpolated normal, mirrored light stays on its side of the facet
        /// and refracted light leaves it, and no light is made.
        #[test]
        fn an_interpolated_normal_sends_no_ray_through_the_facet(
            incident in unit(), facet in unit(), normal in unit(), eta in 0.4..2.5,
            fresnel in any::<bool>(),
        ) {
            let facet = if incident.dot(facet) < 0.0 { facet } else { -facet };
            prop_assume!(incident.dot(facet) < -1e-3 && incident.dot(normal) < -1e-3);
            prop_assert!(mirror(incident, normal, facet).dot(facet) > 0.0);
            let glass = Material {
                reflectivity: 1.0,
                transparency: 1.0,
                fresnel,
                ..Material::default()
            };
            let split = Split::at(&glass, incident, normal, facet, eta);
            if let Some(direction) = split.refracted {
                prop_assert!(direction.dot(facet) < 0.0);
            }
            if fresnel {
                prop_assert!((split.reflect_weight + split.refract_weight - 1.0).abs() < 1e-12);
            }
        }
    }
    #[test]
    fn with_fresnel_the_critical_angle_leaves_no_step_for_any_weights() {
        let critical = 1.0f64 / 1.5;
        for (reflectivity, transparency) in [(1.0, 1.0), (0.5, 1.0), (0.0, 0.9), (1.0, 0.25)] {
            let water =
                Material { reflectivity, transparency, fresnel: true, ..Material::default() };
            for ulps in -8i64..=8 {
                let sine = f64::from_bits(critical.to_bits().wrapping_add_signed(ulps));
                let incident = DVec3::new(sine, 0.0, -(1.0 - sine * sine).sqrt());
                let split = Split::at(&water, incident, DVec3::Z, DVec3::Z, 1.5);
                let off = (split.reflect_weight - reflectivity).abs();
                assert!(off < 1e-6 && split.refract_weight < 1e-6, "{ulps}: {split:?}");
            }
        }
    }
}
