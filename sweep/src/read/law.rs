//! Reads the laws of a spec.

use super::Reader;
use crate::curve::Cubic;
use crate::error::SweepError;
use crate::law::{Ease, Law, is_graph};
use crate::limits::LARGEST;
use crate::spec;
use glam::DVec2;

impl Reader<'_> {
    pub(super) fn law(&self, path: &str, law: &spec::Law) -> Result<Law, SweepError> {
        match law {
            spec::Law::Number(number) => {
                self.number(path, *number)?;
                Ok(Law::constant(*number))
            }
            spec::Law::Total { total } => {
                self.number(&format!("{path}.total"), *total)?;
                Ok(Law::total(*total))
            }
            spec::Law::Keys { keys, ease } => self.keys(&format!("{path}.keys"), keys, *ease),
            spec::Law::Bezier { bezier } => self.graph(&format!("{path}.bezier"), bezier),
        }
    }

    fn keys(&self, path: &str, keys: &[[f64; 2]], ease: Ease) -> Result<Law, SweepError> {
        if keys.is_empty() {
            return Err(self.fault(path, "found no keys, expected at least one"));
        }
        for (i, key) in keys.iter().enumerate() {
            let path = format!("{path}[{i}]");
            self.law_point(&path, key)?;
            if i > 0 && key[0] <= keys[i - 1][0] {
                let message = format!(
                    "found a key at {:?}, expected a position after that of the previous key, {:?}",
                    key[0],
                    keys[i - 1][0]
                );
                return Err(self.fault(&path, message));
            }
        }
        Ok(Law::keys(keys.to_vec(), ease))
    }

    fn graph(&self, path: &str, segments: &[[[f64; 2]; 4]]) -> Result<Law, SweepError> {
        if segments.is_empty() {
            return Err(self.fault(path, "found no segments, expected at least one"));
        }
        let mut cubics = Vec::with_capacity(segments.len());
        for (i, segment) in segments.iter().enumerate() {
            let path = format!("{path}[{i}]");
            for (j, point) in segment.iter().enumerate() {
                self.law_point(&format!("{path}[{j}]"), point)?;
            }
            if i > 0 && segment[0] != segments[i - 1][3] {
                let message = format!(
                    "found {:?}, expected {:?}, where the segment before ends",
                    segment[0],
                    segments[i - 1][3]
                );
                return Err(self.fault(&format!("{path}[0]"), message));
            }
            let cubic = Cubic(segment.map(DVec2::from_array));
            if !is_graph(&cubic) {
                let message = "found a segment that turns back, expected `at` to rise along it";
                return Err(self.fault(&path, message));
            }
            cubics.push(cubic);
        }
        Ok(Law::bezier(cubics))
    }

    /// Checks a point of a law: a position in `[0, 1]` and a number.
    fn law_point(&self, path: &str, point: &[f64; 2]) -> Result<(), SweepError> {
        if !(0.0..=1.0).contains(&point[0]) {
            let message =
                format!("found {:?}, expected a part of the length from 0 to 1", point[0]);
            return Err(self.fault(&format!("{path}[0]"), message));
        }
        self.number(&format!("{path}[1]"), point[1])
    }

    /// Checks that the size of a number is at most [`LARGEST`].
    pub(super) fn number(&self, path: &str, number: f64) -> Result<(), SweepError> {
        if number.abs() <= LARGEST {
            return Ok(());
        }
        let message = format!("found {number:?}, expected a number of at most {LARGEST:?}");
        Err(self.fault(path, message))
    }
}
