//! The solid textures of a scene file.

use super::{Reader, SceneError};
use crate::color::Color;
use crate::procedural::blocks::{Brick, Checker, Stripes};
use crate::procedural::clouds::{Clouds, Sum};
use crate::procedural::granite::Granite;
use crate::procedural::marble::Marble;
use crate::procedural::turbulence::MOST_OCTAVES;
use crate::procedural::wall::{Wall, WallPaint};
use crate::procedural::wood::Wood;
use crate::procedural::{Interpolation, Noise, Octaves, Pattern, Placement, Ramp, Solid};
use crate::scene::file::solid::{
    BrickFile, CloudsFile, GraniteFile, MarbleFile, PlaceFile, StripesFile, WallFile, WoodFile,
};
use crate::scene::file::{ColorFile, TextureFile};
use glam::DVec3;
use std::sync::Arc;

/// Colours of a wall that names none: plaster, darker where it is low.
const PLASTER: [(f64, ColorFile); 2] =
    [(0.2, ColorFile([0.50, 0.44, 0.36])), (0.8, ColorFile([0.82, 0.77, 0.68]))];

impl Reader<'_> {
    pub(super) fn solids(&self) -> Result<Vec<Solid>, SceneError> {
        let solids = self.file.textures.iter().filter(|(_, texture)| texture.image.is_none());
        solids.map(|(name, texture)| self.solid(&format!("textures.{name}"), texture)).collect()
    }

    /// Checks that a texture is of exactly one kind, and has no key that belongs to another.
    pub(super) fn texture_kinds(&self) -> Result<(), SceneError> {
        for (name, file) in self.file.textures {
            let at = format!("textures.{name}");
            self.one_of(
                &at,
                &[
                    ("image", file.image.is_some()),
                    ("marble", file.marble.is_some()),
                    ("granite", file.granite.is_some()),
                    ("wood", file.wood.is_some()),
                    ("wall", file.wall.is_some()),
                    ("turbulence", file.turbulence.is_some()),
                    ("clouds", file.clouds.is_some()),
                    ("checker", file.checker.is_some()),
                    ("stripes", file.stripes.is_some()),
                    ("brick", file.brick.is_some()),
                ],
            )?;
            let picture = file.image.is_some();
            for (key, given, of_pictures) in [
                ("wrap", file.wrap.is_some(), true),
                ("values", file.values.is_some(), true),
                ("place", file.place.is_some(), false),
            ] {
                if given && of_pictures != picture {
                    let (found, place) = if picture {
                        ("a picture", "textures that fill space")
                    } else {
                        ("a texture that fills space", "pictures")
                    };
                    let message = format!("found it on {found}, expected it only on {place}");
                    return self.fault(&format!("{at}.{key}"), message);
                }
            }
        }
        Ok(())
    }

    /// Complains unless exactly one of these keys was given.
    pub(super) fn one_of(&self, at: &str, keys: &[(&str, bool)]) -> Result<(), SceneError> {
        let given: Vec<&str> =
            keys.iter().filter(|(_, given)| *given).map(|(key, _)| *key).collect();
        if given.len() == 1 {
            return Ok(());
        }
        let found = if given.is_empty() { "none".into() } else { given.join(" and ") };
        let names: Vec<&str> = keys.iter().map(|(key, _)| *key).collect();
        self.fault(at, format!("found {found}, expected exactly one of: {}", names.join(", ")))
    }

    fn solid(&self, at: &str, file: &TextureFile) -> Result<Solid, SceneError> {
        let placement =
            self.texture_place(&format!("{at}.place"), &file.place.unwrap_or_default())?;
        let pattern = if let Some(marble) = &file.marble {
            self.marble(&format!("{at}.marble"), marble)?
        } else if let Some(granite) = &file.granite {
            self.granite(&format!("{at}.granite"), granite)?
        } else if let Some(wood) = &file.wood {
            self.wood(&format!("{at}.wood"), wood)?
        } else if let Some(wall) = &file.wall {
            let at = format!("{at}.wall");
            let colors = wall.colors.as_deref().unwrap_or(&PLASTER);
            let colors = self.ramp(&format!("{at}.colors"), colors)?;
            Pattern::Wall(WallPaint { wall: self.wall(&at, wall)?, colors })
        } else if let Some(clouds) = &file.turbulence {
            self.clouds(&format!("{at}.turbulence"), clouds, Sum::Turbulence)?
        } else if let Some(clouds) = &file.clouds {
            self.clouds(&format!("{at}.clouds"), clouds, Sum::Fractal)?
        } else if let Some(checker) = &file.checker {
            let colors = self.two(&format!("{at}.checker.colors"), checker.colors)?;
            Pattern::Checker(Checker { colors })
        } else if let Some(stripes) = &file.stripes {
            self.stripes(&format!("{at}.stripes"), stripes)?
        } else if let Some(brick) = &file.brick {
            self.brick(&format!("{at}.brick"), brick)?
        } else {
            return self.one_of(at, &[]).and_then(|()| self.fault(at, "found no kind"));
        };
        Ok(Solid { pattern, placement })
    }

    fn marble(&self, at: &str, file: &MarbleFile) -> Result<Pattern, SceneError> {
        Ok(Pattern::Marble(Marble {
            colors: self.ramp(&format!("{at}.colors"), &file.colors)?,
            octaves: self.octaves(at, file.octaves, file.interpolation)?,
            folds: self.within(&format!("{at}.folds"), file.folds, 0.0, 100.0)?,
            net: self.within(&format!("{at}.net"), file.net, 0.0, 1.0)?,
        }))
    }

    fn granite(&self, at: &str, file: &GraniteFile) -> Result<Pattern, SceneError> {
        Ok(Pattern::Granite(Granite {
            minerals: self.parts(&format!("{at}.minerals"), &file.minerals)?,
            flakes: self.within(&format!("{at}.flakes"), file.flakes, 0.0, 1.0)?,
            flake: self.color(&format!("{at}.flake_color"), file.flake_color)?,
            vary: self.within(&format!("{at}.vary"), file.vary, 0.0, 1.0)?,
            noise: self.noise(file.interpolation),
        }))
    }

    fn wood(&self, at: &str, file: &WoodFile) -> Result<Pattern, SceneError> {
        Ok(Pattern::Wood(Wood {
            colors: self.ramp(&format!("{at}.colors"), &file.colors)?,
            waver: self.within(&format!("{at}.waver"), file.waver, 0.0, 100.0)?,
            grain: self.within(&format!("{at}.grain"), file.grain, 0.0, 1.0)?,
            noise: self.noise(file.interpolation),
        }))
    }

    pub(super) fn wall(&self, at: &str, file: &WallFile) -> Result<Wall, SceneError> {
        for (k, &bound) in file.clamp.iter().enumerate() {
            self.within(&format!("{at}.clamp[{k}]"), bound, -1.0, 1.0)?;
        }
        let [low, high] = file.clamp;
        if low >= high {
            let message = format!("found {high}, expected more than {low}");
            return self.fault(&format!("{at}.clamp[1]"), message);
        }
        Ok(Wall {
            clamp: file.clamp,
            rough: self.within(&format!("{at}.rough"), file.rough, 0.0, 10.0)?,
            frequency: self.within(&format!("{at}.frequency"), file.frequency, 1e-3, 1e3)?,
            noise: self.noise(file.interpolation),
        })
    }

    fn clouds(&self, at: &str, file: &CloudsFile, sum: Sum) -> Result<Pattern, SceneError> {
        let colors = self.ramp(&format!("{at}.colors"), &file.colors)?;
        let octaves = self.octaves(at, file.octaves, file.interpolation)?;
        Ok(Pattern::Clouds(Clouds { colors, octaves, sum }))
    }

    fn stripes(&self, at: &str, file: &StripesFile) -> Result<Pattern, SceneError> {
        let layers = self.parts(&format!("{at}.layers"), &file.layers)?;
        Ok(Pattern::Stripes(Stripes { layers }))
    }

    fn brick(&self, at: &str, file: &BrickFile) -> Result<Pattern, SceneError> {
        for (k, &side) in file.size.iter().enumerate() {
            self.within(&format!("{at}.size[{k}]"), side, 1e-6, 1e6)?;
        }
        let size = DVec3::from(file.size);
        if !(file.joint >= 0.0 && file.joint < size.min_element()) {
            let message = format!(
                "found {}, expected at least 0 and less than the least size, {}",
                file.joint,
                size.min_element()
            );
            return self.fault(&format!("{at}.joint"), message);
        }
        Ok(Pattern::Brick(Brick {
            size,
            joint: file.joint,
            colors: self.two(&format!("{at}.colors"), file.colors)?,
            vary: self.within(&format!("{at}.vary"), file.vary, 0.0, 1.0)?,
        }))
    }

    pub(super) fn texture_place(
        &self,
        at: &str,
        file: &PlaceFile,
    ) -> Result<Placement, SceneError> {
        let scale = self.within(&format!("{at}.scale"), file.scale, 1e-6, 1e6)?;
        let rotate = self.vector(&format!("{at}.rotate_deg"), file.rotate_deg)?;
        let rotate = rotate.to_array().map(f64::to_radians);
        let translate = self.vector(&format!("{at}.translate"), file.translate)?;
        Ok(Placement::new(scale, rotate.into(), translate))
    }

    pub(super) fn octaves(
        &self,
        at: &str,
        count: u32,
        interpolation: Interpolation,
    ) -> Result<Octaves, SceneError> {
        let most = f64::from(MOST_OCTAVES);
        self.within(&format!("{at}.octaves"), f64::from(count), 1.0, most)?;
        Ok(Octaves { noise: self.noise(interpolation), count })
    }

    /// A noise on the scene's lattice, which is filled for the first that asks.
    pub(super) fn noise(&self, interpolation: Interpolation) -> Noise {
        let lattice = Arc::clone(self.lattice.get_or_init(Arc::default));
        Noise { lattice, interpolation }
    }

    fn ramp(&self, path: &str, stops: &[(f64, ColorFile)]) -> Result<Ramp, SceneError> {
        let colors = stops.iter().enumerate().map(|(k, &(position, color))| {
            Ok((position, self.color(&format!("{path}[{k}][1]"), color)?))
        });
        let colors = colors.collect::<Result<_, SceneError>>()?;
        match Ramp::new(colors) {
            Some(ramp) => Ok(ramp),
            None if stops.is_empty() => self.fault(path, "found no stops, expected at least one"),
            None => {
                let falls = |k: &usize| stops[*k].0 < stops[k - 1].0;
                let k = (1..stops.len()).find(falls).unwrap_or_default();
                let message = format!("found {}, expected positions that rise", stops[k].0);
                self.fault(&format!("{path}[{k}][0]"), message)
            }
        }
    }

    /// Sizes above 0 with their colours, at least one.
    fn parts(
        &self,
        path: &str,
        parts: &[(f64, ColorFile)],
    ) -> Result<Vec<(f64, Color)>, SceneError> {
        if parts.is_empty() {
            return self.fault(path, "found none, expected at least one");
        }
        let part = |(k, &(size, color)): (usize, &(f64, ColorFile))| {
            let size = self.within(&format!("{path}[{k}][0]"), size, 1e-6, 1e6)?;
            Ok((size, self.color(&format!("{path}[{k}][1]"), color)?))
        };
        parts.iter().enumerate().map(part).collect()
    }

    fn two(&self, path: &str, colors: [ColorFile; 2]) -> Result<[Color; 2], SceneError> {
        let [first, second] = colors;
        let color = |k: usize, color| self.color(&format!("{path}[{k}]"), color);
        Ok([color(0, first)?, color(1, second)?])
    }
}
