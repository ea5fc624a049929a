//! Deformations of space around a surface: taper, twist and bend along an axis.
//!
//! After A. Barr, "Global and local deformations of solid primitives", 1984: a point moves by a map `D` of
//! space. A normal `n` moves by the cofactors of the derivative, `det(D') D'^-T n`. The cofactors have a
//! closed form for each map, so normals stay exact. Where a taper contracts everything to a point, the factor
//! that vanishes is left out, and the normals are limits.
//!
//! Each map acts between two heights on its axis. Outside, a taper and a twist keep their end values, and a
//! bend goes straight on.

use crate::curve::cut::Stop;
use crate::law::Law;
use glam::{DMat3, DVec3};

/// A height this close to an end of the span, as a fraction of the span, is at the end.
const AT_END: f64 = 1e-12;

/// A deformation of space along an axis.
#[derive(Debug, Clone)]
pub struct Deform {
    /// A point on the axis, from which heights are measured.
    pub(crate) origin: DVec3,
    /// Unit vectors of x, y and the axis, right-handed; a bend bends toward x.
    pub(crate) axes: DMat3,
    /// Heights on the axis where the deformation begins and ends.
    pub(crate) span: [f64; 2],
    /// Kind of the deformation.
    pub(crate) kind: Kind,
}

/// Kind of a deformation along its axis.
#[derive(Debug, Clone)]
pub enum Kind {
    /// Multiplies the distance from the axis by a law, at least 0.
    Taper(Law),
    /// Turns about the axis by a law, in degrees, right-handed.
    Twist(Law),
    /// Bends the axis by an angle in radians, other than 0.
    Bend(f64),
}

/// A point and a normal after a deformation.
#[derive(Debug, Clone, Copy)]
pub struct Moved {
    /// The point, in the unit of length.
    pub point: DVec3,
    /// The normal, of any length.
    pub normal: DVec3,
    /// True if the deformation turns space inside out at the point.
    pub folds: bool,
}

impl Deform {
    /// Returns the deformed point, and the normal there.
    #[must_use]
    pub fn apply(&self, point: DVec3, normal: DVec3) -> Moved {
        let local = self.axes.transpose();
        let (p, n) = (local * (point - self.origin), local * normal);
        let (p, n, folds) = match &self.kind {
            Kind::Taper(law) => {
                let (r, slope) = self.law(law, p.z);
                let moved = DVec3::new(r * p.x, r * p.y, p.z);
                // The factor r is divided out, because it may be 0.
                let z = r * n.z - slope * (p.x * n.x + p.y * n.y);
                (moved, DVec3::new(n.x, n.y, z), false)
            }
            Kind::Twist(law) => {
                let (degrees, slope) = self.law(law, p.z);
                let angle = crate::curve::turn(degrees / 360.0);
                let moved = angle.rotate(p.truncate()).extend(p.z);
                let across = angle.rotate(n.truncate());
                let swing = moved.truncate().perp() * slope.to_radians();
                (moved, across.extend(n.z - swing.dot(across)), false)
            }
            Kind::Bend(angle) => self.bent(*angle, p, n),
        };
        Moved { point: self.axes * p + self.origin, normal: self.axes * n, folds }
    }

    /// Returns the height of a point on the axis.
    pub(crate) fn height(&self, point: DVec3) -> f64 {
        self.axes.z_axis.dot(point - self.origin)
    }

    /// Returns the heights at which the derivative may jump, each with the length of the span.
    pub(crate) fn edges(&self) -> impl Iterator<Item = (f64, f64)> {
        let [from, to] = self.span;
        let parts = match &self.kind {
            Kind::Taper(law) | Kind::Twist(law) => {
                let slopes = [law.on(Stop::after(0.0)).1, law.on(Stop::before(1.0)).1];
                let ends = [0.0, 1.0].into_iter().zip(slopes).filter(|(_, slope)| *slope != 0.0);
                ends.map(|(end, _)| end).chain(law.kinks()).collect()
            }
            Kind::Bend(_) => vec![0.0, 1.0],
        };
        parts.into_iter().map(move |part| (from + (to - from) * part, to - from))
    }

    /// Returns whether a height lies in the span. The ends of the span belong to it, up to rounding.
    fn within(&self, height: f64) -> bool {
        let [from, to] = self.span;
        let slack = AT_END * (to - from);
        height > from - slack && height < to + slack
    }

    /// Returns the value of a law at a height, and its derivative by height. At a kink the derivative is that of
    /// the side above, at the ends of the span that of the inside.
    fn law(&self, law: &Law, height: f64) -> (f64, f64) {
        let [from, to] = self.span;
        let at = (height - from) / (to - from);
        let (value, _) = law.at(at.clamp(0.0, 1.0));
        // All points of a row at a kink take one side, although their heights differ by rounding.
        let slope = || law.at(law.at_kink(at).clamp(0.0, 1.0)).1 / (to - from);
        (value, if self.within(height) { slope() } else { 0.0 })
    }

    /// Bends the axis into an arc toward x. `k` is the arc's curvature, and `1 - k x` the factor of lengths
    /// along the axis at x.
    fn bent(&self, angle: f64, p: DVec3, n: DVec3) -> (DVec3, DVec3, bool) {
        let [from, to] = self.span;
        let k = angle / (to - from);
        let on_arc = p.z.clamp(from, to) - from;
        let (sin, cos) = (k * on_arc).sin_cos();
        let half = (0.5 * k * on_arc).sin();
        // Before the arc this is the height below its start, after it the height above its end.
        let rest = p.z - from - on_arc;
        let moved = DVec3::new(
            p.x * cos + 2.0 * half * half / k + rest * sin,
            p.y,
            from + sin / k - p.x * sin + rest * cos,
        );
        let left = if self.within(p.z) { 1.0 - k * p.x } else { 1.0 };
        let normal =
            DVec3::new(left * n.x * cos + n.z * sin, left * n.y, n.z * cos - left * n.x * sin);
        (moved, normal, left < 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::Ease;

    fn deform(kind: Kind) -> Deform {
        let axes = DMat3::from_cols(DVec3::Z, DVec3::X, DVec3::Y);
        Deform { origin: DVec3::new(0.1, 0.2, -0.3), axes, span: [0.5, 2.0], kind }
    }

    fn kinds() -> [Deform; 3] {
        let smooth =
            |values: [f64; 2]| Law::keys(vec![[0.0, values[0]], [1.0, values[1]]], Ease::Smooth);
        [
            deform(Kind::Taper(smooth([1.0, 0.3]))),
            deform(Kind::Twist(smooth([0.0, 200.0]))),
            deform(Kind::Bend(1.9)),
        ]
    }

    #[test]
    fn normals_move_by_the_cofactors_of_the_derivative() {
        let h = 1e-3;
        for deform in kinds() {
            for i in 1..200 {
                let part = |golden: f64| (f64::from(i) * golden).fract() * 2.0 - 1.0;
                let point = DVec3::new(part(0.618), 1.6 + 1.5 * part(0.755), part(0.57));
                // The derivative of a law may jump at its ends.
                let height = point.y - deform.origin.y;
                if [0.5, 2.0].iter().any(|end| (height - end).abs() < 3.0 * h) {
                    continue;
                }
                let normal = DVec3::new(part(0.37), part(0.8301), part(0.2113)).normalize();
                let at = |offset: DVec3| deform.apply(point + offset, normal).point;
                let slope = |axis: DVec3| {
                    let pair = |i: f64| at(axis * (i * h)) - at(axis * (-i * h));
                    (pair(1.0) * 0.75 - pair(2.0) * 0.15 + pair(3.0) / 60.0) / h
                };
                let derivative =
                    DMat3::from_cols(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z));
                let cofactors = derivative.inverse().transpose() * derivative.determinant();
                let moved = deform.apply(point, normal);
                let error = moved.normal.normalize() - (cofactors * normal).normalize();
                // Sixth-order differences with a step of 1e-3 leave an error of about 1e-13 / h.
                assert!(error.length() < 1e-9, "{error}");
                assert_eq!(moved.folds, derivative.determinant() < 0.0);
            }
        }
    }

    #[test]
    fn a_quarter_bend_takes_the_axis_to_a_quarter_circle() {
        let quarter = Deform {
            origin: DVec3::ZERO,
            axes: DMat3::from_cols(DVec3::Z, DVec3::X, DVec3::Y),
            span: [0.0, std::f64::consts::FRAC_PI_2],
            kind: Kind::Bend(std::f64::consts::FRAC_PI_2),
        };
        let end = quarter.apply(DVec3::Y * (std::f64::consts::FRAC_PI_2 + 3.0), DVec3::Y);
        assert!((end.point - DVec3::new(0.0, 1.0, 4.0)).length() < 1e-15);
        assert!((end.normal - DVec3::Z).length() < 1e-15);
        let below = quarter.apply(DVec3::new(0.3, -2.0, 0.4), DVec3::X);
        assert_eq!((below.point, below.normal), (DVec3::new(0.3, -2.0, 0.4), DVec3::X));
    }

    #[test]
    fn a_taper_to_a_point_keeps_the_normals_of_the_cone() {
        let cone = deform(Kind::Taper(Law::keys(vec![[0.0, 1.0], [1.0, 0.0]], Ease::Linear)));
        let tip = cone.origin + DVec3::Y * 2.0;
        // A cylinder of radius 1 becomes a cone of radius 1 and height 1.5.
        let moved = cone.apply(tip + DVec3::X, DVec3::X);
        assert!((moved.point - tip).length() < 1e-15);
        let expected = DVec3::new(1.5, 1.0, 0.0).normalize();
        assert!((moved.normal.normalize() - expected).length() < 1e-15);
    }
}
