//! Reads JSON into typed values, and gives every complaint its position in the text.
//!
//! A [`Document`] is a text and the name of its file. [`Document::parse`] reads the text into a value.
//! Complaints about unknown keys, wrong types and syntax errors carry line, column and path. For a
//! misspelt key, the complaint suggests a known one. Checks that only the reader of the value can make
//! (a radius must be positive) go through [`Document::fault`], which finds the position from the path.

mod mistakes;
mod path;

pub use crate::words::nearest;

use crate::{Exit, Failure, words};
use mistakes::Mistake;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_path_to_error::{Path, Segment};
use thiserror::Error;

/// Most bytes that the values of a JSON text take for each byte of the text. A number of one digit
/// and its comma are 2 bytes. As a value of unknown type they take 32 bytes, and an array of such
/// values twice that while it grows. The tree that gives a complaint its position takes as much
/// again. The largest measured ratio was 43.
pub const BYTES_OF_A_BYTE: u64 = 48;

/// Most characters of a message. A longer message is cut in its middle.
const LONGEST_MESSAGE: usize = 440;

/// An error in a JSON text, with its position.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{file}:{line}:{column}: {}{message}", if path.is_empty() { String::new() } else { format!("{path}: ") })]
pub struct JsonError {
    /// The file as the user named it.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// The path of the value, such as `contour.bezier[0][2]`; empty at the root.
    pub path: String,
    /// The found and the expected value, in words.
    pub message: String,
}

impl Failure for JsonError {
    fn exit(&self) -> Exit {
        Exit::Malformed
    }
}

/// A JSON text and the name of its file.
#[derive(Debug, Clone, Copy)]
pub struct Document<'a> {
    /// The file as the user named it; part of every message.
    pub file: &'a str,
    text: &'a str,
}

impl<'a> Document<'a> {
    /// Makes a document from the bytes of a file. A byte order mark is skipped.
    ///
    /// # Errors
    /// When the bytes are not UTF-8 text, or are empty.
    pub fn new(file: &'a str, bytes: &'a [u8]) -> Result<Self, JsonError> {
        let at = |(line, column), message: String| JsonError {
            file: file.into(),
            line,
            column,
            path: String::new(),
            message,
        };
        let text = std::str::from_utf8(bytes).map_err(|error| {
            if let Some(kind) = mistakes::other_kind(bytes) {
                return at((1, 1), format!("found {kind}, expected JSON text"));
            }
            let good = bytes.get(..error.valid_up_to()).unwrap_or_default();
            let good = String::from_utf8_lossy(good);
            let place = place(good.strip_prefix('\u{feff}').unwrap_or(&good));
            at(place, "found bytes that are not UTF-8, expected JSON text".into())
        })?;
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        if text.trim().is_empty() {
            return Err(at((1, 1), "found nothing, expected a JSON object".into()));
        }
        Ok(Self { file, text })
    }

    /// Parses the whole text as a value.
    ///
    /// # Errors
    /// On a syntax error, an unknown key, a missing key or a value of the wrong type.
    pub fn parse<T: DeserializeOwned>(&self) -> Result<T, JsonError> {
        let mut reader = serde_json::Deserializer::from_str(self.text);
        let value = serde_path_to_error::deserialize(&mut reader).map_err(|error| {
            let path = path_text(error.path());
            self.serde_error(path, error.inner())
        })?;
        reader.end().map_err(|error| self.serde_error(String::new(), &error))?;
        Ok(value)
    }

    /// Checks the keys `format` and `version` and ignores all other keys.
    ///
    /// Call this before [`Document::parse`], so that a file of another kind is reported as such.
    /// Otherwise the parser would take its keys for misspelt ones. A text without these keys passes,
    /// and [`Document::parse`] reports the missing keys.
    ///
    /// # Errors
    /// When one of the two keys has another value.
    pub fn expect(&self, format: &str, version: u64) -> Result<(), JsonError> {
        let Ok(Head { format: found_format, version: found_version }) = self.parse() else {
            return Ok(());
        };
        if let Some(found) = found_format.filter(|found| found != format) {
            let found = words::shortened(&found.to_string());
            let hint = reader_of(&found).map_or_else(String::new, |reader| format!(": {reader}"));
            let message = format!("found {found}, expected \"{format}\"{hint}");
            return Err(self.fault("format", message));
        }
        if let Some(found) = found_version.filter(|found| *found != version) {
            let found = words::shortened(&found.to_string());
            return Err(self.fault("version", format!("found {found}, expected {version}")));
        }
        Ok(())
    }

    /// Makes a complaint about the value at `path`. `message` states the found and the expected
    /// value.
    ///
    /// Where `path` leads to a missing key, the position is that of the deepest value on the path that
    /// exists.
    #[must_use]
    pub fn fault(&self, path: &str, message: impl Into<String>) -> JsonError {
        let offset = path::offset_of(self.text, path).unwrap_or(0);
        let (line, column) = place(&self.text[..offset]);
        JsonError {
            file: self.file.into(),
            line,
            column,
            path: words::shortened(path),
            message: words::cut(&message.into(), LONGEST_MESSAGE).to_string(),
        }
    }

    /// Returns the byte of a line and column by serde: lines count from 1, and columns are bytes from 1.
    fn offset_of(&self, line: usize, column: usize) -> usize {
        let mut starts = self.text.match_indices('\n').map(|(at, _)| at + 1);
        let start = if line <= 1 { 0 } else { starts.nth(line - 2).unwrap_or(self.text.len()) };
        let mut offset = (start + column.saturating_sub(1)).min(self.text.len());
        while !self.text.is_char_boundary(offset) {
            offset -= 1;
        }
        offset
    }

    fn serde_error(&self, path: String, error: &serde_json::Error) -> JsonError {
        let stopped = self.offset_of(error.line(), error.column());
        if !error.is_data()
            && let Some(Mistake { offset, message }) = mistakes::find(self.text, stopped)
        {
            let (line, column) = place(&self.text[..offset]);
            return JsonError {
                file: self.file.into(),
                line,
                column,
                path: String::new(),
                message,
            };
        }
        let message = error.to_string();
        let message = message.rsplit_once(" at line ").map_or(message.as_str(), |(text, _)| text);
        let of_value = match message {
            _ if path.is_empty() => None,
            // serde's message when, for example, a point of three numbers has a fourth.
            "trailing characters" => Some("found more values than expected".into()),
            // serde's message for another value in place of a name.
            "expected value" => path::kind_at(self.text, &path)
                .map(|kind| format!("found {kind}, expected a name in quotes")),
            _ => None,
        };
        let is_of_value = error.is_data() || of_value.is_some();
        let message = of_value.unwrap_or_else(|| words::plain(message));
        // serde's column is where reading stopped. The position of the value itself is better, provided
        // the text is complete enough to find it.
        if !path.is_empty() && is_of_value {
            let fault = self.fault(&path, message.as_str());
            if (fault.line, fault.column) != (1, 1) {
                return fault;
            }
        }
        let (line, column) = place(&self.text[..stopped]);
        JsonError {
            file: self.file.into(),
            line,
            column,
            path: words::shortened(&path),
            message: words::cut(&message, LONGEST_MESSAGE).to_string(),
        }
    }
}

/// Returns line and column of the character after a text, both from 1.
fn place(before: &str) -> (usize, usize) {
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    (1 + before.matches('\n').count(), 1 + before[line_start..].chars().count())
}

/// The keys that begin every file of this project.
#[derive(Deserialize)]
struct Head {
    format: Option<serde_json::Value>,
    version: Option<serde_json::Value>,
}

/// Returns the path as `a.b[2].c`, up to the first segment that serde could not name.
fn path_text(path: &Path) -> String {
    let known = path.iter().take_while(|segment| !matches!(segment, Segment::Unknown));
    let mut text = String::new();
    for segment in known {
        match segment {
            Segment::Seq { index } => text.push_str(&format!("[{index}]")),
            Segment::Map { key } => push_key(&mut text, key),
            Segment::Enum { variant } => push_key(&mut text, variant),
            Segment::Unknown => {}
        }
    }
    text
}

fn push_key(text: &mut String, key: &str) {
    if !text.is_empty() {
        text.push('.');
    }
    text.push_str(key);
}

/// Returns words on which program reads a format, whose name is given with its quotes.
fn reader_of(format: &str) -> Option<&'static str> {
    match format.trim_matches('"') {
        "tb-sweep" => Some("`pipeline show` makes a picture of a spec, and `sweep` its grid"),
        "tb-scene" => Some("`render` makes a picture of a scene"),
        "tb-scene-part" => Some("a scene takes its parts with the key `include`"),
        "tb-job" => Some("`pipeline run` makes the pictures of a job"),
        "tb-grid" => Some("`triangulate` makes the triangles of a grid"),
        "tb-areas" => Some("`triangulate --areas` reads areas"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Spec {
        #[expect(dead_code, reason = "only its reading is tested")]
        contour: Contour,
    }

    #[derive(Debug, Deserialize)]
    #[serde(rename_all = "snake_case")]
    #[expect(dead_code, reason = "only its reading is tested")]
    enum Contour {
        Circle(f64),
        Free(Vec<[f64; 2]>),
    }

    fn complaint(text: &str) -> String {
        let document = match Document::new("a.json", text.as_bytes()) {
            Ok(document) => document,
            Err(error) => return error.to_string(),
        };
        document.parse::<Spec>().unwrap_err().to_string()
    }

    #[test]
    fn a_wrong_type_is_placed() {
        let text = "{\"contour\":\n {\"free\": [[0, 0], [1, \"x\"]]}}";
        assert_eq!(
            complaint(text),
            "a.json:2:24: contour.free[1][1]: found the string \"x\", expected a number"
        );
    }

    #[test]
    fn a_value_in_place_of_a_name_is_named() {
        #[derive(Debug, Deserialize)]
        #[serde(rename_all = "snake_case")]
        enum Side {
            Left,
        }
        for (value, found) in [
            ("-1", "a number"),
            ("[]", "a list"),
            ("true", "true"),
            ("{}", "an object without a name"),
        ] {
            let text = format!("{{\"side\":\n {value}}}");
            let document = Document::new("a.json", text.as_bytes()).unwrap();
            let error = document.parse::<std::collections::BTreeMap<String, Side>>().unwrap_err();
            let expected = format!("a.json:2:2: side: found {found}, expected a name in quotes");
            assert_eq!(error.to_string(), expected);
        }
        assert!(matches!(serde_json::from_str("\"left\""), Ok(Side::Left)));
    }

    #[test]
    fn an_unknown_key_is_met_with_a_suggestion() {
        let text = complaint("{\"contuor\": {\"circle\": 1}}");
        assert!(text.contains("did you mean `contour`?"), "{text}");
        assert!(text.starts_with("a.json:1:13: contuor: unknown key"), "{text}");
        let text = complaint("{\"contour\": {\"cirlce\": 1}}");
        assert!(text.contains("did you mean `circle`?"), "{text}");
    }

    #[test]
    fn a_key_in_broken_text_is_placed_where_reading_stopped() {
        let text = complaint("{\n \"contuor\": 1, }}");
        assert!(text.starts_with("a.json:2:10: contuor: unknown key"), "{text}");
    }

    #[test]
    fn common_mistakes_are_named_where_they_are() {
        for (text, expected) in [
            ("{\"contour\": // round\n{}}", "a.json:1:13: found a comment"),
            ("/* a */ {}", "a.json:1:1: found a comment"),
            ("{\n  # round\n}", "a.json:2:3: found a comment"),
            ("{\"contour\": {\"circle\": NaN}}", "a.json:1:24: found NaN, expected a number"),
            ("{\"contour\": {\"circle\": -Infinity}}", "a.json:1:24: found Infinity"),
            ("{\"contour\": {\"circle\": 1,}}", "a.json:1:25: found a comma after the last value"),
            ("{\"contour\": {\"free\": [[1, 2], ]}}", "a.json:1:29: found a comma"),
            ("{'contour': 1}", "a.json:1:2: found a single quote"),
            ("# mesh\nv 1 2 3\nf 1 1 1\n", "a.json:1:1: found an OBJ mesh, expected JSON text"),
            ("ply\nformat ascii 1.0\n", "a.json:1:1: found a PLY mesh"),
        ] {
            let complaint = complaint(text);
            assert!(complaint.starts_with(expected), "{text}: {complaint}");
        }
        let text = "{\"ü\": \"ü\", \"b\" 1}";
        let error = Document::new("b", text.as_bytes()).unwrap().parse::<serde_json::Value>();
        assert_eq!(error.unwrap_err().column, 16, "columns are characters");
        let bytes = [&b"{\n  \"n\": \"\xc3\xbc"[..], b"\xff\"}"].concat();
        let error = Document::new("b", &bytes).unwrap_err();
        assert_eq!((error.line, error.column), (2, 10));
    }

    #[test]
    fn one_number_too_many_is_said_in_words() {
        let text = complaint("{\"contour\": {\"free\": [[0, 0, 0]]}}");
        assert_eq!(text, "a.json:1:23: contour.free[0]: found more values than expected");
    }

    #[test]
    fn numbers_that_are_not_finite_are_refused() {
        for number in ["NaN", "1e400", "Infinity", "-inf"] {
            let text = complaint(&format!("{{\"contour\": {{\"circle\": {number}}}}}"));
            assert!(text.starts_with("a.json:1:"), "{text}");
        }
    }

    #[test]
    fn empty_text_broken_bytes_and_trailing_text_are_refused() {
        assert_eq!(complaint(" "), "a.json:1:1: found nothing, expected a JSON object");
        let error = Document::new("b", b"{}\n\xff").unwrap_err();
        assert_eq!(error.line, 2);
        let text = complaint("{\"contour\": {\"circle\": 1}} x");
        assert!(text.contains("found more text"), "{text}");
    }

    #[test]
    fn a_file_of_another_kind_is_told_by_its_format() {
        let expect = |text: &str| {
            let document = Document::new("a.json", text.as_bytes()).unwrap();
            document.expect("tb-sweep", 1).map_err(|error| error.to_string())
        };
        assert_eq!(expect("{\"format\": \"tb-sweep\", \"version\": 1, \"x\": []}"), Ok(()));
        assert_eq!(
            expect("{\"camera\": {}, \"format\": \"tb-scene\"}").unwrap_err(),
            "a.json:1:26: format: found \"tb-scene\", expected \"tb-sweep\": `render` makes a picture of a scene"
        );
        assert_eq!(
            expect("{\"version\": 2}").unwrap_err(),
            "a.json:1:13: version: found 2, expected 1"
        );
        assert_eq!(expect("{\"version\":"), Ok(()));
    }

    #[test]
    fn a_fault_finds_its_place_by_path() {
        let text = "{\n  \"contour\": {\"free\": [[0, 0],\n   [1, 7]]}}";
        let document = Document::new("a.json", text.as_bytes()).unwrap();
        let fault = document.fault("contour.free[1][1]", "found 7, expected less than 2");
        assert_eq!((fault.line, fault.column), (3, 8));
        let missing = document.fault("contour.radius", "missing");
        assert_eq!((missing.line, missing.column), (2, 14));
    }
}
