//! Textures that would take too much memory are met with one sentence, before they are read.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::bench;

use bench::{Bench, TEXTURED_WALL, encoded, ending};
use image::{ImageFormat, RgbImage};

/// A wall with a picture of 64 by 64 texels: 4096 of them at 6 bytes, or 12 while they are read.
fn wall() -> Bench {
    let bench = Bench::with_scene(TEXTURED_WALL);
    bench.write("checks.png", encoded(RgbImage::new(64, 64), ImageFormat::Png));
    bench
}

#[test]
fn a_picture_is_measured_before_it_is_decoded() {
    let place = "scene.json:4:36: textures.checks.image: found 64 x 64 texels in checks.png, ";
    let arguments = ["scene.json", "--max-texture-mem", "49151"];
    wall().refuse(
        &arguments,
        b"",
        6,
        &[place, "49152 bytes", "at most 49151", "--max-texture-mem"],
    );
    let arguments = ["scene.json", "--max-texture-mem", "48k", "--filter", "point", "-o", "a.png"];
    wall().make(&arguments, b"");
}

/// The CRC of a PNG chunk, bit by bit.
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
    let found = "scene.json:4:36: textures.checks.image: found 2000000 x 2000000 texels";
    bench.refuse(&["scene.json"], b"", 6, &[found, "48000000000000 bytes", "at most 2147483648"]);
}

#[test]
fn several_textures_share_what_there_is() {
    let one = r#"{ "image": "checks.png" }"#;
    let text = TEXTURED_WALL.replacen(one, &format!("{one}, \"more\": {one}"), 1);
    let bench = wall();
    bench.write("scene.json", text);
    // The first keeps 24576 bytes.
    let arguments = ["scene.json", "--max-texture-mem", "60000"];
    let said = ["scene.json:4:", "textures.more.image: ", "49152 bytes", "beside 24576 of others"];
    bench.refuse(&arguments, b"", 6, &said);
}

#[test]
fn tables_are_measured_before_they_are_built() {
    // 66 x 66 entries of 3 channels of 8 bytes, and 67 x 67 for the quadratic.
    for (filter, table) in [("tent", 104_544), ("quadratic", 107_736)] {
        let sum = format!("all textures {}", table + 24_576);
        let limit = (table + 24_575).to_string();
        let arguments = ["scene.json", "--filter", filter, "--max-texture-mem", &limit];
        let said = ["texture checks: ", filter, "64 x 64", &sum, "--max-texture-mem"];
        wall().refuse(&arguments, b"", 6, &said);
        let enough = (table + 24_576).to_string();
        let arguments = ["scene.json", "--filter", filter, "--max-texture-mem", &enough];
        wall().make(&[&arguments[..], &["-o", "a.png", "--size", "4x4"]].concat(), b"");
    }
}

#[test]
fn a_texture_that_nothing_shows_needs_no_room_for_a_table() {
    let text = TEXTURED_WALL.replace(r#", "texture": "checks""#, "");
    let bench = wall();
    bench.write("scene.json", text);
    bench.make(&["scene.json", "--max-texture-mem", "48k", "-o", "a.png", "--size", "4x4"], b"");
}

#[test]
fn what_is_said_is_what_stats_count() {
    for filter in ["mip", "box", "tent", "quadratic"] {
        let arguments =
            ["scene.json", "-o", "a.png", "--size", "4x4", "--filter", filter, "--stats=json"];
        let (code, said) = ending(&wall().run(&arguments, b""));
        assert_eq!(code, Some(0), "{said}");
        let stats: serde_json::Value = serde_json::from_str(&said).unwrap();
        let bytes = stats["table_bytes"].as_u64().unwrap();
        if 24_576 + bytes <= 49_152 {
            // The picture is refused before the pyramid is.
            continue;
        }
        let limit = (24_575 + bytes).to_string();
        let arguments = ["scene.json", "--filter", filter, "--max-texture-mem", &limit];
        wall().refuse(&arguments, b"", 6, &["texture checks: ", &(bytes + 24_576).to_string()]);
    }
}

#[test]
fn a_size_that_is_none_ends_with_2() {
    for bad in ["much", "-1", "1.5G", "1T", ""] {
        let flag = format!("--max-texture-mem={bad}");
        let arguments = ["scene.json", "-o", "a.png", &flag];
        let (code, said) = ending(&wall().run(&arguments, b""));
        assert_eq!(code, Some(2), "{bad}: {said}");
        assert!(said.contains("--max-texture-mem"), "{said}");
    }
}
