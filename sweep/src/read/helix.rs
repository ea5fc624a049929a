//! Reads a helix, whose radius and rise may be laws.

use super::Reader;
use crate::curve::turn;
use crate::error::SweepError;
use crate::frame::Frame;
use crate::law::Heights;
use crate::spec;
use crate::trajectory::{Course, Helix};
use glam::DVec3;
use std::f64::consts::TAU;

/// Largest number of turns of a helix, which leaves enough digits for the position within a turn.
const MOST_TURNS: f64 = 1e6;

/// Most pieces of a helix whose laws change.
const MOST_PIECES: f64 = 4096.0;

impl Reader<'_> {
    pub(super) fn helix(
        &self,
        path: &str,
        helix: &spec::Helix,
        start: Option<&[f64; 3]>,
    ) -> Result<Course, SweepError> {
        let radius = self.law(&format!("{path}.radius"), &helix.radius)?;
        let rise = self.law(&format!("{path}.rise"), &helix.rise)?;
        self.positive(&format!("{path}.radius"), radius.range().0)?;
        self.number(&format!("{path}.start_deg"), helix.start_deg)?;
        if helix.turns == 0.0 || helix.turns.abs() > MOST_TURNS {
            let message = format!(
                "found {:?}, expected turns other than 0 and at most {MOST_TURNS:?}",
                helix.turns
            );
            return Err(self.fault(&format!("{path}.turns"), message));
        }
        self.point(&format!("{path}.center"), &helix.center)?;
        let center = DVec3::from_array(helix.center);
        let start = self.upright(path, center, helix.axis, start)?;
        // The frame's own direction about the axis, from w1 toward T, is left-handed.
        let turned = turn(-helix.start_deg / 360.0);
        let start = Frame {
            normal: start.normal * turned.x + start.tangent * turned.y,
            tangent: start.tangent * turned.x - start.normal * turned.y,
            ..start
        };
        let turns = -helix.turns;
        if let (spec::Law::Number(radius), spec::Law::Number(rise)) = (&helix.radius, &helix.rise) {
            return Ok(Course::Helix(Helix { start, radius: *radius, rise: *rise, turns }));
        }
        let heights = Heights::new(&rise, turns.abs());
        let at = |v: f64| {
            let angle = turn(turns * v);
            let outward = start.normal * angle.x + start.tangent * angle.y;
            let around = (start.tangent * angle.x - start.normal * angle.y) * (TAU * turns);
            let (r, slope) = radius.at(v);
            let (height, climb) = heights.at(v);
            let point = center + outward * r + start.binormal * height;
            [point, outward * slope + around * r + start.binormal * climb]
        };
        let pieces = (8.0 * turns.abs()).ceil().min(MOST_PIECES) as usize;
        let evenly = (0..=pieces).map(|i| i as f64 / pieces as f64);
        let mut ends: Vec<f64> = evenly.chain(radius.kinks()).chain(rise.kinks()).collect();
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        self.computed(path, at, &ends, false, "a fraction of the turns")
    }
}
