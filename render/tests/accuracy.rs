//! Audits and requested errors, compared with the errors of whole pictures.

use crate::bench;
use crate::studio;

use bench::{Bench, ending};
use render::accuracy::{Request, audit};
use render::film::{Pattern, PixelFilter};
use render::filter::Filter;
use render::stats::Stats;
use render::{Picture, Prepared, Sampling, Scene, Settings};
use std::sync::atomic::{AtomicUsize, Ordering};
use studio::{png, scene};

/// A floor of coarse noise up to the horizon, a glass ball and a mirror ball, and a light.
fn room() -> Scene {
    let texel = |k: u32| [k * 37 % 256, 255 - k * 11 % 256, k * k * 91 % 256].map(|x| x as u8);
    let texels: Vec<[u8; 3]> = (0..256).map(texel).collect();
    let keys = r#""camera": { "eye": [0, 1, 4], "target": [0, 0.6, 0], "fov_deg": 40 },
        "ambient": 0.6, "background": 0.25,
        "lights": [ { "point": { "position": [3, 4, 5], "color": 0.4 } } ],
        "textures": { "noise": { "image": "noise.png" } },
        "materials": { "floor": { "diffuse": 0.4 }, "mirror": { "reflectivity": 0.9 },
          "glass": { "transparency": 1, "reflectivity": 1, "fresnel": true, "ambient": 0,
            "diffuse": 0 } },
        "objects": [
          { "plane": { "point": [0, 0, 0], "edge_u": [2, 0, 0.1], "edge_v": [0.1, 0, -2],
            "material": "floor", "texture": "noise" } },
          { "sphere": { "center": [-0.6, 0.5, 0.2], "radius": 0.5, "material": "mirror" } },
          { "sphere": { "center": [0.6, 0.6, 0.4], "radius": 0.5, "material": "glass" } } ]"#;
    scene(keys, &[("noise.png", png(16, &texels))])
}

/// Two pictures by brute force with independent noise.
fn truths(
    prepared: &Prepared<'_>,
    side: u32,
    samples: u32,
    pixel_filter: PixelFilter,
) -> [Picture; 2] {
    [1, 2].map(|seed| {
        let pattern = Pattern::Jitter { seed };
        let sampling = Sampling::Grid { samples, pattern, pixel_filter };
        let settings = Settings { sampling, ..Settings::new(side, side, Filter::Bilinear) };
        render::render(prepared, &settings, &|_, _| {}).0
    })
}

/// Returns the mean squared error of a picture.
fn squared_error(picture: &Picture, [a, b]: &[Picture; 2]) -> f64 {
    let lights = picture.pixels.as_flattened().iter().map(|&light| f64::from(light));
    let pairs = a.pixels.as_flattened().iter().zip(b.pixels.as_flattened());
    let sum: f64 =
        lights.zip(pairs).map(|(m, (a, b))| (m - f64::from(*a)) * (m - f64::from(*b))).sum();
    sum / (3.0 * picture.pixels.len() as f64)
}

/// The audit of a picture agrees with its error over all pixels, for methods of both families and
/// for pixel filters. A bound fails in one of twenty cases, and none of these six fails.
#[test]
fn an_audit_agrees_with_the_error_of_all_pixels() {
    let scene = room();
    let prepared = Prepared::new(&scene);
    let area =
        |samples, pixel_filter, threshold| Sampling::Area { samples, pixel_filter, threshold };
    for (filter, sampling, pixel_filter) in [
        (Filter::Tent, Sampling::regular(1), PixelFilter::Box),
        (Filter::Point, Sampling::regular(2), PixelFilter::Box),
        (Filter::Exact, area(1, PixelFilter::Box, None), PixelFilter::Box),
        (Filter::Exact, area(1, PixelFilter::Box, Some(0.1)), PixelFilter::Box),
        (Filter::Exact, area(1, PixelFilter::Tent, Some(0.1)), PixelFilter::Tent),
        (Filter::Exact, area(1, PixelFilter::Gaussian, None), PixelFilter::Gaussian),
    ] {
        let settings = Settings { sampling, ..Settings::new(64, 64, filter) };
        let (picture, mut stats) = render::render(&prepared, &settings, &|_, _| {});
        let statement = audit(&prepared, &settings, &picture, &mut stats);
        let error = squared_error(&picture, &truths(&prepared, 64, 12, pixel_filter)).sqrt();
        assert!(statement.bound > error, "{sampling:?}: {statement}, true {error}");
        // The bound of a mean lies at most 2.5 standard errors above it, and with 2000 draws these
        // are at most a third of the mean here.
        assert!(statement.bound < 1.6 * error, "{sampling:?}: {statement}, true {error}");
        assert!(stats.audit_rays > 0 && statement.audit > 0.0);
    }
}

#[test]
fn a_requested_error_is_reached() {
    let scene = room();
    let prepared = Prepared::new(&scene);
    let truths = truths(&prepared, 64, 24, PixelFilter::Box);
    let mut rays = 0;
    for wanted in [0.05, 0.02, 0.01, 0.005] {
        let settings = Settings::new(64, 64, Filter::Exact);
        let reached = Request::new(&prepared, &settings, PixelFilter::Box).reach(wanted);
        let error = squared_error(&reached.picture, &truths).max(0.0).sqrt();
        assert!(error < wanted, "{}, true {error}", reached.statement);
        assert_eq!(reached.statement.missed, None);
        // The chosen settings make the same picture without a search.
        assert!(render::render(&prepared, &reached.settings, &|_, _| {}).0 == reached.picture);
        assert!(reached.stats.primary_rays >= rays, "a smaller error takes at least as many rays");
        rays = reached.stats.primary_rays;
    }
}

#[test]
fn pictures_and_statements_do_not_depend_on_threads() {
    let scene = room();
    let made = |threads| {
        let prepared = Prepared::new(&scene);
        let settings = Settings::new(50, 40, Filter::Exact);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let reached = Request::new(&prepared, &settings, PixelFilter::Box).reach(0.01);
            let mut stats = Stats::default();
            let audited = audit(&prepared, &reached.settings, &reached.picture, &mut stats);
            (reached.picture, reached.statement, audited)
        })
    };
    assert!(made(1) == made(3));
}

/// Nothing in a picture of one colour can be wrong, and one ray for each pixel suffices.
#[test]
fn a_plain_wall_has_no_error() {
    let bench = Bench::with_scene(bench::WALL);
    let arguments = ["scene.json", "--size", "16x16", "-o", "out.png", "--error", "8bit"];
    let (code, words) = ending(&bench.run(&arguments, b""));
    assert_eq!(code, Some(0), "{words}");
    assert!(words.starts_with("error 0.0, below 0.00040 with 95 % confidence; "), "{words}");
}

/// A white disk before black. No sampling of the ladder finds the parts of the pixels under its edge to
/// within the request.
#[test]
fn a_request_that_is_out_of_reach_has_an_exit_code_of_its_own() {
    let scene = r#"{ "format": "tb-scene", "version": 1, "ambient": 1, "background": 0,
        "camera": { "eye": [0, 0, 4], "target": [0, 0, 0], "fov_deg": 40 },
        "materials": { "white": { "diffuse": 0 } },
        "objects": [ { "sphere": { "center": [0, 0, 0], "radius": 1, "material": "white" } } ] }"#;
    let bench = Bench::with_scene(scene);
    let arguments = ["scene.json", "--size", "8x8", "-o", "out.png", "--error", "0.00005"];
    let (code, words) = ending(&bench.run(&arguments, b""));
    assert_eq!(code, Some(7), "{words}");
    let end = "; the requested error of 0.00005 was not reached\n";
    assert!(words.starts_with("render: error 0.00") && words.ends_with(end), "{words}");
    assert!(image::load_from_memory(&bench.read("out.png")).is_ok(), "the picture is written");
}

#[test]
fn contradictory_requests_are_refused_in_one_sentence() {
    let bench = Bench::with_scene(bench::WALL);
    let number = "expected a number above 0 and below 1";
    for (flags, message) in [
        ("--error 0", format!("--error 0: {number}")),
        ("--error -1", format!("--error -1: {number}")),
        ("--error NaN", format!("--error NaN: {number}")),
        ("--error inf", format!("--error inf: {number}")),
        ("--error much", "--error much: expected a number, such as 0.01, or 8bit".into()),
        ("--error 1e-6", "--error 1e-6: expected at least 0.0000076: texels".into()),
        ("--error 0.01 --samples 2", "--error chooses the rays, and --samples".into()),
        ("--error 0.01 --split 0.1", "--error chooses the rays, and --split".into()),
        ("--error 0.01 --sampling thesis", "--error chooses the rays, and --sampling".into()),
        ("--error 0.01 --time 3", "--error chooses the rays, and --time".into()),
        ("--time 3 --samples 2", "--time chooses the rays, and --samples".into()),
        ("--pixel 1,1 --error 0.1", "--error is about a whole picture".into()),
        ("--pixel 1,1 --audit", "--audit is about a whole picture".into()),
    ] {
        let arguments: Vec<&str> = ["scene.json"].into_iter().chain(flags.split(' ')).collect();
        bench.refuse(&arguments, b"", 2, &[&message]);
    }
    let layer = ["scene.json", "-o", "out.exr", "--sampling", "thesis", "--layers", "error"];
    let (code, words) = ending(&bench.run(&layer, b""));
    assert_eq!(code, Some(2));
    assert!(words.starts_with("render: --layers error shows an estimate"), "{words}");
}

/// The layer of rays sums to the rays of the picture without those around tiles.
#[test]
fn layers_show_where_rays_went() {
    let scene = room();
    let prepared = Prepared::new(&scene);
    let sampling =
        Sampling::Area { samples: 1, pixel_filter: PixelFilter::Box, threshold: Some(0.1) };
    let layers = vec![render::film::Layer::Error, render::film::Layer::Rays];
    let settings = Settings { sampling, layers, ..Settings::new(64, 64, Filter::Exact) };
    let (picture, stats) = render::render(&prepared, &settings, &|_, _| {});
    let sum: f32 = picture.channels[1].values.iter().sum();
    // One tile with one cell around it.
    assert_eq!(sum as u64, stats.primary_rays - (66 * 66 - 64 * 64));
    for (error, rays) in picture.channels[0].values.iter().zip(&picture.channels[1].values) {
        // A pixel of one ray was below the threshold; four rays and more follow a split.
        assert!(*rays == 1.0 || *rays >= 5.0);
        assert!(*error <= 0.1 || *rays > 1.0, "{error}, {rays}");
    }
}

/// Whenever the work is ended, the answer is none, and little work follows.
#[test]
fn a_request_that_is_left_has_no_picture() {
    let scene = room();
    let prepared = Prepared::new(&scene);
    let settings = Settings::new(80, 80, Filter::Exact);
    let asked = AtomicUsize::new(0);
    let count = || {
        asked.fetch_add(1, Ordering::Relaxed);
        true
    };
    let request = Request::new(&prepared, &settings, PixelFilter::Box);
    let whole = Request { go_on: &count, ..request }.reach_or_leave(0.01).unwrap();
    assert!(whole.picture == request.reach(0.01).picture);
    let all = asked.load(Ordering::Relaxed);
    assert!(all > 200, "the question is asked for each row of a tile: {all}");
    for part in 0..8 {
        let left = AtomicUsize::new(all * part / 8);
        let go_on = || {
            left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(1))
                .is_ok()
        };
        assert!(Request { go_on: &go_on, ..request }.reach_or_leave(0.01).is_none(), "{part}");
    }
}
