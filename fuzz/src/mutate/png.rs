//! Mutations of PNG files, with correct checksums in most cases.

use super::bytes;
use crate::dice::Dice;
use crate::seeds::png::{self, Chunk};

/// Names of chunks that decoders know.
const NAMES: [&[u8; 4]; 16] = [
    b"IHDR", b"PLTE", b"IDAT", b"IEND", b"tRNS", b"gAMA", b"cHRM", b"iCCP", b"sRGB", b"sBIT",
    b"bKGD", b"pHYs", b"acTL", b"fcTL", b"fdAT", b"iTXt",
];

/// Returns a mutated picture. Its checksums are correct except in one case in sixteen.
#[must_use]
pub fn mutated(seed: &[u8], dice: &mut Dice, other: &[u8]) -> Vec<u8> {
    let mut chunks = png::chunks(seed);
    let others = png::chunks(other);
    for _ in 0..=dice.below(2) {
        change(&mut chunks, dice, &others);
    }
    let mut file = png::file(&chunks);
    if dice.once_in(16) {
        bytes::mutate(&mut file, dice, other);
    }
    file
}

fn change(chunks: &mut Vec<Chunk>, dice: &mut Dice, others: &[Chunk]) {
    if chunks.is_empty() || others.is_empty() {
        return;
    }
    let (a, b) = (dice.below(chunks.len()), dice.below(chunks.len()));
    match dice.below(12) {
        0..3 => header(&mut chunks[0].data, dice),
        3..7 => rows(&mut chunks[a], dice),
        7 => {
            let other = dice.one(others).data.clone();
            bytes::mutate(&mut chunks[a].data, dice, &other);
        }
        8 => drop(chunks.remove(a)),
        9 => {
            let copy = if dice.once_in(2) { chunks[a].clone() } else { dice.one(others).clone() };
            chunks.insert(b, copy);
        }
        10 => chunks.swap(a, b),
        _ => {
            let name = **dice.one(&NAMES);
            let data: Vec<u8> = (0..dice.below(40)).map(|_| dice.bits() as u8).collect();
            chunks.insert(b, Chunk::new(&name, data));
        }
    }
}

/// Changes bytes of stored rows, and no length.
fn rows(chunk: &mut Chunk, dice: &mut Dice) {
    // The zlib header and that of the first block lie in the first of the chunks.
    let start = if chunk.name == *b"IDAT" { 7 } else { 0 };
    for _ in 0..=dice.below(4) {
        let at = start + dice.below(chunk.data.len().saturating_sub(start));
        if let Some(byte) = chunk.data.get_mut(at) {
            *byte = *dice.one(&[0, 1, 2, 4, 9, 127, 255, *byte ^ 1, *byte ^ 128]);
        }
    }
}

/// Changes the size, depth, colour type or interlacing in an image header.
fn header(data: &mut [u8], dice: &mut Dice) {
    if data.len() != 13 {
        return;
    }
    match dice.below(6) {
        side @ 0..2 => {
            let value = match dice.below(12) {
                0 => dice.bits() as u32,
                1 => 1 << dice.below(32),
                2 => 0,
                _ => 1 + dice.below(12) as u32,
            };
            data[4 * side..4 * side + 4].copy_from_slice(&value.to_be_bytes());
        }
        2 => data[8] = *dice.one(&[1, 2, 4, 8, 16]),
        3 => data[9] = *dice.one(&[0, 2, 3, 4, 6]),
        4 => data[12] = 1 - data[12].min(1),
        _ => data[8 + dice.below(5)] = dice.bits() as u8,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn most_changed_pictures_keep_their_checksums() {
        let seeds = png::seeds();
        let right = (0..200).filter(|&case| {
            let mut dice = crate::dice::of_case(2, "png", case);
            let seed = &seeds[dice.below(seeds.len())];
            let file = mutated(seed, &mut dice, &seeds[0]);
            png::file(&png::chunks(&file)) == file
        });
        assert!(right.count() > 150);
    }
}
