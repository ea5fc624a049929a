//! The committed textures are what the program draws, and what the scenes expect of them.

use draw_textures::TEXTURES;
use image::{Rgb, RgbImage};
use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

/// The largest file among the textures, and all of them together, in bytes.
const LARGEST: u64 = 350_000;
const TOGETHER: u64 = 1_200_000;

fn path_of(file: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..").join(file)
}

fn committed(file: &str) -> RgbImage {
    image::open(path_of(file)).expect("the texture is committed").into_rgb8()
}

#[test]
fn every_texture_is_what_the_program_draws() {
    for texture in TEXTURES {
        let drawn = (texture.draw)();
        let kept = committed(texture.file);
        assert_eq!(drawn.dimensions(), kept.dimensions(), "{}", texture.file);
        let differing = drawn.pixels().zip(kept.pixels()).filter(|(d, k)| d != k).count();
        let remedy = "cargo run --release -p draw-textures -- -o examples/textures";
        assert_eq!(differing, 0, "texels of {} differ; to make it anew: {remedy}", texture.file);
    }
}

#[test]
fn the_files_stay_small() {
    let sizes = TEXTURES.map(|texture| fs::metadata(path_of(texture.file)).unwrap().len());
    assert!(sizes.iter().all(|&size| size < LARGEST), "{sizes:?}");
    assert!(sizes.iter().sum::<u64>() < TOGETHER, "{sizes:?}");
}

#[test]
fn every_picture_has_its_line_in_the_readme_and_the_other_way_round() {
    let readme = fs::read_to_string(path_of("README.md")).unwrap();
    let listed: BTreeSet<String> = readme
        .lines()
        .filter_map(|line| line.strip_prefix("| `")?.split_once('`'))
        .map(|(file, _)| file.to_owned())
        .collect();
    let present: BTreeSet<String> = fs::read_dir(path_of(""))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".png"))
        .collect();
    assert_eq!(listed, present);
}

#[test]
fn both_checkerboards_have_eight_by_eight_sharp_checks_the_bottom_left_one_light() {
    let boards = [("checkerboard.png", None), ("peer-checker.png", Some([[230; 3], [26; 3]]))];
    for (file, expected) in boards {
        let board = committed(file);
        let (width, height) = board.dimensions();
        let light = *board.get_pixel(0, height - 1);
        let dark = *board.get_pixel(0, 0);
        if let Some(expected) = expected {
            assert_eq!([light, dark], expected.map(Rgb), "{file}");
        }
        assert!((0..3).all(|channel| light[channel] > dark[channel]), "{file}");
        for (x, y, texel) in board.enumerate_pixels() {
            let is_dark = (x * 8 / width + y * 8 / height).is_multiple_of(2);
            assert_eq!(*texel, if is_dark { dark } else { light }, "{file} at {x}, {y}");
        }
    }
}
