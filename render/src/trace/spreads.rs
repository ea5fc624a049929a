//! Spreads of hits, with and without the bump of the surface.

use super::split::Turned;
use super::{Seen, Tracer};
use crate::differential::{RayDifferential, Spread};
use crate::procedural::PlaceChanges;
use crate::ray::Ray;
use crate::scene::Material;
use crate::shape::Changes;
use glam::DVec3;

/// The spreads of a hit, which differ in the normal.
#[derive(Clone, Copy)]
pub(super) struct Spreads {
    /// With the normal of the surface itself.
    pub facet: Spread,
    /// With the normal for shading.
    pub shading: Spread,
}

impl Spreads {
    /// Returns the spreads with normals on the outside, which have `side` 1, or on the inside, which
    /// have -1.
    pub fn on_side(self, side: f64) -> Self {
        let turned =
            |spread: Spread| Spread { normal: spread.normal.map(|change| side * change), ..spread };
        Self { facet: turned(self.facet), shading: turned(self.shading) }
    }

    /// Returns the spread and the normal that turned a ray, of the two normals given.
    pub fn of(&self, turned: Turned, shading: DVec3, facet: DVec3) -> (Spread, DVec3) {
        if turned.by_facet { (self.facet, facet) } else { (self.shading, shading) }
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
        let flat = shape.mesh().is_some();
        let facet = if flat { Spread { normal: [DVec3::ZERO; 2], ..smooth } } else { smooth };
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
}
