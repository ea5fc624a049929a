//! Turns intersection trees into colours (thesis fig. 4.5).
//!
//! A node's colour is its local colour plus what its reflected and refracted branches bring, each
//! with its weight; so the deepest nodes come first and their colours are handed up. The thesis's
//! figure weighs refraction with the reflectivity; here it is weighed with the transparency.

pub mod observer;
mod shadow;

use crate::accel::Accel;
use crate::color::Color;
use crate::filter::FilteredTexture;
use crate::footprint::Footprint;
use crate::footprint::neighbours::Neighbourhood;
use crate::optics;
use crate::scene::{Material, Scene};
use crate::shape::Charts;
use crate::trace::medium::Media;
use crate::trace::tree::Node;
use crate::trace::volume::Volumes;
use observer::{Local, Observer, Seen, Textured, Way};

/// Shades the trees of one scene.
#[derive(Debug)]
pub struct Shader<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// What finds the hits of shadow rays.
    pub accel: &'a Accel<'a>,
    /// The scene's textures, ready; those that are never seen are missing.
    pub textures: &'a [Option<FilteredTexture<'a>>],
    /// How each object's texture coordinates hang together; not known if the filter looks at points only.
    pub charts: &'a [Charts],
    /// The scene's volumes.
    pub volumes: &'a Volumes,
    /// The volumes that each light lies in.
    pub around_lights: &'a [Media],
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
    /// Solid textures looked up.
    pub solids: u64,
}

impl Shader<'_> {
    /// Memory of all tables, in bytes.
    #[must_use]
    pub fn table_bytes(&self) -> u64 {
        self.textures.iter().flatten().map(|texture| texture.table_bytes() as u64).sum()
    }

    /// The colour that comes to the eye; `observer` is told of all branches that lead to it.
    #[must_use]
    pub fn shade<O: Observer>(
        &self,
        around: &Neighbourhood<'_>,
        counts: &mut ShadeCounts,
        observer: &mut O,
    ) -> Color {
        around.through() * self.branch(around, counts, observer)
    }

    /// The colour that the middle branch starts with; `observer` is told of all that follow.
    fn branch<O: Observer>(
        &self,
        around: &Neighbourhood<'_>,
        counts: &mut ShadeCounts,
        observer: &mut O,
    ) -> Color {
        let (local, color) = match around.node() {
            None => {
                let background = |toward| self.scene.background.toward(toward);
                (None, around.away().map_or(Color::ZERO, background))
            }
            Some(node) => {
                let local = self.local(node, around, counts);
                let mut color = local.color;
                if node.reflect_weight != Color::ZERO {
                    observer.follow(Way::Reflected);
                    let reflected = around.step(|node| node.reflected);
                    color += node.reflect_weight * self.branch(&reflected, counts, observer);
                }
                if node.refract_weight != Color::ZERO {
                    observer.follow(Way::Refracted);
                    let refracted = around.step(|node| node.refracted);
                    color += node.refract_weight * self.branch(&refracted, counts, observer);
                }
                (Some(local), color)
            }
        };
        observer.leave(&Seen { around, local, color });
        color
    }

    /// The colour of the surface itself under ambient light and the lights that reach it.
    fn local(&self, node: &Node, around: &Neighbourhood<'_>, counts: &mut ShadeCounts) -> Local {
        let object = &self.scene.objects[node.piece.object as usize];
        let surface = object.parts[node.part as usize];
        let material = &self.scene.materials[surface.material];
        let Lighting { diffuse, highlight } = self.lighting(node, material, counts);
        let mut color = highlight;
        let mut textured = None;
        if material.shows_color() {
            let texture = surface.picture().and_then(|index| self.textures[index].as_ref());
            textured = texture.map(|texture| {
                let footprint = around.footprint(node, &self.charts[node.piece.object as usize]);
                counts.texels += texture.reads();
                match footprint {
                    Footprint::Point(_) => counts.points += 1,
                    Footprint::Rectangle { .. } => counts.areas += 1,
                }
                let average = if object.shape.has_poles() {
                    texture.average(&texture.between_poles(footprint))
                } else {
                    texture.average(&footprint)
                };
                Textured { footprint, average }
            });
            let texture = textured.map_or(Color::ONE, |textured| textured.average);
            let carved = surface.solid().map_or(Color::ONE, |index| {
                counts.solids += 1;
                let solid = &self.scene.procedural.solids[index];
                solid.color(&object.to_own_space, node.position)
            });
            color += material.color
                * texture
                * carved
                * (material.ambient * self.scene.ambient + diffuse);
        }
        Local { textured, color }
    }

    /// What the lights bring to a node.
    fn lighting(&self, node: &Node, material: &Material, counts: &mut ShadeCounts) -> Lighting {
        let mut sum = Lighting { diffuse: Color::ZERO, highlight: Color::ZERO };
        if !material.sees_lights() {
            return sum;
        }
        let mirrored = optics::reflect(node.incident, node.normal);
        for (light, around_light) in self.scene.lights.iter().zip(self.around_lights) {
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
