//! Reads curves of two and three dimensions: Beziers that meet, and splines through points.

use super::Reader;
use crate::curve::vector::extent;
use crate::curve::{Cubic, Path, Vector, fit, spline};
use crate::error::SweepError;
use crate::limits::SMALLEST;
use crate::spec::{Bezier, Free, FreeContour};
use glam::DVec2;

/// Segments meet if their ends are at most this fraction of the curve apart.
///
/// The value is far above rounding, so that six decimals copied from an editor suffice, and far
/// below visible differences.
const MEETS: f64 = 1e-6;

/// Consecutive points at most this fraction of the curve apart are one point.
const COINCIDENT: f64 = 1e-12;

impl Reader<'_> {
    /// Reads segments that meet end to end; small gaps between them are closed.
    pub(super) fn bezier<P, V>(&self, path: &str, bezier: &Bezier<P>) -> Result<Path<V>, SweepError>
    where
        P: AsRef<[f64]> + Copy,
        V: Vector + From<P>,
    {
        let segments_path = format!("{path}.segments");
        if bezier.segments.is_empty() {
            return Err(self.fault(&segments_path, "found no segments, expected at least one"));
        }
        for (i, segment) in bezier.segments.iter().enumerate() {
            self.points(&format!("{segments_path}[{i}]"), segment)?;
        }
        let mut cubics: Vec<Cubic<V>> =
            bezier.segments.iter().map(|segment| Cubic(segment.map(V::from))).collect();
        let widest = MEETS * extent(cubics.iter().flat_map(|cubic| cubic.0));
        let count = cubics.len();
        for i in 0..if bezier.closed { count } else { count - 1 } {
            let next = (i + 1) % count;
            let (end, start) = (cubics[i].0[3], cubics[next].0[0]);
            if (end - start).length() > widest {
                let (end, start) = (bezier.segments[i][3], bezier.segments[next][0]);
                let (end, start) = (end.as_ref(), start.as_ref());
                return Err(if next == 0 {
                    self.fault(
                        &format!("{segments_path}[{i}][3]"),
                        format!("found {end:?}, expected {start:?}, where a closed curve starts"),
                    )
                } else {
                    self.fault(
                        &format!("{segments_path}[{next}][0]"),
                        format!("found {start:?}, expected {end:?}, where the segment before ends"),
                    )
                });
            }
            cubics[i].0[3] = start;
        }
        self.path(path, &cubics, bezier.closed)
    }

    /// Returns the spline through free points, without repeated points.
    pub(super) fn free<P, V>(&self, path: &str, free: &Free<P>) -> Result<Path<V>, SweepError>
    where
        P: AsRef<[f64]> + Copy,
        V: Vector + From<P>,
    {
        let points = self.distinct(path, free)?;
        self.path(path, &spline::through(&points, free.closed), free.closed)
    }

    /// Returns the spline through free points of a plane, or with `fit` a curve near them and the largest
    /// distance of a point from it.
    pub(super) fn near(
        &self,
        path: &str,
        given: &FreeContour,
    ) -> Result<(Path<DVec2>, Option<f64>), SweepError> {
        let free = Free { closed: given.closed, points: given.points.clone() };
        let Some(tolerance) = given.fit else {
            return Ok((self.free(path, &free)?, None));
        };
        self.positive(&format!("{path}.fit"), tolerance)?;
        let points: Vec<DVec2> = self.distinct(path, &free)?;
        let fit = fit::within(&points, free.closed, tolerance);
        Ok((self.path(path, &fit.cubics, free.closed)?, Some(fit.reached)))
    }

    /// Reads straight lines from point to point.
    pub(super) fn polyline<P, V>(&self, path: &str, line: &Free<P>) -> Result<Path<V>, SweepError>
    where
        P: AsRef<[f64]> + Copy,
        V: Vector + From<P>,
    {
        let points: Vec<V> = self.distinct(path, line)?;
        let ends = points.iter().zip(points.iter().cycle().skip(1));
        let count = if line.closed { points.len() } else { points.len() - 1 };
        let sides: Vec<_> = ends.take(count).map(|(&a, &b)| Cubic::line(a, b)).collect();
        self.path(path, &sides, line.closed)
    }

    /// Returns the points of a curve without repetitions; refuses too few of them.
    pub(super) fn distinct<P, V>(&self, path: &str, free: &Free<P>) -> Result<Vec<V>, SweepError>
    where
        P: AsRef<[f64]> + Copy,
        V: Vector + From<P>,
    {
        let points_path = format!("{path}.points");
        let (fewest, kind) = if free.closed { (3, "a closed") } else { (2, "an open") };
        if free.points.len() < fewest {
            let found = free.points.len();
            let message =
                format!("found {found}, expected at least {fewest} points for {kind} curve");
            return Err(self.fault(&points_path, message));
        }
        self.points(&points_path, &free.points)?;
        let mut points: Vec<V> = free.points.iter().map(|&point| V::from(point)).collect();
        let narrow = COINCIDENT * extent(points.iter().copied());
        points.dedup_by(|later, earlier| (*later - *earlier).length() <= narrow);
        if free.closed
            && let [first, .., last] = points[..]
            && (last - first).length() <= narrow
        {
            points.pop();
        }
        if points.len() < fewest {
            let message = format!(
                "found {} that differ, expected at least {fewest} points for {kind} curve",
                points.len()
            );
            return Err(self.geometry(&points_path, message));
        }
        Ok(points)
    }

    pub(super) fn path<V: Vector>(
        &self,
        path: &str,
        cubics: &[Cubic<V>],
        closed: bool,
    ) -> Result<Path<V>, SweepError> {
        let size = extent(cubics.iter().flat_map(|cubic| cubic.0));
        if size > 0.0 && size < SMALLEST {
            let message = format!("found a size of {size:?}, expected at least {SMALLEST:?}");
            return Err(self.geometry(path, message));
        }
        Path::new(cubics, closed).ok_or_else(|| {
            self.geometry(
                path,
                "found points that all coincide, expected a curve with a length above 0",
            )
        })
    }
}
