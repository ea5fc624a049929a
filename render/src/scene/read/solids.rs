//! Reads the solid textures of a scene file.

use super::ranges::Ranges;
use super::{Reader, SceneError};
use crate::color::Color;
use crate::procedural::blocks::{Brick, Checker, Stripes};
use crate::procedural::clouds::{Clouds, Sum};
use crate::procedural::granite::Granite;
use crate::procedural::marble::Marble;
use crate::procedural::turbulence::MOST_OCTAVES;
use crate::procedural::wall::{Wall, WallPaint};
use crate::procedural::wood::Wood;
use crate::procedural::{Interpolation, Noise, Octaves, Pattern, Ramp, Solid};
use crate::scene::file::solid::{
    BrickFile, CloudsFile, GraniteFile, MarbleFile, StripesFile, WallFile, WoodFile,
};
use crate::scene::file::{ColorFile, TextureFile, TextureKind};
use glam::DVec3;
use std::sync::Arc;

/// Colours of a wall without colours of its own: plaster, darker in the depths.
const PLASTER: [(f64, ColorFile); 2] =
    [(0.2, ColorFile([0.50, 0.44, 0.36])), (0.8, ColorFile([0.82, 0.77, 0.68]))];

impl Reader<'_> {
    /// Reads the solids among the file's textures, in the order of their names.
    pub(super) fn solids(&self) -> Result<Vec<Solid>, SceneError> {
        let mut solids = Vec::new();
        for (name, file) in self.file.textures {
            let at = format!("textures.{name}");
            let placement = self.texture_place(&format!("{at}.place"), file.place.as_ref())?;
            if let Some(pattern) = self.pattern(&at, file)? {
                solids.push(Solid { pattern, placement });
            }
        }
        Ok(solids)
    }

    /// Checks that each texture is of exactly one kind, and has no key that belongs to another.
    pub(super) fn texture_kinds(&self) -> Result<(), SceneError> {
        for (name, file) in self.file.textures {
            let at = format!("textures.{name}");
            self.one_of(&at, &file.kinds())?;
            let picture = file.image.is_some();
            for (key, given, of_pictures) in [
                ("wrap", file.wrap.is_some(), true),
                ("values", file.values.is_some(), true),
                ("alpha", file.alpha.is_some(), true),
                ("place", file.place.is_some(), false),
            ] {
                if given && of_pictures != picture {
                    let (found, expected) = if picture {
                        ("a picture", "textures that fill space")
                    } else {
                        ("a texture that fills space", "pictures")
                    };
                    let message =
                        format!("found this key on {found}, expected it only on {expected}");
                    return self.fault(&format!("{at}.{key}"), message);
                }
            }
        }
        Ok(())
    }

    /// Returns the one kind that was given. Fails unless exactly one was given.
    pub(super) fn one_of<T: Copy>(
        &self,
        at: &str,
        kinds: &[(&str, Option<T>)],
    ) -> Result<T, SceneError> {
        let given: Vec<(&str, T)> =
            kinds.iter().filter_map(|(key, kind)| Some((*key, (*kind)?))).collect();
        if let [(_, kind)] = given[..] {
            return Ok(kind);
        }
        let join = |keys: Vec<&str>, between: &str| keys.join(between);
        let found = if given.is_empty() {
            "none".into()
        } else {
            join(given.iter().map(|(key, _)| *key).collect(), " and ")
        };
        let names = join(kinds.iter().map(|(key, _)| *key).collect(), ", ");
        self.fault(at, format!("found {found}, expected exactly one of: {names}"))
    }

    /// Reads the pattern of a texture; `None` for a picture.
    fn pattern(&self, at: &str, file: &TextureFile) -> Result<Option<Pattern>, SceneError> {
        let pattern = match self.one_of(at, &file.kinds())? {
            TextureKind::Image(_) => return Ok(None),
            TextureKind::Marble(file) => self.marble(&format!("{at}.marble"), file)?,
            TextureKind::Granite(file) => self.granite(&format!("{at}.granite"), file)?,
            TextureKind::Wood(file) => self.wood(&format!("{at}.wood"), file)?,
            TextureKind::Wall(file) => self.painted_wall(&format!("{at}.wall"), file)?,
            TextureKind::Turbulence(file) => {
                self.clouds(&format!("{at}.turbulence"), file, Sum::Turbulence)?
            }
            TextureKind::Clouds(file) => {
                self.clouds(&format!("{at}.clouds"), file, Sum::Fractal)?
            }
            TextureKind::Checker(file) => {
                let colors = self.two(&format!("{at}.checker.colors"), file.colors)?;
                Pattern::Checker(Checker { colors })
            }
            TextureKind::Stripes(file) => self.stripes(&format!("{at}.stripes"), file)?,
            TextureKind::Brick(file) => self.brick(&format!("{at}.brick"), file)?,
        };
        Ok(Some(pattern))
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

    fn painted_wall(&self, at: &str, file: &WallFile) -> Result<Pattern, SceneError> {
        let colors = file.colors.as_deref().unwrap_or(&PLASTER);
        let colors = self.ramp(&format!("{at}.colors"), colors)?;
        Ok(Pattern::Wall(WallPaint { wall: self.wall(at, file)?, colors }))
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

    /// Returns a noise on the scene's lattice, which is filled on first use.
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

    /// Returns pairs of a size, 1e-6 to 1e6, and a colour; at least one pair.
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
