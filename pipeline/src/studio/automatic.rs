//! A scene for a spec that has none: a camera that sees the whole object, two lights and a floor.

use super::folder::Folder;
use super::source::Edited;
use files::json::Document;
use glam::DVec3;
use std::collections::BTreeMap;
use std::path::Path;
use sweep::Object;
use sweep::preview::Drawn;
use sweep::spec::Resolution;

/// Cells of the mesh by which the size is found.
const CELLS: usize = 24;

/// Returns the box of a spec's surface, or a box of side 2 if the spec has a fault.
#[must_use]
pub fn bounds(folder: &Folder, path: &str, text: &str) -> [DVec3; 2] {
    let unit = [DVec3::splat(-1.0), DVec3::ONE];
    let Ok(document) = Document::new(path, text.as_bytes()) else { return unit };
    let source = Edited { texts: BTreeMap::new(), folder: folder.clone() };
    let below = Path::new(path).parent().unwrap_or(Path::new(""));
    let coarse = Resolution { rows: Some(CELLS), cols: Some(CELLS), ..Resolution::default() };
    let read = |resolution: &Resolution| Object::read(&document, below, &source, resolution);
    let Ok(object) = read(&coarse).or_else(|_| read(&Resolution::default())) else { return unit };
    let parts = object.parts().iter();
    let points = parts.flat_map(|sweep| Drawn::of(sweep, CELLS, 1, CELLS).stations).flatten();
    let [low, high] = points
        .fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], p| [low.min(p), high.max(p)]);
    if low.is_finite() && high.is_finite() { [low, high] } else { unit }
}

/// Returns the text of a scene that shows a mesh with this name and box.
#[must_use]
pub fn scene(mesh: &str, [low, high]: [DVec3; 2]) -> String {
    let (middle, size) = (0.5 * (low + high), (high - low).length().max(1e-6));
    let eye = middle + DVec3::new(0.55, 0.42, 1.0).normalize() * 1.9 * size;
    let [eye, target] = [eye, middle].map(|p| {
        let [x, y, z] = p.to_array().map(short);
        format!("[{x}, {y}, {z}]")
    });
    let half = 20.0 * size;
    let (x, y, z) = (short(middle.x - half), short(low.y - 1e-3 * size), short(middle.z + half));
    let side = short(2.0 * half);
    format!(
        r#"{{
  "format": "tb-scene", "version": 1,
  "camera": {{ "eye": {eye}, "target": {target}, "up": [0, 1, 0], "fov_deg": 32 }},
  "background": [0.6, 0.68, 0.76],
  "ambient": 0.28,
  "lights": [
    {{ "directional": {{ "direction": [0.42, -0.7, -0.56], "color": 0.62 }} }},
    {{ "directional": {{ "direction": [-0.8, -0.53, -0.27], "color": 0.18 }} }}
  ],
  "textures": {{}},
  "materials": {{
    "body": {{ "color": [0.94, 0.9, 0.84], "diffuse": 0.85, "specular": 0.2, "shininess": 40 }},
    "floor": {{ "color": [0.6, 0.66, 0.72], "diffuse": 0.75 }}
  }},
  "objects": [
    {{ "mesh": {{ "name": "{mesh}", "material": "body" }} }},
    {{ "rectangle": {{ "corner": [{x}, {y}, {z}], "edge_u": [{side}, 0, 0], "edge_v": [0, 0, -{side}],
                     "material": "floor" }} }}
  ]
}}
"#
    )
}

/// Rounds a number to four significant digits.
fn short(x: f64) -> f64 {
    if x == 0.0 || !x.is_finite() {
        return 0.0;
    }
    let digits = (3 - x.abs().log10().floor() as i32).clamp(0, 12);
    format!("{x:.*}", digits as usize).parse().unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_camera_of_the_scene_sees_the_whole_box() {
        let bounds = [DVec3::new(-1.0, 0.0, -2.0), DVec3::new(3.0, 5.0, 2.0)];
        let text = scene("a", bounds);
        let document = Document::new("a.json", text.as_bytes()).unwrap();
        let file = render::scene::read::parse(&document).unwrap();
        let camera = render::scene::read::camera_of(&document, &file).unwrap();
        let size = glam::DVec2::splat(100.0);
        let forward = camera.ray(0.5 * size, size).direction;
        let widest = camera.ray(glam::DVec2::new(50.0, 0.0), size).direction.dot(forward);
        for k in 0..8 {
            let at = |i: usize| f64::from(k >> i & 1);
            let corner = bounds[0] + (bounds[1] - bounds[0]) * DVec3::new(at(0), at(1), at(2));
            let toward = (corner - camera.eye()).normalize();
            assert!(toward.dot(forward) > widest, "{corner}");
        }
    }
}
