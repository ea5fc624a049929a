//! Layers and crops as files, read back.

use crate::bench;

use bench::{Bench, TEXTURED_WALL, checks, ending};
use std::collections::BTreeMap;

/// A ball in front of the middle of a textured wall; the wall leaves an empty strip at the left.
const BALL: &str = r#"{ "format": "tb-scene", "version": 1,
"camera": { "eye": [0, 0, 1], "target": [0, 0, 0], "fov_deg": 90 },
"ambient": 0.5,
"textures": { "checks": { "image": "checks.png" } },
"materials": { "wall": { "diffuse": 0 } },
"objects": [ { "rectangle": { "corner": [-0.5, -2, 0], "edge_u": [2.5, 0, 0], "edge_v": [0, 4, 0],
    "material": "wall", "texture": "checks" } },
  { "sphere": { "center": [0, 0, 0.5], "radius": 0.125, "material": "wall" } } ] }"#;

const SIDE: usize = 16;

/// Values of the layers here are `f32` below 2, as are the expected values, after up to seven
/// operations. Each of these eight numbers is off by half of [`f32::EPSILON`] at most.
const ROUNDINGS: f32 = 4.0 * f32::EPSILON;

/// Returns the channels of an EXR by name.
fn channels(bytes: &[u8]) -> BTreeMap<String, Vec<f32>> {
    fixtures::exr::channels(bytes).into_iter().collect()
}

fn bench() -> Bench {
    let bench = Bench::with_scene(BALL);
    bench.write("checks.png", checks());
    bench
}

fn made(bench: &Bench, arguments: &[&str]) -> BTreeMap<String, Vec<f32>> {
    let arguments = [&["scene.json", "--size", "16x16", "-o", "out.exr"], arguments].concat();
    bench.make(&arguments, b"");
    channels(&bench.read("out.exr"))
}

#[test]
fn layers_hold_what_is_hit_first() {
    // The thesis's footprint lies between the middles of the pixel's neighbours, or is a point.
    layers_hold(&["--sampling", "thesis"], 0.25);
    // The other footprint is the pixel.
    layers_hold(&["--sampling", "area"], 0.125);
}

/// Checks all layers of a picture; `width` is that of a footprint on the wall.
fn layers_hold(method: &[&str], width: f32) {
    let bench = bench();
    let layers = ["--layers", "footprint,object,uv,depth,normal"];
    let channels = made(&bench, &[method, &layers].concat());
    let names: Vec<&str> = channels.keys().map(String::as_str).collect();
    let known = [
        "B",
        "G",
        "R",
        "depth.Z",
        "footprint.H",
        "footprint.W",
        "normal.X",
        "normal.Y",
        "normal.Z",
        "object.id",
        "uv.U",
        "uv.V",
    ];
    assert_eq!(names, known);
    let mut seen = [0; 3];
    for (row, column) in (0..SIDE).flat_map(|row| (0..SIDE).map(move |column| (row, column))) {
        let of = |name: &str| channels[name][row * SIDE + column];
        // Point where the ray through the pixel's middle meets the wall.
        let [x, y] = [column, row].map(|n| (2.0 * n as f32 + 1.0) / SIDE as f32 - 1.0);
        let y = -y;
        let normal = [of("normal.X"), of("normal.Y"), of("normal.Z")];
        let size = [of("footprint.W"), of("footprint.H")];
        let id = of("object.id");
        seen[(id + 1.0) as usize] += 1;
        if id == 0.0 {
            assert_eq!(normal, [0.0, 0.0, 1.0]);
            assert!((of("depth.Z") - (1.0 + x * x + y * y).sqrt()).abs() < ROUNDINGS);
            assert!((of("uv.U") - (x + 0.5) / 2.5).abs() < ROUNDINGS);
            assert!((of("uv.V") - (y + 2.0) / 4.0).abs() < ROUNDINGS);
            let near = (size[0] - width / 2.5).abs() < ROUNDINGS
                && (size[1] - width / 4.0).abs() < ROUNDINGS;
            let point = method.contains(&"thesis") && size == [0.0; 2];
            assert!(near || point, "{size:?}");
            seen[0] += usize::from(near);
        } else if id == 1.0 {
            let unit = normal.iter().map(|n| n * n).sum::<f32>();
            assert!((unit - 1.0).abs() < ROUNDINGS && normal[2] > 0.0);
            // The ray that meets the wall at (x, y) meets the ball at the point that the ball's
            // normal determines.
            let t = of("depth.Z") / (1.0 + x * x + y * y).sqrt();
            assert!((t * x - 0.125 * normal[0]).abs() < ROUNDINGS);
            assert!((1.0 - t - (0.5 + 0.125 * normal[2])).abs() < ROUNDINGS);
        } else {
            assert_eq!((id, normal, size), (-1.0, [0.0; 3], [0.0; 2]));
            assert_eq!((of("depth.Z"), of("uv.U"), of("R")), (f32::INFINITY, 0.0, 0.0));
            assert!(x < -0.5);
        }
    }
    assert!(seen.iter().all(|&count| count > 3), "{seen:?}");
}

#[test]
fn layers_do_not_change_the_colour_and_are_not_averaged() {
    let bench = bench();
    let sampled = ["--samples", "3", "--pixel-filter", "tent"];
    let plain = made(&bench, &sampled);
    let layered = made(&bench, &[&sampled[..], &["--layers", "object,uv"]].concat());
    for name in ["R", "G", "B"] {
        assert_eq!(plain[name], layered[name]);
    }
    assert!(layered["object.id"].iter().all(|id| [-1.0, 0.0, 1.0].contains(id)));
    // The middle ray of three by three, and that of the nine, is the ray of a pixel with one ray.
    let single = made(&bench, &["--layers", "object,uv"]);
    let nine = ["--sampling", "thesis", "--supersample", "--layers", "object,uv"];
    let nine = made(&bench, &nine);
    for name in ["object.id", "uv.U", "uv.V"] {
        assert_eq!(single[name], layered[name], "{name}");
        assert_eq!(single[name], nine[name], "{name}");
    }
}

#[test]
fn a_crop_is_a_picture_of_its_own_size() {
    let bench = bench();
    let flags = ["--sampling", "thesis", "--supersample=rays", "--layers", "normal,footprint"];
    let whole = made(&bench, &flags);
    let part = made(&bench, &[&flags[..], &["--crop", "3,5,9x4"]].concat());
    for (name, values) in &part {
        let cut: Vec<f32> = (5..9)
            .flat_map(|y| (3..12).map(move |x| y * SIDE + x))
            .map(|place| whole[name][place])
            .collect();
        assert_eq!(*values, cut, "{name}");
    }
    let arguments = ["scene.json", "--size", "16x16", "--crop", "3,5,9x4", "-o", "part.png"];
    bench.make(&arguments, b"");
    let picture = image::load_from_memory(&bench.read("part.png")).unwrap();
    assert_eq!((picture.width(), picture.height()), (9, 4));
}

#[test]
fn what_cannot_be_is_told_before_any_work() {
    let bench = Bench::with_scene("not read");
    let text = |part: &str| part.to_string();
    for (arguments, part) in [
        (vec!["--layers", "uv"], text("out.png is a PNG and cannot hold --layers")),
        (
            vec!["--crop", "0,0,5x1"],
            text("--crop 0,0,5x1 reaches out of the picture of 4x4 pixels"),
        ),
        (vec!["--crop", "4,0,1x1"], text("--crop 4,0,1x1 reaches out of the picture")),
        (
            vec!["--sampling", "thesis", "--seed", "1"],
            text("--seed chooses a jitter: add --pattern jitter"),
        ),
        (
            vec!["--sampling", "thesis", "--pixel-filter", "tent"],
            text("--pixel-filter tent needs rays between"),
        ),
        (vec!["--seed", "1"], text("--seed belongs to --sampling thesis")),
        (vec!["--pattern", "jitter"], text("--pattern belongs to --sampling thesis")),
        (vec!["--supersample"], text("--supersample belongs to --sampling thesis")),
        (
            vec!["--sampling", "thesis", "--split", "0.1"],
            text("--split belongs to --sampling area"),
        ),
    ] {
        bench.refuse(&[&["scene.json"], &arguments[..]].concat(), b"", 2, &[&part]);
    }
    for flag in [
        vec!["--layers", "uv,colour", "-o", "out.exr"],
        vec!["--layers", "", "-o", "out.exr"],
        vec!["--crop", "1,2,3", "-o", "out.png"],
        vec!["--crop", "1,2,0x3", "-o", "out.png"],
        vec!["--pixel", "1"],
        vec!["--pixel", "1,-1"],
        vec!["--seed", "one", "-o", "out.png"],
        vec!["--pattern", "hexagons", "-o", "out.png"],
        vec!["--pixel-filter", "gauss", "-o", "out.png"],
        vec!["--supersample=twice", "-o", "out.png"],
        vec!["--supersample", "--samples", "2", "-o", "out.png"],
        vec!["--supersample", "--pattern", "jitter", "-o", "out.png"],
        vec!["--all-samples", "-o", "out.png"],
        vec!["--split", "0", "-o", "out.png"],
        vec!["--split", "half", "-o", "out.png"],
        vec!["--sampling", "random", "-o", "out.png"],
    ] {
        let (code, said) = ending(&bench.run(&[&["scene.json"], &flag[..]].concat(), b""));
        assert_eq!(code, Some(2), "{flag:?}: {said}");
        let name = flag[0].split('=').next().unwrap();
        assert!(said.starts_with("error: ") && said.contains(name), "{flag:?}: {said}");
    }
}

#[test]
fn stats_count_the_rays_of_every_sampling() {
    let bench = Bench::with_scene(TEXTURED_WALL);
    bench.write("checks.png", checks());
    // Pixels, and the samples that they share or need as neighbours beyond them, along each side of
    // 8.
    for (flags, point, tent) in [
        (vec!["--samples", "1"], 8, 10),
        (vec!["--samples", "3"], 24, 26),
        (vec!["--samples", "2", "--pixel-filter", "tent"], 18, 20),
        (vec!["--samples", "3", "--pixel-filter", "tent"], 26, 28),
        (vec!["--samples", "2", "--pattern", "jitter"], 16, 18),
        (vec!["--supersample"], 17, 19),
        (vec!["--supersample=rays"], 17, 17),
    ] {
        for (filter, side) in [("point", point), ("tent", tent)] {
            let fixed = ["scene.json", "--size", "8x8", "-o", "a.png", "--stats=json"];
            let method = ["--sampling", "thesis", "--filter", filter];
            let arguments = [&fixed[..], &method, &flags[..]].concat();
            let (code, said) = ending(&bench.run(&arguments, b""));
            assert_eq!(code, Some(0), "{said}");
            let stats: serde_json::Value = serde_json::from_str(&said).unwrap();
            assert_eq!(stats["primary_rays"], side * side, "{flags:?}, {filter}");
        }
    }
}
