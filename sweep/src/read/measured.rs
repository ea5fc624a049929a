//! Reads trajectories through points that have numbers of their own, and trajectories given by formulas.

use super::Reader;
use crate::curve::arc_length::ArcLength;
use crate::curve::formula::Formula;
use crate::curve::vector::extent;
use crate::curve::{Cubic, Curve3, Path, fit, hermite};
use crate::error::SweepError;
use crate::law::{Ease, Law};
use crate::spec::{self, FormulaCurve, Free, Measured, Spec};
use crate::trajectory::Course;
use glam::{DVec2, DVec3};

/// Consecutive points at most this fraction of the curve apart are one point.
const COINCIDENT: f64 = 1e-12;

/// Ends of a closed formula meet if they are at most this fraction of the curve apart.
const MEETS: f64 = 1e-6;

/// The laws that the numbers at the points of a trajectory give.
#[derive(Debug, Default)]
pub(super) struct PointLaws {
    pub scale: Option<[Law; 2]>,
    pub twist: Option<Law>,
}

impl Reader<'_> {
    /// Returns the points of a measured curve alone.
    pub(super) fn plain(measured: &Measured) -> Free<[f64; 3]> {
        Free { closed: measured.closed, points: measured.points.clone() }
    }

    /// Reads a smooth curve through points.
    pub(super) fn free3(
        &self,
        path: &str,
        measured: &Measured,
    ) -> Result<(Course, Vec<[f64; 2]>), SweepError> {
        if measured.corners.is_some() {
            let message = "found corners of a smooth curve, expected none, or a `polyline`";
            return Err(self.fault(&format!("{path}.corners"), message));
        }
        let Some(tolerance) = measured.fit else {
            let curve = self.free(path, &Self::plain(measured))?;
            self.smooth(&curve, path)?;
            return Ok((Course::Path(curve), Vec::new()));
        };
        self.positive(&format!("{path}.fit"), tolerance)?;
        let points: Vec<DVec3> = self.distinct(path, &Self::plain(measured))?;
        let fit = fit::smooth(&points, measured.closed, tolerance);
        let curve = self.path(path, &fit.cubics, measured.closed)?;
        self.smooth(&curve, path)?;
        let marks = passed(&points, measured.closed, &fit);
        Ok((Course::Path(curve), marks))
    }

    /// Reads the numbers at the points of a trajectory, if there are any. `marks` are pairs of arc lengths: of the curve
    /// through the points, and of the trajectory.
    pub(super) fn point_laws(
        &self,
        spec: &Spec,
        course: &Course,
        marks: &[[f64; 2]],
    ) -> Result<PointLaws, SweepError> {
        let (path, measured, smooth) = match &spec.trajectory {
            spec::Trajectory::Polyline(line) => ("trajectory.polyline", line, false),
            spec::Trajectory::Free(free) => ("trajectory.free", free, true),
            _ => return Ok(PointLaws::default()),
        };
        let count = measured.points.len();
        let fits = |key: &str, length: Option<usize>| match length {
            Some(found) if found != count => {
                let message =
                    format!("found {found} numbers, expected {count}, one for each point");
                Err(self.fault(&format!("{path}.{key}"), message))
            }
            _ => Ok(()),
        };
        fits("radii", measured.radii.as_ref().map(Vec::len))?;
        fits("scales", measured.scales.as_ref().map(Vec::len))?;
        fits("twists", measured.twists.as_ref().map(Vec::len))?;
        for (first, second, both) in [
            ("radii", "scales", measured.radii.is_some() && measured.scales.is_some()),
            ("radii", "scale", measured.radii.is_some() && spec.scale.is_some()),
            ("scales", "scale", measured.scales.is_some() && spec.scale.is_some()),
            ("twists", "twist", measured.twists.is_some() && spec.twist.is_some()),
        ] {
            if both {
                let message = format!("found `{first}` beside `{second}`, expected one of the two");
                return Err(self.fault(&format!("{path}.{first}"), message));
            }
        }
        let law = |key: &str, of: &dyn Fn(usize) -> f64| {
            for i in 0..count {
                self.number(&format!("{path}.{key}[{i}]"), of(i))?;
            }
            Ok::<Law, SweepError>(self.law_at(measured, course, marks, smooth, of))
        };
        let mut laws = PointLaws::default();
        if let Some(radii) = &measured.radii {
            for (i, radius) in radii.iter().enumerate() {
                self.positive(&format!("{path}.radii[{i}]"), *radius)?;
            }
            let law = law("radii", &|i| radii[i])?;
            laws.scale = Some([law.clone(), law]);
        }
        if let Some(scales) = &measured.scales {
            laws.scale =
                Some([law("scales", &|i| scales[i][0])?, law("scales", &|i| scales[i][1])?]);
        }
        if let Some(twists) = &measured.twists {
            laws.twist = Some(law("twists", &|i| twists[i])?);
        }
        Ok(laws)
    }

    /// Returns the law with a number at each point of a trajectory.
    fn law_at(
        &self,
        measured: &Measured,
        course: &Course,
        marks: &[[f64; 2]],
        smooth: bool,
        of: &dyn Fn(usize) -> f64,
    ) -> Law {
        let points: Vec<DVec3> = measured.points.iter().map(|&p| DVec3::from_array(p)).collect();
        let narrow = COINCIDENT * extent(points.iter().copied());
        let mut kept: Vec<usize> = Vec::with_capacity(points.len());
        for i in 0..points.len() {
            if kept.last().is_none_or(|&last| points[last].distance(points[i]) > narrow) {
                kept.push(i);
            }
        }
        let returns = points[kept[0]].distance(points[kept[kept.len() - 1]]) <= narrow;
        if measured.closed && kept.len() > 1 && returns {
            kept.pop();
        }
        let length = course.length();
        let at: Vec<f64> = if marks.is_empty() {
            course.knots().iter().map(|s| s / length).collect()
        } else {
            let mut done = 0.0;
            let ahead = kept.iter().skip(1).chain(measured.closed.then(|| &kept[0]));
            let steps = kept.iter().zip(ahead).map(|(&a, &b)| points[a].distance(points[b]));
            let sums = steps.map(|step| {
                done += step;
                done
            });
            let olds: Vec<f64> = std::iter::once(0.0).chain(sums).collect();
            olds.into_iter().map(|old| between(marks, old) / length).collect()
        };
        let mut keys: Vec<[f64; 2]> = kept.iter().zip(&at).map(|(&i, &at)| [at, of(i)]).collect();
        if measured.closed {
            keys.push([1.0, of(kept[0])]);
        }
        if let Some(last) = keys.last_mut() {
            last[0] = 1.0;
        }
        keys.dedup_by(|later, earlier| later[0] <= earlier[0]);
        if smooth && keys.len() > 1 {
            Law::bezier(monotone(&keys, measured.closed))
        } else {
            Law::keys(keys, Ease::Linear)
        }
    }

    /// Reads a curve whose coordinates are formulas.
    pub(super) fn formula(&self, path: &str, curve: &FormulaCurve) -> Result<Course, SweepError> {
        let formula = |key: &str, text: &str| {
            Formula::new(text).map_err(|message| self.fault(&format!("{path}.{key}"), message))
        };
        let formulas = [formula("x", &curve.x)?, formula("y", &curve.y)?, formula("z", &curve.z)?];
        let t_path = format!("{path}.t");
        self.point(&t_path, &curve.t)?;
        let [from, to] = curve.t;
        if to <= from {
            let message = format!("found {:?}, expected two rising numbers", curve.t);
            return Err(self.fault(&t_path, message));
        }
        let at = |t: f64| {
            let [x, y, z] = formulas.each_ref().map(|formula| formula.at(t));
            [DVec3::new(x.value, y.value, z.value), DVec3::new(x.slope, y.slope, z.slope)]
        };
        self.computed(path, at, &[from, to], curve.closed, "t")
    }

    /// Returns a curve that is given by a function of a parameter.
    pub(super) fn computed(
        &self,
        path: &str,
        at: impl Fn(f64) -> [DVec3; 2],
        ends: &[f64],
        closed: bool,
        parameter: &str,
    ) -> Result<Course, SweepError> {
        let mut cubics = hermite::along(at, ends).map_err(|t| {
            let message = format!(
                "found a point or a direction that is not finite at {parameter} = {t:?}, expected finite numbers"
            );
            self.geometry(path, message)
        })?;
        let size = extent(cubics.iter().flat_map(|cubic: &Cubic<DVec3>| cubic.0));
        if closed {
            let (start, end) = (cubics[0].0[0], cubics[cubics.len() - 1].0[3]);
            if start.distance(end) > MEETS * size {
                let message = format!(
                    "found a curve that ends {:.1e} from its start, expected the same point, since the curve is closed",
                    start.distance(end)
                );
                return Err(self.geometry(path, message));
            }
            if let Some(last) = cubics.last_mut() {
                last.0[3] = start;
            }
        }
        self.points(path, &cubics.iter().map(|cubic| cubic.0[0].to_array()).collect::<Vec<_>>())?;
        let curve: Path<DVec3> = self.path(path, &cubics, closed)?;
        self.smooth(&curve, path)?;
        Ok(Course::Path(curve))
    }
}

/// Returns pairs of arc lengths: of the straight lines through points, and of the curve fitted to them, where it passes
/// them.
fn passed(points: &[DVec3], closed: bool, fit: &fit::Fit<DVec3>) -> Vec<[f64; 2]> {
    let lengths: Vec<ArcLength<DVec3>> =
        fit.cubics.iter().map(|&cubic| ArcLength::new(cubic)).collect();
    let mut starts = vec![0.0];
    for length in &lengths {
        starts.push(starts[starts.len() - 1] + length.total());
    }
    let (mut done, mut furthest) = (0.0, 0.0_f64);
    let mut marks = Vec::with_capacity(points.len() + 1);
    for (i, &(cubic, t)) in fit.places.iter().enumerate() {
        if i > 0 {
            done += points[i - 1].distance(points[i]);
        }
        // Noise may put a point before the one that it follows.
        furthest = furthest.max(starts[cubic] + lengths[cubic].length_to(t));
        marks.push([done, furthest]);
    }
    if closed {
        let end = done + points[points.len() - 1].distance(points[0]);
        marks.push([end, starts[starts.len() - 1]]);
    }
    marks
}

/// Returns the second number of rising pairs, at a first number.
fn between(pairs: &[[f64; 2]], at: f64) -> f64 {
    let next = pairs.partition_point(|pair| pair[0] < at).clamp(1, pairs.len() - 1);
    let ([a, from], [b, to]) = (pairs[next - 1], pairs[next]);
    if b > a { from + (to - from) * ((at - a) / (b - a)).clamp(0.0, 1.0) } else { to }
}

/// Returns cubics through keys, with continuous derivatives and without overshoot: F. N. Fritsch and J. Butland, "A
/// method for constructing local monotone piecewise cubic interpolants", 1984.
fn monotone(keys: &[[f64; 2]], closed: bool) -> Vec<Cubic<DVec2>> {
    let steps: Vec<[f64; 2]> = keys
        .windows(2)
        .map(|pair| {
            let width = pair[1][0] - pair[0][0];
            [width, (pair[1][1] - pair[0][1]) / width]
        })
        .collect();
    let slope = |[h, a]: [f64; 2], [k, b]: [f64; 2]| {
        if a * b <= 0.0 {
            return 0.0;
        }
        let part = (h + 2.0 * k) / (3.0 * (h + k));
        a * b / (part * b + (1.0 - part) * a)
    };
    let last = steps.len() - 1;
    let mut slopes: Vec<f64> = steps.windows(2).map(|pair| slope(pair[0], pair[1])).collect();
    let ends =
        if closed { [slope(steps[last], steps[0]); 2] } else { [steps[0][1], steps[last][1]] };
    slopes.insert(0, ends[0]);
    slopes.push(ends[1]);
    keys.windows(2)
        .zip(slopes.windows(2))
        .map(|(pair, slopes)| {
            let [from, to] = [DVec2::from_array(pair[0]), DVec2::from_array(pair[1])];
            let third = (to.x - from.x) / 3.0;
            let handle = |slope: f64| DVec2::new(third, third * slope);
            Cubic([from, from + handle(slopes[0]), to - handle(slopes[1]), to])
        })
        .collect()
}
