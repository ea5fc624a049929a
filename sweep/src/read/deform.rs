//! Reads the deformations of a spec.

use super::Reader;
use crate::curve::vector::LEAST_SINE;
use crate::error::SweepError;
use crate::limits::SMALLEST;
use crate::spec;
use crate::surface::deform::{Deform, Kind};
use glam::{DMat3, DVec3};

/// A bend of less than this, in degrees, is left out, because its radius would exceed the precision of
/// numbers.
const LEAST_BEND: f64 = 1e-6;

/// Largest bend in degrees; a larger one would run through itself many times.
const MOST_BEND: f64 = 3600.0;

impl Reader<'_> {
    pub(super) fn deforms(&self, deforms: &[spec::Deform]) -> Result<Vec<Deform>, SweepError> {
        deforms
            .iter()
            .enumerate()
            .filter_map(|(i, deform)| {
                let path = format!("deform[{i}]");
                match deform {
                    spec::Deform::Taper(taper) => Some(self.taper(&format!("{path}.taper"), taper)),
                    spec::Deform::Twist(twist) => {
                        Some(self.axis_twist(&format!("{path}.twist"), twist))
                    }
                    spec::Deform::Bend(bend) => {
                        self.bend(&format!("{path}.bend"), bend).transpose()
                    }
                }
            })
            .collect()
    }

    fn taper(&self, path: &str, taper: &spec::Taper) -> Result<Deform, SweepError> {
        let factor_path = format!("{path}.factor");
        let law = self.law(&factor_path, &taper.factor)?;
        let (low, _) = law.range();
        if low < 0.0 {
            let message = format!("found a factor that falls to {low:?}, expected at least 0");
            return Err(self.fault(&factor_path, message));
        }
        self.along(path, taper.axis, taper.origin, [taper.from, taper.to], Kind::Taper(law))
    }

    fn axis_twist(&self, path: &str, twist: &spec::AxisTwist) -> Result<Deform, SweepError> {
        let law = self.law(&format!("{path}.degrees"), &twist.degrees)?;
        self.along(path, twist.axis, twist.origin, [twist.from, twist.to], Kind::Twist(law))
    }

    /// Reads a bend; `None` for a bend by less than [`LEAST_BEND`].
    fn bend(&self, path: &str, bend: &spec::Bend) -> Result<Option<Deform>, SweepError> {
        if bend.degrees.abs() > MOST_BEND {
            let message =
                format!("found {:?}, expected at most {MOST_BEND:?} degrees", bend.degrees);
            return Err(self.fault(&format!("{path}.degrees"), message));
        }
        let kind = Kind::Bend(bend.degrees.to_radians());
        let deform = self.along(path, bend.axis, bend.origin, [bend.from, bend.to], kind)?;
        let toward_path = format!("{path}.toward");
        self.point(&toward_path, &bend.toward)?;
        let (axis, toward) = (deform.axes.z_axis, DVec3::from_array(bend.toward));
        let across = toward - axis * toward.dot(axis);
        let x = across.try_normalize().filter(|_| across.length() > LEAST_SINE * toward.length());
        let Some(x) = x else {
            let message = format!("found {:?}, expected a direction across the axis", bend.toward);
            return Err(self.fault(&toward_path, message));
        };
        let axes = DMat3::from_cols(x, axis.cross(x), axis);
        Ok((bend.degrees.abs() >= LEAST_BEND).then_some(Deform { axes, ..deform }))
    }

    /// Reads the keys that all deformations share: the axis and the span on it.
    fn along(
        &self,
        path: &str,
        axis: [f64; 3],
        origin: [f64; 3],
        span: [f64; 2],
        kind: Kind,
    ) -> Result<Deform, SweepError> {
        let axis_path = format!("{path}.axis");
        self.point(&axis_path, &axis)?;
        self.point(&format!("{path}.origin"), &origin)?;
        let Some(axis) = DVec3::from_array(axis).try_normalize() else {
            return Err(self.fault(&axis_path, "found a vector without length, expected an axis"));
        };
        let [from, to] = span;
        self.number(&format!("{path}.from"), from)?;
        let to_path = format!("{path}.to");
        self.number(&to_path, to)?;
        if to <= from {
            let message =
                format!("found {to:?}, expected more than {from:?}, where the deformation begins");
            return Err(self.fault(&to_path, message));
        }
        if to - from < SMALLEST {
            let message =
                format!("found {to:?}, expected at least {SMALLEST:?} more than {from:?}");
            return Err(self.fault(&to_path, message));
        }
        let x = axis.any_orthonormal_vector();
        let axes = DMat3::from_cols(x, axis.cross(x), axis);
        Ok(Deform { origin: DVec3::from_array(origin), axes, span, kind })
    }
}

#[cfg(test)]
mod tests {
    use crate::read::tests::complaint;

    #[test]
    fn each_deformation_has_its_complaints() {
        for (deform, message) in [
            ("{}", "4:12: deform[0]: found no deformation, expected one of taper, twist, bend"),
            (
                "{\"taper\": {\"from\": 0, \"to\": 1, \"factor\": -1}}",
                "taper.factor: found a factor",
            ),
            (
                "{\"taper\": {\"from\": 0, \"to\": 0, \"factor\": 1}}",
                "taper.to: found 0.0, expected",
            ),
            (
                "{\"bend\": {\"from\": 0, \"to\": 5e-324, \"degrees\": 9, \"toward\": [1, 0, 0]}}",
                "bend.to: found 5e-324, expected at least 1e-60 more than 0.0",
            ),
            ("{\"taper\": {\"from\": 0, \"to\": 1}}", "missing key `factor`"),
            (
                "{\"twist\": {\"from\": 0, \"to\": 1, \"degrees\": 9, \"axis\": [0, 0, 0]}}",
                "twist.axis: found a vector without length",
            ),
            (
                "{\"bend\": {\"from\": 0, \"to\": 1, \"degrees\": 9, \"toward\": [0, 2, 0]}}",
                "bend.toward: found [0.0, 2.0, 0.0], expected a direction across the axis",
            ),
            (
                "{\"bend\": {\"from\": 0, \"to\": 1, \"degrees\": 9e9, \"toward\": [1, 0, 0]}}",
                "bend.degrees: found 9000000000.0",
            ),
        ] {
            let (found, _) = complaint("\"mesh\"", &format!("\"deform\": [{deform}], \"mesh\""));
            assert!(found.starts_with("a.json:4:") && found.contains(message), "{found}");
        }
    }
}
