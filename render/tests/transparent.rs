//! Transparent pictures: coverage at silhouettes, through glass and in mirrors, and the files that hold it.

use crate::bench::{Bench, ending};
use image::{Rgba32FImage, RgbaImage};
use std::f32::consts::PI;

/// A ball of radius 1 in a view of 4 by 4, in white ambient light.
fn scene(background: &str, material: &str, shape: &str) -> String {
    format!(
        r#"{{ "format": "tb-scene", "version": 1, "ambient": 1, "background": {background},
        "camera": {{ "eye": [0, 0, 5], "target": [0, 0, 0], "height": 4 }},
        "materials": {{ "m": {material} }}, "objects": [ {shape} ] }}"#
    )
}

const BALL: &str = r#"{ "sphere": { "center": [0, 0, 0], "radius": 1, "material": "m" } }"#;
const RED: &str = r#"{ "color": [0.5, 0, 0], "diffuse": 0 }"#;

fn rendered(bench: &Bench, flags: &[&str]) -> Rgba32FImage {
    let run = bench.run(&[&["scene.json", "-o", "out.exr"], flags].concat(), b"");
    assert_eq!(ending(&run), (Some(0), String::new()));
    let picture = image::load_from_memory(&bench.read("out.exr")).unwrap();
    assert!(picture.color().has_alpha());
    picture.to_rgba32f()
}

#[test]
fn silhouettes_are_covered_in_part() {
    let bench = Bench::with_scene(&scene("null", RED, BALL));
    let picture = rendered(&bench, &["--size", "40x40"]);
    let sum: f32 = picture.pixels().map(|pixel| pixel.0[3]).sum();
    // A disk of radius 10 pixels, whose edge is sampled to a sixteenth of a pixel or finer.
    assert!((sum - PI * 100.0).abs() < 1.0, "{sum}");
    for pixel in picture.pixels() {
        // Colours are multiplied by the coverage.
        let [red, green, blue, covered] = pixel.0;
        assert!((red - 0.5 * covered).abs() < 1e-6 && green == 0.0 && blue == 0.0, "{pixel:?}");
        assert!((0.0..=1.0).contains(&covered));
    }
    // A background does not show, and the crop is that part of the whole.
    bench.write("scene.json", scene("[0, 0, 1]", RED, BALL));
    let over_blue = rendered(&bench, &["--size", "40x40", "--alpha"]);
    assert_eq!(over_blue, picture);
    bench.make(&["scene.json", "--size", "40x40", "--alpha", "-o", "out.png"], b"");
    let png = image::load_from_memory(&bench.read("out.png")).unwrap().to_rgba8();
    for (pixel, linear) in RgbaImage::pixels(&png).zip(picture.pixels()) {
        assert_eq!(pixel.0[3], (linear.0[3] * 255.0).round() as u8);
        // Half of the light is code 188 wherever the ball is, also where it covers little.
        assert!(pixel.0[3] == 0 || pixel.0[0] == 188, "{pixel:?}");
    }
}

#[test]
fn glass_lets_the_page_through_and_mirrors_do_not() {
    let clear = r#"{ "ambient": 0, "diffuse": 0, "transparency": 1, "index_of_refraction": 1 }"#;
    let half = r#"{ "ambient": 0, "diffuse": 0, "transparency": 0.5, "index_of_refraction": 1 }"#;
    let mirror = r#"{ "ambient": 0, "diffuse": 0, "reflectivity": 1 }"#;
    let pane = r#"{ "rectangle": { "corner": [-1, -1, 0], "edge_u": [2, 0, 0], "edge_v": [0, 2, 0],
        "material": "m" } }"#;
    for (material, shape, covered) in [
        (clear, pane, 0.0),
        (half, pane, 0.5),
        (mirror, pane, 1.0),
        (clear, BALL, 0.0),
        (half, BALL, 0.75),
    ] {
        let bench = Bench::with_scene(&scene("0.5", material, shape));
        let picture = rendered(&bench, &["--size", "8x8", "--alpha"]);
        let [red, _, _, found] = picture.get_pixel(4, 4).0;
        assert!((found - covered).abs() < 1e-6, "{material}: {found}");
        // The mirror shows the background, and nothing else does.
        let light = if material == mirror { 0.5 } else { 0.0 };
        assert!((red - light).abs() < 1e-6, "{material}: {red}");
        assert_eq!(picture.get_pixel(0, 0).0, [0.0; 4]);
    }
    // Fresnel's reflection covers, and the light that total reflection turns inside the ball does not.
    let glass =
        r#"{ "ambient": 0, "diffuse": 0, "reflectivity": 1, "transparency": 1, "fresnel": true }"#;
    let bench = Bench::with_scene(&scene("null", glass, BALL));
    let [.., found] = rendered(&bench, &["--size", "9x9"]).get_pixel(4, 4).0;
    // At perpendicular incidence the surface mirrors 0.04, and what enters leaves again.
    assert!((found - 0.04).abs() < 5e-3, "{found}");
}

#[test]
fn files_of_one_picture_are_equal_whatever_their_names_and_threads() {
    let bench = Bench::with_scene(&scene("null", RED, BALL));
    for ending in ["png", "exr"] {
        let mut first = None;
        for (name, flags) in [("a", &["--threads", "1"][..]), ("b", &["--threads", "2", "-q"])] {
            let name = format!("{name}.{ending}");
            let flags = [&["scene.json", "--size", "16x16", "-o", &name][..], flags].concat();
            bench.make(&flags, b"");
            let bytes = bench.read(&name);
            assert!(*first.get_or_insert_with(|| bytes.clone()) == bytes, "{name}");
        }
    }
}

#[test]
fn sixteen_bits_resolve_the_dark() {
    let bench = Bench::with_scene(&scene("0", r#"{ "color": 0.0001, "diffuse": 0 }"#, BALL));
    bench.make(&["scene.json", "--size", "8x8", "--bits", "16", "-o", "out.png"], b"");
    let picture = image::load_from_memory(&bench.read("out.png")).unwrap();
    assert_eq!(picture.color(), image::ColorType::Rgb16);
    // 12.92 times 0.0001 of 65535.
    assert_eq!(picture.to_rgb16().get_pixel(4, 4).0, [85; 3]);
}
