//! The material file that may lie beside an OBJ.
//!
//! ```text
//! # topobook triangulate MTL 1
//! newmtl tex2_surf0                   the name that the OBJ uses
//! Kd 0.8 0.8 0.8                      a neutral grey; white under a picture
//! map_Kd marble.png                   the picture, if one was named
//! ...                                 and so on for each material of the mesh
//! ```
//!
//! The file serves viewers and other renderers. `render` binds ids to textures and materials in its
//! scene instead.

use crate::Material;

/// The first line of an MTL that `triangulate` writes.
pub const FIRST_LINE: &str = "# topobook triangulate MTL 1";

/// Returns the text of a material file with `materials`, in their order. `map` is the picture on all of
/// them, as a path that readers of the MTL can follow: most resolve it from the folder of the MTL.
#[must_use]
pub fn mtl(materials: &[Material], map: Option<&str>) -> String {
    // White under a picture, because readers multiply the picture's colour by it.
    let (grey, map) = match map {
        Some(map) => (1.0, format!("map_Kd {map}\n")),
        None => (0.8, String::new()),
    };
    let mut text = format!("{FIRST_LINE}\n");
    for material in materials {
        text += &format!("newmtl {}\nKd {grey} {grey} {grey}\n{map}", material.name());
    }
    text
}

/// Returns whether an MTL can name a picture by `name`. The name must be one line with no part that a
/// reader takes for a comment, an option, or a blank to be dropped.
#[must_use]
pub fn is_map_name(name: &str) -> bool {
    let harmless = |c: char| !c.is_control() && c != '#';
    !name.is_empty() && name.trim() == name && !name.starts_with('-') && name.chars().all(harmless)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_material_is_grey_or_shows_its_picture() {
        let one = Material { texture: 2, surface: 5 };
        let two = [one, Material { texture: 3, surface: 5 }];
        let grey = "# topobook triangulate MTL 1\nnewmtl tex2_surf5\nKd 0.8 0.8 0.8\n";
        assert_eq!(mtl(&[one], None), grey);
        let text = mtl(&two, Some("my marble.png"));
        let (materials, names) = tobj::load_mtl_buf(&mut text.as_bytes()).unwrap();
        assert_eq!(names["tex2_surf5"], 0);
        assert_eq!((names["tex3_surf5"], materials.len()), (1, 2));
        for material in materials {
            assert_eq!(material.diffuse, Some([1.0; 3]));
            assert_eq!(material.diffuse_texture.as_deref(), Some("my marble.png"));
        }
    }

    #[test]
    fn names_that_readers_would_take_apart_are_none() {
        for name in ["a.png", "pictures/my marble.png", "ü.png"] {
            assert!(is_map_name(name), "{name}");
        }
        for name in ["", "a\nb", " a", "a ", "-s", "#1.png"] {
            assert!(!is_map_name(name), "{name}");
        }
    }
}
