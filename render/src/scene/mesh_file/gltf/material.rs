//! The materials of a glTF file, as those of a material library.
//!
//! The base colour is the colour of a matt surface. An alpha below 1 counts where the material blends or has
//! a mask. The alpha of a picture cuts out the surface: in proportion where it blends, and wholly below the
//! `alphaCutoff` of a mask. Emitted light is taken if no picture divides it. A normal texture becomes a bump if it
//! is laid as the base colour is, or if there is no picture of the base colour.

use super::accessor::Numbers;
use super::{Fault, uri};
use crate::color::Color;
use crate::scene::VertexColors;
use crate::scene::limits::LARGEST;
use crate::scene::mtl::{Entry, Map, ReliefColors, ReliefMap, plain};
use crate::texture::{Alpha, Wrap};
use glam::{DVec2, dvec2};
use gltf::json::Value;
use gltf::material::AlphaMode;
use gltf::texture::{Texture, WrappingMode};
use gltf::{Document, Material};
use std::collections::{BTreeMap, HashSet};

/// The remark on textures without a picture.
const NO_PICTURE: &str = "textures without a picture that is read";

/// The material of surfaces that name none.
const DEFAULT: &str = "default";

/// The materials that surfaces use so far.
#[derive(Debug, Default)]
pub(super) struct Materials {
    /// The entries, in the order of the mesh's surfaces.
    pub(super) entries: Vec<Entry>,
    /// Pictures inside the file, by the names that entries give them.
    pub(super) pictures: BTreeMap<String, Vec<u8>>,
    numbers: BTreeMap<Option<usize>, u32>,
    names: HashSet<String>,
    /// The parts that are not used.
    pub(super) unused: Vec<&'static str>,
}

/// The document, the bytes of its views, and the name of its file.
pub(super) type Context<'a> = (&'a Document, &'a Numbers<'a>, &'a str);

/// The texture coordinates that a material takes: the set, and their change before the picture is read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Coordinates {
    pub(super) set: u32,
    scale: DVec2,
    turn: f64,
    offset: DVec2,
}

impl Coordinates {
    /// The coordinates of a set, unchanged.
    fn of_set(set: u32) -> Self {
        Self { set, scale: DVec2::ONE, turn: 0.0, offset: DVec2::ZERO }
    }

    /// Returns the coordinates of a material: those of the base colour's picture, or else of the normal texture.
    pub(super) fn of(material: &Material<'_>) -> Self {
        let Some(info) = material.pbr_metallic_roughness().base_color_texture() else {
            return Self::of_normals(material).unwrap_or(Self::of_set(0));
        };
        let own = Self::of_set(info.tex_coord());
        let Some(transform) = info.texture_transform() else { return own };
        let pair = |[x, y]: [f32; 2]| dvec2(x.into(), y.into());
        Self {
            set: transform.tex_coord().unwrap_or(own.set),
            scale: pair(transform.scale()),
            turn: transform.rotation().into(),
            offset: pair(transform.offset()),
        }
    }

    /// Returns the coordinates of the normal texture, if there is one.
    fn of_normals(material: &Material<'_>) -> Option<Self> {
        let normals = material.normal_texture()?;
        let own = Self::of_set(normals.tex_coord());
        let Some(transform) = normals.extension_value("KHR_texture_transform") else {
            return Some(own);
        };
        // The numbers are of single precision, as those of the base colour are.
        let number = |value: &Value| value.as_f64().map(|x| f64::from(x as f32));
        let pair = |key: &str, other: DVec2| {
            let [x, y] = [0, 1].map(|k| number(transform.get(key)?.get(k)?));
            x.zip(y).map_or(other, |(x, y)| dvec2(x, y))
        };
        let set = transform.get("texCoord").and_then(Value::as_u64);
        Some(Self {
            set: set.and_then(|set| u32::try_from(set).ok()).unwrap_or(own.set),
            scale: pair("scale", DVec2::ONE),
            turn: transform.get("rotation").and_then(number).unwrap_or(0.0),
            offset: pair("offset", DVec2::ZERO),
        })
    }

    /// Returns coordinates from the lower left corner of the picture. Those of the file start at the upper
    /// left corner, and are scaled, turned and moved there (extension `KHR_texture_transform`).
    pub(super) fn moved(&self, [u, v]: [f64; 2]) -> [f32; 2] {
        let at = self.scale * dvec2(u, v);
        let (sin, cos) = self.turn.sin_cos();
        let at = self.offset + dvec2(cos * at.x + sin * at.y, cos * at.y - sin * at.x);
        [at.x as f32, (1.0 - at.y) as f32]
    }
}

/// Returns the emitted light of a material: its factor times the strength of an extension.
fn emitted(material: &Material<'_>) -> Color {
    let strength = material
        .extension_value("KHR_materials_emissive_strength")
        .and_then(|value| value.get("emissiveStrength")?.as_f64())
        .unwrap_or(1.0);
    let light = |factor: f32| {
        let light = f64::from(factor) * strength;
        if light.is_finite() { light.clamp(0.0, LARGEST) } else { 0.0 }
    };
    Color::from(material.emissive_factor().map(light))
}

impl Materials {
    /// Returns the surface of a material. With `colored` it shows the colours of vertices too.
    pub(super) fn surface(
        &mut self,
        material: &Material<'_>,
        colored: bool,
        (document, numbers, file): Context<'_>,
    ) -> Result<u32, Fault> {
        if let Some(&known) = self.numbers.get(&material.index()) {
            if colored {
                self.entries[known as usize].material.vertex_colors = VertexColors::Always;
            }
            return Ok(known);
        }
        let name = match (material.name(), material.index()) {
            (Some(name), _) if !name.trim().is_empty() => name.to_string(),
            (_, Some(index)) => format!("material {index}"),
            (_, None) => DEFAULT.into(),
        };
        let mut own = name.clone();
        let mut again = 2;
        while !self.names.insert(own.clone()) {
            own = format!("{name} ({again})");
            again += 1;
        }
        let mut entry = self.entry(own, material, (document, numbers, file))?;
        if colored {
            entry.material.vertex_colors = VertexColors::Always;
        }
        self.entries.push(entry);
        let surface = self.entries.len() as u32 - 1;
        self.numbers.insert(material.index(), surface);
        Ok(surface)
    }

    fn entry(
        &mut self,
        name: String,
        material: &Material<'_>,
        context: Context<'_>,
    ) -> Result<Entry, Fault> {
        let pbr = material.pbr_metallic_roughness();
        let [red, green, blue, alpha] = pbr.base_color_factor().map(f64::from);
        let channel = |x: f64| if x.is_finite() { x.clamp(0.0, 1.0) } else { 1.0 };
        let mut own = plain();
        own.color = Color::new(channel(red), channel(green), channel(blue));
        let picture = match pbr.base_color_texture() {
            Some(info) => self.picture(&info.texture(), context)?,
            None => None,
        };
        let cutoff = f64::from(material.alpha_cutoff().unwrap_or(0.5));
        let (opacity, cut) = match material.alpha_mode() {
            AlphaMode::Opaque => (1.0, Alpha::Ignore),
            AlphaMode::Blend => (channel(alpha), Alpha::Cut),
            AlphaMode::Mask => {
                // The factor is multiplied by the alpha of each texel, which is at most 1.
                let shows = channel(alpha) >= cutoff;
                let least = (cutoff / channel(alpha) * f64::from(u16::MAX)).ceil();
                (f64::from(u8::from(shows)), Alpha::From(least as u16))
            }
        };
        if opacity != 1.0 {
            (own.ambient, own.diffuse) = (opacity, opacity);
            own.transparency = 1.0 - opacity;
        }
        let emits = material.emissive_factor() != [0.0; 3];
        let lit_picture = material.emissive_texture().is_some();
        if emits && !lit_picture {
            own.emission = opacity * emitted(material);
        }
        let relief = self.relief(material, context)?;
        let is_rough = pbr.metallic_factor() == 0.0 && pbr.roughness_factor() == 1.0;
        for (what, is_there) in [
            ("metallic and roughness", !is_rough && material.index().is_some()),
            ("occlusion textures", material.occlusion_texture().is_some()),
            ("emitted light with a picture", emits && lit_picture),
        ] {
            if is_there {
                self.unused.push(what);
            }
        }
        Ok(Entry { picture, alpha: cut, relief, ..Entry::new(&name, own) })
    }

    /// Returns the relief of a normal texture that is laid as the base colour is.
    fn relief(
        &mut self,
        material: &Material<'_>,
        context: Context<'_>,
    ) -> Result<Option<ReliefMap>, Fault> {
        let Some(normals) = material.normal_texture() else { return Ok(None) };
        if Coordinates::of_normals(material) != Some(Coordinates::of(material)) {
            self.unused.push("normal textures with coordinates of their own");
            return Ok(None);
        }
        let map = self.picture(&normals.texture(), context)?;
        let strength = f64::from(normals.scale());
        let strength = if strength.is_finite() { strength.clamp(-1e6, 1e6) } else { 1.0 };
        let relief =
            |map| ReliefMap { map: Map { strength, ..map }, colors: ReliefColors::Normals };
        Ok(map.map(relief))
    }

    /// Returns the picture of a texture. A picture inside the file gets a name, and its bytes are kept.
    fn picture(
        &mut self,
        texture: &Texture<'_>,
        (document, numbers, file): Context<'_>,
    ) -> Result<Option<Map>, Fault> {
        let webp = || {
            let source = texture.extension_value("EXT_texture_webp")?.get("source")?.as_u64()?;
            document.images().nth(usize::try_from(source).ok()?)
        };
        let Some(image) = texture.source().or_else(webp) else {
            self.unused.push(NO_PICTURE);
            return Ok(None);
        };
        let wrap = match texture.sampler().wrap_s() {
            WrappingMode::Repeat => Wrap::Repeat,
            WrappingMode::ClampToEdge => Wrap::Clamp,
            WrappingMode::MirroredRepeat => Wrap::Mirror,
        };
        let inside = format!("{}#image{}", uri::name(file), image.index());
        // The crate's own function asks for a MIME type, which the bytes tell too.
        let json = &document.as_json().images[image.index()];
        let view = json.buffer_view.and_then(|view| document.views().nth(view.value()));
        let bytes = match (view, &json.uri) {
            (Some(view), _) => numbers.view(&view)?.to_vec(),
            (None, Some(uri)) if uri::is_data(uri) => {
                uri::data(uri, &format!("images[{}].uri", image.index()))?
            }
            (None, Some(uri)) => {
                return Ok(Some(Map::of(uri::path(uri), wrap)));
            }
            (None, None) => {
                self.unused.push(NO_PICTURE);
                return Ok(None);
            }
        };
        self.pictures.entry(inside.clone()).or_insert(bytes);
        Ok(Some(Map::of(inside, wrap)))
    }
}
