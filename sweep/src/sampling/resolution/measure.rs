//! Distance of the triangles of a cut surface from the surface.
//!
//! A cell is measured where triangles are farthest from a surface of the second order. These
//! positions are the middles of its sides, its own middle, and the middles of its two triangles.
//! The distance is that of the true point there to the triangles, so the surface may slide along
//! them. At an edge between two cells, the triangles of the nearer cell count. The angle is that
//! between a triangle and the true normals at its corners, where a surface of the second order
//! turns away furthest.
//!
//! All errors are *loads*: relative to the tolerance, and of the second order in the size of the cell. An
//! angle is of the first order, so it is squared. A load of 1 is just allowed.

use super::Tolerance;
use super::triangle::{Facet, Pair};
use crate::curve::cut::Stop;
use crate::surface::Surface;
use crate::surface::profile::Column;
use glam::DVec3;
use rayon::prelude::*;

/// Distance of a position beside a kink from the kink, as a fraction of the cell's height. At a
/// larger distance, the normal differs from the limit. At a smaller distance, the position rounds
/// to the kink itself.
const BESIDE: f64 = 1e-9;

/// The loads of a cell: errors relative to the tolerance.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Load {
    /// Load of the cell's sides along the contour.
    pub u: f64,
    /// Load of the cell's sides along the trajectory.
    pub v: f64,
    /// Load of the whole cell, at least as large as the loads of its sides.
    pub total: f64,
}

/// The loads of all cells of a cut surface.
#[derive(Debug, Clone)]
pub struct Field {
    /// Start and end of each column of cells, as fractions; cells without width are left out.
    pub u: Vec<[f64; 2]>,
    /// Start and end of each row of cells, as fractions.
    pub v: Vec<[f64; 2]>,
    /// Loads row by row: `v.len()` rows of `u.len()` cells.
    pub loads: Vec<Load>,
    /// Largest distance of the triangles from the surface, in the unit of length.
    pub distance: f64,
    /// Largest distance as a fraction of the tolerance.
    pub part: f64,
    /// Largest angle between a triangle and the true normals, in radians.
    pub angle: f64,
}

/// The measurements of one row of cells.
struct Strip {
    loads: Vec<Load>,
    /// Errors of each cell's lower and upper side, measured against the cell's own triangles.
    sides: Vec<[Off; 2]>,
    /// The largest distance of the row.
    distance: Off,
    /// The largest squared chord between the unit normals of a triangle and of the surface.
    turn_sq: f64,
}

/// A distance, and that distance as a fraction of the tolerance.
#[derive(Debug, Clone, Copy, Default)]
struct Off {
    distance: f64,
    part: f64,
}

impl Off {
    fn least(self, other: Self) -> Self {
        Self { distance: self.distance.min(other.distance), part: self.part.min(other.part) }
    }

    fn most(self, other: Self) -> Self {
        Self { distance: self.distance.max(other.distance), part: self.part.max(other.part) }
    }
}

/// Columns at the measured positions of all cells, in the order of the cells.
struct Columns {
    /// Columns at the stops, with the end of a closed contour.
    stops: Vec<Column>,
    /// Columns at a third, the middle and two thirds of each cell that has a width.
    within: [Vec<Column>; 3],
    /// Index of the stop before each cell.
    cells: Vec<usize>,
    /// Columns just inside the left and the right side of each cell, if a column is a kink.
    beside: Option<[Vec<Column>; 2]>,
}

/// Measures the surface cut at `rows` and `cols`.
///
/// `kinks` are positions of the trajectory and of the contour with two normals. `meets` says whether the end of the trajectory meets its start column by column.
pub fn measure(
    surface: &dyn Surface,
    tolerance: &Tolerance,
    [rows, cols]: [&[Stop]; 2],
    [closed_v, closed_u]: [bool; 2],
    [kinks_v, kinks_u]: [&[f64]; 2],
    meets: bool,
) -> Field {
    let (rows, cols) = (opened(rows, closed_v), opened(cols, closed_u));
    let (u, cells) = spans(&cols);
    let (v, _) = spans(&rows);
    let inside = |part: f64| -> Vec<Stop> {
        u.iter().map(|[from, to]| Stop::after(from + (to - from) * part)).collect()
    };
    let columns = Columns {
        stops: surface.columns(&cols),
        within: [1.0 / 3.0, 0.5, 2.0 / 3.0].map(|part| surface.columns(&inside(part))),
        cells,
        beside: (!kinks_u.is_empty())
            .then(|| [BESIDE, 1.0 - BESIDE].map(|part| surface.columns(&inside(part)))),
    };
    let strips: Vec<Strip> = v
        .par_iter()
        .map(|span| strip(surface, tolerance, &columns, *span, kinks_v, closed_u))
        .collect();
    joined(u, v, strips, closed_v && meets)
}

/// Returns the stops with the end of a closed curve added, which repeats its start.
fn opened(stops: &[Stop], closed: bool) -> Vec<Stop> {
    let mut stops = stops.to_vec();
    if closed {
        stops.push(Stop::before(1.0));
    }
    stops
}

/// Returns the cells that have a width, and the index of the stop before each.
fn spans(stops: &[Stop]) -> (Vec<[f64; 2]>, Vec<usize>) {
    let wide = |at: &usize| stops[at + 1].at > stops[*at].at;
    let cells: Vec<usize> = (0..stops.len() - 1).filter(wide).collect();
    (cells.iter().map(|&at| [stops[at].at, stops[at + 1].at]).collect(), cells)
}

/// Measures the row of cells between two positions of the trajectory.
fn strip(
    surface: &dyn Surface,
    tolerance: &Tolerance,
    columns: &Columns,
    [from, to]: [f64; 2],
    kinks: &[f64],
    closed_u: bool,
) -> Strip {
    let row = |stop: Stop| surface.station(stop, &columns.stops);
    let points = |stop: Stop, columns: &[Column]| surface.points(stop, columns);
    let within = |part: f64| Stop::after(from + (to - from) * part);
    let [third, middle, two_thirds] = &columns.within;
    let (below, above) = (Stop::after(from), Stop::before(to));
    let (mut lower, mut upper) = (row(below), row(above));
    // Beside a kink, the point is that of the row itself, and the normal is that of this side.
    let within_by = BESIDE * (to - from);
    for (kink, inside, corners) in
        [(from, from + within_by, &mut lower), (to, to - within_by, &mut upper)]
    {
        if kinks.contains(&kink) {
            let near = row(Stop::after(inside));
            corners.iter_mut().zip(near).for_each(|(here, near)| here.normal = near.normal);
        }
    }
    let beside = columns.beside.as_ref().map(|sides| {
        let at = |stop: Stop| sides.each_ref().map(|columns| surface.station(stop, columns));
        [at(Stop::after(from + within_by)), at(Stop::after(to - within_by))]
    });
    let (lower_middle, upper_middle) = (points(below, middle), points(above, middle));
    let (left, centre) = (points(within(0.5), &columns.stops), points(within(0.5), middle));
    let low = [third, two_thirds].map(|columns| points(within(1.0 / 3.0), columns));
    let high = [third, two_thirds].map(|columns| points(within(2.0 / 3.0), columns));

    let count = columns.cells.len();
    let per_turn_sq = tolerance.per_turn_sq();
    let mut cells: Vec<([Off; 4], Off, f64, [f64; 2])> = Vec::with_capacity(count);
    for (cell, &at) in columns.cells.iter().enumerate() {
        let corners = [lower[at], lower[at + 1], upper[at + 1], upper[at]];
        let places = corners.map(|corner| corner.point);
        let normals = match &beside {
            Some([[a, b], [d, c]]) => [a, b, c, d].map(|side| side[cell].normal),
            None => corners.map(|corner| corner.normal),
        };
        // No angle can be kept where normals are turned over.
        let folds = corners.iter().any(|corner| corner.folds);
        let pair = Pair::choose(&places, &normals);
        let facets = pair.corners.map(|corners| Facet::new(corners.map(|corner| places[corner])));
        // The tolerance in the cell is that at its centre.
        let per_distance = tolerance.per_distance(centre[cell]);
        let off = |point: DVec3| {
            let distance = facets[0].distance_sq(point).min(facets[1].distance_sq(point)).sqrt();
            Off { distance, part: distance * per_distance }
        };
        let sides = [lower_middle[cell], left[at + 1], upper_middle[cell], left[at]].map(off);
        let centroids =
            if pair.ac { [low[1][cell], high[0][cell]] } else { [low[0][cell], high[1][cell]] };
        let inner = centroids.into_iter().fold(off(centre[cell]), |most, p| most.most(off(p)));
        let turn_sq = facets.iter().zip(pair.corners).filter_map(|(facet, corners)| {
            let normal = facet.normal.filter(|_| !folds)?;
            Some(corners.map(|corner| (normals[corner] - normal).length_squared()))
        });
        let turn_sq = turn_sq.flatten().fold(0.0, f64::max);
        // At each end of a side, a facet along it is off by half the turn of the side.
        let turn = |a: usize, b: usize| 0.25 * (normals[a] - normals[b]).length_squared();
        let turns = [turn(0, 1).max(turn(3, 2)), turn(0, 3).max(turn(1, 2))];
        let turns = if folds { [0.0; 2] } else { turns };
        cells.push((sides, inner, turn_sq, turns));
    }

    let (mut loads, mut sides) = (Vec::with_capacity(count), Vec::with_capacity(count));
    let (mut distance, mut most_turn_sq) = (Off::default(), 0.0_f64);
    for (cell, (own, inner, turn_sq, turns)) in cells.iter().enumerate() {
        // The left and right sides are shared with the neighbouring cells.
        let before = match cell {
            0 if closed_u => Some(count - 1),
            0 => None,
            _ => Some(cell - 1),
        };
        let after = if cell + 1 < count { Some(cell + 1) } else { closed_u.then_some(0) };
        let right = after.map_or(own[1], |next| own[1].least(cells[next].0[3]));
        let left = before.map_or(own[3], |next| own[3].least(cells[next].0[1]));
        let across = left.most(right);
        let most = across.most(*inner);
        distance = distance.most(most);
        most_turn_sq = most_turn_sq.max(*turn_sq);
        loads.push(Load {
            u: turns[0] * per_turn_sq,
            v: across.part.max(turns[1] * per_turn_sq),
            total: most.part.max(turn_sq * per_turn_sq),
        });
        sides.push([own[0], own[2]]);
    }
    Strip { loads, sides, distance, turn_sq: most_turn_sq }
}

/// Joins all rows of cells; sides between two rows are shared.
fn joined(u: Vec<[f64; 2]>, v: Vec<[f64; 2]>, strips: Vec<Strip>, closed_v: bool) -> Field {
    let count = strips.len();
    let mut loads = Vec::with_capacity(u.len() * v.len());
    let (mut distance, mut turn_sq) = (Off::default(), 0.0_f64);
    for (at, strip) in strips.iter().enumerate() {
        let before = if at > 0 { Some(at - 1) } else { closed_v.then_some(count - 1) };
        let after = if at + 1 < count { Some(at + 1) } else { closed_v.then_some(0) };
        let other = |strip: Option<usize>, cell: usize, side: usize, own: Off| {
            strip.map_or(own, |strip| own.least(strips[strip].sides[cell][side]))
        };
        for (cell, (load, own)) in strip.loads.iter().zip(&strip.sides).enumerate() {
            let along = other(before, cell, 1, own[0]).most(other(after, cell, 0, own[1]));
            distance = distance.most(along);
            let u = load.u.max(along.part);
            loads.push(Load { u, v: load.v, total: load.total.max(u).max(load.v) });
        }
        distance = distance.most(strip.distance);
        turn_sq = turn_sq.max(strip.turn_sq);
    }
    let angle = 2.0 * (0.5 * turn_sq.sqrt()).min(1.0).asin();
    Field { u, v, loads, distance: distance.distance, part: distance.part, angle }
}

impl Field {
    /// Returns the largest load of a cell.
    pub fn worst(&self) -> f64 {
        self.loads.iter().fold(0.0, |most, load| load.total.max(most))
    }

    /// Returns the number of cells that have a width.
    pub fn quads(&self) -> usize {
        self.loads.len()
    }
}
