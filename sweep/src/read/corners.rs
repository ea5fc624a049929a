//! Reads the corners of a spec's trajectory: refused, rounded or mitred.

use super::Reader;
use super::joints::{corners_of, described};
use crate::curve::path::Joint;
use crate::curve::vector::angle_between;
use crate::curve::{Cubic, Curve3, Path};
use crate::error::SweepError;
use crate::spec::{Bezier, Bezier3, Corners, Measured};
use crate::trajectory::Course;
use glam::DVec3;

/// Two legs of a hairpin coincide if, at the cuts, their distance is at most this fraction of the cut's
/// length.
const ON_EACH_OTHER: f64 = 1e-9;

/// Rounding error of lengths along a trajectory, as a fraction of the whole length.
const ROUNDING: f64 = 1e-12;

/// A segment is straight if its control points are at most this fraction of its length off its chord.
const STRAIGHT: f64 = 1e-9;

impl Reader<'_> {
    pub(super) fn bezier3(&self, path: &str, bezier: &Bezier3) -> Result<Course, SweepError> {
        let curve = Bezier { closed: bezier.closed, segments: bezier.segments.clone() };
        let curve = self.bezier(path, &curve)?;
        let path_of = |segment| format!("{path}.segments[{segment}]");
        Ok(self.cornered(path, curve, bezier.corners, path_of)?.0)
    }

    pub(super) fn polyline3(
        &self,
        path: &str,
        line: &Measured,
    ) -> Result<(Course, Vec<[f64; 2]>), SweepError> {
        if line.fit.is_some() {
            let message = "found a fit of straight lines, expected none, or a `free` curve";
            return Err(self.fault(&format!("{path}.fit"), message));
        }
        let curve = self.polyline(path, &Self::plain(line))?;
        let path_of = |segment| format!("{path}.points[{segment}]");
        self.cornered(path, curve, line.corners, path_of)
    }

    fn cornered(
        &self,
        path: &str,
        curve: Path<DVec3>,
        corners: Option<Corners>,
        path_of: impl Fn(usize) -> String,
    ) -> Result<(Course, Vec<[f64; 2]>), SweepError> {
        let path = format!("{path}.corners");
        let found: Vec<Joint> = corners_of(&curve).collect();
        match corners {
            Some(Corners::Round(cut)) => {
                self.positive(&format!("{path}.round"), cut)?;
                self.rounded(&path, curve, &found, cut, path_of)
            }
            Some(Corners::Mitre(limit)) => {
                if limit < 1.0 {
                    let message = format!("found {limit:?}, expected a limit of at least 1");
                    return Err(self.fault(&format!("{path}.mitre"), message));
                }
                for joint in &found {
                    self.mitre(&curve, joint, limit, &path_of)?;
                }
                Ok((Course::Path(curve), Vec::new()))
            }
            None => match found.first() {
                None => Ok((Course::Path(curve), Vec::new())),
                Some(joint) => {
                    let message = format!(
                        "found {}, expected a trajectory that bends smoothly, or `corners`: \
                         {{\"round\": length}} or {{\"mitre\": limit}}",
                        described(joint)
                    );
                    Err(self.geometry(&path_of(joint.sources[1]), message))
                }
            },
        }
    }

    /// Refuses a corner that cannot be mitred.
    fn mitre(
        &self,
        curve: &Path<DVec3>,
        joint: &Joint,
        limit: f64,
        path_of: impl Fn(usize) -> String,
    ) -> Result<(), SweepError> {
        let straight =
            [joint.before, joint.after].iter().all(|&at| curve.cubic(at).is_straight(STRAIGHT));
        // The ratio is rounded up, so that the user can copy it into the spec as the limit.
        let needed = (1e3 / (0.5 * joint.angle).cos().max(0.0)).ceil() / 1e3;
        let expected = if !straight {
            "straight segments on both sides for a mitre; use `round`".to_owned()
        } else if needed > 1e6 {
            "a blunter corner for a mitre; use `round`".to_owned()
        } else if 1.0 / (0.5 * joint.angle).cos() > limit {
            format!(
                "a mitre of at most {limit:?}, where this corner needs {needed:?}; or use `round`"
            )
        } else {
            return Ok(());
        };
        let message = format!("found {}, expected {expected}", described(joint));
        Err(self.geometry(&path_of(joint.sources[1]), message))
    }

    /// Returns the curve with its corners cut off and bridged by cubics, and pairs of arc lengths before and after that. A
    /// corner between short legs is cut by half of the shorter one.
    fn rounded(
        &self,
        path: &str,
        curve: Path<DVec3>,
        corners: &[Joint],
        asked: f64,
        path_of: impl Fn(usize) -> String,
    ) -> Result<(Course, Vec<[f64; 2]>), SweepError> {
        let length = curve.length();
        let rounding = ROUNDING * length;
        let mut ends: Vec<f64> = corners.iter().map(|joint| joint.s).collect();
        if ends.first() != Some(&0.0) {
            ends.insert(0, 0.0);
        }
        ends.push(length);
        let corner_at = |s: f64| {
            let s = if s == length && curve.closed() { 0.0 } else { s };
            corners.binary_search_by(|joint| joint.s.total_cmp(&s)).ok()
        };
        let cuts: Vec<f64> = corners
            .iter()
            .map(|joint| {
                let next = ends.partition_point(|&end| end <= joint.s);
                let after = ends[next] - joint.s;
                let before = if joint.s > 0.0 {
                    joint.s - ends[next - 2]
                } else {
                    length - ends[ends.len() - 2]
                };
                asked.min(0.5 * before).min(0.5 * after)
            })
            .collect();
        let cut_at = |s: f64| corner_at(s).map_or(0.0, |corner| cuts[corner]);
        let mut cubics = Vec::new();
        // Arc lengths of the given curve at the ends of the cubics, and in the middle of those that round a corner.
        let mut given: Vec<(f64, Option<f64>)> = Vec::new();
        for leg in ends.windows(2) {
            let (from, to) = (leg[0], leg[1]);
            let (first, last) = (from + cut_at(from), to - cut_at(to));
            // Two cuts may leave no length between them.
            if last - first > rounding {
                let part = curve.part(first, last);
                let count = part.len();
                given.extend(
                    (1..=count).map(|i| (first + (last - first) * i as f64 / count as f64, None)),
                );
                cubics.extend(part);
            }
            if let Some(corner) = corner_at(to) {
                let (joint, cut) = (&corners[corner], cuts[corner]);
                let (a, b) = (curve.at(last), curve.at(to % length + cut));
                let chord = (b.position - a.position).length();
                if chord <= ON_EACH_OTHER * cut {
                    let message = format!(
                        "found {} whose legs lie on each other, expected an angle between the \
                         legs, so that an arc fits",
                        described(joint)
                    );
                    return Err(self.geometry(&path_of(joint.sources[1]), message));
                }
                // The length of the handles of a circular arc's cubic.
                let turn = angle_between(a.tangent, b.tangent);
                let handle = chord / (3.0 * (0.25 * turn).cos().powi(2));
                let (p, q) = (a.position, b.position);
                cubics.push(Cubic([p, p + a.tangent * handle, q - b.tangent * handle, q]));
                given.push((to + cut, Some(to)));
            }
        }
        let curve = self.path(path, &cubics, curve.closed())?;
        let left = corners_of(&curve).next();
        let mut marks = vec![[cut_at(0.0), 0.0]];
        for (ends, (to, middle)) in curve.knots().windows(2).zip(given) {
            marks.extend(middle.map(|middle| [middle, 0.5 * (ends[0] + ends[1])]));
            marks.push([to, ends[1]]);
        }
        match left {
            None => Ok((Course::Path(curve), marks)),
            Some(joint) => {
                let message = format!(
                    "found {:.1} degrees left at a rounded corner, expected a shorter or a longer \
                     cut",
                    joint.angle.to_degrees()
                );
                Err(self.geometry(&format!("{path}.round"), message))
            }
        }
    }
}
