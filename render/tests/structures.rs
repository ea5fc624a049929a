//! Tree, grids and brute force find the same hits, to the last bit: on rays through edges and
//! vertices and along the faces of voxels, and on needles and flat, tiny, huge and distant meshes.

use glam::{DVec2, DVec3};
use proptest::prelude::*;
use render::accel::{Accel, Structure};
use render::ray::{Piece, Ray};
use render::shape::mesh::{Mesh, NONE, Triangle};
use render::shape::{Quad, Shape, Sphere};
use std::f64::consts::{PI, TAU};

const STRUCTURES: [Structure; 3] = [Structure::None, Structure::Bvh, Structure::Grid];

/// Builds all structures; brute force is the first.
fn all_structures(shapes: &[Shape]) -> [Accel<'_>; 3] {
    STRUCTURES.map(|structure| Accel::build(shapes.iter().collect(), structure))
}

/// The bits of a hit.
type Exact = (u64, Piece, [u64; 2]);

fn nearest(accel: &Accel<'_>, ray: &Ray) -> Option<Exact> {
    accel
        .closest(ray, f64::INFINITY)
        .map(|hit| (hit.t.to_bits(), hit.piece, hit.barycentric.map(f64::to_bits)))
}

/// Returns all hits before `t_max`, sorted.
fn all_before(accel: &Accel<'_>, ray: &Ray, t_max: f64) -> Vec<Exact> {
    let mut hits = Vec::new();
    accel.any(ray, t_max, |hit| {
        hits.push((hit.t.to_bits(), hit.piece, hit.barycentric.map(f64::to_bits)));
        false
    });
    hits.sort_unstable();
    hits
}

/// Asserts that all structures find the same nearest hit, find every hit exactly once, and find the
/// same hits before a middle distance.
fn see_the_same(accels: &[Accel<'_>; 3], ray: &Ray) -> Result<(), TestCaseError> {
    let [brute, others @ ..] = accels;
    let first = nearest(brute, ray);
    let all = all_before(brute, ray, f64::INFINITY);
    let middle = all.get(all.len() / 2).map_or(1.0, |hit| f64::from_bits(hit.0));
    let some = all_before(brute, ray, middle);
    for (other, structure) in others.iter().zip(&STRUCTURES[1..]) {
        prop_assert_eq!(nearest(other, ray), first, "{:?}: {:?}", structure, ray);
        prop_assert_eq!(&all_before(other, ray, f64::INFINITY), &all, "{:?}: {:?}", structure, ray);
        prop_assert_eq!(&all_before(other, ray, middle), &some, "{:?}: {:?}", structure, ray);
    }
    Ok(())
}

fn mesh(positions: Vec<[f32; 3]>, triangles: &[[u32; 3]]) -> Mesh {
    let triangle =
        |&position: &[u32; 3]| Triangle { position, uv: [NONE; 3], normal: [NONE; 3], surface: 0 };
    let triangles = triangles.iter().map(triangle).collect();
    Mesh { positions, triangles, surfaces: vec![String::new()], ..Mesh::default() }
}

/// Returns a mesh of triangles that share no corners.
fn soup(corners: &[[[f32; 3]; 3]]) -> Mesh {
    let numbers: Vec<[u32; 3]> =
        (0..corners.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    mesh(corners.concat(), &numbers)
}

fn vector(v: [f32; 3]) -> DVec3 {
    DVec3::from(v.map(f64::from))
}

/// Draws coordinates from a coarse lattice, which often coincide: shared corners, flat triangles,
/// and corners on the faces of voxels.
fn corner() -> impl Strategy<Value = [f32; 3]> {
    prop::array::uniform3((-4i8..=4).prop_map(|k| f32::from(k) * 0.25))
}

/// Draws a direction along an axis or a diagonal, with zeros of both signs.
fn lattice_direction() -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(prop::sample::select(vec![-1.0, -0.0, 0.0, 1.0, 0.5]))
        .prop_map(DVec3::from)
        .prop_filter("a direction", |v| v.length() > 0.0)
        .prop_map(DVec3::normalize)
}

/// Draws the size and the position of a scene.
fn place() -> impl Strategy<Value = (f32, [f32; 3])> {
    let far = [1e3, -7.0, 3e4];
    prop::sample::select(vec![
        (1.0, [0.0; 3]),
        (1e-6, [0.0; 3]),
        (1e6, [0.0; 3]),
        (1.0, far),
        (1e-6, [0.5, 0.0, -0.5]),
        (1e6, [1e9, 0.0, 1e7]),
    ])
}

proptest! {
    #[test]
    fn the_tree_and_the_grids_see_what_brute_force_sees(
        corners in prop::collection::vec(prop::array::uniform3(corner()), 1..80),
        eyes in prop::collection::vec((corner(), 0.0..2.0f64), 3),
        directions in prop::collection::vec(lattice_direction(), 3),
        targets in prop::collection::vec(corner(), 3),
        (scale, shift) in place(),
    ) {
        let put = |corner: [f32; 3]| [0, 1, 2].map(|k| scale * corner[k] + shift[k]);
        let corners: Vec<[[f32; 3]; 3]> = corners.into_iter().map(|c| c.map(put)).collect();
        let sphere = |x: f32| Shape::Sphere(Sphere {
            center: vector(put([x, x, 0.25])),
            radius: 0.3 * f64::from(scale),
        });
        let large = 1e3 * f64::from(scale);
        let floor = Quad::new(
            vector(put([0.0, -1.0, 0.0])) - large * (DVec3::X + DVec3::Z),
            DVec3::new(0.0, 0.0, 2.0 * large),
            DVec3::new(2.0 * large, 0.0, 0.0),
            DVec2::ONE,
            true,
        );
        let two = corners.len() / 2;
        let shapes = [
            Shape::Mesh(soup(&corners[two..])),
            Shape::Quad(floor.unwrap()),
            sphere(0.2),
            Shape::Mesh(soup(&corners[..two])),
            sphere(-0.4),
        ];
        let accels = all_structures(&shapes);
        for (eye, off) in eyes {
            // Some eyes are on the lattice, others anywhere, in front and inside.
            let off = if off < 1.0 { 0.0 } else { 3.0 * (off - 1.0) * f64::from(scale) };
            let eye = vector(put(eye)) + off * DVec3::new(0.1, 0.3, 1.0);
            let aimed = targets.iter().map(|&target| (vector(put(target)) - eye).normalize_or(DVec3::X));
            for direction in directions.iter().copied().chain(aimed) {
                let ray = Ray::from_eye(eye, direction);
                see_the_same(&accels, &ray)?;
                if let Some(hit) = accels[0].closest(&ray, f64::INFINITY) {
                    let point = accels[0].surface_point(&ray, &hit).position;
                    for &direction in &directions {
                        see_the_same(&accels, &Ray::leaving(hit.piece, point, direction))?;
                    }
                }
            }
        }
    }

    /// Triangles are a few units in the last place wide and seen along their edges. Their area as
    /// seen consists of rounding, and the hit function may find them anywhere on their line.
    #[test]
    fn needles_and_slivers_are_seen_alike(
        needles in prop::collection::vec((corner(), corner(), -1.0..2.0f32, 0u32..3, 0usize..3), 1..40),
        along in prop::collection::vec((0usize..40, -1.0..2.0f64, -2.0..3.0f64, 0usize..3), 8),
    ) {
        let corners: Vec<[[f32; 3]; 3]> = needles
            .iter()
            .map(|&(a, b, s, ulps, axis)| {
                let mut c = [0, 1, 2].map(|k| a[k] + s * (b[k] - a[k]));
                c[axis] = (0..ulps).fold(c[axis], |x, _| x.next_up());
                [a, b, c]
            })
            .collect();
        let shapes = [Shape::Mesh(soup(&corners))];
        let accels = all_structures(&shapes);
        for (k, from, to, tilt) in along {
            let [a, b, c] = corners[k % corners.len()].map(vector);
            let eye = a + from * (b - a);
            let mut target = c + to * (c - a);
            target[tilt] += 1e-16;
            for eye in [eye, eye - 0.5 * DVec3::ONE, eye + 1e-15] {
                let direction = (target - eye).normalize_or(DVec3::Y);
                see_the_same(&accels, &Ray::from_eye(eye, direction))?;
                see_the_same(&accels, &Ray::from_eye(eye, (b - a).normalize_or(DVec3::Z)))?;
            }
        }
    }
}

/// Returns the icosahedron, with each face cut into four `times` times, on the unit sphere.
fn icosphere(times: usize) -> Mesh {
    let g = (1.0 + 5f64.sqrt()) / 2.0;
    let mut points: Vec<DVec3> = [[0.0, 1.0, g], [0.0, 1.0, -g], [0.0, -1.0, g], [0.0, -1.0, -g]]
        .into_iter()
        .flat_map(|[x, y, z]| [[x, y, z], [z, x, y], [y, z, x]])
        .map(|p| DVec3::from(p).normalize())
        .collect();
    // The faces are the triples of nearest neighbours, with the outside up.
    let near = |a: u32, b: u32| points[a as usize].dot(points[b as usize]) > 0.4;
    let mut faces: Vec<[u32; 3]> = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in (b + 1..12).filter(|&c| near(a, b) && near(b, c) && near(a, c)) {
                let [p, q, r] = [a, b, c].map(|k| points[k as usize]);
                faces.push(if (q - p).cross(r - p).dot(p) > 0.0 { [a, b, c] } else { [a, c, b] });
            }
        }
    }
    for _ in 0..times {
        let mut middles = std::collections::BTreeMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                points.push((points[a as usize] + points[b as usize]).normalize());
                points.len() as u32 - 1
            })
        };
        let quarter = |&[a, b, c]: &[u32; 3]| {
            let [x, y, z] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, x, z], [x, b, y], [z, y, c], [x, y, z]]
        };
        faces = faces.iter().flat_map(quarter).collect();
    }
    mesh(points.iter().map(|p| p.to_array().map(|x| x as f32)).collect(), &faces)
}

/// Returns a torus about y: rings of radius `tube` whose middles lie on the unit circle.
fn torus(rows: u32, cols: u32, tube: f64) -> Mesh {
    let point = |row: u32, col: u32| {
        let (v, u) =
            (TAU * f64::from(row) / f64::from(rows), TAU * f64::from(col) / f64::from(cols));
        let (out, up) = (1.0 + tube * u.cos(), tube * u.sin());
        [out * v.cos(), up, out * v.sin()].map(|x| x as f32)
    };
    let places: Vec<(u32, u32)> = (0..rows).flat_map(|r| (0..cols).map(move |c| (r, c))).collect();
    let at = |r: u32, c: u32| (r % rows) * cols + c % cols;
    let faces: Vec<[u32; 3]> = places
        .iter()
        .flat_map(|&(r, c)| {
            let [a, b, d, e] = [at(r, c), at(r + 1, c), at(r, c + 1), at(r + 1, c + 1)];
            [[a, b, e], [a, e, d]]
        })
        .collect();
    mesh(places.iter().map(|&(r, c)| point(r, c)).collect(), &faces)
}

/// Returns a cube from -1 to 1 whose faces are cut into squares. Its faces lie in axis planes, and
/// its edges on lattice lines.
fn cube(cuts: u32) -> Mesh {
    let mut numbers = std::collections::BTreeMap::new();
    let mut positions = Vec::new();
    let mut number = |p: [u32; 3]| {
        *numbers.entry(p).or_insert_with(|| {
            positions.push(p.map(|k| -1.0 + 2.0 * k as f32 / cuts as f32));
            positions.len() as u32 - 1
        })
    };
    let mut faces = Vec::new();
    for axis in 0..3 {
        for (side, i, j) in [0, cuts]
            .into_iter()
            .flat_map(|side| (0..cuts).flat_map(move |i| (0..cuts).map(move |j| (side, i, j))))
        {
            let mut corner = |i: u32, j: u32| {
                let mut p = [side; 3];
                (p[(axis + 1) % 3], p[(axis + 2) % 3]) = (i, j);
                number(p)
            };
            let [a, b, c, d] =
                [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh(positions, &faces)
}

/// Returns every vertex and the middle of every edge.
fn targets(mesh: &Mesh) -> Vec<DVec3> {
    let corner = |k: u32| vector(mesh.positions[k as usize]);
    let edges = mesh.triangles.iter().flat_map(|triangle| {
        let [a, b, c] = triangle.position;
        [(a, b), (b, c), (c, a)]
    });
    let middles = edges.filter(|(a, b)| a < b).map(|(a, b)| 0.5 * (corner(a) + corner(b)));
    mesh.positions.iter().map(|&p| vector(p)).chain(middles).collect()
}

/// Rays run from inside closed meshes through every vertex and the middle of every edge. The edge
/// functions of neighbours are exact opposites and a zero counts for both, so that no ray gets out.
/// No structure loses a hit that brute force finds.
#[test]
fn no_ray_leaks_out_of_a_closed_mesh() {
    let off = DVec3::new(0.013, -0.2, 0.11);
    let ring = |angle: f64| DVec3::new(angle.cos(), 0.0, angle.sin());
    let round = vec![DVec3::ZERO, off, 0.5 * DVec3::X, DVec3::new(-0.0, 0.25, -0.0)];
    let cases = [
        ("icosahedron", icosphere(0), round.clone()),
        ("sphere", icosphere(2), round.clone()),
        ("cube", cube(4), round),
        ("torus", torus(24, 14, 0.4), vec![ring(0.0), ring(0.3) + 0.3 * off, ring(PI)]),
        ("thin torus", torus(90, 4, 1e-3), vec![ring(0.0), ring(TAU / 90.0)]),
    ];
    for (name, mesh, eyes) in cases {
        for (scale, shift) in [(1.0, 0.0), (1e-6, 0.0), (1e6, 0.0), (1.0, 300.0)] {
            let mut moved = mesh.clone();
            for p in &mut moved.positions {
                *p = p.map(|x| scale * x + shift);
            }
            let targets = targets(&moved);
            let shapes = [Shape::Mesh(moved)];
            let accels = all_structures(&shapes);
            let (mut rays, mut leaks) = (0, 0);
            for eye in &eyes {
                let eye = f64::from(scale) * *eye + f64::from(shift);
                for target in &targets {
                    let ray = Ray::from_eye(eye, (target - eye).normalize());
                    see_the_same(&accels, &ray).unwrap_or_else(|error| panic!("{name}: {error}"));
                    rays += 1;
                    leaks += usize::from(accels[0].closest(&ray, f64::INFINITY).is_none());
                }
            }
            assert_eq!(leaks, 0, "{name} times {scale} plus {shift}: of {rays} rays");
        }
    }
}

/// A plane mesh has no thickness, and its grid no third dimension.
#[test]
fn a_flat_mesh_is_seen_from_above_and_along() {
    for axis in 0..3 {
        let mut flat = torus(30, 12, 0.5);
        for p in &mut flat.positions {
            p[axis] = 0.25;
        }
        let shapes = [Shape::Mesh(flat)];
        let accels = all_structures(&shapes);
        for k in 0..200 {
            let angle = 0.1 * f64::from(k);
            let mut eye = DVec3::new(angle.sin(), (1.7 * angle).cos(), (0.3 * angle).sin());
            for (height, toward) in [(2.0, -1.0), (0.25, 0.0), (0.25, -0.0), (0.3, -1e-9)] {
                eye[axis] = height;
                let mut direction = DVec3::new(angle.cos(), angle.sin(), (2.0 * angle).cos());
                direction[axis] = toward;
                let ray = Ray::from_eye(eye, direction.normalize());
                see_the_same(&accels, &ray).unwrap_or_else(|error| panic!("{error}"));
            }
        }
    }
}

/// Eyes range from near to so far away that their own rounding is larger than the mesh.
#[test]
fn from_far_away_all_see_alike() {
    let shapes = [Shape::Mesh(torus(40, 24, 0.4))];
    let accels = all_structures(&shapes);
    let mut seen = 0;
    for power in 0..20 {
        let eye = 10f64.powi(power) * DVec3::new(2.0, 1.0, 3.0);
        for target in targets(&torus(7, 5, 0.4)) {
            let ray = Ray::from_eye(eye, (target - eye).normalize());
            see_the_same(&accels, &ray).unwrap_or_else(|error| panic!("{error}"));
            seen += usize::from(accels[0].closest(&ray, f64::INFINITY).is_some());
        }
    }
    assert!(seen > 100, "{seen}");
}

/// Corners and numbers of 1920 triangles take 44 bytes per triangle; the structure itself is small.
#[test]
fn a_structure_tells_its_memory() {
    let shapes = [Shape::Mesh(torus(40, 24, 0.4))];
    let [none, tree, grid] = all_structures(&shapes).map(|accel| accel.bytes());
    assert_eq!(none, 44 * 1920);
    for bytes in [tree, grid] {
        assert!(bytes > none + 8 * 1920 && bytes < none + 80 * 1920, "{bytes}");
    }
}

#[test]
fn a_thousand_coincident_triangles_are_one_hit_the_first() {
    let shapes = [Shape::Mesh(soup(&[[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]; 1000]))];
    let ray = Ray::from_eye(DVec3::new(0.2, 0.2, 1.0), DVec3::NEG_Z);
    for accel in all_structures(&shapes) {
        assert_eq!(
            accel.closest(&ray, f64::INFINITY).map(|hit| hit.piece),
            Some(Piece { object: 0, triangle: 0 })
        );
        assert_eq!(all_before(&accel, &ray, 2.0).len(), 1000);
    }
}
