//! Surfaces that masks cut out: their edges, their shadows, and the sources of masks.

use crate::bench::{Bench, encoded, ending};
use image::{ImageFormat, Rgb32FImage, Rgba, RgbaImage};

/// A white page of side 2 before a blue background, in ambient light, in a view of 2 by 2.
fn page(keys: &str, more: &str) -> String {
    format!(
        r#"{{ "format": "tb-scene", "version": 1, "ambient": 1, "background": [0, 0, 1],
        "camera": {{ "eye": [0, 0, 5], "target": [0, 0, 0], "height": 2 }},
        "textures": {{ "leaf": {{ "image": "leaf.png", "wrap": "clamp"{keys} }} }},
        "materials": {{ "m": {{ "diffuse": 0 }} }},
        "objects": [ {{ "rectangle": {{ "corner": [-1, -1, 0], "edge_u": [2, 0, 0],
            "edge_v": [0, 2, 0], "material": "m", "texture": "leaf" }} }}{more} ] }}"#
    )
}

/// A picture of two halves: red, and transparent green.
fn leaf() -> Vec<u8> {
    let texel = |x, _| if x < 32 { Rgba([255, 0, 0, 255]) } else { Rgba([0, 255, 0, 0]) };
    encoded(RgbaImage::from_fn(64, 64, texel), ImageFormat::Png)
}

/// Renders, and returns the linear colours.
fn rendered(bench: &Bench, flags: &[&str]) -> Rgb32FImage {
    let run = bench.run(&[&["scene.json", "-o", "out.exr"], flags].concat(), b"");
    assert_eq!(ending(&run), (Some(0), String::new()));
    image::load_from_memory(&bench.read("out.exr")).unwrap().to_rgb32f()
}

/// Each pixel is a mixture of the leaf and of the background by the covered part of the pixel; the green
/// of the transparent texels shows nowhere.
#[test]
fn a_cut_out_is_averaged_over_pixels_without_fringes() {
    let bench = Bench::with_scene(&page("", ""));
    bench.write("leaf.png", leaf());
    for flags in [&[][..], &["--split", "none"], &["--sampling", "thesis", "--filter", "exact"]] {
        // With an odd number of columns, the middle one is half covered.
        let picture = rendered(&bench, &[&["--size", "9x9"], flags].concat());
        for (x, y, pixel) in picture.enumerate_pixels() {
            let covered = match x {
                0..4 => 1.0,
                4 => 0.5,
                _ => 0.0,
            };
            let truth = [covered, 0.0, 1.0 - covered];
            // Thesis's footprints are three pixels wide.
            let near = if flags.contains(&"thesis") { 0.51 } else { 2e-3 };
            let is_near = (0..3).all(|k| (pixel.0[k] - truth[k]).abs() < near);
            assert!(is_near && pixel.0[1] == 0.0, "{flags:?}: {x},{y}: {pixel:?}");
            let whole = pixel.0[0] + pixel.0[2];
            assert!((whole - 1.0).abs() < 1e-4, "{flags:?}: {x},{y}: {pixel:?}");
        }
    }
}

/// Layers show what is seen: the object behind a hole.
#[test]
fn layers_look_through_holes() {
    let behind = r#", { "plane": { "point": [0, 0, -3], "edge_u": [1, 0, 0], "edge_v": [0, 1, 0],
        "material": "m" } }"#;
    let bench = Bench::with_scene(&page("", behind));
    bench.write("leaf.png", leaf());
    bench.make(&["scene.json", "-o", "out.exr", "--size", "4x4", "--layers", "object,depth"], b"");
    for (name, left, right) in [("object.id", 0.0, 1.0), ("depth.Z", 5.0, 8.0)] {
        let channels = fixtures::exr::channels(&bench.read("out.exr"));
        let (_, values) = channels.iter().find(|(known, _)| known == name).unwrap();
        assert_eq!(values[..4], [left, left, right, right], "{name}");
    }
}

#[test]
fn alpha_is_ignored_on_request() {
    let bench = Bench::with_scene(&page(r#", "alpha": "ignore""#, ""));
    bench.write("leaf.png", leaf());
    let picture = rendered(&bench, &["--size", "8x8"]);
    assert_eq!([1, 6].map(|x| picture.get_pixel(x, 4).0), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
}

/// Ten cut-outs, one behind another, show what is behind all of them.
#[test]
fn cut_outs_stand_one_behind_another_at_no_depth() {
    let more: String = (1..10)
        .map(|k| {
            format!(
                r#", {{ "rectangle": {{ "corner": [-1, -1, {}], "edge_u": [2, 0, 0],
                "edge_v": [0, 2, 0], "material": "m", "texture": "leaf" }} }}"#,
                -k
            )
        })
        .collect();
    let scene = page("", &more).replace(r#""version": 1,"#, r#""version": 1, "max_depth": 0,"#);
    let bench = Bench::with_scene(&scene);
    bench.write("leaf.png", leaf());
    let picture = rendered(&bench, &["--size", "8x8"]);
    assert_eq!([1, 6].map(|x| picture.get_pixel(x, 4).0), [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
}

/// A light straight above shines through the transparent half of a lid onto the floor, also through
/// several lids and through the walls of a box that is cut out.
#[test]
fn shadows_are_cut_out_too() {
    let lid = |y: f64| {
        format!(
            r#"{{ "rectangle": {{ "corner": [-1, {y}, 1], "edge_u": [2, 0, 0], "edge_v": [0, 0, -2],
            "material": "m", "texture": "leaf" }} }}"#
        )
    };
    let cuboid = r#"{ "box": { "low": [-1, 1, -1], "high": [1, 2, 1], "material": "m",
        "texture": "leaf" } }"#;
    for (lids, light) in [
        (lid(1.0), r#"{ "directional": { "direction": [0, -1, 0] } }"#),
        (
            format!("{}, {}", lid(1.0), lid(1.5)),
            r#"{ "directional": { "direction": [0, -1, 0] } }"#,
        ),
        (cuboid.to_string(), r#"{ "directional": { "direction": [0, -1, 0] } }"#),
        // From a great height, the shadow is as large as the lid.
        (lid(0.001), r#"{ "point": { "position": [0, 1000, 0] } }"#),
    ] {
        let bench = Bench::with_scene(&format!(
            r#"{{ "format": "tb-scene", "version": 1, "ambient": 0, "lights": [ {light} ],
            "camera": {{ "eye": [0, -5, 0], "target": [0, 0, 0], "up": [0, 0, -1], "height": 4 }},
            "textures": {{ "leaf": {{ "image": "leaf.png", "wrap": "clamp" }} }},
            "materials": {{ "m": {{}}, "pane": {{ "diffuse": 0, "ambient": 0, "transparency": 1,
                "reflectivity": 1, "index_of_refraction": 1 }}, "f": {{ "diffuse": 1 }} }},
            "objects": [ {lids}, {{ "plane": {{ "point": [0, 0, 0], "edge_u": [1, 0, 0],
                "edge_v": [0, 0, -1], "material": "f" }} }} ] }}"#
        ));
        bench.write("leaf.png", leaf());
        // Seen from above, beside the lids.
        let scene = String::from_utf8(bench.read("scene.json")).unwrap();
        bench.write("scene.json", scene.replace("[0, -5, 0]", "[0, 0.0005, 0]"));
        let picture = rendered(&bench, &["--size", "8x8"]);
        let at = |x: u32, y: u32| picture.get_pixel(x, y).0[0];
        // The lid covers the columns 2 to 5; its left half is opaque. Masks are smooth over a texel, and the
        // parts that pass several of them are multiplied.
        let row = [0, 1, 2, 3, 4, 5, 6, 7].map(|x| at(x, 4));
        let truth = [1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
        let near = row.iter().zip(truth).all(|(found, truth)| (found - truth).abs() < 0.08);
        assert!(near, "{lids}: {row:?}");
    }
}

/// A mask comes from the grey of `map_d`, from its alpha, or from the alpha of `map_Kd`.
#[test]
fn libraries_cut_out_surfaces() {
    let obj = "mtllib a.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
        usemtl a\nf 1/1 2/2 3/3 4/4\n";
    let scene = r#"{ "format": "tb-scene", "version": 1, "ambient": 1, "background": [0, 0, 1],
        "camera": { "eye": [0, 0, 5], "target": [0, 0, 0], "height": 2 },
        "objects": [ { "mesh": { "name": "a", "file": "a.obj" } } ] }"#;
    let bench = Bench::with_scene(scene);
    bench.write("a.obj", obj);
    bench.write("leaf.png", leaf());
    let grey =
        image::GrayImage::from_fn(128, 1, |x, _| image::Luma([if x < 64 { 255 } else { 0 }]));
    bench.write("grey.png", encoded(grey, ImageFormat::Png));
    let red = image::RgbImage::from_pixel(1, 1, image::Rgb([255, 0, 0]));
    bench.write("red.png", encoded(red, ImageFormat::Png));
    for (lines, left) in [
        ("map_Kd leaf.png\nmap_d leaf.png\n", [1.0, 0.0, 0.0]),
        ("map_Kd leaf.png\n", [1.0, 0.0, 0.0]),
        ("map_Kd red.png\nmap_d grey.png\n", [1.0, 0.0, 0.0]),
        ("Kd 1 0 0\nmap_d grey.png\n", [1.0, 0.0, 0.0]),
        ("Kd 0 1 0\nmap_d leaf.png\n", [0.0, 1.0, 0.0]),
    ] {
        bench.write("a.mtl", format!("newmtl a\n{lines}"));
        let picture = rendered(&bench, &["--size", "8x8"]);
        let found = [1, 6].map(|x| picture.get_pixel(x, 4).0);
        assert_eq!(found, [left, [0.0, 0.0, 1.0]], "{lines}");
    }
}
