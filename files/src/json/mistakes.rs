//! Common mistakes in JSON texts, and files of other kinds that are given as JSON.

/// A mistake: the byte at which the text goes wrong, and the sentence about it.
pub(super) struct Mistake {
    pub(super) offset: usize,
    pub(super) message: String,
}

/// Beginnings of files of other kinds.
const KINDS: [(&[u8], &str); 13] = [
    (b"ply\n", "a PLY mesh"),
    (b"ply\r", "a PLY mesh"),
    (b"solid", "an STL mesh"),
    (b"glTF", "a GLB mesh"),
    (b"mtllib ", "an OBJ mesh"),
    (b"newmtl ", "an MTL library"),
    (b"<svg", "an SVG drawing"),
    (b"<?xml", "an XML file"),
    (b"\x89PNG", "a PNG picture"),
    (b"\xff\xd8\xff", "a JPEG picture"),
    (b"v/1\x01", "an EXR picture"),
    (b"#?RADIANCE", "an HDR picture"),
    (b"PK\x03\x04", "a ZIP archive"),
];

/// Keywords with which the lines of an OBJ mesh begin.
const OBJ: [&str; 9] = ["v", "vn", "vt", "f", "o", "g", "s", "mtllib", "usemtl"];

/// Lines in which an OBJ mesh is recognized, after comments and empty lines.
const LINES: usize = 100;

/// Returns the kind of a file that is no JSON, with its article, if it is known.
pub(super) fn other_kind(bytes: &[u8]) -> Option<&'static str> {
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    if let Some((_, kind)) = KINDS.iter().find(|(begin, _)| start.starts_with(begin)) {
        return Some(kind);
    }
    let mut lines = start.split(|&byte| byte == b'\n').take(LINES).map(<[u8]>::trim_ascii);
    let line = lines.find(|line| !line.is_empty() && !line.starts_with(b"#"))?;
    let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
    let keyword = words.next()?;
    let is_obj = OBJ.iter().any(|known| known.as_bytes() == keyword) && words.next().is_some();
    is_obj.then_some("an OBJ mesh")
}

/// Finds the mistake in a text that is no JSON. `offset` is the byte at which its reading stopped.
pub(super) fn find(text: &str, offset: usize) -> Option<Mistake> {
    if let Some(kind) = other_kind(text.as_bytes()) {
        let start = text.len() - text.trim_start().len();
        let message = format!("found {kind}, expected JSON text");
        return Some(Mistake { offset: start, message });
    }
    let rest = text.get(offset..)?;
    for (begin, found) in [("//", "a comment"), ("/*", "a comment"), ("#", "a comment")] {
        if rest.starts_with(begin) {
            let message = format!("found {found}, expected none: JSON has no comments");
            return Some(Mistake { offset, message });
        }
    }
    // Reading may stop within the word, or behind its sign.
    let letters = |c: char| c.is_ascii_alphabetic() || c == '-' || c == '+';
    let begin = text[..offset].trim_end_matches(letters).len();
    let word = text[begin..].trim_start_matches(['-', '+']);
    let end = word.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(word.len());
    if ["nan", "infinity", "inf"].contains(&word[..end].to_ascii_lowercase().as_str()) {
        let word = &word[..end];
        let message = format!("found {word}, expected a number, which is finite in JSON");
        return Some(Mistake { offset: begin, message });
    }
    if rest.starts_with('\'') {
        let message = "found a single quote, expected double quotes around keys and texts".into();
        return Some(Mistake { offset, message });
    }
    // A comma before a closing bracket. Reading may stop before the comma, at it, or at the bracket.
    let begin = text[..offset].trim_end().trim_end_matches(',').len();
    let behind = text[begin..].find(',').map(|at| begin + at)?;
    let is_next = text[begin..behind].chars().filter(|c| !c.is_whitespace()).count() <= 1;
    let is_last = text[behind + 1..].trim_start().starts_with(['}', ']']);
    let message = "found a comma after the last value, expected none".into();
    (is_next && is_last).then_some(Mistake { offset: behind, message })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_other_kinds_are_named() {
        for (bytes, kind) in [
            (&b"# Blender\no Cube\nv 1 2 3\n"[..], Some("an OBJ mesh")),
            (b"\n\nv 1 2 3", Some("an OBJ mesh")),
            (b"ply\nformat ascii 1.0\n", Some("a PLY mesh")),
            (b"\xef\xbb\xbf<?xml version", Some("an XML file")),
            (b"\x89PNG\r\n", Some("a PNG picture")),
            (b"{ \"format\": 1 }", None),
            (b"some words", None),
            (b"# a comment\n{}", None),
            (b"", None),
        ] {
            assert_eq!(other_kind(bytes), kind);
        }
    }
}
