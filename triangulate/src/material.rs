//! What triangles are bound to.

use sweep::grid::file::Header;

/// A texture id and a surface id, under which a scene, or a material file, binds a picture and a
/// material.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Material {
    /// The texture id; 0 is none.
    pub texture: u32,
    /// The surface id.
    pub surface: u32,
}

/// Ids for all patches, in place of their own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Options {
    /// The texture id.
    pub texture: Option<u32>,
    /// The surface id.
    pub surface: Option<u32>,
}

impl Options {
    /// The material of a patch: these ids, or else its own, or else 0.
    #[must_use]
    pub fn material(&self, header: &Header) -> Material {
        Material {
            texture: self.texture.or(header.texture).unwrap_or(0),
            surface: self.surface.or(header.surface).unwrap_or(0),
        }
    }
}

impl Material {
    /// Its name in an OBJ and in a material file.
    #[must_use]
    pub fn name(self) -> String {
        format!("tex{}_surf{}", self.texture, self.surface)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_asked_for_come_before_those_of_the_patch() {
        let patch = Header { texture: Some(3), ..Header::default() };
        for (texture, surface, expected) in [
            (None, None, "tex3_surf0"),
            (Some(0), None, "tex0_surf0"),
            (None, Some(9), "tex3_surf9"),
        ] {
            assert_eq!(Options { texture, surface }.material(&patch).name(), expected);
        }
    }
}
