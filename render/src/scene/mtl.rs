//! Reads MTL files, the material libraries that other tools write beside their OBJ files.
//!
//! | statement | becomes |
//! |---|---|
//! | `Kd` | `color`, taken as linear light; white if it is 0 and there is a `map_Kd` |
//! | `map_Kd` | a texture, `srgb` and `repeat`, with the options `-s`, `-o` and `-clamp` ([`Map`]) |
//! | `map_d` | a mask that cuts out surfaces: the alpha of the picture, or its grey if it has none |
//! | `map_Bump` or `bump` | a bump: the grey of the picture as heights, from 0 to the `-bm` (1 if left out) in the mesh's units |
//! | `norm` | a bump: the colours of the picture as normals, whose slopes are multiplied by the `-bm` |
//! | `Ks` | `specular`, the mean of its three numbers |
//! | `Ns` | `shininess`, 1 if it is less |
//! | `d`, or without it `Tr` for 1 - d | `ambient` and `diffuse` are d, `transparency` is 1 - d |
//! | `Ni` | `index_of_refraction`; 1 if left out, so that a `d` alone bends nothing |
//! | `Ke` | `emission`, times d |
//! | `Ka`, `illum`, `Tf` without effect | nothing |
//!
//! A `Tr 1` without `d` is taken as opaque: some programs wrote it for opaque materials, and
//! none means an invisible object. Tools differ in how they write mirrors, so mirrors are ignored. A
//! scene binds a material that should mirror.
//!
//! Many programs write a normal map as `map_Bump`. A picture of which nearly all colours are unit vectors is
//! therefore taken as one. Without `Kd` and `map_Kd` a material states no colour, and shows those of
//! vertices. Keywords may be written in capitals or not.
//!
//! A line that is not valid is ignored. [`Library::remarks`] names all that is not used.

mod map;
mod open;

pub use map::Map;

use super::Material;
use super::obj::{ObjError, shortened};
use super::text::{self, before_comment};
use crate::texture::Alpha;
use open::Open;
use std::collections::{BTreeMap, HashMap};

/// Sentences about single lines and materials; further ones are counted.
const QUOTED: usize = 3;

/// A material of a library.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Name of the material in `usemtl`.
    pub name: String,
    /// The material.
    pub material: Material,
    /// The picture of its colours.
    pub picture: Option<Map>,
    /// The picture of its opacity, which cuts out surfaces.
    pub mask: Option<Map>,
    /// The use of the alpha of its picture.
    pub alpha: Alpha,
    /// The picture of its relief.
    pub relief: Option<ReliefMap>,
}

/// The picture of a material's relief.
#[derive(Debug, Clone, PartialEq)]
pub struct ReliefMap {
    /// The picture, with its strength.
    pub map: Map,
    /// The meaning of its colours.
    pub colors: ReliefColors,
}

/// The meaning of the colours of a relief's picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ReliefColors {
    /// Heights by the grey, or normals if nearly all colours are unit vectors.
    Heights,
    /// Normals.
    Normals,
}

impl Entry {
    /// Returns an entry with a material alone.
    #[must_use]
    pub fn new(name: &str, material: Material) -> Self {
        let (picture, mask, relief) = (None, None, None);
        Self { name: name.into(), material, picture, mask, alpha: Alpha::Cut, relief }
    }
}

/// The contents of an MTL file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Library {
    /// The materials, each name once.
    pub entries: Vec<Entry>,
    /// Numbers of the entries by their names, with and without the comment behind a name.
    numbers: HashMap<String, usize>,
    /// Sentences about statements that are not used, or are used with another meaning than they state.
    pub remarks: Vec<String>,
}

/// Reads the bytes of an MTL file. `file` is the name of the file in messages. Of entries of one name the
/// first counts.
///
/// # Errors
/// If the file is not text.
pub fn read(file: &str, bytes: &[u8]) -> Result<Library, ObjError> {
    let not_text =
        |text::NotText(line)| ObjError::NotText { file: file.into(), line, kind: "an MTL library" };
    let text = text::of(bytes).map_err(not_text)?;
    let mut library = Library::default();
    let mut open: Option<Open> = None;
    let mut odd = Vec::new();
    let mut unused: BTreeMap<&str, usize> = BTreeMap::new();
    for (number, line) in text.lines().enumerate() {
        let (keyword, rest) = text::keyword(line);
        if keyword.is_empty() || keyword.starts_with('#') {
            continue;
        }
        let fault = match (keyword.to_ascii_lowercase().as_str(), &mut open) {
            ("newmtl", _) if rest.is_empty() => Err("`newmtl` and a name"),
            ("newmtl", _) => {
                library.close(open.take(), &mut odd);
                open = Some(Open::new(rest));
                Ok(())
            }
            (_, None) => Err("`newmtl` before it"),
            (known, Some(open)) => match open.statement(known, rest) {
                Ok(true) => Ok(()),
                Ok(false) => {
                    *unused.entry(keyword).or_default() += 1;
                    Ok(())
                }
                Err(expected) => Err(expected),
            },
        };
        if let Err(expected) = fault {
            odd.push(format!(
                "line {} is ignored: found `{}`, expected {expected}",
                number + 1,
                shortened(line.trim())
            ));
        }
    }
    library.close(open, &mut odd);
    let more = odd.len().saturating_sub(QUOTED);
    library.remarks.extend(odd.into_iter().take(QUOTED));
    if more > 0 {
        library.remarks.push(format!("{more} more such remarks"));
    }
    if !unused.is_empty() {
        library.remarks.push(format!("not used: {}", counted(&unused)));
    }
    Ok(library)
}

/// Lists what is not used and how often it occurs.
pub fn counted<T: AsRef<str>>(unused: &BTreeMap<T, usize>) -> String {
    let item = |(what, count): (&T, &usize)| match count {
        1 => shortened(what.as_ref()),
        _ => format!("{} ({count} times)", shortened(what.as_ref())),
    };
    unused.iter().map(item).collect::<Vec<_>>().join(", ")
}

impl Library {
    /// Returns the library of materials that a mesh file holds, with names that differ.
    #[must_use]
    pub fn of(entries: &[Entry]) -> Self {
        let names = entries.iter().map(|entry| entry.name.clone());
        let numbers = names.zip(0..).collect();
        Self { entries: entries.to_vec(), numbers, remarks: Vec::new() }
    }

    /// Returns the number of the entry with this name in `usemtl`. The name may have a comment behind it.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<usize> {
        let short = || self.numbers.get(before_comment(name)?);
        self.numbers.get(name).or_else(short).copied()
    }

    /// Adds an entry that is complete. Sentences about it are added to `odd`.
    fn close(&mut self, open: Option<Open>, odd: &mut Vec<String>) {
        let Some(open) = open else { return };
        let name = open.name();
        let is_same = |&number: &usize| self.entries[number].name == name;
        if self.numbers.get(name).is_some_and(is_same) {
            odd.push(format!("material {} occurs again; the first counts", shortened(name)));
            return;
        }
        let entry = open.finish(odd);
        let number = self.entries.len();
        self.numbers.insert(entry.name.clone(), number);
        if let Some(short) = before_comment(&entry.name) {
            self.numbers.entry(short.into()).or_insert(number);
        }
        self.entries.push(entry);
    }
}

/// Returns the material of an entry that has a name alone.
#[must_use]
pub fn plain() -> Material {
    Material { diffuse: 1.0, index_of_refraction: 1.0, ..Material::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Color;
    use crate::scene::VertexColors;

    #[test]
    fn what_other_tools_write_becomes_a_material() {
        let text = "# a comment\nnewmtl glass\nKd 0.5 0.25 1 # blue\nKs 0.3 0.6 0.9\nNs 225\nd 0.25\nNi 1.5\n\
                    illum 4\nKe 0 0 0\nnewmtl wood old\nmap_Kd pictures\\oak wood.png\r\n\tNs 0\nTr 0\n";
        let Library { entries, remarks, .. } = read("a.mtl", text.as_bytes()).unwrap();
        assert_eq!(remarks, [""; 0]);
        let glass = Material {
            color: Color::new(0.5, 0.25, 1.0),
            ambient: 0.25,
            diffuse: 0.25,
            specular: entries[0].material.specular,
            shininess: 225.0,
            transparency: 0.75,
            index_of_refraction: 1.5,
            ..plain()
        };
        assert_eq!(entries[0].material, glass);
        assert!((glass.specular - 0.6).abs() < 1e-15);
        let vertex_colors = VertexColors::Untextured;
        let wood = Material { shininess: 1.0, vertex_colors, ..plain() };
        let picture = Map::read("pictures/oak wood.png");
        assert_eq!(entries[1], Entry { picture, ..Entry::new("wood old", wood) });
    }

    #[test]
    fn a_line_that_is_not_valid_costs_only_itself() {
        for (line, expected) in [
            ("Kd 1 1", "three numbers"),
            ("Kd 1 1 -1", "at least 0"),
            ("Kd spectral a.rfl", "three numbers"),
            ("Ks 1 1 nan", "three numbers"),
            ("Ns -1", "0 to 1e6"),
            ("Ni 0", "0.1 to 10"),
            ("d 1.5", "0 to 1"),
            ("d -halo 1.5", "0 to 1"),
            ("Tr inf", "0 to 1"),
            ("map_Kd", "a file"),
            ("newmtl", "a name"),
        ] {
            let read = read("a.mtl", format!("newmtl a\n{line}\nKs 1 1 1\n").as_bytes()).unwrap();
            let said = read.remarks.join("; ");
            assert!(said.starts_with(&format!("line 2 is ignored: found `{line}`")), "{said}");
            assert!(said.contains(expected), "{said}");
            let truth =
                Material { specular: 1.0, vertex_colors: VertexColors::Untextured, ..plain() };
            assert_eq!(read.entries[0].material, truth);
        }
        let early = read("a.mtl", b"Kd 1 1 1\n").unwrap().remarks;
        assert!(early[0].contains("`newmtl` before it"), "{early:?}");
        let binary = read("a.mtl", b"newmtl a\n\0\n").unwrap_err().to_string();
        assert!(
            binary.starts_with("a.mtl:2: found a byte 0, expected the text of an MTL"),
            "{binary}"
        );
    }

    #[test]
    fn what_is_not_used_is_named() {
        let text = "newmtl a\nTf 1 1 0\nrefl a.png\nnewmtl b\nrefl b.png\nnewmtl a\nKd 0 0 0\nKd x\nKd y\nKd z\nKd w\n";
        let Library { entries, remarks, .. } = read("a.mtl", text.as_bytes()).unwrap();
        assert_eq!(entries.len(), 2);
        assert_eq!(entries[0].material.color, Color::ONE, "the first of a name counts");
        assert!(remarks[0].starts_with("line 8 is ignored: found `Kd x`"));
        assert_eq!(remarks[3..], ["2 more such remarks", "not used: Tf, refl (2 times)"]);
    }

    #[test]
    fn a_name_may_have_a_comment_or_a_number_sign() {
        let library =
            read("a.mtl", b"newmtl red # paint\nnewmtl red\nnewmtl a #1\nnewmtl a #2\n").unwrap();
        let numbers = ["red", "red # paint", "red # other", "a #1", "a #2", "a", "b"]
            .map(|name| library.find(name));
        let truth = [Some(1), Some(0), Some(1), Some(2), Some(3), Some(2), None];
        assert_eq!(numbers, truth);
    }

    #[test]
    fn opacity_is_that_of_d_or_else_of_tr() {
        for (lines, transparency) in [
            ("d 0.75\nTr 0.5", 0.25),
            ("Tr 0.5\nd 0.75", 0.25),
            ("Tr 0.5", 0.5),
            ("Tr 1", 0.0),
            ("Tr 1.000\nd 0", 1.0),
            ("Tr 0", 0.0),
            ("d 1\nTr 1", 0.0),
        ] {
            let read = read("a.mtl", format!("newmtl a\n{lines}\n").as_bytes()).unwrap();
            let material = &read.entries[0].material;
            assert_eq!(material.transparency, transparency, "{lines}");
            assert_eq!(material.diffuse, 1.0 - transparency, "{lines}");
        }
        let lone = read("a.mtl", b"newmtl a\nTr 1\n").unwrap().remarks;
        assert_eq!(lone, ["`Tr 1` of material a, without `d`, is taken as opaque"]);
    }

    #[test]
    fn a_black_colour_does_not_hide_a_picture() {
        let read =
            read("a.mtl", b"newmtl a\nKd 0 0 0\nmap_Kd a.png\nnewmtl b\nKd 0 0 0\n").unwrap();
        let colors: Vec<Color> = read.entries.iter().map(|entry| entry.material.color).collect();
        assert_eq!(colors, [Color::ONE, Color::ZERO]);
        assert_eq!(read.remarks.len(), 1);
    }
}
