//! The text of OBJ and MTL files, as lines that end in a line feed.

use std::borrow::Cow;

/// A byte 0, which no text contains: the number of its line, from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NotText(pub usize);

/// Returns the text of a file.
///
/// Bytes that are not UTF-8 are Latin-1, as in files of older programs, or UTF-16 behind its byte order
/// mark. A byte order mark at the start is left out. Lines may end in CR, LF or both. A backslash at the end of a line joins it with the next
/// one; empty lines behind a joined line keep the numbers of the lines that follow.
///
/// # Errors
/// If the file contains a byte 0.
pub fn of(bytes: &[u8]) -> Result<Cow<'_, str>, NotText> {
    if let Some(text) = wide(bytes) {
        return of(text.as_bytes()).map(|text| Cow::Owned(text.into_owned()));
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    // One fast pass: most files have none of these bytes.
    let seen = bytes.iter().fold(0, |seen, &byte| {
        seen | u8::from(byte == 0) | u8::from(byte == b'\r') << 1 | u8::from(byte == b'\\') << 2
    });
    let [zero, returns, backslash] = [1, 2, 4].map(|bit| seen & bit != 0);
    if zero {
        let lines = bytes.split(|&byte| byte == 0).next().unwrap_or_default();
        return Err(NotText(1 + lines.iter().filter(|&&byte| byte == b'\n').count()));
    }
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().copied().map(char::from).collect()),
    };
    let text = if returns && has_lone_returns(&text) {
        Cow::Owned(text.replace("\r\n", "\n").replace('\r', "\n"))
    } else {
        text
    };
    let continues = backslash && text.lines().any(|line| line.ends_with('\\'));
    Ok(if continues { joined(&text).into() } else { text })
}

/// Returns the text of a file in UTF-16, which begins with a byte order mark.
fn wide(bytes: &[u8]) -> Option<String> {
    let (words, read): (_, fn([u8; 2]) -> u16) = match bytes {
        [0xff, 0xfe, words @ ..] => (words, u16::from_le_bytes),
        [0xfe, 0xff, words @ ..] => (words, u16::from_be_bytes),
        _ => return None,
    };
    let words = words.as_chunks::<2>().0.iter().map(|&two| read(two));
    Some(char::decode_utf16(words).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect())
}

fn has_lone_returns(text: &str) -> bool {
    text.match_indices('\r').any(|(at, _)| text.as_bytes().get(at + 1) != Some(&b'\n'))
}

/// Joins the lines that end in a backslash with those that follow.
fn joined(text: &str) -> String {
    let mut all = String::with_capacity(text.len());
    let mut waiting = 0;
    for line in text.lines() {
        if let Some(start) = line.strip_suffix('\\') {
            all.push_str(start);
            all.push(' ');
            waiting += 1;
        } else {
            all.push_str(line);
            all.extend(std::iter::repeat_n('\n', waiting + 1));
            waiting = 0;
        }
    }
    all
}

/// Splits the keyword of a line from the rest.
#[must_use]
pub fn keyword(line: &str) -> (&str, &str) {
    let line = line.trim_ascii();
    match line.bytes().position(|byte| byte.is_ascii_whitespace()) {
        Some(end) => (&line[..end], line[end..].trim_ascii_start()),
        None => (line, ""),
    }
}

/// Returns the words of a statement up to a comment.
pub fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split_ascii_whitespace().take_while(|word| !word.starts_with('#'))
}

/// Returns a name without the comment that may follow it; `None` without such a comment.
///
/// A name may contain `#`. A reader tries the whole name first.
pub fn before_comment(name: &str) -> Option<&str> {
    let (start, _) = name.split_once(" #").or_else(|| name.split_once("\t#"))?;
    Some(start.trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_of_line_end_becomes_a_line_feed() {
        let text = |bytes: &[u8]| of(bytes).map(Cow::into_owned);
        assert_eq!(text(b"a\rb\r\nc\nd").as_deref(), Ok("a\nb\nc\nd"));
        assert_eq!(text(b"\xef\xbb\xbfa\r\nb").as_deref(), Ok("a\r\nb"));
        assert_eq!(text(b"gr\xfcn\n").as_deref(), Ok("gr\u{fc}n\n"));
        assert_eq!(text("gr\u{fc}n".as_bytes()).as_deref(), Ok("gr\u{fc}n"));
        assert_eq!(text(b"a\nb\0"), Err(NotText(2)));
        // UTF-16 in both orders of bytes.
        assert_eq!(text(b"\xff\xfea\0\r\0\n\0").as_deref(), Ok("a\r\n"));
        assert_eq!(text(b"\xfe\xff\0a\0\xfc").as_deref(), Ok("a\u{fc}"));
    }

    #[test]
    fn a_backslash_joins_lines_and_keeps_their_numbers() {
        for end in ["\n", "\r\n", "\r"] {
            let file = ["v 1 \\", " 2\\", "3", "f 1"].join(end);
            let text = of(file.as_bytes()).unwrap().into_owned();
            let lines: Vec<&str> = text.lines().collect();
            assert_eq!(lines, ["v 1   2 3", "", "", "f 1"], "{end:?}");
        }
        // The last line has none to be joined with.
        assert_eq!(of(b"a \\").unwrap(), "a  ");
    }

    #[test]
    fn a_line_is_a_keyword_and_the_rest() {
        assert_eq!(keyword(" \tv  1 2 \r"), ("v", "1 2"));
        assert_eq!((keyword("f"), keyword("")), (("f", ""), ("", "")));
    }

    #[test]
    fn a_comment_ends_words_and_may_end_a_name() {
        assert_eq!(words("1 2 # three 4").collect::<Vec<_>>(), ["1", "2"]);
        assert_eq!(words("1#2 3").collect::<Vec<_>>(), ["1#2", "3"]);
        assert_eq!(before_comment("red # paint"), Some("red"));
        assert_eq!(before_comment("red#paint"), None);
    }
}
