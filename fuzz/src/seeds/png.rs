//! PNG files of every kind, written without compression so that mutations reach their rows.

use crate::dice::{Dice, of_case};

/// The first eight bytes of every PNG file.
pub const SIGNATURE: [u8; 8] = [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n'];

/// A chunk: its name and its bytes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chunk {
    /// Four letters.
    pub name: [u8; 4],
    /// The content of the chunk.
    pub data: Vec<u8>,
}

impl Chunk {
    /// Makes a chunk with this name and this content.
    #[must_use]
    pub fn new(name: &[u8; 4], data: impl Into<Vec<u8>>) -> Self {
        Self { name: *name, data: data.into() }
    }
}

/// Returns a file of these chunks, each with its correct length and CRC.
#[must_use]
pub fn file(chunks: &[Chunk]) -> Vec<u8> {
    let mut bytes = SIGNATURE.to_vec();
    for chunk in chunks {
        bytes.extend((chunk.data.len() as u32).to_be_bytes());
        bytes.extend(chunk.name);
        bytes.extend(&chunk.data);
        let mut crc = crc32fast::Hasher::new();
        crc.update(&chunk.name);
        crc.update(&chunk.data);
        bytes.extend(crc.finalize().to_be_bytes());
    }
    bytes
}

/// Returns the chunks of a file, up to the first length that is wrong.
#[must_use]
pub fn chunks(bytes: &[u8]) -> Vec<Chunk> {
    let mut rest = bytes.get(SIGNATURE.len()..).unwrap_or_default();
    let mut found = Vec::new();
    while let Some((head, behind)) = rest.split_first_chunk::<8>() {
        let length = u32::from_be_bytes([head[0], head[1], head[2], head[3]]) as usize;
        let name = [head[4], head[5], head[6], head[7]];
        let Some(data) = behind.get(..length) else { break };
        found.push(Chunk::new(&name, data));
        rest = behind.get(length + 4..).unwrap_or_default();
    }
    found
}

/// Returns a zlib stream that stores the bytes without compression.
#[must_use]
pub fn stored(bytes: &[u8]) -> Vec<u8> {
    let mut stream = vec![0x78, 0x01];
    let blocks = bytes.chunks(0xffff);
    let last = blocks.len().saturating_sub(1);
    for (number, block) in blocks.enumerate() {
        let length = block.len() as u16;
        stream.push(u8::from(number == last));
        stream.extend(length.to_le_bytes());
        stream.extend((!length).to_le_bytes());
        stream.extend(block);
    }
    let (mut a, mut b) = (1_u32, 0_u32);
    for &byte in bytes {
        a = (a + u32::from(byte)) % 65521;
        b = (b + a) % 65521;
    }
    stream.extend(((b << 16) | a).to_be_bytes());
    stream
}

/// Width and height of the seeds.
const SIZE: [u32; 2] = [9, 7];

/// Makes a small picture of every colour type and depth, plain and interlaced.
#[must_use]
pub fn seeds() -> Vec<Vec<u8>> {
    let kinds = [
        (0, 1),
        (0, 2),
        (0, 4),
        (0, 8),
        (0, 16),
        (2, 8),
        (2, 16),
        (3, 1),
        (3, 2),
        (3, 4),
        (3, 8),
        (4, 8),
        (4, 16),
        (6, 8),
        (6, 16),
    ];
    let mut dice = of_case(0, "png seeds", 0);
    let mut seeds = Vec::new();
    for (color, depth) in kinds {
        for interlace in [0, 1] {
            seeds.push(seed(color, depth, interlace, &mut dice));
        }
    }
    seeds
}

fn seed(color: u8, depth: u8, interlace: u8, dice: &mut Dice) -> Vec<u8> {
    let mut header: Vec<u8> = SIZE.iter().flat_map(|side| side.to_be_bytes()).collect();
    header.extend([depth, color, 0, 0, interlace]);
    let mut chunks = vec![Chunk::new(b"IHDR", header)];
    if depth == 16 {
        chunks.push(Chunk::new(b"gAMA", 45455_u32.to_be_bytes()));
    }
    if color == 3 {
        let palette: Vec<u8> = (0..3 << depth.min(4)).map(|_| dice.bits() as u8).collect();
        chunks.push(Chunk::new(b"PLTE", palette));
        chunks.push(Chunk::new(b"tRNS", [255, 255]));
    }
    if color == 0 && depth == 8 {
        chunks.push(Chunk::new(b"tRNS", [0, 9]));
        chunks.push(Chunk::new(b"tEXt", *b"Title\0seed"));
        chunks.push(Chunk::new(b"pHYs", [0, 0, 0, 9, 0, 0, 0, 9, 1]));
    }
    if color == 2 && depth == 8 {
        let mut profile = b"icc\0\0".to_vec();
        profile.extend(stored(&[0; 128]));
        chunks.push(Chunk::new(b"iCCP", profile));
        let mut text = b"key\0\0".to_vec();
        text.extend(stored(b"text"));
        chunks.push(Chunk::new(b"zTXt", text));
    }
    let channels = [1, 0, 3, 1, 2, 0, 4][usize::from(color)];
    let most_index = 1_u16 << depth.min(4);
    let mut rows = Vec::new();
    for [width, height] in passes(interlace) {
        let bytes = (width * channels * u32::from(depth)).div_ceil(8);
        for _ in 0..if width == 0 { 0 } else { height } {
            rows.push(dice.below(5) as u8);
            let index = |dice: &mut Dice| (dice.bits() % u64::from(most_index)) as u8;
            let grey = dice.bits() as u8;
            rows.extend((0..bytes).map(|_| if color == 3 { index(dice) } else { grey }));
        }
    }
    let data = stored(&rows);
    let (first, second) = data.split_at(data.len() / 2);
    chunks.extend([Chunk::new(b"IDAT", first), Chunk::new(b"IDAT", second)]);
    chunks.push(Chunk::new(b"IEND", []));
    file(&chunks)
}

/// Returns the sizes of the passes in which rows are stored: one pass, or the seven of Adam7.
fn passes(interlace: u8) -> Vec<[u32; 2]> {
    if interlace == 0 {
        return vec![SIZE];
    }
    let starts = [[0, 0], [4, 0], [0, 4], [2, 0], [0, 2], [1, 0], [0, 1]];
    let steps = [[8, 8], [8, 8], [4, 8], [4, 4], [2, 4], [2, 2], [1, 2]];
    let side = |i: usize, start: [u32; 2], step: [u32; 2]| (SIZE[i] - start[i]).div_ceil(step[i]);
    starts.iter().zip(steps).map(|(&at, step)| [side(0, at, step), side(1, at, step)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_seed_is_a_picture() {
        for (number, seed) in seeds().iter().enumerate() {
            let picture = image::load_from_memory(seed);
            let size = picture.as_ref().map(|picture| [picture.width(), picture.height()]);
            assert_eq!(size.ok(), Some(SIZE), "seed {number}: {:?}", picture.err());
        }
    }

    #[test]
    fn chunks_are_found_again() {
        let made = [Chunk::new(b"IHDR", [1, 2]), Chunk::new(b"IEND", [])];
        assert_eq!(chunks(&file(&made)), made);
        assert_eq!(chunks(b"no picture").len(), 0);
    }
}
