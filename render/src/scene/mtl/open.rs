//! A material of a library while its statements are read.

use super::{Entry, Map, ReliefColors, ReliefMap, plain};
use crate::color::Color;
use crate::scene::VertexColors;
use crate::scene::limits::LARGEST;
use crate::scene::obj::shortened;
use crate::scene::text::words;

/// The entry that is read, with the statements that are judged at its end.
#[derive(Debug)]
pub(super) struct Open {
    entry: Entry,
    /// Opacity by `d` and transparency by `Tr`.
    opacity: Option<f64>,
    transparency: Option<f64>,
    /// True if there is a `Kd`.
    has_color: bool,
    /// True if there is a picture of emitted light.
    has_lit_picture: bool,
    bump: Option<Map>,
    normals: Option<Map>,
}

impl Open {
    pub(super) fn new(name: &str) -> Self {
        Self {
            entry: Entry::new(name, plain()),
            opacity: None,
            transparency: None,
            has_color: false,
            has_lit_picture: false,
            bump: None,
            normals: None,
        }
    }

    /// The name of the material.
    pub(super) fn name(&self) -> &str {
        &self.entry.name
    }

    /// Reads a statement, whose keyword has small letters. Returns whether it is used or has no effect, or the
    /// expected form.
    pub(super) fn statement(&mut self, keyword: &str, rest: &str) -> Result<bool, &'static str> {
        let material = &mut self.entry.material;
        let within = |low: f64, high: f64, expected: &'static str| {
            let number = words(rest).find(|word| *word != "-halo");
            let number = number.and_then(|word| word.parse().ok());
            number.filter(|x| (low..=high).contains(x)).ok_or(expected)
        };
        match keyword {
            "kd" => {
                material.color = color(rest).ok_or("`Kd` and three numbers of at least 0")?;
                self.has_color = true;
            }
            "ks" => {
                let strength = color(rest).ok_or("`Ks` and three numbers of at least 0")?;
                material.specular = (strength.element_sum() / 3.0).min(1.0);
            }
            "ke" => {
                material.emission = color(rest).ok_or("`Ke` and three numbers of at least 0")?;
            }
            "ns" => {
                let shininess: f64 = within(0.0, 1e6, "`Ns` and a number from 0 to 1e6")?;
                material.shininess = shininess.max(1.0);
            }
            "ni" => {
                material.index_of_refraction =
                    within(0.1, 10.0, "`Ni` and a number from 0.1 to 10")?;
            }
            "d" => self.opacity = Some(within(0.0, 1.0, "`d` and a number from 0 to 1")?),
            "tr" => self.transparency = Some(within(0.0, 1.0, "`Tr` and a number from 0 to 1")?),
            "map_kd" => self.entry.picture = Some(Map::read(rest).ok_or("`map_Kd` and a file")?),
            "map_d" => self.entry.mask = Some(Map::read(rest).ok_or("`map_d` and a file")?),
            "map_bump" | "bump" => {
                self.bump = Some(Map::read(rest).ok_or("`map_Bump` and a file")?);
            }
            "norm" => self.normals = Some(Map::read(rest).ok_or("`norm` and a file")?),
            "map_ke" => {
                self.has_lit_picture = true;
                return Ok(false);
            }
            "ka" | "illum" => {}
            // A filter of the light that passes.
            "tf" => return Ok(color(rest) == Some(Color::ONE)),
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Returns the entry. Sentences about it are added to `odd`.
    pub(super) fn finish(self, odd: &mut Vec<String>) -> Entry {
        let mut entry = self.entry;
        let name = shortened(&entry.name);
        let opacity = match (self.opacity, self.transparency) {
            (Some(opacity), _) => opacity,
            (None, Some(1.0)) => {
                odd.push(format!("`Tr 1` of material {name}, without `d`, is taken as opaque"));
                1.0
            }
            (None, Some(transparency)) => 1.0 - transparency,
            (None, None) => 1.0,
        };
        let material = &mut entry.material;
        if self.has_lit_picture && material.emission != Color::ZERO {
            // Programs write white light beside the picture that divides it.
            material.emission = Color::ZERO;
            odd.push(format!("`Ke` of material {name} is not used, since it has a `map_Ke`"));
        }
        if opacity != 1.0 {
            (material.ambient, material.diffuse) = (opacity, opacity);
            material.emission *= opacity;
            material.transparency = 1.0 - opacity;
        }
        if entry.picture.is_some() && material.color == Color::ZERO {
            material.color = Color::ONE;
            odd.push(format!(
                "`Kd 0` of material {name} is taken as white, since it has a `map_Kd`"
            ));
        }
        if !self.has_color {
            material.vertex_colors = VertexColors::Untextured;
        }
        if self.bump.is_some() && self.normals.is_some() {
            odd.push(format!("`bump` of material {name} is not used, since it has a `norm`"));
        }
        let relief = |colors| move |map| ReliefMap { map, colors };
        let normals = self.normals.map(relief(ReliefColors::Normals));
        entry.relief = normals.or(self.bump.map(relief(ReliefColors::Heights)));
        entry
    }
}

/// Returns three numbers; a single number stands for all three.
fn color(text: &str) -> Option<Color> {
    let mut numbers = Vec::new();
    for word in words(text) {
        numbers.push(word.parse().ok().filter(|x| (0.0..=LARGEST).contains(x))?);
    }
    match numbers[..] {
        [grey] => Some(Color::splat(grey)),
        [red, green, blue] => Some(Color::new(red, green, blue)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Library, read};
    use super::*;

    fn entry(lines: &str) -> (Entry, Vec<String>) {
        let text = format!("newmtl a\n{lines}\n");
        let Library { mut entries, remarks, .. } = read("a.mtl", text.as_bytes()).unwrap();
        (entries.remove(0), remarks)
    }

    #[test]
    fn emitted_light_is_kept_times_the_opacity() {
        for (lines, truth) in [
            ("Ke 0.5 0.25 4", Color::new(0.5, 0.25, 4.0)),
            ("KE 2", Color::splat(2.0)),
            ("Ke 1 1 1\nd 0.25", Color::splat(0.25)),
            ("d 0.25\nKe 1 1 1", Color::splat(0.25)),
        ] {
            let (entry, remarks) = entry(lines);
            assert_eq!((entry.material.emission, remarks), (truth, vec![]), "{lines}");
        }
        let (entry, remarks) = entry("Ke 1 1 1\nmap_Ke lamp.png");
        assert_eq!(entry.material.emission, Color::ZERO);
        assert_eq!(
            remarks,
            ["`Ke` of material a is not used, since it has a `map_Ke`", "not used: map_Ke"]
        );
    }

    #[test]
    fn reliefs_keep_their_pictures_and_strengths() {
        use ReliefColors::{Heights, Normals};
        for (lines, colors, path, strength) in [
            ("map_Bump -bm 0.3 a b.png", Heights, "a b.png", 0.3),
            ("map_bump a.png", Heights, "a.png", 1.0),
            ("bump -s 2 2 -bm -4 a.png", Heights, "a.png", -4.0),
            ("bump -bm x a.png", Heights, "a.png", 1.0),
            ("norm -bm 2 a.png", Normals, "a.png", 2.0),
        ] {
            let (entry, remarks) = entry(lines);
            let ReliefMap { map, colors: found } = entry.relief.unwrap();
            assert_eq!((found, map.path.as_str(), map.strength), (colors, path, strength));
            assert_eq!(remarks, [""; 0]);
        }
        let (entry, remarks) = entry("norm n.png\nbump b.png");
        assert_eq!(entry.relief.unwrap().map.path, "n.png");
        assert_eq!(remarks, ["`bump` of material a is not used, since it has a `norm`"]);
    }

    #[test]
    fn a_material_without_a_colour_shows_those_of_vertices() {
        for (lines, truth) in [
            ("Kd 1 1 1", VertexColors::Never),
            ("Ks 1 1 1", VertexColors::Untextured),
            ("map_Kd a.png", VertexColors::Untextured),
        ] {
            assert_eq!(entry(lines).0.material.vertex_colors, truth, "{lines}");
        }
    }

    #[test]
    fn keywords_may_have_any_letters_and_a_halo_is_passed_over() {
        let (entry, remarks) = entry("kd 0.5 0.5 0.5\nKS 1 1 1\nD -halo 0.5\nMAP_KD a.png");
        assert_eq!(entry.material.color, Color::splat(0.5));
        assert_eq!((entry.material.specular, entry.material.transparency), (1.0, 0.5));
        assert_eq!((entry.picture, remarks), (Map::read("a.png"), vec![]));
    }
}
