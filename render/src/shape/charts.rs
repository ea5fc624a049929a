//! Charts of the texture coordinates of a shape.
//!
//! Two texture coordinates can be compared if one leads to the other without a jump. This holds
//! within a chart: a connected piece of mesh whose triangles share positions and texture
//! coordinates. A mesh with several areas has a chart for each area, even if all areas show one
//! texture.
//!
//! A chart may close on itself, as around a tube. Its coordinates then jump by a whole number at a
//! seam, and differences are taken across the seam if this is shorter. Seams are found in the mesh,
//! for each chart separately. One area may go around with its picture once, another with four
//! pictures, and a third only halfway. An edge lies on a seam if two triangles of a chart share it
//! with coordinates that differ by the same whole number at both ends. A floor has no seam, however
//! often its picture repeats.

use super::SeamPeriod;
use super::mesh::{Mesh, NONE};
use super::weld::{self, Weld};
use glam::DVec2;
use std::collections::HashMap;
use std::sync::Arc;

/// Largest rounding of a file's texture coordinates, which have the precision of `f32` or six
/// digits.
const ROUNDING: f64 = 1e-4;

/// The charts of one shape.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Charts {
    /// Chart of each triangle; empty if there is only one chart.
    of_triangle: Arc<[u32]>,
    /// Seam of each chart.
    seams: Vec<Seam>,
}

/// The jump of a chart's texture coordinates where the chart closes on itself.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Seam {
    /// Size of the jump, across and up; 0 where the chart does not close.
    period: SeamPeriod,
    /// For each direction of closing, whether the other coordinate is mirrored, as on a Moebius
    /// band.
    mirrors: [bool; 2],
}

impl Charts {
    /// One chart, whose texture coordinates jump by `period` at its seams.
    #[must_use]
    pub fn one(period: SeamPeriod) -> Self {
        Self { of_triangle: Arc::default(), seams: vec![Seam { period, mirrors: [false; 2] }] }
    }

    /// Finds the charts of a mesh. All triangles without texture coordinates form one chart.
    #[must_use]
    pub fn of(mesh: &Mesh) -> Self {
        let weld = Weld::new(&mesh.positions);
        let of_triangle = connected(mesh, &weld);
        let count = of_triangle.iter().max().map_or(1, |&last| last as usize + 1);
        let seams = seams(mesh, &weld, &of_triangle, count);
        let of_triangle = if count == 1 { Arc::default() } else { of_triangle.into() };
        Self { of_triangle, seams }
    }

    /// Returns the difference `to - from` of two texture coordinates, each given with its triangle.
    /// Where the chart closes on itself, the difference is taken across the seam if this is
    /// shorter. Returns `None` if the coordinates are of different charts. Returns `None` too if
    /// the shorter difference crosses a seam that mirrors, since the coordinates between are then
    /// unknown.
    #[must_use]
    pub fn difference(&self, from: (u32, DVec2), to: (u32, DVec2)) -> Option<DVec2> {
        let chart = self.chart(from.0);
        if self.chart(to.0) != chart {
            return None;
        }
        let Seam { period, mirrors } = self.seams.get(chart).copied().unwrap_or_default();
        let mut difference = to.1 - from.1;
        for k in 0..2 {
            if period[k] > 0.0 {
                let turns = (difference[k] / period[k]).round();
                if turns != 0.0 && mirrors[k] {
                    return None;
                }
                difference[k] -= period[k] * turns;
            }
        }
        Some(difference)
    }

    fn chart(&self, triangle: u32) -> usize {
        self.of_triangle.get(triangle as usize).map_or(0, |&chart| chart as usize)
    }
}

/// Returns the chart of each triangle, numbered in the order of triangles. Triangles of one surface
/// belong to one chart if they share a corner with its position and its texture coordinates.
fn connected(mesh: &Mesh, weld: &Weld) -> Vec<u32> {
    let mut parents: Vec<u32> = (0..mesh.triangles.len() as u32).collect();
    let mut first: HashMap<(u32, [u32; 2], u32), u32> = HashMap::new();
    for (triangle, number) in mesh.triangles.iter().zip(0..) {
        for (&position, &uv) in triangle.position.iter().zip(&triangle.uv) {
            let key = if uv == NONE {
                (NONE, [NONE; 2], NONE)
            } else {
                let bits = weld::bits(mesh.uvs[uv as usize]);
                (weld.number(position), bits, triangle.surface)
            };
            let other = *first.entry(key).or_insert(number);
            let [one, other] = [root(&mut parents, number), root(&mut parents, other)];
            parents[one.max(other) as usize] = one.min(other);
        }
    }
    // A root is the first triangle of its chart, so its number is known when other triangles need
    // it.
    let mut charts = vec![0; parents.len()];
    let mut count = 0;
    for triangle in 0..parents.len() as u32 {
        let root = root(&mut parents, triangle);
        charts[triangle as usize] = if root == triangle {
            count += 1;
            count - 1
        } else {
            charts[root as usize]
        };
    }
    charts
}

/// Returns the root of `node` in the forest of parents and halves the path to the root.
fn root(parents: &mut [u32], mut node: u32) -> u32 {
    while parents[node as usize] != node {
        let above = parents[parents[node as usize] as usize];
        parents[node as usize] = above;
        node = above;
    }
    node
}

/// An edge of one triangle, between two numbered positions, the smaller number first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Edge {
    ends: [u32; 2],
    chart: u32,
    /// Indices of the texture coordinates at both ends.
    uvs: [u32; 2],
}

fn seams(mesh: &Mesh, weld: &Weld, of_triangle: &[u32], count: usize) -> Vec<Seam> {
    let mut edges = Vec::with_capacity(3 * mesh.triangles.len());
    for (triangle, &chart) in mesh.triangles.iter().zip(of_triangle) {
        if triangle.uv[0] == NONE {
            continue;
        }
        for k in 0..3 {
            let corner = |k: usize| (weld.number(triangle.position[k]), triangle.uv[k]);
            let [from, to] = [corner(k), corner((k + 1) % 3)];
            let [low, high] = if from.0 < to.0 { [from, to] } else { [to, from] };
            if low.0 != high.0 {
                edges.push(Edge { ends: [low.0, high.0], chart, uvs: [low.1, high.1] });
            }
        }
    }
    edges.sort_unstable();
    let mut seams = vec![Seam::default(); count];
    let mut beside_poles = vec![DVec2::ZERO; count];
    for pair in edges.windows(2) {
        let [one, other] = [pair[0], pair[1]];
        if one.ends != other.ends || one.chart != other.chart {
            continue;
        }
        let jump = |end: usize| uv(mesh, other.uvs[end]) - uv(mesh, one.uvs[end]);
        let jumps = [jump(0), jump(1)];
        let chart = one.chart as usize;
        for k in 0..2 {
            let along = jumps.map(|jump| jump[k].abs());
            let across = jumps.map(|jump| jump[1 - k]);
            if let Some(period) = closing(along) {
                let seam = &mut seams[chart];
                seam.period[k] = seam.period[k].max(period);
                let shifted = across.map(|jump| jump - jump.round()).map(f64::abs);
                seam.mirrors[k] |= shifted.iter().any(|&rest| rest > ROUNDING)
                    || (across[0] - across[1]).abs() > ROUNDING;
            } else {
                let most = beside_pole(along).unwrap_or(0.0);
                beside_poles[chart][k] = beside_poles[chart][k].max(most);
            }
        }
    }
    for (seam, beside) in seams.iter_mut().zip(beside_poles) {
        for k in 0..2 {
            if seam.period[k] == 0.0 {
                seam.period[k] = beside[k];
            }
        }
    }
    seams
}

fn uv(mesh: &Mesh, index: u32) -> DVec2 {
    DVec2::from(mesh.uvs[index as usize].map(f64::from))
}

/// Returns the whole number by which a coordinate jumps at both ends of an edge, if it is the same.
fn closing(jumps: [f64; 2]) -> Option<f64> {
    let whole = whole(jumps[0])?;
    (self::whole(jumps[1])? == whole).then_some(whole)
}

/// Returns the whole number by which a coordinate jumps at one end of an edge whose other end is a
/// pole.
///
/// At a pole each triangle has the coordinate of its middle, so the jump there is smaller by a
/// triangle's width. This rule applies only to a fan, which has no other edges along its seam.
fn beside_pole(jumps: [f64; 2]) -> Option<f64> {
    let [less, most] = if jumps[0] < jumps[1] { jumps } else { [jumps[1], jumps[0]] };
    whole(most).filter(|_| less > 0.5 * most - ROUNDING)
}

/// Returns the whole number, at least 1, that a jump equals up to rounding.
fn whole(jump: f64) -> Option<f64> {
    let whole = jump.round();
    let rounding = ROUNDING.max(1e-6 * jump);
    (whole >= 1.0 && (jump - whole).abs() < rounding).then_some(whole)
}

#[cfg(test)]
mod tests {
    use super::super::mesh::Triangle;
    use super::*;
    use std::f32::consts::TAU;

    /// Adds a band around the y axis from height `low` to `low + 1`. It has `cells` cells over the
    /// fraction `ring` of the circle, with coordinates from 0 to `repeat`.
    fn band(mesh: &mut Mesh, low: f32, cells: u32, ring: f32, repeat: f32, surface: u32) {
        for cell in 0..cells {
            let corner = |mesh: &mut Mesh, dx: u32, dy: u32| {
                let u = (cell + dx) as f32 / cells as f32;
                let angle = if u * ring == 1.0 { 0.0 } else { TAU * u * ring };
                mesh.positions.push([angle.cos(), low + dy as f32, angle.sin()]);
                mesh.uvs.push([repeat * u, dy as f32]);
                mesh.positions.len() as u32 - 1
            };
            let [a, b, c, d] = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(x, y)| corner(mesh, x, y));
            triangles(mesh, &[[a, b, c], [a, c, d]], surface);
        }
    }

    fn triangles(mesh: &mut Mesh, corners: &[[u32; 3]], surface: u32) {
        mesh.triangles.extend(corners.iter().map(|&corners| Triangle {
            position: corners,
            uv: corners,
            normal: [NONE; 3],
            surface,
        }));
    }

    /// Returns the difference of two coordinates on two triangles, rounded to nine digits.
    fn difference(charts: &Charts, from: (u32, f64), to: (u32, f64)) -> Option<f64> {
        let at = |(triangle, u)| (triangle, DVec2::new(u, 0.5));
        charts.difference(at(from), at(to)).map(|difference| (difference.x * 1e9).round() / 1e9)
    }

    #[test]
    fn each_area_has_a_seam_of_its_own() {
        let mut mesh = Mesh::default();
        band(&mut mesh, 0.0, 8, 1.0, 1.0, 0);
        band(&mut mesh, 1.0, 8, 1.0, 4.0, 0);
        band(&mut mesh, 2.0, 8, 0.5, 1.0, 0);
        let charts = Charts::of(&mesh);
        // Once around, the shorter difference crosses the seam. Four times around, 0.9 stays 0.9.
        assert_eq!(difference(&charts, (0, 0.05), (15, 0.95)), Some(-0.1));
        assert_eq!(difference(&charts, (16, 0.05), (17, 0.95)), Some(0.9));
        assert_eq!(difference(&charts, (16, 0.05), (31, 3.95)), Some(-0.1));
        // Half around, the area does not close.
        assert_eq!(difference(&charts, (32, 0.05), (47, 0.95)), Some(0.9));
        // Different areas have no difference, even on one surface.
        assert_eq!(difference(&charts, (0, 0.0), (16, 0.0)), None);
    }

    #[test]
    fn areas_side_by_side_on_an_open_grid_make_no_seam() {
        // The coordinates jump by 2 at the border, but the areas do not close.
        let mut mesh = Mesh::default();
        for x in 0..2u32 {
            let first = mesh.positions.len() as u32;
            for [dx, dy] in [[0u32, 0], [1, 0], [1, 1], [0, 1]] {
                mesh.positions.push([(x + dx) as f32, dy as f32, 0.0]);
                mesh.uvs.push([2.0 * dx as f32, dy as f32]);
            }
            triangles(&mut mesh, &[[0, 1, 2], [0, 2, 3]].map(|t| t.map(|k| first + k)), 0);
        }
        let charts = Charts::of(&mesh);
        assert_eq!(difference(&charts, (0, 0.1), (1, 1.9)), Some(1.8));
        assert_eq!(difference(&charts, (0, 1.9), (2, 0.1)), None);
    }

    #[test]
    fn a_seam_is_read_off_the_mesh() {
        // A floor repeats its picture and has no seam. A tube may be written with zeros of both
        // signs and six digits.
        let mut floor = Mesh::default();
        band(&mut floor, 0.0, 4, 0.25, 4.0, 0);
        assert_eq!(Charts::of(&floor), Charts::one(DVec2::ZERO));
        let mut tube = Mesh::default();
        band(&mut tube, 0.0, 5, 1.0, 4.0, 0);
        for position in &mut tube.positions {
            *position = position.map(|x| if x == 0.0 { -x } else { x });
        }
        tube.uvs.iter_mut().for_each(|uv| uv[0] *= 0.999_999);
        assert_eq!(Charts::of(&tube), Charts::one(DVec2::new(4.0, 0.0)));
        assert_eq!(Charts::of(&Mesh::default()), Charts::one(DVec2::ZERO));
    }

    #[test]
    fn a_fan_around_a_pole_is_one_chart_that_closes() {
        // The tip of each triangle has the coordinate of the middle of its base.
        let cone = |ring: f32| {
            let mut mesh = Mesh::default();
            band(&mut mesh, 0.0, 8, ring, 4.0, 0);
            for pair in 0..8 {
                mesh.triangles[2 * pair].position[2] = 2;
                let [from, to] = [0, 1].map(|k| mesh.uvs[4 * pair + k][0]);
                mesh.uvs[4 * pair + 2] = [0.5 * (from + to), 1.0];
            }
            mesh.triangles.retain(|triangle| triangle.position[1] % 4 == 1);
            Charts::of(&mesh)
        };
        assert_eq!(cone(1.0), Charts::one(DVec2::new(4.0, 0.0)));
        // A part of a cone does not close, although coordinates at its tip differ by whole numbers.
        assert_eq!(cone(0.5), Charts::one(DVec2::ZERO));
    }

    #[test]
    fn over_a_seam_that_mirrors_there_is_no_difference() {
        let mut mesh = Mesh::default();
        band(&mut mesh, 0.0, 8, 1.0, 1.0, 0);
        // The last cell ends at the first one's corners, upside down.
        mesh.positions.swap(29, 30);
        let charts = Charts::of(&mesh);
        assert_eq!(difference(&charts, (0, 0.05), (15, 0.95)), None);
        assert_eq!(difference(&charts, (0, 0.05), (5, 0.3)), Some(0.25));
    }

    #[test]
    fn triangles_without_coordinates_are_one_chart() {
        let mut mesh = Mesh::default();
        band(&mut mesh, 0.0, 8, 1.0, 1.0, 0);
        mesh.triangles.iter_mut().for_each(|triangle| triangle.uv = [NONE; 3]);
        mesh.triangles.drain(4..9);
        assert_eq!(Charts::of(&mesh), Charts::one(DVec2::ZERO));
    }
}
