//! Meshes of few triangles with interpolated normals, meshes far from the origin, and colours of vertices.

use crate::bench::{Bench, ending};
use image::Rgb32FImage;
use std::f64::consts::PI;
use std::fmt::Write as _;

/// A ball of radius 1 around `middle`, in `around` times `down` cells, with normals.
fn ball(around: u32, down: u32, middle: [f64; 3]) -> String {
    let mut text = String::new();
    for i in 0..=down {
        for j in 0..around {
            let polar = PI * f64::from(i) / f64::from(down);
            let along = 2.0 * PI * f64::from(j) / f64::from(around);
            let normal = [polar.sin() * along.sin(), polar.cos(), polar.sin() * along.cos()];
            let [x, y, z] = [0, 1, 2].map(|k| middle[k] + normal[k]);
            let [a, b, c] = normal;
            // Writing to a string does not fail.
            let _ = writeln!(text, "v {x:.6} {y:.6} {z:.6}\nvn {a:.6} {b:.6} {c:.6}");
        }
    }
    for i in 0..down {
        for j in 0..around {
            let at = |i: u32, j: u32| i * around + j % around + 1;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            let _ = writeln!(text, "f {a}//{a} {b}//{b} {c}//{c}\nf {a}//{a} {c}//{c} {d}//{d}");
        }
    }
    text
}

/// A scene with the mesh `ball.obj`, seen from `eye` toward `target`.
fn scene(keys: &str, material: &str, eye: [f64; 3], target: [f64; 3]) -> String {
    format!(
        r#"{{ "format": "tb-scene", "version": 1, {keys},
        "camera": {{ "eye": {eye:?}, "target": {target:?}, "fov_deg": 40 }},
        "materials": {{ "m": {material} }},
        "objects": [ {{ "mesh": {{ "name": "ball", "file": "ball.obj", "material": "m" }} }} ] }}"#
    )
}

fn rendered(bench: &Bench, flags: &[&str]) -> Rgb32FImage {
    let run = bench.run(&[&["scene.json", "-o", "out.exr"], flags].concat(), b"");
    assert_eq!(ending(&run), (Some(0), String::new()));
    image::load_from_memory(&bench.read("out.exr")).unwrap().to_rgb32f()
}

/// The white furnace: glass neither adds nor loses light, however coarse its mesh is.
#[test]
fn coarse_glass_in_a_white_world_is_white() {
    let glass = r#"{ "ambient": 0, "diffuse": 0, "reflectivity": 1, "transparency": 1,
        "index_of_refraction": 1.5, "fresnel": true }"#;
    for (around, down, depth) in [(9, 6, 40), (8, 5, 12), (24, 12, 40)] {
        let keys = format!(r#""ambient": 0, "background": 1, "max_depth": {depth}"#);
        let bench = Bench::with_scene(&scene(&keys, glass, [0.0, 0.8, 4.5], [0.0; 3]));
        bench.write("ball.obj", ball(around, down, [0.0; 3]));
        for flags in [&["--size", "100x75"][..], &["--size", "60x45", "--sampling", "thesis"]] {
            let picture = rendered(&bench, flags);
            let least = picture.pixels().flat_map(|pixel| pixel.0).fold(f32::INFINITY, f32::min);
            let most = picture.pixels().flat_map(|pixel| pixel.0).fold(0.0, f32::max);
            assert!(least > 1.0 - 1e-3 && most < 1.0 + 1e-3, "{around} x {down}: {least} {most}");
        }
    }
}

/// On a convex ball no point is in a shadow: each pixel has the light of its interpolated normal, also
/// where the plane of its facet is turned from the light.
#[test]
fn smooth_meshes_have_no_staircase_at_the_edge_of_light() {
    let keys =
        r#""ambient": 0.2, "lights": [ { "directional": { "direction": [-1, -0.3, -0.25] } } ]"#;
    let material = r#"{ "diffuse": 0.7 }"#;
    let bench = Bench::with_scene(&scene(keys, material, [0.0, 0.3, 4.5], [0.0; 3]));
    bench.write("ball.obj", ball(10, 7, [0.0; 3]));
    let flags = ["--size", "120x120", "--split", "none", "--layers", "normal"];
    let picture = rendered(&bench, &flags);
    let channels = fixtures::exr::channels(&bench.read("out.exr"));
    let channel = |name: &str| {
        let found = channels.iter().find(|(known, _)| known == name);
        found.map(|(_, values)| values.clone()).unwrap()
    };
    let normals = ["normal.X", "normal.Y", "normal.Z"].map(channel);
    let light = [1.0, 0.3, 0.25f64].map(|x| x / (1.0f64 + 0.09 + 0.0625).sqrt());
    let (mut wrong, mut lit, mut edge) = (0, 0, 0);
    for (k, pixel) in picture.pixels().enumerate() {
        let normal = [0, 1, 2].map(|axis| f64::from(normals[axis][k]));
        if normal == [0.0; 3] {
            continue;
        }
        let cosine: f64 = (0..3).map(|axis| normal[axis] * light[axis]).sum();
        lit += usize::from(cosine > 0.0);
        edge += usize::from(cosine.abs() < 0.3);
        let truth = 0.2 + 0.7 * cosine.max(0.0);
        wrong += usize::from((f64::from(pixel.0[0]) - truth).abs() > 1e-4);
    }
    assert!(lit > 2000 && edge > 500, "{lit} {edge}");
    // Facets seen from the back of their normals, at the silhouette, are lit by their planes.
    assert!(wrong * 200 < lit, "{wrong} of {lit} pixels");
}

/// A ball in metres of a national grid shows what it shows at the origin.
#[test]
fn a_ball_far_from_the_origin_is_round() {
    let keys = r#""ambient": 0.2, "lights": [ { "directional": { "direction": [-1, -1, -1] } } ]"#;
    let material = r#"{ "diffuse": 0.7 }"#;
    let picture = |middle: [f64; 3], place: &str| {
        let eye = [middle[0], middle[1] + 1.0, middle[2] + 4.0];
        let scene = scene(keys, material, eye, middle);
        let bench = Bench::with_scene(
            &scene.replace(r#""material": "m" }"#, &format!(r#""material": "m"{place} }}"#)),
        );
        bench.write("ball.obj", ball(48, 24, if place.is_empty() { middle } else { [0.0; 3] }));
        rendered(&bench, &["--size", "60x60", "--split", "none"])
    };
    let near = picture([0.0; 3], "");
    let place = r#", "place": [ { "translate": [500000, 40, 6000000] } ]"#;
    for far in [
        picture([500_000.0, 40.0, 6_000_000.0], ""),
        picture([-512_340.5, 0.0, 5_843_210.25], ""),
        picture([500_000.0, 40.0, 6_000_000.0], place),
    ] {
        let apart = near.pixels().zip(far.pixels()).filter(|(a, b)| (a.0[0] - b.0[0]).abs() > 1e-3);
        // Rays from far away have positions to a nanometre: some pixels at silhouettes differ.
        assert!(apart.count() < 6);
    }
}

/// All structures find the hits of a mesh with an offset, to the last bit.
#[test]
fn structures_agree_far_from_the_origin() {
    let middle = [500_000.25, 40.0, -6_000_000.5];
    let keys =
        r#""ambient": 0.2, "lights": [ { "point": { "position": [500003, 45, -5999990] } } ]"#;
    let eye = [middle[0], middle[1] + 1.0, middle[2] + 4.0];
    let bench = Bench::with_scene(&scene(keys, "{}", eye, middle));
    bench.write("ball.obj", ball(16, 8, middle));
    let pictures = ["bvh", "grid", "none"].map(|accel| {
        bench.make(&["scene.json", "-o", "out.png", "--size", "40x40", "--accel", accel], b"");
        bench.read("out.png")
    });
    assert!(pictures[0] == pictures[1] && pictures[1] == pictures[2]);
}

const SQUARE: &str =
    "v -1 -1 0 1 0 0\nv 1 -1 0 0 1 0\nv 1 1 0 0 0 1\nv -1 1 0 1 1 0\nf 1 2 3\nf 1 3 4\n";

fn square(material: &str, keys: &str, obj: &str) -> Bench {
    let bench = Bench::with_scene(&format!(
        r#"{{ "format": "tb-scene", "version": 1, "ambient": 1,
        "camera": {{ "eye": [0, 0, 5], "target": [0, 0, 0], "height": 2 }},
        "materials": {{ "m": {material} }},
        "objects": [ {{ "mesh": {{ "name": "square", "file": "square.obj"{keys} }} }} ] }}"#
    ));
    bench.write("square.obj", obj);
    bench
}

/// Colours are those of the vertices, and linear between them. Codes are sRGB, of either range.
#[test]
fn vertices_have_their_colours() {
    let vertex = r#"{ "color": "vertex", "diffuse": 0 }"#;
    let bytes = SQUARE.replace(" 1 0 0\n", " 255 0 0\n").replace(" 0 1 0\n", " 0 255 0\n");
    for (keys, obj) in
        [(r#", "material": "m""#, SQUARE.to_string()), ("", SQUARE.to_string()), ("", bytes)]
    {
        let bench = square(vertex, keys, &obj);
        let picture = rendered(&bench, &["--size", "32x32"]);
        for (x, y, pixel) in picture.enumerate_pixels() {
            if x == 31 - y {
                // The pixel sees both triangles.
                continue;
            }
            let [u, v] = [(x as f32 + 0.5) / 32.0, 1.0 - (y as f32 + 0.5) / 32.0];
            // Weights of the corners of either triangle; blue is 1/255 as a code if red is 255.
            let truth = if u > v { [1.0 - u, u - v, v] } else { [1.0 - u, v - u, u] };
            if u > v {
                let near = (0..2).all(|k| (pixel.0[k] - truth[k]).abs() < 1e-5);
                assert!(near, "{keys}: {x},{y}: {pixel:?} {truth:?}");
            } else {
                assert!(
                    (pixel.0[0] - (1.0 - u)).abs() < 1e-5 || obj.contains("255"),
                    "{x},{y}: {pixel:?}"
                );
            }
        }
    }
    // A material that states no colour shows them, and one that states a colour does not.
    let pictures = [vertex, r#"{ "diffuse": 0 }"#].map(|material| {
        rendered(&square(material, r#", "material": "m""#, SQUARE), &["--size", "32x32"])
    });
    assert!(pictures[0] == pictures[1]);
    let unused = square(r#"{ "color": 1 }"#, r#", "material": "m""#, SQUARE);
    let run = unused.run(&["scene.json", "-o", "out.png", "--size", "4x4"], b"");
    let (_, said) = ending(&run);
    let remark =
        "render: remark: square.obj: not used: vertex colours (4 times), which a material with";
    assert!(said.starts_with(remark), "{said}");
    let odd = square(vertex, "", &SQUARE.replace("0 0 1\n", "nan 0 1\n"));
    let (code, said) = ending(&odd.run(&["scene.json", "-o", "out.png", "--size", "4x4"], b""));
    assert!(code == Some(0) && said.contains("vertex colours that are not finite"), "{said}");
    let bad = square(r#"{ "color": "vertices" }"#, "", SQUARE);
    let parts =
        ["scene.json:3:40: materials.m.color: found the string \"vertices\"", "or \"vertex\""];
    bad.refuse(&["scene.json"], b"", 3, &parts);
}

fn findings(objects: &str, obj: &str) -> String {
    let bench = Bench::with_scene(&format!(
        r#"{{ "format": "tb-scene", "version": 1,
        "camera": {{ "eye": [1, 3, 6], "target": [0, 0, 0], "fov_deg": 60 }},
        "materials": {{ "m": {{}}, "n": {{}} }}, "objects": [ {objects} ] }}"#
    ));
    bench.write("a.obj", obj);
    String::from_utf8(bench.run(&["scene.json", "--check"], b"").stdout).unwrap()
}

/// A decal in the plane of its floor is named, and so are boxes and meshes that overlap in a plane.
/// Neighbours in a mesh, and boxes that stand beside each other, are not.
#[test]
fn surfaces_that_overlap_in_one_plane_are_named() {
    let mesh = r#"{ "mesh": { "name": "a", "file": "a.obj", "materials": { "floor": "m", "mark": "n" } } }"#;
    let floor = "v -3 0 2\nv 3 0 2\nv 3 0 -3\nv -3 0 -3\nusemtl floor\nf 1 2 3 4\n";
    let decal = format!("{floor}v -1 0 0.8\nv 1.1 0 0.6\nv 0.7 0 -1.1\nusemtl mark\nf 5 6 7\n");
    let said = findings(mesh, &decal);
    let hint = "hint: objects[0].mesh: 1 triangle of mark overlaps other triangles of floor in one plane; \
                rounding decides at each point which of the two is seen";
    assert!(said.contains(hint), "{said}");
    let cuboid = |low: [f64; 3], high: [f64; 3]| {
        format!(r#"{{ "box": {{ "low": {low:?}, "high": {high:?}, "material": "m" }} }}"#)
    };
    let (one, on_top) = (cuboid([0.0; 3], [1.0; 3]), cuboid([0.2, 1.0, 0.2], [0.8, 2.0, 0.8]));
    let said = findings(&format!("{one}, {on_top}"), "");
    assert!(
        said.contains("hint: objects[1].box: 1 face overlaps objects[0].box (box) in one plane"),
        "{said}"
    );
    let said = findings(&format!("{mesh}, {on_top}, {}", cuboid([0.0; 3], [0.1; 3])), floor);
    assert!(
        said.contains("hint: objects[2].box: 1 face overlaps objects[0].mesh (mesh a) of floor"),
        "{said}"
    );
    assert!(!said.contains("objects[1].box: 1 face"), "{said}");
    for (objects, obj) in [
        (mesh.to_string(), floor.to_string()),
        (format!("{one}, {}", cuboid([0.0, 0.0, 1.5], [1.0, 1.0, 2.5])), String::new()),
        (mesh.replace("floor", ""), ball(24, 12, [0.0; 3])),
        (mesh.replace("floor", ""), ball(24, 12, [5e5, 40.0, 6e6])),
    ] {
        let said = findings(&objects, &obj);
        assert!(!said.contains("in one plane"), "{said}");
    }
    // A turned box on a rectangle.
    let turned = cuboid([0.0; 3], [1.0; 3]).replace(
        r#""material""#,
        r#""place": [ { "rotate_deg": { "axis": [0, 1, 0], "angle": 30 } } ], "material""#,
    );
    let rectangle = r#"{ "rectangle": { "corner": [-4, 0, 4], "edge_u": [8, 0, 0], "edge_v": [0, 0, -8], "material": "m" } }"#;
    let said = findings(&format!("{rectangle}, {turned}"), "");
    assert!(
        said.contains("hint: objects[1].box: 1 face overlaps objects[0].rectangle (rectangle)"),
        "{said}"
    );
}

#[test]
fn a_bump_without_its_object_is_told_the_keys() {
    let bench = Bench::with_scene(
        r#"{ "format": "tb-scene", "version": 1,
        "camera": { "eye": [0, 0, 4], "target": [0, 0, 0], "fov_deg": 40 },
        "materials": { "b": { "bump": { "image": "x.png", "strength": 0.02 } } }, "objects": [] }"#,
    );
    let message = "scene.json:3:50: materials.b.bump.image: found the string \"x.png\", expected an object with \"file\"";
    bench.refuse(&["scene.json"], b"", 3, &[message]);
}
