//! Meshes, libraries and pictures as other programs write them.

use crate::bench;

use bench::{Bench, encoded, ending};
use image::{DynamicImage, ImageFormat, RgbImage, RgbaImage};

/// A square of two halves that fills the view, of materials `left` and `right`.
const HALVES: &str = "v -2 -2 0\nv 0 -2 0\nv 2 -2 0\nv 2 2 0\nv 0 2 0\nv -2 2 0\nvt 0 0\nvt 1 0\n\
    vt 1 1\nvt 0 1\nusemtl left\nf 1/1 2/2 5/3 6/4\nusemtl right\nf 2/1 3/2 4/3 5/4\n";

/// Returns a scene that shows `halves.obj` in ambient light, with these keys on the mesh.
fn scene(keys: &str) -> String {
    format!(
        r#"{{ "format": "tb-scene", "version": 1, "ambient": 1,
        "camera": {{ "eye": [0, 0, 1.5], "target": [0, 0, 0], "fov_deg": 90 }},
        "textures": {{ "blue": {{ "image": "blue.png" }} }}, "materials": {{ "grey": {{ "color": 0.5 }} }},
        "objects": [ {{ "mesh": {{ "name": "halves", "file": "halves.obj"{keys} }} }} ] }}"#
    )
}

/// Returns a folder with a scene, the halves, and pictures of one colour.
fn folder(keys: &str, obj: &str) -> Bench {
    let bench = Bench::with_scene(&scene(keys));
    bench.write("halves.obj", obj);
    for (name, color) in [("blue.png", [0, 0, 255]), ("red.png", [255, 0, 0])] {
        bench.write(name, encoded(RgbImage::from_pixel(2, 2, image::Rgb(color)), ImageFormat::Png));
    }
    bench
}

/// Renders, and returns the colours of the left and of the right half, and what was said.
fn halves(bench: &Bench) -> ([[u8; 3]; 2], String) {
    let run = bench.run(&["scene.json", "-o", "out.png", "--size", "24x16"], b"");
    let (code, said) = ending(&run);
    assert_eq!(code, Some(0), "{said}");
    let picture = image::load_from_memory(&bench.read("out.png")).unwrap().into_rgb8();
    ([6, 18].map(|x| picture.get_pixel(x, 8).0), said)
}

const RED: [u8; 3] = [255, 0, 0];
const BLUE: [u8; 3] = [0, 0, 255];
const GREY: [u8; 3] = [188; 3];
const WHITE: [u8; 3] = [255; 3];

/// A library in which both materials have the colour of a picture.
fn library(left: &str, right: &str) -> String {
    format!("newmtl left\nmap_Kd {left}\nnewmtl right\nmap_Kd {right}\n")
}

#[test]
fn the_library_that_a_mesh_names_is_found_as_other_programs_find_it() {
    for (name, file) in [
        ("halves.mtl", "halves.mtl"),
        ("my halves.mtl", "my halves.mtl"),
        ("C:\\work\\halves.mtl", "halves.mtl"),
        ("/home/someone/halves.mtl # made by hand", "halves.mtl"),
        ("Halves.MTL", "halves.mtl"),
    ] {
        let bench = folder("", &format!("mtllib {name}\n{HALVES}"));
        bench.write(file, library("red.png", "blue.png"));
        assert_eq!(halves(&bench), ([RED, BLUE], String::new()), "{name}");
    }
    let two = folder("", &format!("mtllib a.mtl b.mtl\nmtllib c.mtl\n{HALVES}"));
    two.write("a.mtl", "newmtl left\nKd 1 0 0\n");
    two.write("c.mtl", "newmtl right\nKd 0 0 1\n");
    let (found, said) = halves(&two);
    assert_eq!(found, [RED, BLUE]);
    assert!(said.starts_with("render: remark: halves.obj: mtllib: cannot read b.mtl"), "{said}");
    for names in ["my a.mtl my b.mtl", "\"my a.mtl\" \"my b.mtl\"", "\\old\\my a.mtl MY B.mtl"] {
        let spaces = folder("", &format!("mtllib {names}\n{HALVES}"));
        spaces.write("my a.mtl", "newmtl left\nKd 1 0 0\n");
        spaces.write("my b.mtl", "newmtl right\nKd 0 0 1\n");
        assert_eq!(halves(&spaces), ([RED, BLUE], String::new()), "{names}");
    }
    let lost = folder("", &format!("mtllib lost.mtl\n{HALVES}"));
    let (found, said) = halves(&lost);
    assert_eq!(found, [WHITE; 2]);
    for part in
        ["mtllib: cannot read lost.mtl", "no library has material left, which is plain white"]
    {
        assert!(said.contains(part), "{said}");
    }
    let listed = folder(r#", "mtl": ["a.mtl", "c.mtl"]"#, HALVES);
    listed.write("a.mtl", "newmtl left # first\nKd 1 0 0\n");
    listed.write("c.mtl", "newmtl right\nKd 0 0 1\n");
    assert_eq!(halves(&listed), ([RED, BLUE], String::new()));
}

#[test]
fn what_the_scene_binds_comes_before_the_library_of_the_mesh() {
    let named = format!("mtllib halves.mtl\n{HALVES}");
    let all = folder(r#", "material": "grey""#, &named);
    all.write("halves.mtl", library("red.png", "red.png"));
    let (found, said) = halves(&all);
    assert_eq!(found, [GREY; 2]);
    assert!(said.contains("the library halves.mtl is not used"), "{said}");
    let one =
        folder(r#", "materials": { "left": "grey" }, "textures": { "right": "blue" }"#, &named);
    one.write("halves.mtl", library("lost.png", "lost.png"));
    // No picture of the library is needed, so none is missed.
    let (found, said) = halves(&one);
    assert_eq!((found, said.as_str()), ([GREY, BLUE], ""));
}

#[test]
fn what_is_missing_is_named_and_costs_only_itself() {
    let bench = folder("", &format!("mtllib halves.mtl\n{HALVES}"));
    bench.write("halves.mtl", "newmtl left\nKd 1 0 0\nmap_Kd lost.png\nrefl red.png\nKd 1 0\n");
    let (found, said) = halves(&bench);
    assert_eq!(found, [RED, WHITE]);
    for part in [
        "halves.mtl: line 5 is ignored: found `Kd 1 0`, expected `Kd` and three numbers",
        "not used: refl",
        "no picture: scene.json:",
        "cannot read lost.png",
        "remark: halves: no library has material right, which is plain white",
    ] {
        assert!(said.contains(part), "`{part}` in: {said}");
    }
    let quiet = bench.run(&["scene.json", "-q", "-o", "out.png", "--size", "24x16"], b"");
    assert_eq!(ending(&quiet), (Some(0), String::new()));
    let check = bench.run(&["scene.json", "--check"], b"");
    let printed = String::from_utf8(check.stdout).unwrap();
    assert!(printed.contains("remark: halves.mtl: line 5 is ignored"), "{printed}");
}

/// A picture that is red up to its middle and blue beyond shows the coordinate at which it is read.
#[test]
fn a_map_is_scaled_moved_and_clamped() {
    let bench = folder("", &format!("mtllib halves.mtl\n{HALVES}"));
    let stripes = RgbImage::from_fn(2, 1, |x, _| image::Rgb(if x == 0 { RED } else { BLUE }));
    bench.write("stripes.png", encoded(stripes, ImageFormat::Png));
    for (options, scale, offset, clamps) in [
        ("", 1.0, 0.0, false),
        ("-s 3 2 1 -o 0.25 0 0", 3.0, 0.25, false),
        ("-o -0.6 0", 1.0, -0.6, false),
        ("-clamp on -o 0.6 0", 1.0, 0.6, true),
    ] {
        bench.write("halves.mtl", library(&format!("{options} stripes.png"), "red.png"));
        let flags = ["--size", "48x32", "--sampling", "thesis", "--filter", "point"];
        bench.make(&[&["scene.json", "-o", "out.png"][..], &flags].concat(), b"");
        let picture = image::load_from_memory(&bench.read("out.png")).unwrap().into_rgb8();
        for column in 4..23 {
            // The view is 4.5 wide, and the picture covers x from -2 to 0.
            let x = (f64::from(column) + 0.5) / 48.0 * 4.5 - 2.25;
            let at = scale * (x + 2.0) / 2.0 + offset;
            let at = if clamps { f64::clamp(at, 0.0, 0.999) } else { at.rem_euclid(1.0) };
            let truth = if at < 0.5 { RED } else { BLUE };
            assert_eq!(picture.get_pixel(column, 16).0, truth, "{options}: column {column}");
        }
    }
}

#[test]
fn pictures_of_all_formats_show_the_same() {
    let texel = |x, y| image::Rgb([40 * x as u8, 90 * y as u8, 200]);
    let picture = RgbImage::from_fn(5, 3, texel);
    let keys = r#", "material": "grey", "texture": "blue""#;
    let bench = folder(keys, HALVES);
    let mut first = None;
    for format in [
        ImageFormat::Png,
        ImageFormat::Tga,
        ImageFormat::Bmp,
        ImageFormat::Tiff,
        ImageFormat::WebP,
        ImageFormat::Gif,
    ] {
        let name = format!("other.{}", format.extensions_str()[0]);
        let kind = if format == ImageFormat::Gif {
            DynamicImage::from(RgbaImage::from(DynamicImage::from(picture.clone())))
        } else {
            picture.clone().into()
        };
        bench.write(&name, encoded(kind, format));
        bench.write("scene.json", scene(keys).replace("blue.png", &name));
        bench.make(&["scene.json", "-o", "out.png", "--size", "24x16"], b"");
        let shown = bench.read("out.png");
        let first = first.get_or_insert_with(|| shown.clone());
        assert!(*first == shown, "{name}");
    }
}

#[test]
fn a_jpeg_that_is_cut_off_is_refused() {
    let picture = RgbImage::from_fn(64, 64, |x, y| image::Rgb([(3 * x) as u8, (3 * y) as u8, 9]));
    let whole = encoded(picture, ImageFormat::Jpeg);
    let bench = folder(r#", "material": "grey", "texture": "blue""#, HALVES);
    bench.write(
        "scene.json",
        scene(r#", "material": "grey", "texture": "blue""#).replace("blue.png", "a.jpg"),
    );
    bench.write("a.jpg", &whole);
    bench.make(&["scene.json", "-o", "out.png", "--size", "4x4"], b"");
    for length in [whole.len() / 2, whole.len() - 2] {
        bench.write("a.jpg", &whole[..length]);
        let run = bench.run(&["scene.json", "-o", "out.png", "--size", "4x4"], b"");
        let (code, said) = ending(&run);
        assert_eq!(code, Some(3), "{said}");
        assert!(said.contains("a.jpg (the file ends before its picture does)"), "{said}");
    }
}
