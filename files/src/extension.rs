//! Refuses output names whose extension contradicts the content.

use crate::{Exit, Failure};
use std::path::Path;
use thiserror::Error;

/// Extensions of known formats, our own and those of other tools. Users expect a file with such an
/// extension to hold that format.
const KNOWN: [&str; 42] = [
    "grid", "json", "obj", "mtl", "stl", "ply", "png", "exr", "svg", "html", "csv", // ours
    "glb", "gltf", "fbx", "dae", "3ds", "3mf", "blend", "usd", "usda", "usdc", "usdz", "abc",
    "x3d", "wrl", "off", "step", "stp", "iges", "igs", // other surfaces
    "jpg", "jpeg", "gif", "bmp", "tif", "tiff", "webp", "hdr", "pdf", // other pictures
    "zip", "gz", "zst", // packed
];

/// An output whose extension promises another format than the content.
#[derive(Debug, Error)]
#[error("{name} would hold {content}, but its extension names another format: expected {expected}")]
pub struct WrongExtension {
    name: String,
    content: &'static str,
    expected: String,
}

impl Failure for WrongExtension {
    fn exit(&self) -> Exit {
        Exit::Use
    }
}

/// Checks that the extension of an output does not contradict its content. `content` describes the
/// content ("an OBJ mesh") and `extensions` lists the extensions that it may have, in lowercase and
/// without a dot. An output without an extension, or with an unknown one, may hold any content. So may
/// standard output (`-`).
///
/// # Errors
/// When the extension is known and not one of `extensions`; case is ignored.
pub fn check(
    output: &Path,
    content: &'static str,
    extensions: &[&str],
) -> Result<(), WrongExtension> {
    let Some(found) = output.extension() else { return Ok(()) };
    let found = found.to_string_lossy().to_ascii_lowercase();
    if extensions.contains(&found.as_str()) || !KNOWN.contains(&found.as_str()) {
        return Ok(());
    }
    let dotted: Vec<String> = extensions.iter().map(|extension| format!(".{extension}")).collect();
    let (name, expected) = (output.display().to_string(), dotted.join(" or "));
    Err(WrongExtension { name, content, expected })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_extension_of_another_format_is_refused() {
        for name in ["a.glb", "b/a.PNG", "a.obj.gz"] {
            let error = check(Path::new(name), "an OBJ mesh", &["obj"]).unwrap_err();
            assert_eq!(error.exit(), Exit::Use);
            let expected =
                "would hold an OBJ mesh, but its extension names another format: expected .obj";
            assert_eq!(error.to_string(), format!("{name} {expected}"));
        }
    }

    #[test]
    fn no_extension_and_one_of_no_known_format_are_taken() {
        for name in ["-", "a", "a.obj", "A.OBJ", "a.new", "png", ".png", "a.png.1", "/dev/null"] {
            assert!(check(Path::new(name), "an OBJ mesh", &["obj"]).is_ok(), "{name}");
        }
    }
}
