//! Area sampling: one ray for a cell, and cells that split.

use crate::studio;

use glam::DVec2;
use render::film::{PixelFilter, THRESHOLD};
use render::filter::Filter;
use render::stats::Stats;
use render::{Picture, Prepared, Sampling, Scene, Settings};
use studio::{png, scene};

const SIDE: u32 = 64;

fn area(pixel_filter: PixelFilter, threshold: Option<f64>) -> Sampling {
    Sampling::Area { samples: 1, pixel_filter, threshold }
}

fn exposed(scene: &Scene, sampling: Sampling, filter: Filter) -> (Picture, Stats) {
    let settings = Settings { sampling, ..Settings::new(SIDE, SIDE, filter) };
    let (picture, stats) = render::render(&Prepared::new(scene), &settings, &|_, _| {});
    assert_eq!(stats.not_finite, 0);
    (picture, stats)
}

/// A picture whose error is far below that of one ray per cell: 32 by 32 rays in each pixel.
fn truth(scene: &Scene, pixel_filter: PixelFilter) -> Picture {
    let pattern = render::film::Pattern::Jitter { seed: 1 };
    exposed(scene, Sampling::Grid { samples: 32, pattern, pixel_filter }, Filter::Bilinear).0
}

/// Root mean square difference over the pixels for which `counts` is true, and the number of these
/// pixels.
fn error(a: &Picture, b: &Picture, counts: impl Fn(usize) -> bool) -> (f64, usize) {
    let chosen: Vec<usize> = (0..a.pixels.len()).filter(|&k| counts(k)).collect();
    let squares = chosen
        .iter()
        .flat_map(|&k| a.pixels[k].iter().zip(b.pixels[k]).map(|(a, b)| f64::from(a - b).powi(2)));
    ((squares.sum::<f64>() / (3 * chosen.len()) as f64).sqrt(), chosen.len())
}

/// A white ball on black, seen along the axis z.
fn moon() -> Scene {
    let keys = r#""camera": { "eye": [0, 0, 4], "target": [0, 0, 0], "fov_deg": 40 },
        "ambient": 1, "background": 0,
        "materials": { "white": { "diffuse": 0 } },
        "objects": [ { "sphere": { "center": [0, 0, 0], "radius": 1, "material": "white" } } ]"#;
    scene(keys, &[])
}

/// The part of each pixel that the white ball covers, by a closed form: its outline is a circle.
fn covered(column: u32, row: u32) -> f64 {
    let radius = 1.0 / 15.0_f64.sqrt() / 20.0_f64.to_radians().tan() * f64::from(SIDE) / 2.0;
    let parts = 64;
    let inside = |k: i32| {
        let at = DVec2::new(f64::from(k % parts), f64::from(k / parts)) + 0.5;
        let at = at / f64::from(parts) + DVec2::new(f64::from(column), f64::from(row));
        usize::from((at - f64::from(SIDE) / 2.0).length() < radius)
    };
    (0..parts * parts).map(inside).sum::<usize>() as f64 / f64::from(parts * parts)
}

#[test]
fn the_outline_of_a_ball_shows_how_much_of_each_pixel_it_covers() {
    let (picture, stats) = exposed(&moon(), area(PixelFilter::Box, Some(THRESHOLD)), Filter::Exact);
    let (mut worst, mut squares, mut cut) = (0.0_f64, 0.0, 0);
    for row in 0..SIDE {
        for column in 0..SIDE {
            let shown = f64::from(picture.pixels[(row * SIDE + column) as usize][0]);
            let truth = covered(column, row);
            worst = worst.max((shown - truth).abs());
            if truth > 0.0 && truth < 1.0 {
                squares += (shown - truth).powi(2);
                cut += 1;
            }
        }
    }
    // No cell is left whole with an error above the threshold. The estimate is a mean over all
    // positions of an edge, and the largest error is twice as large. One ray has 0.29.
    assert!(worst <= THRESHOLD, "{worst}");
    let rms = (squares / f64::from(cut)).sqrt();
    assert!(rms <= 0.03, "{rms}");
    // The outline crosses about 4 * 2 * 27 of the 4096 pixels. These pixels and those beside them
    // have 4 to 20 rays more, and the samples around the tile count as well.
    assert!(stats.primary_rays < 4096 * 3, "{}", stats.primary_rays);
}

#[test]
fn without_splitting_every_cell_has_one_ray() {
    let (picture, stats) = exposed(&moon(), area(PixelFilter::Box, None), Filter::Exact);
    assert_eq!(stats.primary_rays, u64::from(SIDE * SIDE));
    assert!(picture.pixels.iter().all(|pixel| pixel[0] == 0.0 || pixel[0] == 1.0));
}

/// A floor in the light of a lamp, with the shadow of a card.
fn card() -> Scene {
    let keys = r#""camera": { "eye": [0, 4, 3], "target": [0, 0, 0], "fov_deg": 50 },
        "ambient": 0.1, "background": 0,
        "lights": [ { "point": { "position": [1, 4, 1], "color": 1 } } ],
        "materials": { "floor": { "diffuse": 0.9, "ambient": 1 } },
        "objects": [ { "plane": { "point": [0, 0, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, -1],
            "material": "floor" } },
          { "rectangle": { "corner": [-0.7, 1.1, -0.4], "edge_u": [0.9, 0.1, 0.2],
            "edge_v": [0.1, 0, 0.7], "material": "floor" } } ]"#;
    scene(keys, &[])
}

#[test]
fn edges_of_shadows_are_smooth() {
    let scene = card();
    let truth = truth(&scene, PixelFilter::Box);
    let (split, _) = exposed(&scene, area(PixelFilter::Box, Some(THRESHOLD)), Filter::Exact);
    let (whole, _) = exposed(&scene, area(PixelFilter::Box, None), Filter::Exact);
    let edge = |k: usize| (whole.pixels[k][0] - truth.pixels[k][0]).abs() > 0.02;
    let (before, count) = error(&whole, &truth, edge);
    let (after, _) = error(&split, &truth, edge);
    assert!(count > 50, "{count}");
    // Sixteen parts or more instead of one ray.
    assert!(after < 0.25 * before, "{after} instead of {before}");
}

/// A glass ball and a mirror over a floor with a fine pattern.
fn still_life() -> Scene {
    let texels: Vec<[u8; 3]> = (0..256_u32)
        .map(|k| if (k / 8 + k / 128) % 2 == 0 { [230, 200, 26] } else { [26, 90, 230] })
        .collect();
    let keys = r#""camera": { "eye": [0.3, 1.5, 5], "target": [0, 0.8, 0], "fov_deg": 40 },
        "ambient": 1, "background": [0.2, 0.3, 0.4],
        "textures": { "checks": { "image": "checks.png", "values": "linear" } },
        "materials": { "floor": { "diffuse": 0 },
          "glass": { "transparency": 1, "reflectivity": 1, "fresnel": true, "ambient": 0,
            "diffuse": 0 },
          "mirror": { "reflectivity": 0.9, "ambient": 0, "diffuse": 0 } },
        "objects": [ { "plane": { "point": [0, 0, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, -1],
            "material": "floor", "texture": "checks" } },
          { "sphere": { "center": [-0.8, 0.8, 0], "radius": 0.8, "material": "glass", "ior": 1.5 } },
          { "sphere": { "center": [1.0, 0.9, -0.6], "radius": 0.9, "material": "mirror" } } ]"#;
    scene(&keys.replace(r#", "ior": 1.5 }"#, " }"), &[("checks.png", png(16, &texels))])
}

#[test]
fn a_floor_in_glass_and_in_a_mirror_keeps_the_error_of_the_default() {
    let scene = still_life();
    let truth = truth(&scene, PixelFilter::Box);
    let (picture, stats) = exposed(&scene, area(PixelFilter::Box, Some(THRESHOLD)), Filter::Exact);
    // The truth's own error is about 0.002, at edges.
    let (found, _) = error(&picture, &truth, |_| true);
    assert!(found < 0.012, "{found}");
    assert!(stats.primary_rays < 8 * 4096, "{}", stats.primary_rays);
}

#[test]
fn tent_and_gaussian_are_those_of_many_rays() {
    let scene = still_life();
    for pixel_filter in [PixelFilter::Tent, PixelFilter::Gaussian] {
        let truth = truth(&scene, pixel_filter);
        let (picture, _) = exposed(&scene, area(pixel_filter, Some(THRESHOLD)), Filter::Exact);
        let (found, _) = error(&picture, &truth, |_| true);
        // The filter is constant on each half of a pixel.
        assert!(found < 0.012, "{pixel_filter:?}: {found}");
    }
}
