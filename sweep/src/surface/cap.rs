//! Caps: surfaces that close the ends of a sweep beyond its trajectory.
//!
//! A cap shrinks the last section toward a centre that sees the whole section, and moves it straight along
//! the trajectory's last direction. With `t` from 0 at the section to 1 at the pole,
//!
//! | cap   | scale of the section             | distance from the end |
//! |-------|----------------------------------|--------------------|
//! | flat  | `1 - t`                          | 0                  |
//! | dome  | `cos(pi t / 2)`                  | `h sin(pi t / 2)`  |
//! | pole  | `1 - t`                          | `h t`              |
//!
//! A dome therefore meets a tube without an edge. On a circle of radius `h` it is half a sphere.

use crate::curve::turn;
use glam::DVec2;
use std::f64::consts::{FRAC_PI_2, PI};

/// A cap on a section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cap {
    /// The centre toward which the section shrinks, on the section's axes.
    pub(crate) center: DVec2,
    /// Mean distance of the section's outline from the centre.
    pub(crate) radius: f64,
    /// Shape of the cap.
    pub(crate) form: Form,
}

/// Shape of a cap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Form {
    /// Flat, in the plane of the section.
    Flat,
    /// A quarter of an ellipse of this height, in the unit of length, above 0.
    Dome(f64),
    /// A straight line to the pole at this height, in the unit of length, above 0.
    Pole(f64),
}

/// A section on a cap at `t`, with derivatives by `t`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Gathered {
    pub center: DVec2,
    /// Scale of the section about the centre, from 1 at the rim to 0 at the pole.
    pub part: f64,
    /// Derivative of the scale by `t`.
    pub part_t: f64,
    /// Distance of the section from the trajectory's end.
    pub beyond: f64,
    /// Derivative of the distance by `t`.
    pub beyond_t: f64,
}

impl Cap {
    /// Returns the length of a line on the cap from the rim to the pole, at the mean radius.
    #[must_use]
    pub fn length(&self) -> f64 {
        match self.form {
            Form::Flat => self.radius,
            Form::Pole(height) => self.radius.hypot(height),
            // A quarter of the ellipse by Ramanujan's first formula, 1914. The length only distributes rows
            // and texture coordinates.
            Form::Dome(h) => {
                let r = self.radius;
                0.25 * PI * (3.0 * (r + h) - ((3.0 * r + h) * (r + 3.0 * h)).sqrt())
            }
        }
    }

    /// Returns the section at `t`, from 0 at the rim to 1 at the pole.
    pub(crate) fn at(&self, t: f64) -> Gathered {
        let (part, part_t, beyond, beyond_t) = match self.form {
            Form::Flat => (1.0 - t, -1.0, 0.0, 0.0),
            Form::Pole(height) => (1.0 - t, -1.0, height * t, height),
            Form::Dome(height) => {
                let angle = turn(0.25 * t);
                let speed = FRAC_PI_2;
                (angle.x, -angle.y * speed, height * angle.y, height * angle.x * speed)
            }
        };
        Gathered { center: self.center, part, part_t, beyond, beyond_t }
    }
}

/// Returns a point that sees the whole of a closed polygon, and the polygon's area, which is negative if the
/// polygon runs clockwise. `None` if there is no such point.
///
/// The point is the centre of gravity if that sees the whole polygon. Otherwise it is the centre of gravity
/// of the polygon's kernel: a box from which everything behind each edge is cut off.
#[must_use]
pub fn center_of(polygon: &[DVec2]) -> Option<(DVec2, f64)> {
    let (area, center) = area_and_center(polygon)?;
    if sees_all(center, polygon, area) {
        return Some((center, area));
    }
    let (low, high) = polygon
        .iter()
        .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high): (DVec2, DVec2), &p| {
            (low.min(p), high.max(p))
        });
    let mut kernel = vec![low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
    for (from, to) in edges(polygon) {
        let inside = |p: DVec2| (to - from).perp_dot(p - from) * area.signum();
        let mut left = Vec::with_capacity(kernel.len() + 1);
        for (a, b) in edges(&kernel) {
            let (in_a, in_b) = (inside(a), inside(b));
            if in_a >= 0.0 {
                left.push(a);
            }
            if (in_a >= 0.0) != (in_b >= 0.0) {
                left.push(a.lerp(b, in_a / (in_a - in_b)));
            }
        }
        kernel = left;
    }
    let (_, center) = area_and_center(&kernel)?;
    sees_all(center, polygon, area).then_some((center, area))
}

fn edges(polygon: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> {
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().copied().zip(next.copied())
}

fn area_and_center(polygon: &[DVec2]) -> Option<(f64, DVec2)> {
    let &origin = polygon.first()?;
    let (mut twice, mut moment) = (0.0, DVec2::ZERO);
    for (a, b) in edges(polygon) {
        let (a, b) = (a - origin, b - origin);
        let part = a.perp_dot(b);
        twice += part;
        moment += (a + b) * part;
    }
    let center = origin + moment / (3.0 * twice);
    (twice != 0.0 && center.is_finite()).then_some((0.5 * twice, center))
}

/// An edge seen from its end spans with the centre at most this fraction of the polygon's area. Rounding of its points
/// decides the sign of so small an area.
const SEEN_FROM_ITS_END: f64 = 1e-9;

/// Returns whether all edges are seen from their inner side. An edge seen from its end, or too short to
/// judge, counts as seen.
fn sees_all(viewpoint: DVec2, polygon: &[DVec2], area: f64) -> bool {
    let slack = SEEN_FROM_ITS_END * area.abs();
    edges(polygon)
        .all(|(from, to)| (from - viewpoint).perp_dot(to - viewpoint) * area.signum() > -slack)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_is_seen_from_its_middle() {
        let square = [[1.0, 1.0], [3.0, 1.0], [3.0, 3.0], [1.0, 3.0]].map(DVec2::from_array);
        assert_eq!(center_of(&square), Some((DVec2::splat(2.0), 4.0)));
    }

    #[test]
    fn a_bent_shape_is_seen_from_its_kernel_alone() {
        // Long legs, whose centre of gravity does not lie in the corner that sees both.
        let ell = [[0.0, 0.0], [9.0, 0.0], [9.0, 1.0], [1.0, 1.0], [1.0, 9.0], [0.0, 9.0]];
        let (center, area) = center_of(&ell.map(DVec2::from_array)).unwrap();
        assert!((center - DVec2::splat(0.5)).length() < 1e-12, "{center}");
        assert_eq!(area, 17.0);
        let reversed: Vec<DVec2> = ell.iter().rev().copied().map(DVec2::from_array).collect();
        assert_eq!(center_of(&reversed).map(|(_, area)| area), Some(-17.0));
    }

    #[test]
    fn a_shape_with_two_bends_is_seen_from_nowhere() {
        let u = [[0, 0], [9, 0], [9, 9], [8, 9], [8, 1], [1, 1], [1, 9], [0, 9]];
        let polygon = u.map(|[x, y]| DVec2::new(f64::from(x), f64::from(y)));
        assert_eq!(center_of(&polygon), None);
        assert_eq!(center_of(&[DVec2::ZERO, DVec2::X, DVec2::X * 2.0]), None);
    }

    #[test]
    fn the_way_over_half_a_sphere_is_a_quarter_circle() {
        let cap = Cap { center: DVec2::ZERO, radius: 2.0, form: Form::Dome(2.0) };
        assert!((cap.length() - PI).abs() < 1e-15);
        let Gathered { part, beyond, .. } = cap.at(1.0 / 3.0);
        assert!((part.hypot(beyond / 2.0) - 1.0).abs() < 1e-15);
        assert_eq!((cap.at(1.0).part, cap.at(0.0).beyond), (0.0, 0.0));
    }
}
