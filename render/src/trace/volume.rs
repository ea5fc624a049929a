//! Finds the transparent closed objects, and the volumes that contain a point.

use super::medium::{Media, Medium};
use crate::accel::Accel;
use crate::ray::Ray;
use crate::scene::{Light, Object, Scene, SpotLight};
use crate::shape::Shape;
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};

/// A direction along which no edge of a scene is likely to lie. A ray that meets an edge may count
/// both of its triangles.
const ASKEW: DVec3 = DVec3::new(0.4199743416, 0.5532967357, 0.7193814786);

/// The volumes of a scene.
#[derive(Debug)]
pub struct Volumes {
    /// For each object, true if it bounds a volume: if it is transparent and closed.
    volumes: Vec<bool>,
    /// True if some volume absorbs light.
    absorb: bool,
}

impl Volumes {
    /// Finds the volumes of a scene. A mesh is examined only if it is transparent.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let transparent = |object: &Object| {
            object.parts.iter().any(|part| scene.materials[part.material].transparency > 0.0)
        };
        let volume = |object: &Object| transparent(object) && object.shape.is_closed();
        let volumes: Vec<bool> = scene.objects.iter().map(volume).collect();
        let absorb = scene.objects.iter().zip(&volumes).any(|(object, &volume)| {
            let absorbs = |material: usize| scene.materials[material].absorption != DVec3::ZERO;
            volume && object.parts.iter().any(|part| absorbs(part.material))
        });
        Self { volumes, absorb }
    }

    /// Returns whether the scene has a volume.
    #[must_use]
    pub fn any(&self) -> bool {
        self.volumes.contains(&true)
    }

    /// Returns whether some volume absorbs light.
    #[must_use]
    pub fn absorb(&self) -> bool {
        self.absorb
    }

    /// Returns the volume that a surface bounds, if it bounds one. `object` and `part` are indices
    /// of the object and of its surface.
    #[must_use]
    pub fn medium(&self, scene: &Scene, object: u32, part: u32) -> Option<Medium> {
        if !self.volumes[object as usize] {
            return None;
        }
        let material = scene.objects[object as usize].parts[part as usize].material;
        let transparent = scene.materials[material].transparency > 0.0;
        transparent.then_some(Medium { object, material: material as u32 })
    }

    /// Returns the volumes that contain a point, the innermost last.
    ///
    /// A ray from the point meets the back of such a volume once more often than its front. Of two
    /// volumes, the one that the ray leaves first counts as the inner one.
    #[must_use]
    pub fn around(&self, scene: &Scene, accel: &Accel<'_>, place: DVec3) -> Media {
        let ray = Ray::from_eye(place, ASKEW.normalize());
        // For each volume that the ray meets: the volume, the number of backs minus the number of
        // fronts, and the distance of the farthest hit.
        let mut met: BTreeMap<u32, (Medium, i32, f64)> = BTreeMap::new();
        if self.any() {
            accel.any(&ray, f64::INFINITY, |hit| {
                if let Some(own) = self.medium(scene, hit.piece.object, accel.part(&hit)) {
                    let normal = accel.geometric_normal(&ray, &hit);
                    let side = if normal.dot(ray.direction) > 0.0 { 1 } else { -1 };
                    let (_, sides, far) = met.entry(own.object).or_insert((own, 0, hit.t));
                    (*sides, *far) = (*sides + side, far.max(hit.t));
                }
                false
            });
        }
        let mut around: Vec<(Medium, f64)> = met
            .into_values()
            .filter(|(_, sides, _)| *sides > 0)
            .map(|(own, _, far)| (own, far))
            .collect();
        around.extend(self.endless(scene, place).map(|own| (own, f64::INFINITY)));
        ordered(around, scene)
    }

    /// Returns the volumes that contain a point at infinite distance in a direction.
    fn around_far(&self, scene: &Scene, toward: DVec3) -> Media {
        let behind = |object: &Object| match &object.shape {
            Shape::Quad(quad) => quad.normal().dot(toward) < 0.0,
            Shape::Sphere(_)
            | Shape::Mesh(_)
            | Shape::Cuboid(_)
            | Shape::Superquadric(_)
            | Shape::Placed(_)
            | Shape::Instance(_) => false,
        };
        let media = self.all(scene).filter(|own| behind(&scene.objects[own.object as usize]));
        ordered(media.map(|own| (own, f64::INFINITY)).collect(), scene)
    }

    /// Returns the volumes that contain each light. They are empty if no volume absorbs light,
    /// since they are then not needed.
    #[must_use]
    pub fn around_lights(&self, scene: &Scene, accel: &Accel<'_>) -> Vec<Media> {
        let around = |light: &Light| match light {
            _ if !self.absorb => Media::default(),
            Light::Point(light) | Light::Spot(SpotLight { point: light, .. }) => {
                self.around(scene, accel, light.position)
            }
            Light::Directional(light) => self.around_far(scene, light.toward),
        };
        scene.lights.iter().map(around).collect()
    }

    /// Returns the half spaces behind planes that contain a point. A ray may never meet their
    /// boundary.
    fn endless<'s>(&'s self, scene: &'s Scene, place: DVec3) -> impl Iterator<Item = Medium> + 's {
        self.all(scene).filter(move |own| match &scene.objects[own.object as usize].shape {
            Shape::Quad(quad) => (place - quad.corner()).dot(quad.normal()) < 0.0,
            Shape::Sphere(_)
            | Shape::Mesh(_)
            | Shape::Cuboid(_)
            | Shape::Superquadric(_)
            | Shape::Placed(_)
            | Shape::Instance(_) => false,
        })
    }

    /// Returns the volume of each object that bounds one, taken from the object's first surface.
    fn all<'s>(&'s self, scene: &'s Scene) -> impl Iterator<Item = Medium> + 's {
        (0..scene.objects.len() as u32).filter_map(|object| self.medium(scene, object, 0))
    }
}

/// Sorts volumes from the farthest boundary to the nearest. A half space that the ray also meets
/// counts as endless.
fn ordered(mut media: Vec<(Medium, f64)>, scene: &Scene) -> Media {
    media.sort_by(|(a, near), (b, far)| far.total_cmp(near).then(a.object.cmp(&b.object)));
    let mut known = BTreeSet::new();
    let each_once = media.into_iter().map(|(own, _)| own).filter(|own| known.insert(own.object));
    Media::within(each_once, &scene.materials)
}
