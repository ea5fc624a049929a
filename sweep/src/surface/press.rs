//! An end that a scale of 0 on one axis presses to a line, as at the edge of a chisel.
//!
//! Opposite columns of a section meet there, and are one. A contour that is symmetric about the pressed axis has columns
//! opposite each other if they are placed symmetrically. The symmetry takes `u` to `u0 - u`, as a mirrored seam does.

use crate::curve::cut::{Side, Stop};
use crate::surface::closing::{Closing, SAMPLES};
use crate::surface::profile::Profile;
use glam::{DVec2, DVec3};

/// Points of a pressed row that are at most this fraction of its size apart are one point.
const ONE: f64 = 1e-9;

/// Points of a symmetric contour and their images differ by at most this fraction of the contour's size.
const SAME: f64 = 1e-6;

/// Bisections of a crossing of the axis.
const STEPS: usize = 60;

/// Most crossings of the axis that are tried as the middle of the symmetry.
const MOST_ZEROS: usize = 16;

/// Denominator of the position of the symmetry, which is far finer than positions that are one.
const FINE: usize = 1 << 40;

/// The ends that are pressed to a line, and the symmetry of the contour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Press {
    /// True for a start and an end that is pressed.
    pub(crate) ends: [bool; 2],
    /// The `u` that corresponds to each `u`.
    pub(crate) symmetry: Closing,
}

impl Press {
    /// Returns the press of a contour, whose points are mirrored by two factors of 1 or -1; `None` if the contour is not
    /// symmetric.
    pub(crate) fn of(contour: &Profile, mirror: DVec2, ends: [bool; 2]) -> Option<Self> {
        let point = |u: f64| contour.at(u.rem_euclid(1.0) % 1.0).first.point;
        // Height above the axis of symmetry.
        let height = |u: f64| if mirror.x < 0.0 { point(u).x } else { point(u).y };
        let us = (0..=SAMPLES).map(|i| i as f64 / SAMPLES as f64);
        let mut us: Vec<f64> = us.chain(contour.breaks().iter().copied()).collect();
        us.sort_by(f64::total_cmp);
        let size = us.iter().map(|&u| point(u).length()).fold(0.0, f64::max);
        let zeros = us.windows(2).filter_map(|ends| {
            let (mut low, mut high) = (ends[0], ends[1]);
            let sign = height(low) > 0.0;
            if height(low).abs() <= ONE * size {
                return Some(low);
            }
            if (height(high) > 0.0) == sign {
                return None;
            }
            for _ in 0..STEPS {
                let middle = 0.5 * (low + high);
                if (height(middle) > 0.0) == sign { low = middle } else { high = middle }
            }
            Some(high)
        });
        zeros.take(MOST_ZEROS).find_map(|zero| {
            let offset = (2.0 * zero).rem_euclid(1.0) % 1.0;
            let alike =
                us.iter().all(|&u| (point(offset - u) - point(u) * mirror).length() <= SAME * size);
            let offset = ((offset * FINE as f64).round() as usize % FINE, FINE);
            let symmetry = Closing { mirrored: true, offset, turn: 0.0, edge: false };
            let fits = alike
                && symmetry
                    .seam(&Self::columns(symmetry, contour, 0), contour.breaks(), true)
                    .is_some();
            fits.then_some(Self { ends, symmetry })
        })
    }

    fn columns(symmetry: Closing, contour: &Profile, cells: usize) -> Vec<Stop> {
        let anchors = symmetry.anchors(contour.breaks(), true);
        crate::curve::cut::between(
            contour.breaks(),
            true,
            cells.max(contour.fewest_cells()),
            &anchors,
        )
    }

    /// Returns whether the row at a stop is pressed.
    pub(crate) fn at(&self, stop: Stop) -> bool {
        self.ends[0] && stop.at == 0.0 && stop.side == Side::After
            || self.ends[1] && stop.at == 1.0 && stop.side == Side::Before
    }

    /// Makes opposite points of a pressed row equal to the last bit.
    pub(crate) fn join(&self, stops: &[Stop], breaks: &[f64], points: &mut [DVec3]) {
        let Some((seam, shift)) = self.symmetry.seam(stops, breaks, true) else { return };
        let size = points.iter().map(|point| point.distance(points[0])).fold(0.0, f64::max);
        for col in 1..points.len() {
            // A side along the pressed axis becomes one point.
            if points[col].distance(points[col - 1]) <= ONE * size {
                points[col] = points[col - 1];
            }
        }
        for col in 0..points.len() {
            let other = seam.leads_to(col, shift, points.len());
            if other < col {
                points[col] = points[other];
            }
        }
    }
}
