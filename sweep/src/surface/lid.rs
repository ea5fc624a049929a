//! Triangles that fill an outline with holes, without other points than those of the outline.
//!
//! The triangles are a constrained Delaunay triangulation (crate spade), of which those inside the outline are kept.
//! An outline of many points on a straight line would give triangles without area along that line. So the points of a
//! straight run are moved inward by a hundred thousandth of its length before they are connected: from inside, the run
//! is then a hollow, and no triangle has all its corners on it.

use glam::DVec2;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use std::collections::HashMap;

/// Points of a straight run are moved inward by up to this fraction of its length. A larger number could move them
/// into another loop, and with a smaller one rounding would decide.
const HOLLOW: f64 = 1e-5;

/// A chain that turns by less than this at a point, in radians, is straight there.
const STRAIGHT: f64 = 1e-5;

/// Returns triangles that fill the area between closed loops, counter-clockwise. Corners count the points of all loops
/// one after another. `None` if loops cross themselves or each other.
#[must_use]
pub fn filled(loops: &[Vec<DVec2>]) -> Option<Vec<[u32; 3]>> {
    let mut numbers: HashMap<[u64; 2], usize> = HashMap::new();
    let (mut points, mut names): (Vec<Point2<f64>>, Vec<u32>) = (Vec::new(), Vec::new());
    let mut sides: Vec<[usize; 2]> = Vec::new();
    let mut first = 0;
    for own in loops {
        // Both columns of a crease are one point.
        let mut chain: Vec<(u32, DVec2)> = Vec::with_capacity(own.len());
        for (i, &point) in own.iter().enumerate() {
            if chain.last().is_none_or(|last| last.1 != point) {
                chain.push((first + i as u32, point));
            }
        }
        while chain.len() > 1 && chain[0].1 == chain[chain.len() - 1].1 {
            chain.pop();
        }
        let hollow = hollowed(&chain.iter().map(|one| one.1).collect::<Vec<_>>());
        let ids: Vec<usize> = chain
            .iter()
            .zip(hollow)
            .map(|(&(name, _), p)| {
                *numbers.entry([(p.x + 0.0).to_bits(), (p.y + 0.0).to_bits()]).or_insert_with(
                    || {
                        points.push(Point2::new(p.x, p.y));
                        names.push(name);
                        points.len() - 1
                    },
                )
            })
            .collect();
        sides.extend((0..ids.len()).map(|i| [ids[i], ids[(i + 1) % ids.len()]]));
        first += own.len() as u32;
    }
    let count = points.len();
    let mut crossed = false;
    let mesh = ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(
        points,
        sides.clone(),
        |_| crossed = true,
    )
    .ok()?;
    if crossed || mesh.num_vertices() != count {
        return None;
    }
    // Inside are the faces that a path from outside enters over an odd number of sides.
    let mut inside: Vec<Option<bool>> = vec![None; mesh.num_all_faces()];
    inside[mesh.outer_face().fix().index()] = Some(false);
    let mut open = vec![mesh.outer_face().fix()];
    let of_edges = |face: spade::handles::FixedFaceHandle<spade::handles::PossiblyOuterTag>| {
        let handle = mesh.face(face);
        match handle.as_inner() {
            Some(face) => face.adjacent_edges().to_vec(),
            None => mesh.convex_hull().collect(),
        }
    };
    while let Some(face) = open.pop() {
        let here = inside[face.index()] == Some(true);
        for edge in of_edges(face) {
            let next = edge.rev().face().fix();
            if inside[next.index()].is_none() {
                inside[next.index()] = Some(here != edge.as_undirected().is_constraint_edge());
                open.push(next);
            }
        }
    }
    let mut triangles: Vec<[u32; 3]> = mesh
        .inner_faces()
        .filter(|face| inside[face.fix().index()] == Some(true))
        .map(|face| face.vertices().map(|vertex| names[vertex.fix().index()]))
        .collect();
    triangles.iter_mut().for_each(|corners| {
        let least = (0..3).min_by_key(|&i| corners[i]).unwrap_or(0);
        corners.rotate_left(least);
    });
    triangles.sort_unstable();
    // Loops that touch along a side have no inside there.
    let filled = triangles.len() + 2 >= count.min(3);
    (filled && !triangles.is_empty()).then_some(triangles)
}

/// Moves the inner points of straight runs of a closed chain a little to the left.
fn hollowed(chain: &[DVec2]) -> Vec<DVec2> {
    let count = chain.len();
    let mut moved = chain.to_vec();
    let at = |i: usize| chain[i % count];
    let straight = |i: usize| {
        let (a, b) = (at(i + count - 1), at(i + 1));
        (at(i) - a).angle_to(b - at(i)).abs() < STRAIGHT
    };
    let Some(start) = (0..count).find(|&i| !straight(i)) else { return moved };
    let mut from = start;
    while from < start + count {
        let to = (from + 1..=start + count).find(|&i| i == start + count || !straight(i));
        let to = to.unwrap_or(start + count);
        let run = at(to) - at(from);
        // Parts of a run are measured by its length, so that the hollow is round.
        for i in from + 1..to {
            let part = (at(i) - at(from)).dot(run) / run.length_squared();
            moved[i % count] = at(i) + run.perp() * (4.0 * HOLLOW * part * (1.0 - part));
        }
        from = to;
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(loops: &[Vec<DVec2>], triangles: &[[u32; 3]]) -> f64 {
        let points = loops.concat();
        let twice = |[a, b, c]: &[u32; 3]| {
            let [a, b, c] = [a, b, c].map(|&corner| points[corner as usize]);
            (b - a).perp_dot(c - a)
        };
        triangles.iter().map(|corners| 0.5 * twice(corners)).sum()
    }

    fn square(half: f64, cells: i32, backward: bool) -> Vec<DVec2> {
        let corners = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].map(DVec2::from_array);
        let mut points: Vec<DVec2> = (0..4)
            .flat_map(|side| {
                let (a, b) = (corners[side] * half, corners[(side + 1) % 4] * half);
                (0..cells).map(move |i| a.lerp(b, f64::from(i) / f64::from(cells)))
            })
            .collect();
        if backward {
            points.reverse();
        }
        points
    }

    /// A triangulation of `n` points and `h` holes has `n + 2 h - 2` triangles if it uses every point.
    #[test]
    fn every_point_is_used_and_the_area_is_that_of_the_outline_without_its_holes() {
        for cells in [1, 2, 7, 40] {
            let outline = square(3.0, cells, false);
            let hole = square(1.0, cells, true);
            let one = filled(std::slice::from_ref(&outline)).unwrap();
            assert_eq!(one.len(), 4 * cells as usize - 2);
            assert!((area(std::slice::from_ref(&outline), &one) - 36.0).abs() < 1e-12);
            let loops = [outline, hole];
            let ring = filled(&loops).unwrap();
            assert_eq!(ring.len(), 8 * cells as usize);
            assert!((area(&loops, &ring) - 32.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_channel_is_filled_and_a_figure_of_eight_is_not() {
        let points =
            |all: &[[f64; 2]]| all.iter().map(|&p| DVec2::from_array(p)).collect::<Vec<_>>();
        let channel = points(&[
            [-3., 0.],
            [3., 0.],
            [3., 5.],
            [2., 5.],
            [2., 1.],
            [-2., 1.],
            [-2., 5.],
            [-3., 5.],
        ]);
        let triangles = filled(std::slice::from_ref(&channel)).unwrap();
        assert!((area(&[channel], &triangles) - 14.0).abs() < 1e-12 && triangles.len() == 6);
        assert_eq!(filled(&[points(&[[0., 0.], [2., 2.], [2., 0.], [0., 2.]])]), None);
    }
}
