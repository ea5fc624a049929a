//! The materials of a glTF file, as those of a material library.
//!
//! The base colour is the colour of a matt surface. An alpha below 1 counts where the material blends or has
//! a mask: the alpha of a picture cuts out the surface.

use super::accessor::Numbers;
use super::{Fault, uri};
use crate::color::Color;
use crate::scene::mtl::{Entry, Map, plain};
use crate::texture::{Alpha, Wrap};
use glam::{DVec2, dvec2};
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
#[derive(Debug, Clone, Copy)]
pub(super) struct Coordinates {
    pub(super) set: u32,
    scale: DVec2,
    turn: f64,
    offset: DVec2,
}

impl Coordinates {
    /// Returns the coordinates of a material. Without a picture they are those of set 0.
    pub(super) fn of(material: &Material<'_>) -> Self {
        let plain = Self { set: 0, scale: DVec2::ONE, turn: 0.0, offset: DVec2::ZERO };
        let Some(info) = material.pbr_metallic_roughness().base_color_texture() else {
            return plain;
        };
        let own = Self { set: info.tex_coord(), ..plain };
        let Some(transform) = info.texture_transform() else { return own };
        let pair = |[x, y]: [f32; 2]| dvec2(x.into(), y.into());
        Self {
            set: transform.tex_coord().unwrap_or(own.set),
            scale: pair(transform.scale()),
            turn: transform.rotation().into(),
            offset: pair(transform.offset()),
        }
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

impl Materials {
    /// Returns the surface of a material. With `colored` it shows the colours of vertices too.
    pub(super) fn surface(
        &mut self,
        material: &Material<'_>,
        colored: bool,
        (document, numbers, file): Context<'_>,
    ) -> Result<u32, Fault> {
        if let Some(&known) = self.numbers.get(&material.index()) {
            self.entries[known as usize].material.vertex_colors |= colored;
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
        entry.material.vertex_colors = colored;
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
        let opacity = match material.alpha_mode() {
            AlphaMode::Opaque => 1.0,
            AlphaMode::Blend => channel(alpha),
            AlphaMode::Mask => {
                let cutoff = material.alpha_cutoff().unwrap_or(0.5);
                f64::from(u8::from(channel(alpha) >= f64::from(cutoff)))
            }
        };
        if opacity != 1.0 {
            (own.ambient, own.diffuse) = (opacity, opacity);
            own.transparency = 1.0 - opacity;
        }
        let picture = match pbr.base_color_texture() {
            Some(info) => self.picture(&info.texture(), context)?,
            None => None,
        };
        let is_rough = pbr.metallic_factor() == 0.0 && pbr.roughness_factor() == 1.0;
        let emits = material.emissive_factor() != [0.0; 3];
        for (what, is_there) in [
            ("metallic and roughness", !is_rough && material.index().is_some()),
            ("normal textures", material.normal_texture().is_some()),
            ("occlusion textures", material.occlusion_texture().is_some()),
            ("emitted light", emits),
            // The alpha of a picture cuts out in proportion.
            ("alphaCutoff", material.alpha_mode() == AlphaMode::Mask && picture.is_some()),
        ] {
            if is_there {
                self.unused.push(what);
            }
        }
        let alpha = match material.alpha_mode() {
            AlphaMode::Opaque => Alpha::Ignore,
            AlphaMode::Mask | AlphaMode::Blend => Alpha::Cut,
        };
        Ok(Entry { name, material: own, picture, mask: None, alpha })
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
                let map =
                    Map { path: uri::path(uri), scale: DVec2::ONE, offset: DVec2::ZERO, wrap };
                return Ok(Some(map));
            }
            (None, None) => {
                self.unused.push(NO_PICTURE);
                return Ok(None);
            }
        };
        self.pictures.entry(inside.clone()).or_insert(bytes);
        Ok(Some(Map { path: inside, scale: DVec2::ONE, offset: DVec2::ZERO, wrap }))
    }
}
