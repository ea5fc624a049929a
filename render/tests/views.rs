//! Orthographic cameras and spot lights against closed forms.

use crate::bench::{Bench, ending};
use image::Rgb32FImage;

fn rendered(scene: &str, flags: &[&str]) -> Rgb32FImage {
    let bench = Bench::with_scene(scene);
    let run = bench.run(&[&["scene.json", "-o", "out.exr"], flags].concat(), b"");
    assert_eq!(ending(&run), (Some(0), String::new()));
    image::load_from_memory(&bench.read("out.exr")).unwrap().to_rgb32f()
}

/// A floor of diffuse white under one light, seen from above by a camera with parallel rays.
fn floor(light: &str) -> String {
    format!(
        r#"{{ "format": "tb-scene", "version": 1, "ambient": 0, "lights": [ {light} ],
        "camera": {{ "eye": [0, 10, 0], "target": [0, 0, 0], "up": [0, 0, -1], "height": 4 }},
        "materials": {{ "m": {{ "diffuse": 1 }} }},
        "objects": [ {{ "plane": {{ "point": [0, 0, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, -1],
            "material": "m" }} }} ] }}"#
    )
}

#[test]
fn a_spot_lights_a_disk_with_a_smooth_edge() {
    let light = r#"{ "spot": { "position": [0, 1, 0], "direction": [0, -2, 0], "inner_deg": 30,
        "outer_deg": 45, "color": 0.5 } }"#;
    // One ray in the middle of each pixel.
    let picture = rendered(&floor(light), &["--size", "64x64", "--split", "none"]);
    let [inner, outer] = [30f64, 45.0].map(|angle| angle.to_radians().cos());
    for (x, y, pixel) in picture.enumerate_pixels() {
        let [x, z] = [x, y].map(|k| (f64::from(k) + 0.5) / 16.0 - 2.0);
        let cosine = 1.0 / (1.0 + x * x + z * z).sqrt();
        let part = ((cosine - outer) / (inner - outer)).clamp(0.0, 1.0);
        let truth = 0.5 * cosine * part * part * (3.0 - 2.0 * part);
        assert!((f64::from(pixel.0[0]) - truth).abs() < 1e-6, "{x} {z}: {pixel:?} {truth}");
    }
}

/// A ball has the same size near and far, also where the eye is inside of glass.
#[test]
fn an_orthographic_camera_sees_no_distance() {
    let scene = |z: f64, more: &str| {
        format!(
            r#"{{ "format": "tb-scene", "version": 1, "ambient": 1, "background": 0,
            "camera": {{ "eye": [0, 0, 20], "target": [0, 0, 0], "height": 4 }},
            "materials": {{ "m": {{ "diffuse": 0 }}, "air": {{ "ambient": 0, "diffuse": 0,
                "transparency": 1, "index_of_refraction": 1.5, "absorption": 0.1 }} }},
            "objects": [ {{ "sphere": {{ "center": [0.3, 0.1, {z}], "radius": 1, "material": "m" }} }}
                {more} ] }}"#
        )
    };
    let near = rendered(&scene(10.0, ""), &["--size", "32x32"]);
    let far = rendered(&scene(-1000.0, ""), &["--size", "32x32"]);
    let sum: f32 = near.pixels().map(|pixel| pixel.0[0]).sum();
    // A disk of radius 8 pixels.
    assert!((sum - std::f32::consts::PI * 64.0).abs() < 0.7, "{sum}");
    for (a, b) in near.pixels().zip(far.pixels()) {
        // The far ball's points lose four digits.
        assert!((a.0[0] - b.0[0]).abs() < 0.1, "{a:?} {b:?}");
    }
    // A slab of glass around the plane of the eye, on the right: 1 unit of it dims the right half alone.
    let slab = r#", { "box": { "low": [0, -3, 19], "high": [3, 3, 21], "material": "air" } }"#;
    let behind = r#", { "rectangle": { "corner": [-3, -3, -2], "edge_u": [6, 0, 0], "edge_v": [0, 6, 0],
        "material": "m" } }"#;
    let dimmed = rendered(&scene(-1000.0, &format!("{slab}{behind}")), &["--size", "8x8"]);
    let [left, right] = [1, 6].map(|x| dimmed.get_pixel(x, 4).0[0]);
    assert!((left - 1.0).abs() < 1e-6 && (right - (-0.1f32).exp()).abs() < 1e-6, "{left} {right}");
}

#[test]
fn a_floor_of_texels_is_averaged_under_parallel_rays() {
    let scene = r#"{ "format": "tb-scene", "version": 1, "ambient": 1,
        "camera": { "eye": [0, 5, 5], "target": [0, 0, 0], "height": 4 },
        "textures": { "t": { "image": "checks.png" } }, "materials": { "m": { "diffuse": 0 } },
        "objects": [ { "plane": { "point": [0, 0, 0], "edge_u": [0.01, 0, 0],
            "edge_v": [0, 0, -0.01], "material": "m", "texture": "t" } } ] }"#;
    let bench = Bench::with_scene(scene);
    bench.write("checks.png", crate::bench::checks());
    bench.make(&["scene.json", "-o", "out.exr", "--size", "16x16"], b"");
    let picture = image::load_from_memory(&bench.read("out.exr")).unwrap().to_rgb32f();
    // Each pixel sees 25 x 35 checks.
    assert!(picture.pixels().all(|pixel| (pixel.0[0] - 0.5).abs() < 0.02));
}

#[test]
fn a_camera_has_an_angle_or_a_height() {
    let scene = floor(r#"{ "point": { "position": [0, 1, 0] } }"#);
    for (keys, parts) in [
        (r#""height": 4, "fov_deg": 40"#, "camera: found both of fov_deg and height, expected"),
        (r#""up": [0, 0, -1]"#, "camera: found neither of fov_deg and height, expected"),
        (r#""height": 0"#, "camera.height: found 0, expected more than 0"),
    ] {
        let bench = Bench::with_scene(&scene.replace(r#""up": [0, 0, -1], "height": 4"#, keys));
        bench.refuse(&["scene.json"], b"", 3, &["scene.json:2:", parts]);
    }
    for (keys, parts) in [
        (r#""outer_deg": 0"#, "lights[0].spot.outer_deg: found 0, expected an angle above it"),
        (r#""outer_deg": 190"#, "lights[0].spot.outer_deg: found 190, expected 0 to 180"),
        (
            r#""outer_deg": 20, "inner_deg": 30"#,
            "lights[0].spot.inner_deg: found 30, expected 0 to 20",
        ),
    ] {
        let light = format!(
            r#"{{ "spot": {{ "position": [0, 1, 0], "direction": [0, -1, 0], {keys} }} }}"#
        );
        Bench::with_scene(&floor(&light)).refuse(
            &["scene.json"],
            b"",
            3,
            &["scene.json:1:", parts],
        );
    }
}
