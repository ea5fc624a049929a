//! Division of light at a surface into a mirrored and a refracted ray.

use crate::optics;
use crate::scene::Material;
use glam::DVec3;

/// Weights of the mirrored and the refracted ray at a surface, and the direction of the latter.
#[derive(Debug, Clone, Copy)]
pub struct Split {
    /// Weight of the mirrored ray, [0, 1].
    pub reflect_weight: f64,
    /// Weight of the refracted ray, [0, 1].
    pub refract_weight: f64,
    /// The refracted ray, if there is one.
    pub refracted: Option<Turned>,
}

/// The direction of a mirrored or refracted ray, and the normal that turned it.
#[derive(Debug, Clone, Copy)]
pub struct Turned {
    /// Unit direction of the ray.
    pub direction: DVec3,
    /// True if the facet's normal turned the ray, because the interpolated normal would have sent
    /// it to the wrong side of the surface.
    pub by_facet: bool,
    /// True if the ray runs straight on, whatever the media.
    pub is_straight: bool,
}

impl Turned {
    /// A ray that runs on in its direction.
    #[must_use]
    pub fn straight(direction: DVec3) -> Self {
        Self { direction, by_facet: true, is_straight: true }
    }
}

impl Split {
    /// Divides light at a surface between two media. `eta` is the index of refraction on the side
    /// of the incident ray over the index on the other side. `incident` is a unit vector. Both unit
    /// normals are on the side of the incident ray.
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
        let reflectance = |normal: DVec3| {
            if material.fresnel { optics::fresnel(-incident.dot(normal), eta) } else { 1.0 }
        };
        if transparency == 0.0 {
            return Self { reflect_weight: reflectivity * reflectance(normal), ..mirror_only };
        }
        let by_facet = || {
            let direction = optics::refract(incident, geometric_normal, eta)?;
            Some(Turned { direction, by_facet: true, is_straight: false })
        };
        let (refracted, share) = match optics::refract(incident, normal, eta) {
            Some(direction) if direction.dot(geometric_normal) < 0.0 => (
                Some(Turned { direction, by_facet: false, is_straight: false }),
                reflectance(normal),
            ),
            // The facet's normal replaces an interpolated normal that would keep the ray on this side.
            Some(_) => (by_facet(), reflectance(normal)),
            None if normal == geometric_normal => (None, reflectance(normal)),
            // So it does where only the interpolated normal gives total reflection. Otherwise light could
            // enter glass of few facets and never leave it.
            None => (by_facet(), reflectance(geometric_normal)),
        };
        match refracted {
            Some(turned) if material.fresnel => Self {
                reflect_weight: reflectivity * share,
                refract_weight: transparency * (1.0 - share),
                refracted: Some(turned),
            },
            Some(turned) => Self {
                reflect_weight: reflectivity,
                refract_weight: transparency,
                refracted: Some(turned),
            },
            // Total internal reflection. Fresnel's reflectance reaches 1 continuously at the
            // critical angle, so the weights have no step there.
            None if material.fresnel => Self { reflect_weight: reflectivity, ..mirror_only },
            // Without Fresnel, the light that would be refracted is mirrored as well.
            None => Self { reflect_weight: reflectivity.max(transparency), ..mirror_only },
        }
    }
}

/// Returns the mirrored ray. The facet's normal replaces the interpolated
/// normal where the latter would send the ray through the surface.
#[must_use]
pub fn mirror(incident: DVec3, normal: DVec3, geometric_normal: DVec3) -> Turned {
    let direction = optics::reflect(incident, normal);
    if direction.dot(geometric_normal) > 0.0 {
        Turned { direction, by_facet: false, is_straight: false }
    } else {
        let direction = optics::reflect(incident, geometric_normal);
        Turned { direction, by_facet: true, is_straight: false }
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
        /// For any interpolated normal, mirrored light stays on its side of the facet, refracted
        /// light leaves that side, and no light is created.
        #[test]
        fn an_interpolated_normal_sends_no_ray_through_the_facet(
            incident in unit(), facet in unit(), normal in unit(), eta in 0.4..2.5,
            fresnel in any::<bool>(),
        ) {
            let facet = if incident.dot(facet) < 0.0 { facet } else { -facet };
            prop_assume!(incident.dot(facet) < -1e-3 && incident.dot(normal) < -1e-3);
            prop_assert!(mirror(incident, normal, facet).direction.dot(facet) > 0.0);
            let glass = Material {
                reflectivity: 1.0,
                transparency: 1.0,
                fresnel,
                ..Material::default()
            };
            let split = Split::at(&glass, incident, normal, facet, eta);
            if let Some(turned) = split.refracted {
                prop_assert!(turned.direction.dot(facet) < 0.0);
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
