//! Pictures as backgrounds: their directions, their averages, and light brighter than white.

use crate::bench::{Bench, encoded, ending};
use image::{ImageFormat, Rgb, Rgb32FImage, RgbImage};

/// A scene of one object before the picture `sky.exr`, seen along -z in a view of 90 degrees.
fn scene(keys: &str, objects: &str) -> String {
    format!(
        r#"{{ "format": "tb-scene", "version": 1, "ambient": 0,
        "background": {{ "picture": "sky.exr"{keys} }},
        "camera": {{ "eye": [0, 0, 0], "target": [0, 0, -1], "fov_deg": 90 }},
        "materials": {{
            "glass": {{ "ambient": 0, "diffuse": 0, "reflectivity": 1, "transparency": 1,
                "index_of_refraction": 1.5, "fresnel": true }},
            "mirror": {{ "ambient": 0, "diffuse": 0, "reflectivity": 1 }} }},
        "objects": [ {objects} ] }}"#
    )
}

fn sky(width: u32, height: u32, light: impl Fn(u32, u32) -> [f32; 3]) -> Vec<u8> {
    let picture = Rgb32FImage::from_fn(width, height, |x, y| Rgb(light(x, y)));
    encoded(picture, ImageFormat::OpenExr)
}

fn rendered(bench: &Bench, flags: &[&str]) -> Rgb32FImage {
    let run = bench.run(&[&["scene.json", "-o", "out.exr"], flags].concat(), b"");
    assert_eq!(ending(&run), (Some(0), String::new()));
    image::load_from_memory(&bench.read("out.exr")).unwrap().to_rgb32f()
}

/// Eight columns of different light. The view of 90 degrees shows the middle two of them.
#[test]
fn directions_are_longitude_and_latitude() {
    let bench = Bench::new();
    bench.write("sky.exr", sky(128, 64, |x, y| [(x / 16) as f32, (y / 16) as f32, 100.0]));
    for (turn, left, right) in
        [(0.0, 3.0, 4.0), (45.0, 4.0, 5.0), (-90.0, 1.0, 2.0), (360.0, 3.0, 4.0)]
    {
        bench.write("scene.json", scene(&format!(r#", "turn_deg": {turn}"#), ""));
        let picture = rendered(&bench, &["--size", "64x64"]);
        for (x, column) in [(8, left), (24, left), (40, right), (56, right)] {
            for (y, row) in [(28, 1.0), (36, 2.0)] {
                let found = picture.get_pixel(x, y).0;
                let near = [column, row, 100.0].into_iter().zip(found);
                // A code is the brightest light over 2^32.
                assert!(
                    near.clone().all(|(a, b)| (a - b).abs() < 1e-4),
                    "{turn}: {x},{y}: {found:?}"
                );
            }
        }
    }
}

/// A picture finer than the pixels is averaged, with every method, and in a mirror too.
#[test]
fn fine_pictures_are_averaged_over_what_a_pixel_sees() {
    let ball = r#"{ "sphere": { "center": [0, 0, -3], "radius": 1.2, "material": "mirror" } }"#;
    let bench = Bench::with_scene(&scene("", ball));
    bench.write("sky.exr", sky(2048, 1024, |x, y| [((x + y) % 2) as f32 * 8.0; 3]));
    for flags in
        [&["--size", "16x16"][..], &["--size", "16x16", "--sampling", "thesis", "--filter", "tent"]]
    {
        let picture = rendered(&bench, flags);
        for (x, y) in [(1, 1), (14, 3), (2, 13), (8, 8)] {
            let found = picture.get_pixel(x, y).0[0];
            assert!((found - 4.0).abs() < 0.2, "{flags:?}: {x},{y}: {found}");
        }
    }
}

/// In a white world, glass is white. A picture of 8 bits is read as sRGB.
#[test]
fn glass_in_a_white_world_is_white() {
    let ball = r#"{ "sphere": { "center": [0, 0, -3], "radius": 1.2, "material": "glass" } }"#;
    let bench = Bench::with_scene(&scene("", ball).replace("sky.exr", "sky.png"));
    let white = RgbImage::from_pixel(4, 2, Rgb([255; 3]));
    bench.write("sky.png", encoded(white, ImageFormat::Png));
    let picture = rendered(&bench, &["--size", "32x32"]);
    assert!(picture.pixels().all(|pixel| pixel.0.iter().all(|x| (x - 1.0).abs() < 1e-3)));
}

#[test]
fn faults_of_the_picture_are_placed() {
    let bench = Bench::with_scene(&scene("", ""));
    bench.refuse(
        &["scene.json"],
        b"",
        5,
        &["scene.json:2:36: background.picture: cannot read sky.exr"],
    );
    bench.write("sky.exr", "text");
    let parts = ["scene.json:2:36: background.picture: found no picture in sky.exr", "HDR or EXR"];
    bench.refuse(&["scene.json"], b"", 3, &parts);
    bench.write("scene.json", scene(r#", "turn_deg": 1e9"#, ""));
    bench.refuse(
        &["scene.json"],
        b"",
        3,
        &["scene.json:2:59: background.turn_deg: found 1000000000"],
    );
    bench.write("scene.json", scene(r#", "by_elevation": []"#, ""));
    bench.refuse(
        &["scene.json"],
        b"",
        3,
        &["scene.json:2:23: background: ", "expected by_elevation, or picture"],
    );
}
