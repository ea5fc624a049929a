//! The profile that is swept: one contour, or several contours at positions on the trajectory with blends
//! between them.
//!
//! Points of several contours correspond by length. The point of a blend at `u` lies between the points at
//! `u` of both contours, however many points each was drawn with. Closed contours are first given starts that
//! match (see [`align`]). A crease of any contour is a break of all contours; a contour without a crease
//! there has the same normal on both sides.
//!
//! | module    | what                                                |
//! |-----------|-----------------------------------------------------|
//! | [`align`] | the start of a closed contour that matches another  |
//! | [`blend`] | the two contours around a position, and their blend |

pub mod align;
pub mod blend;

pub use blend::Blend;

use crate::curve::cut::{self, Side, Stop};
use crate::surface::contour::{Contour, Local2};
use glam::DVec2;

/// Breaks of two contours at most this fraction of the length apart are one break.
const SAME: f64 = 1e-9;

/// A contour, or several contours that are all closed or all open.
#[derive(Debug, Clone)]
pub struct Profile {
    contours: Vec<Aligned>,
    /// Positions of the creases as fractions of the length, rising.
    breaks: Vec<f64>,
    /// Factors of both axes, 1 or -1, if the profile is mirrored. A mirrored profile runs in the
    /// opposite direction.
    mirror: Option<DVec2>,
}

/// A contour with the start that aligns it with the others.
#[derive(Debug, Clone)]
struct Aligned {
    contour: Contour,
    /// Start of the contour, as a fraction of its own length; 0 for an open contour.
    start: f64,
    /// Creases, rising: position on the profile and position on the contour, as fractions of the length.
    creases: Vec<[f64; 2]>,
}

/// A position along a profile: the points with the same `u` on all its contours.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Arc length from the start, as a fraction of the whole, in `[0, 1]`.
    pub u: f64,
    /// The point on the first contour.
    pub first: Local2,
    /// The points on the other contours; most often there are none.
    pub others: Box<[Local2]>,
    /// The straight side that the point lies on, if the contour has corners and its columns are asked for their sides.
    pub side: Option<Side2>,
}

/// A straight side of a contour, between two corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Side2 {
    /// Position on the side, from 0 at its start to 1.
    pub part: f64,
    /// Length of the side, as a fraction of the contour's.
    pub length: f64,
    /// Unit tangents of the side before and of the side after; the side's own at an end that is no corner.
    pub around: [DVec2; 2],
}

impl Profile {
    /// Returns a profile of one contour.
    pub(crate) fn single(contour: Contour) -> Self {
        Self::of(vec![(contour, 0.0)])
    }

    /// Returns a profile of at least one contour. If `aligned`, closed contours get starts that match.
    pub(crate) fn blended(contours: Vec<Contour>, aligned: bool) -> Self {
        let mut placed: Vec<(Contour, f64)> = Vec::with_capacity(contours.len());
        for contour in contours {
            let start = match placed.last() {
                Some((before, from)) if aligned && contour.closed() => {
                    align::start(before, *from, &contour)
                }
                _ => 0.0,
            };
            placed.push((contour, start));
        }
        Self::of(placed)
    }

    fn of(placed: Vec<(Contour, f64)>) -> Self {
        let mut contours: Vec<Aligned> = placed
            .into_iter()
            .map(|(contour, start)| {
                let crease = |own: f64| {
                    let u = if own < start { own - start + 1.0 } else { own - start };
                    let at_start = start > 0.0 && !(SAME..=1.0 - SAME).contains(&u);
                    [if at_start { 0.0 } else { u }, own]
                };
                let mut creases: Vec<_> = contour.breaks().into_iter().map(crease).collect();
                creases.sort_by(|a, b| a[0].total_cmp(&b[0]));
                Aligned { contour, start, creases }
            })
            .collect();
        let mut breaks: Vec<f64> =
            contours.iter().flat_map(|one| one.creases.iter().map(|crease| crease[0])).collect();
        breaks.sort_by(f64::total_cmp);
        if contours.len() > 1 {
            breaks.dedup_by(|later, earlier| *later - *earlier <= SAME);
        }
        for crease in contours.iter_mut().flat_map(|one| &mut one.creases) {
            let next = breaks.partition_point(|at| *at <= crease[0]);
            crease[0] = breaks[next.max(1) - 1];
        }
        Self { contours, breaks, mirror: None }
    }

    /// Returns the profile mirrored by two factors of 1 or -1.
    ///
    /// The mirrored profile runs in the other direction, from the same start if it is closed. So its outside
    /// stays to the right of its direction.
    pub(crate) fn mirrored(self, factors: DVec2) -> Self {
        Self { mirror: Some(factors), ..self }.reversed()
    }

    fn reversed(mut self) -> Self {
        let closed = self.closed();
        let other = |at: f64| if closed && at == 0.0 { 0.0 } else { 1.0 - at };
        let turn = |positions: &mut Vec<f64>| {
            for at in positions.iter_mut() {
                *at = other(*at);
            }
            positions.sort_by(f64::total_cmp);
        };
        turn(&mut self.breaks);
        for one in &mut self.contours {
            for crease in &mut one.creases {
                crease[0] = other(crease[0]);
            }
            one.creases.sort_by(|a, b| a[0].total_cmp(&b[0]));
        }
        self
    }

    /// Returns the only contour, or `None` if there are several.
    #[must_use]
    pub fn as_contour(&self) -> Option<&Contour> {
        match &self.contours[..] {
            [only] => Some(&only.contour),
            _ => None,
        }
    }

    /// Returns, for each contour fitted to points, the number of segments and the largest distance of a point
    /// from them.
    pub fn fits(&self) -> impl Iterator<Item = (usize, f64)> {
        self.contours.iter().filter_map(|one| one.contour.fit())
    }

    /// Returns the number of contours.
    #[must_use]
    pub fn contours(&self) -> usize {
        self.contours.len()
    }

    /// Returns whether the contours are closed.
    #[must_use]
    pub fn closed(&self) -> bool {
        self.contours.iter().all(|one| one.contour.closed())
    }

    /// Returns the length of the longest contour.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.contours.iter().map(|one| one.contour.length()).fold(0.0, f64::max)
    }

    /// Returns the number of cells that resolves every contour.
    pub(crate) fn detail(&self) -> f64 {
        self.contours.iter().map(|one| one.contour.detail()).fold(0.0, f64::max)
    }

    /// Returns the number of creases of all contours; creases at one position count once.
    #[must_use]
    pub fn creases(&self) -> usize {
        self.breaks.len()
    }

    /// Returns the positions of the creases as fractions of the length in `[0, 1]`, rising.
    #[must_use]
    pub fn breaks(&self) -> &[f64] {
        &self.breaks
    }

    /// Returns the fewest cells along the profile: one for each smooth piece, and at least three if it is
    /// closed.
    #[must_use]
    pub fn fewest_cells(&self) -> usize {
        let around = if self.closed() { 3 } else { 1 };
        cut::pieces(&self.breaks).max(around)
    }

    /// Returns the smallest and the largest `x` of all contours.
    pub(crate) fn x_range(&self) -> (f64, f64) {
        let mirrored = self.mirror.is_some_and(|factors| factors.x < 0.0);
        let turned = |(low, high): (f64, f64)| if mirrored { (-high, -low) } else { (low, high) };
        let ranges = self.contours.iter().map(|one| turned(one.contour.x_range()));
        ranges.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (a, b)| {
            (low.min(a), high.max(b))
        })
    }

    /// Returns the columns at `stops`, which serve all rows of the trajectory.
    #[must_use]
    pub fn columns(&self, stops: &[Stop]) -> Vec<Column> {
        stops.iter().map(|&stop| self.column(stop)).collect()
    }

    /// Returns the column at `u`, a fraction of the length in `[0, 1]`; at a crease, of the side after.
    #[must_use]
    pub fn at(&self, u: f64) -> Column {
        self.column(Stop::after(u))
    }

    /// Returns the first contour's own parameter at a stop, from 0 to 1.
    pub(crate) fn parameter(&self, stop: Stop) -> f64 {
        let Some(one) = self.contours.first() else { return stop.at };
        match (self.mirror, stop.at) {
            (None, _) => one.contour.parameter(stop),
            (Some(_), 0.0) => 0.0,
            (Some(_), at) => 1.0 - one.contour.parameter(Stop::before(1.0 - at)),
        }
    }

    fn column(&self, stop: Stop) -> Column {
        let (first, others) = self.contours.split_first().expect("a profile has a contour");
        Column {
            u: stop.at,
            first: first.at(stop, self.mirror),
            others: others.iter().map(|one| one.at(stop, self.mirror)).collect(),
            side: None,
        }
    }

    /// Returns the side of a polygon that a stop lies on.
    fn side(&self, stop: Stop) -> Option<Side2> {
        let breaks = &self.breaks;
        let count = breaks.len();
        if count == 0 {
            return None;
        }
        // Index of the break at which the side starts; the side over the start of the contour starts at the last one.
        let next = match stop.side {
            Side::After => breaks.partition_point(|&at| at <= stop.at),
            Side::Before => breaks.partition_point(|&at| at < stop.at),
        };
        let from = (next + count - 1) % count;
        let (start, end) = (breaks[from], breaks[next % count]);
        let length = (end - start).rem_euclid(1.0);
        let length = if length == 0.0 { 1.0 } else { length };
        let done = (stop.at - start).rem_euclid(1.0);
        let at_end = stop.side == Side::Before && stop.at == end;
        let part = if at_end { 1.0 } else { (done / length).min(1.0) };
        let tangent = |stop: Stop| self.column(stop).first.tangent;
        let around = [tangent(Stop::before(start)), tangent(Stop::after(end))];
        Some(Side2 { part, length, around })
    }

    /// Returns the columns at stops of a contour with straight sides, each with its side.
    pub(crate) fn columns_with_sides(&self, stops: &[Stop]) -> Vec<Column> {
        stops.iter().map(|&stop| Column { side: self.side(stop), ..self.column(stop) }).collect()
    }
}

impl Aligned {
    fn at(&self, stop: Stop, mirror: Option<DVec2>) -> Local2 {
        let crease = self.creases.binary_search_by(|crease| crease[0].total_cmp(&stop.at));
        let crease = crease.ok().map(|index| self.creases[index][1]);
        let Some(factors) = mirror else {
            let own = crease.unwrap_or_else(|| align::own(self.start, stop.at));
            return self.contour.at(Stop { at: own, ..stop });
        };
        let forward = if self.contour.closed() && stop.at == 0.0 { 0.0 } else { 1.0 - stop.at };
        let own = crease.unwrap_or_else(|| align::own(self.start, forward));
        let side = match stop.side {
            Side::Before => Side::After,
            Side::After => Side::Before,
        };
        let local = self.contour.at(Stop { at: own, side });
        // Both the mirror and the reversed direction change the sign of the turn, so the curvature keeps its
        // sign.
        Local2 { point: local.point * factors, tangent: -local.tangent * factors, ..local }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::{Cubic, Path, spline};

    fn polygon(points: &[[f64; 2]]) -> Contour {
        let points: Vec<DVec2> = points.iter().copied().map(DVec2::from_array).collect();
        let next = points.iter().cycle().skip(1);
        let sides: Vec<_> = points.iter().zip(next).map(|(&a, &b)| Cubic::line(a, b)).collect();
        Contour::fitted(Path::new(&sides, true).unwrap(), None)
    }

    #[test]
    fn creases_of_each_contour_are_breaks_of_all() {
        let square = polygon(&[[1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]]);
        let triangle = polygon(&[[1.0, 0.0], [1.0, 3.0], [-3.0, 0.0]]);
        let profile =
            Profile::blended(vec![square, triangle, Contour::circle(DVec2::ZERO, 1.0)], false);
        assert_eq!(profile.breaks(), [0.0, 0.25, 0.5, 2.0 / 3.0, 0.75]);
        assert_eq!((profile.fewest_cells(), profile.creases()), (5, 5));
        let stops = cut::evenly(profile.breaks(), true, 5);
        let columns = profile.columns(&stops);
        // At the triangle's own corner only the triangle has two tangents.
        let [before, after] = [&columns[6], &columns[7]];
        assert_eq!((before.u, after.u), (2.0 / 3.0, 2.0 / 3.0));
        assert_eq!(before.first, after.first);
        assert_ne!(before.others[0].tangent, after.others[0].tangent);
        assert_eq!(before.others[0].point, after.others[0].point);
        assert_eq!(before.others[1], after.others[1]);
    }

    #[test]
    fn a_shifted_start_moves_the_creases_with_it() {
        let square = |first: usize| {
            let mut corners = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
            corners.rotate_left(first);
            polygon(&corners)
        };
        let profile = Profile::blended(vec![square(0), square(3)], true);
        assert_eq!(profile.creases(), 4);
        for stop in cut::evenly(profile.breaks(), true, 12) {
            let column = profile.column(stop);
            assert!((column.first.point - column.others[0].point).length() < 1e-15);
            assert!((column.first.tangent - column.others[0].tangent).length() < 1e-15);
        }
    }

    #[test]
    fn the_only_contour_keeps_its_places() {
        let points = [[1.0, 0.0], [0.3, 1.0], [-1.0, 0.4], [0.0, -1.0]].map(DVec2::from_array);
        let contour =
            Contour::fitted(Path::new(&spline::through(&points, true), true).unwrap(), None);
        let profile = Profile::single(contour.clone());
        for u in [0.0, 0.1, 0.77, 1.0] {
            let column = profile.at(u);
            assert_eq!((column.u, column.first), (u, contour.at(Stop::after(u))));
            assert!(column.others.is_empty());
        }
    }
}
