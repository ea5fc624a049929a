//! Mutations of JPEG files, segment by segment.

use super::bytes;
use crate::dice::Dice;

/// A marker, and the bytes up to the next marker. `sized` segments begin with their length.
#[derive(Debug, Clone)]
struct Segment {
    marker: u8,
    sized: bool,
    data: Vec<u8>,
}

/// Markers of frame headers, tables, scans, restarts and the ends.
const MARKERS: [u8; 14] =
    [0xc0, 0xc1, 0xc2, 0xc3, 0xc4, 0xc9, 0xd0, 0xd8, 0xd9, 0xda, 0xdb, 0xdd, 0xe0, 0xee];

/// Returns a mutated picture. The lengths of its segments are correct in most cases.
#[must_use]
pub fn mutated(seed: &[u8], dice: &mut Dice, other: &[u8]) -> Vec<u8> {
    let mut segments = segments(seed);
    for _ in 0..=dice.below(3) {
        change(&mut segments, dice, other);
    }
    let mut file = joined(&segments);
    if dice.once_in(10) {
        bytes::mutate(&mut file, dice, other);
    }
    file
}

fn change(segments: &mut Vec<Segment>, dice: &mut Dice, other: &[u8]) {
    if segments.is_empty() {
        return;
    }
    let (a, b) = (dice.below(segments.len()), dice.below(segments.len()));
    match dice.below(12) {
        0..6 => bytes::mutate(&mut segments[a].data, dice, other),
        6..8 => frame(segments, dice),
        8 => drop(segments.remove(a)),
        9 => segments.insert(b, segments[a].clone()),
        10 => segments.swap(a, b),
        _ => segments[a].marker = *dice.one(&MARKERS),
    }
}

/// Changes precision, size or components of the frame header.
fn frame(segments: &mut [Segment], dice: &mut Dice) {
    let is_frame = |segment: &&mut Segment| (0xc0..0xc4).contains(&segment.marker);
    let Some(frame) = segments.iter_mut().find(is_frame) else { return };
    let at = dice.below(frame.data.len());
    let value = *dice.one(&[0, 1, 2, 3, 4, 8, 0x11, 0x12, 0x21, 0x22, 0x41, 0x44, 0xff]);
    if let Some(byte) = frame.data.get_mut(at) {
        *byte = value;
    }
}

/// Splits a file into its segments. The bytes after the header of a scan belong to the segment of
/// that header.
fn segments(file: &[u8]) -> Vec<Segment> {
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(&[0xff, marker]) = file.get(at..at + 2) {
        at += 2;
        let sized = !matches!(marker, 0xd0..=0xd9 | 0x01);
        if sized {
            let Some(&[high, low]) = file.get(at..at + 2) else { break };
            let end = (at + usize::from(u16::from_be_bytes([high, low]))).min(file.len());
            let data = file.get(at + 2..end).unwrap_or_default().to_vec();
            found.push(Segment { marker, sized, data });
            at = end;
        } else {
            found.push(Segment { marker, sized, data: Vec::new() });
        }
        // Coded data up to the next marker that is no stuffed zero and no restart.
        let is_next = |pair: &[u8]| pair[0] == 0xff && !matches!(pair[1], 0 | 0xd0..=0xd7);
        let rest = &file[at..];
        let length = rest.windows(2).position(is_next).unwrap_or(rest.len());
        if length > 0 {
            found.push(Segment { marker: 0, sized: false, data: rest[..length].to_vec() });
        }
        at += length;
    }
    found
}

fn joined(segments: &[Segment]) -> Vec<u8> {
    let mut file = Vec::new();
    for segment in segments {
        if segment.marker != 0 {
            file.extend([0xff, segment.marker]);
        }
        if segment.sized {
            file.extend((segment.data.len() as u16).wrapping_add(2).to_be_bytes());
        }
        file.extend(&segment.data);
    }
    file
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments_are_joined_to_the_same_file() {
        let mut file = std::io::Cursor::new(Vec::new());
        let picture =
            image::RgbImage::from_fn(20, 20, |x, y| image::Rgb([x as u8 * 9, y as u8, 3]));
        picture.write_to(&mut file, image::ImageFormat::Jpeg).unwrap();
        let file = file.into_inner();
        let segments = segments(&file);
        assert!(segments.len() > 5, "{}", segments.len());
        assert_eq!(joined(&segments), file);
    }
}
