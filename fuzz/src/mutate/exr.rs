//! Mutations of EXR files: the attributes of the header, and the bytes after them.

use super::bytes;
use crate::dice::Dice;
use std::ops::Range;

/// The ranges of a header's attribute in its file.
#[derive(Debug, Clone)]
struct Attribute {
    /// The name, type, length and value.
    whole: Range<usize>,
    /// The value alone.
    value: Range<usize>,
}

/// Returns a mutated picture.
#[must_use]
pub fn mutated(seed: &[u8], dice: &mut Dice, other: &[u8]) -> Vec<u8> {
    let mut file = seed.to_vec();
    for _ in 0..=dice.below(2) {
        change(&mut file, dice, other);
    }
    file
}

fn change(file: &mut Vec<u8>, dice: &mut Dice, other: &[u8]) {
    let attributes = attributes(file);
    let end = attributes.last().map_or(8, |last| last.whole.end).min(file.len());
    if attributes.is_empty() {
        return bytes::mutate(file, dice, other);
    }
    let chosen = dice.one(&attributes).clone();
    match dice.below(12) {
        0..4 => value(file, &chosen.value, dice),
        4 => drop(file.drain(chosen.whole)),
        5 => {
            let copy = file[chosen.whole].to_vec();
            file.splice(end..end, copy);
        }
        6 => {
            // A value of another length.
            let mut new = file[chosen.value.clone()].to_vec();
            bytes::mutate(&mut new, dice, other);
            let at = chosen.value.start - 4;
            let length = (new.len() as u32).to_le_bytes();
            file.splice(at..chosen.value.end, length.into_iter().chain(new));
        }
        7..10 => {
            // The table of offsets, and the blocks.
            let mut behind = file.split_off(end);
            bytes::mutate(&mut behind, dice, other);
            file.extend(behind);
        }
        10 => {
            // The version and its flags.
            if let Some(byte) = file.get_mut(4 + dice.below(4)) {
                *byte ^= 1 << dice.below(8);
            }
        }
        _ => bytes::mutate(file, dice, other),
    }
}

/// Changes one number of a value.
fn value(file: &mut [u8], place: &Range<usize>, dice: &mut Dice) {
    let length = place.len();
    if length < 4 {
        if length > 0 {
            file[place.start + dice.below(length)] = dice.below(12) as u8;
        }
        return;
    }
    let at = place.start + 4 * dice.below(length / 4);
    let old = i32::from_le_bytes([file[at], file[at + 1], file[at + 2], file[at + 3]]);
    let new = match dice.below(10) {
        0..5 => old.wrapping_add(dice.below(9) as i32 - 4),
        5 => -old.max(-1000),
        6 => 1 << dice.below(31),
        7 => i32::MIN,
        8 => i32::MAX,
        _ => dice.bits() as i32,
    };
    file[at..at + 4].copy_from_slice(&new.to_le_bytes());
}

/// Lists the attributes of the first header.
fn attributes(file: &[u8]) -> Vec<Attribute> {
    let mut found = Vec::new();
    let mut at = 8;
    loop {
        let start = at;
        let Some(name) = word(file, at).filter(|&length| length > 0) else { break };
        at += name + 1;
        let Some(kind) = word(file, at) else { break };
        at += kind + 1;
        let Some(&[a, b, c, d]) = file.get(at..at + 4) else { break };
        let length = u32::from_le_bytes([a, b, c, d]) as usize;
        let value = at + 4..(at + 4).saturating_add(length);
        if value.end > file.len() {
            break;
        }
        at = value.end;
        found.push(Attribute { whole: start..at, value });
    }
    found
}

/// Returns the length of the zero-terminated text at this position.
fn word(file: &[u8], at: usize) -> Option<usize> {
    file.get(at..)?.iter().take(256).position(|&byte| byte == 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_attributes_of_a_header_are_found() {
        let file = crate::seeds::exr::seeds().remove(0);
        let attributes = attributes(&file);
        assert!(attributes.len() >= 8, "{}", attributes.len());
        let names = attributes.iter().map(|attribute| &file[attribute.whole.clone()]);
        assert!(names.into_iter().any(|name| name.starts_with(b"dataWindow\0box2i\0")));
    }
}
