//! What a pixel sees, by what ways, and how much of a texture lies in it.
//!
//! Five rays are followed for each pixel: through its middle, and through four places close by. The tree
//! of the middle one says what is seen; the way from its texture coordinates to those of the others,
//! where they came to the same surface by the same path, is the derivative of the texture coordinates
//! on the film, also behind mirrors and glass.

use glam::{DMat2, DVec2};
use render::Scene;
use render::accel::{Accel, Structure};
use render::color::Color;
use render::scene::Material;
use render::shape::{Charts, Shape};
use render::trace::tree::{Branch, IntersectionTree, Node};
use render::trace::volume::Volumes;
use render::trace::{RayCounts, Tracer};

/// How far the places close by are from a pixel's middle, in pixels.
///
/// The difference of two of them is a derivative but for the third one, which on a plane is 2e-4 of it
/// one pixel below the horizon; it loses 1e-13 to rounding where coordinates count in hundreds.
const STEP: f64 = 1.0 / 64.0;

/// The middle, right, left, below and above.
const PLACES: [DVec2; 5] = [
    DVec2::ZERO,
    DVec2::new(STEP, 0.0),
    DVec2::new(-STEP, 0.0),
    DVec2::new(0.0, STEP),
    DVec2::new(0.0, -STEP),
];

/// The trees of a pixel's rays, to be filled again for each.
pub(super) type Trees = [IntersectionTree; PLACES.len()];

/// What a pixel's middle sees.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Sight {
    /// The object that is hit first; nothing where the ray leaves the scene.
    pub object: Option<u32>,
    /// The minor axis of the footprint on what is hit first, in texels, if that is flat and shows a
    /// picture.
    pub flat: Option<f64>,
    /// The part of the pixel's weight that comes from pictures by mirrors alone.
    pub mirrored: f64,
    /// The part that comes from pictures through surfaces.
    pub through: f64,
    /// The minor axis of the footprint on the picture that more than half of the weight comes from, in
    /// texels.
    pub minor: Option<f64>,
}

/// Looks at the pixels of a scene.
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

    /// What the pixel in this column and row sees.
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

    /// Adds up what comes along a branch that counts for `weight`.
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

    /// The minor axis of the footprint of a pixel, in texels: the smaller singular value of the
    /// derivative of texture coordinates on the film. Nothing where there is no picture, or its
    /// coordinates have no derivative.
    fn minor_axis(&self, five: &Five<'_>, node: &Node) -> Option<f64> {
        let object = &self.scene.objects[node.piece.object as usize];
        let texture = &self.scene.textures[object.parts[node.part as usize].picture()?];
        let charts = &self.charts[node.piece.object as usize];
        let way = |k: usize| {
            let to = five.agreeing(k, node)?;
            charts.difference((node.piece.triangle, node.uv), (to.piece.triangle, to.uv))
        };
        // Where one side has come to something else, the other one tells as well.
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

/// How light came to the eye, so far.
#[derive(Debug, Clone, Copy, Default)]
struct Way {
    reflected: bool,
    refracted: bool,
}

/// Weights, summed over a tree.
#[derive(Debug, Default)]
struct Found {
    all: f64,
    mirrored: f64,
    through: f64,
    /// The largest weight of a picture, and the minor axis there.
    most: f64,
    minor: Option<f64>,
}

/// Five trees walked in step: for each, the branch of it that corresponds to the middle one's.
struct Five<'t> {
    trees: [&'t IntersectionTree; PLACES.len()],
    branches: [Branch; PLACES.len()],
}

impl<'t> Five<'t> {
    /// The middle tree's node, if its branch came to one.
    fn node(&self) -> Option<&'t Node> {
        self.trees[0].node(self.branches[0])
    }

    /// The node of a tree, if it came to the same textured area as the middle one's.
    fn agreeing(&self, k: usize, node: &Node) -> Option<&'t Node> {
        self.trees[k].node(self.branches[k]).filter(|other| other.area() == node.area())
    }

    /// One step along all trees; those on another path are left behind.
    fn step(&self, child: impl Fn(&Node) -> Branch) -> Self {
        let branches = std::array::from_fn(|k| {
            let node = self.node().and_then(|node| self.agreeing(k, node));
            node.map_or(Branch::Cut, &child)
        });
        Self { branches, ..*self }
    }
}

/// What a surface's own colour counts for, in the scene's ambient light and one lamp of white light
/// straight above: no shadows, since a region should not end where one begins.
fn own_color(scene: &Scene, material: &Material) -> Color {
    material.color * (material.ambient * scene.ambient + material.diffuse)
}

fn mean(color: Color) -> f64 {
    color.element_sum() / 3.0
}

/// Whether a shape is made of planes.
fn is_flat(shape: &Shape) -> bool {
    match shape {
        Shape::Quad(_) | Shape::Cuboid(_) => true,
        Shape::Placed(placed) => is_flat(placed.shape()),
        Shape::Sphere(_) | Shape::Mesh(_) | Shape::Superquadric(_) => false,
    }
}

/// A matrix is the sum of a turning and a mirrored turning, each with a factor; its singular values are
/// the factors' sum and difference.
fn smaller_singular_value(m: DMat2) -> f64 {
    let turning = DVec2::new(m.x_axis.x + m.y_axis.y, m.x_axis.y - m.y_axis.x).length();
    let mirrored = DVec2::new(m.x_axis.x - m.y_axis.y, m.x_axis.y + m.y_axis.x).length();
    0.5 * (turning - mirrored).abs()
}

/// What finds the hits of a scene's rays.
pub(super) fn accel_of(scene: &Scene) -> Accel<'_> {
    let shapes = scene.objects.iter().map(|object| &object.shape).collect();
    Accel::build(shapes, Structure::default())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// The squares of singular values have the trace and the determinant of the matrix times its
        /// transpose.
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
