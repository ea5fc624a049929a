//! Vessels: the open profile of a rotation, given a thickness.
//!
//! The outline of the wall runs along the outer side, over the rim at an end that is not on the axis, and returns along the
//! inner side. A profile with both ends on the axis has two outlines, the outer side and a closed hollow. Each side is
//! the profile moved along its normals; see [`offset`]. Where a moved side crosses itself (inside corners, and where it
//! bends more tightly than the distance) the loop is cut off; see [`trim`].
//!
//! | module     | what                                                   |
//! |------------|--------------------------------------------------------|
//! | [`offset`] | a profile moved along its normals, corner by corner    |
//! | [`trim`]   | loops of a chain of cubics cut off                     |

pub mod offset;
pub mod trim;

use crate::curve::cut::Stop;
use crate::curve::{Cubic, Path, hermite, turn};
use crate::law::Law;
use crate::surface::contour::Contour;
use glam::DVec2;
use std::f64::consts::PI;

/// Samples of each piece of a profile for its curvature.
const SAMPLES: usize = 16;

/// A wall up to this multiple of the radius counts as thin enough: rounding of drawn arcs is smaller.
const TIGHT: f64 = 1.001;

/// Shape of a rim.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rim {
    /// A straight line.
    Flat,
    /// A half circle.
    Round,
}

/// The wall of a vessel.
#[derive(Debug, Clone)]
pub struct Vessel<'a> {
    /// The profile: open, with x of at least 0, outside to the right of its direction.
    pub profile: &'a Contour,
    /// Thickness along the profile.
    pub thickness: &'a Law,
    /// Thickness from each end on the axis to the first corner, if it differs.
    pub floor: Option<f64>,
    /// Parts of the thickness outside and inside the profile, which add up to 1.
    pub parts: [f64; 2],
    /// Shape of the rims.
    pub rim: Rim,
    /// Points with at most this x lie on the axis.
    pub on_axis: f64,
}

/// An outline of a wall.
#[derive(Debug, Clone)]
pub struct Outline {
    /// The outline, with the wall to the left of its direction.
    pub path: Path<DVec2>,
    /// The part that is the outer side, as fractions of the length; `None` for a hollow.
    pub face: Option<[f64; 2]>,
}

/// A bend of a profile that is tighter than the wall on its inner side is thick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TightBend {
    /// The point of the profile.
    pub point: DVec2,
    /// Radius of curvature there.
    pub radius: f64,
    /// Thickness of the wall on the inner side of the bend, more than the radius.
    pub thickness: f64,
}

/// A reason why a profile has no wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fault {
    /// The wall is thicker than the vessel is wide at this height.
    Fills(f64),
    /// The moved side has more pieces than are searched for crossings.
    Long(usize),
    /// A moved side has no length.
    Empty,
}

impl Vessel<'_> {
    /// Returns the outlines of the wall: one, or two if both ends are on the axis.
    ///
    /// # Errors
    /// The reason why there is no wall.
    pub fn outlines(&self) -> Result<Vec<Outline>, Fault> {
        let [outer, inner] = [self.side(self.parts[0])?, self.side(-self.parts[1])?];
        let [starts, ends] = self.on_axis();
        let backward = |chain: &[Cubic<DVec2>]| -> Vec<Cubic<DVec2>> {
            chain.iter().rev().map(Cubic::reversed).collect()
        };
        if starts && ends {
            let one = |chain: &[Cubic<DVec2>], face| {
                let path = Path::new(chain, false).ok_or(Fault::Empty)?;
                Ok(Outline { path, face })
            };
            return Ok(vec![one(&outer, Some([0.0, 1.0]))?, one(&backward(&inner), None)?]);
        }
        let first = |chain: &[Cubic<DVec2>]| chain[0].0[0];
        let last = |chain: &[Cubic<DVec2>]| chain[chain.len() - 1].0[3];
        let (mut before, mut after) = (Vec::new(), Vec::new());
        if ends {
            before.extend(backward(&inner));
            before.extend(self.rim([first(&inner), first(&outer)]));
        } else {
            after.extend(self.rim([last(&outer), last(&inner)]));
            after.extend(backward(&inner));
            if !starts {
                after.extend(self.rim([first(&inner), first(&outer)]));
            }
        }
        let count = [before.len(), before.len() + outer.len()];
        let chain: Vec<Cubic<DVec2>> = before.into_iter().chain(outer).chain(after).collect();
        let closed = !starts && !ends;
        let mut chain = joined(chain);
        if closed {
            let start = first(&chain);
            if let Some(end) = chain.last_mut() {
                end.0[3] = start;
            }
        }
        let path = Path::new(&chain, closed).ok_or(Fault::Empty)?;
        let length = |until: usize| Path::new(&chain[..until], false).map_or(0.0, |p| p.length());
        let face = count.map(|until| (length(until) / path.length()).min(1.0));
        Ok(vec![Outline { path, face: Some(face) }])
    }

    /// Returns whether the start and the end of the profile lie on the axis.
    #[must_use]
    pub fn on_axis(&self) -> [bool; 2] {
        [Stop::after(0.0), Stop::before(1.0)]
            .map(|stop| self.profile.at(stop).point.x <= self.on_axis)
    }

    /// Returns the bend that is tightest in proportion to the wall, if one is tighter than the wall is thick. There, a
    /// side of the wall crosses itself, and its loop is cut off.
    #[must_use]
    pub fn tightest(&self) -> Option<TightBend> {
        let breaks = self.profile.breaks();
        let [starts, ends] = self.on_axis();
        let knots = [0.0].into_iter().chain(self.profile.knots()).chain([1.0]).collect::<Vec<_>>();
        let parts = (0..=SAMPLES).map(|i| i as f64 / SAMPLES as f64);
        let stops = knots.windows(2).flat_map(|span| {
            parts.clone().map(|part| span[0] + (span[1] - span[0]) * part).collect::<Vec<_>>()
        });
        let bend = |u: f64| {
            let here = self.profile.at(Stop::after(u));
            let in_floor = breaks.first().is_some_and(|at| starts && u < *at)
                || breaks.last().is_some_and(|at| ends && u > *at);
            let whole = self.floor.filter(|_| in_floor).unwrap_or_else(|| self.thickness.at(u).0);
            // A profile that turns to the left is hollow on its inner side.
            let part = if here.curvature > 0.0 { self.parts[1] } else { self.parts[0] };
            let (thickness, radius) = (part * whole, 1.0 / here.curvature.abs());
            TightBend { point: here.point, radius, thickness }
        };
        let tight = stops.map(bend).filter(|bend| bend.thickness > bend.radius * TIGHT);
        tight.max_by(|a, b| (a.thickness / a.radius).total_cmp(&(b.thickness / b.radius)))
    }

    /// Returns a side of the wall, at a part of the thickness from the profile.
    fn side(&self, part: f64) -> Result<Vec<Cubic<DVec2>>, Fault> {
        let chain = offset::moved(self, part);
        let chain = trim::without_loops(chain)?;
        let chain = trim::right_of_axis(chain, self.on_axis(), self.on_axis)?;
        if chain.is_empty() { Err(Fault::Empty) } else { Ok(joined(chain)) }
    }

    /// Returns the rim from one side to the other; the wall lies to the left.
    fn rim(&self, [from, to]: [DVec2; 2]) -> Vec<Cubic<DVec2>> {
        match self.rim {
            Rim::Flat => vec![Cubic::line(from, to)],
            Rim::Round => arc(0.5 * (from + to), 0.5 * (from - to).length(), from - to, PI),
        }
    }
}

/// Returns a chain whose pieces meet to the last bit.
fn joined(mut chain: Vec<Cubic<DVec2>>) -> Vec<Cubic<DVec2>> {
    for i in 1..chain.len() {
        chain[i].0[0] = chain[i - 1].0[3];
    }
    chain
}

/// Returns cubics along an arc about a center, from a direction, over an angle in radians.
pub(super) fn arc(center: DVec2, radius: f64, from: DVec2, angle: f64) -> Vec<Cubic<DVec2>> {
    let Some(from) = from.try_normalize() else { return Vec::new() };
    let at = |t: f64| {
        let direction = turn(t * angle / (2.0 * PI)).rotate(from);
        let slope = direction.perp() * (radius * angle);
        [(center + direction * radius).extend(0.0), slope.extend(0.0)]
    };
    let pieces = (angle.abs() / 0.4).ceil().max(1.0) as usize;
    hermite::between(at, &[0.0, 1.0], pieces, offset::NEAR)
        .unwrap_or_default()
        .into_iter()
        .map(|cubic| Cubic(cubic.0.map(glam::DVec3::truncate)))
        .collect()
}
