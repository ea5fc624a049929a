//! Meshes that a scene shows many times: they equal written-out copies, and exist once.

use crate::bench;
use crate::studio;

use bench::{Bench, ending};
use glam::{DAffine3, DMat3, DVec3};
use proptest::prelude::*;
use render::accel::{Accel, Structure};
use render::filter::Filter;
use render::ray::{Piece, Ray};
use render::scene::Scene;
use render::shape::mesh::{Mesh, NONE, Triangle};
use render::shape::{Instance, Placement, Shape, SharedMesh, Sphere};
use std::sync::Arc;
use studio::{png, scene, sized};

/// A pyramid of four sides with a picture on each, and smooth normals. Its coordinates have few binary
/// digits, so that copies at whole and half numbers are exact.
const PYRAMID: &str = "v -0.5 0 -0.5\nv 0.5 0 -0.5\nv 0.5 0 0.5\nv -0.5 0 0.5\nv 0 1 0\n\
    vt 0 0\nvt 1 0\nvt 0.5 1\nvn -1 1 -1\nvn 1 1 -1\nvn 1 1 1\nvn -1 1 1\nvn 0 1 0\n\
    f 2/1/2 1/2/1 5/3/5\nf 3/1/3 2/2/2 5/3/5\nf 4/1/4 3/2/3 5/3/5\nf 1/1/1 4/2/4 5/3/5\n\
    f 1/1/1 2/2/2 3/3/3\nf 1/1/1 3/2/3 4/3/4\n";

/// Returns the scene of these objects over a floor, with a mirror.
fn valley(objects: &str) -> Scene {
    let keys = format!(
        r#""camera": {{ "eye": [0.5, 3, 6], "target": [0, 0, 0], "fov_deg": 50 }},
        "lights": [ {{ "point": {{ "position": [3, 6, 2], "color": 0.8 }} }} ],
        "textures": {{ "stripes": {{ "image": "stripes.png" }} }},
        "materials": {{ "stone": {{}}, "glass": {{ "transparency": 0.5, "index_of_refraction": 1.1 }} }},
        "objects": [ {objects},
          {{ "plane": {{ "point": [0, -0.125, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, -1],
            "material": "stone" }} }} ]"#
    );
    let texels: Vec<[u8; 3]> = (0..8).map(|k| [255 * (k % 2), 120, 30 * k]).collect();
    scene(&keys, &[("stripes.png", png(8, &texels)), ("pyramid.obj", PYRAMID.into())])
}

/// Returns a mesh object with these keys.
fn pyramid(keys: &str) -> String {
    format!(r#"{{ "mesh": {{ "name": "p", "file": "pyramid.obj", "texture": "stripes"{keys} }} }}"#)
}

const PLACES: [&str; 4] = [
    r#"{ "translate": [-2, 0, 0.5] }"#,
    r#"{ "scale": [2, 1.5, -1] }, { "translate": [1.5, 0, -2] }"#,
    r#"{ "rotate_deg": { "axis": [0, 1, 0], "angle": 90 } }, { "translate": [0, 0.5, 1] }"#,
    r#"{ "matrix": [[1, 0.25, 0, 2], [0, 1, 0, 0], [0, 0, 1, 1]] }"#,
];

/// Returns the largest difference of a channel, and the number of pixels that differ by more than 1e-4.
fn apart(one: &Scene, other: &Scene) -> (f32, usize) {
    let [one, other] = [one, other].map(|scene| sized(scene, 96, 72, Filter::Exact));
    let differences = one
        .pixels
        .iter()
        .zip(&other.pixels)
        .map(|(a, b)| (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f32::max));
    let differences: Vec<f32> = differences.collect();
    let most = differences.iter().copied().fold(0.0, f32::max);
    (most, differences.into_iter().filter(|&difference| difference > 1e-4).count())
}

/// The corners of these copies are exact in single precision. The two scenes then differ by the rounding
/// of rays in own space only, which moves the outlines of no pixel.
#[test]
fn instances_are_copies() {
    for material in ["stone", "glass"] {
        let key = format!(r#", "material": "{material}""#);
        let listed = PLACES.map(|place| format!("[ {place} ]")).join(", ");
        let shared = valley(&pyramid(&format!("{key}, \"instances\": [ {listed} ]")));
        // A different angle for each object keeps the meshes apart.
        let copies = PLACES.iter().enumerate().map(|(k, place)| {
            pyramid(&format!("{key}, \"smooth_deg\": {k}, \"place\": [ {place} ]"))
        });
        let copies = valley(&copies.collect::<Vec<_>>().join(", "));
        assert_eq!((shared.objects.len(), copies.objects.len()), (5, 5));
        assert_eq!((shared.triangles(), copies.triangles()), (6, 24));
        assert!(copies.objects.iter().all(|object| !matches!(object.shape, Shape::Instance(_))));
        let (most, count) = apart(&shared, &copies);
        // The error estimate that splits pixels may fall on the other side of its threshold.
        assert!(count <= 3 && most < 0.05, "{material}: {count} pixels differ, by up to {most}");
    }
}

/// Objects that name the same file share its mesh, whatever their materials. An object that smooths it in
/// another manner has a mesh of its own.
#[test]
fn objects_of_one_file_share_its_mesh() {
    let places = r#", "place": [ { "translate": [1, 0, 0] } ]"#;
    let objects = [
        pyramid(r#", "material": "stone""#),
        pyramid(&format!(r#", "material": "glass"{places}"#)),
        pyramid(r#", "material": "stone", "smooth_deg": 30"#),
    ];
    let scene = valley(&objects.join(", "));
    let instances: Vec<Option<usize>> = scene
        .objects
        .iter()
        .map(|object| match &object.shape {
            Shape::Instance(instance) => Some(instance.key()),
            _ => None,
        })
        .collect();
    assert!(instances[0].is_some() && instances[0] == instances[1]);
    assert_eq!(instances[2..], [None, None]);
    assert_eq!(scene.triangles(), 12);
    assert_eq!(scene.objects[1].parts[0].material, 0, "glass comes before stone");
    assert_eq!(scene.names.objects.len(), 4);
}

/// The triangles of a soup, without texture coordinates and normals.
fn soup(corners: &[[[f32; 3]; 3]]) -> Mesh {
    let triangle = |k: u32| Triangle {
        position: [3 * k, 3 * k + 1, 3 * k + 2],
        uv: [NONE; 3],
        normal: [NONE; 3],
        surface: 0,
    };
    Mesh {
        positions: corners.concat(),
        triangles: (0..corners.len() as u32).map(triangle).collect(),
        surfaces: vec![String::new()],
        ..Mesh::default()
    }
}

/// The bits of a hit.
type Exact = (u64, Piece, [u64; 2]);

fn hits(accel: &Accel<'_>, ray: &Ray, t_max: f64) -> (Option<Exact>, Vec<Exact>) {
    let bits =
        |hit: render::ray::Hit| (hit.t.to_bits(), hit.piece, hit.barycentric.map(f64::to_bits));
    let mut all = Vec::new();
    accel.any(ray, t_max, |hit| {
        all.push(bits(hit));
        false
    });
    all.sort_unstable();
    (accel.closest(ray, t_max).map(bits), all)
}

fn vector(size: f64) -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-size..size).prop_map(DVec3::from)
}

/// Draws rotated, sheared, mirrored and moved placements, and quarter turns at whole numbers.
fn placement() -> impl Strategy<Value = Placement> {
    let any = (vector(1.5), vector(1.5), vector(1.5), vector(4.0));
    let any = any.prop_filter_map("not flat", |(x, y, z, shift)| {
        let linear = DMat3::from_cols(x, y, z);
        let thick = linear.determinant().abs() > 0.05;
        thick.then(|| Placement::new(DAffine3::from_mat3_translation(linear, shift)).unwrap())
    });
    let whole = (0..4, prop::array::uniform3(-3i8..=3)).prop_map(|(turns, shift)| {
        let turn = [DVec3::X, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Z][turns as usize];
        let linear = DMat3::from_cols(turn, DVec3::Y, turn.cross(DVec3::Y));
        let shift = DVec3::from(shift.map(f64::from));
        Placement::new(DAffine3::from_mat3_translation(linear, shift)).unwrap()
    });
    prop_oneof![any, whole]
}

proptest! {
    /// Tree, grids and brute force find the same hits on instances, spheres and plain meshes together,
    /// each hit once, to the last bit.
    #[test]
    fn all_structures_see_the_same_instances(
        corners in prop::collection::vec(prop::array::uniform3(prop::array::uniform3(
            (-4i8..=4).prop_map(|k| f32::from(k) * 0.25))), 1..40),
        placements in prop::collection::vec(placement(), 1..6),
        eyes in prop::collection::vec((vector(8.0), 0usize..40, 0usize..6, any::<bool>()), 1..12),
    ) {
        let shared = SharedMesh::new(soup(&corners));
        let other = SharedMesh::new(soup(&corners[..1]));
        let instance = |k: usize, &at: &Placement| {
            let shared = if k % 3 == 2 { &other } else { &shared };
            Shape::Instance(Instance::new(Arc::clone(shared), at))
        };
        let mut shapes: Vec<Shape> =
            placements.iter().enumerate().map(|(k, at)| instance(k, at)).collect();
        shapes.push(Shape::Sphere(Sphere { center: DVec3::ONE, radius: 0.5 }));
        shapes.push(Shape::Mesh(soup(&corners[..corners.len() / 2 + 1])));
        let accels = [Structure::None, Structure::Bvh, Structure::Grid]
            .map(|structure| Accel::build(shapes.iter().collect(), structure));
        let [brute, others @ ..] = &accels;
        for (eye, triangle, object, leaving) in eyes {
            let object = object % placements.len();
            let mesh = if object % 3 == 2 { other.mesh() } else { shared.mesh() };
            let triangle = (triangle % mesh.triangles.len()) as u32;
            let target = shapes[object].surface_point(triangle, [0.25, 0.25], DVec3::ZERO).position;
            let mut ray = Ray::from_eye(eye, (target - eye).normalize_or(DVec3::X));
            if leaving {
                let piece = Piece { object: object as u32, triangle };
                ray = Ray::leaving(piece, target, -ray.direction);
            }
            let (first, all) = hits(brute, &ray, f64::INFINITY);
            let middle = all.get(all.len() / 2).map_or(1.0, |hit| f64::from_bits(hit.0));
            let some = hits(brute, &ray, middle);
            for accel in others {
                prop_assert_eq!(&hits(accel, &ray, f64::INFINITY), &(first, all.clone()), "{:?}", ray);
                prop_assert_eq!(&hits(accel, &ray, middle), &some, "{:?}", ray);
            }
            if let Some(hit) = brute.closest(&ray, f64::INFINITY) {
                let point = brute.surface_point(&ray, &hit).position;
                // Placements magnify the rounding of coordinates up to 20 by less than 1000.
                prop_assert!(point.distance(ray.at(hit.t)) < 1e-11, "{} {}", point, ray.at(hit.t));
            }
        }
    }
}

/// A tile of two triangles in the plane y = 0.
fn tile() -> Mesh {
    let [a, b, c, d] = [[0., 0., 0.], [0., 0., 1.], [1., 0., 1.], [1., 0., 0.]];
    soup(&[[a, b, c], [a, c, d]])
}

/// Ten thousand placements lie in rows of a hundred. A ray down onto each finds that one, at its own
/// distance. The structures take the memory of one mesh and some for each placement.
#[test]
fn each_of_ten_thousand_placements_is_where_it_was_put() {
    const SIDE: usize = 100;
    let shared = SharedMesh::new(tile());
    let place = |k: usize| DVec3::new((k % SIDE) as f64, (k % 7) as f64, (k / SIDE) as f64);
    let shapes: Vec<Shape> = (0..SIDE * SIDE)
        .map(|k| {
            let at = Placement::new(DAffine3::from_translation(2.0 * place(k))).unwrap();
            Shape::Instance(Instance::new(Arc::clone(&shared), at))
        })
        .collect();
    let tree = Accel::build(shapes.iter().collect(), Structure::Bvh);
    for k in 0..SIDE * SIDE {
        let above = 2.0 * place(k) + DVec3::new(0.75, 0.0, 0.25);
        let eye = DVec3::new(above.x, 20.0, above.z);
        let hit = tree.closest(&Ray::from_eye(eye, DVec3::NEG_Y), f64::INFINITY).unwrap();
        assert_eq!(hit.piece, Piece { object: k as u32, triangle: 1 });
        assert_eq!(hit.t, 20.0 - above.y);
        let between = eye + DVec3::new(0.75, 0.0, 0.0);
        assert!(tree.closest(&Ray::from_eye(between, DVec3::NEG_Y), f64::INFINITY).is_none());
    }
    let one = Accel::build(vec![&shapes[0]], Structure::Bvh).bytes();
    assert!(tree.bytes() < one + SIDE * SIDE * 160, "{} bytes", tree.bytes());
}

/// A hundred placements of a mesh of 69,000 triangles take at most 1.2 times the memory of one placement,
/// and no more work to build than one and a little for each.
#[test]
fn a_hundred_placements_take_hardly_more_than_one() {
    let side = 186u32;
    let at = |x: u32, z: u32| {
        let height = (f64::from(x) * 0.1).sin() * (f64::from(z) * 0.07).cos();
        [x as f32, height as f32, z as f32]
    };
    let corners: Vec<[[f32; 3]; 3]> = (0..side * side)
        .flat_map(|k| {
            let (x, z) = (k % side, k / side);
            let [a, b, c, d] = [at(x, z), at(x, z + 1), at(x + 1, z + 1), at(x + 1, z)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    let shared = SharedMesh::new(soup(&corners));
    let shapes: Vec<Shape> = (0..100)
        .map(|k| {
            let turn = DAffine3::from_rotation_y(0.1 * f64::from(k));
            let at = DAffine3::from_translation(200.0 * DVec3::new(f64::from(k), 0.0, 0.0)) * turn;
            Shape::Instance(Instance::new(Arc::clone(&shared), Placement::new(at).unwrap()))
        })
        .collect();
    let one = Accel::build(vec![&shapes[0]], Structure::Bvh);
    let all = Accel::build(shapes.iter().collect(), Structure::Bvh);
    let mesh =
        shared.mesh().positions.len() * 12 + shared.mesh().triangles.len() * size_of::<Triangle>();
    let (one_bytes, all_bytes) = (mesh + one.bytes(), mesh + all.bytes() + size_of_val(&*shapes));
    assert!(all_bytes as f64 <= 1.2 * one_bytes as f64, "{all_bytes} and {one_bytes} bytes");
    assert!(all.looks() < one.looks() + 100 * 100, "{} and {}", all.looks(), one.looks());
}

const FOREST: &str = r#"{ "format": "tb-scene", "version": 1, "ambient": 1,
"camera": { "eye": [0, 0, 10], "target": [0, 0, 0], "fov_deg": 60 },
"materials": { "bark": {} },
"objects": [ { "mesh": { "name": "tree", "file": "tree.obj", "material": "bark",
  "place": [ { "scale": [2, 2, 2] } ],
  "instances": [ [ { "translate": [-2, 0, 0] } ], [], [ { "translate": [2, 0, 0] } ] ] } } ] }"#;

const TREE: &str = "v -0.5 0 0\nv 0.5 0 0\nv 0 1 0\nf 1 2 3\n";

fn forest(text: &str) -> Bench {
    let bench = Bench::with_scene(text);
    bench.write("tree.obj", TREE);
    bench
}

#[test]
fn reports_name_the_placement() {
    let (code, _) =
        ending(&forest(FOREST).run(&["scene.json", "-o", "a.png", "--size", "24x24"], b""));
    assert_eq!(code, Some(0));
    let run = forest(FOREST).run(&["--check", "scene.json"], b"");
    let said = String::from_utf8(run.stdout).unwrap();
    let expected = [
        "objects[0].mesh.instances[0]: mesh tree, 1 triangle, open along 3 edges, material bark, \
         from (-3, 0, 0) to (-1, 2, 0), 2 x 2 x 0",
        "objects[0].mesh.instances[1] to objects[0].mesh.instances[2]: the same mesh, \
         from (-1, 0, 0) to (3, 2, 0), 4 x 2 x 0",
    ];
    assert!(expected.iter().all(|line| said.lines().any(|said| said == *line)), "{said}");
    let run = forest(FOREST).run(&["scene.json", "--size", "24x24", "--pixel", "16,10"], b"");
    let said = String::from_utf8(run.stdout).unwrap();
    assert!(said.contains("object 2, mesh \"tree\", placement 2, triangle 0"), "{said}");
}

#[test]
fn faulty_placements_are_named() {
    for (from, to, expected) in [
        (
            r#"[ [ { "translate": [-2, 0, 0] } ], [], [ { "translate": [2, 0, 0] } ] ]"#,
            "[]",
            "objects[0].mesh.instances: found no placement, expected at least one",
        ),
        (
            r#"{ "translate": [2, 0, 0] }"#,
            r#"{ "scale": [1, 0, 1] }"#,
            "objects[0].mesh.instances[2][0].scale[1]: found 0",
        ),
        (
            r#"{ "translate": [2, 0, 0] }"#,
            r#"{ "scale": [1e9, 1, 1] }"#,
            "objects[0].mesh.instances[2]: found a transform that flattens",
        ),
    ] {
        assert!(FOREST.contains(from));
        forest(&FOREST.replacen(from, to, 1)).refuse(
            &["scene.json"],
            b"",
            3,
            &["scene.json:", expected],
        );
    }
}

/// A scene of instances has the colours of its pixels in all structures.
#[test]
fn pictures_of_instances_do_not_depend_on_the_structure() {
    let bench = forest(FOREST);
    let make = |structure: &str| {
        let name = format!("{structure}.png");
        bench.make(&["scene.json", "-o", &name, "--size", "40x30", "--accel", structure], b"");
        bench.read(&name)
    };
    let tree = make("bvh");
    assert!(make("grid") == tree && make("none") == tree);
    let picture = image::load_from_memory(&tree).unwrap().into_rgb8();
    assert!(picture.pixels().any(|pixel| pixel.0 != [0; 3]));
}
