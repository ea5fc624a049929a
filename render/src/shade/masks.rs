//! The light that masks let pass on a shadow ray.

use super::Shader;
use crate::differential::RayDifferential;
use crate::footprint::Footprint;
use crate::ray::{Hit, Ray};
use crate::shape::{Changes, SurfacePoint};

/// Largest number of surfaces that a shadow ray meets one after another. Beyond them no light passes.
///
/// If larger, hostile scenes take long. If smaller, the light under thick foliage is cut.
const MOST_MET: usize = 1 << 10;

impl Shader<'_> {
    /// Returns the part of the light that the masks on a ray let pass, [0, 1]. The ray ends at the
    /// distance `end`. Each surface with a mask counts where the ray meets it; other surfaces are left
    /// out. `differential` is that of the ray, over which masks are averaged.
    pub(super) fn passed_by_masks(
        &self,
        ray: &Ray,
        end: f64,
        differential: Option<&RayDifferential>,
    ) -> f64 {
        let (mut passed, mut start, mut step) = (1.0, 0.0, *ray);
        for _ in 0..MOST_MET {
            // As for the boundaries of volumes, the exact test follows the one along the ray.
            let t_max = (end - start) * (1.0 + 1e-9) + f64::EPSILON * start;
            let hit = self.accel.closest(&step, t_max).filter(|hit| start + hit.t < end);
            let Some(hit) = hit else { return passed };
            start += hit.t;
            let point = self.accel.surface_point(&step, &hit);
            let surface = self.scene.objects[hit.piece.object as usize].parts[point.part as usize];
            if surface.mask(self.scene).is_some() {
                let covered = self.covered(ray, start, &hit, &point, differential);
                let transparency = self.scene.materials[surface.material].transparency;
                passed *= 1.0 - covered * (1.0 - transparency);
                if passed <= 0.0 {
                    return 0.0;
                }
            }
            step = Ray::leaving(hit.piece, point.position, ray.direction);
        }
        0.0
    }

    /// Returns the part of the ray's cross section that a surface with a mask covers, [0, 1].
    fn covered(
        &self,
        ray: &Ray,
        t: f64,
        hit: &Hit,
        point: &SurfacePoint,
        differential: Option<&RayDifferential>,
    ) -> f64 {
        let object = &self.scene.objects[hit.piece.object as usize];
        let picture = object.parts[point.part as usize].picture();
        let Some(texture) = picture.and_then(|index| self.textures[index].as_ref()) else {
            return 1.0;
        };
        let sides = differential.map(|differential| {
            let position = differential.transferred(ray.direction, t, point.geometric_normal);
            let Changes { uv, .. } =
                object.shape.changes(hit.piece.triangle, hit.barycentric, point, position);
            uv
        });
        let footprint = match sides {
            Some(sides) if sides.iter().all(|side| side.is_finite()) => {
                Footprint::Parallelogram { center: point.uv, sides }
            }
            Some(_) | None => Footprint::Point(point.uv),
        };
        let has_poles = object.shape.has_poles();
        texture.coverage(&if has_poles { texture.between_poles(footprint) } else { footprint })
    }
}
