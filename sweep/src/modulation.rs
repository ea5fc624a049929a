//! How the contour changes on its way: given a relief, scaled along its axes, then turned about the
//! trajectory.
//!
//! With `q(u, s)` the contour's point after relief and scale, on a frame that turns by `phi(s)` more than it
//! must, and the trajectory's curvature `k` on that frame's `(w1, w2)`,
//!
//! ```text
//!     S         = P + q1 w1 + q2 w2
//!     S_u       = q1_u w1 + q2_u w2
//!     S_s       = (1 - k.q) T + A w1 + B w2,    A = q1_s - phi' q2,    B = q2_s + phi' q1
//!     S_u x S_s = (1 - k.q)(q2_u w1 - q1_u w2) + (q1_u B - q2_u A) T
//! ```
//!
//! so that a normal needs the laws' derivatives and no differences. Where a scale of 0 gathers the
//! contour in a point, both `q` and `q_u` vanish; they are divided by the scale first, and the
//! normal is the limit along the column: that of a cone, or `-T` or `T` on a cap whose scale ends
//! vertically.

use crate::contour::Column;
use crate::cut::Stop;
use crate::depth::{Depth, Raised, Relief};
use crate::law::Law;
use crate::trajectory::{Station, Trajectory};
use glam::{DVec2, DVec3};

/// The laws by which a contour changes; none of them leaves it as it is.
#[derive(Debug, Clone, Default)]
pub struct Modulation {
    /// Factors of the contour's x and y, not negative.
    pub(crate) scale: Option<[Law; 2]>,
    /// Turn about the trajectory, in degrees as in the file.
    pub(crate) twist: Option<Law>,
    /// Relief on the contour, under the scale.
    pub(crate) depth: Option<Depth>,
}

/// A contour in its place on the trajectory, with all that has changed there.
#[derive(Debug, Clone)]
pub struct Section {
    station: Station,
    scale: DVec2,
    /// Derivative of the scale by length of the trajectory; by radian for a rotation.
    scale_s: DVec2,
    relief: Option<Relief>,
    /// Length of the trajectory, by which derivatives by `v` become those by length.
    extent: f64,
    /// Whether the contour is as it was drawn.
    plain: bool,
}

/// A point of a section: where it lies on the frame, and how it moves.
#[derive(Debug, Clone, Copy)]
struct Local {
    q: DVec2,
    /// Direction of the contour, divided by the scale: it does not vanish with it.
    q_u: DVec2,
    q_s: DVec2,
    /// Whether the contour itself folds back.
    folds: bool,
}

impl Modulation {
    /// The section at a stop of the trajectory.
    #[must_use]
    pub fn section(&self, trajectory: &Trajectory, stop: Stop) -> Section {
        let (station, v) = (trajectory.station_at(stop), stop.at);
        let extent = trajectory.extent();
        let pace = 1.0 / extent;
        let station = match &self.twist {
            Some(law) => {
                let (degrees, slope) = law.at(v);
                station.turned(degrees / 360.0, slope.to_radians() * pace)
            }
            None => station,
        };
        let (scale, scale_s) = match &self.scale {
            Some([x, y]) => {
                let ((a, a_v), (b, b_v)) = (x.at(v), y.at(v));
                (DVec2::new(a, b), DVec2::new(a_v, b_v) * pace)
            }
            None => (DVec2::ONE, DVec2::ZERO),
        };
        let relief = self.depth.as_ref().map(|depth| depth.at(v));
        let plain = self.scale.is_none() && relief.is_none();
        Section { station, scale, scale_s, relief, extent, plain }
    }
}

impl Modulation {
    /// Cells that see all that the laws and waves do, along the trajectory and along the contour.
    pub(crate) fn detail(&self) -> [f64; 2] {
        let mut along: f64 = self.laws().map(Law::detail).sum();
        if let Some(twist) = &self.twist {
            let (low, high) = twist.range();
            along += 16.0 * (high - low) / 360.0;
        }
        let mut around = 0.0_f64;
        for term in self.depth.iter().flat_map(|depth| &depth.terms) {
            along += 8.0 * term.v.abs();
            around += 8.0 * term.u.abs();
        }
        [along, around]
    }

    /// Places inside the trajectory where the surface may have an edge.
    pub(crate) fn kinks(&self) -> Vec<f64> {
        self.laws().flat_map(Law::kinks).collect()
    }

    fn laws(&self) -> impl Iterator<Item = &Law> {
        let terms = self.depth.iter().flat_map(|depth| &depth.terms);
        self.scale.iter().flatten().chain(&self.twist).chain(terms.map(|term| &term.along))
    }
}

impl Section {
    /// The point of the surface.
    #[must_use]
    pub fn point(&self, column: &Column) -> DVec3 {
        self.station.point(self.local(column).q)
    }

    /// The unit normal of the surface.
    #[must_use]
    pub fn normal(&self, column: &Column) -> DVec3 {
        if self.plain {
            return self.station.normal(column.point, column.tangent);
        }
        let Local { q, q_u, q_s, .. } = self.local(column);
        self.station.normal_of_moving(q, q_u, q_s)
    }

    /// Whether the surface folds back on itself here.
    #[must_use]
    pub fn folds(&self, column: &Column) -> bool {
        let local = self.local(column);
        local.folds || self.station.stretch(local.q) < 0.0
    }

    fn local(&self, column: &Column) -> Local {
        let Raised { point, along, across, folds } = match &self.relief {
            Some(relief) => relief.on(column),
            None => Raised {
                point: column.point,
                along: column.tangent,
                across: DVec2::ZERO,
                folds: false,
            },
        };
        // The proportion of the axes; where both are 0 it is that in which they leave it.
        let axes = if self.scale == DVec2::ZERO { self.scale_s.abs() } else { self.scale };
        let axes = if axes == DVec2::ZERO { DVec2::ONE } else { axes / axes.max_element() };
        let q_s = self.scale_s * point + self.scale * (across / self.extent);
        Local { q: self.scale * point, q_u: axes * along, q_s, folds }
    }
}
