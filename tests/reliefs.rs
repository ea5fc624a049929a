//! The bump of `render` and the relief of `sweep` show the same picture of heights.

use files::Disk;
use files::json::Document;
use glam::{DAffine3, DVec2};
use render::procedural::{Bump, Heights, Place, Placement, Relief};
use std::path::Path;
use sweep::Sweep;

/// Returns the largest distance between the normals of the scaly ring and those of the smooth ring
/// with its bump. Both have scales of height `strength`.
fn apart(strength: f64) -> f64 {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/curves");
    let read = |name: &str| {
        let text = std::fs::read_to_string(folder.join(name)).expect("the example is there");
        assert!(name != "scaly-ring.json" || text.contains("\"amp\": 0.06, \"repeat\": [10, 14]"));
        let text = text.replace("\"amp\": 0.06", &format!("\"amp\": {strength:?}"));
        let document = Document::new(name, text.as_bytes()).expect("it is JSON");
        Sweep::read_in(&document, &folder, &Disk, &sweep::spec::Resolution::default())
            .expect("a spec")
    };
    let (smooth, scaly) = (read("smooth-ring.json"), read("scaly-ring.json"));
    let picture = image::open(folder.join("../textures/scales.png")).expect("it is there");
    let picture = picture.into_luma16();
    let grey = picture.pixels().map(|pixel| f64::from(pixel.0[0]) / 65535.0).collect();
    let width = picture.width() as usize;
    let heights = Heights::new(grey, width, DVec2::new(10.0, 14.0), false).expect("whole rows");
    let placement = Placement::default();
    let bump = Bump { relief: Relief::Picture(heights), strength, placement };
    let mut apart: f64 = 0.0;
    for k in 0..300 {
        let (u, v) = ((0.618 * f64::from(k)).fract(), (0.377 * f64::from(k)).fract());
        let (point, normal) = smooth.at(u, v);
        // On a ring the two directions are perpendicular, and each gradient is parallel to its own
        // direction.
        let step = 1e-6;
        let [along_u, along_v] = [(step, 0.0), (0.0, step)].map(|(du, dv)| {
            let along = (smooth.at(u + du, v + dv).0 - smooth.at(u - du, v - dv).0) / (2.0 * step);
            along / along.length_squared()
        });
        let uv_gradients = [along_u, along_v];
        let place = Place { point, normal, uv: DVec2::new(u, v), uv_gradients };
        let bumped = bump.normal(&DAffine3::IDENTITY, &place);
        apart = apart.max(bumped.distance(scaly.at(u, v).1));
    }
    apart
}

/// A bump is a relief to first order: a tenth of the height leaves a hundredth of the difference.
#[test]
fn a_bump_shades_like_the_relief_of_the_same_picture() {
    let [low, lower] = [1e-3, 1e-4].map(apart);
    assert!(low < 1e-2 && lower < 0.02 * low, "{low} and {lower}");
}
