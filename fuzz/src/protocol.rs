//! The lines that parent and child exchange.
//!
//! The parent requests a run of cases, or one input whose bytes follow the line. The child writes
//! `at N` before it tries case N, and an answer after it. So the parent knows which case ended a
//! child.

use crate::reader::Reader;
use crate::verdict::{Fault, Kind, Verdict};
use std::fmt::{self, Display};
use std::time::Duration;

/// A request of the parent to a child.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Request {
    /// `count` cases from `from` on.
    Cases {
        /// The reader.
        reader: Reader,
        /// The seed of the run.
        seed: u64,
        /// The first case.
        from: u64,
        /// The number of cases.
        count: u64,
    },
    /// One input of `length` bytes, which follow.
    Input {
        /// The reader.
        reader: Reader,
        /// The number of bytes of the input.
        length: usize,
    },
}

impl Request {
    /// Reads a request from a line.
    #[must_use]
    pub fn read(line: &str) -> Option<Self> {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["cases", reader, seed, from, count] => Some(Self::Cases {
                reader: reader.parse().ok()?,
                seed: seed.parse().ok()?,
                from: from.parse().ok()?,
                count: count.parse().ok()?,
            }),
            ["input", reader, length] => {
                Some(Self::Input { reader: reader.parse().ok()?, length: length.parse().ok()? })
            }
            _ => None,
        }
    }
}

impl Display for Request {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cases { reader, seed, from, count } => {
                write!(f, "cases {reader} {seed} {from} {count}")
            }
            Self::Input { reader, length } => write!(f, "input {reader} {length}"),
        }
    }
}

/// A line of a child to its parent.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Reply {
    /// The child begins with this case.
    At(u64),
    /// The child has tried the case or the input.
    Answer(Answer),
}

/// The result of an input.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Answer {
    /// The verdict on the input.
    pub verdict: Verdict,
    /// Processor time of the input.
    pub time: Duration,
    /// The most memory held at once, in bytes.
    pub memory: u64,
}

impl Reply {
    /// Reads a reply from a line.
    #[must_use]
    pub fn read(line: &str) -> Option<Self> {
        let mut words = line.trim_end_matches('\n').splitn(5, ' ');
        let first = words.next()?;
        if first == "at" {
            return Some(Self::At(words.next()?.parse().ok()?));
        }
        let time = Duration::from_micros(words.next()?.parse().ok()?);
        let memory = words.next()?.parse().ok()?;
        let verdict = match first {
            "ok" => Verdict::Accepted,
            "no" => {
                // Only a fault has a kind; a refusal has a placeholder in its position.
                words.next()?;
                Verdict::Refused(words.next()?.into())
            }
            "bad" => {
                let kind = Kind::named(words.next()?)?;
                Verdict::Fault(Fault { kind, text: words.next()?.into() })
            }
            _ => return None,
        };
        Some(Self::Answer(Answer { verdict, time, memory }))
    }
}

impl Display for Reply {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::At(case) => write!(f, "at {case}"),
            Self::Answer(Answer { verdict, time, memory }) => {
                let cost = format!("{} {memory}", time.as_micros());
                match verdict {
                    Verdict::Accepted => write!(f, "ok {cost}"),
                    Verdict::Refused(message) => write!(f, "no {cost} - {message}"),
                    Verdict::Fault(fault) => write!(f, "bad {cost} {} {}", fault.kind, fault.text),
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requests_and_replies_are_read_back() {
        let reader = Reader::GridText;
        for request in [
            Request::Cases { reader, seed: u64::MAX, from: 7, count: 100 },
            Request::Input { reader, length: 9 },
        ] {
            assert_eq!(Request::read(&request.to_string()), Some(request));
        }
        let fault = Fault::new(Kind::Panic, "a.rs:7: index 3\nof 2");
        let refused = Verdict::Refused("found no v".into());
        for verdict in [Verdict::Accepted, refused, Verdict::Fault(fault)] {
            let answer = Answer { verdict, time: Duration::from_micros(81), memory: 5 };
            let reply = Reply::Answer(answer);
            assert_eq!(Reply::read(&reply.to_string()), Some(reply));
        }
        assert_eq!(Reply::read("at 12\n"), Some(Reply::At(12)));
        assert_eq!(Reply::read("nonsense"), None);
    }
}
