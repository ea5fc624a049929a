//! Finds what a pixel sees, along which paths, and how many texels its footprint spans.
//!
//! Five rays are traced for each pixel: through its middle and through four points close by. The tree
//! of the middle ray tells what the pixel sees. Where another ray reaches the same surface by the same
//! path, the difference between the two texture coordinates gives the derivative with respect to film
//! position. This also works behind mirrors and glass.

use glam::{DMat2, DVec2};
use render::Scene;
use render::accel::{Accel, Structure};
use render::color::Color;
use render::scene::Material;
use render::shape::{Charts, Shape};
use render::trace::tree::{Branch, IntersectionTree, Node};
use render::trace::volume::Volumes;
use render::trace::{RayCounts, Tracer};

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

/// The trees of a pixel's rays, reused for each pixel.
pub(super) type Trees = [IntersectionTree; PLACES.len()];

/// What the middle of a pixel sees.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Sight {
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

/// Finds the sights of a scene's pixels.
pub(super) struct Looker<'a> {
    scene: &'a Scene,
    tracer: Tracer<'a>,
    charts: Vec<Charts>,
    size: DVec2,
}

impl<'a> Looker<'a> {
    pub(super) fn new(
        scene: &'a Scene,
        accel: &'a Accel<'a>,
        volumes: &'a Volumes,
        (width, height): (u32, u32),
    ) -> Self {
        Self {
            scene,
            tracer: Tracer::new(scene, accel, volumes),
            charts: scene.objects.iter().map(|object| object.shape.charts()).collect(),
            size: DVec2::new(f64::from(width), f64::from(height)),
        }
    }

    /// Returns the sight of the pixel in column `x` and row `y`. The trees are overwritten.
    pub(super) fn look(&self, x: u32, y: u32, trees: &mut Trees) -> Sight {
        let middle = DVec2::new(f64::from(x), f64::from(y)) + 0.5;
        let mut counts = RayCounts::default();
        for (tree, offset) in trees.iter_mut().zip(PLACES) {
            let ray = self.scene.camera.ray(middle + offset, self.size);
            self.tracer.trace(&ray, tree, &mut counts);
        }
        let five =
            Five { trees: trees.each_ref(), branches: trees.each_ref().map(|tree| tree.root) };
        let mut found = Found::default();
        self.weigh(&five, five.trees[0].through, Way::default(), &mut found);
        let first = five.node();
        let flat =
            first.filter(|node| is_flat(&self.scene.objects[node.piece.object as usize].shape));
        let part = |weight: f64| if found.all > 0.0 { weight / found.all } else { 0.0 };
        Sight {
            object: first.map(|node| node.piece.object),
            flat: flat.and_then(|node| self.minor_axis(&five, node)),
            mirrored: part(found.mirrored),
            through: part(found.through),
            minor: found.minor.filter(|_| part(found.most) > 0.5),
        }
    }

    /// Adds up the weights of a branch and of all branches below it. `weight` is the product of the
    /// factors up to the branch.
    fn weigh(&self, five: &Five<'_>, weight: Color, way: Way, found: &mut Found) {
        let Some(node) = five.node() else {
            if matches!(five.branches[0], Branch::Background(_)) {
                found.all += mean(weight);
            }
            return;
        };
        let surface = self.scene.objects[node.piece.object as usize].parts[node.part as usize];
        let own = mean(weight * own_color(self.scene, &self.scene.materials[surface.material]));
        found.all += own;
        if own > 0.0 && surface.picture().is_some() {
            match way {
                Way { refracted: true, .. } => found.through += own,
                Way { reflected: true, .. } => found.mirrored += own,
                Way { .. } => {}
            }
            if own > found.most {
                (found.most, found.minor) = (own, self.minor_axis(five, node));
            }
        }
        if node.reflect_weight != Color::ZERO {
            let way = Way { reflected: true, ..way };
            self.weigh(&five.step(|node| node.reflected), weight * node.reflect_weight, way, found);
        }
        if node.refract_weight != Color::ZERO {
            let way = Way { refracted: true, ..way };
            self.weigh(&five.step(|node| node.refracted), weight * node.refract_weight, way, found);
        }
    }

    /// Returns the minor axis of a pixel's footprint, in texels: the smaller singular value of the
    /// derivative of texture coordinates with respect to film position. `None` where there is no
    /// texture, or where the derivative cannot be found.
    fn minor_axis(&self, five: &Five<'_>, node: &Node) -> Option<f64> {
        let object = &self.scene.objects[node.piece.object as usize];
        let texture = &self.scene.textures[object.parts[node.part as usize].picture()?];
        let charts = &self.charts[node.piece.object as usize];
        let way = |k: usize| {
            let to = five.agreeing(k, node)?;
            charts.difference((node.piece.triangle, node.uv), (to.piece.triangle, to.uv))
        };
        // Where one of two opposite rays misses the surface, the other gives a one-sided difference.
        let along = |ahead: usize, back: usize| match (way(ahead), way(back)) {
            (Some(ahead), Some(back)) => Some((ahead - back) / (2.0 * STEP)),
            (Some(ahead), None) => Some(ahead / STEP),
            (None, Some(back)) => Some(-back / STEP),
            (None, None) => None,
        };
        let texels = DVec2::new(texture.width as f64, texture.height as f64);
        Some(smaller_singular_value(DMat2::from_cols(texels * along(1, 2)?, texels * along(3, 4)?)))
    }
}

/// The kinds of rays on the path from the eye so far.
#[derive(Debug, Clone, Copy, Default)]
struct Way {
    reflected: bool,
    refracted: bool,
}

/// Weights of textures, summed over a tree. `all` includes surfaces without texture and the background.
#[derive(Debug, Default)]
struct Found {
    all: f64,
    mirrored: f64,
    through: f64,
    /// The largest weight of one textured surface, and in `minor` the minor axis there, in texels.
    most: f64,
    minor: Option<f64>,
}

/// Five trees walked in step. `branches` holds the current branch of each tree, on the same path in all
/// of them.
struct Five<'t> {
    trees: [&'t IntersectionTree; PLACES.len()],
    branches: [Branch; PLACES.len()],
}

impl<'t> Five<'t> {
    /// Returns the node of the middle tree, if its branch ends in a node.
    fn node(&self) -> Option<&'t Node> {
        self.trees[0].node(self.branches[0])
    }

    /// Returns the node of tree `k`, if it lies on the same textured area as the middle tree's node.
    fn agreeing(&self, k: usize, node: &Node) -> Option<&'t Node> {
        self.trees[k].node(self.branches[k]).filter(|other| other.area() == node.area())
    }

    /// Moves one step down all trees. Trees on another path than the middle one are cut off.
    fn step(&self, child: impl Fn(&Node) -> Branch) -> Self {
        let branches = std::array::from_fn(|k| {
            let node = self.node().and_then(|node| self.agreeing(k, node));
            node.map_or(Branch::Cut, &child)
        });
        Self { branches, ..*self }
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
        Shape::Sphere(_) | Shape::Mesh(_) | Shape::Superquadric(_) => false,
    }
}

/// Returns the smaller singular value of a matrix. A matrix is the sum of a rotation and a mirrored
/// rotation, each with a factor. Its singular values are the sum and the difference of these factors.
fn smaller_singular_value(m: DMat2) -> f64 {
    let turning = DVec2::new(m.x_axis.x + m.y_axis.y, m.x_axis.y - m.y_axis.x).length();
    let mirrored = DVec2::new(m.x_axis.x - m.y_axis.y, m.x_axis.y + m.y_axis.x).length();
    0.5 * (turning - mirrored).abs()
}

/// Builds the structure that finds the hits of a scene's rays.
pub(super) fn accel_of(scene: &Scene) -> Accel<'_> {
    let shapes = scene.objects.iter().map(|object| &object.shape).collect();
    Accel::build(shapes, Structure::default())
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
