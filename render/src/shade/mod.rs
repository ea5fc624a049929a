//! Turns intersection trees into colours (thesis fig. 4.5).
//!
//! The colour of a node is its local colour plus the weighted colours of its reflected and
//! refracted branches. The deepest nodes are therefore shaded first, and their colours are returned
//! to their parents. The thesis's figure weights refraction with the reflectivity; this module
//! weights it with the transparency.

mod background;
mod lobe;
mod masks;
pub mod observer;
mod shadow;
mod start;

use crate::accel::Accel;
use crate::color::Color;
use crate::differential::Spread;
use crate::filter::FilteredTexture;
use crate::footprint::{Footprint, Sight};
use crate::optics;
use crate::scene::{Material, Scene};
use crate::shape::Charts;
use crate::trace::medium::Media;
use crate::trace::tree::{Child, Node};
use crate::trace::volume::Volumes;
use glam::DVec3;
use lobe::Lobe;
use observer::{Local, Observer, Seen, Textured};
pub use shadow::{Facing, Shadows};
pub use start::ShadowStart;

/// Shades the trees of one scene.
#[derive(Debug)]
pub struct Shader<'a> {
    /// The scene whose trees are shaded.
    pub scene: &'a Scene,
    /// Structure that finds the hits of shadow rays.
    pub accel: &'a Accel<'a>,
    /// The scene's textures prepared for filtering, by texture index. A texture that no surface
    /// shows is `None`.
    pub textures: &'a [Option<FilteredTexture<'a>>],
    /// Texture coordinate charts of each object, by object index. They are empty unless
    /// [`Shader::wants_area`].
    pub charts: &'a [Charts],
    /// True if footprints are areas: the filter averages over areas, and a surface shows a texture.
    /// Otherwise a sampling method needs no rays near those that are shaded.
    pub wants_area: bool,
    /// The scene's closed volumes, which bend and absorb light.
    pub volumes: &'a Volumes,
    /// The volumes that contain each light, in the order of the scene's lights.
    pub around_lights: &'a [Media],
    /// True if some picture cuts out surfaces.
    pub has_masks: bool,
    /// The part of the light that is wanted.
    pub view: View,
}

/// The part of a picture that is shaded.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum View {
    /// The scene before its background.
    #[default]
    Whole,
    /// The scene without the background behind it. Surfaces mirror the background all the same.
    Foreground,
    /// The part of the background that shows, per channel, [0, 1]; what covers it is black. It shows
    /// beside surfaces, through refracting ones and through masks, but not in mirrors.
    ///
    /// Observers see what they see of the foreground: both views divide their pixels alike, so that
    /// colour and coverage belong together.
    Coverage,
}

/// Counts of the operations that shading performs.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ShadeCounts {
    /// Shadow rays sent to lights.
    pub shadow: u64,
    /// Texture averages over an area.
    pub areas: u64,
    /// Texture lookups at a point.
    pub points: u64,
    /// Texels or table entries read for averages and lookups together.
    pub texels: u64,
    /// Lookups of solid textures.
    pub solids: u64,
}

/// Counts of shading, and memory that it uses again for each ray.
#[derive(Debug, Default)]
pub struct ShadeWork {
    /// Counts of the operations so far.
    pub counts: ShadeCounts,
    shadows: Shadows,
}

impl Shader<'_> {
    /// Returns the memory of all filter tables, in bytes.
    #[must_use]
    pub fn table_bytes(&self) -> u64 {
        self.textures.iter().flatten().map(|texture| texture.table_bytes() as u64).sum()
    }

    /// Returns the linear RGB light that reaches the eye along the tree of `sight`, which stands at
    /// the root. Reports every shaded branch to `observer`.
    #[must_use]
    pub fn shade<S: Sight, O: Observer>(
        &self,
        sight: &S,
        work: &mut ShadeWork,
        observer: &mut O,
    ) -> Color {
        sight.through() * self.branch(sight, true, work, observer)
    }

    /// Returns the colour at the start of the current branch. Reports the branch and its
    /// descendants to `observer`. `through` is true if light came here through surfaces alone, and was
    /// not mirrored by any from outside.
    fn branch<S: Sight, O: Observer>(
        &self,
        sight: &S,
        through: bool,
        work: &mut ShadeWork,
        observer: &mut O,
    ) -> Color {
        let (local, color) = match sight.node() {
            None => {
                let away = sight.away();
                let seen = away.map(|away| self.background(away, through));
                let [color, reported] = seen.unwrap_or_default();
                observer.leave(&Seen { sight, local: None, color: reported });
                return color;
            }
            Some(node) => {
                let local = self.local(node, sight, work);
                let covers = self.view == View::Coverage;
                let mut color = if covers { Color::ZERO } else { local.color };
                let c = local.coverage;
                let reflect_weight = c * node.reflect_weight;
                if reflect_weight != Color::ZERO {
                    observer.follow(node, Child::Reflected, reflect_weight);
                    let reflected = sight.step(Child::Reflected);
                    let through = through && node.inside;
                    color += reflect_weight * self.branch(&reflected, through, work, observer);
                }
                let refract_weight = c * node.refract_weight + (1.0 - c) * node.pass_weight;
                if refract_weight != Color::ZERO {
                    observer.follow(node, Child::Refracted, refract_weight);
                    let refracted = sight.step(Child::Refracted);
                    color += refract_weight * self.branch(&refracted, through, work, observer);
                }
                (Some(local), color)
            }
        };
        observer.leave(&Seen { sight, local, color });
        color
    }

    /// Moves a sight behind the cut-outs that cover less than half of its footprint.
    #[must_use]
    pub fn behind_cutouts<S: Sight>(&self, mut sight: S) -> S {
        while let Some(node) = sight.node()
            && node.pass_weight != Color::ZERO
        {
            let object = &self.scene.objects[node.piece.object as usize];
            let picture = object.parts[node.part as usize].picture();
            let Some(texture) = picture.and_then(|index| self.textures[index].as_ref()) else {
                break;
            };
            if texture.coverage(&self.footprints(node, &sight, texture)[1]) >= 0.5 {
                break;
            }
            sight = sight.step(Child::Refracted);
        }
        sight
    }

    /// Returns the footprint of a node on its texture, and the part of it that the filter averages.
    fn footprints<S: Sight>(
        &self,
        node: &Node,
        sight: &S,
        texture: &FilteredTexture<'_>,
    ) -> [Footprint; 2] {
        let footprint = sight.footprint(node, &self.charts[node.piece.object as usize]);
        let has_poles = self.scene.objects[node.piece.object as usize].shape.has_poles();
        [footprint, if has_poles { texture.between_poles(footprint) } else { footprint }]
    }

    /// Computes the colour of the surface itself under ambient light and the lights that reach it.
    fn local<S: Sight>(&self, node: &Node, sight: &S, work: &mut ShadeWork) -> Local {
        let object = &self.scene.objects[node.piece.object as usize];
        let surface = object.parts[node.part as usize];
        let material = &self.scene.materials[surface.material];
        let texture = surface.picture().and_then(|index| self.textures[index].as_ref());
        // A surface is opaque where its ray was not followed beyond.
        let cut = texture.filter(|_| node.pass_weight != Color::ZERO);
        let coverage =
            cut.map_or(1.0, |texture| texture.coverage(&self.footprints(node, sight, texture)[1]));
        if coverage == 0.0 {
            return Local { textured: None, color: Color::ZERO, plain: Color::ZERO, coverage };
        }
        let variance = sight.spread().map_or(0.0, Spread::normal_variance);
        let Lighting { diffuse, highlight } = self.lighting(node, sight, variance, material, work);
        let counts = &mut work.counts;
        let mut color = coverage * (highlight + material.emission);
        let mut plain = color;
        let mut textured = None;
        if material.shows_color() {
            textured = texture.map(|texture| {
                let [footprint, averaged] = self.footprints(node, sight, texture);
                counts.texels += texture.reads();
                let count =
                    if footprint.is_point() { &mut counts.points } else { &mut counts.areas };
                *count += 1;
                // Only a method with spreads compares samples.
                let (average, contrast) = if sight.spread().is_some() {
                    texture.average_and_contrast(&averaged)
                } else {
                    (texture.average(&averaged), 0.0)
                };
                Textured { footprint, average, contrast }
            });
            // The average of a picture with a mask contains its coverage.
            let texture = textured.map_or(Color::ONE, |textured| textured.average);
            let carved = surface.solid().map_or(Color::ONE, |index| {
                counts.solids += 1;
                let solid = &self.scene.procedural.solids[index];
                match sight.spread() {
                    Some(spread) => {
                        solid.average(&object.to_own_space, sight.middle(node), spread.position)
                    }
                    None => solid.color(&object.to_own_space, node.position),
                }
            });
            let shows = material.vertex_colors.show(surface.texture.is_some());
            let by_vertex = if shows { self.vertex_color(node, sight) } else { Color::ONE };
            let own = material.color * by_vertex;
            let light = material.ambient * self.scene.ambient + diffuse;
            color += own * texture * carved * light;
            plain += coverage * own * light;
        }
        Local { textured, color, plain, coverage }
    }

    /// Returns the colour of a mesh's vertices in the middle of the part of the surface that is seen, or
    /// white. Colours are linear on each triangle, so that the middle has their average.
    fn vertex_color<S: Sight>(&self, node: &Node, sight: &S) -> Color {
        let shape = &self.scene.objects[node.piece.object as usize].shape;
        shape.vertex_color(node.piece.triangle, sight.middle(node)).unwrap_or(Color::ONE)
    }

    /// Sums the light that the scene's lights send to a node. `variance` is that of its normal along
    /// each tangent.
    fn lighting<S: Sight>(
        &self,
        node: &Node,
        sight: &S,
        variance: f64,
        material: &Material,
        work: &mut ShadeWork,
    ) -> Lighting {
        let mut sum = Lighting { diffuse: Color::ZERO, highlight: Color::ZERO };
        if !material.sees_lights() || self.scene.lights.is_empty() {
            return sum;
        }
        let ShadeWork { counts, shadows } = work;
        shadows.clear();
        let start = ShadowStart::of(self.scene, node, sight.spread());
        for (index, light) in self.scene.lights.iter().enumerate() {
            let toward = light.toward(node.position);
            let cosine = node.normal.dot(toward);
            if cosine > 0.0 && start.normal.dot(toward) > 0.0 {
                counts.shadow += 1;
                shadows.add(self.scene, &start, Facing { light: index, toward, cosine });
            }
        }
        self.trace_shadows(shadows);
        let shiny = material.specular > 0.0;
        let lobe = Lobe::over(material.shininess, variance, node.incident.dot(node.normal));
        let mirrored =
            if shiny { optics::reflect(node.incident, node.normal) } else { DVec3::ZERO };
        for (&Facing { light, toward, cosine }, reaching) in shadows.results() {
            if reaching == Color::ZERO {
                continue;
            }
            let light = self.scene.lights[light].arriving(node.position);
            let light = reaching * light * material.tint(cosine);
            sum.diffuse += material.diffuse * cosine * light;
            if shiny {
                let phong = mirrored.dot(toward).max(0.0).powf(lobe.exponent);
                sum.highlight += material.specular * lobe.strength * phong * light;
            }
        }
        sum
    }
}

/// Light on a surface. `diffuse` is multiplied by the surface's colour and `highlight` is not.
#[derive(Debug, Clone, Copy)]
struct Lighting {
    diffuse: Color,
    highlight: Color,
}
