//! Rewrites serde's complaints about a wrong value for people who write JSON and not Rust.
//!
//! serde has no error codes, so its sentences are rewritten piece by piece. A piece that is not
//! known here stays unchanged, and the result is still a sentence.

use super::{nearest, shortened};

/// Sentences that are replaced as a whole.
const SENTENCES: [(&str, &str); 16] = [
    ("EOF while parsing a list", "found the end of the text inside an array, expected `]`"),
    ("EOF while parsing an object", "found the end of the text inside an object, expected `}`"),
    ("EOF while parsing a string", "found the end of the text inside a string, expected `\"`"),
    ("EOF while parsing a value", "found the end of the text, expected a value"),
    (
        "control character (\\u0000-\\u001F) found while parsing a string",
        "found a control character inside a string, expected \\u and the number of the character",
    ),
    ("expected ident", "found an unknown word, expected true, false or null"),
    ("expected value", "expected a value"),
    ("invalid escape", "found a backslash that begins no escape, expected `\\\\` for a backslash"),
    ("invalid number", "found a number in a notation that JSON does not have"),
    ("key must be a string", "expected a key in double quotes"),
    ("lone leading surrogate in hex escape", "found half of a pair of \\u escapes, expected both"),
    ("number out of range", "found a number out of range"),
    ("recursion limit exceeded", "found brackets nested more than a hundred deep"),
    ("unexpected end of hex escape", "found half of a pair of \\u escapes, expected both"),
    ("trailing characters", "found more text after the end of the JSON, expected nothing"),
    ("trailing comma", "found a comma after the last value, expected none"),
];

/// Pieces that describe the found value.
const FOUND: [(&str, &str); 13] = [
    ("invalid type: ", "found "),
    ("invalid value: ", "found "),
    ("found floating point `", "found the number `"),
    ("found integer `", "found the number `"),
    ("found boolean `", "found `"),
    ("found string ", "found the string "),
    ("found map", "found an object"),
    ("found unit variant", "found a name alone"),
    ("found newtype variant", "found an object"),
    ("found tuple variant", "found an object"),
    ("found struct variant", "found an object"),
    ("found unit value", "found null"),
    ("found sequence", "found an array"),
];

/// Pieces that describe the expected value.
const EXPECTED: [(&str, &str); 11] = [
    ("expected f64", "expected a number"),
    ("expected f32", "expected a number"),
    ("expected usize", "expected a whole number of at least 0"),
    ("expected u64", "expected a whole number of at least 0"),
    ("expected u32", "expected a whole number of at least 0"),
    ("expected u16", "expected a whole number from 0 to 65535"),
    ("expected u8", "expected a whole number from 0 to 255"),
    ("expected i64", "expected a whole number"),
    ("expected i32", "expected a whole number"),
    ("expected a boolean", "expected true or false"),
    ("expected a sequence", "expected an array"),
];

/// Beginnings of the expected value in serde's sentences, before the type's name in Rust.
const KINDS: [(&str, &str); 12] = [
    ("expected struct", "expected an object"),
    ("expected newtype", "expected an object with the value of this key"),
    ("expected tuple", "expected an array"),
    ("expected a tuple of size", "expected an array"),
    ("expected enum", "expected a name, or an object with one key"),
    ("expected string or map", "expected a name, or an object with one key"),
    ("expected unit", "expected the name alone"),
    ("expected a map", "expected an object"),
    ("expected map", "expected an object"),
    ("expected option", "expected a value, or null"),
    ("expected variant identifier", "expected a name"),
    ("expected field identifier", "expected a key"),
];

/// Returns serde's message in plain words, with a suggestion for a misspelt key.
pub(crate) fn plain(message: &str) -> String {
    if let Some((_, words)) = SENTENCES.iter().find(|(serdes, _)| *serdes == message) {
        return (*words).into();
    }
    // Only serde's own words are rewritten, never the user's text between quotes.
    let (found, expected) = message.rsplit_once(", expected ").unwrap_or((message, ""));
    if let Some(length) = found.strip_prefix("invalid length ") {
        let fixed = ["an array of length ", "a tuple of size "];
        let count = fixed.iter().find_map(|serdes| expected.strip_prefix(serdes));
        let kind = KINDS.iter().find(|(serdes, _)| {
            serdes.strip_prefix("expected ").is_some_and(|serdes| expected.starts_with(serdes))
        });
        let kind = kind.and_then(|(_, words)| words.strip_prefix("expected "));
        return format!("found {length} values, expected {}", count.or(kind).unwrap_or(expected));
    }
    let mut text = shortened(found);
    for (serdes, words) in FOUND {
        if let Some(rest) = text.strip_prefix(serdes) {
            text = format!("{words}{rest}");
        }
    }
    for (serdes, words) in [
        ("unknown field", "unknown key"),
        ("missing field", "missing key"),
        ("duplicate field", "duplicate key"),
        ("unknown variant", "found"),
    ] {
        if let Some(rest) = text.strip_prefix(serdes) {
            text = format!("{words}{rest}");
        }
    }
    if !expected.is_empty() {
        let expected = format!("expected {expected}");
        let words = EXPECTED.iter().find(|(serdes, _)| *serdes == expected);
        let kind = KINDS.iter().find(|(serdes, _)| expected.starts_with(serdes));
        let words = words.or(kind).map_or(expected.as_str(), |(_, words)| words);
        text.push_str(&format!(", {words}"));
    }
    if message.starts_with("unknown ") {
        let mut names = message.split('`').skip(1).step_by(2);
        if let Some(found) = names.next()
            && let Some(near) = nearest(found, names)
        {
            text.push_str(&format!(" (did you mean `{near}`?)"));
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;

    /// Returns the complaint about a text that is not a list of points.
    fn complaint(text: &str) -> String {
        let error = serde_json::from_str::<Vec<[f64; 2]>>(text).unwrap_err().to_string();
        plain(error.rsplit_once(" at line ").unwrap().0)
    }

    #[test]
    fn wrong_values_are_called_as_json_calls_them() {
        for (text, expected) in [
            ("{}", "found an object, expected an array"),
            ("[1]", "found the number `1`, expected an array of length 2"),
            ("[[true, 0]]", "found `true`, expected a number"),
            ("[[null, 0]]", "found null, expected a number"),
            ("[[[], 0]]", "found an array, expected a number"),
            ("[[1]]", "found 1 values, expected 2"),
            ("[[1, 2]", "found the end of the text inside an array, expected `]`"),
            ("[[\"integer `\", 2]]", "found the string \"integer `\", expected a number"),
            ("[nul]", "found an unknown word, expected true, false or null"),
            ("[[1, 1e999]]", "found a number out of range"),
            ("[[1, 2],]", "found a comma after the last value, expected none"),
        ] {
            assert_eq!(complaint(text), expected, "{text}");
        }
        let deep = "[".repeat(300);
        assert!(serde_json::from_str::<serde_json::Value>(&deep).is_err_and(|error| {
            plain(error.to_string().rsplit_once(" at line ").unwrap().0)
                .starts_with("found brackets")
        }));
    }

    #[test]
    fn a_page_of_text_is_not_said_back() {
        let text = complaint(&format!("[[\"{}\", 1]]", "blah ".repeat(1000)));
        assert!(text.chars().count() < 160 && text.ends_with(", expected a number"), "{text}");
    }

    #[test]
    fn numbers_that_are_counts_are_called_whole() {
        #[derive(Debug, Deserialize)]
        struct Counts {
            #[expect(dead_code, reason = "only its reading is tested")]
            rows: u64,
        }
        let error = serde_json::from_str::<Counts>("[]").unwrap_err().to_string();
        let words = plain(error.rsplit_once(" at line ").unwrap().0);
        assert_eq!(words, "found 0 values, expected an object");
        for text in ["{\"rows\": -1}", "{\"rows\": 1.5}"] {
            let error = serde_json::from_str::<Counts>(text).unwrap_err().to_string();
            let words = plain(error.rsplit_once(" at line ").unwrap().0);
            assert!(words.starts_with("found the number `"), "{words}");
            assert!(words.ends_with(", expected a whole number of at least 0"), "{words}");
        }
    }
}
