//! Rounding of the coordinates of a mesh to f32.

use super::{Finding, Severity, short};
use crate::grid::GridMesh;
use glam::DVec3;

/// Rounding errors beyond this fraction of the object's size are visible.
const SEEN: f64 = 1e-4;

/// Returns a finding if rounding the points of a grid to f32, as in an OBJ file, loses more than the requested tolerance
/// or than is visible.
#[must_use]
pub fn findings(grid: &GridMesh) -> Option<Finding> {
    let none = (DVec3::INFINITY, DVec3::NEG_INFINITY, 0.0_f64);
    let (low, high, lost) = grid.positions.iter().fold(none, |(low, high, lost), &point| {
        let error = (point - point.as_vec3().as_dvec3()).abs().max_element();
        (low.min(point), high.max(point), lost.max(error))
    });
    let size = (high - low).length();
    if !lost.is_finite() {
        let message = "the coordinates are beyond 3.4e38, the largest of an OBJ";
        return Some(Finding::new(Severity::Wrong, "position", message));
    }
    let asked = grid.tolerance.and_then(|tolerance| tolerance.asked);
    let (limit, of) = match asked {
        Some(asked) if asked < SEEN * size => (asked, "the tolerance asked for".to_owned()),
        _ => (SEEN * size, format!("{SEEN:.0e} of the size")),
    };
    let away = low.abs().max(high.abs()).max_element();
    let message = format!(
        "the single-precision coordinates of a mesh lose {}, which is more than {of}: the surface is {} large \
         and up to {} from the origin; move it nearer",
        short(lost),
        short(size),
        short(away)
    );
    (lost > limit).then(|| Finding::new(Severity::Hint, "position", message))
}
