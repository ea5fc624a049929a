//! How finely the meshes of a scene are made.
//!
//! A job that requests an error makes the meshes whose specs state a tolerance anew, within a number of
//! pixels that the error needs. Meshes whose specs count rows and columns stay as they are. The truth
//! about either kind is a mesh of about eight times as many cells.

use serde_json::Value;
use sweep::spec::{Camera, Resolution};

/// Cells of a finer mesh along each side of a cell of a mesh with counted cells.
const TIMES: usize = 3;

/// Distance of a mesh from its surface, in those of the mesh that is its truth. The number of cells
/// grows by the same factor.
const FINER: f64 = 8.0;

/// How finely meshes are made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fineness {
    /// As specs and jobs state it.
    Stated,
    /// Meshes with a tolerance stay within this many pixels of their surface.
    Pixels(f64),
    /// Meshes with a tolerance stay within an eighth of this many pixels.
    Truth(f64),
    /// All of them eight times finer.
    Finest(f64),
}

/// The kinds of resolution in a spec.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Kinds {
    /// True if a mesh is made to a tolerance.
    pub tolerance: bool,
    /// True if the cells of a mesh are counted.
    pub counted: bool,
}

impl Kinds {
    /// Returns the kinds of both.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            tolerance: self.tolerance || other.tolerance,
            counted: self.counted || other.counted,
        }
    }
}

impl Fineness {
    /// Replaces the resolutions in the text of a spec. `overrides` are those of the job, and `camera` is
    /// that of the scene. Returns the kinds that were found, and the new text. It is `None` if meshes
    /// are made as stated, or if the text is not JSON.
    #[must_use]
    pub fn apply(
        self,
        text: &[u8],
        overrides: &Resolution,
        camera: Camera,
    ) -> (Kinds, Option<Vec<u8>>) {
        let Ok(mut spec) = serde_json::from_slice(text) else { return (Kinds::default(), None) };
        let kinds = self.replace(&mut spec, overrides, camera);
        (kinds, (self != Self::Stated).then(|| spec.to_string().into_bytes()))
    }

    fn replace(self, spec: &mut Value, overrides: &Resolution, camera: Camera) -> Kinds {
        let mut kinds = Kinds::default();
        let mut one = |mesh: &mut Value| {
            let Ok(own) = serde_json::from_value::<Resolution>(mesh.clone()) else { return };
            let stated = own.overridden_by(overrides);
            let counted = stated.rows.is_some() || stated.cols.is_some();
            kinds.counted |= counted;
            kinds.tolerance |= !counted;
            let made =
                if counted { self.of_cells(stated) } else { self.of_tolerance(stated, camera) };
            *mesh = serde_json::to_value(made).unwrap_or_default();
        };
        match spec.get_mut("parts").and_then(Value::as_array_mut) {
            Some(parts) => parts.iter_mut().filter_map(|part| part.get_mut("mesh")).for_each(one),
            None => spec.get_mut("mesh").into_iter().for_each(&mut one),
        }
        kinds
    }

    fn of_cells(self, stated: Resolution) -> Resolution {
        let times = match self {
            Self::Finest(_) => TIMES,
            Self::Stated | Self::Pixels(_) | Self::Truth(_) => 1,
        };
        let more = |cells: Option<usize>| cells.map(|cells| cells.saturating_mul(times));
        Resolution { rows: more(stated.rows), cols: more(stated.cols), ..stated }
    }

    fn of_tolerance(self, stated: Resolution, camera: Camera) -> Resolution {
        let pixels = match self {
            Self::Stated => return stated,
            Self::Pixels(pixels) => pixels,
            Self::Truth(pixels) | Self::Finest(pixels) => pixels / FINER,
        };
        let camera = stated.camera.or(Some(camera));
        Resolution { tol: None, pixels: Some(pixels), camera, ..stated }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn camera() -> Camera {
        let (eye, target, up) = ([0.0, 0.0, 5.0], [0.0; 3], [0.0, 1.0, 0.0]);
        Camera { eye, target, up, fov_deg: 40.0, size: [100, 100] }
    }

    #[test]
    fn counted_cells_stay_and_their_truth_has_nine_times_as_many() {
        let spec = || json!({ "name": "a", "mesh": { "rows": 10, "cols": 4 } });
        let apply = |fineness: Fineness, overrides: &Resolution| {
            let mut spec = spec();
            let kinds = fineness.replace(&mut spec, overrides, camera());
            assert_eq!(kinds, Kinds { tolerance: false, counted: true });
            spec
        };
        let none = Resolution::default();
        assert_eq!(apply(Fineness::Pixels(0.1), &none), spec());
        assert_eq!(apply(Fineness::Truth(0.1), &none), spec());
        assert_eq!(apply(Fineness::Finest(0.1), &none)["mesh"], json!({ "rows": 30, "cols": 12 }));
        let of_job = Resolution { rows: Some(7), ..none };
        assert_eq!(apply(Fineness::Finest(0.1), &of_job)["mesh"]["rows"], 21);
    }

    #[test]
    fn tolerances_become_pixels_of_the_camera_in_every_part() {
        let mesh = json!({ "tol": 0.01, "angle_deg": 9.0 });
        let mut spec = json!({ "parts": [{ "mesh": mesh }, { "mesh": { "rows": 3, "cols": 3 } }] });
        let kinds = Fineness::Truth(0.4).replace(&mut spec, &Resolution::default(), camera());
        assert_eq!(kinds, Kinds { tolerance: true, counted: true });
        let made = &spec["parts"][0]["mesh"];
        assert_eq!((&made["pixels"], &made["angle_deg"]), (&json!(0.05), &json!(9.0)));
        assert_eq!(made["camera"]["size"], json!([100, 100]));
        assert!(made.get("tol").is_none());
        assert_eq!(spec["parts"][1]["mesh"], json!({ "rows": 3, "cols": 3 }));
    }
}
