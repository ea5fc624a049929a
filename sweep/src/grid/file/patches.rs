//! Tests of files with several grids: whole, cut between two, and assembled wrongly.

use super::tests::{bytes_of, small};
use super::*;
use files::{Exit, Failure};

const ENCODINGS: [Encoding; 2] = [Encoding::Binary, Encoding::Json];

/// Returns the patches of a cup, its handle and its lid.
fn patches() -> Vec<GridMesh> {
    let named = |name: &str| GridMesh { name: name.into(), ..small() };
    let handle = GridMesh { texture: Some(3), surface: Some(0), ..named("handle") };
    vec![named("cup"), handle, named("lid")]
}

fn all_bytes(encoding: Encoding) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_all(&patches(), encoding, &mut bytes).unwrap();
    bytes
}

fn complaint(bytes: &[u8]) -> String {
    let error = read_all("cup.grid", bytes).unwrap_err();
    assert_eq!(error.exit(), Exit::Malformed);
    error.to_string()
}

/// Returns the byte offsets at which patches start in a text file.
fn starts(text: &str) -> Vec<usize> {
    text.match_indices("{\"format\"").map(|(at, _)| at).collect()
}

#[test]
fn patches_read_back_as_they_were() {
    for encoding in ENCODINGS {
        assert_eq!(read_all("cup.grid", all_bytes(encoding).as_slice()).unwrap(), patches());
    }
}

#[test]
fn objects_behind_each_other_are_a_file_too_in_any_encoding() {
    let bytes = [
        all_bytes(Encoding::Json),
        bytes_of(&small(), Encoding::Binary),
        all_bytes(Encoding::Binary),
    ];
    let expected = [patches(), vec![small()], patches()].concat();
    assert_eq!(read_all("cup.grid", bytes.concat().as_slice()).unwrap(), expected);
    let message = read("cup.grid", bytes.concat().as_slice()).unwrap_err().to_string();
    assert_eq!(message, "cup.grid: found several grids, expected one");
}

#[test]
fn rows_that_were_not_asked_for_are_passed_and_checked() {
    let mut bytes = all_bytes(Encoding::Binary);
    let mut reader = GridReader::open("cup.grid", bytes.as_slice()).unwrap();
    let mut names = vec![reader.header().name.clone()];
    while reader.next_patch().unwrap() {
        names.push(reader.header().name.clone());
    }
    assert_eq!(names, ["cup", "handle", "lid"]);
    let end = bytes.len() - 20;
    bytes[end] ^= 1;
    let mut reader = GridReader::open("cup.grid", bytes.as_slice()).unwrap();
    assert!(reader.next_patch().unwrap() && reader.next_patch().unwrap());
    let message = reader.next_patch().unwrap_err().to_string();
    assert!(message.starts_with("cup.grid, patch 3 of 3: found the checksum"), "{message}");
}

#[test]
fn every_cut_is_noticed_between_patches_too() {
    for encoding in ENCODINGS {
        let bytes = all_bytes(encoding);
        for end in 1..bytes.len() {
            let message = complaint(&bytes[..end]);
            assert!(message.contains("cut short"), "{end}: {message}");
        }
    }
    let text = String::from_utf8(all_bytes(Encoding::Json)).unwrap();
    assert_eq!(
        complaint(&text.as_bytes()[..starts(&text)[2]]),
        "cup.grid: patch 3 of 3 is missing, the grid is cut short: the program that wrote it \
         stopped early"
    );
}

#[test]
fn patches_out_of_order_are_noticed() {
    let text = String::from_utf8(all_bytes(Encoding::Json)).unwrap();
    let at = starts(&text);
    let without_the_second = [&text[..at[1]], &text[at[2]..]].concat();
    assert_eq!(
        complaint(without_the_second.as_bytes()),
        "cup.grid: found patch 3 of 3, expected patch 2 of 3: the patches are not in their order"
    );
    let message = complaint(&text.as_bytes()[at[1]..]);
    assert!(message.contains("found patch 2 of 3, expected patch 1 of 3"), "{message}");
    let message = complaint(text.replacen("\"patch\":[1,3]", "\"patch\":[4,3]", 1).as_bytes());
    assert!(
        message.contains("patch: found [4, 3], expected the patch's number, from 1"),
        "{message}"
    );
}

#[test]
fn a_fault_in_a_later_patch_is_placed_in_the_file() {
    let text = String::from_utf8(all_bytes(Encoding::Json)).unwrap();
    let at = starts(&text)[1];
    // A patch of three rows has five lines.
    let header = [&text[..at], &text[at..].replacen("\"rows\":3", "\"rows\":1", 1)].concat();
    let message = complaint(header.as_bytes());
    assert!(message.starts_with("cup.grid:6:"), "{message}");
    let row = [&text[..at], &text[at..].replacen("1.0]", "null]", 1)].concat();
    let message = complaint(row.as_bytes());
    assert!(message.starts_with("cup.grid, patch 2 of 3:7:"), "{message}");
}

#[test]
fn no_patch_is_not_written() {
    let error = write_all(&[], Encoding::Json, &mut Vec::new()).unwrap_err();
    assert!(error.to_string().contains("found no patch, expected at least one"), "{error}");
}
