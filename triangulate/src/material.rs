//! The material ids that triangles are bound to.

use sweep::grid::file::Header;

/// A texture id and a surface id. A scene or a material file binds a picture and a material to these
/// ids.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Material {
    /// The texture id; 0 means no texture.
    pub texture: u32,
    /// The surface id.
    pub surface: u32,
}

/// Ids that replace those of all patches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Options {
    /// The texture id, if it replaces that of each patch.
    pub texture: Option<u32>,
    /// The surface id, if it replaces that of each patch.
    pub surface: Option<u32>,
}

impl Options {
    /// Returns the material of a patch: for each id the value in these options, or else that of the
    /// header, or else 0.
    #[must_use]
    pub fn material(&self, header: &Header) -> Material {
        Material {
            texture: self.texture.or(header.texture).unwrap_or(0),
            surface: self.surface.or(header.surface).unwrap_or(0),
        }
    }
}

impl Material {
    /// Returns the name of the material in an OBJ and in a material file, such as `tex2_surf0`.
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
