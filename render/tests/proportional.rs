//! The work grows with the input and not with its square. Operations are counted at one size and at
//! twice that size, on inputs that are made to be hard.

use files::json::Document;
use files::{Embedded, FileError, Source};
use glam::{DVec2, DVec3};
use render::accel::{Accel, Structure};
use render::ray::Ray;
use render::scene::MeshSource;
use render::scene::check::coincident::{self, Coincidences};
use render::scene::check::subject::Subject;
use render::scene::read::{self, Draft};
use render::shape::mesh::{Mesh, NONE, Triangle};
use render::shape::{Quad, Shape};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// Largest ratio of the work at twice the size, with a margin for the logarithm of the size.
const TWICE: f64 = 2.4;

type Corners = [[f32; 3]; 3];

fn soup(corners: &[Corners]) -> Mesh {
    let triangles = (0..corners.len() as u32).map(|k| Triangle {
        position: [3 * k, 3 * k + 1, 3 * k + 2],
        uv: [NONE; 3],
        normal: [NONE; 3],
        surface: 0,
    });
    Mesh {
        positions: corners.concat(),
        triangles: triangles.collect(),
        surfaces: vec![String::new()],
        ..Mesh::default()
    }
}

/// A function that returns the corners of one of several triangles, from its number and their
/// count.
type Family = fn(usize, usize) -> Corners;

/// Families of hard triangles.
const HARD: [(&str, Family); 5] = [
    ("in one place", |_, _| [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.5]]),
    ("of one point", |_, _| [[0.5; 3]; 3]),
    ("long, thin and askew", |k, of| {
        let at = k as f32 / of as f32;
        let next = (k + 1) as f32 / of as f32;
        [[at, 0., 0.], [1. + at, 1., 1.], [1. + next, 1., 1.]]
    }),
    ("halving without end", |k, _| {
        let size = 0.5f32.powi((k % 120) as i32);
        [[size, 0., 0.], [size, size, 0.], [size, 0., size]]
    }),
    ("in a line", |k, of| {
        let at = k as f32 / of as f32;
        [[at, at, at], [at + 1., at + 1., at + 1.], [at + 2., at + 2., at + 2.]]
    }),
];

fn hard(make: fn(usize, usize) -> Corners, count: usize) -> Shape {
    Shape::Mesh(soup(&(0..count).map(|k| make(k, count)).collect::<Vec<_>>()))
}

#[test]
fn trees_and_grids_of_twice_the_triangles_take_twice_the_work() {
    for (name, make) in HARD {
        let cost = |count: usize, structure: Structure| {
            let shape = hard(make, count);
            let accel = Accel::build(vec![&shape], structure);
            (accel.looks() as f64, accel.bytes() as f64)
        };
        let [one, two] = [5000, 10_000].map(|count| cost(count, Structure::Bvh));
        assert!(two.0 <= TWICE * one.0, "tree of triangles {name}: {one:?} {two:?}");
        assert!(two.1 <= TWICE * one.1, "tree of triangles {name}: {one:?} {two:?}");
        // A grid has at most 64 entries for each triangle, and their number varies in steps with
        // the size.
        for count in [5000, 10_000] {
            let (looks, bytes) = cost(count, Structure::Grid);
            assert!(looks <= 150.0 * count as f64, "{count} triangles {name}: {looks}");
            assert!(bytes <= 400.0 * count as f64, "{count} triangles {name}: {bytes}");
        }
    }
}

#[test]
fn triangles_of_two_corners_are_in_no_structure() {
    let shape = hard(HARD[1].1, 1000);
    for structure in [Structure::Bvh, Structure::Grid, Structure::None] {
        assert_eq!(Accel::build(vec![&shape], structure).bytes(), 0);
    }
}

#[test]
fn quads_in_one_place_take_a_tree_of_twice_the_work() {
    let quad = Quad::new(DVec3::ZERO, DVec3::X, DVec3::Y, DVec2::ONE, true).unwrap();
    let [one, two] = [5000, 10_000].map(|count| {
        let shapes = vec![Shape::Quad(quad); count];
        Accel::build(shapes.iter().collect(), Structure::Bvh).looks() as f64
    });
    assert!(two <= TWICE * one, "{one} {two}");
}

#[test]
fn hard_triangles_are_hit_as_brute_force_hits_them() {
    for (name, make) in HARD {
        let shape = hard(make, 300);
        let [brute, tree, grid] = [Structure::None, Structure::Bvh, Structure::Grid]
            .map(|structure| Accel::build(vec![&shape], structure));
        for k in 0..500 {
            let part = |golden: f64| (f64::from(k) * golden).fract();
            let eye = DVec3::new(part(0.618_034), part(0.754_877), 3.0);
            let target = DVec3::new(part(0.569_84), part(0.819_17), part(0.671_04));
            let ray = Ray::from_eye(eye, (target - eye).normalize());
            let seen = |accel: &Accel<'_>| {
                accel
                    .closest(&ray, f64::INFINITY)
                    .map(|hit| (hit.t.to_bits(), hit.piece, hit.barycentric))
            };
            assert_eq!(seen(&tree), seen(&brute), "{name}");
            assert_eq!(seen(&grid), seen(&brute), "{name}");
        }
    }
}

/// A source that counts how often each file is read.
#[derive(Debug, Default)]
struct Counted {
    files: BTreeMap<PathBuf, String>,
    reads: Mutex<BTreeMap<PathBuf, usize>>,
}

impl Source for Counted {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileError> {
        *self.reads.lock().unwrap().entry(path.into()).or_default() += 1;
        self.files.get(path).map(|text| text.clone().into_bytes()).ok_or_else(|| FileError::Read {
            name: path.display().to_string(),
            source: std::io::ErrorKind::NotFound.into(),
        })
    }
}

const HEAD: &str = r#""format": "tb-scene", "version": 1,
    "camera": { "eye": [0, 0, 4], "target": [0, 0, 0], "fov_deg": 60 },"#;

/// Three folders: the part of each level includes the next level of all three folders.
#[test]
fn parts_that_include_each_other_crosswise_are_read_once_each() {
    const LEVELS: usize = 12;
    let mut source = Counted::default();
    let next = |level: usize| {
        ["a", "b", "c"].map(|other| format!("\"../{other}/{level}.json\"")).join(", ")
    };
    for level in 0..LEVELS {
        let include = if level + 1 < LEVELS { next(level + 1) } else { String::new() };
        for folder in ["a", "b", "c"] {
            let text =
                format!(r#"{{ "format": "tb-scene-part", "version": 1, "include": [{include}] }}"#);
            source.files.insert(format!("{folder}/{level}.json").into(), text);
        }
    }
    let text = format!("{{ {HEAD} \"include\": [{}], \"objects\": [] }}", next(0));
    let document = Document::new("s/scene.json", text.as_bytes()).unwrap();
    let file = read::parse(&document).unwrap();
    let draft = Draft::gather(&document, &file, Path::new("s"), &source).unwrap();
    assert_eq!(draft.texts().unwrap().len(), 3 * LEVELS + 1);
    let reads = source.reads.into_inner().unwrap();
    assert_eq!(reads.len(), 3 * LEVELS);
    assert!(reads.values().all(|&count| count == 1), "{reads:?}");
}

/// Returns the coincident surfaces that the check finds in a scene of these rectangles.
fn coincidences(rectangles: impl Iterator<Item = [f64; 4]>) -> Coincidences {
    let objects: Vec<String> = rectangles
        .map(|[x, y, width, height]| {
            format!(
                r#"{{ "rectangle": {{ "corner": [{x}, {y}, 0.1], "edge_u": [{width}, 0, 0],
                "edge_v": [0, {height}, 0], "material": "m" }} }}"#
            )
        })
        .collect();
    let text = format!(
        "{{ {HEAD} \"materials\": {{ \"m\": {{}} }}, \"objects\": [{}] }}",
        objects.join(",")
    );
    let document = Document::new("scene.json", text.as_bytes()).unwrap();
    let file = read::parse(&document).unwrap();
    let draft = Draft::gather(&document, &file, Path::new(""), &Embedded(&[])).unwrap();
    let scene = draft.resolve(&Embedded(&[]), MeshSource::new()).unwrap();
    let texts = draft.texts().unwrap();
    coincident::findings(&Subject::new(&draft, &texts, &scene, 1.0))
}

#[test]
fn surfaces_in_one_place_are_all_counted_the_first_named_and_the_work_is_in_proportion() {
    let equal = |count: usize| coincidences((0..count).map(|_| [0.0, 0.0, 1.0, 1.0]));
    let [one, two] = [1000, 2000].map(equal);
    assert_eq!((one.pairs, two.pairs), (1000 * 999 / 2, 2000 * 1999 / 2));
    assert!(two.looks as f64 <= TWICE * one.looks as f64, "{} {}", one.looks, two.looks);
    let said: Vec<String> = two.findings.iter().map(ToString::to_string).collect();
    assert_eq!(said.len(), 21);
    let first = "remark: objects[1].rectangle: the surface lies in the same plane as objects[0].rectangle (rectangle)";
    assert!(said[0].starts_with(first), "{}", said[0]);
    let others = format!("in {} more pairs", 2000 * 1999 / 2 - 20);
    assert!(said[20].contains(&others), "{}", said[20]);
    // Rectangles of a floor only touch each other.
    let floor = |side: usize| {
        coincidences((0..side * side).map(|k| [(k % side) as f64, (k / side) as f64, 1.0, 1.0]))
    };
    let [one, two] = [30, 42].map(floor);
    assert_eq!((one.pairs, two.pairs), (0, 0));
    assert!(two.looks as f64 <= TWICE * one.looks as f64, "{} {}", one.looks, two.looks);
}

#[test]
fn surfaces_nearly_in_one_place_are_counted_as_trying_all_counts_them() {
    // Cards on a table: each overlaps some of the others.
    let part = |k: usize, golden: f64| (k as f64 * golden).fract();
    let card =
        |k: usize| [part(k, 0.618_034), part(k, 0.754_877), 0.05 + 0.1 * part(k, 0.569_84), 0.1];
    let count = 300;
    let covers = |[x, y, w, h]: [f64; 4], [other_x, other_y, other_w, other_h]: [f64; 4]| {
        x < other_x + other_w && other_x < x + w && y < other_y + other_h && other_y < y + h
    };
    let pairs = (0..count)
        .flat_map(|i| (0..i).map(move |j| (i, j)))
        .filter(|&(i, j)| covers(card(i), card(j)))
        .count();
    assert!(pairs > 500, "{pairs}");
    assert_eq!(coincidences((0..count).map(card)).pairs, pairs as u64);
    // Thousands of surfaces coincide: the count states that it may be too low.
    let stack = |count: usize| coincidences((0..count).map(|k| [0.0, 0.0, 1.0 + k as f64, 1.0]));
    let [stack, twice] = [3000, 6000].map(stack);
    assert!(twice.looks as f64 <= TWICE * stack.looks as f64, "{} {}", stack.looks, twice.looks);
    let last = stack.findings.last().unwrap().to_string();
    assert!(last.contains("in at least "), "{last}");
}
