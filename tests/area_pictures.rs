//! Pictures fitted to areas of a swept surface, from a spec to pixels: seams, borders, poles.

use crate::studio;

use files::json::Document;
use glam::DVec3;
use render::filter::Filter;
use render::{Picture, Scene};
use serde_json::{Value, json};
use studio::{assert_near, at, picture, pixels, png, scene, supersampled};
use sweep::{GridMesh, Sweep};
use triangulate::Options;

const AREA_FILTERS: [Filter; 2] = [Filter::Box, Filter::Tent];

pub fn swept(keys: &Value) -> GridMesh {
    let mut spec = json!({ "format": "tb-sweep", "version": 1, "name": "test" });
    for (key, value) in keys.as_object().expect("keys") {
        spec[key] = value.clone();
    }
    let text = spec.to_string();
    let document = Document::new("test", text.as_bytes()).expect("it is JSON");
    Sweep::read(&document).unwrap_or_else(|error| panic!("{error}")).grid()
}

/// Returns a tube of radius 1 along y, from -1.5 to 1.5, of three rows of 96 cells.
fn tube(areas: &Value) -> GridMesh {
    swept(&json!({
        "contour": {"circle": 1}, "trajectory": {"line": [[0, -1.5, 0], [0, 1.5, 0]]},
        "mesh": {"rows": 3, "cols": 96}, "areas": areas,
    }))
}

/// Returns a scene of the surface with pictures on it, unlit, by texture id.
pub fn shown(grid: &GridMesh, eye: DVec3, textures: &[(u32, usize, Vec<[u8; 3]>)]) -> Scene {
    let mut obj = Vec::new();
    triangulate::write_obj(grid, &Options::default(), &mut obj).expect("memory takes it");
    let mut files = vec![("m.obj".to_string(), obj)];
    let (mut pictures, mut bindings) = (json!({}), json!({}));
    for (id, width, texels) in textures {
        let name = format!("t{id}");
        pictures[&name] = json!({ "image": format!("{name}.png"), "values": "linear" });
        bindings[id.to_string()] = json!(name);
        files.push((format!("{name}.png"), png(*width, texels)));
    }
    let up = if eye.x == 0.0 && eye.z == 0.0 { [1, 0, 0] } else { [0, 1, 0] };
    let keys = json!({
        "camera": { "eye": eye.to_array(), "target": [0, 0, 0], "up": up, "fov_deg": 50 },
        "ambient": 1, "background": 0, "textures": pictures,
        "materials": { "unlit": { "diffuse": 0 } },
        "objects": [{ "mesh": { "name": "m", "file": "m.obj", "material": "unlit",
            "textures": bindings } }],
    });
    let keys = keys.to_string();
    let files: Vec<(&str, Vec<u8>)> =
        files.iter().map(|(name, bytes)| (name.as_str(), bytes.clone())).collect();
    scene(&keys[1..keys.len() - 1], &files)
}

/// Returns the direction from the axis of the tube to its seam.
fn seam(grid: &GridMesh) -> DVec3 {
    let first = grid.positions[0];
    DVec3::new(first.x, 0.0, first.z).normalize()
}

/// Returns 32 by 8 texels of many colours. The columns are moved by half the width, `turned` times.
fn many_colored(turned: usize) -> Vec<[u8; 3]> {
    let texel =
        |i: usize, j: usize| [37 * i % 256, 53 * j % 256, 29 * i * j % 256].map(|x| x as u8);
    (0..256).map(|k| texel((k + 16 * turned) % 32, k / 32)).collect()
}

#[test]
fn pictures_that_go_once_and_three_times_around_show_no_seam() {
    // Half a turn is half a picture for the first area, and one and a half for the second. Rotating
    // the picture and the eye by half a turn therefore moves the seam of both areas to the front.
    let grid = tube(&json!([
        {"rows": [0, 1], "cols": [0, 96], "texture": 1, "repeat": [1, 1]},
        {"rows": [1, 3], "cols": [0, 96], "texture": 1, "repeat": [3, 1]},
    ]));
    let eye = 5.0 * seam(&grid);
    for filter in AREA_FILTERS {
        let front = picture(&shown(&grid, eye, &[(1, 32, many_colored(1))]), 60, filter);
        let back = picture(&shown(&grid, -eye, &[(1, 32, many_colored(0))]), 60, filter);
        // Corners are rounded to f32, which moves the edges of texels slightly.
        assert_near(&front, &back, 1e-4);
    }
}

#[test]
fn an_area_that_ends_before_the_seam_keeps_its_picture_whole() {
    // From cell 24 to 72 of 96: the side away from the seam, and halfway around.
    let areas = json!([{"rows": [0, 3], "cols": [24, 72], "texture": 1, "repeat": [1, 1]}]);
    let mut grid = tube(&areas);
    grid.texture = Some(2);
    let ramp: Vec<[u8; 3]> = (0..256).map(|k| [k as u8; 3]).collect();
    let textures = [(1, 256, ramp), (2, 1, vec![[0, 0, 255]])];
    let eye = -5.0 * seam(&grid);
    let truth = supersampled(&shown(&grid, eye, &textures), 60, 8, Filter::Point);
    for filter in AREA_FILTERS {
        let seen = picture(&shown(&grid, eye, &textures), 60, filter);
        let mut inside = 0;
        for ((x, y, pixel), truth) in pixels(&seen).zip(&truth.pixels) {
            // Pixels in the middle of the tube, away from the sky beside it.
            let grey = pixel[0] == pixel[2] && (truth[0] - truth[2]).abs() < 1e-6;
            if grey && (22..38).contains(&x) && (18..42).contains(&y) {
                inside += 1;
                // The footprint is two pixels wide and the truth's one. At the sides of the tube
                // the ramp is not linear, which costs a few hundredths.
                let error = (pixel[0] - truth[0]).abs();
                assert!(error < 0.03, "{filter:?} at {x} {y}: {pixel:?} {truth:?}");
            }
        }
        assert_eq!(inside, 16 * 24);
    }
}

#[test]
fn areas_of_one_mesh_show_their_own_textures_and_never_mix() {
    let grid = tube(&json!([
        {"rows": [0, 1], "cols": [0, 96], "texture": 1, "repeat": [3, 1]},
        {"rows": [1, 2], "cols": [0, 48], "texture": 2},
        {"rows": [1, 2], "cols": [48, 96], "texture": 3},
        {"rows": [2, 3], "cols": [0, 96], "texture": 4, "repeat": [0.5, 2]},
    ]));
    let plain = [[200, 0, 0], [0, 200, 0], [0, 0, 200], [200, 200, 0]];
    let textures: Vec<_> = (1..).zip(plain).map(|(id, color)| (id, 4, vec![color; 16])).collect();
    let scene = shown(&grid, 5.0 * seam(&grid), &textures);
    let points = picture(&scene, 61, Filter::Point);
    for filter in AREA_FILTERS {
        // A pixel shows the area on which its middle lies, whatever its neighbours show.
        assert_near(&picture(&scene, 61, filter), &points, 1e-6);
    }
    let [upper, middle, lower] = [15, 30, 45].map(|y| at(&points, 26, y));
    let green_or_blue = middle[0] == 0.0 && middle[1] + middle[2] > 0.7;
    assert!(green_or_blue, "{middle:?}");
    assert!(upper[0] > 0.7 && upper[1] > 0.7 && lower[0] > 0.7 && lower[1] == 0.0);
    // The seam is in front, where the second and the third area meet.
    assert_ne!(at(&points, 26, 30), at(&points, 34, 30));
}

#[test]
fn where_two_areas_of_one_texture_meet_neither_blurs() {
    // The picture ends white in one area and begins black in the next.
    let grid = tube(&json!([
        {"rows": [0, 3], "cols": [0, 48], "texture": 1},
        {"rows": [0, 3], "cols": [48, 96], "texture": 1},
    ]));
    let ramp: Vec<[u8; 3]> = (0..256).map(|k| [k as u8; 3]).collect();
    let scene = shown(&grid, 5.0 * seam(&grid), &[(1, 256, ramp)]);
    let points = picture(&scene, 60, Filter::Point);
    let steps = |picture: &Picture| {
        let row: Vec<f32> = (20..40).map(|x| at(picture, x, 30)[0]).collect();
        row.windows(2).map(|pair| (pair[0] - pair[1]).abs()).fold(0.0, f32::max)
    };
    assert!(steps(&points) > 0.9, "the border is in view");
    for filter in AREA_FILTERS {
        let seen = picture(&scene, 60, filter);
        assert!(steps(&seen) > 0.9, "{filter:?}: {}", steps(&seen));
    }
}

#[test]
fn over_the_mirrored_seam_of_a_moebius_band_nothing_blurs() {
    // The picture goes from black to white across the band. At the seam both ends meet upside down.
    let grid = swept(&json!({
        "contour": {"svg": "M-0.45 0H0.45"}, "trajectory": {"circle": {"radius": 1.2}},
        "twist": {"total": 180}, "seam": "mirror", "mesh": {"rows": 180, "cols": 16},
        "areas": [{"rows": [0, 180], "cols": [0, 16], "texture": 1, "repeat": [1, 8]}],
    }));
    let ramp: Vec<[u8; 3]> = (0..64).map(|k| [4 * k as u8; 3]).collect();
    let first = grid.positions[8];
    let eye = first.normalize() * 4.0 + DVec3::Y * 1.0;
    let scene = shown(&grid, eye, &[(1, 64, ramp)]);
    let points = picture(&scene, 90, Filter::Bilinear);
    for filter in AREA_FILTERS {
        let seen = picture(&scene, 90, filter);
        // The seam is in the middle. Further right the band hides itself, and one box contains
        // nodes of both parts.
        let window = pixels(&seen).filter(|(x, y, _)| (30..58).contains(x) && (50..58).contains(y));
        for (x, y, pixel) in window {
            let near = |(dx, dy): (i64, i64)| {
                let (x, y) = ((i64::from(x) + dx).clamp(0, 89), (i64::from(y) + dy).clamp(0, 89));
                at(&points, x as u32, y as u32)[0]
            };
            let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| near((dx, dy))));
            let (low, high) = around.fold((1f32, 0f32), |(l, h), x| (l.min(x), h.max(x)));
            // A pixel blends only nearby colours.
            assert!((low - 0.02..=high + 0.02).contains(&pixel[0]), "{filter:?} at {x} {y}");
            let smooth = high - low < 0.15;
            let own = at(&points, x, y)[0];
            // The average of a linear ramp is its middle. The tolerance is a third of the spread,
            // for the curvature.
            assert!(!smooth || (pixel[0] - own).abs() < 0.05, "{filter:?} at {x} {y}");
        }
    }
}

#[test]
fn the_pole_of_a_swept_sphere_is_calm() {
    let grid = swept(&json!({
        "contour": {"bezier": {"segments": [
            [[0, -1], [0.5523, -1], [1, -0.5523], [1, 0]],
            [[1, 0], [1, 0.5523], [0.5523, 1], [0, 1]]]}},
        "trajectory": {"rotation": {}}, "mesh": {"rows": 96, "cols": 48},
        "uv": {"across": "trajectory"},
    }));
    let mut grid = grid;
    grid.texture = Some(1);
    // Black and white, as different as possible from texel to texel; all columns meet at the pole.
    let noise = |k: u64| if (k * 0x9e37_79b9_7f4a_7c15) >> 63 == 0 { 0 } else { 255 };
    let texels: Vec<[u8; 3]> = (0..128 * 64).map(|k| [noise(k * k + 7 * k); 3]).collect();
    let scene = shown(&grid, DVec3::new(0.0, 5.0, 0.0), &[(1, 128, texels)]);
    let truth = supersampled(&scene, 41, 16, Filter::Point);
    let error = |picture: &Picture| {
        let near_pole = pixels(picture)
            .filter(|&(x, y, _)| (f64::from(x) - 20.0).hypot(f64::from(y) - 20.0) < 6.0)
            .map(|(x, y, pixel)| f64::from(pixel[0] - at(&truth, x, y)[0]));
        let errors: Vec<f64> = near_pole.collect();
        let square: f64 = errors.iter().map(|error| error * error).sum();
        let largest = errors.iter().fold(0.0, |most: f64, error| most.max(error.abs()));
        [(square / errors.len() as f64).sqrt(), largest]
    };
    let [point, _] = error(&picture(&scene, 41, Filter::Point));
    for filter in AREA_FILTERS {
        let [rms, largest] = error(&picture(&scene, 41, filter));
        println!("{filter:?}: rms {rms:.3}, largest {largest:.3}; point sampled {point:.3}");
        assert!(rms < 0.4 * point, "{filter:?}: {rms} against {point}");
        assert!(largest < 0.4, "{filter:?}: {largest}");
    }
}
