//! The swept surface before it is cut into cells: a point and a normal for each (u, v).

use crate::curve::cut::{self, Stop};
use crate::grid::Seam;
use crate::surface::cap::Cap;
use crate::surface::closing::Closing;
use crate::surface::deform::{Deform, Moved};
use crate::surface::edges::Edges;
use crate::surface::modulation::{Modulation, Section, SectionPoint};
use crate::surface::place::Placement;
use crate::surface::press::Press;
use crate::surface::profile::{Column, Profile};
use crate::surface::{Corner, Surface};
use crate::trajectory::Trajectory;
use glam::DVec3;

/// Points of a rotation whose distance from the axis is at most this fraction of the largest distance lie on
/// the axis.
pub(crate) const ON_AXIS: f64 = 1e-9;

/// A contour and a trajectory that fit each other, with all changes of the surface between them.
#[derive(Debug, Clone)]
pub struct Shape {
    pub(crate) contour: Profile,
    pub(crate) trajectory: Trajectory,
    pub(crate) modulation: Modulation,
    /// Caps that close the start and the end.
    pub(crate) caps: [Option<Cap>; 2],
    /// How the end meets the start, if columns do not meet themselves.
    pub(crate) closing: Option<Closing>,
    /// The ends that are pressed to a line.
    pub(crate) press: Option<Press>,
    /// Deformations of the finished surface, applied one after another.
    pub(crate) deforms: Vec<Deform>,
    /// Rows and columns where a deformation makes an edge.
    pub(crate) edges: Edges,
    /// Translation applied after the deformations.
    pub(crate) position: DVec3,
    /// Motion of the finished surface after the translation.
    pub(crate) place: Placement,
}

/// A point of the finished surface, with all results of one evaluation of its section.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SurfacePoint {
    /// The point, in the unit of length.
    pub point: DVec3,
    /// The unit normal.
    pub normal: DVec3,
    /// The stretch before deformations: see [`Station::stretch`](crate::trajectory::Station::stretch).
    pub stretch: f64,
    /// True if the contour folds back on itself, because its relief is deeper than it is round.
    pub contour_folds: bool,
    /// True if a deformation turns space inside out at the point.
    pub space_folds: bool,
}

impl SurfacePoint {
    /// Returns whether the surface folds back on itself, for any reason.
    pub(crate) fn folds(&self) -> bool {
        self.contour_folds || self.stretch < 0.0 || self.space_folds
    }
}

impl Shape {
    /// Returns the point and the unit normal of the surface at (u, v).
    ///
    /// `u` is a fraction of the contour's length, `v` a fraction of the length of the trajectory with its
    /// caps. At a crease the normal is that of the side after.
    #[must_use]
    pub fn at(&self, u: f64, v: f64) -> (DVec3, DVec3) {
        let column = self.columns(&[Stop::after(u)]).remove(0);
        let point = self.evaluate(&self.section(Stop::after(v)), &column);
        (point.point, point.normal)
    }

    /// Returns whether the last row leads back to the first.
    #[must_use]
    pub fn closed(&self) -> bool {
        self.trajectory.closed() || self.closing.is_some()
    }

    /// Returns the contour at a stop of the rows, on the trajectory or on a cap.
    pub(crate) fn section(&self, stop: Stop) -> Section {
        // The side before the start is the end, unless columns continue as other columns there.
        let first = self.closing.is_some() && stop == Stop::before(0.0);
        let stop = if first { Stop::after(0.0) } else { stop };
        let [start, end] = self.body();
        let on_trajectory = |stop| self.modulation.section(&self.trajectory, stop);
        match self.caps {
            [None, None] => on_trajectory(stop),
            [Some(cap), _] if stop.at < start || stop == Stop::before(start) => {
                on_trajectory(Stop::after(0.0)).gathered(cap.at(1.0 - stop.at / start), -1.0)
            }
            [_, Some(cap)] if stop.at > end || stop == Stop::after(end) => {
                // A cap too short to have a part of `v` is reduced to its tip.
                let t = if end < 1.0 { (stop.at - end) / (1.0 - end) } else { 1.0 };
                on_trajectory(Stop::before(1.0)).gathered(cap.at(t), 1.0)
            }
            _ => on_trajectory(Stop { at: self.on_body([start, end], stop.at), ..stop }),
        }
    }

    /// Returns a point of a section in space, after deformations and translation, with its unit normal.
    pub(crate) fn evaluate(&self, section: &Section, column: &Column) -> SurfacePoint {
        let SectionPoint { point, normal, stretch, contour_folds } = section.evaluate(column);
        let mut moved = Moved { point, normal, folds: false };
        for deform in &self.deforms {
            let next = deform.apply(moved.point, moved.normal);
            moved = Moved {
                normal: next.normal.try_normalize().unwrap_or(moved.normal),
                folds: next.folds || moved.folds,
                ..next
            };
        }
        SurfacePoint {
            point: self.place.point(moved.point + self.position),
            normal: self.place.direction(moved.normal),
            stretch,
            contour_folds,
            space_folds: moved.folds,
        }
    }

    /// Returns the `v` of possible edges that run along the contour, rising: at caps, at corners of the
    /// trajectory, at poles inside it, and where the surface closes.
    pub(crate) fn row_breaks(&self) -> Vec<f64> {
        let edge = self.closing.filter(|closing| closing.edge).map(|_| 0.0);
        let [start, end] = self.body();
        let caps = [self.caps[0].map(|_| start), self.caps[1].map(|_| end)];
        let corners = self.trajectory.breaks().iter().copied();
        let poles = self.modulation.breaks(self.trajectory.closed());
        let inner = corners.chain(poles).map(|at| self.row_of(at));
        let mut breaks: Vec<f64> =
            edge.into_iter().chain(caps.into_iter().flatten()).chain(inner).collect();
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        breaks
    }

    /// Returns the `v` of possible edges that run along the contour and have one normal.
    pub(crate) fn kinks(&self) -> Vec<f64> {
        let laws = self.modulation.kinks().into_iter().map(|at| self.row_of(at));
        laws.chain(self.edges.rows.iter().copied()).collect()
    }

    /// Returns the columns at stops of the contour.
    pub(crate) fn columns_at(&self, stops: &[Stop]) -> Vec<Column> {
        self.columns(stops)
    }

    /// Returns the unit normal that a direction across a section becomes by the deformations, at a column.
    pub(crate) fn deformed(&self, section: &Section, column: &Column, normal: DVec3) -> DVec3 {
        let point = section.point(column);
        let start = Moved { point, normal, folds: false };
        let moved = self.deforms.iter().fold(start, |moved, deform| {
            let next = deform.apply(moved.point, moved.normal);
            Moved { normal: next.normal.try_normalize().unwrap_or(moved.normal), ..next }
        });
        self.place.direction(moved.normal)
    }

    /// Returns the point of a section before the deformation with this index.
    pub(crate) fn before_deform(&self, section: &Section, column: &Column, index: usize) -> DVec3 {
        let SectionPoint { point, normal, .. } = section.evaluate(column);
        self.deforms[..index].iter().fold(point, |point, deform| deform.apply(point, normal).point)
    }

    /// Returns the fewest cells along the trajectory and its caps: one for each piece, and at least three if
    /// the rows are closed.
    pub(crate) fn fewest_rows(&self) -> usize {
        let around = if self.closed() { 3 } else { 1 };
        cut::pieces(&self.row_breaks()).max(around)
    }

    /// Returns the stops of about `cells` columns, of equal width on each smooth piece.
    pub(crate) fn even_columns(&self, cells: usize) -> Vec<Stop> {
        let (breaks, closed) = (self.contour.breaks(), self.contour.closed());
        match self.anchors() {
            Some(anchors) => cut::between(breaks, closed, cells, &anchors),
            None => cut::evenly(breaks, closed, cells),
        }
    }

    /// Returns the positions where columns must lie so that they meet columns: where the surface closes, or at an end that
    /// is pressed to a line. `None` if columns may lie anywhere.
    pub(crate) fn anchors(&self) -> Option<Vec<f64>> {
        let symmetry = self.closing.or(self.press.map(|press| press.symmetry))?;
        Some(symmetry.anchors(self.contour.breaks(), self.contour.closed()))
    }

    /// Returns the seam of the rows and its shift in columns, for columns at these stops. `None` if the
    /// columns do not meet columns.
    pub(crate) fn seam(&self, stops: &[Stop]) -> Option<(Seam, usize)> {
        match &self.closing {
            Some(closing) => closing.seam(stops, self.contour.breaks(), self.contour.closed()),
            None if self.closed() => Some((Seam::Closed, 0)),
            None => Some((Seam::Open, 0)),
        }
    }

    /// Returns the number of cells that resolves the whole surface,
    /// `[along the trajectory, along the contour]`.
    pub(crate) fn detail(&self) -> [usize; 2] {
        let [along, around] = self.modulation.detail();
        let caps = 16.0 * self.caps.iter().flatten().count() as f64;
        let deforms = 16.0 * self.deforms.len() as f64;
        let cells = |curve: f64, laws: f64| (curve + laws).clamp(8.0, 1e7) as usize;
        let along = along + caps + deforms;
        [cells(self.trajectory.detail(), along), cells(self.contour.detail(), around)]
    }

    /// Converts the `v` of a row by arc length to a `v` by the trajectory's own parameter; on a cap, `v` is
    /// unchanged.
    pub(crate) fn parameter_of(&self, v: f64) -> f64 {
        let [start, end] = self.body();
        if v < start || v > end {
            return v;
        }
        self.row_of(self.trajectory.parameter(self.on_body([start, end], v)))
    }

    /// Returns the fraction of the trajectory's length at a stop of the rows; `None` on a cap.
    pub(crate) fn along(&self, stop: Stop) -> Option<f64> {
        let [start, end] = self.body();
        let before = stop.at < start || self.caps[0].is_some() && stop == Stop::before(start);
        let after = stop.at > end || self.caps[1].is_some() && stop == Stop::after(end);
        (!before && !after).then(|| self.on_body([start, end], stop.at))
    }

    /// Returns the fraction of the trajectory's length at a `v` on the trajectory, which has the range `body`.
    fn on_body(&self, body: [f64; 2], v: f64) -> f64 {
        let [start, end] = body;
        // Inverts `row_of` exactly, to the last bit, where a break lies.
        let corners = self.trajectory.breaks();
        let next = corners.partition_point(|&at| row_between(body, at) < v);
        let same = |at: &f64| row_between(body, *at) == v;
        let corner = corners.get(next).copied().filter(same);
        let known = corner.or_else(|| self.modulation.breaks(self.trajectory.closed()).find(same));
        known.unwrap_or_else(|| ((v - start) / (end - start)).clamp(0.0, 1.0))
    }

    /// Returns the `v` at which the trajectory starts and ends; caps lie before and after.
    fn body(&self) -> [f64; 2] {
        let [start, end] = self.caps.map(|cap| cap.map_or(0.0, |cap| cap.length()));
        let whole = start + self.trajectory.length() + end;
        [
            if start == 0.0 { 0.0 } else { start / whole },
            if end == 0.0 { 1.0 } else { 1.0 - end / whole },
        ]
    }

    /// Returns the `v` of a fraction of the trajectory's length.
    fn row_of(&self, at: f64) -> f64 {
        row_between(self.body(), at)
    }

    /// Sets x to 0 for points of a rotation that lie on its axis up to `ON_AXIS`.
    fn snap_to_axis(&self, columns: &mut [Column]) {
        if self.trajectory.is_rotation() {
            let on_axis = ON_AXIS * self.contour.x_range().1;
            let locals = columns
                .iter_mut()
                .flat_map(|column| std::iter::once(&mut column.first).chain(&mut column.others));
            for local in locals.filter(|local| local.point.x <= on_axis) {
                local.point.x = 0.0;
            }
        }
    }
}

/// Returns the `v` of a fraction of the trajectory's length; the trajectory has the range `[start, end]`.
fn row_between([start, end]: [f64; 2], at: f64) -> f64 {
    start + (end - start) * at
}

impl Surface for Shape {
    fn columns(&self, stops: &[Stop]) -> Vec<Column> {
        let mut columns = match &self.modulation.offset {
            Some(_) => self.contour.columns_with_sides(stops),
            None => self.contour.columns(stops),
        };
        self.snap_to_axis(&mut columns);
        columns
    }

    fn station(&self, stop: Stop, columns: &[Column]) -> Vec<Corner> {
        let section = self.section(stop);
        let corner = |column| {
            let found = self.evaluate(&section, column);
            Corner { point: found.point, normal: found.normal, folds: found.folds() }
        };
        columns.iter().map(corner).collect()
    }

    fn points(&self, stop: Stop, columns: &[Column]) -> Vec<DVec3> {
        let section = self.section(stop);
        columns.iter().map(|column| self.evaluate(&section, column).point).collect()
    }
}
