//! Contours: the curves that are swept.
//!
//! Each contour of a spec becomes a circle or a path of cubics. A new kind that cubics can express
//! must provide its JSON and a variant of [`spec::Contour`](crate::spec::Contour). It must also
//! provide its cubics: in `read/contour.rs` for the surface and in `check/drawing.rs` as it was
//! drawn. A kind in closed form also needs a variant of `Form` here, with an arm in each method.
//! These methods return its length, creases, range of x, parameter and detail, and at each stop its
//! point, unit tangent and curvature. No `match` over these enums has a wildcard arm, so the
//! compiler names each missing arm.

use crate::curve::cut::{Side, Stop};
use crate::curve::path::{Joint, Position};
use crate::curve::{Cubic, Path, turn};
use glam::DVec2;
use kurbo::{CubicBez, ParamCurveArea, Point, Shape};
use std::f64::consts::TAU;

/// A joint of a contour that turns by more than this, in degrees, is a crease.
///
/// Handles rounded to three decimals turn a joint that is meant to be smooth by some tenths of a degree. A
/// crease of less than a degree looks like a smooth joint.
const CREASE_DEG: f64 = 1.0;

/// A side is straight if its control points are at most this fraction of its length off its chord.
const STRAIGHT: f64 = 1e-9;

/// An area below this fraction of the squared length has no reliable sign (a figure of eight).
const NO_AREA: f64 = 1e-9;

/// A point of a contour, with derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Local2 {
    /// The point, in the unit of length.
    pub point: DVec2,
    /// The unit tangent; at a crease, of one side.
    pub tangent: DVec2,
    /// Turn of the tangent in radians per length, positive to the left; 0 where it is unbounded.
    pub curvature: f64,
    /// Derivative of `u` by length: 1 over the contour's length.
    pub pace: f64,
}

/// A checked contour: it has a length, and a closed one runs counter-clockwise.
#[derive(Debug, Clone)]
pub struct Contour(Form);

#[derive(Debug, Clone)]
enum Form {
    Circle {
        center: DVec2,
        radius: f64,
        /// 1 for a counter-clockwise circle, -1 for a clockwise one.
        turn: f64,
    },
    /// `reached` is the largest distance of a fitted point from the path.
    Path { path: Path<DVec2>, creases: Vec<Joint>, reached: Option<f64> },
}

impl Contour {
    /// Returns a circle, counter-clockwise from its point in the direction of x.
    pub(crate) fn circle(center: DVec2, radius: f64) -> Self {
        Self(Form::Circle { center, radius, turn: 1.0 })
    }

    /// Returns a closed contour in the other direction, from the same start. A clockwise contour bounds a hole.
    pub(crate) fn backward(self) -> Self {
        match self.0 {
            Form::Circle { center, radius, turn } => {
                Self(Form::Circle { center, radius, turn: -turn })
            }
            Form::Path { path, reached, .. } => {
                let mut reversed: Vec<_> = path.cubics().map(Cubic::reversed).collect();
                reversed.reverse();
                Self::of(Path::new(&reversed, path.closed()).unwrap_or(path), reached)
            }
        }
    }

    /// Returns a contour along a path. A closed path that runs clockwise is reversed, from the same start. A closed path
    /// that encloses equal areas to its left and right keeps its direction. `reached` is the largest distance of points
    /// from a path that was fitted to them.
    pub(crate) fn fitted(path: Path<DVec2>, reached: Option<f64>) -> Self {
        let path = if path.closed() { counter_clockwise(path) } else { path };
        Self::of(path, reached)
    }

    /// Returns a contour along a path in the direction of the path.
    pub(crate) fn drawn(path: Path<DVec2>) -> Self {
        Self::of(path, None)
    }

    /// Returns the contour for a rotation about the y axis. An open contour that starts and ends on the axis
    /// (x of at most `on_axis`) is reversed like a closed one if it runs clockwise.
    pub(crate) fn rotated(self, on_axis: f64) -> Self {
        match self.0 {
            Form::Path { path, reached, .. }
                if [path.start(), path.end()].iter().all(|&end| path.point(end).x <= on_axis) =>
            {
                // The line back along the axis adds nothing to an area about the start.
                Self::of(counter_clockwise(path), reached)
            }
            form => Self(form),
        }
    }

    fn of(path: Path<DVec2>, reached: Option<f64>) -> Self {
        let mut creases: Vec<Joint> =
            path.joints().filter(|joint| joint.angle.to_degrees() > CREASE_DEG).collect();
        // A closed path ends where it starts. A joint whose fraction of the length rounds to 1 is the start.
        while path.closed()
            && let Some(last) = creases.pop_if(|joint| joint.s / path.length() >= 1.0)
        {
            if creases.first().is_none_or(|first| first.s > 0.0) {
                creases.insert(0, Joint { s: 0.0, ..last });
            }
        }
        Self(Form::Path { path, creases, reached })
    }

    /// Returns whether the contour leads back to its start.
    #[must_use]
    pub fn closed(&self) -> bool {
        match &self.0 {
            Form::Circle { .. } => true,
            Form::Path { path, .. } => path.closed(),
        }
    }

    /// Returns the length of the whole contour.
    #[must_use]
    pub fn length(&self) -> f64 {
        match &self.0 {
            Form::Circle { radius, .. } => TAU * radius,
            Form::Path { path, .. } => path.length(),
        }
    }

    /// Returns the number of creases: corners of more than a degree, including the start of a closed contour.
    #[must_use]
    pub fn creases(&self) -> usize {
        match &self.0 {
            Form::Circle { .. } => 0,
            Form::Path { creases, .. } => creases.len(),
        }
    }

    /// Returns the number of segments fitted to points, and the largest distance of a point from them; `None`
    /// if the contour was not fitted.
    #[must_use]
    pub fn fit(&self) -> Option<(usize, f64)> {
        match &self.0 {
            Form::Circle { .. } => None,
            Form::Path { path, reached, .. } => {
                reached.map(|reached| (path.cubics().count(), reached))
            }
        }
    }

    /// Returns whether the contour has no corners, or only straight sides between them.
    pub(crate) fn has_straight_sides(&self) -> bool {
        match &self.0 {
            Form::Circle { .. } => true,
            Form::Path { path, creases, .. } => {
                creases.is_empty() || path.cubics().all(|cubic| cubic.is_straight(STRAIGHT))
            }
        }
    }

    /// Returns the smallest and the largest `x`.
    pub(crate) fn x_range(&self) -> (f64, f64) {
        match &self.0 {
            Form::Circle { center, radius, .. } => (center.x - radius, center.x + radius),
            Form::Path { path, .. } => path
                .cubics()
                .map(|cubic| kurbo_cubic(cubic.0).bounding_box())
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), bounds| {
                    (low.min(bounds.x0), high.max(bounds.x1))
                }),
        }
    }

    /// Returns the positions of the creases as fractions of the length, rising.
    #[must_use]
    pub fn breaks(&self) -> Vec<f64> {
        match &self.0 {
            Form::Circle { .. } => Vec::new(),
            Form::Path { path, creases, .. } => {
                creases.iter().map(|joint| joint.s / path.length()).collect()
            }
        }
    }

    /// Returns the positions of the joints of segments as fractions of the length, rising; none on a circle.
    pub(crate) fn knots(&self) -> Vec<f64> {
        match &self.0 {
            Form::Circle { .. } => Vec::new(),
            Form::Path { path, .. } => {
                path.knots().into_iter().map(|s| s / path.length()).collect()
            }
        }
    }

    /// Returns the number of cells that resolves the contour: eight for each segment.
    pub(crate) fn detail(&self) -> f64 {
        match &self.0 {
            Form::Circle { .. } => 32.0,
            Form::Path { path, .. } => 8.0 * path.cubics().count() as f64,
        }
    }

    /// Returns the contour's own parameter at a stop, from 0 to 1.
    pub(crate) fn parameter(&self, stop: Stop) -> f64 {
        match &self.0 {
            Form::Circle { .. } => stop.at,
            Form::Path { path, creases, .. } => match stop {
                // Both sides of the start have parameter 0.
                Stop { at: 0.0, .. } => 0.0,
                _ => path.parameter(position_of(path, creases, stop)),
            },
        }
    }

    /// Returns the contour at a stop; at a crease, of the stop's side.
    #[must_use]
    pub fn at(&self, stop: Stop) -> Local2 {
        match &self.0 {
            Form::Circle { center, radius, turn: direction } => {
                let point = turn(direction * stop.at);
                Local2 {
                    point: point * *radius + *center,
                    tangent: point.perp() * *direction,
                    curvature: direction / radius,
                    pace: 1.0 / self.length(),
                }
            }
            Form::Path { path, creases, .. } => {
                let position = position_of(path, creases, stop);
                let tangent = path.tangent(position);
                let curvature = tangent.perp_dot(path.curvature(position));
                Local2 {
                    point: path.point(position),
                    tangent,
                    curvature,
                    pace: 1.0 / path.length(),
                }
            }
        }
    }
}

/// Returns the position of a stop; at a crease, on the stop's side.
fn position_of(path: &Path<DVec2>, creases: &[Joint], stop: Stop) -> Position {
    let length = path.length();
    match (creases.binary_search_by(|joint| (joint.s / length).total_cmp(&stop.at)), stop.side) {
        (Ok(index), Side::Before) => creases[index].before,
        (Ok(index), Side::After) => creases[index].after,
        (Err(_), _) if stop.at >= 1.0 => path.end(),
        (Err(_), _) => path.locate(stop.at * length),
    }
}

/// Returns the path, reversed if it runs clockwise.
fn counter_clockwise(path: Path<DVec2>) -> Path<DVec2> {
    let origin = path.point(path.start());
    // The area is taken about a point of the path, so that no digits are lost far from the origin.
    let area: f64 =
        path.cubics().map(|cubic| kurbo_cubic(cubic.0.map(|p| p - origin)).signed_area()).sum();
    if area < -NO_AREA * path.length().powi(2) {
        let mut reversed: Vec<_> = path.cubics().map(Cubic::reversed).collect();
        reversed.reverse();
        return Path::new(&reversed, path.closed()).unwrap_or(path);
    }
    path
}

fn kurbo_cubic(points: [DVec2; 4]) -> CubicBez {
    let [p0, p1, p2, p3] = points.map(|p| Point::new(p.x, p.y));
    CubicBez::new(p0, p1, p2, p3)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::cut;
    use crate::curve::svg;
    use std::f64::consts::PI;

    fn contour(text: &str) -> Contour {
        let outline = svg::outline(text).unwrap();
        Contour::fitted(Path::new(&outline.segments, outline.closed).unwrap(), None)
    }

    /// Returns the contour at the ends of its cells, each with its `u` rounded to six decimals.
    fn cut(contour: &Contour, cells: usize) -> Vec<(f64, Local2)> {
        let stops = cut::evenly(&contour.breaks(), contour.closed(), cells);
        stops.iter().map(|&stop| ((stop.at * 1e6).round() / 1e6, contour.at(stop))).collect()
    }

    fn us(columns: &[(f64, Local2)]) -> Vec<f64> {
        columns.iter().map(|column| column.0).collect()
    }

    #[test]
    fn a_circle_is_cut_evenly() {
        let circle = Contour::circle(DVec2::ZERO, 2.0);
        assert_eq!(circle.length(), 4.0 * PI);
        let columns = cut(&circle, 4);
        let (point, tangent) = (DVec2::Y * 2.0, DVec2::NEG_X);
        let pace = 1.0 / (4.0 * PI);
        assert_eq!(columns[1], (0.25, Local2 { point, tangent, curvature: 0.5, pace }));
        assert_eq!(us(&columns), [0.0, 0.25, 0.5, 0.75]);
    }

    /// The last two corners lie within rounding of the start, as fractions of a length of 8e9.
    #[test]
    fn corners_within_rounding_of_the_start_of_a_closed_contour_are_at_the_start() {
        let spike = contour("M0 0H1V4294967296L2 3L0 1e-7L0 1e-8Z");
        let breaks = spike.breaks();
        assert!(spike.closed() && spike.length() > 8e9);
        assert_eq!(breaks[0], 0.0);
        assert!(breaks.windows(2).all(|pair| pair[0] <= pair[1]), "{breaks:?}");
        assert!(breaks.iter().all(|&at| at < 1.0), "{breaks:?}");
    }

    #[test]
    fn corners_are_given_twice() {
        // A rectangle of 3 x 1, counter-clockwise; SVG's y points down.
        let rectangle = contour("M0 0H3V-1H0Z");
        assert_eq!(rectangle.creases(), 4);
        let columns = cut(&rectangle, 8);
        assert_eq!(columns.len(), 12);
        assert_eq!(
            us(&columns),
            [0.0, 0.0, 0.125, 0.25, 0.375, 0.375, 0.5, 0.5, 0.625, 0.75, 0.875, 0.875]
        );
        assert_eq!(columns[0].1.tangent, DVec2::NEG_Y, "the side that comes in");
        assert_eq!(columns[1].1.tangent, DVec2::X, "the side that goes out");
        assert_eq!(columns[0].1.point, columns[1].1.point);
    }

    #[test]
    fn an_open_contour_has_both_its_ends() {
        let bend = contour("M0 0H1V-1");
        let columns = cut(&bend, 4);
        assert_eq!(us(&columns), [0.0, 0.25, 0.5, 0.5, 0.75, 1.0]);
        assert_eq!(columns[5].1.point, DVec2::ONE);
    }

    #[test]
    fn a_corner_elsewhere_than_at_the_start_leaves_the_start_smooth() {
        let drop = contour("M0 0C0 -1 1 -1 2 0C1 1 0 1 0 0Z");
        assert_eq!(drop.creases(), 1);
        let columns = cut(&drop, 10);
        assert_eq!(columns.len(), 11);
        assert_eq!(columns[0].0, 0.0);
        assert!(columns[1].0 > 0.0);
    }

    #[test]
    fn clockwise_contours_are_turned_round_from_the_same_start() {
        let (clockwise, counter) = (contour("M0 0V-1H1V0Z"), contour("M0 0H1V-1H0Z"));
        let (a, b) = (cut(&clockwise, 8), cut(&counter, 8));
        for (a, b) in a.iter().zip(&b) {
            assert!((a.1.point - b.1.point).length() < 1e-15);
            assert!((a.1.tangent - b.1.tangent).length() < 1e-15);
        }
        let open = contour("M0 0V-1H1");
        assert_eq!(cut(&open, 2)[0].1.tangent, DVec2::Y, "an open one is kept");
    }

    #[test]
    fn the_range_of_x_is_that_of_the_curve() {
        let p = DVec2::new;
        let bulge = Cubic([p(0.0, 0.0), p(4.0, 1.0), p(4.0, 2.0), p(0.0, 3.0)]);
        let (low, high) = Contour::fitted(Path::new(&[bulge], false).unwrap(), None).x_range();
        assert_eq!((low, high), (0.0, 3.0));
    }
}
