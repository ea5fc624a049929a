//! Tests of grids written and read back: whole, cut, damaged and made up.

use super::*;
use crate::grid::{Across, Area, Fold, Seam, Tolerance, UvLayout};
use files::{Exit, Failure};
use glam::DVec3;
use proptest::prelude::*;

const ENCODINGS: [Encoding; 2] = [Encoding::Binary, Encoding::Json];

/// Returns a grid of three rows and four columns, closed along `u`, whose name needs escapes.
pub(super) fn small() -> GridMesh {
    let point = |i: usize| DVec3::new(i as f64 / 3.0, -(i as f64) * 1e-7, 1.0 + i as f64);
    GridMesh {
        name: "a \"small\" grid\n".into(),
        seam_u: Seam::Closed,
        seam_v: Seam::Open,
        uv: UvLayout { across: Across::Trajectory, repeat: [2.0, 0.1], ..UvLayout::default() },
        u: vec![0.0, 0.25, 0.25, 0.7],
        v: vec![0.0, 1.0 / 3.0, 1.0],
        positions: (0..12).map(point).collect(),
        normals: (0..12).map(|i| point(i).as_vec3().normalize()).collect(),
        ..GridMesh::default()
    }
}

pub(super) fn bytes_of(grid: &GridMesh, encoding: Encoding) -> Vec<u8> {
    let mut bytes = Vec::new();
    write(grid, encoding, &mut bytes).unwrap();
    bytes
}

fn complaint(bytes: &[u8]) -> String {
    read("grid.tbg", bytes).unwrap_err().to_string()
}

/// Returns a binary file with a checksum that fits, whatever the bytes before it are.
fn signed(mut bytes: Vec<u8>) -> Vec<u8> {
    let end = bytes.len() - 4;
    let crc = crc32fast::hash(&bytes[..end - 8]);
    bytes[end..].copy_from_slice(&crc.to_le_bytes());
    bytes
}

fn header_len(bytes: &[u8]) -> usize {
    1 + bytes.iter().position(|&b| b == b'\n').unwrap()
}

proptest! {
    #[test]
    fn noise_is_refused(noise in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = read("noise", noise.as_slice()).unwrap_err();
        let grid = small();
        let mut bytes = bytes_of(&grid, Encoding::Binary);
        bytes.truncate(header_len(&bytes));
        bytes.extend(noise);
        let _ = read("noise", bytes.as_slice()).unwrap_err();
    }
}

#[test]
fn the_text_grid_of_the_module_doc_is_one() {
    let text: String = include_str!("../file.rs")
        .lines()
        .skip_while(|line| *line != "//! ```json")
        .skip(1)
        .take_while(|line| *line != "//! ```")
        .map(|line| format!("{}\n", line.trim_start_matches("//! ")))
        .collect();
    let grid = read("doc", text.as_bytes()).unwrap();
    assert_eq!((grid.rows(), grid.cols(), grid.positions[5]), (2, 3, DVec3::new(2.0, 1.0, 0.0)));
    assert_eq!(String::from_utf8(bytes_of(&grid, Encoding::Json)).unwrap(), text);
}

#[test]
fn a_binary_point_takes_36_bytes() {
    let bytes = bytes_of(&small(), Encoding::Binary);
    assert_eq!(bytes.len(), header_len(&bytes) + 3 * (9 + 4 * 36) + 12);
}

#[test]
fn every_cut_is_noticed() {
    for encoding in ENCODINGS {
        let bytes = bytes_of(&small(), encoding);
        for end in 0..bytes.len() {
            let error = read("grid.tbg", &bytes[..end]).unwrap_err();
            assert_eq!(error.exit(), Exit::Malformed);
            let message = error.to_string();
            assert!(end == 0 || message.contains("cut short"), "{end}: {message}");
        }
    }
}

#[test]
fn every_damaged_byte_is_noticed() {
    for encoding in ENCODINGS {
        let good = bytes_of(&small(), encoding);
        for place in 0..good.len() {
            for change in [1, 2, 4, 8, 16, 32, 64, 128, 255] {
                let mut bytes = good.clone();
                bytes[place] ^= change;
                assert!(read("grid.tbg", bytes.as_slice()).is_err(), "{place} ^ {change}");
            }
        }
    }
}

#[test]
fn a_cut_says_which_row() {
    let bytes = bytes_of(&small(), Encoding::Binary);
    let row = 9 + 4 * 36;
    assert_eq!(
        complaint(&bytes[..header_len(&bytes) + row + 1]),
        "grid.tbg: row 2 of 3 is cut short: the program that wrote it stopped early"
    );
    assert!(complaint(&bytes[..bytes.len() - 1]).contains("after the last of 3 rows"));
    let message = read("<stdin>", &[][..]).unwrap_err().to_string();
    assert_eq!(
        message,
        "<stdin> is empty, expected a grid: the program before the pipe wrote nothing"
    );
}

#[test]
fn a_wrong_number_is_placed() {
    let good = bytes_of(&small(), Encoding::Binary);
    let (head, row) = (header_len(&good), 9 + 4 * 36);
    let with = |at: usize, value: &[u8]| {
        let mut bytes = good.clone();
        bytes[at..at + value.len()].copy_from_slice(value);
        complaint(&signed(bytes))
    };
    assert_eq!(
        with(head + row + 9 + 24, &f64::NAN.to_le_bytes()),
        "grid.tbg: row 2 of 3: the position of column 1: found a number that is not finite, \
         expected finite numbers"
    );
    let normal = with(head + 9 + 4 * 24 + 3 * 12, &f32::INFINITY.to_le_bytes());
    assert!(normal.contains("row 1 of 3: the normal of column 3"), "{normal}");
    let order = with(head + 2 * row, &0.25_f64.to_le_bytes());
    assert!(order.contains("row 3 of 3: v: found 0.25, expected a number from 0.333"), "{order}");
    let flags = with(head + 8, &[2]);
    assert!(flags.contains("row 1 of 3: flags: found 2, expected 0"), "{flags}");
    let count = with(good.len() - 12, &[9]);
    assert!(count.contains("found 9 rows in the closing count, expected the 3"), "{count}");
}

#[test]
fn a_text_row_is_placed_by_line_and_column() {
    let text = String::from_utf8(bytes_of(&small(), Encoding::Json)).unwrap();
    let shorter = text.replacen("],[0.3333333333333333,-1e-7,2.0]", "]", 1);
    let message = complaint(shorter.as_bytes());
    assert!(message.starts_with("grid.tbg:2:"), "{message}");
    assert!(message.contains("found 3 positions, expected 4"), "{message}");
    let null = complaint(text.replacen("1.0]", "null]", 1).as_bytes());
    assert!(null.contains("grid.tbg:2:") && null.contains("(row 1 of 3)"), "{null}");
    let lines: Vec<&str> = text.lines().collect();
    let without_a_row = [lines[0], lines[1], lines[2], lines[4], ""].join("\n");
    let message = complaint(without_a_row.as_bytes());
    assert!(message.contains("row 3 of 3 is missing"), "{message}");
}

#[test]
fn a_hand_edited_text_grid_fails_its_checksum() {
    let text = String::from_utf8(bytes_of(&small(), Encoding::Json)).unwrap();
    let message = complaint(text.replacen("2.0]", "2.5]", 1).as_bytes());
    assert!(message.contains("was changed or damaged after it was written"), "{message}");
}

#[test]
fn nothing_may_follow() {
    for encoding in ENCODINGS {
        let mut bytes = bytes_of(&small(), encoding);
        bytes.push(b'\n');
        assert!(complaint(&bytes).contains("bytes after the end"));
    }
}

#[test]
fn the_header_is_checked() {
    let good = String::from_utf8(bytes_of(&small(), Encoding::Json)).unwrap();
    let with = |from: &str, to: &str| {
        assert!(good.contains(from), "{from}");
        complaint(good.replacen(from, to, 1).as_bytes())
    };
    for (from, to, expected) in [
        ("\"version\":1", "\"version\":2", "found a grid of version 2, expected version 1"),
        ("\"rows\":3", "\"rows\":1", "rows: found 1, expected from 2 to 4294967295"),
        ("\"rows\":3", "\"rows\":1e9", "rows: "),
        ("\"cols\":4", "\"cols\":5", "cols: found 5, expected 4, the number of values in u"),
        ("0.25,0.7", "0.25,1.0", "u[3]: found 1, expected a number from 0.25"),
        ("0.25,0.7", "0.25,0.2", "u[3]: found 0.2, expected a number from 0.25"),
        ("\"u\":[0.0", "\"u\":[0.1", "u[0]: found 0.1, expected 0"),
        ("[2.0,0.1]", "[2.0,-0.1]", "uv.repeat[1]: found -0.1, expected a positive number"),
        (
            "\"seam_v\":\"open\"",
            "\"seam_v\":\"open\",\"shift\":2",
            "shift: found 2, expected 0 along",
        ),
        (
            "\"seam_u\":\"closed\"",
            "\"seam_u\":\"mirror\"",
            "seam_u: found mirror, expected open or",
        ),
        (
            "\"seam_v\":\"open\"",
            "\"seam_v\":\"mirror\",\"shift\":4",
            "shift: found 4, expected less than 4",
        ),
        (
            "\"uv\"",
            "\"areas\":[{\"area\":{\"rows\":[0,1],\"cols\":[0,4]},\"v\":[0,1]}],\"uv\"",
            "areas[0].area.cols: found [0, 4], expected two rising numbers from 0 to 3",
        ),
        (
            "\"uv\"",
            "\"areas\":[{\"area\":{\"rows\":[0,1],\"cols\":[0,1]},\"v\":[1,1]}],\"uv\"",
            "areas[0].v: found [1.0, 1.0], expected two rising numbers from 0 to 1",
        ),
        ("\"endian\":\"little\"", "\"endian\":\"big\"", "endian"),
        ("\"seam_u\"", "\"seem_u\"", "did you mean `seam_u`?"),
        ("\"tb-grid\"", "\"tb-sweep\"", "it is JSON without \"format\":\"tb-grid\""),
    ] {
        let message = with(from, to);
        assert!(message.contains(expected), "{message}");
    }
}

/// Found by the fuzzer: such a grid was read, but no writer accepted it.
#[test]
fn an_area_that_the_rows_do_not_have_is_refused() {
    let area = Area { rows: [0, 2], cols: [0, 3], texture: None, surface: None, repeat: [1.0; 2] };
    let grid = GridMesh { areas: vec![area], ..small() };
    for encoding in ENCODINGS {
        assert_eq!(read("a.grid", &bytes_of(&grid, encoding)[..]).unwrap(), grid);
    }
    let text = String::from_utf8(bytes_of(&grid, Encoding::Json)).unwrap();
    let with = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        complaint(resigned(&text.replacen(from, to, 1)).as_bytes())
    };
    assert_eq!(
        with("\"v\":[0.0,1.0]", "\"v\":[0.0,0.5]"),
        "grid.tbg: row 3 of 3: areas[0].v[1]: found 0.5, expected 1.0, the v of the row"
    );
    // Two rows at one `v` are one edge of cells.
    assert_eq!(
        with("[0.3333333333333333,0,", "[0.0,0,"),
        "grid.tbg: row 3 of 3: areas[0].area.rows: found [0, 2], expected two rising numbers from 0 to 1, \
         the number of cells"
    );
}

/// Found by the fuzzer: messages had hundreds of zeros, and names of Rust types.
#[test]
fn numbers_of_a_text_grid_are_complained_of_in_short_words() {
    let text = String::from_utf8(bytes_of(&small(), Encoding::Json)).unwrap();
    let tiny = complaint(text.replacen("[0.0,0,[[", "[1e-320,0,[[", 1).as_bytes());
    assert_eq!(tiny, "grid.tbg: row 1 of 3: v: found 1e-320, expected 0, where every grid starts");
    let pair = complaint(text.replacen("[0.0,-0.0,1.0]", "[0.0,1.0]", 1).as_bytes());
    assert!(pair.contains("[2][0]: found 2 values, expected 3 (row 1 of 3)"), "{pair}");
}

/// Returns a text grid with a checksum that fits.
fn resigned(text: &str) -> String {
    let end = 1 + text.trim_end().rfind('\n').unwrap();
    let crc = crc32fast::hash(&text.as_bytes()[..end]);
    let rows = text.lines().count() - 2;
    format!("{}{{\"rows\":{rows},\"crc32\":{crc}}}\n", &text[..end])
}

#[test]
fn other_files_are_called_by_their_names() {
    for (bytes, expected) in [
        (&b"# topobook triangulate OBJ 1\no a\nv 0 0 0\n"[..], "looks like an OBJ mesh"),
        (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "is a PNG picture"),
        (b"{\n  \"contour\": {}\n}\n", "if it is a curve spec, `sweep` makes its grid"),
        (b"{\"contour\":{}}", "if it is a curve spec"),
        (b"hello", "starts with \"hello\", expected {\"format\":\"tb-grid\""),
    ] {
        let message = complaint(bytes);
        assert!(message.starts_with("grid.tbg is not a grid: "), "{message}");
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn a_hostile_header_takes_no_memory_and_no_stack() {
    let huge = r#"{"format":"tb-grid","version":1,"encoding":"binary","endian":"little","name":"x","rows":4000000000,"cols":1000000000000,"seam_u":"open","seam_v":"open","uv":{},"u":[0,1]}"#;
    assert!(complaint(format!("{huge}\n").as_bytes()).contains("cols: found 1000000000000"));
    let deep = format!("{{\"format\":\"tb-grid\",\"x\":{}\n", "[".repeat(1 << 20));
    assert!(complaint(deep.as_bytes()).starts_with("grid.tbg"));
    let closed = "]".repeat(1 << 20);
    let deep = format!("{}{closed}}}\n", deep.trim_end());
    assert!(complaint(deep.as_bytes()).starts_with("grid.tbg"));
    let endless = io::Read::chain(&b"{\"format\":"[..], io::repeat(b' '));
    let message = read("grid.tbg", io::BufReader::new(endless)).unwrap_err().to_string();
    assert!(message.contains("line 1 is longer than"), "{message}");
}

#[test]
fn a_grid_that_cannot_be_read_is_not_written() {
    type Harm = fn(&mut GridMesh);
    let harms: [Harm; 7] = [
        |g| g.positions[7].y = f64::NAN,
        |g| g.normals[7].y = f32::INFINITY,
        |g| g.v[1] = 2.0,
        |g| g.u[1] = 0.9,
        |g| g.positions.truncate(11),
        |g| g.fold = Some(Fold { worst: f64::NAN, rows: 0, fits: None }),
        |g| g.tolerance = Some(Tolerance { pixels: Some(f64::INFINITY), ..Tolerance::default() }),
    ];
    for harm in harms {
        let mut grid = small();
        harm(&mut grid);
        let error = write(&grid, Encoding::Binary, &mut Vec::new()).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::InvalidInput, "{error}");
    }
}
