//! Mutations of text: numbers, words, lines.

use super::bytes;
use crate::dice::Dice;
use std::ops::Range;

/// Numbers, and words that resemble numbers, that strain a reader.
const NUMBERS: [&str; 34] = [
    "0",
    "-0",
    "1",
    "-1",
    "2",
    "0.5",
    "1e-9",
    "1e-320",
    "5e-324",
    "-1e-16",
    "1e30",
    "1e39",
    "1e308",
    "-1e308",
    "1e309",
    "1e400",
    "-1e400",
    "1e99999999999",
    "NaN",
    "nan",
    "inf",
    "-Infinity",
    "2147483647",
    "2147483648",
    "-2147483649",
    "4294967296",
    "9223372036854775807",
    "9223372036854775808",
    "18446744073709551616",
    "0x10",
    "1e",
    "-",
    "+1",
    "0000001",
];

/// Longest text that mutation makes, in bytes.
const LONGEST: usize = 1 << 16;

/// Changes a text at one position; `words` are tokens of its format, `other` is another seed.
pub fn mutate(text: &mut Vec<u8>, dice: &mut Dice, words: &[&str], other: &[u8]) {
    if text.len() > LONGEST {
        text.truncate(LONGEST);
    }
    match dice.below(12) {
        0..2 => number(text, dice),
        2..5 => scaled(text, dice),
        5 if !words.is_empty() => {
            let word = dice.one(words);
            let at = dice.below(text.len() + 1);
            text.splice(at..at, word.bytes());
        }
        6 if !words.is_empty() => {
            let tokens = tokens(text, |byte| !byte.is_ascii_whitespace());
            if !tokens.is_empty() {
                let token = dice.one(&tokens).clone();
                text.splice(token, dice.one(words).bytes());
            }
        }
        7..11 => lines(text, dice, other),
        11 if dice.once_in(3) => text.truncate(dice.below(text.len())),
        _ => bytes::mutate(text, dice, other),
    }
}

/// Replaces a number by another one.
pub fn number(text: &mut Vec<u8>, dice: &mut Dice) {
    let numbers = tokens(text, is_of_number);
    if !numbers.is_empty() {
        let place = dice.one(&numbers).clone();
        text.splice(place, dice.one(&NUMBERS).bytes());
    }
}

/// Changes one number of the text, or replaces it by a changed copy of another. A whole number
/// moves by at most 2; any other number is multiplied by a factor in [-0.5, 2).
fn scaled(text: &mut Vec<u8>, dice: &mut Dice) {
    let numbers = tokens(text, is_of_number);
    if numbers.is_empty() {
        return;
    }
    let place = dice.one(&numbers).clone();
    let from = if dice.once_in(2) { place.clone() } else { dice.one(&numbers).clone() };
    let found = String::from_utf8_lossy(&text[from]).into_owned();
    let new = match (found.parse::<i64>(), found.parse::<f64>()) {
        (Ok(whole), _) => (whole.saturating_add(dice.below(5) as i64 - 2)).to_string(),
        (_, Ok(number)) => (number * (2.5 * dice.fraction() - 0.5)).to_string(),
        _ => found,
    };
    text.splice(place, new.into_bytes());
}

/// Removes, doubles, exchanges or inserts lines.
fn lines(text: &mut Vec<u8>, dice: &mut Dice, other: &[u8]) {
    let mut lines: Vec<&[u8]> = text.split_inclusive(|&byte| byte == b'\n').collect();
    let others: Vec<&[u8]> = other.split_inclusive(|&byte| byte == b'\n').collect();
    if lines.is_empty() || others.is_empty() {
        return;
    }
    let (a, b) = (dice.below(lines.len()), dice.below(lines.len()));
    if dice.once_in(100) {
        // Many equal lines reveal work that grows faster than the input.
        let many = (LONGEST - text.len().min(LONGEST)) / lines[a].len().max(8);
        lines.splice(b..b, std::iter::repeat_n(lines[a], many).collect::<Vec<_>>());
        *text = lines.concat();
        return;
    }
    match dice.below(6) {
        0 => drop(lines.remove(a)),
        1 => lines.insert(b, lines[a]),
        2 => lines.swap(a, b),
        3 => lines.insert(a, *dice.one::<&[u8]>(&others)),
        4 => lines[a] = *dice.one::<&[u8]>(&others),
        _ => {
            let range = bytes::piece(lines.len(), dice);
            lines.drain(range);
        }
    }
    *text = lines.concat();
}

fn is_of_number(byte: u8) -> bool {
    byte.is_ascii_digit() || matches!(byte, b'-' | b'.' | b'+' | b'e')
}

/// Returns the longest ranges of bytes of one kind. Ranges of numbers are returned only if they
/// hold a digit.
fn tokens(text: &[u8], of_kind: impl Fn(u8) -> bool) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut start = None;
    for at in 0..=text.len() {
        let inside = text.get(at).is_some_and(|&byte| of_kind(byte));
        match (start, inside) {
            (None, true) => start = Some(at),
            (Some(from), false) => {
                if text[from..at].iter().any(|&byte| byte.is_ascii_digit() || !is_of_number(byte)) {
                    found.push(from..at);
                }
                start = None;
            }
            _ => {}
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_found_and_replaced() {
        let text = b"v 1 -2.5e3 x\nf 7/8";
        let found = tokens(text, is_of_number);
        let words: Vec<&[u8]> = found.into_iter().map(|range| &text[range]).collect();
        assert_eq!(words, [&b"1"[..], b"-2.5e3", b"7", b"8"]);
        let mut changed = b"v 5".to_vec();
        number(&mut changed, &mut crate::dice::of_case(0, "", 3));
        assert!(changed.starts_with(b"v ") && changed != b"v 5");
    }
}
