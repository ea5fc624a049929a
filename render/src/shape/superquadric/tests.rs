//! Compares superquadrics with the sphere, the box and brute force.

use super::*;
use crate::shape::{Cuboid, Sphere};
use glam::Vec3Swizzles;
use proptest::prelude::*;

const FREE: Start = Start { left_face: None, skin: 0.0 };

/// The start of a ray that leaves a shape of about unit size.
const LEAVING: Start = Start { left_face: Some(0), skin: 1e-13 };

fn shape(exponents: [f64; 2], ring: Option<f64>) -> Superquadric {
    Superquadric::new(DVec3::new(0.3, -0.2, 0.1), DVec3::new(1.0, 0.7, 1.6), exponents, ring)
        .unwrap()
}

fn unit(exponents: [f64; 2]) -> Superquadric {
    Superquadric::new(DVec3::ZERO, DVec3::ONE, exponents, None).unwrap()
}

/// Exponents of every kind: convex, pinched, mixed, and those at which the kind changes.
fn exponent() -> impl Strategy<Value = f64> {
    prop_oneof![0.05..2.0f64, 2.0..4.0f64, Just(0.05), Just(1.0), Just(2.0), Just(4.0)]
}

fn any_shape() -> impl Strategy<Value = Superquadric> {
    let ring = prop_oneof![3 => Just(None), 1 => (1.0..4.0f64).prop_map(Some)];
    (exponent(), exponent(), ring).prop_map(|(e1, e2, ring)| shape([e1, e2], ring))
}

/// Mostly generic points, sometimes on an axis or in a coordinate plane.
fn any_point(size: f64) -> impl Strategy<Value = DVec3> {
    let coordinate = move || prop_oneof![4 => -size..size, 1 => Just(0.0)];
    prop::array::uniform3(coordinate()).prop_map(DVec3::from)
}

fn value(shape: &Superquadric, point: DVec3) -> f64 {
    shape.field.value((point - shape.center) / shape.radii) - 1.0
}

/// Returns the distance of a point from the surface: to the nearest change of side along the six
/// directions of the axes and both directions of the gradient.
fn off(shape: &Superquadric, point: DVec3) -> f64 {
    let here = value(shape, point) > 0.0;
    let mut reach = 1e-16;
    let gradient = shape.surface_point(point).geometric_normal;
    while reach < 1.0 {
        let mut axes = DVec3::AXES.into_iter().chain([gradient]);
        let changes = |direction: DVec3| {
            [direction, -direction]
                .into_iter()
                .any(|direction| (value(shape, point + reach * direction) > 0.0) != here)
        };
        if axes.any(changes) {
            return reach;
        }
        reach *= 2.0;
    }
    reach
}

/// Compares a root with the sides at many points along the ray. All points before the root must be
/// on the side `outside`, and the root must lie on the surface.
fn check(
    shape: &Superquadric,
    from: DVec3,
    direction: DVec3,
    outside: bool,
    root: Option<f64>,
) -> Result<(), TestCaseError> {
    let end = root.unwrap_or(14.0);
    for k in 1..3000 {
        // The last rounding before the root is exempt.
        let t = end * f64::from(k) / 3000.0;
        let value = value(shape, from + t * direction);
        let agrees = (value > 0.0) == outside || value.abs() < 1e-11;
        prop_assert!(agrees, "side changes at {t} (value {value}) before {root:?}");
    }
    if let Some(t) = root {
        let off = off(shape, from + t * direction);
        prop_assert!(off < 1e-14, "the hit at {t} is {off} off the surface");
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// The hit lies on the surface, and no point before it is inside. Without a hit no point is
    /// inside.
    #[test]
    fn no_root_is_before_the_first(shape in any_shape(), from in any_point(6.0), to in any_point(1.5)) {
        prop_assume!((to - from).length() > 0.1 && value(&shape, from).abs() > 1e-6);
        let direction = (to - from).normalize();
        let root = shape.intersect(from, direction, FREE);
        check(&shape, from, direction, value(&shape, from) > 0.0, root)?;
    }

    /// A ray that leaves the surface finds the next point where it meets the surface, if any.
    #[test]
    fn a_ray_that_leaves_meets_the_next_root(shape in any_shape(), at in any_point(2.0), to in any_point(1.5)) {
        let start = shape.center + at;
        prop_assume!(at.length() > 0.1 && (shape.center + to - start).length() > 0.1);
        // The last point on the surface along a ray outward.
        let Some(t) = shape.intersect(start + 10.0 * at, -at.normalize(), FREE) else { return Ok(()) };
        let point = shape.surface_point(start + 10.0 * at - t * at.normalize());
        let direction = (shape.center + to - point.position).normalize();
        let cosine = direction.dot(point.geometric_normal);
        prop_assume!(cosine.abs() > 1e-3);
        let root = shape.intersect(point.position, direction, LEAVING);
        prop_assert!(root.is_none_or(|t| t > LEAVING.skin));
        // Creases have two normals, and the outward direction depends on the side.
        let off_crease = (point.position - shape.center).abs().min_element() > 1e-6;
        if off_crease {
            check(&shape, point.position, direction, cosine > 0.0, root)?;
        }
    }

    /// Both methods of finding a root agree where both apply.
    #[test]
    fn pieces_find_what_newton_proves(
        e1 in 0.05..2.0f64, e2 in 0.05..2.0f64, from in any_point(4.0), to in any_point(1.2),
    ) {
        prop_assume!((to - from).length() > 0.1);
        let shape = shape([e1, e2], None);
        let step = (to - from).normalize();
        let line = Line { field: shape.field, from, step };
        let Some([enter, leave]) = shape.within_box(&line) else { return Ok(()) };
        let newton = root::of_convex(&line, enter, leave, false);
        let pieces = root::first(&line, enter, leave, None);
        let close = match (newton, pieces) {
            // Near a tangent a rounding of the value moves the root by its square root, 1e-8.
            (Some(a), Some(b)) => (a - b).abs() < 1e-7 && (line.value(a) - line.value(b)).abs() < 1e-13,
            (a, b) => a == b,
        };
        prop_assert!(close, "{newton:?} {pieces:?}");
    }

    #[test]
    fn with_exponents_of_1_it_is_the_sphere(from in any_point(5.0), to in any_point(1.2)) {
        prop_assume!((to - from).length() > 0.1 && (from.length() - 1.0).abs() > 1e-3);
        let direction = (to - from).normalize();
        let sphere = Sphere { center: DVec3::ZERO, radius: 1.0 };
        let (ours, truth) = (unit([1.0; 2]).intersect(from, direction, FREE), sphere.intersect(from, direction, false, 0.0));
        let aside = from.cross(direction).length();
        // Where the ray touches the sphere, the hit has half the digits.
        prop_assume!((aside - 1.0).abs() > 1e-4);
        prop_assert_eq!(ours.is_some(), truth.is_some());
        if let (Some(ours), Some(truth)) = (ours, truth) {
            prop_assert!((ours - truth).abs() < 1e-12, "{ours} {truth}");
            let (ours, truth) = (unit([1.0; 2]).surface_point(from + ours * direction), sphere.surface_point(from + truth * direction));
            prop_assert!(ours.position.abs_diff_eq(truth.position, 1e-12));
            prop_assert!(ours.geometric_normal.abs_diff_eq(truth.geometric_normal, 1e-12));
            prop_assume!(truth.position.xz().length() > 1e-2);
            prop_assert!(ours.uv.abs_diff_eq(truth.uv, 1e-12), "{} {}", ours.uv, truth.uv);
        }
    }

    /// The surface lies between the box and the box shrunk until its corners touch the surface.
    #[test]
    fn with_small_exponents_it_is_nearly_a_box(from in any_point(5.0), to in any_point(0.9), e in 0.05..0.2f64) {
        let cuboid = |reach: f64| Cuboid::new(DVec3::splat(-reach), DVec3::splat(reach)).unwrap();
        prop_assume!(from.abs().max_element() > 1.0);
        let direction = (to - from).normalize();
        let hit = |reach: f64| cuboid(reach).intersect(from, direction, FREE).map_or(f64::INFINITY, |(t, _)| t);
        let t = unit([e; 2]).intersect(from, direction, FREE).unwrap_or(f64::INFINITY);
        let inner = 3f64.powf(-0.5 * e);
        prop_assert!(hit(1.0) - 1e-12 <= t && t <= hit(inner) + 1e-12, "{} {t} {}", hit(1.0), hit(inner));
    }

    #[test]
    fn normals_agree_with_differences(
        shape in any_shape(), toward in prop::array::uniform3(0.2..1.0f64), octant in 0u32..8,
    ) {
        // Away from creases and from the tips of stars, where the curvature is unbounded.
        let sign = |k: u32| if octant >> k & 1 == 0 { 1.0 } else { -1.0 };
        let direction = -DVec3::new(sign(0), sign(1), sign(2)) * DVec3::from(toward).normalize();
        let from = shape.center - 9.0 * direction + DVec3::new(0.0, 0.05, 0.0);
        let Some(t) = shape.intersect(from, direction, FREE) else { return Ok(()) };
        let point = shape.surface_point(from + t * direction);
        let own = ((point.position - shape.center) / shape.radii).abs();
        prop_assume!(own.min_element() > 0.05 && (shape.field.axis_norm(own) - shape.field.ring).abs() > 0.05);
        let step = 1e-6;
        let slope = |axis: DVec3| {
            let value = |s: f64| value(&shape, point.position + s * axis);
            (8.0 * (value(step) - value(-step)) - value(2.0 * step) + value(-2.0 * step)) / (12.0 * step)
        };
        let truth = DVec3::from(DVec3::AXES.map(slope)).normalize();
        // A rounding of 1e-15 over a step of 1e-6 gives 1e-9, and slopes of a section with a large
        // exponent magnify this error.
        prop_assert!(point.geometric_normal.abs_diff_eq(truth, 1e-6), "{} {truth}", point.geometric_normal);
        prop_assert!((point.geometric_normal.length() - 1.0).abs() < 1e-14);
    }
}

#[test]
fn a_ray_that_runs_along_a_straight_line_of_the_surface_ends_soon() {
    // A star with e1 of 2 consists of straight lines between its points, and an octahedron of
    // planes.
    for exponents in [[2.0, 4.0], [2.0, 2.0], [2.0, 0.7], [2.0, 2.5]] {
        let star = unit(exponents);
        let h = star.field.axis_norm(DVec3::new(0.6, 0.0, 0.3));
        let (foot, top) = (DVec3::new(0.6 / h, 0.0, 0.3 / h), DVec3::Y);
        let direction = (top - foot).normalize();
        for aside in [0.0, 1e-15, 1e-12, 1e-9, 1e-6] {
            for side in [DVec3::Y, DVec3::NEG_Y, DVec3::X] {
                let from = foot - direction + aside * side;
                // Any hit must be on the surface.
                if let Some(t) = star.intersect(from, direction, FREE) {
                    assert!(
                        value(&star, from + t * direction).abs() < 1e-14,
                        "{exponents:?} {aside}"
                    );
                }
            }
        }
    }
}

#[test]
fn rays_along_the_axes_hit_the_tips() {
    for e1 in [0.05, 0.3, 1.0, 2.0, 3.0, 4.0] {
        for e2 in [0.05, 0.3, 1.0, 2.0, 3.0, 4.0] {
            for axis in DVec3::AXES {
                let t = unit([e1, e2]).intersect(3.0 * axis, -axis, FREE);
                assert!(t.is_some_and(|t| (t - 2.0).abs() < 1e-15), "{e1} {e2} {axis}: {t:?}");
                let point = unit([e1, e2]).surface_point(axis);
                assert_eq!((point.position, point.geometric_normal), (axis, axis));
            }
        }
    }
}

#[test]
fn what_starts_near_a_crease_but_off_the_surface_is_not_on_it() {
    // The slope is unbounded here and does not give the distance to the surface.
    let star = unit([4.0, 4.0]);
    let from = DVec3::new(1e-300, 0.1, 0.5);
    let near = Start { left_face: None, skin: 1e-13 };
    assert_eq!(star.intersect(from, DVec3::NEG_Z, near), star.intersect(from, DVec3::NEG_Z, FREE));
    assert!(star.intersect(from, DVec3::NEG_Z, near).is_some());
    let tip = DVec3::new(1.0, 0.0, 0.0);
    assert_eq!(star.intersect(tip, DVec3::X, near), None);
}

#[test]
fn from_the_edge_of_a_fin_the_next_fin_is_seen() {
    // The slope at the edge is equal on both sides and implies that the ray leads inside. The fin
    // is thinner there than any ray.
    let fins = unit([1.0, 4.0]);
    let (edge, inside) = (DVec3::new(0.0, 0.6, 0.8), DVec3::new(0.5, 0.0, 0.0));
    let direction = (inside - edge).normalize();
    let t = fins.intersect(edge, direction, LEAVING).unwrap();
    let outside = |k: u32| value(&fins, edge + t * f64::from(k) / 100.0 * direction) > 0.0;
    assert!((1..100).all(outside) && t < edge.distance(inside), "{t}");
    assert!(off(&fins, edge + t * direction) < 1e-15);
}

#[test]
fn the_map_on_a_ring_is_not_mirrored() {
    let ring = Superquadric::new(DVec3::ZERO, DVec3::ONE, [0.8, 1.2], Some(2.5)).unwrap();
    let uv = |x: f64, y: f64| ring.surface_point(DVec3::new(x, y, 3.5)).uv;
    assert_eq!(uv(0.0, 0.0), DVec2::splat(0.5));
    assert!(uv(0.1, 0.0).x > 0.5 && uv(0.0, 0.1).y > 0.5);
    assert_eq!((ring.seam(), unit([1.0; 2]).seam()), (DVec2::ONE, DVec2::X));
}

#[test]
fn other_numbers_are_refused() {
    let made = |radius: f64, e: f64, ring| {
        Superquadric::new(DVec3::ZERO, DVec3::splat(radius), [e, 1.0], ring).is_some()
    };
    assert!(made(1.0, 0.05, None) && made(1e-9, 4.0, Some(1.0)));
    assert!(!made(0.0, 1.0, None) && !made(f64::NAN, 1.0, None) && !made(1.0, f64::NAN, None));
    assert!(!made(1.0, 0.04, None) && !made(1.0, 4.1, None) && !made(1.0, 1.0, Some(0.9)));
}
