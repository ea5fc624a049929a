//! The JSON of a glTF file and its binary chunk: a GLB holds both, and a `.gltf` the JSON alone.

use super::Fault;
use gltf::Document;
use gltf::json::validation::{Error, Validate};
use gltf::json::{Path, Root, deserialize};

/// First bytes of a GLB.
pub(super) const MAGIC: &[u8] = b"glTF";

/// Bytes of the header of a GLB, and of the header of a chunk.
const HEADER: usize = 12;
const CHUNK: usize = 8;

/// Extensions that a file may require: our reader knows them, or they change the appearance alone.
const TAKEN: [&str; 5] = [
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "EXT_texture_webp",
    "KHR_materials_",
    "KHR_technique",
];

/// Extensions whose content is used.
pub(super) const USED: [&str; 4] = [
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "EXT_texture_webp",
    "KHR_materials_emissive_strength",
];

/// Reads the JSON of a file and checks it. Returns the document and the binary chunk of a GLB.
pub(super) fn read(bytes: &[u8]) -> Result<(Document, Option<&[u8]>), Fault> {
    let (json, chunk) = if bytes.starts_with(MAGIC) { chunks(bytes)? } else { (bytes, None) };
    let json = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
    let mut root: Root = match deserialize::from_slice(json) {
        Ok(root) => root,
        Err(error) => return Err(json_fault(json, &error)),
    };
    if !root.asset.version.starts_with("2.") {
        let found = format!("version `{}` at `asset.version`", shown(&root.asset.version));
        return Err(Fault::part(found, "2.0"));
    }
    let required = std::mem::take(&mut root.extensions_required);
    let is_taken = |name: &&String| TAKEN.iter().any(|taken| name.starts_with(taken));
    if let Some(name) = required.iter().find(|name| !is_taken(name)) {
        let found = format!("the required extension `{}`", shown(name));
        let expected = "a file without it, since it holds the mesh in a form that is not read";
        return Err(Fault::part(found, expected));
    }
    // The crate's own rules use these indices before they are checked.
    for (m, mesh) in root.meshes.iter().enumerate() {
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            let count = root.accessors.len();
            if let Some(index) = primitive.attributes.values().find(|index| index.value() >= count)
            {
                let found =
                    format!("index {} at `meshes[{m}].primitives[{p}].attributes`", index.value());
                return Err(Fault::part(found, format!("one of the {count} accessors")));
            }
        }
    }
    let mut first = None;
    root.validate(&root, Path::new, &mut |path, error| {
        let path = path().to_string();
        // Bounds of positions help viewers, and are often left out.
        let is_bound = path.ends_with(".min") || path.ends_with(".max");
        // Rows without a view are zero.
        let is_view = path.starts_with("accessors[") && path.ends_with("].bufferView");
        let is_optional = is_bound || is_view || path.contains("POSITION");
        if !(matches!(error, Error::Missing) && is_optional) {
            first.get_or_insert((path, error));
        }
    });
    if let Some((path, error)) = first {
        let (found, expected) = match error {
            Error::IndexOutOfBounds => ("an index", "an index of an entry that the file has"),
            Error::Missing => ("nothing", "a value, which glTF 2.0 asks for"),
            Error::Oversize => ("a number", "a smaller one"),
            Error::Invalid | Error::Unsupported => ("a value", "a value that glTF 2.0 knows"),
        };
        return Err(Fault::part(format!("{found} at `{}`", shown(&path)), expected));
    }
    Ok((Document::from_json_without_validation(root), chunk))
}

/// Splits a GLB into its JSON and its binary chunk.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), Fault> {
    let word = |at: usize| Some(u32::from_le_bytes(*bytes.get(at..at + 4)?.first_chunk()?));
    let end = || Fault::byte(bytes.len(), "the end of the file", "the header of a GLB");
    let version = word(4).ok_or_else(end)?;
    if version != 2 {
        return Err(Fault::byte(4, format!("version {version}"), "version 2 of GLB"));
    }
    let length = word(8).ok_or_else(end)? as usize;
    if length > bytes.len() {
        let expected = format!("{length} bytes, as the header says; the file is cut off");
        return Err(Fault::byte(bytes.len(), "the end of the file", expected));
    }
    let chunk = |at: usize, kind: &[u8; 4]| -> Result<Option<&[u8]>, Fault> {
        let (Some(size), Some(found)) = (word(at), bytes.get(at + 4..at + CHUNK)) else {
            return Ok(None);
        };
        if found != kind {
            return Ok(None);
        }
        let start = at + CHUNK;
        let chunk = bytes.get(start..).and_then(|rest| rest.get(..size as usize));
        let expected = || format!("at most the {} bytes that are left", bytes.len() - start);
        chunk
            .map(Some)
            .ok_or_else(|| Fault::byte(at, format!("a chunk of {size} bytes"), expected()))
    };
    let json = chunk(HEADER, b"JSON")?;
    let json = json.ok_or_else(|| Fault::byte(HEADER, "another chunk", "a chunk of JSON"))?;
    // Chunks fill up to whole words; some programs leave out the filling.
    let after = HEADER + CHUNK + json.len();
    let binary = match chunk(after.next_multiple_of(4), b"BIN\0")? {
        None => chunk(after, b"BIN\0")?,
        found => found,
    };
    Ok((json, binary))
}

/// Returns the fault of JSON that is no glTF.
fn json_fault(json: &[u8], error: &gltf::json::Error) -> Fault {
    let (line, column) = (error.line(), error.column());
    // Version 1.0 has objects where version 2.0 has lists.
    let is_old = json.windows(12).any(|part| part == b"\"techniques\"");
    let expected = if is_old {
        "glTF 2.0; the file seems to be of version 1.0"
    } else {
        "the keys and values of glTF 2.0"
    };
    Fault::part(format!("a fault of the JSON at line {line}, column {column}"), expected)
}

pub(super) fn shown(text: &str) -> String {
    crate::scene::obj::shortened(text)
}
