//! SVG paths and SVG files as they are written.
//!
//! `"svg"` is the `d` attribute of a path, or a file with its outlines:
//!
//! | key    | meaning                                                                       |
//! |--------|-------------------------------------------------------------------------------|
//! | `file` | an SVG file; its path is relative to the spec's folder                        |
//! | `id`   | id of the shape or group to read; without it all shapes of the file are read  |
//!
//! Paths, rectangles, circles, ellipses, lines, polylines and polygons are read, with their transforms, `viewBox` and
//! `use`. Texts must be turned into paths by the drawing program. Style sheets, hidden elements and `defs` are ignored.
//! The subpaths of an element are outlines and holes by its `fill-rule`, which is `nonzero` unless the element or one around
//! it says `evenodd`. Elements inside each other are outlines and holes, too: a circle drawn on a plate is a hole. A
//! `rule` beside `svg` replaces both. y points up, and the origin is
//! the lower left corner of the page; `"center": true` moves the middle of the contour there.
//!
//! If the spec has a `unit`, the drawing has its physical size in this unit: a page of `width="210mm"` is 210 wide with
//! `"unit": "mm"`, and a drawing without units has 96 pixels per inch. A spec without `unit` takes user units, the
//! numbers of the `viewBox`.

use crate::limits;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use std::borrow::Cow;
use std::fmt;

/// A path, or a file with outlines.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub(super) enum Svg {
    /// The `d` attribute of a path.
    Path(String),
    /// A file.
    File(SvgFile),
}

/// An SVG file, and the element of it that is read.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the key file, and id if it is one element"
)]
pub struct SvgFile {
    /// The file; its path is relative to the spec's folder.
    #[schemars(transform = limits::file)]
    pub file: String,
    /// Id of the element that is read; all shapes if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub id: Option<String>,
}

impl JsonSchema for Svg {
    fn schema_name() -> Cow<'static, str> {
        "Svg".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "The `d` attribute of an SVG path, or an SVG file.",
            "anyOf": [{ "type": "string" }, generator.subschema_for::<SvgFile>()],
        })
    }
}

impl<'de> Deserialize<'de> for Svg {
    fn deserialize<D: Deserializer<'de>>(reader: D) -> Result<Self, D::Error> {
        struct Visit;
        impl<'de> Visitor<'de> for Visit {
            type Value = Svg;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("the text of an SVG path, or an object with the key file")
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<Svg, E> {
                if is_name(text) {
                    let whole = serde_json::json!({ "svg": { "file": text } });
                    return Err(E::custom(format!(
                        "found the name of a file, {text:?}, expected the text of an SVG path; write {whole} for a file"
                    )));
                }
                Ok(Svg::Path(text.into()))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Svg, A::Error> {
                SvgFile::deserialize(MapAccessDeserializer::new(map)).map(Svg::File)
            }
        }
        reader.deserialize_any(Visit)
    }
}

/// Returns whether a text is the name of an SVG file. No path ends in this letter.
fn is_name(text: &str) -> bool {
    let text = text.trim().to_ascii_lowercase();
    text.ends_with(".svg") || text.ends_with(".svgz")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_of_a_file_is_no_path() {
        for name in ["profile.svg", "my drawings/a b.SVG "] {
            let said = serde_json::from_value::<Svg>(name.into()).unwrap_err().to_string();
            let parts = [format!("{name:?}"), "write {\"svg\":{\"file\":".into()];
            assert!(parts.iter().all(|part| said.contains(part)), "{said}");
        }
        assert!(matches!(serde_json::from_value("M0 0H1".into()), Ok(Svg::Path(_))));
    }
}
