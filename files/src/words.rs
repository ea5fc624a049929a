//! Makes names and values safe to print: without characters that steer a terminal, and cut if they
//! are long.
//!
//! Names come from files of strangers. [`shown`] is for a name or a value inside a sentence or a
//! list: the result is one line of limited length. [`printed`] is for text of several lines that is
//! printed whole. Both spell out control characters, invisible characters, and characters that
//! reverse the direction of the text: `\u{202e}` is shown as those eight letters.

mod plain;

use std::borrow::Cow;
use std::fmt::{self, Display, Write};

pub(crate) use plain::plain;

/// Quoted text longer than twice this many characters is cut in the middle of a message. A message
/// gives the position by line and column; the text only helps to recognize it.
const LONGEST_QUOTE: usize = 60;

/// Most characters of a line, with everything that is quoted in it.
const LONGEST_LINE: usize = 1000;

/// Most characters of a list of known names in a message, where the user chose the names.
pub const LONGEST_LIST: usize = 300;

/// Names longer than this many characters are not compared with known names. The time of a
/// comparison is the product of both lengths, for each known name.
const LONGEST_SLIP: usize = 200;

/// Returns a name or a value for a message, on one line. Invisible characters are spelled out, and
/// a text longer than 120 characters is cut in the middle.
#[must_use]
pub fn shown(text: &str) -> impl Display {
    cut(text, 2 * LONGEST_QUOTE)
}

/// Returns a line of a list or a report, spelled out as by [`shown`] and cut if it is longer than
/// 1000 characters.
#[must_use]
pub fn line(text: &str) -> impl Display {
    cut(text, LONGEST_LINE)
}

/// Returns text as [`shown`] does, with at most `longest` characters. Of longer text the first half
/// of `longest` and the last sixth are shown.
#[must_use]
pub fn cut(text: &str, longest: usize) -> impl Display {
    Shown { text, longest }
}

struct Shown<'a> {
    text: &'a str,
    longest: usize,
}

impl Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { text, longest } = *self;
        // A character has at least one byte, so most texts need not be counted.
        if text.len() <= longest || text.chars().count() <= longest {
            return spell(text, f);
        }
        let place = |k: usize| text.char_indices().nth(k).map_or(text.len(), |(at, _)| at);
        let place_back = |k: usize| text.char_indices().nth_back(k).map_or(0, |(at, _)| at);
        spell(&text[..place(longest / 2)], f)?;
        f.write_str(" ... ")?;
        spell(&text[place_back(longest / 6 - 1)..], f)
    }
}

fn spell(text: &str, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    text.chars().try_for_each(|c| match unseen(c) {
        true => write!(f, "{}", c.escape_default()),
        false => f.write_char(c),
    })
}

/// Returns text of several lines for printing. Line ends and tabs stay; all other invisible
/// characters are spelled out.
#[must_use]
pub fn printed(text: &str) -> Cow<'_, str> {
    let spelled = |c: char| unseen(c) && c != '\n' && c != '\t';
    if !text.contains(spelled) {
        return Cow::Borrowed(text);
    }
    let mut safe = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if spelled(c) {
            safe.extend(c.escape_default());
        } else {
            safe.push(c);
        }
    }
    Cow::Owned(safe)
}

/// Returns whether a character is invisible and changes how text is shown. These are control
/// characters (C0, C1, delete), line and paragraph separators, and the format characters of
/// Unicode, among them the marks that turn the direction of text.
#[must_use]
pub fn unseen(c: char) -> bool {
    c.is_control()
        || matches!(c,
            '\u{ad}' | '\u{600}'..='\u{605}' | '\u{61c}' | '\u{6dd}' | '\u{70f}' | '\u{180e}'
            | '\u{890}'..='\u{891}' | '\u{8e2}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}' | '\u{3164}' | '\u{115f}'..='\u{1160}' | '\u{ffa0}'
            | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{110bd}' | '\u{110cd}'
            | '\u{13430}'..='\u{1343f}' | '\u{1bca0}'..='\u{1bca3}' | '\u{1d173}'..='\u{1d17a}'
            | '\u{e0000}'..='\u{e0fff}')
}

/// Returns the text, or its beginning and its end if it is long.
pub(crate) fn shortened(text: &str) -> String {
    shown(text).to_string()
}

/// Returns the candidate that a typing error would turn into `found`, if there is one.
#[must_use]
pub fn nearest<'a>(found: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let length = found.chars().count();
    if length > LONGEST_SLIP {
        return None;
    }
    let allowed = 1 + length / 4;
    candidates
        // The time for the distance is the product of both lengths. The distance is at least their
        // difference.
        .filter(|candidate| candidate.chars().count().abs_diff(length) <= allowed)
        .map(|candidate| (strsim::damerau_levenshtein(found, candidate), candidate))
        .filter(|&(distance, _)| distance <= allowed)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_stays_on_its_line_and_steers_nothing() {
        for (name, expected) in [
            ("Väse 3", "Väse 3"),
            ("a\nb\t\u{1b}[2J", "a\\nb\\t\\u{1b}[2J"),
            ("\u{9b}31m\u{7f}", "\\u{9b}31m\\u{7f}"),
            ("exe\u{202e}gnp", "exe\\u{202e}gnp"),
            ("\u{2066}a\u{2069}\u{200f}\u{feff}", "\\u{2066}a\\u{2069}\\u{200f}\\u{feff}"),
            ("a\u{2028}b\u{2029}c\u{200b}", "a\\u{2028}b\\u{2029}c\\u{200b}"),
            ("\u{e0041}", "\\u{e0041}"),
        ] {
            assert_eq!(shown(name).to_string(), expected);
        }
    }

    #[test]
    fn a_long_name_is_cut_and_a_short_one_is_not() {
        let exact = "ä".repeat(120);
        assert_eq!(shown(&exact).to_string(), exact);
        let long = shown(&"ä".repeat(100_000)).to_string();
        assert_eq!(long, format!("{} ... {}", "ä".repeat(60), "ä".repeat(20)));
    }

    #[test]
    fn text_of_lines_keeps_them() {
        assert_eq!(printed("a\n\tb\n"), "a\n\tb\n");
        assert_eq!(printed("a\r\u{1b}[2J\n\u{202e}b"), "a\\r\\u{1b}[2J\n\\u{202e}b");
    }
}
