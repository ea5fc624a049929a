//! Examples to start from: curve specs and a scene, each with a `note` on its keys.
//!
//! The files are those of `examples/start/`. In their notes the word FILE stands for the name of the file that is
//! written.

use crate::pages::FILES;
use clap::ValueEnum;
use files::{FileError, Source};
use std::path::Path;

/// An example to start from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Start {
    /// A vase turned on a wheel, with a wall and a relief
    Vase,
    /// A hollow tube along a curve
    Tube,
    /// A trefoil knot with stripes
    Knot,
    /// A Klein bottle
    Klein,
    /// A Moebius band
    Moebius,
    /// A letter cut out of a plate
    Letter,
    /// A scene: a glass ball, a block of marble and a ring
    Scene,
}

impl Start {
    /// Returns the name of the example.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Vase => "vase",
            Self::Tube => "tube",
            Self::Knot => "knot",
            Self::Klein => "klein",
            Self::Moebius => "moebius",
            Self::Letter => "letter",
            Self::Scene => "scene",
        }
    }

    /// Returns the command that makes a picture of the file of this example.
    #[must_use]
    pub fn command(self, file: &Path) -> String {
        let picture = file.with_extension("png");
        let program = if self == Self::Scene { "render" } else { "pipeline show" };
        format!("{program} {} -o {}", file.display(), picture.display())
    }

    /// Returns the text of the example for a file of this name, which its notes state.
    ///
    /// # Errors
    /// None, as long as the example is built in, which a test checks.
    pub fn text(self, file: &Path) -> Result<String, FileError> {
        let bytes = FILES.read(Path::new(&format!("examples/start/{}.json", self.name())))?;
        let stem = file.file_stem().unwrap_or_default().to_string_lossy();
        // The word as it stands within quotes.
        let quoted = serde_json::Value::from(stem).to_string();
        Ok(String::from_utf8_lossy(&bytes).replace("FILE", quoted.trim_matches('"')))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::Value;

    #[test]
    fn each_example_is_json_with_notes_that_name_its_file() {
        for start in Start::value_variants() {
            for file in ["my own.json", "a\"b\\.json"] {
                let text = start.text(Path::new(file)).unwrap();
                let json: Value = serde_json::from_str(&text).unwrap();
                let notes = json["note"].as_array().unwrap();
                let named = |note: &Value| note.as_str().unwrap().contains(file);
                assert!(notes.iter().any(named), "{text}");
                assert!(!text.contains("FILE"), "{text}");
            }
        }
    }

    #[test]
    fn each_file_of_the_folder_is_an_example() {
        let files = FILES.0.iter().filter(|(path, _)| path.starts_with("examples/start/"));
        assert_eq!(files.count(), Start::value_variants().len());
    }
}
