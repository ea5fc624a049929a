//! Turns intersection trees into colours (thesis fig. 4.5).
//!
//! A node's colour is its local colour plus what its reflected and refracted branches bring, each
//! with its weight; so the deepest nodes come first and their colours are handed up. The thesis's
//! figure weighs refraction with the reflectivity; here it is weighed with the transparency.

mod shadow;

use crate::accel::Accel;
use crate::color::Color;
use crate::filter::FilteredTexture;
use crate::footprint::Footprint;
use crate::footprint::neighbours::Neighbourhood;
use crate::optics;
use crate::scene::{Material, Scene};
use crate::shape::{SeamPeriod, Shape};
use crate::trace::medium::Media;
use crate::trace::tree::{Branch, Node};
use crate::trace::volume::Volumes;

/// Shades the trees of one scene.
#[derive(Debug)]
pub struct Shader<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// What finds the hits of shadow rays.
    pub accel: &'a Accel<'a>,
    /// The scene's textures, ready; those that are never seen are missing.
    pub textures: Vec<Option<FilteredTexture<'a>>>,
    /// The seam of each object's texture coordinates.
    pub seams: Vec<SeamPeriod>,
    /// The scene's volumes.
    pub volumes: &'a Volumes,
    /// The volumes that each light lies in.
    pub around_lights: Vec<Media>,
}

/// How much work shading was.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ShadeCounts {
    /// Rays to lights.
    pub shadow: u64,
    /// Textures averaged over an area.
    pub areas: u64,
    /// Textures looked up at a point.
    pub points: u64,
    /// Texels or table entries read for both.
    pub texels: u64,
}

impl Shader<'_> {
    /// How many tables were built.
    #[must_use]
    pub fn tables(&self) -> u64 {
        self.textures.iter().flatten().filter(|texture| texture.table_bytes() > 0).count() as u64
    }

    /// Memory of all tables, in bytes.
    #[must_use]
    pub fn table_bytes(&self) -> u64 {
        self.textures.iter().flatten().map(|texture| texture.table_bytes() as u64).sum()
    }

    /// The colour that comes to the eye.
    #[must_use]
    pub fn shade(&self, around: &Neighbourhood<'_>, counts: &mut ShadeCounts) -> Color {
        around.through() * self.branch(around, counts)
    }

    /// The colour that the middle branch starts with.
    fn branch(&self, around: &Neighbourhood<'_>, counts: &mut ShadeCounts) -> Color {
        let node = match (around.middle(), around.node()) {
            (Branch::Background, _) => return self.scene.background,
            (_, None) => return Color::ZERO,
            (_, Some(node)) => node,
        };
        let mut color = self.local(node, around, counts);
        if node.reflect_weight != Color::ZERO {
            let reflected = around.step(|node| node.reflected);
            color += node.reflect_weight * self.branch(&reflected, counts);
        }
        if node.refract_weight != Color::ZERO {
            let refracted = around.step(|node| node.refracted);
            color += node.refract_weight * self.branch(&refracted, counts);
        }
        color
    }

    /// The colour of the surface itself under ambient light and the lights that reach it.
    fn local(&self, node: &Node, around: &Neighbourhood<'_>, counts: &mut ShadeCounts) -> Color {
        let surface = self.scene.objects[node.piece.object as usize].parts[node.part as usize];
        let material = &self.scene.materials[surface.material];
        let Lighting { diffuse, highlight } = self.lighting(node, material, counts);
        let mut color = highlight;
        if material.shows_color() {
            let texture = surface.texture.and_then(|index| self.textures[index].as_ref());
            let textured = texture.map_or(Color::ONE, |texture| {
                let footprint = around.footprint(node, self.seams[node.piece.object as usize]);
                counts.texels += texture.reads();
                match footprint {
                    Footprint::Point(_) => counts.points += 1,
                    Footprint::Rectangle { .. } => counts.areas += 1,
                }
                let object = &self.scene.objects[node.piece.object as usize];
                match object.shape {
                    Shape::Sphere(_) => texture.average(&texture.between_poles(footprint)),
                    Shape::Quad(_) | Shape::Mesh(_) => texture.average(&footprint),
                }
            });
            color += material.color * textured * (material.ambient * self.scene.ambient + diffuse);
        }
        color
    }

    /// What the lights bring to a node.
    fn lighting(&self, node: &Node, material: &Material, counts: &mut ShadeCounts) -> Lighting {
        let mut sum = Lighting { diffuse: Color::ZERO, highlight: Color::ZERO };
        if !material.sees_lights() {
            return sum;
        }
        let mirrored = optics::reflect(node.incident, node.normal);
        for (light, around_light) in self.scene.lights.iter().zip(&self.around_lights) {
            let toward = light.toward(node.position);
            let cosine = node.normal.dot(toward);
            if cosine <= 0.0 || node.geometric_normal.dot(toward) <= 0.0 {
                continue;
            }
            counts.shadow += 1;
            let reaching = self.transmission(node, light, around_light);
            let light = reaching * light.arriving(node.position) * material.tint(cosine);
            sum.diffuse += material.diffuse * cosine * light;
            if material.specular > 0.0 {
                let phong = mirrored.dot(toward).max(0.0).powf(material.shininess);
                sum.highlight += material.specular * phong * light;
            }
        }
        sum
    }
}

/// Light on a surface: what its colour multiplies, and the highlight, which it does not.
#[derive(Debug, Clone, Copy)]
struct Lighting {
    diffuse: Color,
    highlight: Color,
}
