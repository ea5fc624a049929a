//! Input that would take too much memory is refused with one sentence, before memory is allocated.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::bench;

use bench::{Bench, TEXTURED_WALL, WALL, encoded, ending};
use image::{ImageFormat, RgbImage};

/// Returns a wall with a picture of 256 by 256 texels: 65536 texels of 6 bytes each, or 12 while
/// they are read.
fn wall() -> Bench {
    let bench = Bench::with_scene(TEXTURED_WALL);
    bench.write("checks.png", encoded(RgbImage::new(256, 256), ImageFormat::Png));
    bench
}

/// Bytes that are allowed besides the textures: the text of the scene and small pictures.
const BESIDE: u64 = 30_000;

#[test]
fn a_picture_is_measured_before_it_is_decoded() {
    let place = "scene.json:4:36: textures.checks.image: checks.png: a picture of 256x256 pixels ";
    let said = [place, "needs 786432 bytes, and 700000 bytes are allowed", "raise --max-memory"];
    wall().refuse(&["scene.json", "--max-memory", "700000"], b"", 6, &said);
    let arguments = ["scene.json", "--max-memory", "800k", "--filter", "point", "--size", "4x4"];
    wall().make(&[&arguments[..], &["-o", "a.png"]].concat(), b"");
}

/// Returns the CRC of a PNG chunk, computed bit by bit.
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 * (crc & 1)))
    })
}

#[test]
fn a_small_file_that_claims_a_huge_picture_is_not_believed() {
    let mut file = encoded(RgbImage::new(1, 1), ImageFormat::Png);
    // Width and height follow the signature and the first chunk's length and name.
    for side in [16, 20] {
        file[side..side + 4].copy_from_slice(&2_000_000u32.to_be_bytes());
    }
    let sum = crc(&file[12..29]);
    file[29..33].copy_from_slice(&sum.to_be_bytes());
    let bench = wall();
    bench.write("checks.png", file);
    let found = "scene.json:4:36: textures.checks.image: checks.png: a picture of 2000000x2000000";
    bench.refuse(&["scene.json"], b"", 6, &[found, "needs 44703.5 GB"]);
}

#[test]
fn several_textures_share_what_there_is() {
    let one = r#"{ "image": "checks.png" }"#;
    let text = TEXTURED_WALL.replacen(one, &format!("{one}, \"more\": {one}"), 1);
    let bench = wall();
    bench.write("scene.json", text);
    // The first picture keeps 393216 bytes, and a row takes 4096.
    let arguments = ["scene.json", "--max-memory", "1000000"];
    let said = ["scene.json:4:", "textures.more.image: ", "of which 397312 bytes are in use"];
    bench.refuse(&arguments, b"", 6, &said);
}

#[test]
fn tables_are_measured_before_they_are_built() {
    // 258 x 258 entries of 3 channels of 8 bytes, and 259 x 259 for the quadratic.
    for (filter, table) in [("tent", 258 * 258 * 24u64), ("quadratic", 259 * 259 * 24)] {
        let limit = (table + 393_215).to_string();
        let arguments = ["scene.json", "--filter", filter, "--max-memory", &limit];
        let said = ["texture checks: the data of the ", filter, "256x256 texels needs "];
        wall().refuse(&arguments, b"", 6, &said);
        let enough = (table + 393_216 + BESIDE).to_string();
        let arguments = ["scene.json", "--filter", filter, "--max-memory", &enough];
        wall().make(&[&arguments[..], &["-o", "a.png", "--size", "4x4"]].concat(), b"");
    }
}

#[test]
fn a_texture_that_nothing_shows_needs_no_room_for_a_table() {
    let text = TEXTURED_WALL.replace(r#", "texture": "checks""#, "");
    let bench = wall();
    bench.write("scene.json", text);
    bench.make(&["scene.json", "--max-memory", "800k", "-o", "a.png", "--size", "4x4"], b"");
}

#[test]
fn a_picture_with_layers_is_measured_before_it_is_rendered() {
    let layers = "normal,depth,uv,object,footprint";
    let arguments = ["scene.json", "-o", "a.exr", "--layers", layers, "--size", "65536x4096"];
    let bench = Bench::with_scene(WALL);
    let run = bench.run(&[&arguments[..], &["--max-memory", "20G"]].concat(), b"");
    let (code, said) = ending(&run);
    assert_eq!(code, Some(6), "{said}");
    let expected = "render: a picture of 65536x4096 pixels with 5 layers needs 36.0 GB, and 20.0 \
                    GB are allowed: make the input or the result smaller, or raise --max-memory\n";
    assert_eq!(said, expected);
    // A crop takes only the memory of its own pixels.
    let crop = ["--crop", "0,0,8x8", "--max-memory", "1M"];
    bench.make(&[&arguments[..], &crop].concat(), b"");
}

#[cfg(target_os = "linux")]
#[test]
fn a_limited_address_space_ends_with_a_sentence() {
    let bench = Bench::with_scene(WALL);
    let program = env!("CARGO_BIN_EXE_render");
    for (size, limit) in [("16384x16384", ""), ("16384x16384", " --max-memory 100G")] {
        let line = format!(
            "ulimit -v 2000000; exec {program} scene.json -q -o a.png --threads 1 --size {size}{limit}"
        );
        let mut shell = std::process::Command::new("sh");
        let run = shell.args(["-c", &line]).current_dir(bench.path("")).output().unwrap();
        let (code, said) = ending(&run);
        assert_eq!(code, Some(6), "{said}");
        assert!(said.starts_with("render: a picture of 16384x16384 pixels needs "), "{said}");
    }
}

#[test]
fn a_size_that_is_none_ends_with_2() {
    for bad in ["much", "-1", "1.5G", "1T", ""] {
        let flag = format!("--max-memory={bad}");
        let arguments = ["scene.json", "-o", "a.png", &flag];
        let (code, said) = ending(&wall().run(&arguments, b""));
        assert_eq!(code, Some(2), "{bad}: {said}");
        assert!(said.contains("--max-memory"), "{said}");
    }
}
