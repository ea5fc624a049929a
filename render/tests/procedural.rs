//! Solid textures and bumps in whole scenes with known results.

use crate::studio;

use fixtures::rounding::STEP;
use image::{GrayImage, ImageFormat, Luma};
use render::filter::Filter;
use render::stats::Stats;
use render::{Picture, Prepared, Scene, Settings};
use std::io::Cursor;
use studio::{FILTERS, assert_near, at, on_film, picture, pixels, scene};

/// A wall in the plane z = 0 that fills the view, seen in ambient light only.
const LIT: &str = r#""ambient": 1, "materials": { "m": { "diffuse": 0 } },"#;

fn wall(textures: &str, texture: &str) -> Scene {
    let rectangle = format!(
        r#""objects": [{{ "rectangle": {{ "corner": [-2, -2, 0], "edge_u": [4, 0, 0],
        "edge_v": [0, 4, 0], "material": "m", "texture": "{texture}" }} }}]"#
    );
    scene(&format!(r#"{LIT} "textures": {{ {textures} }}, {rectangle}"#), &[])
}

fn stats(scene: &Scene, filter: Filter) -> Stats {
    let settings = Settings::new(8, 6, filter);
    render::render(&Prepared::new(scene), &settings, &|_, _| {}).1
}

#[test]
fn a_wall_carved_out_of_a_checker_shows_its_cubes_with_every_filter() {
    let checker = r#""c": { "checker": { "colors": [[1, 0, 0], [0, 0, 1]] },
        "place": { "scale": 0.25, "translate": [0.1, 0, 0] } }"#;
    let scene = wall(checker, "c");
    for filter in FILTERS {
        for (x, y, pixel) in pixels(&picture(&scene, 50, filter)) {
            let [a, b] = on_film(x, y, 50);
            let cube = ((a - 0.1) / 0.25).floor() + (b / 0.25).floor();
            let expected =
                if cube.rem_euclid(2.0) == 0.0 { [1.0, 0.0, 0.0] } else { [0.0, 0.0, 1.0] };
            assert_eq!(pixel, expected, "{x} {y} {filter:?}");
        }
    }
}

#[test]
fn a_lattice_is_filled_only_for_what_is_made_of_noise() {
    let still = r#""a": { "checker": {} }, "b": { "stripes": {} }, "c": { "brick": {} }"#;
    let found = stats(&wall(still, "b"), Filter::Tent);
    assert_eq!((found.lattice_bytes, found.solid_points), (0, 48));
    assert_eq!((found.texture_points, found.texture_areas, found.tables), (0, 0, 0));
    // Solids need no neighbours, so no ray is sent beside the picture.
    assert_eq!(found.primary_rays, 48);
    for kind in ["marble", "granite", "wood", "wall", "turbulence", "clouds"] {
        let scene = wall(&format!(r#""t": {{ "{kind}": {{}} }}"#), "t");
        let found = stats(&scene, Filter::Tent);
        assert_eq!((found.lattice_bytes, found.solid_points), (4 << 18, 48), "{kind}");
    }
}

#[test]
fn solids_and_pictures_keep_their_names_side_by_side() {
    // By name, a picture lies between two solids, and so do their indices.
    let grey = studio::png(1, &[[255, 255, 255]]);
    let textures = r#""a": { "checker": { "colors": [0.25, 0.25] } }, "b": { "image": "b.png" },
        "c": { "stripes": { "layers": [[1, 0.5]] } }"#;
    let object = |k: i32, texture: &str| {
        format!(
            r#"{{ "rectangle": {{ "corner": [{k}, -2, 0], "edge_u": [1, 0, 0], "edge_v": [0, 4, 0],
            "material": "m", "texture": "{texture}" }} }}"#
        )
    };
    let objects = [object(-2, "c"), object(-1, "a"), object(0, "b"), object(1, "c")].join(", ");
    let keys = format!(
        r#"{LIT} "textures": {{ {textures} }}, "objects": [{objects}],
        "camera": {{ "eye": [0, 0, 2], "target": [0, 0, 0], "fov_deg": 90 }}"#
    );
    let picture = picture(&scene(&keys, &[("b.png", grey)]), 4, Filter::Tent);
    let row = [0, 1, 2, 3].map(|x| at(&picture, x, 1)[0]);
    assert_eq!(row, [0.5, 0.25, 1.0, 0.5]);
}

/// Returns heights that rise by 256/255 over the width of the picture.
fn ramp() -> Vec<u8> {
    let picture = GrayImage::from_fn(256, 1, |x, _| Luma([x as u8]));
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png).expect("memory takes it");
    bytes.into_inner()
}

/// Slope in the middle of a wall of width 4 whose bump rises to the right.
const RISE: f64 = 0.5 * 256.0 / 255.0;

/// Renders the middle of a bumped wall, with these keys of its material and of the scene, and a
/// ball at this position. Returns its colour.
fn bumped(material: &str, keys: &str, ball: [f64; 3]) -> [f32; 3] {
    let keys = format!(
        r#"{keys} "materials": {{ "green": {{ "color": [0, 1, 0], "diffuse": 0 }},
        "m": {{ {material}, "bump": {{ "image": {{ "file": "ramp.png" }}, "strength": 2 }} }} }},
        "objects": [
          {{ "sphere": {{ "center": {ball:?}, "radius": 0.05, "material": "green" }} }},
          {{ "rectangle": {{ "corner": [-2, -2, 0], "edge_u": [4, 0, 0], "edge_v": [0, 4, 0],
                          "material": "m" }} }}]"#
    );
    at(&picture(&scene(&keys, &[("ramp.png", ramp())]), 1, Filter::Tent), 0, 0)
}

/// Returns x and z of the unit normal of a surface that rises to the right; the normal leans to the
/// left.
fn normal() -> [f64; 2] {
    let length = (1.0 + RISE * RISE).sqrt();
    [-RISE / length, 1.0 / length]
}

#[test]
fn light_falls_on_a_bumped_wall_as_on_the_slope_it_stands_for() {
    let far = [0.0, 0.0, -9.0];
    for light in [[0.0, 1e6], [-6e5, 8e5], [6e5, 8e5]] {
        let keys = format!(
            r#""ambient": 0, "lights": [{{ "point": {{ "position": [{:?}, 0, {:?}] }} }}],"#,
            light[0], light[1]
        );
        let found = f64::from(bumped(r#""diffuse": 1"#, &keys, far)[0]);
        let expected = (normal()[0] * light[0] + normal()[1] * light[1]) / 1e6;
        // The middle of the ramp is straight, up to the influence of its ends through the splines.
        assert!((found - expected.max(0.0)).abs() < 1e-5, "{found} and {expected}");
    }
}

#[test]
fn a_bump_turns_mirrored_rays() {
    let [x, z] = normal();
    // (0, 0, -1) mirrored about (x, 0, z).
    let toward = [2.0 * x * z, 0.0, 2.0 * z * z - 1.0].map(|d| 3.0 * d);
    let mirror = r#""ambient": 0, "diffuse": 0, "reflectivity": 1"#;
    assert_eq!(bumped(mirror, r#""ambient": 1,"#, toward), [0.0, 1.0, 0.0]);
    assert_eq!(bumped(mirror, r#""ambient": 1,"#, [0.0, 0.0, 3.0]), [0.0; 3]);
}

#[test]
fn a_bump_turns_refracted_rays() {
    let [x, z] = normal();
    // By Snell the ray lies between its own direction and the reversed normal, which leans to the
    // right.
    let inside = ((-x) / 1.5).asin();
    let lean = (-x).atan2(z);
    let angle = lean - inside;
    let toward = [angle.sin(), 0.0, -angle.cos()].map(|d| 3.0 * d);
    let glass = r#""ambient": 0, "diffuse": 0, "transparency": 1"#;
    let (found, other) = (
        bumped(glass, r#""ambient": 1,"#, toward),
        bumped(glass, r#""ambient": 1,"#, [-toward[0], 0.0, toward[2]]),
    );
    assert_eq!([found, other], [[0.0, 1.0, 0.0], [0.0; 3]]);
}

#[test]
fn a_bump_of_no_strength_changes_nothing() {
    let keys = |bump: &str| {
        format!(
            r#""lights": [{{ "point": {{ "position": [3, 4, 5] }} }}],
            "materials": {{ "m": {{ "specular": 0.5, "reflectivity": 0.3 {bump} }} }},
            "objects": [{{ "sphere": {{ "center": [0, 0, -1], "radius": 1, "material": "m" }} }}]"#
        )
    };
    let draw = |bump: &str| -> Picture { picture(&scene(&keys(bump), &[]), 24, Filter::Tent) };
    let plain = draw("");
    for relief in ["noise", "turbulence", "wall", "dnoise"] {
        let bump = format!(r#", "bump": {{ "{relief}": {{}}, "strength": 0 }}"#);
        assert_near(&plain, &draw(&bump), STEP);
        let bump = format!(r#", "bump": {{ "{relief}": {{}}, "strength": 0.3 }}"#);
        assert!(plain.pixels != draw(&bump).pixels, "{relief}");
    }
}

/// However strong a bump is, all pixels are finite and no light is created.
#[test]
fn a_bump_of_absurd_strength_leaves_finite_pixels() {
    for strength in [1e6, -1e6] {
        let keys = format!(
            r#""ambient": 0, "background": 1, "materials": {{ "m": {{ "diffuse": 0, "fresnel": true,
            "reflectivity": 1, "transparency": 1,
            "bump": {{ "noise": {{ "octaves": 3 }}, "strength": {strength:?} }} }} }},
            "objects": [{{ "sphere": {{ "center": [0, 0, -1], "radius": 1, "material": "m" }} }}]"#
        );
        for (x, y, pixel) in pixels(&picture(&scene(&keys, &[]), 24, Filter::Tent)) {
            assert!(
                pixel.iter().all(|c| (0.0..=1.0 + f32::EPSILON).contains(c)),
                "{x} {y} {pixel:?}"
            );
        }
    }
}

#[test]
fn what_the_page_shows_is_read() {
    let page = include_str!("../../docs/procedural.md");
    let blocks: Vec<&str> = page
        .split("```json\n{")
        .skip(1)
        .map(|rest| rest.split("\n}\n```").next().unwrap())
        .collect();
    assert_eq!(blocks.len(), 2);
    let map = image::RgbImage::from_pixel(2, 2, image::Rgb([128, 128, 255]));
    let mut normals = Cursor::new(Vec::new());
    map.write_to(&mut normals, ImageFormat::Png).unwrap();
    let files = [("normals.png", normals.into_inner())];
    for (block, count) in blocks.into_iter().zip([3, 4]) {
        let drawn = scene(&format!("{block}, \"objects\": []"), &files);
        assert_eq!(drawn.procedural.solids.len() + drawn.procedural.bumps.len(), count);
    }
}
