//! Triangles, normals and textures of meshes.

use super::subject::{Item, Subject};
use super::{Finding, Severity, count};
use crate::shape::Mesh;
use crate::shape::mesh::{NONE, as_dvec3};
use glam::{DVec2, DVec3};

/// A texture counts as stretched if one direction is stretched this many times more than another. A
/// smaller number would report the triangles around poles.
const STRETCHED: f64 = 100.0;

/// Returns the findings about meshes.
#[must_use]
pub fn findings(subject: &Subject<'_>) -> Vec<Finding> {
    // The placements of one mesh have the same faults.
    let items = subject.items.iter().filter(|item| item.placement == 0);
    let meshes = items.filter_map(|item| Some((item, item.mesh()?)));
    let mut found = Vec::new();
    for (item, mesh) in meshes {
        found.extend(flat(item, mesh));
        found.extend(doubled(item));
        found.extend(inward(subject, item));
        found.extend(normals(item, mesh));
        found.extend(stretched(item, mesh));
        found.extend(rounded(item, mesh));
    }
    found
}

fn flat(item: &Item<'_>, mesh: &Mesh) -> Option<Finding> {
    let (flat, all) = (item.skin?.flat, mesh.triangles.len());
    if flat == all {
        let message = "no triangle of the mesh has an area: the mesh is invisible";
        return Some(Finding::new(Severity::Wrong, &item.path, message));
    }
    let message = format!(
        "{} of {all} without an area: no ray meets them",
        count(flat, "triangle is", "triangles are")
    );
    (flat > 0).then(|| Finding::new(Severity::Remark, &item.path, message))
}

fn doubled(item: &Item<'_>) -> Option<Finding> {
    let doubled = item.skin?.doubled;
    let message = format!(
        "{} the corners of an earlier triangle: only the first is seen",
        count(doubled, "triangle has", "triangles have")
    );
    (doubled > 0).then(|| Finding::new(Severity::Hint, &item.path, message))
}

/// Finds a closed mesh whose corners run clockwise as seen from outside. Glass has a finding of its own.
fn inward(subject: &Subject<'_>, item: &Item<'_>) -> Option<Finding> {
    let skin = item.skin?;
    let message = "its triangles face inward: found corners that run clockwise as seen from outside, \
                   expected counter-clockwise";
    (skin.is_closed() && skin.volume < 0.0 && !subject.bends(item))
        .then(|| Finding::new(Severity::Hint, &item.path, message))
}

/// Finds normals of the file that are zero, or that point to the back of their triangle.
fn normals(item: &Item<'_>, mesh: &Mesh) -> Vec<Finding> {
    let zero = mesh.normals.iter().filter(|normal| **normal == [0.0; 3]).count();
    let mut averted = 0;
    for (number, triangle) in mesh.triangles.iter().enumerate() {
        if triangle.normal[0] == NONE {
            continue;
        }
        let [a, b, c] = mesh.corners(number as u32).map(as_dvec3);
        let across = (b - a).cross(c - a);
        let faces = |index: u32| as_dvec3(mesh.normals[index as usize]).dot(across) < 0.0;
        averted += usize::from(triangle.normal.into_iter().all(faces));
    }
    let zero = (zero > 0).then(|| {
        let message = format!(
            "{} zero: the triangles' own normals are used instead",
            count(zero, "normal (vn) is", "normals (vn) are")
        );
        Finding::new(Severity::Hint, &item.path, message)
    });
    let averted = (averted > 0).then(|| {
        let message = format!(
            "the normals (vn) of {} of {} point to the side from which its corners run clockwise: \
             light and shadow will not agree",
            count(averted, "triangle", "triangles"),
            mesh.triangles.len()
        );
        Finding::new(Severity::Hint, &item.path, message)
    });
    zero.into_iter().chain(averted).collect()
}

/// Finds triangles on which a texture is stretched far more in one direction than in another.
fn stretched(item: &Item<'_>, mesh: &Mesh) -> Option<Finding> {
    let is_textured = |surface: u32| item.object.parts[surface as usize].picture().is_some();
    let mut stretched = 0;
    for (number, triangle) in mesh.triangles.iter().enumerate() {
        if triangle.uv[0] == NONE || !is_textured(triangle.surface) {
            continue;
        }
        let corners = mesh.corners(number as u32).map(as_dvec3);
        let uvs = triangle.uv.map(|index| DVec2::from(mesh.uvs[index as usize].map(f64::from)));
        stretched += usize::from(stretch(corners, uvs).is_some_and(|ratio| ratio > STRETCHED));
    }
    let message = format!(
        "on {} the texture is stretched more than {STRETCHED} times as far in one direction as in \
         another",
        count(stretched, "triangle", "triangles")
    );
    (stretched > 0).then(|| Finding::new(Severity::Remark, &item.path, message))
}

/// Returns the ratio of the singular values of the map from the texture to the triangle, at least 1.
/// Returns `None` if the texture or the triangle has no area.
fn stretch([a, b, c]: [DVec3; 3], [s, t, u]: [DVec2; 3]) -> Option<f64> {
    let (e, f) = (t - s, u - s);
    let area = e.perp_dot(f);
    if area == 0.0 || (b - a).cross(c - a) == DVec3::ZERO {
        return None;
    }
    let across = ((b - a) * f.y - (c - a) * e.y) / area;
    let up = ((c - a) * e.x - (b - a) * f.x) / area;
    let (p, q, r) = (across.length_squared(), up.length_squared(), across.dot(up));
    let half = 0.5 * (p + q);
    let root = (0.25 * (p - q) * (p - q) + r * r).sqrt();
    // The product of both values gives the smaller value without loss of digits.
    let product = across.cross(up).length_squared();
    let larger = half + root;
    (product > 0.0).then(|| larger / product.sqrt())
}

/// Finds a mesh so far from the origin that the steps of its `f32` coordinates are visible.
fn rounded(item: &Item<'_>, mesh: &Mesh) -> Option<Finding> {
    let [low, high] = mesh.all_bounds()?;
    let size = (high - low).max_element();
    // Coordinates count from the offset of the mesh.
    let far = (low - mesh.offset).abs().max((high - mesh.offset).abs()).max_element();
    let step = far * f64::from(f32::EPSILON);
    let message = format!(
        "its coordinates have steps of {}, a {}th of its size: move the mesh nearer to the origin",
        super::short(step),
        super::short(size / step)
    );
    (mesh.triangles.len() > 1 && size > 0.0 && size < 1e4 * step)
        .then(|| Finding::new(Severity::Hint, &item.path, message))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stretch_is_the_ratio_of_a_textures_longest_and_shortest_step() {
        let corners = |x: f64, y: f64| [DVec3::ZERO, DVec3::X * x, DVec3::Y * y];
        let unit = [DVec2::ZERO, DVec2::X, DVec2::Y];
        assert_eq!(stretch(corners(3.0, 3.0), unit), Some(1.0));
        assert_eq!(stretch(corners(8.0, 2.0), unit), Some(4.0));
        assert_eq!(stretch(corners(0.0, 2.0), unit), None);
        assert_eq!(stretch(corners(1.0, 1.0), [DVec2::ZERO; 3]), None);
    }
}
