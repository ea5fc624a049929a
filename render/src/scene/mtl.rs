//! Reads MTL files, the material libraries that other tools write beside their OBJ files.
//!
//! | statement | becomes |
//! |---|---|
//! | `Kd` | `color`, taken as linear light |
//! | `map_Kd` | a texture, `srgb` and `repeat`; its path is relative to the MTL file's folder |
//! | `Ks` | `specular`, the mean of its three numbers |
//! | `Ns` | `shininess`, 1 if it is less |
//! | `d`, or `Tr` for 1 - d | `ambient` and `diffuse` are d, `transparency` is 1 - d |
//! | `Ni` | `index_of_refraction`; 1 if left out, so that a `d` alone bends nothing |
//!
//! All other statements are ignored: the illumination model, emission, and maps of other values. Tools
//! differ in how they write mirrors, so mirrors are ignored too. A scene binds a material that should
//! mirror.

use super::Material;
use super::limits::LARGEST;
use super::obj::{ObjError, shortened};
use crate::color::Color;
use std::collections::HashSet;

/// A material of a library.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Name of the material in `usemtl`.
    pub name: String,
    /// The material.
    pub material: Material,
    /// Path of the picture, as in the file, but with `/` between folders.
    pub picture: Option<String>,
}

/// Reads the bytes of an MTL file. `file` is the name of the file in messages.
///
/// # Errors
/// If a line is not a valid statement. The error names the line.
pub fn read(file: &str, bytes: &[u8]) -> Result<Vec<Entry>, ObjError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut entries: Vec<Entry> = Vec::new();
    let mut names = HashSet::new();
    for (number, line) in bytes.split(|&byte| byte == b'\n').enumerate() {
        let number = number + 1;
        let line = std::str::from_utf8(line)
            .map_err(|_| ObjError::NotText { file: file.into(), line: number })?
            .trim();
        let wrong = |expected| ObjError::Line {
            file: file.into(),
            line: number,
            found: shortened(line),
            expected,
        };
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let rest = rest.trim();
        if keyword == "newmtl" {
            if rest.is_empty() || !names.insert(rest) {
                return Err(wrong("`newmtl` and a name, each name once"));
            }
            entries.push(Entry { name: rest.into(), material: plain(), picture: None });
            continue;
        }
        if !["Kd", "Ks", "Ns", "Ni", "d", "Tr", "map_Kd"].contains(&keyword) {
            continue;
        }
        let Some(entry) = entries.last_mut() else {
            return Err(wrong("`newmtl` and a name before it"));
        };
        let material = &mut entry.material;
        let within = |low: f64, high: f64, expected| {
            let number = rest.parse().ok().filter(|x| (low..=high).contains(x));
            number.ok_or_else(|| wrong(expected))
        };
        match keyword {
            "Kd" => {
                material.color =
                    color(rest).ok_or_else(|| wrong("`Kd` and three numbers of at least 0"))?;
            }
            "Ks" => {
                let strength =
                    color(rest).ok_or_else(|| wrong("`Ks` and three numbers of at least 0"))?;
                material.specular = (strength.element_sum() / 3.0).min(1.0);
            }
            "Ns" => {
                let shininess: f64 = within(0.0, 1e6, "`Ns` and a number from 0 to 1e6")?;
                material.shininess = shininess.max(1.0);
            }
            "Ni" => {
                material.index_of_refraction =
                    within(0.1, 10.0, "`Ni` and a number from 0.1 to 10")?;
            }
            "map_Kd" => {
                if rest.is_empty() || rest.starts_with('-') {
                    return Err(wrong("`map_Kd` and a file, without options"));
                }
                entry.picture = Some(rest.replace('\\', "/"));
            }
            _ => {
                let share: f64 = within(0.0, 1.0, "`d` or `Tr` and a number from 0 to 1")?;
                let solid = if keyword == "d" { share } else { 1.0 - share };
                material.ambient = solid;
                material.diffuse = solid;
                material.transparency = 1.0 - solid;
            }
        }
    }
    Ok(entries)
}

/// Returns the material of an entry that has a name alone.
fn plain() -> Material {
    Material { diffuse: 1.0, index_of_refraction: 1.0, ..Material::default() }
}

/// Returns three numbers; a single number stands for all three.
fn color(text: &str) -> Option<Color> {
    let mut numbers = Vec::new();
    for word in text.split_whitespace() {
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
    use super::*;

    #[test]
    fn what_other_tools_write_becomes_a_material() {
        let text = "# a comment\nnewmtl glass\nKd 0.5 0.25 1\nKs 0.3 0.6 0.9\nNs 225\nd 0.25\nNi 1.5\n\
                    illum 4\nKe 0 0 0\nnewmtl wood old\nmap_Kd pictures\\oak wood.png\r\n\tNs 0\n";
        let entries = read("a.mtl", text.as_bytes()).unwrap();
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
        let wood = Material { shininess: 1.0, ..plain() };
        let picture = Some("pictures/oak wood.png".into());
        assert_eq!(entries[1], Entry { name: "wood old".into(), material: wood, picture });
    }

    #[test]
    fn bad_lines_are_named() {
        for (line, expected) in [
            ("Kd 1 1", "three numbers"),
            ("Kd 1 1 -1", "at least 0"),
            ("Kd spectral a.rfl", "three numbers"),
            ("Ks 1 1 nan", "three numbers"),
            ("Ns -1", "0 to 1e6"),
            ("Ni 0", "0.1 to 10"),
            ("d 1.5", "0 to 1"),
            ("d -halo 0.5", "0 to 1"),
            ("Tr inf", "0 to 1"),
            ("map_Kd", "a file"),
            ("map_Kd -s 2 2 a.png", "without options"),
            ("newmtl a", "each name once"),
            ("newmtl", "a name"),
        ] {
            let said = read("a.mtl", format!("newmtl a\n{line}\n").as_bytes()).unwrap_err();
            let said = said.to_string();
            assert!(said.starts_with("a.mtl:2: found `"), "{said}");
            assert!(said.contains(expected), "{said}");
        }
        let early = read("a.mtl", b"Kd 1 1 1\n").unwrap_err().to_string();
        assert!(early.contains("`newmtl` and a name before it"), "{early}");
        let binary = read("a.mtl", b"newmtl a\n\xff\n").unwrap_err().to_string();
        assert!(binary.starts_with("a.mtl:2: "), "{binary}");
    }
}
