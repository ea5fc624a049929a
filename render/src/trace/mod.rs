//! Follows rays through the scene and stores their hits (thesis 4.5.1, fig. 4.3).
//!
//! Tracing is classic: one ray at a time, mirrored and refracted at surfaces. Nothing is shaded during tracing. Each
//! sample on the film gets an [`tree::IntersectionTree`], and is shaded only when its neighbours have trees too.

mod cutout;
pub mod medium;
mod ranked;
pub mod rows;
mod split;
mod spreads;
pub mod tree;
mod viewpoint;
pub mod volume;

use crate::accel::Accel;
use crate::color::Color;
use crate::differential::RayDifferential;
use crate::ray::{Hit, Ray};
use crate::scene::{Camera, Scene};
use crate::shape::SurfacePoint;
use medium::{Boundary, Media};
use split::{Split, Turned, mirror};
use tree::{Away, Branch, IntersectionTree, Node};
use volume::Volumes;

/// Largest number of hidden boundaries that a ray passes before it is dropped. No meaningful scene
/// has as many; the limit bounds the work for one ray.
const MOST_HIDDEN: usize = 1 << 12;

/// Follows rays through one scene.
#[derive(Debug)]
pub struct Tracer<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The camera, most often that of the scene.
    pub camera: Camera,
    /// Structure that finds the hits.
    pub accel: &'a Accel<'a>,
    /// The volumes of the scene.
    pub volumes: &'a Volumes,
    /// The volumes that contain the camera.
    pub around_eye: Media,
    /// Least weight in its pixel, in some channel, of a ray that is followed, [0, 1].
    pub min_weight: f64,
}

/// Number of rays by kind, and number of rays that hit a surface.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct RayCounts {
    /// Rays from the eye.
    pub primary: u64,
    /// Mirrored rays, also those inside glass.
    pub reflected: u64,
    /// Rays that passed through a surface.
    pub refracted: u64,
    /// Rays of all three kinds that hit a surface.
    pub hits: u64,
}

/// The end of a ray: a visible surface, the background, or a dropped ray.
enum End {
    Surface(Hit, SurfacePoint, Boundary),
    Background,
    Lost,
}

/// A ray and, if footprints come from it alone, its differential. Last its closest hit, if it is known
/// whether there is one.
type Carried<'a> = (&'a Ray, Option<&'a RayDifferential>, Option<Option<Hit>>);

/// A visible surface that a ray reaches.
struct Seen {
    hit: Hit,
    point: SurfacePoint,
    boundary: Boundary,
    path: Path,
}

/// The path of a ray from the eye.
#[derive(Clone, Copy)]
struct Path {
    /// Number of reflections and refractions before this surface.
    depth: u32,
    /// Number of surfaces with masks that the path passed.
    passed: u32,
    /// True if the path entered a volume by refraction.
    has_entered: bool,
    /// True if the ray was mirrored inside of such a volume.
    is_turned: bool,
    /// Weight in the pixel of the light from this surface, linear RGB.
    weight: Color,
}

/// Gives the weight of a ray that is not worth following to the other ray at the same surface. If neither
/// is, but both together are, the heavier one gets both. The weights are those of the mirrored and of
/// the refracted ray.
///
/// The light of a ray that is not followed is thus taken to be that of the other ray. No light is lost,
/// and the error is the product of a small weight and a difference.
fn followed([mirrored, refracted]: [Color; 2], worth_it: impl Fn(Color) -> bool) -> [Color; 2] {
    let both = mirrored + refracted;
    match (worth_it(mirrored), worth_it(refracted)) {
        (true, true) => [mirrored, refracted],
        (false, false) if !worth_it(both) => [mirrored, refracted],
        (true, false) => [both, Color::ZERO],
        (false, true) => [Color::ZERO, both],
        _ if mirrored.max_element() > refracted.max_element() => [both, Color::ZERO],
        _ => [Color::ZERO, both],
    }
}

impl<'a> Tracer<'a> {
    /// Creates a tracer for the scene's camera and the least weight that the scene states.
    #[must_use]
    pub fn new(scene: &'a Scene, accel: &'a Accel<'a>, volumes: &'a Volumes) -> Self {
        let (camera, min_weight) = (scene.camera, scene.min_weight);
        let around_eye = volumes.around(scene, accel, camera.eye());
        Self { scene, camera, accel, volumes, around_eye, min_weight }
    }

    /// Traces a ray from the eye and fills its intersection tree.
    pub fn trace(&self, ray: &Ray, tree: &mut IntersectionTree, counts: &mut RayCounts) {
        self.trace_carried((ray, None, None), tree, counts);
    }

    /// Traces a ray from the eye as [`Tracer::trace`] does, and stores the spread of each hit in the
    /// tree. `differential` is that of the ray.
    pub fn trace_spread(
        &self,
        ray: &Ray,
        differential: &RayDifferential,
        tree: &mut IntersectionTree,
        counts: &mut RayCounts,
    ) {
        self.trace_carried((ray, Some(differential), None), tree, counts);
    }

    /// Traces a ray from the eye as [`Tracer::trace_spread`] does. `first` is its closest hit.
    pub fn trace_spread_from(
        &self,
        ray: &Ray,
        differential: &RayDifferential,
        first: Option<Hit>,
        tree: &mut IntersectionTree,
        counts: &mut RayCounts,
    ) {
        self.trace_carried((ray, Some(differential), Some(first)), tree, counts);
    }

    fn trace_carried(
        &self,
        carried: Carried<'_>,
        tree: &mut IntersectionTree,
        counts: &mut RayCounts,
    ) {
        tree.clear();
        counts.primary += 1;
        let mut media = std::mem::take(&mut tree.media);
        if self.camera.is_orthographic() && self.volumes.any() {
            // Each ray starts at a place of its own.
            let (ray, _, _) = carried;
            media = self.volumes.around(self.scene, self.accel, ray.origin);
        } else {
            media.start_in(&self.around_eye);
        }
        let (has_entered, is_turned) = (false, false);
        let path = Path { depth: 0, passed: 0, has_entered, is_turned, weight: Color::ONE };
        (tree.root, tree.through) = self.follow(carried, &mut media, path, tree, counts);
        tree.media = media;
    }

    /// Adds the hit of a ray, and the hits of its mirrored and refracted rays, to the tree. Returns
    /// the branch that the ray reaches and the transmittance up to it, linear RGB, [0, 1] per
    /// channel.
    ///
    /// `media` are the volumes around the ray's start and are restored at the end.
    fn follow(
        &self,
        carried: Carried<'_>,
        media: &mut Media,
        path: Path,
        tree: &mut IntersectionTree,
        counts: &mut RayCounts,
    ) -> (Branch, Color) {
        if tree.is_full() {
            return (Branch::Cut, Color::ONE);
        }
        let start = media.mark();
        let (ray, differential, first) = carried;
        let (end, through) = self.arrive(ray, first, media);
        let branch = match end {
            End::Surface(hit, point, boundary) => {
                let path = Path { weight: path.weight * through, ..path };
                let seen = Seen { hit, point, boundary, path };
                self.divide(carried, media, &seen, tree, counts)
            }
            End::Background => {
                let changes = differential.map(|differential| differential.direction);
                tree.leave(Away { direction: ray.direction, changes })
            }
            End::Lost => Branch::Cut,
        };
        media.back_to(start);
        (branch, through)
    }

    /// Adds a visible surface to the tree, and follows its mirrored and refracted rays.
    #[inline]
    fn divide(
        &self,
        (ray, differential, _): Carried<'_>,
        media: &mut Media,
        seen: &Seen,
        tree: &mut IntersectionTree,
        counts: &mut RayCounts,
    ) -> Branch {
        let Seen { hit, point, boundary, path } = *seen;
        counts.hits += 1;
        let object = &self.scene.objects[hit.piece.object as usize];
        let surface = &object.parts[point.part as usize];
        let material = &self.scene.materials[surface.material];
        let own = self.volumes.medium(self.scene, hit.piece.object, point.part);

        // Both normals are turned to the side from which the ray comes.
        let inside = ray.direction.dot(point.geometric_normal) > 0.0;
        let side = if inside { -1.0 } else { 1.0 };
        let geometric_normal = side * point.geometric_normal;
        let (outward, mut spreads) = match differential {
            None => (self.bumped(material, &hit, &point), None),
            Some(differential) => {
                let (outward, mut spreads) = self.spread(ray, differential, material, seen);
                spreads.turn(side);
                (outward, Some(spreads))
            }
        };
        let mut normal = side * outward;
        // The ray may meet the back of the interpolated normal. The facet's normal replaces it.
        if ray.direction.dot(normal) >= 0.0 {
            normal = geometric_normal;
            if let Some(spreads) = &mut spreads {
                spreads.flatten();
            }
        }

        let eta = boundary.eta(&self.scene.materials);
        let mut split = Split::at(material, ray.direction, normal, geometric_normal, eta);
        let tint = material.tint(-ray.direction.dot(normal));
        let mut weights = [split.reflect_weight * tint, Color::splat(split.refract_weight)];
        // A ray is followed if its weight in the pixel is large enough in some channel.
        let share = |weight: Color| (path.weight * weight).max_element();
        let worth_it = |weight: Color| share(weight) > 0.0 && share(weight) >= self.min_weight;
        if differential.is_some() && split.refracted.is_some() {
            weights = followed(weights, worth_it);
        }
        let is_last = path.depth >= self.scene.max_depth;
        let is_within = inside && own.is_some();
        let is_trapped = is_last && is_within && path.is_turned;
        if is_trapped {
            // Light that entered a volume leaves it at last, unless interpolated normals turn it round
            // without end. It is not lost: it leaves straight.
            weights = [Color::ZERO, weights[0] + weights[1]];
            split.refracted = Some(Turned::straight(ray.direction));
        }
        let passes = path.passed < cutout::MOST_PASSED
            && surface.mask(self.scene).is_some_and(|mask| {
                cutout::may_pass(mask, point.uv, spreads.as_ref().map(|s| s.shading.uv))
            });
        let [reflect_weight, refract_weight] = weights;
        let slot = tree.push(Node {
            piece: hit.piece,
            part: point.part,
            position: point.position,
            incident: ray.direction,
            geometric_normal,
            normal,
            uv: point.uv,
            reflected: Branch::Cut,
            refracted: Branch::Cut,
            reflect_weight,
            refract_weight,
            pass_weight: if passes { Color::ONE } else { Color::ZERO },
            inside: is_within,
        });
        if let Some(spreads) = &spreads {
            tree.push_spread(spreads.shading);
        }
        let normals = [normal, geometric_normal];
        let deeper =
            |weight: Color| Path { depth: path.depth + 1, weight: path.weight * weight, ..path };
        if worth_it(reflect_weight) && !is_last {
            counts.reflected += 1;
            let turned = mirror(ray.direction, normal, geometric_normal);
            let mirrored = Ray::leaving(hit.piece, point.position, turned.direction);
            let differential =
                spreads.as_ref().map(|spreads| spreads.reflected(turned, ray.direction, normals));
            let mirrored = (&mirrored, differential.as_ref(), None);
            let is_turned = path.has_entered && is_within;
            let path = Path { is_turned, ..deeper(reflect_weight) };
            let (branch, through) = self.follow(mirrored, media, path, tree, counts);
            let node = tree.node_mut(slot);
            node.reflected = branch;
            node.reflect_weight *= through;
        }
        // A mask lets light run straight on, which is no refraction and has no depth of its own.
        let passing = passes.then(|| Turned::straight(ray.direction));
        let leaves = !is_last || is_trapped;
        let refracted = split.refracted.filter(|_| leaves && worth_it(refract_weight));
        if let Some(turned) = refracted.or(passing.filter(|_| worth_it(Color::ONE))) {
            counts.refracted += 1;
            let passed = Ray::leaving(hit.piece, point.position, turned.direction);
            let eta = if turned.is_straight { 1.0 } else { eta };
            let differential = spreads
                .as_ref()
                .map(|spreads| spreads.refracted(turned, ray.direction, normals, eta));
            let passed = (&passed, differential.as_ref(), None);
            let path = if passes {
                Path { passed: path.passed + 1, ..path }
            } else {
                let has_entered = path.has_entered || !inside;
                Path { has_entered, is_turned: false, ..deeper(refract_weight) }
            };
            if let Some(own) = own {
                media.cross(own, inside, &self.scene.materials);
            }
            let (branch, through) = self.follow(passed, media, path, tree, counts);
            let node = tree.node_mut(slot);
            node.refracted = branch;
            node.refract_weight *= through;
            node.pass_weight *= through;
        }
        Branch::Node(slot)
    }

    /// Sends a ray to the first surface that no other volume hides. Returns the end of the ray and
    /// the transmittance up to it, linear RGB, [0, 1] per channel. `media` become the volumes in
    /// front of that surface. `first` is the ray's closest hit, if it is known whether there is one.
    #[inline]
    fn arrive(&self, ray: &Ray, mut first: Option<Option<Hit>>, media: &mut Media) -> (End, Color) {
        let Self { scene, volumes, .. } = self;
        let mut through = Color::ONE;
        let mut ray = *ray;
        for _ in 0..MOST_HIDDEN {
            let hit = first.take().unwrap_or_else(|| self.accel.closest(&ray, f64::INFINITY));
            let Some(hit) = hit else {
                let medium = media.current();
                return (End::Background, through * self.transmittance(medium, f64::INFINITY));
            };
            let point = self.accel.surface_point(&ray, &hit);
            let inside = ray.direction.dot(point.geometric_normal) > 0.0;
            let Some(own) = volumes.medium(scene, hit.piece.object, point.part) else {
                // An object without an inside is no medium; the ray stays in its current one.
                let medium = media.current();
                through *= self.transmittance(medium, hit.t);
                let surface = scene.objects[hit.piece.object as usize].parts[point.part as usize];
                let boundary = media.sheet(surface.material as u32, inside);
                return (End::Surface(hit, point, boundary), through);
            };
            let boundary = media.boundary(own, inside, &scene.materials);
            through *= self.transmittance(boundary.before, hit.t);
            if boundary.seen {
                return (End::Surface(hit, point, boundary), through);
            }
            media.cross(own, inside, &scene.materials);
            ray = Ray::leaving(hit.piece, point.position, ray.direction);
        }
        (End::Lost, through)
    }

    /// Returns the transmittance of a material over a distance in scene units, linear RGB, [0, 1]
    /// per channel.
    fn transmittance(&self, medium: Option<u32>, distance: f64) -> Color {
        medium.map_or(Color::ONE, |material| {
            self.scene.materials[material as usize].transmittance(distance)
        })
    }
}
