//! Mutations that ignore the format.

use crate::dice::Dice;

/// Numbers at which integers of formats wrap or overflow.
const INTEGERS: [u64; 16] = [
    0,
    1,
    2,
    3,
    0x7f,
    0x80,
    0xff,
    0x7fff,
    0x8000,
    0xffff,
    0x7fff_ffff,
    0x8000_0000,
    0xffff_ffff,
    1 << 53,
    1 << 63,
    u64::MAX,
];

/// Doubles that strain arithmetic.
pub const DOUBLES: [f64; 20] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    1e-320,
    1e-30,
    -1e-9,
    1e9,
    1e30,
    -1e30,
    1e39,
    1e155,
    1e308,
    -1e308,
    f64::MIN_POSITIVE,
    f64::EPSILON,
    f64::MAX,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
];

/// Longest input that mutation makes, in bytes.
const LONGEST: usize = 1 << 16;

/// Changes some bytes: flips, numbers, and pieces that are removed, doubled or taken from `other`.
pub fn mutate(bytes: &mut Vec<u8>, dice: &mut Dice, other: &[u8]) {
    let at = dice.below(bytes.len());
    match dice.below(12) {
        0..3 if !bytes.is_empty() => bytes[at] ^= 1 << dice.below(8),
        3 if !bytes.is_empty() => bytes[at] = dice.bits() as u8,
        4 if !bytes.is_empty() => bytes[at] = bytes[at].wrapping_add(1),
        5..7 => integer(bytes, at, dice),
        7 => double(bytes, at, dice),
        8 => drop(bytes.drain(piece(bytes.len(), dice))),
        9 => {
            let copy = bytes[piece(bytes.len(), dice)].to_vec();
            insert(bytes, at, &copy);
        }
        10 => {
            let copy = &other[piece(other.len(), dice)];
            insert(bytes, at, copy);
        }
        _ => bytes.truncate(at),
    }
}

/// Returns a range of at most 64 positions, most often of few.
pub fn piece(length: usize, dice: &mut Dice) -> std::ops::Range<usize> {
    let start = dice.below(length);
    let longest = *dice.one(&[1, 2, 4, 16, 64]);
    let end = (start + 1 + dice.below(longest)).min(length);
    start..end
}

fn insert(bytes: &mut Vec<u8>, at: usize, copy: &[u8]) {
    if bytes.len() + copy.len() <= LONGEST {
        bytes.splice(at..at, copy.iter().copied());
    }
}

/// Writes an integer of 1, 2, 4 or 8 bytes in either byte order.
fn integer(bytes: &mut [u8], at: usize, dice: &mut Dice) {
    let width = *dice.one(&[1, 2, 4, 8]);
    let number = dice.one(&INTEGERS).to_le_bytes();
    let backwards = dice.once_in(2);
    let Some(place) = bytes.get_mut(at..at + width) else { return };
    place.copy_from_slice(&number[..width]);
    if backwards {
        place.reverse();
    }
}

/// Writes a little-endian f64 or f32.
pub fn double(bytes: &mut [u8], at: usize, dice: &mut Dice) {
    let number = *dice.one(&DOUBLES);
    if dice.once_in(2) {
        if let Some(place) = bytes.get_mut(at..at + 8) {
            place.copy_from_slice(&number.to_le_bytes());
        }
    } else if let Some(place) = bytes.get_mut(at..at + 4) {
        place.copy_from_slice(&(number as f32).to_le_bytes());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_change_most_of_the_time_and_empty_ones_do_no_harm() {
        let whole: Vec<u8> = (0..100).collect();
        let mut changed = 0;
        for case in 0..500 {
            let mut dice = crate::dice::of_case(1, "bytes", case);
            let mut bytes = whole.clone();
            mutate(&mut bytes, &mut dice, &whole);
            changed += usize::from(bytes != whole);
            mutate(&mut Vec::new(), &mut dice, &[]);
        }
        assert!(changed > 400, "{changed}");
    }
}
