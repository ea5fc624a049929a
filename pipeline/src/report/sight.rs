//! Finds the objects and paths that a pixel sees, and the number of texels that its footprint
//! spans.
//!
//! Five rays are traced for each pixel: through its middle and through four points close by. The
//! tree of the middle ray determines what the pixel sees. Where another ray reaches the same
//! surface by the same path, the difference between the two texture coordinates gives the
//! derivative with respect to film position. This method also works behind mirrors and glass.

use glam::{DMat2, DVec2};
use render::accel::Structure;
use render::color::Color;
use render::footprint::{Bundle, Footprint, PointReason, Sight};
use render::scene::Material;
use render::shape::{Charts, Shape};
use render::trace::tree::{Branch, Child, IntersectionTree, Node};
use render::trace::{RayCounts, Tracer};
use render::{Prepared, Scene};

/// Distance of the four points from a pixel's middle, in pixels.
///
/// The difference quotient of opposite points has an error from the third derivative. On a plane, one
/// pixel below the horizon, its relative error is 2e-4. Rounding adds 1e-13 where texture coordinates
/// are in the hundreds. A larger value increases the first error; a smaller value increases the second.
const STEP: f64 = 1.0 / 64.0;

/// Offsets of the middle and of the points to the right, left, below and above, in pixels with y down.
const PLACES: [DVec2; 5] = [
    DVec2::ZERO,
    DVec2::new(STEP, 0.0),
    DVec2::new(-STEP, 0.0),
    DVec2::new(0.0, STEP),
    DVec2::new(0.0, -STEP),
];

/// Names of the five points.
const NAMES: [&str; 5] = ["middle", "right", "left", "lower", "upper"];

/// The trees of a pixel's rays, reused for each pixel.
pub(super) type Trees = [IntersectionTree; PLACES.len()];

/// The view through the middle of a pixel.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct PixelView {
    /// The object that is hit first; `None` where the ray leaves the scene.
    pub object: Option<u32>,
    /// Minor axis of the footprint at the first hit, in texels, if the object there is flat and shows a
    /// texture.
    pub flat: Option<f64>,
    /// Fraction of the pixel's weight that comes from textures by mirrors alone, in [0, 1].
    pub mirrored: f64,
    /// Fraction of the weight that comes from textures through surfaces, in [0, 1].
    pub through: f64,
    /// Minor axis of the footprint on the textured surface that more than half of the weight comes
    /// from, in texels.
    pub minor: Option<f64>,
}

/// Finds what the pixels of a scene see.
pub(super) struct PixelTracer<'a> {
    scene: &'a Scene,
    tracer: Tracer<'a>,
    charts: Vec<Charts>,
    size: DVec2,
}

impl<'a> PixelTracer<'a> {
    pub(super) fn new(prepared: &'a Prepared<'_>, (width, height): (u32, u32)) -> Self {
        let scene = prepared.scene();
        let accel = prepared.accel(Structure::default());
        Self {
            scene,
            tracer: Tracer::new(scene, accel, prepared.volumes()),
            charts: scene.objects.iter().map(|object| object.shape.charts()).collect(),
            size: DVec2::new(f64::from(width), f64::from(height)),
        }
    }

    /// Returns what the pixel sees that lies in column `x` and row `y`. The trees are overwritten.
    pub(super) fn view(&self, x: u32, y: u32, trees: &mut Trees) -> PixelView {
        let middle = DVec2::new(f64::from(x), f64::from(y)) + 0.5;
        let mut counts = RayCounts::default();
        for (tree, offset) in trees.iter_mut().zip(PLACES) {
            let ray = self.scene.camera.ray(middle + offset, self.size);
            self.tracer.trace(&ray, tree, &mut counts);
        }
        let five = Five(Bundle::of(trees.each_ref(), 0));
        let mut found = Found::default();
        self.weigh(&five, five.through(), PathKinds::default(), &mut found);
        let first = five.node();
        let flat =
            first.filter(|node| is_flat(&self.scene.objects[node.piece.object as usize].shape));
        let part = |weight: f64| if found.all > 0.0 { weight / found.all } else { 0.0 };
        PixelView {
            object: first.map(|node| node.piece.object),
            flat: flat.and_then(|node| self.minor_axis(&five, node)),
            mirrored: part(found.mirrored),
            through: part(found.through),
            minor: found.minor.filter(|_| part(found.most) > 0.5),
        }
    }

    /// Adds up the weights of a branch and of all branches below it. `weight` is the product of the
    /// factors up to the branch.
    fn weigh(&self, five: &Five<'_>, weight: Color, path: PathKinds, found: &mut Found) {
        let Some(node) = five.node() else {
            if matches!(five.branch(), Branch::Background(_)) {
                found.all += mean(weight);
            }
            return;
        };
        let surface = self.scene.objects[node.piece.object as usize].parts[node.part as usize];
        let own = mean(weight * own_color(self.scene, &self.scene.materials[surface.material]));
        found.all += own;
        if own > 0.0 && surface.picture().is_some() {
            match path {
                PathKinds { refracted: true, .. } => found.through += own,
                PathKinds { reflected: true, .. } => found.mirrored += own,
                PathKinds { .. } => {}
            }
            if own > found.most {
                (found.most, found.minor) = (own, self.minor_axis(five, node));
            }
        }
        if node.reflect_weight != Color::ZERO {
            let path = PathKinds { reflected: true, ..path };
            self.weigh(&five.step(Child::Reflected), weight * node.reflect_weight, path, found);
        }
        if node.refract_weight != Color::ZERO {
            let path = PathKinds { refracted: true, ..path };
            self.weigh(&five.step(Child::Refracted), weight * node.refract_weight, path, found);
        }
    }

    /// Returns the minor axis of a pixel's footprint, in texels: the smaller singular value of the
    /// derivative of texture coordinates with respect to film position. `None` where there is no
    /// texture, or where the derivative cannot be found.
    fn minor_axis(&self, five: &Five<'_>, node: &Node) -> Option<f64> {
        let object = &self.scene.objects[node.piece.object as usize];
        let texture = &self.scene.textures[object.parts[node.part as usize].picture()?];
        let charts = &self.charts[node.piece.object as usize];
        let texels = DVec2::new(texture.width as f64, texture.height as f64);
        let [across, down] = five.derivatives(node, charts)?;
        Some(smaller_singular_value(DMat2::from_cols(texels * across, texels * down)))
    }
}

/// The kinds of rays on the path from the eye so far.
#[derive(Debug, Clone, Copy, Default)]
struct PathKinds {
    reflected: bool,
    refracted: bool,
}

/// Weights of textures, summed over a tree.
#[derive(Debug, Default)]
struct Found {
    /// All weights, with those of surfaces without texture and of the background.
    all: f64,
    /// Weights of textures by mirrors alone.
    mirrored: f64,
    /// Weights of textures through surfaces.
    through: f64,
    /// The largest weight of one textured surface.
    most: f64,
    /// The minor axis of the footprint on that surface, in texels.
    minor: Option<f64>,
}

/// Five trees walked in step; the middle one is shaded.
#[derive(Debug, Clone, Copy)]
struct Five<'t>(Bundle<'t, { PLACES.len() }>);

impl Five<'_> {
    /// Returns the derivatives of the texture coordinates of `node`, the current node, with respect to
    /// film position: per pixel to the right, and per pixel down. `None` where they cannot be found.
    fn derivatives(&self, node: &Node, charts: &Charts) -> Option<[DVec2; 2]> {
        let difference = |k: usize| self.0.difference(k, node, charts);
        // Where one of two opposite rays misses the surface, the other gives a one-sided difference.
        let along = |ahead: usize, back: usize| match (difference(ahead), difference(back)) {
            (Some(ahead), Some(back)) => Some((ahead - back) / (2.0 * STEP)),
            (Some(ahead), None) => Some(ahead / STEP),
            (None, Some(back)) => Some(-back / STEP),
            (None, None) => None,
        };
        Some([along(1, 2)?, along(3, 4)?])
    }
}

impl Sight for Five<'_> {
    fn tree(&self) -> &IntersectionTree {
        self.0.tree()
    }

    fn branch(&self) -> Branch {
        self.0.branch()
    }

    fn step(&self, child: Child) -> Self {
        Self(self.0.step(child))
    }

    /// Returns the parallelogram that the pixel becomes on the texture, to first order.
    fn footprint(&self, node: &Node, charts: &Charts) -> Footprint {
        let Some([across, down]) = self.derivatives(node, charts) else {
            return Footprint::Point(node.uv);
        };
        let corners = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
        Footprint::Quadrilateral(corners.map(|(x, y)| node.uv + x * across + y * down))
    }

    fn point_reason(&self, _: &Node) -> PointReason<'_> {
        self.0.stranger().map_or(PointReason::OtherChart, |(k, branch, node)| {
            PointReason::Stranger { position: NAMES[k], branch, node }
        })
    }
}

/// Returns the weight of a surface's own colour in the scene's ambient light and one white lamp
/// straight above. There are no shadows, since a region should not end where a shadow begins.
fn own_color(scene: &Scene, material: &Material) -> Color {
    material.color * (material.ambient * scene.ambient + material.diffuse)
}

fn mean(color: Color) -> f64 {
    color.element_sum() / 3.0
}

/// Returns whether a shape is made of planes.
fn is_flat(shape: &Shape) -> bool {
    match shape {
        Shape::Quad(_) | Shape::Cuboid(_) => true,
        Shape::Placed(placed) => is_flat(placed.shape()),
        Shape::Sphere(_) | Shape::Mesh(_) | Shape::Superquadric(_) | Shape::Instance(_) => false,
    }
}

/// Returns the smaller singular value of a matrix. A matrix is the sum of a rotation and a mirrored
/// rotation, each with a factor. Its singular values are the sum and the difference of these factors.
fn smaller_singular_value(m: DMat2) -> f64 {
    let turning = DVec2::new(m.x_axis.x + m.y_axis.y, m.x_axis.y - m.y_axis.x).length();
    let mirrored = DVec2::new(m.x_axis.x - m.y_axis.y, m.x_axis.y + m.y_axis.x).length();
    0.5 * (turning - mirrored).abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// The squares of the singular values have the trace and the determinant of the matrix times
        /// its transpose.
        #[test]
        fn the_smaller_singular_value_is_that(columns in prop::array::uniform4(-9.0..9.0f64)) {
            let m = DMat2::from_cols_array(&columns);
            let minor = smaller_singular_value(m);
            let product = m * m.transpose();
            let major = (product.x_axis.x + product.y_axis.y - minor * minor).sqrt();
            prop_assert!(major >= minor);
            prop_assert!((minor * major - m.determinant().abs()).abs() < 1e-9);
        }
    }
}
