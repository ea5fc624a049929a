//! A plane curve with a height above each of its points.
//!
//! The plane curve gives x and y as functions of its arc length `l`; the height z is also a function of `l`.
//! The surface between the plane curve and the curve in space can be unrolled. Its upper edge then becomes
//! the graph of z over `l`, which has the same length as the curve in space. So the graph alone determines
//! the arc length of the curve in space. With `(l, z)` on the graph, at the graph's arc length `s`,
//!
//! ```text
//!     P     = (p(l), z)
//!     P_s   = (t l_s, z_s)                                  t the flat tangent,
//!     P_ss  = (k l_s^2 + t l_ss, z_ss)                      k = dt/dl,
//!     P_sss = (k_l l_s^3 + 3 k l_s l_ss + t l_sss, z_sss)   k_l = dk/dl
//! ```

use crate::curve::cut::Side;
use crate::curve::path::Position;
use crate::curve::vector::angle_between;
use crate::curve::{Cubic, Curve3, Local3, Path};
use crate::law::parameter;
use glam::DVec2;

/// Joints of the two curves at most this fraction of the length apart are one joint.
const SAME: f64 = 1e-11;

/// A curve in space above a plane curve.
#[derive(Debug, Clone)]
pub struct Flat {
    plane: Path<DVec2>,
    /// The graph of points `(l, z)`, along which `l` does not fall.
    graph: Path<DVec2>,
}

impl Flat {
    /// Returns the curve in space for a graph of points `(at, z)` over a plane curve. `at` is a fraction of
    /// the plane curve's length, from 0 to 1. `None` only if the graph has no length, which cannot be.
    #[must_use]
    pub fn new(plane: Path<DVec2>, graph: &[Cubic<DVec2>]) -> Option<Self> {
        let wide = DVec2::new(plane.length(), 1.0);
        let graph: Vec<_> = graph.iter().map(|cubic| Cubic(cubic.0.map(|p| p * wide))).collect();
        let graph = Path::new(&graph, plane.closed())?;
        Some(Self { plane, graph })
    }

    /// Returns the joints: the arc length of each, and the turn of the tangent there in radians.
    pub fn joints(&self) -> impl Iterator<Item = (f64, f64)> {
        let length = self.length();
        let mut knots = self.knots();
        knots.pop();
        if !self.closed() {
            knots.remove(0);
        }
        // Tangents are taken a small step aside, because joints of one curve are located on the other only up
        // to rounding.
        knots.into_iter().map(move |s| {
            let end = if s == 0.0 { length } else { s };
            let (before, after) = (self.at(end - SAME * length), self.at(s + SAME * length));
            (s, angle_between(before.tangent, after.tangent))
        })
    }

    /// Returns the arc length in space above the arc length `l` of the plane curve.
    fn over(&self, l: f64) -> f64 {
        let next = self.graph.cubics().take_while(|cubic| cubic.0[3].x <= l).count();
        match self.graph.cubics().nth(next) {
            Some(cubic) => self.graph.length_to(self.graph.position(next, parameter(cubic, l))),
            None => self.graph.length(),
        }
    }

    fn local(&self, position: Position, side: Side) -> Local3 {
        let graph = &self.graph;
        let (g, g1) = (graph.point(position), graph.tangent(position));
        let (g2, g3) = (graph.curvature(position), graph.third(position));
        let below = match side {
            Side::Before => self.plane.locate_before(g.x),
            Side::After => self.plane.locate(g.x),
        };
        let (p, t) = (self.plane.point(below), self.plane.tangent(below));
        let (k, k_l) = (self.plane.curvature(below), self.plane.third(below));
        let l = g1.x;
        Local3 {
            position: p.extend(g.y),
            tangent: (t * l).extend(g1.y),
            curvature: (k * (l * l) + t * g2.x).extend(g2.y),
            third: (k_l * (l * l * l) + k * (3.0 * l * g2.x) + t * g3.x).extend(g3.y),
        }
    }
}

impl Curve3 for Flat {
    fn length(&self) -> f64 {
        self.graph.length()
    }

    fn closed(&self) -> bool {
        self.plane.closed()
    }

    fn knots(&self) -> Vec<f64> {
        let length = self.length();
        let plane = self.plane.knots().into_iter().map(|l| self.over(l));
        let mut knots: Vec<f64> = self.graph.knots().into_iter().chain(plane).collect();
        knots.sort_by(f64::total_cmp);
        knots.retain(|&s| s > SAME * length && s < (1.0 - SAME) * length);
        knots.dedup_by(|later, earlier| *later - *earlier <= SAME * length);
        knots.insert(0, 0.0);
        knots.push(length);
        knots
    }

    fn at(&self, s: f64) -> Local3 {
        self.local(self.graph.locate(s), Side::After)
    }

    fn before(&self, s: f64) -> Local3 {
        self.local(self.graph.locate_before(s), Side::Before)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::{spline, turn};
    use crate::law::{Ease, Law};
    use glam::DVec3;

    #[test]
    fn a_level_law_leaves_the_flat_curve_and_an_even_one_climbs_evenly() {
        let points: Vec<DVec2> = (0..64).map(|i| turn(f64::from(i) / 64.0) * 2.0).collect();
        let ring = Path::new(&spline::through(&points, true), true).unwrap();
        let flat = Flat::new(ring.clone(), &Law::constant(3.0).graph()).unwrap();
        assert!((flat.length() - ring.length()).abs() < 1e-13);
        let local = flat.at(1.0);
        assert!((local.position - ring.point(ring.locate(1.0)).extend(3.0)).length() < 1e-14);
        // An open ring, because the ends of a helix differ.
        let cubics: Vec<_> = ring.cubics().copied().collect();
        let ring = Path::new(&cubics, false).unwrap();
        let around = ring.length();
        let helix = Flat::new(ring, &Law::total(5.0).graph()).unwrap();
        assert!((helix.length() - around.hypot(5.0)).abs() < 1e-13);
        let slope = 5.0 / around.hypot(5.0);
        for i in 0..=40 {
            let local = helix.at(helix.length() * f64::from(i) / 40.0);
            assert!((local.tangent.z - slope).abs() < 1e-14);
            // The ring is a spline through 64 points, whose curvature is that of a circle to 1e-3.
            assert!((local.curvature.length() - (1.0 - slope * slope) / 2.0).abs() < 1e-3);
        }
    }

    #[test]
    fn it_runs_at_unit_speed_with_three_derivatives() {
        let points = [[0.0, 0.0], [1.0, 0.3], [1.2, 1.0], [3.0, 1.0]].map(DVec2::from_array);
        let plane = Path::new(&spline::through(&points, false), false).unwrap();
        let law = Law::keys(vec![[0.1, 0.0], [0.5, 1.5], [0.9, -1.0]], Ease::Smooth);
        let flat = Flat::new(plane, &law.graph()).unwrap();
        let (knots, h) = (flat.knots(), 1e-5);
        assert_eq!(knots.len(), 4 + 3);
        for i in 1..200 {
            let s = flat.length() * f64::from(i) / 200.0;
            if knots.iter().any(|knot| (knot - s).abs() < 2.0 * h) {
                continue;
            }
            let (local, before, after) = (flat.at(s), flat.at(s - h), flat.at(s + h));
            assert!((local.tangent.length() - 1.0).abs() < 1e-14);
            let off = |a: DVec3, b: DVec3, slope: DVec3| ((b - a) / (2.0 * h) - slope).length();
            assert!(off(before.position, after.position, local.tangent) < 1e-6);
            assert!(off(before.tangent, after.tangent, local.curvature) < 1e-5);
            let third = off(before.curvature, after.curvature, local.third);
            assert!(third < 1e-5 * (1.0 + local.third.length()), "{i} {third}");
            let on_graph = flat.graph.point(flat.graph.locate(s));
            let height = law.at(on_graph.x / flat.plane.length()).0;
            assert!((height - local.position.z).abs() < 1e-13);
        }
    }
}
