//! Descriptions of files that are not grids, so that messages can state a remedy.

/// Descriptions of files known by their first bytes.
const KNOWN: [(&[u8], &str); 9] = [
    (b"\x89PNG", "it is a PNG picture"),
    (b"\xff\xd8\xff", "it is a JPEG picture"),
    (b"v/1\x01", "it is an EXR picture"),
    (b"\x1f\x8b", "it is compressed; unpack it first"),
    (b"\xef\xbb\xbf", "it starts with the byte order mark of a text editor"),
    (b"\xff\xfe", "it is UTF-16 text; a program changed the encoding after `sweep` wrote the grid"),
    (b"ply", "it is a PLY mesh, which has triangles already"),
    (b"solid ", "it is an STL mesh, which has triangles already"),
    (b"[", "it is JSON without the header line of a grid"),
];

/// First words of the lines that an OBJ file may start with.
const OBJ_WORDS: [&str; 9] = ["#", "o", "g", "v", "vt", "vn", "f", "mtllib", "usemtl"];

/// Description of JSON that does not state that it is a grid.
pub(super) const OTHER_JSON: &str = "it is JSON without \"format\":\"tb-grid\" in its first line; \
                                     if it is a curve spec, `sweep` makes its grid";

/// Describes a file that starts with `bytes`, which do not start with a brace.
pub(super) fn described(bytes: &[u8]) -> String {
    if let Some((_, what)) = KNOWN.iter().find(|(magic, _)| bytes.starts_with(magic)) {
        return format!("{what}; expected a grid as `sweep` writes it");
    }
    let start = bytes.trim_ascii_start();
    if start.starts_with(b"{") {
        return OTHER_JSON.into();
    }
    let word = start.split(u8::is_ascii_whitespace).next().unwrap_or_default();
    if OBJ_WORDS.iter().any(|known| known.as_bytes() == word) {
        return "it looks like an OBJ mesh, which has triangles already; `render` reads it".into();
    }
    let found = bytes[..bytes.len().min(16)].escape_ascii();
    format!("it starts with \"{found}\", expected {{\"format\":\"tb-grid\" and so on")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn well_known_files_are_called_by_their_names() {
        assert!(described(b"\x89PNG\r\n\x1a\n").contains("PNG picture"));
        assert!(described(b"# Blender 5\nv 0 0 0\n").contains("OBJ mesh"));
        assert!(described(b"v 0 0 0\n").contains("OBJ mesh"));
        assert!(described(b"ply\nformat ascii 1.0\n").contains("a PLY mesh"));
        assert!(described(b"  {\n").contains("curve spec"));
        assert!(described(b"\x00\x01").contains(r"\x00\x01"));
    }
}
