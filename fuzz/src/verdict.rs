//! The result of one input.

use std::error::Error;
use std::fmt::{self, Display};

/// Largest number of characters in an error message.
pub const LONGEST_MESSAGE: usize = 1000;

/// Words of Rust that mean nothing to a user.
const RUST_WORDS: [&str; 16] = [
    "struct ", "tuple", "enum ", "newtype", "Option<", "Vec<", "Some(", "None ", "f32", "f64",
    "u8", "u32", "u64", "usize", "i32", "i64",
];

/// A reason why an input was not accepted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Stop {
    /// The reader refused the input with this message, as a reader may.
    Refused(String),
    /// The input was accepted, and a property that must hold does not.
    Broken(String),
}

/// The result of a reader that tries an input.
pub type Tried = Result<(), Stop>;

/// Returns the refusal with the message of an error as a program prints it: with its control
/// characters spelled out.
pub fn refused(error: impl Error) -> Stop {
    let spelled =
        |c: char| if c.is_control() { c.escape_default().collect() } else { c.to_string() };
    Stop::Refused(error.to_string().chars().map(spelled).collect())
}

/// Returns the fault of a later program that refuses the output of an earlier one.
pub fn broken(what: &str) -> impl Fn(&dyn Error) -> Stop {
    move |error| Stop::Broken(format!("{what}: {error}"))
}

/// Checks a property that every accepted input must have.
pub fn hold(holds: bool, what: &str) -> Tried {
    if holds { Ok(()) } else { Err(Stop::Broken(what.into())) }
}

/// A kind of fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A panic.
    Panic,
    /// The process ended, by a signal or by an abort.
    Died,
    /// More processor time than any small input may take.
    Slow,
    /// Neither an answer nor progress of the processor time.
    Stalled,
    /// More memory than any small input may take.
    Memory,
    /// A message that is no sentence for a user.
    Message,
    /// An accepted input whose result is wrong.
    Broken,
}

impl Kind {
    const ALL: [Self; 7] = [
        Self::Panic,
        Self::Died,
        Self::Slow,
        Self::Stalled,
        Self::Memory,
        Self::Message,
        Self::Broken,
    ];

    /// Returns the kind of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.to_string() == name)
    }
}

impl Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Panic => "panic",
            Self::Died => "died",
            Self::Slow => "slow",
            Self::Stalled => "stalled",
            Self::Memory => "memory",
            Self::Message => "message",
            Self::Broken => "broken",
        })
    }
}

/// A fault of a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// The kind of the fault.
    pub kind: Kind,
    /// The position or the description of the fault, on one line.
    pub text: String,
}

impl Fault {
    /// Makes a fault, with its text on one line.
    #[must_use]
    pub fn new(kind: Kind, text: &str) -> Self {
        let line: String = text.chars().take(2000).flat_map(char::escape_debug).collect();
        Self { kind, text: line }
    }

    /// Returns the signature of the fault: its kind and its text without numbers, names of
    /// temporary inputs and quoted pieces. Two inputs that show one fault have equal signatures.
    #[must_use]
    pub fn signature(&self) -> String {
        let text = self.text.replace("\\\"", "\"");
        // The signature of a panic is its position, which precedes the message.
        let text = match self.kind {
            Kind::Panic => {
                return format!("{} {}", self.kind, text.split(": ").next().unwrap_or(""));
            }
            Kind::Slow | Kind::Memory | Kind::Stalled => String::new(),
            // The fault of the wording, whatever the message says.
            Kind::Message => {
                let what = text.split(" in: ").next().unwrap_or_default();
                return format!("{} {}", self.kind, what.replace(|c: char| c.is_ascii_digit(), ""));
            }
            Kind::Died | Kind::Broken => without_quotes(&text),
        };
        let words = text.split(|c: char| !c.is_alphabetic()).filter(|word| word.len() > 2);
        let words: Vec<&str> = words.take(12).collect();
        format!("{} {}", self.kind, words.join(" "))
    }
}

/// The verdict on one input.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// The reader accepted the input, and the work that follows succeeded.
    Accepted,
    /// The reader refused the input with this sentence.
    Refused(String),
    /// The input shows a fault.
    Fault(Fault),
}

/// Returns the fault in the wording of a message, or `None`.
#[must_use]
pub fn wording_fault(message: &str) -> Option<String> {
    if message.trim().is_empty() {
        return Some("an empty message".into());
    }
    if let Some(c) = message.chars().find(|&c| c.is_control() || is_bidirectional(c)) {
        return Some(format!("the control character U+{:04X}", u32::from(c)));
    }
    let length = message.chars().count();
    if length > LONGEST_MESSAGE {
        return Some(format!("{length} characters"));
    }
    let own = without_quotes(message);
    if let Some(name) = debug_name(&own) {
        return Some(format!("the value of the Rust type {name}"));
    }
    let mut words = RUST_WORDS.into_iter().filter(|word| contains_word(&own, word));
    words.next().map(|word| format!("the word {:?} of Rust", word.trim()))
}

/// Returns a name such as `ChunkType` before a brace, a parenthesis or `::`, as Rust prints values
/// for programmers.
fn debug_name(text: &str) -> Option<&str> {
    let marks = [" {", "{", "(", "::"];
    let ends = marks.iter().flat_map(|mark| text.match_indices(mark)).map(|(at, _)| &text[..at]);
    ends.filter_map(|before| before.rsplit(|c: char| !c.is_alphanumeric() && c != '_').next()).find(
        |name| {
            let mut letters = name.chars();
            letters.next().is_some_and(|c| c.is_ascii_uppercase())
                && name.contains(|c: char| c.is_ascii_lowercase())
                && letters.any(|c| c.is_ascii_uppercase())
        },
    )
}

/// Returns true for characters that change the direction of the text after them.
fn is_bidirectional(c: char) -> bool {
    matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{200e}' | '\u{200f}')
}

/// Returns true if `word` occurs in the text with no letter or digit before it.
fn contains_word(text: &str, word: &str) -> bool {
    text.match_indices(word).any(|(at, _)| {
        let joined = |c: char| c.is_alphanumeric() || c == '_';
        let after = text[at + word.len()..].chars().next();
        !text[..at].chars().next_back().is_some_and(joined)
            && (!word.ends_with(char::is_alphanumeric) || !after.is_some_and(joined))
    })
}

/// Returns the text without the parts that it quotes from the input.
fn without_quotes(text: &str) -> String {
    let mut kept = String::new();
    let mut quote = None;
    let mut escaped = false;
    for c in text.chars() {
        match quote {
            None if matches!(c, '"' | '`') => quote = Some(c),
            None => kept.push(c),
            Some(_) if escaped => escaped = false,
            Some(_) if c == '\\' => escaped = true,
            Some(open) if c == open => quote = None,
            Some(_) => {}
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_passes_and_its_quotations_are_not_its_own() {
        let message = "a.json:1:2: found the string \"f64 struct \\\" usize\", expected a number";
        assert_eq!(wording_fault(message), None);
        assert_eq!(wording_fault("v.obj:3: found `f32`, expected a constructor"), None);
    }

    #[test]
    fn words_of_rust_control_characters_and_long_messages_are_faults() {
        for bad in [
            "expected struct Spec",
            "found ChunkType { a: 1 }",
            "found BadLength(3)",
            "expected f64",
            "a\nb",
            "a\u{202e}b",
            " ",
            "invalid type: tuple",
        ] {
            assert!(wording_fault(bad).is_some(), "{bad:?}");
        }
        assert!(wording_fault(&"long ".repeat(1 + LONGEST_MESSAGE / 5)).is_some());
    }

    #[test]
    fn the_same_fault_with_other_numbers_has_the_same_signature() {
        let fault = |text| Fault::new(Kind::Panic, text).signature();
        let first = fault("a.rs:7: index 3 is out of range 2");
        assert_eq!(first, fault("a.rs:7: index 9 is out of range 1"));
        assert_ne!(first, fault("a.rs:8: index 3 is out of range 2"));
        let fault = |text| Fault::new(Kind::Broken, text).signature();
        assert_eq!(
            fault("point 3 of \"a\" is not finite"),
            fault("point 4 of \"b\" is not finite")
        );
    }
}
