//! Spreads of hits against differences between neighbouring rays.

use crate::exact;
use crate::studio;

use exact::dice::Dice;
use glam::{DVec2, DVec3};
use render::Scene;
use render::accel::{Accel, Structure};
use render::differential::Spread;
use render::ray::Piece;
use render::trace::tree::{Branch, Child, IntersectionTree, Node};
use render::trace::volume::Volumes;
use render::trace::{RayCounts, Tracer};
use studio::objects::{ball, mesh, plane, quad, sphere};
use studio::scene;

/// Size of the film, in pixels.
const SIZE: DVec2 = DVec2::new(32.0, 24.0);

/// Largest distance of the neighbours, in pixels, and the number of times that it is halved.
///
/// Differences over the smallest distance carry about 1e-12 of rounding. Extrapolation removes the
/// error of the largest one, unless the paths behind many bounces bend sharply.
const WIDEST: f64 = 0.02;
const HALVINGS: usize = 5;

/// Relative error up to which a spread agrees with differences.
const AGREEMENT: f64 = 1e-6;

/// A difference counts as certain if its own relative error is estimated below this number.
const CERTAIN: f64 = 1e-7;

/// Smallest change to which errors are relative. A change of 0, such as that of the normal of a plane,
/// has only rounding in its differences. One pixel changes the direction of a ray by about 0.03.
const FLOOR: f64 = 0.01;

/// The numbers of a node whose changes a spread holds: position, texture coordinates, normal and
/// incident direction.
type Numbers = [f64; 11];

/// The ranges of these four in [`Numbers`].
const PARTS: [(&str, std::ops::Range<usize>); 4] =
    [("position", 0..3), ("uv", 3..5), ("normal", 5..8), ("incident", 8..11)];

fn numbers(position: DVec3, uv: DVec2, normal: DVec3, incident: DVec3) -> Numbers {
    let mut all = [0.0; 11];
    all[0..3].copy_from_slice(&position.to_array());
    all[3..5].copy_from_slice(&uv.to_array());
    all[5..8].copy_from_slice(&normal.to_array());
    all[8..11].copy_from_slice(&incident.to_array());
    all
}

/// A node of a path: its piece, its number of bounces, its numbers and its spread.
struct Bounce {
    piece: Option<Piece>,
    depth: u32,
    numbers: Numbers,
    spread: Spread,
}

/// Lists the nodes of a tree, each before its children. Ends of rays without a node have no piece.
fn bounces(tree: &IntersectionTree, branch: Branch, depth: u32, list: &mut Vec<Bounce>) {
    let Some(node) = tree.node(branch) else {
        let (numbers, spread) = ([0.0; 11], Spread::default());
        return list.push(Bounce { piece: None, depth, numbers, spread });
    };
    let Node { position, uv, normal, incident, .. } = *node;
    let numbers = numbers(position, uv, normal, incident);
    let spread = *tree.spread(branch).unwrap();
    list.push(Bounce { piece: Some(node.piece), depth, numbers, spread });
    for child in [Child::Reflected, Child::Refracted] {
        bounces(tree, node.child(child), depth + 1, list);
    }
}

/// Number of comparisons that were made, by the number of bounces before the node, and number of
/// nodes without certain differences.
#[derive(Debug, Default)]
pub struct Compared {
    by_depth: [usize; 16],
    pub uncertain: usize,
}

impl Compared {
    /// Returns the number of comparisons.
    pub fn certain(&self) -> usize {
        self.by_depth.iter().sum()
    }
}

/// Compares the spreads of `count` rays through random positions on the film with differences.
/// `step` is the side of the part of the film that a spread stands for, in pixels.
pub fn compare(scene: &Scene, step: f64, count: usize, seed: u64) -> Compared {
    let shapes = scene.objects.iter().map(|object| &object.shape).collect();
    let accel = Accel::build(shapes, Structure::Bvh);
    let volumes = Volumes::of(scene);
    let tracer = Tracer::new(scene, &accel, &volumes);
    let mut tree = IntersectionTree::default();
    let mut traced = |position: DVec2| {
        let ray = scene.camera.ray(position, SIZE);
        let differential = scene.camera.differential(position, SIZE, step);
        tracer.trace_spread(&ray, &differential, &mut tree, &mut RayCounts::default());
        let mut list = Vec::new();
        bounces(&tree, tree.root, 0, &mut list);
        list
    };
    let mut dice = Dice::new(seed);
    let mut compared = Compared::default();
    for _ in 0..count {
        let position = DVec2::new(dice.between(0.0, SIZE.x), dice.between(0.0, SIZE.y));
        let here = traced(position);
        for (k, axis) in [DVec2::X, DVec2::Y].into_iter().enumerate() {
            let rays: Vec<[Vec<Bounce>; 2]> = (0..=HALVINGS)
                .map(|n| WIDEST * 0.5f64.powi(n as i32))
                .map(|off| [position + off * axis, position - off * axis].map(&mut traced))
                .collect();
            let pieces = |path: &[Bounce]| path.iter().map(|at| at.piece).collect::<Vec<_>>();
            let own = pieces(&here);
            // Neighbours on other paths have no differences.
            if rays.iter().flatten().any(|path| pieces(path) != own) {
                continue;
            }
            for (n, bounce) in here.iter().enumerate().filter(|(_, at)| at.piece.is_some()) {
                let change = |pair: &[Vec<Bounce>; 2], i: usize| {
                    let all = pair[0][n].numbers[i] - pair[1][n].numbers[i];
                    // Texture coordinates may jump by a period of 1 between the neighbours. No
                    // texture here is so dense that they change by half a period.
                    if (3..5).contains(&i) { all - all.round() } else { all }
                };
                let differences = std::array::from_fn(|i| {
                    extrapolated(
                        rays.iter()
                            .zip(0..)
                            .map(|(pair, n)| change(pair, i) / (2.0 * WIDEST * 0.5f64.powi(n))),
                    )
                });
                check(bounce, k, step, &differences, &mut compared);
            }
        }
    }
    compared
}

/// Extrapolates central differences over steps that are halved each time to a step of 0, by
/// Richardson's method. Returns the derivative and an estimate of its error (Ridders 1982).
fn extrapolated(differences: impl Iterator<Item = f64>) -> [f64; 2] {
    let mut best = [f64::NAN, f64::INFINITY];
    let mut row: Vec<f64> = Vec::new();
    for difference in differences {
        let mut next = vec![difference];
        let mut factor = 1.0;
        for (k, &coarser) in row.iter().enumerate() {
            factor *= 4.0;
            let finer = next[k] + (next[k] - coarser) / (factor - 1.0);
            let error = (finer - next[k]).abs().max((finer - coarser).abs());
            if error <= best[1] {
                best = [finer, error];
            }
            next.push(finer);
        }
        row = next;
    }
    best
}

/// Checks one axis of the spread of a node.
fn check(bounce: &Bounce, k: usize, step: f64, found: &[[f64; 2]; 11], compared: &mut Compared) {
    let Spread { position, uv, normal, incident, .. } = bounce.spread;
    let spread = numbers(position[k], uv[k], normal[k], incident[k]).map(|x| x / step);
    for (name, part) in PARTS {
        let size =
            |of: &dyn Fn(usize) -> f64| part.clone().map(|i| of(i).powi(2)).sum::<f64>().sqrt();
        let scale = size(&|i| found[i][0]).max(FLOOR);
        let doubt = size(&|i| found[i][1]);
        if doubt.is_nan() || doubt > CERTAIN * scale {
            compared.uncertain += 1;
            continue;
        }
        let error = size(&|i| spread[i] - found[i][0]);
        assert!(
            error <= AGREEMENT * scale,
            "{name} of {:?} after {} bounces: {:?} and {:?}",
            bounce.piece,
            bounce.depth,
            &spread[part.clone()],
            &found[part]
        );
        compared.by_depth[bounce.depth as usize] += 1;
    }
}

/// Maps of placement: rotated, stretched unevenly, sheared and mirrored. The last is all at once.
pub const MAPS: [&str; 5] = [
    r#"{ "rotate_deg": { "axis": [1, 2, -0.5], "angle": 50 } }"#,
    r#"{ "scale": [1.3, 0.7, 1.1] }"#,
    r#"{ "matrix": [[1, 0.4, 0, 0], [0, 1, -0.3, 0], [0.2, 0, 1, 0]] }"#,
    r#"{ "scale": [1, -1, 1] }"#,
    r#"{ "matrix": [[-0.9, 0.3, 0.2, 0.1], [0.1, 1.1, -0.3, 0.05], [0.4, -0.2, 0.8, 0]] }"#,
];

/// Keys of a glass that mirrors and refracts.
const GLASS: &str = r#""glass": { "reflectivity": 1, "transparency": 1, "fresnel": true }"#;

/// Returns a scene of these objects in a room: a floor, a slanted wall behind and a large ball above, all
/// of them mirrors. The eye looks at the origin from 4 units away.
pub fn room(objects: &str, materials: &str, files: &[(&str, Vec<u8>)]) -> Scene {
    let floor = plane([0.0, -1.5, 0.0], [900.0, 0.0, 200.0], [300.0, 100.0, -900.0], "mirror");
    let wall = quad([-8.0, -6.0, -3.0], [16.0, 1.0, 0.0], [0.0, 16.0, -2.0], "mirror");
    let above = sphere([0.5, 6.0, 1.0], 2.5, "mirror");
    let keys = format!(
        r#""max_depth": 5, "min_weight": 0.01, "camera": {{ "eye": [0.4, 0.9, 4], "target": [0, 0, 0],
        "fov_deg": 40 }}, "materials": {{ {GLASS}, "mirror": {{ "reflectivity": 0.6 }} {materials} }},
        "objects": [{objects}, {floor}, {wall}, {above}]"#
    );
    scene(&keys, files)
}

/// Returns an object with this key and these steps of its placement.
pub fn placed(object: &str, map: &str) -> String {
    format!("{} , \"place\": [{map}] }} }}", object.trim_end_matches(['}', ' ']))
}

/// Compares the spreads in a room with an object, as it is and by each placement. Most differences must
/// be certain, and some of them lie behind three bounces.
fn compare_placed(object: &str, count: usize, files: &[(&str, Vec<u8>)]) {
    let placements = std::iter::once(object.to_string());
    let placements = placements.chain(MAPS.iter().map(|map| placed(object, map)));
    for (object, seed) in placements.zip(1..) {
        let compared = compare(&room(&object, "", files), 1.0, count, seed);
        assert_mostly_certain(&compared);
        assert!(compared.by_depth[3..].iter().sum::<usize>() > 100, "{compared:?}");
    }
}

fn assert_mostly_certain(compared: &Compared) {
    let certain = compared.certain();
    assert!(certain > 1000 && certain > 9 * compared.uncertain, "{compared:?}");
}

#[test]
fn spreads_of_a_sphere_agree_with_differences() {
    compare_placed(&sphere([0.1, 0.0, 0.0], 1.0, "glass"), 60, &[]);
}

#[test]
fn spreads_of_a_rectangle_agree_with_differences() {
    compare_placed(&quad([-1.2, -1.0, 0.0], [2.2, 0.1, 0.4], [0.2, 2.0, -0.6], "glass"), 200, &[]);
}

#[test]
fn spreads_of_a_box_agree_with_differences() {
    let cuboid =
        r#"{ "box": { "low": [-0.9, -0.7, -0.6], "high": [0.8, 0.9, 0.7], "material": "glass" } }"#;
    compare_placed(cuboid, 60, &[]);
}

#[test]
fn spreads_of_superquadrics_agree_with_differences() {
    for more in [
        r#""exponents": [1, 1]"#,
        r#""exponents": [0.5, 0.8]"#,
        r#""exponents": [1.4, 1.7]"#,
        r#""exponents": [1, 1], "ring": 2"#,
        r#""exponents": [0.6, 1.3], "ring": 1.7"#,
    ] {
        let radii = if more.contains("ring") { "[0.4, 0.5, 0.35]" } else { "[1.1, 0.8, 0.9]" };
        let object = format!(
            r#"{{ "superquadric": {{ "center": [0.1, 0, 0.1], "radii": {radii}, {more}, "material": "glass" }} }}"#
        );
        compare_placed(&object, 60, &[]);
    }
}

/// Returns a ball of triangles with interpolated normals and texture coordinates.
pub fn smooth_ball() -> Vec<u8> {
    let text = String::from_utf8(ball(DVec3::ZERO, 1.0, 12, 8, true)).unwrap();
    let line = |line: &str| -> String {
        let mut words = line.split(' ');
        let key = words.next().unwrap();
        let words: Vec<&str> = words.collect();
        match key {
            "v" => format!("{line}\nvt {} {}\n", words[0], words[2]),
            "f" => {
                let corner = |word: &&str| {
                    word.replace("//", &format!("/{}/", word.split('/').next().unwrap()))
                };
                format!("f {}\n", words.iter().map(corner).collect::<Vec<_>>().join(" "))
            }
            _ => format!("{line}\n"),
        }
    };
    text.lines().map(line).collect::<String>().into_bytes()
}

#[test]
fn spreads_of_a_smooth_mesh_agree_with_differences() {
    compare_placed(&mesh("glass"), 200, &[("m.obj", smooth_ball())]);
}

/// Water in glass in water. The ray bends at boundaries between two media and passes hidden
/// boundaries without a bend.
#[test]
fn spreads_through_nested_glass_agree_with_differences() {
    let objects = [
        sphere([0.0, 0.0, 0.0], 1.1, "glass"),
        sphere([0.2, 0.1, 0.1], 0.7, "water"),
        sphere([0.5, -0.2, 0.3], 0.5, "gem"),
        sphere([-0.8, 0.1, 0.3], 0.5, "water"),
    ];
    let materials = r#", "water": { "reflectivity": 1, "transparency": 1, "fresnel": true,
        "index_of_refraction": 1.33, "priority": 1 }, "gem": { "reflectivity": 1, "transparency": 1,
        "index_of_refraction": 2.4, "priority": 2 }"#;
    let compared = compare(&room(&objects.join(", "), materials, &[]), 1.0, 200, 5);
    assert_mostly_certain(&compared);
    assert!(compared.by_depth[4..].iter().sum::<usize>() > 100, "{compared:?}");
}

/// A box without mirrors reflects only at angles beyond the critical one. A node after two bounces
/// therefore lies behind such a reflection.
#[test]
fn spreads_after_total_internal_reflection_agree_with_differences() {
    let cuboid =
        r#"{ "box": { "low": [-0.9, -0.7, -0.6], "high": [0.8, 0.9, 0.7], "material": "clear" } }"#;
    for map in MAPS {
        let keys = format!(
            r#""max_depth": 5, "camera": {{ "eye": [0.4, 0.9, 4], "target": [0, 0, 0], "fov_deg": 40 }},
            "materials": {{ "clear": {{ "transparency": 1 }} }}, "objects": [{}]"#,
            placed(cuboid, map)
        );
        let compared = compare(&scene(&keys, &[]), 1.0, 200, 7);
        assert!(compared.by_depth[2..].iter().sum::<usize>() > 100, "{compared:?}");
        assert_eq!(compared.uncertain, 0);
    }
}
