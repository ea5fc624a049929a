//! The URIs of a glTF file: paths beside it, and data in base 64.

use super::Fault;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

/// Returns whether the URI holds its data.
pub(super) fn is_data(uri: &str) -> bool {
    uri.starts_with("data:")
}

/// Returns the data of a URI at a JSON path.
pub(super) fn data(uri: &str, at: &str) -> Result<Vec<u8>, Fault> {
    let fault = |found: &str| {
        Fault::part(format!("{found} at `{at}`"), "`data:`, a type, `;base64,` and data in base 64")
    };
    let (start, text) = uri.split_once(',').ok_or_else(|| fault("no comma"))?;
    if !start.ends_with(";base64") {
        return Err(fault("data that is not in base 64"));
    }
    STANDARD.decode(text.trim_ascii()).map_err(|_| fault("broken data"))
}

/// Returns the path of a URI: with `/` between folders, and with characters in place of their codes.
pub(super) fn path(uri: &str) -> String {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let code = (first == b'%').then(|| {
            let digits = std::str::from_utf8(after.get(..2)?).ok()?;
            u8::from_str_radix(digits, 16).ok()
        });
        match code.flatten() {
            Some(byte) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            None => {
                bytes.push(if first == b'\\' { b'/' } else { first });
                rest = after;
            }
        }
    }
    String::from_utf8(bytes).unwrap_or_else(|_| uri.into())
}

/// Returns the name of a file without its folders.
pub(super) fn name(file: &str) -> &str {
    file.rsplit(['/', '\\']).next().unwrap_or(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_has_its_characters_and_data_its_bytes() {
        assert_eq!(path("a%20b/c\\d%.png"), "a b/c/d%.png");
        assert_eq!(path("%ff.png"), "%ff.png");
        let found = data("data:image/png;base64,AAEC", "images[0].uri").unwrap();
        assert_eq!(found, [0, 1, 2]);
        for broken in ["data:image/png;base64", "data:text/plain,abc", "data:;base64,A"] {
            assert!(data(broken, "images[0].uri").is_err(), "{broken}");
        }
        assert_eq!(name("some/folder/a.glb"), "a.glb");
    }
}
