//! Bumps, normal maps and emitted light of libraries and of glTF files.

use crate::bench::{Bench, encoded, ending};
use crate::formats::glb;
use image::{
    DynamicImage, GrayImage, ImageFormat, Luma, Rgb, Rgb32FImage, RgbImage, Rgba, RgbaImage,
};
use serde_json::json;

/// A square that fills a view with parallel rays, of one surface.
const SQUARE: &str = "mtllib a.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
    usemtl m\nf 1/1 2/2 3/3 4/4\n";

/// Direction to the light of [`scene`].
const TOWARD: [f64; 3] = [0.6, 0.0, 0.8];

/// A scene that shows a mesh in light from the right, with these keys.
fn scene(mesh: &str, keys: &str) -> String {
    format!(
        r#"{{ "format": "tb-scene", "version": 1, "ambient": 0, "background": [0, 0, 1],
        "camera": {{ "eye": [0, 0, 5], "target": [0, 0, 0], "height": 2 }},
        "lights": [ {{ "directional": {{ "direction": [-0.6, 0, -0.8], "color": 1 }} }} ], {keys}
        "objects": [ {{ "mesh": {{ "name": "a", {mesh} }} }} ] }}"#
    )
}

/// Renders `scene.json`. Returns linear light and what was said.
fn rendered(bench: &Bench) -> (Rgb32FImage, String) {
    let run = bench.run(&["scene.json", "-o", "out.exr", "--size", "16x16"], b"");
    let (code, said) = ending(&run);
    assert_eq!(code, Some(0), "{said}");
    (image::load_from_memory(&bench.read("out.exr")).unwrap().to_rgb32f(), said)
}

/// Renders the square with a library of one material.
fn library(lines: &str, pictures: &[(&str, DynamicImage)]) -> (Rgb32FImage, String) {
    let bench = Bench::with_scene(&scene(r#""file": "a.obj""#, ""));
    bench.write("a.obj", SQUARE);
    bench.write("a.mtl", format!("newmtl m\nKd 1 1 1\n{lines}\n"));
    for (name, picture) in pictures {
        bench.write(name, encoded(picture.clone(), ImageFormat::Png));
    }
    rendered(&bench)
}

/// The light on a white square with a normal of these slopes.
fn lit(slopes: [f64; 2]) -> f64 {
    let [x, y] = slopes;
    (TOWARD[2] - x * TOWARD[0] - y * TOWARD[1]) / (1.0 + x * x + y * y).sqrt()
}

fn assert_even(picture: &Rgb32FImage, truth: [f64; 3], what: &str) {
    for pixel in picture.pixels() {
        for k in 0..3 {
            assert!((f64::from(pixel.0[k]) - truth[k]).abs() < 1e-5, "{what}: {pixel:?} {truth:?}");
        }
    }
}

/// The normal of a map is that of the surface, over its texture coordinates, times the strength.
#[test]
fn a_normal_map_of_one_colour_turns_the_surface() {
    // A unit vector within 0.002.
    let code = [153_u8, 102, 250];
    let [x, y, z] = code.map(|code| f64::from(code) / 255.0 * 2.0 - 1.0);
    let map = || [("n.png", RgbImage::from_pixel(4, 4, Rgb(code)).into())];
    for (lines, strength, remark) in [
        ("norm n.png", 1.0, ""),
        ("norm -bm 0.5 n.png", 0.5, ""),
        ("norm -bm -1 n.png", -1.0, ""),
        ("map_Bump -bm 2 n.png", 2.0, "a.mtl: n.png is taken as a normal map, by its colours"),
    ] {
        let (picture, said) = library(lines, &map());
        let light = lit([-strength * x / z, -strength * y / z]);
        assert_even(&picture, [light; 3], lines);
        assert!(said.contains(remark) && said.is_empty() == remark.is_empty(), "{said}");
    }
    // Coordinates that are turned by a quarter turn the normal, and mirrored ones mirror it.
    let turned = SQUARE.replace("f 1/1 2/2 3/3 4/4", "f 1/2 2/3 3/4 4/1");
    let mirrored = SQUARE.replace("f 1/1 2/2 3/3 4/4", "f 1/2 2/1 3/4 4/3");
    for (obj, slopes) in [(turned, [-y, x]), (mirrored, [x, -y])] {
        let bench = Bench::with_scene(&scene(r#""file": "a.obj""#, ""));
        bench.write("a.obj", obj);
        bench.write("a.mtl", "newmtl m\nKd 1 1 1\nnorm n.png\n");
        bench.write("n.png", encoded(map()[0].1.clone(), ImageFormat::Png));
        assert_even(&rendered(&bench).0, [lit(slopes.map(|slope| slope / z)); 3], "turned");
    }
}

/// A bump of a library is the bump of the scene with the same picture, strength and repetitions.
#[test]
fn a_bump_of_a_library_is_that_of_a_scene() {
    let height = |x: u32, y: u32| Luma([((x * x * 7 + y * 13) % 64) as u8]);
    let heights = GrayImage::from_fn(8, 8, height);
    let pictures = [
        ("h.png", heights.into()),
        ("white.png", RgbImage::from_pixel(1, 1, Rgb([255; 3])).into()),
    ];
    for (lines, strength, repeat) in [
        ("map_Bump -bm 0.2 h.png", "0.2", "[1, 1]"),
        ("bump -s 2 3 -bm -0.1 h.png", "-0.1", "[2, 3]"),
        // The relief lies as its own options say, whatever those of the colours are.
        ("map_Kd -s 5 0.5 -o 0.3 0.1 white.png\nbump -s 2 3 -bm 0.1 h.png", "0.1", "[2, 3]"),
    ] {
        let (found, said) = library(lines, &pictures);
        assert_eq!(said, "", "{lines}");
        let keys = format!(
            r#""materials": {{ "m": {{ "color": 1, "diffuse": 1, "bump": {{ "strength": {strength},
            "image": {{ "file": "h.png", "repeat": {repeat} }} }} }} }},"#
        );
        let bench = Bench::with_scene(&scene(r#""file": "a.obj", "material": "m""#, &keys));
        bench.write("a.obj", SQUARE.replace("mtllib a.mtl\n", ""));
        bench.write("h.png", encoded(pictures[0].1.clone(), ImageFormat::Png));
        let (truth, _) = rendered(&bench);
        let range = truth.iter().fold([1_f32, 0.0], |[low, high], &x| [low.min(x), high.max(x)]);
        assert!(range[1] > range[0] + 0.1, "{range:?}");
        for (a, b) in found.iter().zip(truth.iter()) {
            // Texture coordinates that were moved are in single precision.
            assert!((a - b).abs() < 1e-4, "{lines}: {a} {b}");
        }
    }
    let (flat, said) = library("bump lost.png", &[]);
    assert_even(&flat, [TOWARD[2]; 3], "lost");
    assert!(said.contains("a.mtl: no bump: ") && said.contains("lost.png"), "{said}");
}

/// The key `normals` is the statement `norm`.
#[test]
fn a_normal_map_of_a_scene_is_that_of_a_library() {
    let texel = |x: u32, y: u32| Rgb([(90 + 9 * x) as u8, (160 - 8 * y) as u8, 230]);
    let map = [("n.png", RgbImage::from_fn(8, 8, texel).into())];
    let (truth, _) = library("norm -s 2 3 -bm 0.7 n.png", &map);
    let keys = r#""materials": { "m": { "color": 1, "diffuse": 1, "bump": { "strength": 0.7,
        "normals": { "file": "n.png", "repeat": [2, 3] } } } },"#;
    let bench = Bench::with_scene(&scene(r#""file": "a.obj", "material": "m""#, keys));
    bench.write("a.obj", SQUARE);
    bench.write("n.png", encoded(map[0].1.clone(), ImageFormat::Png));
    assert!(rendered(&bench).0 == truth);
    let odd = keys.replace(r#""strength""#, r#""place": {}, "strength""#);
    let bench = Bench::with_scene(&scene(r#""file": "a.obj", "material": "m""#, &odd));
    bench.write("n.png", encoded(map[0].1.clone(), ImageFormat::Png));
    bench.refuse(
        &["scene.json"],
        b"",
        3,
        &["scene.json:", "materials.m.bump.place: found this key"],
    );
}

/// Emitted light is added, in light and in shadow, and lights no other surface.
#[test]
fn light_of_its_own_is_added() {
    let (picture, said) = library("Ke 0.25 0.5 2", &[]);
    assert_even(&picture, [0.25, 0.5, 2.0].map(|own| own + TOWARD[2]), "Ke");
    assert_eq!(said, "");
    // Half of everything, with the blue background behind.
    let (picture, _) = library("Ke 0.25 0.5 2\nd 0.5", &[]);
    let half = [0.25, 0.5, 2.0].map(|own| 0.5 * (own + TOWARD[2]));
    assert_even(&picture, [half[0], half[1], half[2] + 0.5], "d");
    let keys = r#""materials": { "m": { "color": 0, "emission": [0.25, 0.5, 2] },
        "white": { "diffuse": 1 } },"#;
    let alone = Bench::with_scene(&scene(r#""file": "a.obj", "material": "m""#, keys));
    alone.write("a.obj", SQUARE);
    assert_even(&rendered(&alone).0, [0.25, 0.5, 2.0], "emission");
    let said = String::from_utf8(alone.run(&["scene.json", "--check"], b"").stdout).unwrap();
    assert!(!said.contains("black"), "{said}");
}

/// The square as a GLB with this material and these pictures.
fn gltf(material: &serde_json::Value, pictures: &[DynamicImage]) -> Bench {
    let corners = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0_f32]];
    let uvs = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0_f32]];
    let mut bytes: Vec<u8> = corners.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    bytes.extend(uvs.iter().flatten().flat_map(|x| x.to_le_bytes()));
    bytes.extend([0, 1, 2, 0, 2, 3, 0, 0]);
    let numbers: Vec<usize> = (0..pictures.len()).collect();
    let json = json!({
        "asset": { "version": "2.0" }, "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [
            { "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "indices": 2, "material": 0 } ] }],
        "materials": [material],
        "textures": numbers.iter().map(|k| json!({ "source": k })).collect::<Vec<_>>(),
        "images": numbers.iter().map(|k| json!({ "uri": format!("{k}.png") })).collect::<Vec<_>>(),
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" },
            { "bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2" },
            { "bufferView": 2, "componentType": 5121, "count": 6, "type": "SCALAR" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 32 },
            { "buffer": 0, "byteOffset": 80, "byteLength": 6 },
        ],
        "buffers": [{ "byteLength": 88 }],
    });
    let bench = Bench::with_scene(&scene(r#""file": "a.glb""#, ""));
    bench.write("a.glb", glb(&json, &bytes));
    for (k, picture) in pictures.iter().enumerate() {
        bench.write(&format!("{k}.png"), encoded(picture.clone(), ImageFormat::Png));
    }
    bench
}

#[test]
fn a_gltf_has_normals_and_light_of_its_own() {
    let rough = json!({ "metallicFactor": 0, "roughnessFactor": 1 });
    let own = json!({ "pbrMetallicRoughness": rough, "emissiveFactor": [0.25, 0.5, 1.0],
        "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 2.0 } } });
    let (picture, said) = rendered(&gltf(&own, &[]));
    assert_even(&picture, [0.5, 1.0, 2.0].map(|own| own + TOWARD[2]), "emissive");
    assert_eq!(said, "");
    let code = [153_u8, 102, 230];
    let [x, y, z] = code.map(|code| f64::from(code) / 255.0 * 2.0 - 1.0);
    let map = || [RgbImage::from_pixel(4, 4, Rgb(code)).into()];
    let normal = json!({ "index": 0, "scale": 0.5 });
    let bumped = json!({ "pbrMetallicRoughness": rough, "normalTexture": normal });
    let (picture, said) = rendered(&gltf(&bumped, &map()));
    assert_even(&picture, [lit([-0.5 * x / z, -0.5 * y / z]); 3], "normals");
    assert_eq!(said, "");
    // Other coordinates than those of the base colour are not used, and said so.
    let mut other = bumped;
    other["pbrMetallicRoughness"]["baseColorTexture"] = json!({ "index": 1 });
    other["normalTexture"]["extensions"] = json!({ "KHR_texture_transform": { "scale": [2, 2] } });
    let white = RgbImage::from_pixel(1, 1, Rgb([255; 3]));
    let (picture, said) = rendered(&gltf(&other, &[map()[0].clone(), white.into()]));
    assert_even(&picture, [TOWARD[2]; 3], "other coordinates");
    assert!(said.contains("not used: normal textures with coordinates of their own"), "{said}");
}

/// Texels of a mask are there or not: their alpha times the factor is compared with the cutoff.
#[test]
fn a_mask_of_a_gltf_has_a_cutoff() {
    // Alpha 64 and 128 above, 192 and 255 below.
    let alpha = |x: u32, y: u32| [64, 128, 192, 255][(x / 8 + 2 * (y / 8)) as usize];
    let picture = RgbaImage::from_fn(16, 16, |x, y| Rgba([255, 255, 255, alpha(x, y)]));
    for (mode, cutoff, factor, truth) in [
        ("MASK", None, 1.0, [0.0, 1.0, 1.0, 1.0]),
        ("MASK", Some(0.6), 1.0, [0.0, 0.0, 1.0, 1.0]),
        ("MASK", Some(0.6), 0.7, [0.0, 0.0, 0.0, 1.0]),
        ("MASK", Some(0.6), 0.5, [0.0; 4]),
        ("MASK", Some(0.0), 1.0, [1.0; 4]),
        ("OPAQUE", None, 0.5, [1.0; 4]),
        ("BLEND", None, 1.0, [64.0, 128.0, 192.0, 255.0].map(|code| code / 255.0)),
        ("BLEND", None, 0.5, [64.0, 128.0, 192.0, 255.0].map(|code| code / 510.0)),
    ] {
        let mut material = json!({ "alphaMode": mode, "pbrMetallicRoughness": {
            "metallicFactor": 0, "roughnessFactor": 1, "baseColorTexture": { "index": 0 },
            "baseColorFactor": [1, 1, 1, factor] } });
        if let Some(cutoff) = cutoff {
            material["alphaCutoff"] = json!(cutoff);
        }
        let (found, said) = rendered(&gltf(&material, &[picture.clone().into()]));
        assert_eq!(said, "", "{mode} {cutoff:?}");
        for (k, [x, y]) in [[4, 4], [12, 4], [4, 12], [12, 12]].into_iter().enumerate() {
            // The square is white in this light, and the background is blue.
            let pixel = found.get_pixel(x, y).0.map(f64::from);
            let expected = [TOWARD[2] * truth[k], TOWARD[2] * truth[k] + 1.0 - truth[k]];
            assert!(
                (pixel[0] - expected[0]).abs() < 1e-4 && (pixel[2] - expected[1]).abs() < 1e-4,
                "{mode} {cutoff:?} {factor}: {pixel:?} {expected:?}"
            );
        }
    }
}
