//! Tests of the structures without a hit function.

use super::build::Numbered;
use super::frame::{Frame, TreeRay};
use super::grid::Grids;
use super::kernel::Portable;
use super::node::Child;
use super::tree::{Leaves, Tree};
use super::*;
use crate::accel::slabs::SlabRay;
use crate::shape::Mesh;
use crate::shape::Sphere;
use crate::shape::mesh::{NONE, Triangle};
use proptest::prelude::*;
use std::ops::Range;

#[test]
fn an_empty_scene_has_no_hits() {
    let ray = Ray::from_eye(DVec3::ZERO, DVec3::X);
    for structure in [Structure::Bvh, Structure::Grid, Structure::None] {
        assert!(Accel::build(vec![], structure).closest(&ray, f64::INFINITY).is_none());
    }
}

/// Counts how often a ray gets each box.
struct Count<'a> {
    order: &'a [Numbered],
    leaves: &'a [Range<usize>],
    given: &'a mut [i32],
}

impl Leaves for Count<'_> {
    #[inline(always)]
    fn visit<K: Kernel>(&mut self, _: K, leaf: Child, _: &TreeRay, _: f32, t_max: f64) -> f64 {
        for one in &self.order[self.leaves[leaf.number()].clone()] {
            self.given[one.number() as usize] += 1;
        }
        t_max
    }
}

/// The walk of one ray through a tree.
struct Tested<'a> {
    tree: &'a Tree,
    ray: &'a Ray,
    t_max: f64,
    count: Count<'a>,
}

impl Task for Tested<'_> {
    type Out = ();

    #[inline(always)]
    fn run<K: Kernel>(&mut self, kernel: K) {
        self.tree.walk(kernel, (self.ray, 2.0), self.t_max, &mut self.count);
    }
}

fn place() -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-4i8..=4).prop_map(|p| DVec3::from(p.map(|k| f64::from(k) * 0.25)))
}

proptest! {
    /// Rays that are traced together find the hits that each finds alone.
    #[test]
    fn a_slice_of_rays_is_traced_as_one_by_one(
        centers in prop::collection::vec(place(), 1..20),
        rays in prop::collection::vec((place(), place(), any::<bool>()), 0..20),
    ) {
        let ball = |center| Shape::Sphere(Sphere { center, radius: 0.2 });
        let balls: Vec<Shape> = centers.into_iter().map(ball).collect();
        let accel = Accel::build(balls.iter().collect(), Structure::Bvh);
        let rays: Vec<(Ray, f64)> = rays.into_iter().map(|(eye, toward, near)| {
            let direction = (toward - eye).normalize_or(DVec3::X);
            (Ray::from_eye(eye, direction), if near { 0.75 } else { f64::INFINITY })
        }).collect();
        let bits = |hit: Hit| (hit.t.to_bits(), hit.piece);
        let mut hits = vec![None; rays.len()];
        accel.closest_of(&rays, &mut hits);
        let mut met = vec![false; rays.len()];
        let odd = |hit: &Hit| hit.piece.object % 2 == 1;
        accel.any_of(&rays, |_, hit| odd(&hit), &mut met);
        for (k, (ray, t_max)) in rays.iter().enumerate() {
            prop_assert_eq!(hits[k].map(bits), accel.closest(ray, *t_max).map(bits));
            prop_assert_eq!(met[k], accel.any(ray, *t_max, |hit| odd(&hit)));
        }
    }

    /// Every structure visits the boxes that a ray crosses before `t_max`, and no box twice.
    /// The test calls no hit function.
    #[test]
    fn every_box_that_a_ray_crosses_is_given_once(
        boxes in prop::collection::vec((place(), place()), 1..200),
        origin in place(), toward in place(), near in any::<bool>(),
        nudge in prop::sample::select(vec![0.0, 1e-16, -1e-16, 1e-9]),
        in_leaf in 1usize..=4, portable in any::<bool>(),
    ) {
        let boxes: Vec<_> = boxes.into_iter().map(|(a, b)| {
            // Many small boxes, some of them flat.
            let b = a + 0.25 * (b - a);
            [a.min(b), a.max(b)]
        }).collect();
        let t_max = if near { 0.75 } else { f64::INFINITY };
        let direction = (toward - origin + nudge).normalize_or(DVec3::NEG_X);
        let ray = SlabRay::new(origin, direction, 2.0);
        let crossed = |piece: &[DVec3; 2]| ray.crosses(*piece).is_some_and(|at| at[0] <= t_max);
        let half = boxes.len() as u32 / 2;
        let ranges = [0..half, half..boxes.len() as u32];
        let [mut by_tree, mut by_grids] = [vec![0; boxes.len()], vec![0; boxes.len()]];
        let whole = boxes.iter().copied().reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]).unwrap();
        let frame = Frame::around(whole);
        let numbered = |(k, &bounds): (usize, &[DVec3; 2])| {
            let [low, high] = frame.box_around(bounds);
            Numbered::new(k as u32, low, high)
        };
        let mut order: Vec<Numbered> = boxes.iter().enumerate().map(numbered).collect();
        let (tree, leaves) = Tree::build(whole, frame, &mut order, in_leaf);
        let count = Count { order: &order, leaves: &leaves, given: &mut by_tree };
        if portable {
            Tested { tree: &tree, ray: &Ray::from_eye(origin, direction), t_max, count }.run(Portable);
        } else {
            Instructions::detect().run(&mut Tested { tree: &tree, ray: &Ray::from_eye(origin, direction), t_max, count });
        }
        let objects: Vec<_> = ranges.into_iter().filter(|range| !range.is_empty()).collect();
        Grids::build(&boxes, &objects).walk(&ray, t_max, |piece, t_max| {
            by_grids[piece as usize] += 1;
            t_max
        });
        for (k, piece) in boxes.iter().enumerate() {
            for given in [&by_tree, &by_grids] {
                prop_assert!(given[k] <= 1, "box {} was given {} times", k, given[k]);
                prop_assert!(given[k] == 1 || !crossed(piece), "box {} was missed", k);
            }
        }
    }
}

/// A soup of triangles: small ones, needles, flat ones, and those that share corners.
fn soup() -> impl Strategy<Value = Vec<[[f32; 3]; 3]>> {
    let corner = prop::array::uniform3(prop_oneof![
        (-8i8..=8).prop_map(|k| f32::from(k) * 0.125),
        -1.0..1.0f32,
        Just(1e-30f32),
    ]);
    let near =
        (corner.clone(), prop::array::uniform3(-0.1..0.1f32), 0usize..3).prop_map(|(a, d, k)| {
            let mut c = a;
            c[k] += 0.125;
            [a, [a[0] + d[0], a[1] + d[1], a[2] + d[2]], c]
        });
    prop::collection::vec(prop_oneof![prop::array::uniform3(corner), near], 1..60)
}

fn mesh(triangles: &[[[f32; 3]; 3]], size: f32, shift: [f32; 3]) -> Mesh {
    let moved = |p: &[f32; 3]| [0, 1, 2].map(|axis| size * p[axis] + shift[axis]);
    let triangle = |k: u32| Triangle {
        position: [3 * k, 3 * k + 1, 3 * k + 2],
        uv: [NONE; 3],
        normal: [NONE; 3],
        surface: 0,
    };
    Mesh {
        positions: triangles.iter().flatten().map(moved).collect(),
        triangles: (0..triangles.len() as u32).map(triangle).collect(),
        surfaces: vec![String::new()],
        ..Mesh::default()
    }
}

proptest! {
    /// The vector instructions, the portable ones and brute force find the same hits, to the last
    /// bit, for meshes of any size, near and far from the origin.
    #[test]
    fn every_kernel_finds_the_hits_of_brute_force(
        triangles in soup(),
        size in prop::sample::select(vec![1.0f32, 1e-20, 1e-38, 1e20, 3.0]),
        shift in prop::sample::select(vec![[0.0f32; 3], [300.0, -200.0, 0.0], [0.0, 0.0, 1e6]]),
        rays in prop::collection::vec((place(), 0usize..60, 0usize..3, any::<bool>(), -1.0..1.0f64), 1..20),
    ) {
        let shift = shift.map(|x| if size == 3.0 || size == 1.0 { x } else { 0.0 });
        let mesh = mesh(&triangles, size, shift);
        let corners: Vec<[[f32; 3]; 3]> =
            (0..triangles.len() as u32).map(|k| mesh.corners(k)).collect();
        let shape = Shape::Mesh(mesh);
        let mut tree = Accel::build(vec![&shape], Structure::Bvh);
        let brute = Accel::build(vec![&shape], Structure::None);
        for (eye, triangle, corner, leaving, part) in rays {
            let [a, b, c] = corners[triangle % corners.len()].map(|p| DVec3::from(p.map(f64::from)));
            let target = [a, a + part.abs() * (b - a), (a + b + c) / 3.0][corner];
            let far = f64::from(size) * eye + DVec3::from(shift.map(f64::from));
            let start = if leaving { (a + b + c) / 3.0 } else { far };
            let toward = if leaving { far - start } else { target - start };
            let direction = toward.normalize_or(DVec3::X);
            let piece = Piece { object: 0, triangle: (triangle % corners.len()) as u32 };
            let ray = if leaving { Ray::leaving(piece, start, direction) } else { Ray::from_eye(start, direction) };
            let bits = |hit: Hit| (hit.t.to_bits(), hit.piece, hit.barycentric.map(f64::to_bits));
            let expected = brute.closest(&ray, f64::INFINITY).map(bits);
            let all = |accel: &Accel<'_>, t_max: f64| {
                let mut hits = Vec::new();
                accel.any(&ray, t_max, |hit| { hits.push(bits(hit)); false });
                hits.sort_unstable();
                hits
            };
            let middle = 0.75 * toward.length();
            for instructions in [Instructions::Portable, Instructions::detect()] {
                tree.instructions = instructions;
                prop_assert_eq!(tree.closest(&ray, f64::INFINITY).map(bits), expected);
                prop_assert_eq!(all(&tree, middle), all(&brute, middle));
            }
            // A group of rays to the points of a triangle.
            let group: Vec<(Ray, f64)> = (0..40).map(|k| {
                let [u, v] = [k % 8, k / 8].map(|k| f64::from(k) * 0.125);
                let toward = a + u * (b - a) + v * (1.0 - u) * (c - a) - start;
                (Ray { direction: toward.normalize_or(DVec3::X), ..ray }, f64::INFINITY)
            }).collect();
            for instructions in [Instructions::Portable, Instructions::detect()] {
                tree.instructions = instructions;
                let mut hits = vec![None; group.len()];
                tree.closest_of(&group, &mut hits);
                for ((ray, t_max), hit) in group.iter().zip(hits) {
                    prop_assert_eq!(hit.map(bits), brute.closest(ray, *t_max).map(bits));
                }
            }
        }
    }
}

/// A tree of more boxes than one thread divides alone does not depend on the number of threads.
#[test]
fn the_tree_is_the_same_for_any_number_of_threads() {
    let corner = |k: usize, step: f64| {
        let part = |golden: f64| ((k as f64 + step) * golden).fract() as f32;
        [part(0.618_034), part(0.754_877), part(0.569_84)]
    };
    let triangles: Vec<_> =
        (0..40_000).map(|k| [corner(k, 0.0), corner(k, 0.01), corner(k, 0.02)]).collect();
    let shape = Shape::Mesh(mesh(&triangles, 1.0, [0.0; 3]));
    let built = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let accel = Accel::build(vec![&shape], Structure::Bvh);
            format!("{:?}", accel.index)
        })
    };
    let one = built(1);
    assert!([2, 3].into_iter().all(|threads| built(threads) == one));
}
