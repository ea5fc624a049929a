//! Textures of odd sizes, and footprints across the horizon, beside the eye, and larger than the
//! texture.

use crate::studio;

use fixtures::Dice;
use fixtures::rounding::{HALF_STEP, STEP};
use glam::DVec3;
use render::filter::Filter;
use render::{Picture, Scene};
use studio::objects::{plane, sphere, textured};
use studio::{FILTERS, assert_near, picture, pixels, png, scene};

/// An unlit object with a picture on it, seen by a camera.
fn paper(camera: &str, object: &str, width: usize, texels: &[[u8; 3]]) -> Scene {
    let keys = format!(
        r#"{camera} "ambient": 1, "textures": {{ "image": {{ "image": "i.png", "values": "linear" }} }},
        "materials": {{ "unlit": {{ "diffuse": 0 }} }}, "background": 0.5, "objects": [ {} ]"#,
        textured(object)
    );
    scene(&keys, &[("i.png", png(width, texels))])
}

fn random(dice: &mut Dice, count: usize) -> Vec<[u8; 3]> {
    // Codes are from 51 to 204, so that any value that is no average of them is found.
    (0..count).map(|_| std::array::from_fn(|_| 51 + dice.below(154) as u8)).collect()
}

/// Asserts that every pixel is an average of texels from 51 to 204, or the sky, which is 0.5.
#[track_caller]
fn assert_averages(picture: &Picture, what: &str) {
    for (x, y, pixel) in pixels(picture) {
        let within = |light: &f32| (0.2 - STEP..=0.8 + STEP).contains(light);
        assert!(pixel.iter().all(within), "{what}: at {x} {y}: {pixel:?}");
    }
}

#[test]
fn a_texture_of_any_size_looks_like_four_of_it_in_one() {
    let mut dice = Dice::new(1);
    let floor = |size: f64| {
        plane([0.03, -1.0, 0.01], [size, 0.0, 0.2 * size], [0.2 * size, 0.0, -size], "unlit")
    };
    for (width, height) in [(1, 1), (1, 7), (5, 1), (3, 5), (7, 13), (2, 3)] {
        let texels = random(&mut dice, width * height);
        let four: Vec<[u8; 3]> = (0..4 * width * height)
            .map(|k| texels[k / (2 * width) % height * width + k % (2 * width) % width])
            .collect();
        // A pyramid over other texels has other levels.
        let leveled = |filter: &Filter| matches!(filter, Filter::Mip | Filter::Exact);
        for filter in FILTERS.into_iter().filter(|filter| !leveled(filter)) {
            // The rows reach down to those where a footprint covers many texels.
            let one = picture(&paper("", &floor(1.0), width, &texels), 48, filter);
            let tiled = picture(&paper("", &floor(2.0), 2 * width, &four), 48, filter);
            assert_near(&one, &tiled, 2e-6);
            assert_averages(&one, "odd sizes");
        }
    }
}

#[test]
fn spheres_take_textures_of_a_row_or_a_column() {
    let mut dice = Dice::new(2);
    let globe = sphere([0.0; 3], 1.0, "unlit");
    for (width, height) in [(1, 1), (1, 2), (2, 1), (1, 9), (9, 1), (3, 2)] {
        let texels = random(&mut dice, width * height);
        for eye in [[0.0, 0.0, 1.7], [0.0, 1.7, 0.0], [0.0, 0.0, -1.7]] {
            let camera = format!(
                r#""camera": {{ "eye": {eye:?}, "target": [0, 0, 0], "up": [1, 0, 0], "fov_deg": 90 }},"#
            );
            for filter in FILTERS {
                let seen = picture(&paper(&camera, &globe, width, &texels), 31, filter);
                assert_averages(&seen, "rows and columns");
            }
        }
    }
}

#[test]
fn to_the_horizon_and_behind_the_eye_every_pixel_is_an_average() {
    let mut dice = Dice::new(3);
    let texels = random(&mut dice, 12);
    let floor = plane([0.3, 0.0, 0.1], [1.0, 0.0, 0.2], [0.2, 0.0, -1.0], "unlit");
    for height in [1e-12, 1e-6, 1.0, 1e6, 1e12] {
        let eye = DVec3::new(0.0, height, 0.0);
        // Views that are level, slightly upward, straight down, and down to the back. The widest
        // view covers nearly half of space.
        for (toward, up) in [
            (DVec3::NEG_Z, DVec3::Y),
            (DVec3::new(0.0, 0.3, -1.0), DVec3::Y),
            (DVec3::NEG_Y, DVec3::Z),
            (DVec3::new(0.0, -1.0, 0.4), DVec3::Z),
        ] {
            for fov in [60.0, 178.0, 179.999_999] {
                let target = eye + toward * height;
                let camera = format!(
                    r#""camera": {{ "eye": {:?}, "target": {:?}, "up": {:?}, "fov_deg": {fov:?} }},"#,
                    eye.to_array(),
                    target.to_array(),
                    up.to_array()
                );
                for filter in FILTERS {
                    let seen = picture(&paper(&camera, &floor, 4, &texels), 18, filter);
                    assert_averages(&seen, &format!("{height:e} {toward} {fov} {filter:?}"));
                }
            }
        }
    }
}

#[test]
fn what_is_larger_than_the_texture_tends_to_its_mean() {
    let mut dice = Dice::new(4);
    let texels = random(&mut dice, 35);
    let mean: [f64; 3] = [0, 1, 2]
        .map(|k| texels.iter().map(|texel| f64::from(texel[k])).sum::<f64>() / 35.0 / 255.0);
    for size in [1e-2, 1e-4, 1e-6, 1e-9] {
        let wall = plane([0.1, 0.2, 0.0], [size, 0.1 * size, 0.0], [0.0, size, 0.0], "unlit");
        for filter in [Filter::Box, Filter::Tent] {
            let seen = picture(&paper("", &wall, 7, &texels), 16, filter);
            // A pixel is an eighth wide and its box twice as wide. Of the many periods in it, at
            // most one at each border is incomplete.
            let periods = 0.25 / size;
            for pixel in &seen.pixels {
                for (light, mean) in pixel.iter().zip(mean) {
                    let error = (f64::from(*light) - mean).abs();
                    assert!(error < 0.6 / periods + HALF_STEP, "{size:e} {filter:?}: {error:e}");
                }
            }
        }
    }
}

#[test]
fn a_footprint_of_a_pole_and_a_seam_at_once_is_an_average_of_its_rows() {
    // The pole is seen from nearly above. Rows of uniform colour stay separate, in all columns.
    let rows: Vec<[u8; 3]> =
        (0..64 * 32).map(|k| if (k / 64) < 16 { [204, 51, 51] } else { [51, 204, 51] }).collect();
    for eye in [[0.0, 3.0, -0.4], [0.0, 3.0, 0.0], [0.3, 3.0, -0.01]] {
        let camera = format!(
            r#""camera": {{ "eye": {eye:?}, "target": [0, 0, 0], "up": [0, 0, 1], "fov_deg": 20 }},"#
        );
        let globe = sphere([0.0; 3], 1.0, "unlit");
        // At a pole the square of a mip-map covers the whole row, and equally many rows.
        for filter in FILTERS.into_iter().filter(|&filter| filter != Filter::Mip) {
            let seen = picture(&paper(&camera, &globe, 64, &rows), 41, filter);
            // The northern half is uniform. Colours beyond the pole or the seam must not appear.
            for (x, y, pixel) in pixels(&seen) {
                let near = (pixel[0] - 0.8).abs() < STEP && (pixel[1] - 0.2).abs() < STEP;
                assert!(near, "{filter:?} at {x} {y}: {pixel:?}");
            }
        }
    }
}
