//! Textures in pictures: their orientation, constant textures, and the thesis's statements about
//! its filters.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::studio;

use fixtures::rounding::{HALF_STEP, STEP};
use image::{DynamicImage, ImageBuffer, ImageFormat, Luma};
use render::color::Encoding;
use render::filter::Filter;
use render::{Picture, Scene};
use std::io::Cursor;
use studio::{FILTERS, assert_near, at, picture, pixels, png, scene, supersampled};

/// Four colours, the upper two first.
const FOUR: [[u8; 3]; 4] = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 0]];

/// A square from -1 to 1 with its texture upright, in the plane z = 0.
const RECTANGLE: &str = r#"{ "rectangle": { "corner": [-1, -1, 0], "edge_u": [2, 0, 0],
    "edge_v": [0, 2, 0], "material": "paper", "texture": "image" } }"#;

/// The same square as a mesh.
const SQUARE_OBJ: &[u8] = b"v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n\
    vt 0 1\nf 1/1 2/2 3/3 4/4\n";

/// A sphere that nearly fills the view.
const SPHERE: &str = r#"{ "sphere": { "center": [0, 0, -1], "radius": 1, "material": "paper",
    "texture": "image" } }"#;

/// Returns an object with the mesh of the file `file`.
fn mesh(file: &str) -> String {
    format!(
        r#"{{ "mesh": {{ "name": "m", "file": "{file}", "material": "paper", "texture": "image" }} }}"#
    )
}

/// Returns a scene of unlit paper objects with a picture on them.
fn paper(wrap: &str, width: usize, texels: &[[u8; 3]], objects: &str, obj: &[u8]) -> Scene {
    let keys = format!(
        r#""ambient": 1,
        "textures": {{ "image": {{ "image": "i.png", "wrap": "{wrap}", "values": "linear" }} }},
        "materials": {{ "paper": {{ "diffuse": 0 }}, "mirror": {{ "ambient": 0, "diffuse": 0,
        "reflectivity": 1 }}, "glass": {{ "ambient": 0, "diffuse": 0, "reflectivity": 1,
        "transparency": 1, "fresnel": true }} }}, "objects": [ {objects} ]"#
    );
    scene(&keys, &[("i.png", png(width, texels)), ("m.obj", obj.to_vec())])
}

/// Returns the pixels in the middles of the four quarters of the part of the picture between `low`
/// and `high`, as letters. A filter may mix in some of the neighbouring colours.
fn quarters(picture: &Picture, low: u32, high: u32) -> String {
    let (a, b) = ((3 * low + high) / 4, (low + 3 * high) / 4);
    let letter = |(x, y)| match at(picture, x, y).map(f32::round) {
        [1.0, 0.0, 0.0] => 'R',
        [0.0, 1.0, 0.0] => 'G',
        [0.0, 0.0, 1.0] => 'B',
        [1.0, 1.0, 0.0] => 'Y',
        other => panic!("found {other:?}"),
    };
    [(a, a), (b, a), (a, b), (b, b)].map(letter).into_iter().collect()
}

#[test]
fn a_picture_is_upright_and_not_mirrored_from_outside() {
    let mesh = mesh("m.obj");
    // Each colour covers 8 by 8 texels, so that filters blend colours in the middle only.
    let texels: Vec<[u8; 3]> = (0..256).map(|k| FOUR[k / 128 * 2 + k % 16 / 8]).collect();
    for (objects, low, high) in [(RECTANGLE, 0, 64), (&mesh, 0, 64), (SPHERE, 16, 48)] {
        for filter in FILTERS {
            let shown = picture(&paper("clamp", 16, &texels, objects, SQUARE_OBJ), 64, filter);
            assert_eq!(quarters(&shown, low, high), "RGBY", "{filter:?} {objects}");
        }
    }
}

#[test]
fn seen_from_behind_a_rectangle_shows_its_picture_mirrored() {
    let objects = RECTANGLE.replace("[-1, -1, 0]", "[1, -1, 0]").replace("[2, 0, 0]", "[-2, 0, 0]");
    let shown = picture(&paper("clamp", 2, &FOUR, &objects, b""), 64, Filter::Point);
    assert_eq!(quarters(&shown, 0, 64), "GRYB");
}

#[test]
fn repeat_lays_a_picture_several_times_and_every_copy_is_upright() {
    let objects = RECTANGLE.replace("\"material\"", "\"repeat\": [2, 4], \"material\"");
    let shown = picture(&paper("repeat", 2, &FOUR, &objects, b""), 64, Filter::Point);
    // Two copies across and four down: the first is 32 columns by 16 rows.
    assert_eq!(at(&shown, 8, 4), [1.0, 0.0, 0.0]);
    assert_eq!(at(&shown, 24, 4), [0.0, 1.0, 0.0]);
    assert_eq!(at(&shown, 8, 12), [0.0, 0.0, 1.0]);
    for (x, y, pixel) in pixels(&shown) {
        assert_eq!(pixel, at(&shown, x % 32, y % 16), "at {x} {y}");
    }
}

#[test]
fn a_mirrored_picture_is_the_repetition_of_itself_beside_its_image() {
    let mut code = (0..).map(|k: u32| (k.wrapping_mul(2_654_435_761) >> 24) as u8);
    let texels: Vec<[u8; 3]> = (0..64).map(|_| [(); 3].map(|()| code.next().unwrap())).collect();
    let folded = |k: usize| k.min(15 - k);
    // Coordinates begin at the bottom, so the upright picture is there, and its mirror image above.
    let twice: Vec<[u8; 3]> =
        (0..256).map(|k| texels[folded((k / 16 + 8) % 16) * 8 + folded(k % 16)]).collect();
    let objects =
        |repeat| RECTANGLE.replace("\"material\"", &format!("\"repeat\": {repeat}, \"material\""));
    for filter in FILTERS {
        // The texture is magnified, and then has several texels per pixel.
        for (mirrored, repeated) in [("[4, 2]", "[2, 1]"), ("[40, 60]", "[20, 30]")] {
            let one = picture(&paper("mirror", 8, &texels, &objects(mirrored), b""), 64, filter);
            let other = picture(&paper("repeat", 16, &twice, &objects(repeated), b""), 64, filter);
            // A few roundings to f32, and the roundings of a pyramid's codes.
            assert_near(&one, &other, if filter == Filter::Mip { 1e-4 } else { STEP });
        }
    }
}

#[test]
fn texels_have_their_exact_place_on_a_rectangle() {
    // 64 pixels over 16 texels, each of a different colour.
    let texels: Vec<[u8; 3]> = (0..=255).map(|k| [k, 255 - k, k / 2]).collect();
    let shown = picture(&paper("clamp", 16, &texels, RECTANGLE, b""), 64, Filter::Point);
    for (x, y, pixel) in pixels(&shown) {
        let texel = texels[(y / 4 * 16 + x / 4) as usize];
        assert_eq!(pixel, texel.map(|code| (f64::from(code) / 255.0) as f32), "at {x} {y}");
    }
}

#[test]
fn a_constant_texture_stays_constant_under_every_filter_even_by_mirrors_and_glass() {
    let (code, mirror, glass) = ([180, 90, 7], "mirror", "glass");
    let objects = format!(
        r#"{{ "plane": {{ "point": [0, -1, 0], "edge_u": [0.37, 0, 0.1], "edge_v": [0, 0, -0.41],
        "material": "paper", "texture": "image" }} }},
        {{ "sphere": {{ "center": [-0.4, 0, 0], "radius": 0.3, "material": "{mirror}" }} }},
        {{ "sphere": {{ "center": [0.4, 0, 0], "radius": 0.3, "material": "{glass}" }} }},
        {{ "sphere": {{ "center": [0, 0.6, 0], "radius": 0.3, "material": "paper",
        "texture": "image" }} }}"#
    );
    let plain = objects.replace(r#""texture": "image""#, r#""texture": null"#);
    // A texture of one colour gives that colour on white paper.
    let color = code.map(|code| f64::from(code) / 255.0);
    let truth = {
        let keys = format!(
            r#""background": 0, "ambient": 1, "materials": {{ "paper": {{ "color": {color:?},
            "diffuse": 0 }}, "mirror": {{ "ambient": 0, "diffuse": 0, "reflectivity": 1 }},
            "glass": {{ "ambient": 0, "diffuse": 0, "reflectivity": 1, "transparency": 1,
            "fresnel": true }} }}, "objects": [ {plain} ]"#
        );
        picture(&scene(&keys, &[]), 80, Filter::Point)
    };
    for filter in FILTERS {
        for wrap in ["repeat", "clamp"] {
            let shown = picture(&paper(wrap, 5, &[code; 35], &objects, b""), 80, filter);
            // Exact integers meet weights that sum to one up to a few roundings of f64.
            assert_near(&shown, &truth, 2e-7);
        }
    }
}

#[test]
fn a_square_of_two_triangles_looks_like_the_rectangle() {
    let texels: Vec<[u8; 3]> = (0..=255).map(|k: u8| [k.wrapping_mul(37), k, 255 - k]).collect();
    let camera =
        r#""camera": { "eye": [0.7, -2.1, 0.9], "target": [0.013, 0.1, 0], "fov_deg": 50 },"#;
    for filter in FILTERS {
        let show = |object: &str| {
            let mut scene = paper("repeat", 16, &texels, object, SQUARE_OBJ);
            scene.camera = studio::scene(&format!("{camera} \"objects\": []"), &[]).camera;
            picture(&scene, 61, filter)
        };
        // Texture coordinates differ by roundings of f64. Only a texel edge at the middle of a
        // pixel could show the difference, and there is none.
        assert_near(&show(&mesh("m.obj")), &show(RECTANGLE), STEP);
    }
}

/// A floor to the horizon with two by two checks in each unit, each check of `fine` by `fine`
/// texels, for a picture of 64 x 64 pixels. It begins with row 32, whose upper neighbours see the
/// sky, so that every filter samples points there.
fn floor(fine: usize) -> Scene {
    let side = 2 * fine;
    let texels: Vec<[u8; 3]> =
        (0..side * side)
            .map(|k| {
                if (k / side / fine + k % side / fine).is_multiple_of(2) {
                    [230; 3]
                } else {
                    [20; 3]
                }
            })
            .collect();
    let object = r#"{ "plane": { "point": [0.03, -1, 0.01], "edge_u": [1, 0, 0.2],
        "edge_v": [0.2, 0, -1], "material": "paper", "texture": "image" } }"#;
    paper("repeat", side, &texels, object, b"")
}

/// Returns mean and variance of the first channel over some rows.
fn moments(picture: &Picture, rows: std::ops::Range<u32>) -> [f64; 2] {
    let lights: Vec<f64> = pixels(picture)
        .filter(|(_, y, _)| rows.contains(y))
        .map(|(_, _, pixel)| f64::from(pixel[0]))
        .collect();
    let mean = lights.iter().sum::<f64>() / lights.len() as f64;
    [mean, lights.iter().map(|light| (light - mean).powi(2)).sum::<f64>() / lights.len() as f64]
}

/// The mean of the floor's texture.
const MEAN: f64 = 125.0 / 255.0;

#[test]
fn far_away_a_filtered_floor_varies_less_than_a_point_sampled_one() {
    let far = 33..37;
    let [_, point] = moments(&picture(&floor(1), 64, Filter::Point), far.clone());
    for filter in [Filter::Mip, Filter::Box, Filter::Tent, Filter::Quadratic] {
        let [_, filtered] = moments(&picture(&floor(1), 64, filter), far.clone());
        // Row 36 is averaged over at least 3.3 units of the floor. The checks leave at most half a
        // unit of it unpaired: 0.5 / 3.3 of the contrast, and 2.3 % of the variance.
        assert!(filtered < 0.025 * point, "{filter:?}: {filtered} against {point}");
    }
    let [_, bilinear] = moments(&picture(&floor(1), 64, Filter::Bilinear), far);
    // Interpolation between unlike texels along both axes keeps a third of the variance, twice,
    // where checks are far smaller than a pixel.
    assert!((bilinear / point - 1.0 / 9.0).abs() < 0.03, "{bilinear} against {point}");
}

#[test]
fn far_away_a_filtered_floor_tends_to_the_mean_of_its_texture() {
    for filter in [Filter::Mip, Filter::Box, Filter::Tent, Filter::Quadratic] {
        let shown = picture(&floor(1), 64, filter);
        for (x, y, pixel) in pixels(&shown).filter(|(_, y, _)| (33..35).contains(y)) {
            // Row 34 is averaged over at least 12 units of the floor, of which at most half a unit
            // is unpaired: 0.5 / 12 of the amplitude, which is 105 / 255.
            assert!(
                (f64::from(pixel[0]) - MEAN).abs() < 0.5 / 12.0 * 105.0 / 255.0,
                "{filter:?} at {x} {y}: {pixel:?}"
            );
        }
    }
}

#[test]
fn at_equal_support_the_tent_keeps_more_contrast_than_the_box() {
    // The thesis observed that box filtering (n = 1) blurs, and chose the triangle (3.3.3). This
    // holds where the checks are still visible: here they are half a unit wide, and footprints are
    // 0.06 to 1 unit wide.
    for rows in [42..47, 47..52, 52..58, 58..64] {
        let [_, order1] = moments(&picture(&floor(16), 64, Filter::Box), rows.clone());
        let [_, order2] = moments(&picture(&floor(16), 64, Filter::Tent), rows.clone());
        assert!(order2 > 1.05 * order1, "rows {rows:?}: {order2} against {order1}");
    }
}

#[test]
fn the_filters_keep_the_mean_brightness_of_the_floor() {
    let whole = 40..64;
    let [truth, _] = moments(&supersampled(&floor(16), 64, 16, Filter::Point), whole.clone());
    let amplitude = 105.0 / 255.0;
    // At either border of 24 rows a quarter of a row comes from beyond. The mean of a row is off by
    // at most the amplitude.
    let border = 2.0 * 0.25 / 24.0 * amplitude;
    // Bilinear interpolation takes one sample per pixel. The mean of independent samples would have
    // this standard deviation; regular samples are spread more evenly.
    let noise = amplitude / f64::sqrt(24.0 * 64.0);
    for (filter, bound) in [
        (Filter::Bilinear, noise),
        (Filter::Mip, border),
        (Filter::Box, border),
        (Filter::Tent, border),
        (Filter::Quadratic, border),
    ] {
        let [mean, _] = moments(&picture(&floor(16), 64, filter), whole.clone());
        assert!((mean - truth).abs() < bound, "{filter:?}: {mean}, expected {truth}");
    }
}

/// Greys of codes 0 and 85 above 170 and 255, as a palette of which one entry is transparent.
const PALETTE_PNG: &[u8] =
    b"\x89PNG\x0d\x0a\x1a\x0a\x00\x00\x00\x0dIHDR\x00\x00\x00\x02\x00\x00\x00\x02\x08\x03\
    \x00\x00\x00Eh\xfd\x16\x00\x00\x00\x0cPLTEUUU\xaa\xaa\xaa\x00\x00\x00\xff\xff\xffn\
    \x87\x7f\xe4\x00\x00\x00\x02tRNS\xff\x00\xe5\xb70J\x00\x00\x00\x0eIDATx\xdac`b``d\
    \x06\x00\x00\x15\x00\x07\xbe\x0ax\xb3\x00\x00\x00\x00IEND\xaeB`\x82";

/// The picture of [`PALETTE_PNG`] with two bits per texel.
const TWO_BIT_PNG: &[u8] =
    b"\x89PNG\x0d\x0a\x1a\x0a\x00\x00\x00\x0dIHDR\x00\x00\x00\x02\x00\x00\x00\x02\x02\x00\
    \x00\x00\x00\x1dmJY\x00\x00\x00\x0cIDATx\xdac\x10`\xd8\x00\x00\x00\xe4\x00\xc1\x19U;\
    \xfb\x00\x00\x00\x00IEND\xaeB`\x82";

#[test]
fn every_kind_of_picture_is_the_same_texture() {
    let codes = [0u8, 85, 170, 255];
    let wide: Vec<u16> = codes.iter().map(|&code| 257 * u16::from(code)).collect();
    let grey = ImageBuffer::<Luma<u8>, _>::from_raw(2, 2, codes.to_vec()).unwrap();
    let deep = ImageBuffer::<Luma<u16>, _>::from_raw(2, 2, wide).unwrap();
    let (grey, deep) = (DynamicImage::from(grey), DynamicImage::from(deep));
    // Transparency is ignored on request.
    let mut clear = grey.to_luma_alpha8();
    clear.pixels_mut().for_each(|pixel| pixel[1] = 0);
    let mut deep_clear = deep.to_rgba16();
    deep_clear.pixels_mut().for_each(|pixel| pixel[3] = 0);
    let kinds = [
        DynamicImage::from(grey.to_rgb8()),
        DynamicImage::from(clear.clone()).to_rgba8().into(),
        clear.into(),
        deep.to_luma_alpha16().into(),
        deep.to_rgb16().into(),
        deep_clear.into(),
        grey.clone(),
        deep,
    ];
    let encoded = |picture: &DynamicImage| {
        let mut bytes = Cursor::new(Vec::new());
        picture.write_to(&mut bytes, ImageFormat::Png).unwrap();
        bytes.into_inner()
    };
    let files = kinds.iter().map(encoded).chain([PALETTE_PNG.to_vec(), TWO_BIT_PNG.to_vec()]);
    let files: Vec<Vec<u8>> = files.collect();
    for values in ["linear", "srgb"] {
        let keys = format!(
            r#""ambient": 1, "materials": {{ "paper": {{ "diffuse": 0 }} }}, "textures":
            {{ "image": {{ "image": "i.png", "values": "{values}", "alpha": "ignore" }} }}, "objects": [ {RECTANGLE} ]"#
        );
        for (kind, file) in files.iter().enumerate() {
            let shown = picture(&scene(&keys, &[("i.png", file.clone())]), 2, Filter::Point);
            for (pixel, code) in shown.pixels.iter().zip(codes) {
                let code = f64::from(code) / 255.0;
                let light = if values == "linear" { code } else { Encoding::Srgb.decode(code) };
                // Light is stored in 16 bits.
                let near =
                    pixel.iter().all(|&x| (f64::from(x) - light).abs() < 0.5 / 65535.0 + HALF_STEP);
                assert!(near, "{values}, kind {kind}: found {pixel:?}, expected {light}");
            }
        }
    }
}
