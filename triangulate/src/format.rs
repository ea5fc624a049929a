//! The formats of mesh files.

use clap::ValueEnum;

/// A format of mesh files. Its name on the command line is that of the variant, and is also the
/// extension of its files. The comments of the variants are the texts of `--help`.
///
/// A new format provides, and the compiler leads to each `match`:
///
/// - a file in this folder that opens with the format's layout, and either a [`Sink`](crate::Sink), if
///   the format can be written row by row, or a function of a whole [`TriMesh`](crate::TriMesh);
/// - its name and article, its contents in words, and whether a terminal shows it as text (below);
/// - its call in `cli/write.rs`;
/// - the endings of other formats' files, which `files::extension` refuses;
/// - tests: a reader of another crate, or a reader written in the test, finds every triangle with the
///   same f32 corners; a mesh without triangles is a valid file (`tests/binary.rs`).
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Text, written row by row; the format that render reads
    Obj,
    /// Binary STL: triangles only, for printers; needs the mesh in memory
    Stl,
    /// Binary PLY with normals and picture coordinates; needs the mesh in memory
    Ply,
    /// Binary glTF with normals and picture coordinates; needs the mesh in memory
    Glb,
    /// 3MF with a unit, for printers; needs the mesh in memory
    #[value(name = "3mf")]
    ThreeMf,
}

impl Format {
    /// Returns the format that a file's extension names, in upper or lower case, if there is one.
    #[must_use]
    pub fn of_extension(extension: &str) -> Option<Self> {
        Self::from_str(extension, true).ok()
    }

    /// Returns the name of the format, in capitals.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Obj => "OBJ",
            Self::Stl => "STL",
            Self::Ply => "PLY",
            Self::Glb => "GLB",
            Self::ThreeMf => "3MF",
        }
    }

    /// Returns the name of the format after its indefinite article.
    #[must_use]
    pub fn with_article(self) -> &'static str {
        match self {
            Self::Obj => "an OBJ",
            Self::Stl => "an STL",
            Self::Ply => "a PLY",
            Self::Glb => "a GLB",
            Self::ThreeMf => "a 3MF",
        }
    }

    /// Returns the contents of a file of the format, in words.
    #[must_use]
    pub fn content(self) -> &'static str {
        match self {
            Self::Obj => "an OBJ mesh",
            Self::Stl => "an STL mesh",
            Self::Ply => "a PLY mesh",
            Self::Glb => "a GLB mesh",
            Self::ThreeMf => "a 3MF mesh",
        }
    }

    /// Returns the extension of the format's files.
    #[must_use]
    pub fn extension(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Stl => "stl",
            Self::Ply => "ply",
            Self::Glb => "glb",
            Self::ThreeMf => "3mf",
        }
    }

    /// Returns whether files of the format are text, which a terminal can show.
    #[must_use]
    pub fn is_text(self) -> bool {
        match self {
            Self::Obj => true,
            Self::Stl | Self::Ply | Self::Glb | Self::ThreeMf => false,
        }
    }

    /// Returns whether files of the format state a unit of length.
    #[must_use]
    pub fn has_unit(self) -> bool {
        matches!(self, Self::Glb | Self::ThreeMf)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_of_a_format_is_its_name_on_the_command_line() {
        for &format in Format::value_variants() {
            assert_eq!(Format::of_extension(format.extension()), Some(format));
            assert_eq!(format.name(), format.extension().to_uppercase());
            assert!(format.content().starts_with(format.with_article()));
        }
        assert_eq!(Format::of_extension("StL"), Some(Format::Stl));
        assert_eq!(Format::of_extension("3MF"), Some(Format::ThreeMf));
        assert_eq!(Format::of_extension("fbx"), None);
    }
}
