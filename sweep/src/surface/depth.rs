//! Depth modulation: a relief on the contour, from waves along both directions of the surface and from a
//! picture of heights.
//!
//! The thesis names depth modulation without defining it; this definition is ours. With
//!
//! ```text
//!     delta(u, v) = sum of amp * along(v) * sin(2 pi (m u + n v) + phase)
//! ```
//!
//! and the heights of the picture added to `delta`, a *factor* changes the contour `C` into `(1 + delta) C`.
//! An *offset* changes it into `C + delta n`, where `n` is its outer normal. The relief belongs to the
//! contour, so scale and twist act on the contour with its relief. Where a relief fades, `delta` is multiplied by a factor
//! of `u`; see [`fade`](crate::surface::fade).

use crate::curve::turn;
use crate::law::Law;
use crate::surface::contour::Local2;
use crate::surface::fade::{Cover, Covered};
use crate::surface::height::HeightMap;
use crate::surface::profile::blend::Moving;
use glam::DVec2;
use std::f64::consts::TAU;
use std::sync::Arc;

/// A relief on a contour, checked against the contour.
#[derive(Debug, Clone)]
pub struct Depth {
    /// How `delta` changes the contour.
    pub(crate) mode: Mode,
    /// The waves that add up to `delta`.
    pub(crate) terms: Vec<Term>,
    /// Heights from a picture, added to the waves.
    pub(crate) heights: Option<Arc<HeightMap>>,
    /// The covered part of the contour, and where the relief fades; all of it if `None`.
    pub(crate) cover: Option<Arc<Cover>>,
}

/// How `delta` changes the contour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// The contour is multiplied by `1 + delta`.
    Factor,
    /// The contour is moved along its outer normal by `delta`.
    Offset,
}

/// One wave of a relief.
#[derive(Debug, Clone)]
pub struct Term {
    /// Amplitude of the wave, before its law; a length for an offset.
    pub(crate) amp: f64,
    /// Number of waves along the contour.
    pub(crate) u: f64,
    /// Number of waves along the trajectory.
    pub(crate) v: f64,
    /// Phase at the start of both curves, as a fraction of a turn.
    pub(crate) phase: f64,
    /// Factor of the amplitude along the trajectory.
    pub(crate) along: Law,
}

/// A relief at one position of the trajectory.
#[derive(Debug, Clone)]
pub struct Relief {
    mode: Mode,
    waves: Vec<Wave>,
    heights: Option<Arc<HeightMap>>,
    cover: Option<Arc<Cover>>,
    v: f64,
}

/// A wave at one position of the trajectory.
#[derive(Debug, Clone, Copy)]
struct Wave {
    /// Number of waves along the contour.
    u: f64,
    /// Phase as a fraction of a turn.
    phase: f64,
    /// Derivative of the phase by `v`, in radians.
    phase_v: f64,
    /// Amplitude with its law.
    height: f64,
    /// Derivative of the amplitude by `v`.
    height_v: f64,
}

/// A point of a contour with its relief, and its derivatives.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Raised {
    pub point: DVec2,
    /// Derivative of the point by length of the contour without its relief.
    pub along: DVec2,
    /// Derivative of the point by `v`.
    pub across: DVec2,
    /// True if the contour folds back on itself here.
    pub folds: bool,
}

impl Depth {
    /// Returns an upper bound of `|delta|`.
    #[must_use]
    pub fn most(&self) -> f64 {
        let heights = self.heights.as_ref().map_or(0.0, |heights| heights.most());
        self.waves() + heights
    }

    /// Returns bounds of `delta`.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        let [low, high] = self.heights.as_ref().map_or([0.0; 2], |heights| heights.range());
        [low - self.waves(), high + self.waves()]
    }

    /// Returns an upper bound of the size of the waves.
    fn waves(&self) -> f64 {
        let most = |term: &Term| {
            let (low, high) = term.along.range();
            term.amp.abs() * low.abs().max(high.abs())
        };
        self.terms.iter().map(most).sum::<f64>()
    }

    /// Returns the relief at `v`, a fraction of the trajectory's length.
    #[must_use]
    pub fn at(&self, v: f64) -> Relief {
        let wave = |term: &Term| {
            let (height, height_v) = term.along.at(v);
            Wave {
                u: term.u,
                phase: term.v * v + term.phase,
                phase_v: TAU * term.v,
                height: term.amp * height,
                height_v: term.amp * height_v,
            }
        };
        let waves = self.terms.iter().map(wave).collect();
        let (heights, cover) = (self.heights.clone(), self.cover.clone());
        Relief { mode: self.mode, waves, heights, cover, v }
    }
}

impl Relief {
    /// Returns the contour's point at `u` with the relief on it.
    pub(crate) fn on(&self, u: f64, moving: &Moving) -> Raised {
        let Moving { local, across, turning } = *moving;
        let Local2 { point, tangent, curvature, pace } = local;
        let covered = self.cover.as_ref().map(|cover| cover.at(u));
        if covered == Some(None) {
            return Raised { point, along: tangent, across, folds: false };
        }
        let covered = covered.flatten();
        let u = covered.map_or(u, |covered| covered.u);
        let (mut delta, mut delta_u, mut delta_v) = (0.0, 0.0, 0.0);
        for wave in &self.waves {
            let angle = turn(wave.u * u + wave.phase);
            delta += wave.height * angle.y;
            delta_u += wave.height * angle.x * (TAU * wave.u);
            delta_v += wave.height_v * angle.y + wave.height * angle.x * wave.phase_v;
        }
        if let Some(heights) = &self.heights {
            let [height, by_u, by_v] = heights.at(u, self.v);
            delta += height;
            delta_u += by_u;
            delta_v += by_v;
        }
        if let Some(Covered { rate, factor, factor_u, .. }) = covered {
            delta_u = factor * delta_u * rate + factor_u * delta;
            delta_v *= factor;
            delta *= factor;
        }
        match self.mode {
            Mode::Factor => Raised {
                point: point * (1.0 + delta),
                along: tangent * (1.0 + delta) + point * (delta_u * pace),
                across: point * delta_v + across * (1.0 + delta),
                folds: false,
            },
            Mode::Offset => {
                // The normal points out of a counter-clockwise contour, whose curvature is above 0 at a
                // bulge. It turns with the tangent.
                let normal = -tangent.perp();
                let stretch = 1.0 + delta * curvature;
                Raised {
                    point: point + normal * delta,
                    along: tangent * stretch + normal * (delta_u * pace),
                    across: normal * delta_v + across + tangent * (delta * turning),
                    folds: stretch < 0.0,
                }
            }
        }
    }
}
