//! Reads the resolution of a spec.

use super::Reader;
use crate::error::SweepError;
use crate::grid::MOST_CELLS;
use crate::sampling::resolution::{Distance, Resolution, Tolerance, View};
use crate::spec;
use crate::spec::resolution::{Camera, MAX_QUADS};
use glam::DVec3;

/// A reason why there is no resolution: the key and a message.
type Fault = (&'static str, String);

impl Reader<'_> {
    /// Returns the resolution that a spec requests, after the overrides of the reader.
    pub(super) fn resolution(&self, asked: &spec::Resolution) -> Result<Resolution, SweepError> {
        let asked = asked.overridden_by(self.overrides);
        resolution(&asked).map_err(|fault| self.resolution_fault(fault))
    }

    /// Returns an error about a key of `mesh`, or about the override that replaced this key.
    pub(super) fn resolution_fault(&self, (key, message): Fault) -> SweepError {
        let overrides = self.overrides;
        let overridden = match key {
            "rows" => overrides.rows.is_some() || overrides.cols.is_some(),
            "cols" => overrides.cols.is_some() || overrides.rows.is_some(),
            "tol" => overrides.tol.is_some(),
            "angle_deg" => overrides.angle_deg.is_some(),
            "pixels" => overrides.pixels.is_some(),
            "max_quads" => overrides.max_quads.is_some(),
            _ => key.starts_with("camera") && overrides.camera.is_some(),
        };
        if overridden {
            return SweepError::Resolution(format!("{key}: {message}"));
        }
        let path = if key.is_empty() { "mesh".into() } else { format!("mesh.{key}") };
        self.fault(&path, message)
    }
}

fn resolution(asked: &spec::Resolution) -> Result<Resolution, Fault> {
    let counted = asked.rows.is_some() || asked.cols.is_some();
    let tolerance = [
        ("tol", asked.tol.is_some()),
        ("angle_deg", asked.angle_deg.is_some()),
        ("pixels", asked.pixels.is_some()),
        ("max_quads", asked.max_quads.is_some()),
        ("camera", asked.camera.is_some()),
    ];
    let first = tolerance.into_iter().find_map(|(key, given)| given.then_some(key));
    match (counted, first) {
        (true, Some(key)) => {
            let message = "found this key beside a number of rows or cols, expected only one of \
                           the two";
            Err((key, message.into()))
        }
        (true, None) => match (asked.rows, asked.cols) {
            (Some(rows), Some(cols)) => Ok(Resolution::Cells { rows, cols }),
            (Some(_), None) => Err(("cols", "found rows without cols, expected both".into())),
            _ => Err(("rows", "found cols without rows, expected both".into())),
        },
        (false, _) => tolerance_of(asked).map(Resolution::Tolerance),
    }
}

fn tolerance_of(asked: &spec::Resolution) -> Result<Tolerance, Fault> {
    for (key, number, most) in [
        ("tol", asked.tol, 1e60),
        ("angle_deg", asked.angle_deg, 90.0),
        ("pixels", asked.pixels, 1e6),
    ] {
        if let Some(number) = number
            && !(number >= 1e-60 && number < most)
        {
            let message = format!("found {number:?}, expected a number above 0 and below {most:?}");
            return Err((key, message));
        }
    }
    let distance = match (asked.tol, asked.pixels, &asked.camera) {
        (Some(_), Some(_), _) => {
            return Err(("pixels", "found pixels beside tol, expected only one of the two".into()));
        }
        (_, Some(pixels), Some(camera)) => Some(Distance::Pixels(pixels, view(camera)?)),
        (_, Some(_), None) => {
            let message = "found pixels without a camera, expected a camera in mesh.camera; \
                           `pipeline run` takes the camera of the scene";
            return Err(("pixels", message.into()));
        }
        (Some(tol), None, None) => Some(Distance::Everywhere(tol)),
        (_, None, Some(_)) => {
            return Err(("camera", "found a camera without pixels, expected both".into()));
        }
        (None, None, None) => None,
    };
    if distance.is_none() && asked.angle_deg.is_none() {
        let message =
            "found no resolution, expected rows and cols, or any of tol, angle_deg, pixels";
        return Err(("", message.into()));
    }
    let max_quads = asked.max_quads.unwrap_or(MAX_QUADS);
    if !(1..=MOST_CELLS).contains(&max_quads) {
        let message = format!("found {max_quads}, expected 1 to {MOST_CELLS}");
        return Err(("max_quads", message));
    }
    Ok(Tolerance { distance, angle: asked.angle_deg.map(f64::to_radians), max_quads })
}

fn view(camera: &Camera) -> Result<View, Fault> {
    if !(camera.fov_deg > 0.0 && camera.fov_deg < 180.0) {
        let message = format!("found {:?}, expected an angle between 0 and 180", camera.fov_deg);
        return Err(("camera.fov_deg", message));
    }
    for (key, point) in
        [("camera.eye", camera.eye), ("camera.target", camera.target), ("camera.up", camera.up)]
    {
        if let Some(number) = point.iter().find(|number| number.abs() > 1e60) {
            return Err((key, format!("found {number:?}, expected coordinates of at most 1e60")));
        }
    }
    if camera.size.contains(&0) {
        let [width, height] = camera.size;
        return Err(("camera.size", format!("found {width} x {height}, expected pixels")));
    }
    let [eye, target, up] = [camera.eye, camera.target, camera.up].map(DVec3::from_array);
    View::new(eye, target, up, camera.fov_deg.to_radians(), camera.size).ok_or_else(|| {
        let message = "found an eye at its target or an up along the view, expected a direction";
        ("camera", message.into())
    })
}

#[cfg(test)]
mod tests {
    use crate::read::tests::complaint;
    use files::Exit;

    #[test]
    fn what_a_resolution_lacks_has_its_place() {
        let camera = "\"camera\": {\"eye\": [0, 0, 1], \"target\": [0, 0, 0], \"fov_deg\": 40, \
                      \"size\": [9, 9]}";
        let pixels = |camera: &str| format!("\"pixels\": 1, {camera}");
        for (mesh, message) in [
            ("\"rows\": 9".into(), "a.json:4:9: mesh.cols: found rows without cols"),
            ("\"cols\": 9".into(), "a.json:4:9: mesh.rows: found cols without rows"),
            ("\"max_quads\": 9".into(), "mesh: found no resolution, expected rows and cols"),
            ("\"rows\": 9, \"tol\": 1".into(), "mesh.tol: found this key beside a number of rows"),
            ("\"tol\": -1".into(), "mesh.tol: found -1.0, expected a number above 0"),
            ("\"angle_deg\": 90".into(), "mesh.angle_deg: found 90.0, expected a number"),
            ("\"tol\": 1, \"pixels\": 1".into(), "mesh.pixels: found pixels beside tol"),
            ("\"pixels\": 1".into(), "mesh.pixels: found pixels without a camera"),
            (format!("\"tol\": 1, {camera}"), "mesh.camera: found a camera without pixels"),
            (pixels(&camera.replace("40", "180")), "mesh.camera.fov_deg: found 180.0"),
            (pixels(&camera.replace("0, 0, 1", "0, 0, 0")), "mesh.camera: found an eye at its"),
            (pixels(&camera.replace("9, 9", "9, 0")), "mesh.camera.size: found 9 x 0"),
            ("\"tol\": 1, \"max_quads\": 8".into(), "mesh.max_quads: found 8, expected at least 9"),
            ("\"tol\": 1, \"max_quads\": 0".into(), "mesh.max_quads: found 0, expected 1 to"),
        ] {
            let (text, exit) = complaint("\"rows\": 9, \"cols\": 8", &mesh);
            assert!(text.contains(message), "{text}");
            assert_eq!(exit, Exit::Malformed);
        }
    }
}
