//! Changes of the contour along the trajectory: it is blended into another contour, given a relief, scaled
//! along its axes, then turned about the trajectory.
//!
//! Let `q(u, s)` be the contour's point after all these changes except the turn, on a frame that spins at the
//! rate `phi'(s)` beyond a rotation-minimizing frame. Let `k` be the trajectory's curvature on that frame's
//! `(w1, w2)`. Then
//!
//! ```text
//!     S         = P + q1 w1 + q2 w2
//!     S_u       = q1_u w1 + q2_u w2
//!     S_s       = (1 - k.q) T + A w1 + B w2,    A = q1_s - phi' q2,    B = q2_s + phi' q1
//!     S_u x S_s = (1 - k.q)(q2_u w1 - q1_u w2) + (q1_u B - q2_u A) T
//! ```
//!
//! So a normal needs the derivatives of the laws and no finite differences. Where a scale of 0 contracts the
//! contour to a point, both `q` and `q_u` vanish. `q_u` is therefore divided by the scale first. The normal
//! there is the limit along the column: that of a cone, or `-T` or `T` on a cap whose scale ends vertically.

mod pole;
mod side;

pub use pole::Pole;
pub(crate) use pole::Signs;

use crate::curve::cut::{Side, Stop};
use crate::frame::Frame;
use crate::law::Law;
use crate::surface::cap::Gathered;
use crate::surface::depth::{Depth, Raised, Relief};
use crate::surface::profile::blend::{Mix, Moving};
use crate::surface::profile::{Blend, Column};
use crate::trajectory::{Station, Trajectory};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// A side whose direction is shortened to less than this fraction lies along an axis that is pressed flat.
const PRESSED: f64 = 1e-9;

/// The laws by which a contour changes. A law that is `None` leaves the contour unchanged.
#[derive(Debug, Clone, Default)]
pub struct Modulation {
    /// Positions of the contours on the trajectory, if there are several.
    pub(crate) blend: Option<Blend>,
    /// Factors of the contour's x and y. At each position both have the same sign, or one of them is 0.
    pub(crate) scale: Option<[Law; 2]>,
    /// The poles, where both factors are 0.
    pub(crate) poles: Vec<Pole>,
    /// Turn about the trajectory, in degrees as in the file.
    pub(crate) twist: Option<Law>,
    /// Relief on the contour, before the scale.
    pub(crate) depth: Option<Depth>,
    /// Distance along the outer normal of the finished section, in the unit of length: a side of a wall.
    pub(crate) offset: Option<Law>,
    /// Total turn that closes the surface, as a fraction of a full turn, added evenly on top of the twist.
    pub(crate) turn: f64,
}

/// A contour placed on the trajectory, with all changes that apply there.
#[derive(Debug, Clone)]
pub struct Section {
    station: Station,
    mix: Option<Mix>,
    scale: DVec2,
    /// Derivative of the scale by length of the trajectory, or by radian for a rotation.
    scale_s: DVec2,
    /// At a pole, the signs of the scale's factors on the side of the stop; (1, 1) elsewhere.
    signs: DVec2,
    relief: Option<Relief>,
    /// The offset, and its derivative by length of the trajectory.
    offset: Option<[f64; 2]>,
    /// Length of the trajectory, or angle of a rotation in radians. A derivative by `v` divided by this
    /// number is the derivative by length or angle.
    extent: f64,
    /// On a cap, the contraction of the contour toward the pole.
    gathered: Option<Gathered>,
    /// True if the contour has no scale, relief, blend or contraction.
    plain: bool,
}

/// A point of a section on the frame's axes, with its derivatives.
#[derive(Debug, Clone, Copy)]
struct Local {
    q: DVec2,
    /// Direction of the contour, divided by the scale so that it does not vanish with the scale.
    q_u: DVec2,
    /// Derivative of the point by length of the trajectory, or by radian for a rotation.
    q_s: DVec2,
    /// True if the contour itself folds back here.
    folds: bool,
}

/// A point of a section in space, with all results of one evaluation of the contour.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SectionPoint {
    /// The point, in the unit of length.
    pub point: DVec3,
    /// The unit normal.
    pub normal: DVec3,
    /// Speed of the point along the tangent, per length of the trajectory: see [`Station::stretch`].
    pub stretch: f64,
    /// True if the contour itself folds back here, because its relief is deeper than it is round.
    pub contour_folds: bool,
}

impl Modulation {
    /// Returns the positions inside the trajectory where a row is needed from both sides: the poles. If the
    /// trajectory is `closed`, a pole at 0 is included.
    pub(crate) fn breaks(&self, closed: bool) -> impl Iterator<Item = f64> {
        let inside = move |at: &f64| *at < 1.0 && (closed || *at > 0.0);
        self.poles.iter().map(|pole| pole.at).filter(inside)
    }

    /// Returns the section at a stop of the trajectory.
    #[must_use]
    pub fn section(&self, trajectory: &Trajectory, stop: Stop) -> Section {
        let station = trajectory.station_at(stop);
        // The side before the start of a closed trajectory is its end.
        let stop = match stop {
            Stop { at: 0.0, side: Side::Before } => Stop::before(1.0),
            _ => stop,
        };
        let v = stop.at;
        let extent = trajectory.extent();
        let pace = 1.0 / extent;
        let (degrees, slope) = self.twist.as_ref().map_or((0.0, 0.0), |law| law.on(stop));
        let (turns, rate) = (degrees / 360.0 + self.turn * v, slope / 360.0 + self.turn);
        let station = if turns == 0.0 && rate == 0.0 {
            station
        } else {
            station.turned(turns, rate * TAU * pace)
        };
        let (scale, scale_s) = match &self.scale {
            Some([x, y]) => {
                let ((a, a_v), (b, b_v)) = (x.on(stop), y.on(stop));
                (DVec2::new(a, b), DVec2::new(a_v, b_v) * pace)
            }
            None => (DVec2::ONE, DVec2::ZERO),
        };
        let (scale, signs) = match self.poles.iter().find(|pole| pole.at == v) {
            Some(pole) => (DVec2::ZERO, pole.signs(stop)),
            None => (scale, DVec2::ONE),
        };
        let relief = self.depth.as_ref().map(|depth| depth.at(v));
        let mix = self.blend.as_ref().map(|blend| blend.at(v));
        let offset = self.offset.as_ref().map(|law| {
            let (offset, slope) = law.on(stop);
            [offset, slope * pace]
        });
        let changed = relief.is_some() || mix.is_some() || offset.is_some();
        let plain = self.scale.is_none() && !changed;
        Section {
            station,
            mix,
            scale,
            scale_s,
            signs,
            relief,
            offset,
            extent,
            gathered: None,
            plain,
        }
    }
}

impl Modulation {
    /// Returns the number of cells that resolves all laws and waves,
    /// `[along the trajectory, along the contour]`.
    pub(crate) fn detail(&self) -> [f64; 2] {
        let mut along: f64 = self.laws().map(Law::detail).sum();
        if let Some(twist) = &self.twist {
            let (low, high) = twist.range();
            along += 16.0 * (high - low) / 360.0;
        }
        along += 16.0 * self.turn.abs();
        along += self.blend.as_ref().map_or(0.0, |blend| 8.0 * blend.at.len() as f64);
        let mut around = 0.0_f64;
        for term in self.depth.iter().flat_map(|depth| &depth.terms) {
            along += 8.0 * term.v.abs();
            around += 8.0 * term.u.abs();
        }
        if let Some(heights) = self.depth.as_ref().and_then(|depth| depth.heights.as_ref()) {
            let [u, v] = heights.detail();
            along += v;
            around += u;
        }
        [along, around]
    }

    /// Returns the positions inside the trajectory where the surface may have an edge with one normal.
    pub(crate) fn kinks(&self) -> Vec<f64> {
        let blends = self.blend.iter().flat_map(|blend| &blend.at);
        let inside = blends.copied().filter(|&at| at > 0.0 && at < 1.0);
        self.laws().flat_map(Law::kinks).chain(inside).collect()
    }

    fn laws(&self) -> impl Iterator<Item = &Law> {
        let terms = self.depth.iter().flat_map(|depth| &depth.terms);
        self.scale.iter().flatten().chain(&self.twist).chain(terms.map(|term| &term.along))
    }
}

impl Section {
    /// Returns this section contracted as a cap does, beyond the trajectory's end (`outward` of 1) or before
    /// its start (-1).
    #[must_use]
    pub(crate) fn gathered(self, gathered: Gathered, outward: f64) -> Self {
        let Gathered { part_t, beyond, beyond_t, .. } = gathered;
        // `t` runs in the direction of the trajectory at the end and against it at the start.
        let station = self.station.beyond(outward * beyond, beyond_t);
        let gathered = Gathered { part_t: outward * part_t, ..gathered };
        Self { station, gathered: Some(gathered), plain: false, ..self }
    }

    /// Returns the point of the surface at a column, with its normal, its stretch and its folds.
    pub(crate) fn evaluate(&self, column: &Column) -> SectionPoint {
        if self.plain {
            let (q, q_u) = (column.first.point, column.first.tangent);
            let stretch = self.station.stretch(q);
            return SectionPoint {
                point: self.station.point(q),
                normal: self.station.normal_stretched(q, q_u, stretch),
                stretch,
                contour_folds: false,
            };
        }
        let Local { q, q_u, q_s, folds } = self.local(column);
        let stretch = self.station.stretch(q);
        SectionPoint {
            point: self.station.point(q),
            normal: self.station.normal_of_moving(q, q_u, q_s, stretch),
            stretch,
            contour_folds: folds,
        }
    }

    /// Returns the point of the surface at a column.
    pub(crate) fn point(&self, column: &Column) -> DVec3 {
        self.station.point(self.local_point(column))
    }

    /// Returns the frame that carries the contour's axes.
    pub(crate) fn frame(&self) -> &Frame {
        &self.station.frame
    }

    /// Returns the contour's point at a column, on the axes `(w1, w2)` of the station.
    #[must_use]
    pub fn local_point(&self, column: &Column) -> DVec2 {
        if self.plain { column.first.point } else { self.local(column).q }
    }

    fn local(&self, column: &Column) -> Local {
        let moving = match &self.mix {
            Some(mix) => mix.of(column),
            None => Moving::still(column.first),
        };
        let Raised { point, along, across, folds } = match &self.relief {
            Some(relief) => relief.on(column.u, &moving),
            None => Raised {
                point: moving.local.point,
                along: moving.local.tangent,
                across: moving.across,
                folds: false,
            },
        };
        // The ratio of the two factors. Where both are 0 it is the ratio of their derivatives.
        let leaving = self.signs * self.scale_s.abs();
        let axes = if self.scale == DVec2::ZERO { leaving } else { self.scale };
        let size = axes.abs().max_element();
        let axes = if size == 0.0 { self.signs } else { axes / size };
        let q_s = self.scale_s * point + self.scale * (across / self.extent);
        let mut q_u = axes * along;
        if q_u.length_squared() <= (PRESSED * along.length()).powi(2) {
            // A side along an axis that is pressed flat keeps its direction.
            q_u = self.signs * along;
        }
        let mut local = Local { q: self.scale * point, q_u, q_s, folds };
        if let Some(offset) = self.offset {
            self.move_out(&mut local, offset, column, axes);
        }
        match self.gathered {
            None => local,
            Some(Gathered { center, part, part_t, .. }) => {
                // On the rim `part` is 1, and the lerp gives the section's own point to the last bit.
                let q = center.lerp(local.q, part);
                Local { q, q_s: (local.q - center) * part_t, ..local }
            }
        }
    }

    /// Returns the speed of the point along the tangent, by length of the trajectory: see
    /// [`Station::stretch`].
    pub(crate) fn stretch(&self, column: &Column) -> f64 {
        self.station.stretch(self.local_point(column))
    }
}
