//! Boxes, superquadrics and placed objects: pairs of descriptions that give equal pictures.

use crate::studio;

use fixtures::rounding::STEP;
use glam::{DAffine3, DQuat, DVec3};
use render::filter::Filter;
use render::{Picture, Scene};
use studio::{FILTERS, assert_near, at, on_film, picture, pixels, png, scene};

const MATERIALS: &str = r#""materials": { "paint": { "diffuse": 0.8, "specular": 0.3 },
    "unlit": { "diffuse": 0 }, "mirror": { "ambient": 0, "diffuse": 0, "reflectivity": 1 },
    "air": { "ambient": 0, "diffuse": 0, "transparency": 1, "index_of_refraction": 1 },
    "glass": { "ambient": 0, "diffuse": 0, "reflectivity": 1, "transparency": 1, "fresnel": true } }"#;

/// Returns a picture of smoothly varying colours.
fn map() -> Vec<u8> {
    let wave = |k: usize, n: usize| (128.0 + 100.0 * (0.2 * (k * n) as f64).sin()) as u8;
    let texels: Vec<_> =
        (0..1024).map(|k| [wave(k % 32, 1), wave(k / 32, 2), wave(k, 3)]).collect();
    png(32, &texels)
}

fn shown(keys: &str, objects: &str, obj: &[u8]) -> Scene {
    let keys = format!(
        r#""textures": {{ "map": {{ "image": "map.png" }} }}, {MATERIALS}, {keys} "objects": [ {objects} ]"#
    );
    scene(&keys, &[("map.png", map()), ("m.obj", obj.to_vec())])
}

/// A floor of light under a sky of different light.
const WORLD: &str = r#""background": [0.3, 0.5, 0.7], "ambient": 0.6,"#;

/// Returns one object of each kind except meshes, each with the placement `place`.
fn one_of_each(material: &str, place: &str) -> [String; 6] {
    let looks = format!(r#""material": "{material}", "texture": "map" {place}"#);
    [
        format!(r#"{{ "sphere": {{ "center": [0.1, 0, 0.1], "radius": 0.6, {looks} }} }}"#),
        format!(
            r#"{{ "box": {{ "low": [-0.5, -0.5, -0.4], "high": [0.5, 0.25, 0.5], {looks} }} }}"#
        ),
        superquadric("[0.2, 0.4]", "", &looks),
        superquadric("[3, 2.5]", "", &looks),
        superquadric("[0.7, 1.6]", r#""ring": 1.5,"#, &looks),
        format!(
            r#"{{ "rectangle": {{ "corner": [-0.5, -0.5, 0], "edge_u": [1, 0, 0],
            "edge_v": [0.1, 1, 0], {looks} }} }}"#
        ),
    ]
}

fn superquadric(exponents: &str, ring: &str, looks: &str) -> String {
    let radii = if ring.is_empty() { "[0.6, 0.5, 0.7]" } else { "[0.25, 0.25, 0.25]" };
    format!(
        r#"{{ "superquadric": {{ "center": [0, 0.05, 0], "radii": {radii}, "exponents": {exponents},
        {ring} {looks} }} }}"#
    )
}

const CAMERA: &str = r#""camera": { "eye": [0.8, 0.9, 2], "target": [0, 0, 0], "fov_deg": 45 },
    "lights": [ { "point": { "position": [3, 4, 5], "color": 0.8 } } ],"#;

#[test]
fn a_placement_that_changes_nothing_gives_the_same_bytes() {
    let nothing = r#", "place": [ { "scale": [1, 1, 1] }, { "translate": [0, 0, 0] },
        { "rotate_deg": { "axis": [1, 2, 3], "angle": 360 } } ]"#;
    for (plain, placed) in one_of_each("paint", "").iter().zip(one_of_each("paint", nothing)) {
        for filter in [Filter::Point, Filter::Tent] {
            let plain = picture(&shown(&format!("{WORLD} {CAMERA}"), plain, b""), 40, filter);
            let placed = picture(&shown(&format!("{WORLD} {CAMERA}"), &placed, b""), 40, filter);
            assert!(plain == placed);
        }
    }
}

#[test]
fn a_turned_object_looks_as_it_does_to_a_camera_turned_the_other_way() {
    // The objects are rotated so that their poles and seams are visible.
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 130f64.to_radians());
    let way = DAffine3::from_rotation_translation(turn, DVec3::new(2.0, -1.0, 0.5));
    let place = r#", "place": [ { "rotate_deg": { "axis": [1, 2, -0.5], "angle": 130 } },
        { "translate": [2, -1, 0.5] } ]"#;
    let point = |v: [f64; 3]| way.transform_point3(v.into()).to_array();
    let camera = format!(
        r#""camera": {{ "eye": {:?}, "target": {:?}, "up": {:?}, "fov_deg": 45 }},
        "lights": [ {{ "point": {{ "position": {:?}, "color": 0.8 }} }} ],"#,
        point([0.8, 0.9, 2.0]),
        point([0.0; 3]),
        (turn * DVec3::Y).to_array(),
        point([3.0, 4.0, 5.0])
    );
    for material in ["paint", "glass"] {
        let pairs = one_of_each(material, "").into_iter().zip(one_of_each(material, place));
        for (plain, placed) in pairs {
            let plain =
                picture(&shown(&format!("{WORLD} {CAMERA}"), &plain, b""), 48, Filter::Tent);
            let placed =
                picture(&shown(&format!("{WORLD} {camera}"), &placed, b""), 48, Filter::Tent);
            let far =
                |(a, b): (&[f32; 3], &[f32; 3])| (0..3).any(|k| (a[k] - b[k]).abs() > 1.0 / 255.0);
            let different =
                plain.pixels.iter().zip(&placed.pixels).filter(|&pair| far(pair)).count();
            // A rounding may send a ray past an edge, repeatedly inside glass.
            assert!(different <= 2, "{different} pixels differ: {material}");
        }
    }
}

/// Returns the box from -1/2 to 1/2 as triangles that face outward, with a `usemtl` and the whole
/// picture on each face.
fn box_of_triangles() -> String {
    let mut obj: String = (0..8)
        .map(|k: i32| {
            let side = |bit: i32| if k >> bit & 1 == 1 { 0.5 } else { -0.5 };
            format!("v {} {} {}\n", side(0), side(1), side(2))
        })
        .collect();
    obj += "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    // Corners of each face from the lower left one, counter-clockwise as seen from outside.
    let faces =
        [[0, 4, 6, 2], [5, 1, 3, 7], [0, 1, 5, 4], [6, 7, 3, 2], [1, 0, 2, 3], [4, 5, 7, 6]];
    for (k, face) in faces.iter().enumerate() {
        let [a, b, c, d] = face.map(|corner| corner + 1);
        obj += &format!("usemtl face{k}\nf {a}/1 {b}/2 {c}/3\nf {a}/1 {c}/3 {d}/4\n");
    }
    obj
}

#[test]
fn a_box_of_twelve_triangles_looks_like_the_box() {
    let obj = box_of_triangles();
    // The placements are exact in f32, so that both boxes are equal; the second one mirrors.
    let places = [
        "",
        r#", "place": [ { "scale": [-0.75, 1.25, 1] }, { "translate": [0.125, 0, 0.25] },
            { "rotate_deg": { "axis": [0, 1, 0], "angle": 90 } } ]"#,
    ];
    for place in places {
        for material in ["paint", "glass", "mirror"] {
            let looks = format!(r#""material": "{material}", "texture": "map" {place}"#);
            let cuboid = format!(
                r#"{{ "box": {{ "low": [-0.5, -0.5, -0.5], "high": [0.5, 0.5, 0.5], {looks} }} }}"#
            );
            let mesh = format!(r#"{{ "mesh": {{ "name": "m", "file": "m.obj", {looks} }} }}"#);
            let floor = r#"{ "plane": { "point": [0, -1, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, -1],
                "material": "paint", "texture": "map" } }"#;
            for filter in FILTERS {
                let make = |object: &str| {
                    let objects = format!("{object}, {floor}");
                    picture(
                        &shown(&format!("{WORLD} {CAMERA}"), &objects, obj.as_bytes()),
                        64,
                        filter,
                    )
                };
                let (cuboid, mesh) = (make(&cuboid), make(&mesh));
                let far =
                    |(a, b): (&[f32; 3], &[f32; 3])| (0..3).any(|k| (a[k] - b[k]).abs() > STEP);
                let different =
                    cuboid.pixels.iter().zip(&mesh.pixels).filter(|&pair| far(pair)).count();
                assert!(different == 0, "{different} pixels differ: {material} {filter:?} {place}");
            }
        }
    }
}

#[test]
fn no_ray_is_lost_in_a_shape_of_air() {
    // Light that enters and leaves again shows the world beyond. A ray that met its own start would
    // swap inside and outside and meet the surface again, until it is cut and black.
    let stretched = r#", "place": [ { "scale": [1.5, 0.25, 0.75] },
        { "rotate_deg": { "axis": [1, 1, 0], "angle": 40 } }, { "translate": [0.1, 0.1, -0.2] } ]"#;
    for place in ["", stretched] {
        for object in one_of_each("air", place) {
            let seen =
                picture(&shown(&format!("{WORLD} {CAMERA}"), &object, b""), 96, Filter::Point);
            assert!(seen.pixels.iter().all(|&pixel| pixel == [0.3, 0.5, 0.7]), "{object}");
        }
    }
}

#[test]
fn a_ball_of_glass_in_a_mirror_is_a_ball_of_glass() {
    let ball = |place: &str| {
        let sphere = format!(
            r#"{{ "sphere": {{ "center": [0.125, 0, 0], "radius": 0.5, "material": "glass" {place} }} }}"#
        );
        picture(&shown(&format!("{WORLD} {CAMERA}"), &sphere, b""), 64, Filter::Point)
    };
    let mirrored =
        ball(r#", "place": [ { "translate": [-0.25, 0, 0] }, { "scale": [-1, 1, 1] } ]"#);
    assert_near(&mirrored, &ball(""), STEP);
}

#[test]
fn across_the_edge_of_a_box_nothing_is_averaged() {
    // The rim of each face is white and its inside black. A filter that joined two faces to one
    // footprint would see the black of a whole face.
    let rim = |k: usize| [0, 15].contains(&(k % 16)) || [0, 15].contains(&(k / 16));
    let texels: Vec<[u8; 3]> = (0..256).map(|k| [if rim(k) { 255 } else { 0 }; 3]).collect();
    let keys = format!(
        r#""camera": {{ "eye": [2, 0, 2], "target": [0, 0, 0], "fov_deg": 40 }}, "ambient": 1,
        "textures": {{ "rim": {{ "image": "rim.png", "wrap": "clamp" }} }}, {MATERIALS},
        "objects": [ {{ "box": {{ "low": [-1, -1, -1], "high": [1, 1, 1], "material": "unlit",
        "texture": "rim" }} }} ]"#
    );
    for filter in FILTERS {
        // The upright edge is in the middle, between two pixels.
        let shown = picture(&scene(&keys, &[("rim.png", png(16, &texels))]), 64, filter);
        for y in 16..48 {
            // The middles of these pixels are 0.1 texels from the edge. The widest filter reaches
            // 1.5 texels from there, and has 0.6^3 / 6 of its weight beyond the rim. A footprint of
            // a quarter of a texel adds to that.
            for x in [31, 32] {
                assert!(at(&shown, x, y)[0] > 0.95, "{filter:?} {x} {y}: {:?}", at(&shown, x, y));
            }
        }
        // At 2.1 texels from the edge, 0.4^3 / 6 of the weight lies on the rim.
        assert!(at(&shown, 20, 32)[0] < 0.05);
    }
}

#[test]
fn a_sharp_superquadric_looks_like_the_box_it_all_but_is() {
    let silhouette = |object: &str| {
        let seen = picture(&shown(&format!("{WORLD} {CAMERA}"), object, b""), 64, Filter::Point);
        seen.pixels.iter().filter(|&&pixel| pixel != [0.3, 0.5, 0.7]).count()
    };
    let box_ = silhouette(
        r#"{ "box": { "low": [-0.5, -0.5, -0.5], "high": [0.5, 0.5, 0.5], "material": "unlit" } }"#,
    );
    let sharp = silhouette(
        r#"{ "superquadric": { "center": [0, 0, 0], "radii": [0.5, 0.5, 0.5],
        "exponents": [0.05, 0.05], "material": "unlit" } }"#,
    );
    // The shape contains the box shrunk by 2.7 %, whose silhouette is 5.3 % smaller.
    assert!(sharp <= box_ && sharp as f64 > 0.947 * box_ as f64, "{sharp} {box_}");
}

#[test]
fn an_octahedron_is_where_the_sum_of_the_coordinates_is_1() {
    // With exponents 2 and 2 the shape is |x| + |y| + |z| = 1. Seen along z, its silhouette is the
    // square on its corner.
    let keys =
        r#""camera": { "eye": [0, 0, 1000001], "target": [0, 0, 0], "fov_deg": 0.0001145916 },"#;
    let object = r#"{ "superquadric": { "center": [0, 0, 0], "radii": [1, 1, 1], "exponents": [2, 2],
        "material": "unlit" } }"#;
    let seen: Picture = picture(&shown(&format!("{keys} {WORLD}"), object, b""), 64, Filter::Point);
    for (x, y, pixel) in pixels(&seen) {
        let [a, b] = on_film(x, y, 64);
        let off = a.abs() + b.abs() - 1.0;
        // Pixels whose middle lies exactly on the edge may be inside or outside.
        assert!(
            off.abs() < 1e-3 || (off < 0.0) == (pixel != [0.3, 0.5, 0.7]),
            "{x} {y}: {pixel:?}"
        );
    }
}

#[test]
fn objects_know_the_space_they_were_described_in() {
    let place = r#", "place": [ { "scale": [2, 4, -0.5] }, { "translate": [1, 2, 3] } ]"#;
    let mesh =
        format!(r#"{{ "mesh": {{ "name": "m", "file": "m.obj", "material": "paint" {place} }} }}"#);
    let objects = one_of_each("paint", place).join(",") + "," + &mesh;
    let scene = shown(WORLD, &objects, box_of_triangles().as_bytes());
    for object in &scene.objects {
        let own = object.to_own_space.transform_point3(DVec3::new(3.0, 6.0, 2.5));
        assert_eq!(own, DVec3::ONE);
    }
    let plain = shown(WORLD, &one_of_each("paint", "").join(","), b"");
    assert!(plain.objects.iter().all(|object| object.to_own_space == DAffine3::IDENTITY));
}
