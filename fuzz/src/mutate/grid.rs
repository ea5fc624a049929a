//! Mutations of grid files, with correct checksums.

use super::{bytes, json, text};
use crate::dice::Dice;
use serde_json::Value;

/// Number of bytes of a binary row: without its columns, and for each column.
const ROW: [usize; 2] = [9, 36];

/// The parts of a patch in a grid file.
#[derive(Debug, Clone)]
pub struct Patch {
    /// The header line.
    pub header: Value,
    /// The rows; those of text without their newlines.
    pub rows: Vec<Vec<u8>>,
    /// True if the rows are binary.
    pub binary: bool,
}

/// Splits a file that `sweep` wrote into its patches.
#[must_use]
pub fn patches(file: &[u8]) -> Vec<Patch> {
    let mut rest = file;
    let mut found = Vec::new();
    while let Some(end) = rest.iter().position(|&byte| byte == b'\n') {
        let Ok(header) = serde_json::from_slice::<Value>(&rest[..end]) else { break };
        rest = &rest[end + 1..];
        let binary = header["encoding"] == "binary";
        let count = header["rows"].as_u64().unwrap_or(0) as usize;
        let cols = header["cols"].as_u64().unwrap_or(0) as usize;
        let mut rows = Vec::new();
        for _ in 0..count {
            let length = if binary {
                ROW[0] + ROW[1] * cols
            } else {
                rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len())
            };
            let length = length.min(rest.len());
            rows.push(rest[..length].to_vec());
            rest = rest.get(length + usize::from(!binary)..).unwrap_or_default();
        }
        let footer = if binary { Some(12) } else { rest.iter().position(|&b| b == b'\n') };
        rest = footer.and_then(|length| rest.get(length + usize::from(!binary)..)).unwrap_or(&[]);
        found.push(Patch { header, rows, binary });
    }
    found
}

/// Returns the file of these patches, with correct checksums. The footer counts the rows that
/// exist.
#[must_use]
pub fn file(patches: &[Patch]) -> Vec<u8> {
    let mut file = Vec::new();
    for patch in patches {
        let start = file.len();
        file.extend(patch.header.to_string().into_bytes());
        file.push(b'\n');
        for row in &patch.rows {
            file.extend(row);
            if !patch.binary {
                file.push(b'\n');
            }
        }
        let mut crc = crc32fast::Hasher::new();
        crc.update(&file[start..]);
        let (rows, crc) = (patch.rows.len() as u64, crc.finalize());
        if patch.binary {
            file.extend(rows.to_le_bytes());
            file.extend(crc.to_le_bytes());
        } else {
            file.extend(format!("{{\"rows\":{rows},\"crc32\":{crc}}}\n").into_bytes());
        }
    }
    file
}

/// Returns a mutated file.
#[must_use]
pub fn mutated(seed: &[Patch], dice: &mut Dice, others: &[Patch], index: &json::Index) -> Vec<u8> {
    let mut patches = seed.to_vec();
    for _ in 0..=dice.below(2) {
        change(&mut patches, dice, others, index);
    }
    let mut file = file(&patches);
    if dice.once_in(12) {
        bytes::mutate(&mut file, dice, b"{\"rows\":");
    }
    file
}

fn change(patches: &mut Vec<Patch>, dice: &mut Dice, others: &[Patch], index: &json::Index) {
    if patches.is_empty() {
        return;
    }
    let chosen = dice.below(patches.len());
    if dice.once_in(20) {
        let other = if dice.once_in(2) { others.first() } else { patches.get(chosen) };
        patches.extend(other.cloned());
        return;
    }
    let patch = &mut patches[chosen];
    if dice.once_in(2) || patch.rows.is_empty() {
        json::mutate(&mut patch.header, dice, index);
        return;
    }
    let (a, b) = (dice.below(patch.rows.len()), dice.below(patch.rows.len()));
    match dice.below(12) {
        0 => {
            patch.rows.remove(a);
            patch.header["rows"] = patch.rows.len().into();
        }
        1 => {
            patch.rows.insert(b, patch.rows[a].clone());
            patch.header["rows"] = patch.rows.len().into();
        }
        2 => patch.rows.swap(a, b),
        3 => drop(patch.rows.remove(a)),
        4..6 => {
            // The points or normals of another row.
            let (from, to) = (patch.rows[b].clone(), &mut patch.rows[a]);
            let keep = if patch.binary { ROW[0].min(from.len()).min(to.len()) } else { 0 };
            to.truncate(keep);
            to.extend(&from[keep..]);
        }
        _ if patch.binary => {
            let row = &mut patch.rows[a];
            // At a coordinate of a point, or at any position.
            let at = if dice.once_in(3) {
                dice.below(row.len())
            } else {
                9 + 8 * dice.below(row.len() / 12)
            };
            bytes::double(row, at, dice);
        }
        _ => {
            let other = patch.rows[b].clone();
            if dice.once_in(3) {
                text::mutate(&mut patch.rows[a], dice, &["[", "]", ","], &other);
            } else {
                text::number(&mut patch.rows[a], dice);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sweep::grid::file::{Encoding, write_all};

    #[test]
    fn files_are_taken_apart_and_put_together_with_right_checksums() {
        let corpus = crate::seeds::Corpus::load().unwrap();
        let several = corpus.grids.iter().find(|grids| grids.len() > 1).unwrap();
        for encoding in [Encoding::Binary, Encoding::Json] {
            let mut bytes = Vec::new();
            write_all(several, encoding, &mut bytes).unwrap();
            let patches = patches(&bytes);
            assert_eq!(patches.len(), several.len());
            let again = sweep::grid::file::read_all("a.grid", &file(&patches)[..]).unwrap();
            assert_eq!(&again, several);
        }
    }
}
