//! Spreads of hits, with and without the bump of the surface.

use super::split::Turned;
use super::{Seen, Tracer};
use crate::differential::{RayDifferential, Spread};
use crate::procedural::{Bump, Place, PlaceChanges};
use crate::ray::{Hit, Ray};
use crate::scene::Material;
use crate::shape::{Changes, SurfacePoint};
use glam::DVec3;

/// The spreads of a hit, which differ in the changes of the normal.
#[derive(Clone, Copy)]
pub(super) struct Spreads {
    /// The spread with the normal for shading.
    pub shading: Spread,
    /// Changes of the normal of the surface itself.
    facet: [DVec3; 2],
}

impl Spreads {
    /// Turns normals to the outside, with a `side` of 1, or to the inside, with -1.
    pub fn turn(&mut self, side: f64) {
        for change in self.shading.normal.iter_mut().chain(&mut self.facet) {
            *change *= side;
        }
    }

    /// Replaces the normal for shading by that of the surface itself.
    pub fn flatten(&mut self) {
        self.shading = self.facet();
    }

    /// Returns the spread with the normal of the surface itself.
    fn facet(&self) -> Spread {
        Spread { normal: self.facet, roughness: 0.0, ..self.shading }
    }

    /// Returns the differential of a mirrored ray; `incident` is the unit direction of the ray that
    /// hits. `normals` are the normal for shading and that of the surface itself.
    pub fn reflected(
        &self,
        turned: Turned,
        incident: DVec3,
        normals: [DVec3; 2],
    ) -> RayDifferential {
        if turned.by_facet {
            self.facet().reflected(incident, normals[1])
        } else {
            self.shading.reflected(incident, normals[0])
        }
    }

    /// Returns the differential of a refracted ray, as [`Spreads::reflected`] does of a mirrored one.
    /// `eta` is that of [`Spread::refracted`].
    pub fn refracted(
        &self,
        turned: Turned,
        incident: DVec3,
        normals: [DVec3; 2],
        eta: f64,
    ) -> RayDifferential {
        if turned.by_facet {
            self.facet().refracted(incident, normals[1], eta)
        } else {
            self.shading.refracted(incident, normals[0], eta)
        }
    }
}

impl Tracer<'_> {
    /// Returns the unit normal for shading and the spreads of a hit: that of the smooth surface, and
    /// that of the surface with the bump of its material, averaged over the spread. Normals are on the
    /// outside of the surface.
    pub(super) fn spread(
        &self,
        ray: &Ray,
        differential: &RayDifferential,
        material: &Material,
        seen: &Seen,
    ) -> (DVec3, Spreads) {
        let Seen { hit, point, .. } = seen;
        let object = &self.scene.objects[hit.piece.object as usize];
        let shape = &object.shape;
        // The ray may have passed hidden boundaries, so the distance is not that of the hit.
        let t = (point.position - ray.origin).dot(ray.direction);
        let position = differential.transferred(ray.direction, t, point.geometric_normal);
        let incident = differential.direction;
        let Changes { uv, normal } =
            shape.changes(hit.piece.triangle, hit.barycentric, point, position);
        let smooth = Spread { position, uv, normal, incident, roughness: 0.0 };
        let facet = if shape.mesh().is_some() { [DVec3::ZERO; 2] } else { normal };
        let Some(bump) = material.bump.map(|bump| &self.scene.procedural.bumps[bump]) else {
            return (point.shading_normal, Spreads { facet, shading: smooth });
        };
        let place = self.place(bump, hit, point);
        let uv_gradients = if bump.wants_uv() {
            shape.uv_gradient_changes(point, position, normal)
        } else {
            [[DVec3::ZERO; 2]; 2]
        };
        let changes = PlaceChanges { point: position, normal, uv, uv_gradients };
        let averaged = bump.averaged(&object.to_own_space, &place, &changes);
        let shading = Spread { normal: averaged.changes, roughness: averaged.roughness, ..smooth };
        (averaged.normal, Spreads { facet, shading })
    }

    /// Returns the unit normal for shading, perturbed by the material's bump if it has one.
    pub(super) fn bumped(&self, material: &Material, hit: &Hit, point: &SurfacePoint) -> DVec3 {
        let Some(bump) = material.bump.map(|bump| &self.scene.procedural.bumps[bump]) else {
            return point.shading_normal;
        };
        let object = &self.scene.objects[hit.piece.object as usize];
        bump.normal(&object.to_own_space, &self.place(bump, hit, point))
    }

    /// Returns a hit as the place of a bump.
    fn place(&self, bump: &Bump, hit: &Hit, point: &SurfacePoint) -> Place {
        let shape = &self.scene.objects[hit.piece.object as usize].shape;
        let uv_gradients = if bump.wants_uv() {
            shape.uv_gradients(hit.piece.triangle, point.position)
        } else {
            [DVec3::ZERO; 2]
        };
        let (position, normal) = (point.position, point.shading_normal);
        Place { point: position, normal, uv: point.uv, uv_gradients }
    }
}
