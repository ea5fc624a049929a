//! Reads numbers and names of command lines.

use crate::verdict::{Stop, Tried};
use compare::Scale;
use files::memory::bytes;
use render::film::Layer;
use render::film::size;

/// Reads a word as each kind of value that a command line has.
///
/// # Errors
/// When no kind accepts the word.
pub fn read(word: &[u8]) -> Tried {
    let word = String::from_utf8_lossy(word);
    let word = word.as_ref();
    let refusals = [
        size(word).err(),
        bytes(word).err(),
        word.parse::<Layer>().err(),
        word.parse::<Scale>().err(),
    ];
    if refusals.iter().any(Option::is_none) {
        return Ok(());
    }
    // Only one message can be checked; the length of the word selects it.
    match refusals.into_iter().flatten().nth(word.len() % 4) {
        Some(message) => Err(Stop::Refused(message)),
        None => Ok(()),
    }
}
