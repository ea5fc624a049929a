//! Triangles of polygons that need not be convex.

use crate::shape::mesh::Triangle;
use glam::DVec3;

/// Replaces the fan of a polygon by triangles inside of it.
///
/// `fan` are the triangles that share the polygon's first corner, in order. `position` returns the place
/// of a vertex. A quadrangle is divided along a diagonal inside of it, if possible along the first. A
/// larger polygon is divided by cutting ears in the plane of its mean normal. The fan stays where there
/// is no such division, as for polygons without area and for most that cross themselves.
pub fn divide(fan: &mut [Triangle], position: impl Fn(u32) -> DVec3) {
    let Some(first) = fan.first() else { return };
    let mut ring = vec![Corner::of(first, 0)];
    ring.extend([Corner::of(first, 1), Corner::of(first, 2)]);
    ring.extend(fan[1..].iter().map(|triangle| Corner::of(triangle, 2)));
    let places: Vec<DVec3> = ring.iter().map(|corner| position(corner.position)).collect();
    let surface = first.surface;
    let parts = match places[..] {
        [a, b, c, d] => match inner_diagonal([a, b, c, d]) {
            Some(1) => vec![[0, 1, 3], [1, 2, 3]],
            _ => return,
        },
        _ if is_fan(&places) => return,
        _ => match ears(&places) {
            Some(parts) => parts,
            None => return,
        },
    };
    for (triangle, part) in fan.iter_mut().zip(parts) {
        *triangle = Corner::triangle(part.map(|k| ring[k]), surface);
    }
}

/// The indices of a corner.
#[derive(Debug, Clone, Copy)]
struct Corner {
    position: u32,
    uv: u32,
    normal: u32,
}

impl Corner {
    fn of(triangle: &Triangle, k: usize) -> Self {
        Self { position: triangle.position[k], uv: triangle.uv[k], normal: triangle.normal[k] }
    }

    fn triangle(corners: [Self; 3], surface: u32) -> Triangle {
        Triangle {
            position: corners.map(|corner| corner.position),
            uv: corners.map(|corner| corner.uv),
            normal: corners.map(|corner| corner.normal),
            surface,
        }
    }
}

fn cross(a: DVec3, b: DVec3, c: DVec3) -> DVec3 {
    (b - a).cross(c - a)
}

/// Returns the first corner of a diagonal of a quadrangle that lies inside: 0 or 1. Returns `None` if
/// neither does.
fn inner_diagonal([a, b, c, d]: [DVec3; 4]) -> Option<usize> {
    // The two triangles beside a diagonal turn in the same direction if it lies inside.
    if cross(a, b, c).dot(cross(a, c, d)) >= 0.0 {
        Some(0)
    } else if cross(b, c, d).dot(cross(b, d, a)) >= 0.0 {
        Some(1)
    } else {
        None
    }
}

/// Twice the area of a polygon, along its normal (Newell's method).
fn double_area(places: &[DVec3]) -> DVec3 {
    (2..places.len()).map(|k| cross(places[0], places[k - 1], places[k])).sum()
}

/// Returns whether all triangles of the fan turn as the polygon does.
fn is_fan(places: &[DVec3]) -> bool {
    let normal = double_area(places);
    (2..places.len()).all(|k| cross(places[0], places[k - 1], places[k]).dot(normal) >= 0.0)
}

/// Cuts ears. Returns two triangles less than there are corners, or `None` if that is not possible.
fn ears(places: &[DVec3]) -> Option<Vec<[usize; 3]>> {
    let normal = double_area(places).try_normalize()?;
    let (across, up) = normal.any_orthonormal_pair();
    let flat: Vec<[f64; 2]> =
        places.iter().map(|&at| [(at - places[0]).dot(across), (at - places[0]).dot(up)]).collect();
    let mut indices: Vec<usize> = Vec::new();
    earcut::Earcut::new().earcut(flat, &[], &mut indices);
    let mut parts: Vec<[usize; 3]> = indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
    let turns = |&[a, b, c]: &[usize; 3]| cross(places[a], places[b], places[c]).dot(normal);
    if parts.iter().map(turns).sum::<f64>() < 0.0 {
        parts.iter_mut().for_each(|part| part.swap(1, 2));
    }
    // Cutting leaves out corners on straight edges. Neighbouring faces end there, so they are put back.
    let count = places.len();
    let mut kept = vec![false; count];
    parts.iter().flatten().for_each(|&corner| kept[corner] = true);
    for corner in 0..count {
        if kept[corner] {
            continue;
        }
        let before = (1..count).map(|k| (corner + count - k) % count).find(|&k| kept[k])?;
        let after = (1..count).map(|k| (corner + k) % count).find(|&k| kept[k])?;
        let (number, side) = parts.iter().enumerate().find_map(|(number, part)| {
            let side = (0..3).find(|&k| part[k] == before && part[(k + 1) % 3] == after)?;
            Some((number, side))
        })?;
        let apex = parts[number][(side + 2) % 3];
        parts[number] = [before, corner, apex];
        parts.push([corner, after, apex]);
        kept[corner] = true;
    }
    (parts.len() + 2 == count).then_some(parts)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::mesh::NONE;
    use proptest::prelude::*;

    /// Divides a polygon whose corners are in order.
    fn divided(places: &[DVec3]) -> Vec<[u32; 3]> {
        let corner = |[a, b, c]: [u32; 3]| Triangle {
            position: [a, b, c],
            uv: [a, b, c],
            normal: [NONE; 3],
            surface: 7,
        };
        let mut fan: Vec<Triangle> =
            (2..places.len() as u32).map(|k| corner([0, k - 1, k])).collect();
        divide(&mut fan, |index| places[index as usize]);
        assert!(fan.iter().all(|t| t.uv == t.position && t.normal == [NONE; 3] && t.surface == 7));
        fan.iter().map(|triangle| triangle.position).collect()
    }

    fn area([a, b, c]: [u32; 3], places: &[DVec3]) -> DVec3 {
        cross(places[a as usize], places[b as usize], places[c as usize])
    }

    proptest! {
        /// A star with a hollow corner behind each tip: the triangles cover it once, whichever corner is
        /// first, in any plane and direction.
        #[test]
        fn triangles_cover_a_star_once(
            radii in prop::collection::vec((1.0..2.0f64, 0.2..0.9f64), 2..7), start in 0usize..20,
            reversed in any::<bool>(), normal in prop::array::uniform3(-1.0..1.0f64),
        ) {
            let normal = DVec3::from(normal);
            prop_assume!(normal.length() > 0.1);
            let (across, up) = normal.normalize().any_orthonormal_pair();
            let count = 2 * radii.len();
            let mut places: Vec<DVec3> = (0..count).map(|k| {
                let angle = k as f64 / count as f64 * std::f64::consts::TAU;
                let (tip, hollow) = radii[k / 2];
                let radius = if k % 2 == 0 { tip } else { hollow };
                5.0 * normal + radius * (angle.cos() * across + angle.sin() * up)
            }).collect();
            places.rotate_left(start % count);
            if reversed {
                places.reverse();
            }
            let parts = divided(&places);
            prop_assert_eq!(parts.len(), count - 2);
            let whole = double_area(&places);
            let sum: DVec3 = parts.iter().map(|&part| area(part, &places)).sum();
            prop_assert!(sum.abs_diff_eq(whole, 1e-12));
            for part in parts {
                prop_assert!(area(part, &places).dot(whole) >= -1e-12, "{part:?} is turned over");
            }
        }
    }

    /// An L with further corners on its straight edges, in any order of start.
    #[test]
    fn corners_on_straight_edges_are_kept() {
        let ring = [[0, 0], [2, 0], [4, 0], [4, 1], [2, 1], [1, 1], [1, 2], [1, 4], [0, 4], [0, 1]];
        for start in 0..ring.len() {
            let mut places = ring.map(|[x, y]| DVec3::new(f64::from(x), f64::from(y), 3.0));
            places.rotate_left(start);
            let parts = divided(&places);
            let sum: DVec3 = parts.iter().map(|&part| area(part, &places)).sum();
            assert_eq!(sum, 14.0 * DVec3::Z, "start {start}");
            let edges = |k: u32| {
                let next = (k + 1) % ring.len() as u32;
                let has =
                    |part: &&[u32; 3]| (0..3).any(|i| [part[i], part[(i + 1) % 3]] == [k, next]);
                parts.iter().filter(has).count()
            };
            assert!((0..ring.len() as u32).all(|k| edges(k) == 1), "start {start}: {parts:?}");
            assert!(parts.iter().all(|&part| area(part, &places).z >= 0.0), "start {start}");
        }
    }

    #[test]
    fn a_convex_quadrangle_keeps_its_first_diagonal() {
        let square = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]].map(DVec3::from);
        assert_eq!(divided(&square), [[0, 1, 2], [0, 2, 3]]);
    }

    #[test]
    fn polygons_without_area_keep_their_fan() {
        assert_eq!(divided(&[DVec3::ONE; 5]), [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
        let bow = [[0., 0., 0.], [1., 1., 0.], [1., 0., 0.], [0., 1., 0.]].map(DVec3::from);
        assert_eq!(divided(&bow).len(), 2);
    }
}
