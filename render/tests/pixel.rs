//! The print of a pixel states the values of the picture, and their causes.

use crate::bench;
use crate::studio;

use bench::{Bench, TEXTURED_WALL, checks, ending};
use render::color::Encoding;
use render::film::{Pattern, PixelFilter, Supersample};
use render::filter::Filter;
use render::{Prepared, Sampling, Scene, Settings, inspect};
use studio::{at, png, scene};

/// A checkered floor, a ball of reflecting glass, and a mirror.
fn room() -> Scene {
    let texels: Vec<[u8; 3]> = (0..16).map(|k| [k * 16, 255 - k * 9, (k % 4) * 80]).collect();
    let keys = r#""camera": { "eye": [0.2, 1.5, 4], "target": [0, 0.6, 0], "fov_deg": 45 },
        "ambient": 0.5, "background": [0.3, 0.4, 0.6],
        "lights": [ { "point": { "position": [3, 4, 5], "color": 0.5 } } ],
        "textures": { "tiles": { "image": "tiles.png" } },
        "materials": { "floor": { "diffuse": 0.5, "specular": 0.2 }, "mirror": { "reflectivity": 0.8,
            "color": [0.1, 0.2, 0.1] },
          "glass": { "transparency": 1, "reflectivity": 1, "fresnel": true, "ambient": 0,
            "diffuse": 0 } },
        "objects": [ { "plane": { "point": [0, 0, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, -1],
            "material": "floor", "texture": "tiles" } },
          { "sphere": { "center": [-0.4, 0.7, 0.2], "radius": 0.6, "material": "glass" } },
          { "rectangle": { "corner": [0.5, 0, -1], "edge_u": [1.5, 0, 0.5], "edge_v": [0, 1.5, 0],
            "material": "mirror" } } ]"#;
    scene(keys, &[("tiles.png", png(4, &texels))])
}

/// Returns the numbers after a word in a line.
fn numbers(line: &str, word: &str) -> Vec<f32> {
    let (_, rest) = line.split_once(word).unwrap_or_else(|| panic!("{word} in {line}"));
    let numbers = rest.split([' ', ',']).filter(|part| !part.is_empty());
    numbers.map_while(|part| part.parse().ok()).collect()
}

#[test]
fn a_printed_pixel_is_the_pictures_to_the_last_bit() {
    let scene = room();
    let jitter = Sampling::Grid {
        samples: 2,
        pattern: Pattern::Jitter { seed: 3 },
        pixel_filter: PixelFilter::Tent,
    };
    for (filter, sampling, samples) in [
        (Filter::Tent, Sampling::regular(1), 1),
        (Filter::Point, Sampling::regular(3), 9),
        (Filter::Box, jitter, 16),
        (Filter::Tent, Sampling::Supersample(Supersample::Image), 9),
        (Filter::Tent, Sampling::Supersample(Supersample::Rays), 9),
    ] {
        let settings = Settings { sampling, ..Settings::new(24, 20, filter) };
        let (picture, _) = render::render(&Prepared::new(&scene), &settings, &|_, _| {});
        for k in 0..120u32 {
            let (x, y) = (k * 7 % 24, k / 6);
            for all in [false, true] {
                let text =
                    inspect::pixel(&Prepared::new(&scene), &settings, (x, y), Encoding::Srgb, all);
                let first = text.lines().next().unwrap_or_default();
                assert!(first.starts_with(&format!("pixel {x},{y} of 24x20: linear ")), "{first}");
                let shown = at(&picture, x, y);
                assert_eq!(numbers(first, "linear "), shown, "{settings:?}");
                let codes = shown.map(|light| f32::from(Encoding::Srgb.to_byte(f64::from(light))));
                assert_eq!(numbers(first, "as codes "), codes, "{settings:?}");
                let rays = text.lines().filter(|line| line.starts_with("sample ")).count();
                assert_eq!(rays, if all { samples } else { 1 }, "{settings:?}");
            }
        }
    }
}

/// A printed node: the values that the tests need, and its branches.
#[derive(Default)]
struct Printed {
    local: Vec<f32>,
    weights: [f32; 2],
    handed: Vec<f32>,
    branches: [Option<Box<Printed>>; 2],
}

/// Parses and consumes the node that begins at the first of the lines.
fn parse(lines: &mut std::iter::Peekable<std::str::Lines<'_>>) -> Printed {
    let indent = |line: &str| line.len() - line.trim_start().len();
    let mut node = Printed::default();
    let own = lines.next().map(indent).unwrap_or_default();
    while let Some(&line) = lines.peek() {
        if indent(line) <= own {
            break;
        }
        let way = ["reflected:", "refracted:"].iter().position(|way| {
            line.trim_start().split_once(' ').is_some_and(|(_, rest)| rest.starts_with(way))
        });
        if let (Some(way), true) = (way, line.trim_start().starts_with(char::is_numeric)) {
            node.branches[way] = Some(Box::new(parse(lines)));
            continue;
        }
        lines.next();
        if line.contains("local colour") {
            node.local = numbers(line, "local colour ");
        } else if line.contains("weights:") {
            node.weights = [numbers(line, "reflected ")[0], numbers(line, "refracted ")[0]];
        } else if line.contains("colour") {
            node.handed =
                numbers(line, if line.contains("returned") { "returned " } else { "colour " });
        }
    }
    node
}

/// Checks that a node returns its own colour plus its weighted branches, and counts the nodes.
fn adds_up(node: &Printed) -> usize {
    let mut count = 1;
    if !node.local.is_empty() {
        for k in 0..3 {
            let of = |n: usize| node.branches[n].as_ref().map_or(0.0, |branch| branch.handed[k]);
            let sum = node.local[k] + node.weights[0] * of(0) + node.weights[1] * of(1);
            // Each of five numbers was rounded to f32.
            assert!((sum - node.handed[k]).abs() <= 1e-6, "{sum} {:?}", node.handed);
        }
    }
    for branch in node.branches.iter().flatten() {
        count += adds_up(branch);
    }
    count
}

#[test]
fn the_printed_tree_adds_up_to_the_pixel() {
    let scene = room();
    let settings = Settings::new(24, 20, Filter::Tent);
    let mut nodes = 0;
    for (x, y) in (0..24).flat_map(|x| [(x, 5), (x, 11), (x, 15)]) {
        let text = inspect::pixel(&Prepared::new(&scene), &settings, (x, y), Encoding::Srgb, false);
        let (head, tree) = text.split_once("weight 1\n").unwrap_or_default();
        let mut lines = tree.lines().peekable();
        let root = parse(&mut lines);
        assert!(lines.next().is_none(), "{text}");
        assert_eq!(root.handed, numbers(head, "linear "), "{text}");
        nodes += adds_up(&root);
    }
    assert!(nodes > 150, "found {nodes} nodes, expected trees with branches");
}

#[test]
fn names_footprints_and_reasons_are_told() {
    let scene = room();
    let print = |filter, x, y| {
        inspect::pixel(
            &Prepared::new(&scene),
            &Settings::new(24, 20, filter),
            (x, y),
            Encoding::Srgb,
            false,
        )
    };
    let floor = print(Filter::Tent, 3, 18);
    for part in [
        "0 from the eye: object 0, plane\n",
        "part 0, material \"floor\", texture \"tiles\"\n",
        "sees a rectangle of ",
        "texture average ",
    ] {
        assert!(floor.contains(part), "`{part}` in:\n{floor}");
    }
    // The texture has four texels per unit of texture coordinates, along both axes.
    let line = floor.lines().find(|line| line.contains("sees a rectangle")).unwrap_or_default();
    let words: Vec<f32> = line.split([' ', ',']).filter_map(|word| word.parse().ok()).collect();
    assert_eq!(words[2..4], [4.0 * words[0], 4.0 * words[1]], "{line}");
    assert!(print(Filter::Point, 3, 18).contains("sees a point, as the filter requires\n"));
    let places = (0..20).flat_map(|y| (0..24).map(move |x| (x, y)));
    let texts: Vec<String> = places.map(|(x, y)| print(Filter::Tent, x, y)).collect();
    let told = |part: &str| texts.iter().any(|text| text.contains(part));
    assert!(told(" neighbour hit object 1, sphere, part 0\n"));
    assert!(told("1 reflected: object 0, plane\n") && told("1 refracted: object 1, sphere\n"));
    assert!(print(Filter::Tent, 0, 0).contains("0 from the eye: the background\n"));
}

#[test]
fn the_program_prints_without_a_file_and_beside_one() {
    let bench = Bench::with_scene(TEXTURED_WALL);
    bench.write("checks.png", checks());
    let before = bench.names();
    let run = bench.make(&["scene.json", "--size", "8x8", "--pixel", "5,2"], b"");
    assert_eq!(bench.names(), before, "no file is made");
    let alone = String::from_utf8(run.stdout).unwrap_or_default();
    assert!(alone.starts_with("pixel 5,2 of 8x8: linear "), "{alone}");
    let arguments = ["scene.json", "--size", "8x8", "--pixel", "5,2", "-o", "wall.exr"];
    let run = bench.make(&arguments, b"");
    assert_eq!(String::from_utf8(run.stdout).unwrap_or_default(), alone);
    let picture = image::load_from_memory(&bench.read("wall.exr")).map(|file| file.to_rgb32f());
    let pixel = picture.map(|picture| picture.get_pixel(5, 2).0.to_vec()).unwrap_or_default();
    assert_eq!(numbers(&alone, "linear "), pixel);
    for (arguments, part) in [
        (["--pixel", "8,0"], "--pixel 8,0 is not in the picture of 8x8 pixels"),
        (["--pixel", "0,8"], "--pixel 0,8 is not in the picture of 8x8 pixels"),
    ] {
        let run = bench.run(&[&["scene.json", "--size", "8x8"], &arguments[..]].concat(), b"");
        let (code, said) = ending(&run);
        assert_eq!(code, Some(2), "{said}");
        assert!(said.starts_with(&format!("render: {part}")), "{said}");
    }
    let arguments = ["scene.json", "--pixel", "0,0", "-o", "-", "--format", "png"];
    let (code, said) = ending(&bench.run(&arguments, b""));
    assert_eq!(code, Some(2));
    assert!(said.contains("--pixel prints on standard output"), "{said}");
}
