//! The parts of a sample's colour, for the comparison of neighbouring samples.

use crate::color::Color;
use crate::footprint::Sight;
use crate::shade::Shader;
use crate::shade::observer::{Observer, Seen};
use crate::trace::tree::{Branch, Child, Node};
use glam::DVec2;

/// Light that a sample receives from one surface, or from the background, along one path.
#[derive(Debug, Clone, Copy, Default)]
pub struct Leaf {
    /// Hash of the path: the textured areas on it, in order, and whether each was left by
    /// reflection or refraction. Samples with equal keys see the same surface along the same path.
    pub key: u64,
    /// The light, linear RGB, as a part of the sample's colour.
    pub value: [f32; 3],
    /// The light if the surface had a white texture.
    pub plain: [f32; 3],
    /// The part of `value` that may change where the footprint moves on its texture, as the root
    /// mean square of the channels; 0 without a picture.
    pub contrast: f32,
    /// The place on a picture, if the surface shows one.
    pub place: Option<Place>,
}

/// A footprint on a picture.
#[derive(Debug, Clone, Copy)]
pub struct Place {
    /// Index of the object.
    pub object: u32,
    /// Triangle or face, which selects the chart of the texture coordinates.
    pub triangle: u32,
    /// Texture coordinates of the ray's hit.
    pub uv: DVec2,
    /// Change of the texture coordinates across and down the cell.
    pub sides: [DVec2; 2],
    /// Size of the picture, in texels.
    pub texels: DVec2,
}

/// Records the leaves of a sample while it is shaded.
pub struct Recorder<'a> {
    shader: &'a Shader<'a>,
    leaves: &'a mut Vec<Leaf>,
    /// Key and weight of each open branch, from the root on.
    open: &'a mut Vec<(u64, Color)>,
}

/// Key of the root of all paths.
const ROOT: u64 = 0x9e37_79b9_7f4a_7c15;

/// Key of the background, which is no object.
const BACKGROUND: u64 = u64::MAX;

impl<'a> Recorder<'a> {
    /// Starts at the root of a sample's tree. `through` is the transmittance up to the root. The
    /// leaves are appended to `leaves`; `open` is memory for the work.
    pub fn new(
        shader: &'a Shader<'a>,
        through: Color,
        leaves: &'a mut Vec<Leaf>,
        open: &'a mut Vec<(u64, Color)>,
    ) -> Self {
        open.clear();
        open.push((ROOT, through));
        Self { shader, leaves, open }
    }
}

impl Observer for Recorder<'_> {
    fn follow(&mut self, node: &Node, child: Child, share: Color) {
        let Some(&(key, weight)) = self.open.last() else { return };
        let turn = match child {
            Child::Reflected => 1,
            Child::Refracted => 2,
        };
        self.open.push((mixed(mixed(key, area(node)), turn), weight * share));
    }

    fn leave<S: Sight>(&mut self, seen: &Seen<'_, S>) {
        let Some((key, weight)) = self.open.pop() else { return };
        let single = |color: Color| color.to_array().map(|light| light as f32);
        let leaf = match (seen.sight.node(), seen.local) {
            (Some(node), Some(local)) => {
                let plain = single(weight * local.plain);
                let picture = local.textured.zip(seen.sight.spread());
                let place = picture.map(|(textured, spread)| {
                    let part = self.shader.scene.objects[node.piece.object as usize].parts
                        [node.part as usize];
                    let texture = part.picture().map(|index| &self.shader.scene.textures[index]);
                    let texels = texture.map_or(DVec2::ONE, |texture| {
                        DVec2::new(texture.width as f64, texture.height as f64)
                    });
                    let Node { piece, uv, .. } = *node;
                    let place = Place {
                        object: piece.object,
                        triangle: piece.triangle,
                        uv,
                        sides: spread.uv,
                        texels,
                    };
                    (textured.contrast as f32 * size(plain), place)
                });
                Leaf {
                    key: mixed(key, area(node)),
                    value: single(weight * local.color),
                    plain,
                    contrast: place.map_or(0.0, |(contrast, _)| contrast),
                    place: place.map(|(_, place)| place),
                }
            }
            (None, _) | (_, None) => {
                // Nothing changes along the background but its own colours.
                let away = matches!(seen.sight.branch(), Branch::Background(_));
                let value = single(weight * seen.color);
                let key = if away { mixed(key, BACKGROUND) } else { key };
                Leaf { key, value, plain: value, contrast: 0.0, place: None }
            }
        };
        if leaf.plain != [0.0; 3] || leaf.value != [0.0; 3] {
            self.leaves.push(leaf);
        }
    }
}

/// Root mean square of three channels.
#[must_use]
pub fn size(color: [f32; 3]) -> f32 {
    let [r, g, b] = color;
    ((r * r + g * g + b * b) * (1.0 / 3.0)).sqrt()
}

/// The number of a textured area, unique in its scene.
fn area(node: &Node) -> u64 {
    let (object, part) = node.area();
    u64::from(object) << 32 | u64::from(part)
}

/// Mixes a number into a key (the finalizer of `SplitMix64`; G. Steele et al., "Fast Splittable
/// Pseudorandom Number Generators", 2014).
fn mixed(key: u64, number: u64) -> u64 {
    let mut z = key ^ number.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(key << 6);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
