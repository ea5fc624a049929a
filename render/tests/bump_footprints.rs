//! Bumps averaged over footprints: derivatives, highlights and reflections.

use crate::differentials;
use crate::exact;
use crate::studio;

use differentials::{MAPS, compare, placed, room, smooth_ball};
use exact::dice::Dice;
use glam::DVec2;
use render::accel::Structure;
use render::filter::Filter;
use render::footprint::{Alone, Beam};
use render::shade::ShadeWork;
use render::trace::tree::IntersectionTree;
use render::trace::{RayCounts, Tracer};
use render::{Prepared, Scene};
use studio::objects::{mesh, quad, sphere};
use studio::{png, scene};

/// Part of the film so small that a bump over it is the bump at its middle, in pixels.
const POINT: f64 = 1e-6;

/// Every relief, with a strength that tilts normals by about 0.1 to 0.3.
const RELIEFS: [&str; 8] = [
    r#""noise": {}, "strength": 0.05"#,
    r#""noise": { "octaves": 3, "interpolation": "smoother" }, "strength": 0.03"#,
    r#""noise": { "octaves": 2, "interpolation": "linear" }, "strength": 0.05"#,
    r#""turbulence": { "octaves": 2 }, "strength": 0.05"#,
    r#""wall": {}, "strength": 0.03"#,
    r#""dnoise": { "interpolation": "smooth" }, "strength": 0.1"#,
    r#""image": { "file": "bump.png" }, "strength": 0.1"#,
    r#""image": { "file": "bump.png", "repeat": [2, 3], "mirror": true }, "strength": 0.03"#,
];

/// A picture of random heights.
fn heights() -> Vec<u8> {
    let mut dice = Dice::new(4);
    let texels: Vec<[u8; 3]> = (0..8 * 8).map(|_| [dice.below(256) as u8; 3]).collect();
    png(8, &texels)
}

#[test]
fn spreads_of_bumped_shapes_agree_with_differences() {
    let superquadric = |more: &str| {
        format!(
            r#"{{ "superquadric": {{ "center": [0.1, 0, 0.1], {more}, "material": "bumped" }} }}"#
        )
    };
    let objects = [
        sphere([0.1, 0.0, 0.0], 1.0, "bumped"),
        placed(&sphere([0.1, 0.0, 0.0], 0.8, "bumped"), MAPS[4]),
        quad([-1.2, -1.0, 0.0], [2.2, 0.1, 0.4], [0.2, 2.0, -0.6], "bumped"),
        placed(&quad([-1.2, -1.0, 0.0], [2.2, 0.1, 0.4], [0.2, 2.0, -0.6], "bumped"), MAPS[2]),
        superquadric(r#""radii": [1.1, 0.8, 0.9], "exponents": [0.6, 0.8]"#),
        placed(
            &superquadric(r#""radii": [0.4, 0.5, 0.35], "exponents": [0.6, 1.3], "ring": 1.7"#),
            MAPS[4],
        ),
        mesh("bumped"),
    ];
    let files = [("bump.png", heights()), ("m.obj", smooth_ball())];
    for (relief, seed) in RELIEFS.into_iter().zip(1..) {
        let place = if relief.contains("image") {
            ""
        } else {
            r#", "place": { "scale": 0.4, "rotate_deg": [10, 20, 30] }"#
        };
        let material = format!(
            r#", "bumped": {{ "reflectivity": 1, "transparency": 1, "fresnel": true,
            "bump": {{ {relief} {place} }} }}"#
        );
        let mut certain = 0;
        let mut uncertain = 0;
        for object in &objects {
            let compared = compare(&room(object, &material, &files), POINT, 40, seed);
            certain += compared.certain();
            uncertain += compared.uncertain;
        }
        // Neighbours on two sides of a crease of the relief have no certain difference.
        assert!(certain > 3000 && certain > 3 * uncertain, "{relief}: {certain} {uncertain}");
    }
}

/// Pixels of the region that is averaged.
const REGION: usize = 16;

/// Light in one channel of the pixels of a region: with one averaged ray in each, and with many exact
/// rays, of which the first is kept too.
struct Region {
    averaged: Vec<f64>,
    first: Vec<f64>,
    means: Vec<f64>,
}

impl Region {
    /// Renders the middle of a film of `size` pixels a side, with `rays` by `rays` exact rays in each
    /// pixel.
    fn of(scene: &Scene, size: f64, rays: usize) -> Self {
        let prepared = Prepared::new(scene);
        let (shader, _) = prepared.shader(Structure::Bvh, Filter::Box);
        let tracer = Tracer::new(scene, prepared.accel(Structure::Bvh), prepared.volumes());
        let (mut tree, mut counts) = (IntersectionTree::default(), RayCounts::default());
        let mut work = ShadeWork::default();
        let film = DVec2::splat(size);
        let mut dice = Dice::new(1);
        let mut region = Self { averaged: vec![], first: vec![], means: vec![] };
        for pixel in 0..REGION * REGION {
            let corner = DVec2::new((pixel % REGION) as f64, (pixel / REGION) as f64)
                + (0.5 * (size - REGION as f64)).floor();
            let middle = corner + 0.5;
            let differential = scene.camera.differential(middle, film, 1.0);
            let ray = scene.camera.ray(middle, film);
            tracer.trace_spread(&ray, &differential, &mut tree, &mut counts);
            let averaged = shader.shade(&Beam::of(&tree, DVec2::ZERO), &mut work, &mut ());
            region.averaged.push(averaged.x);
            let mut exact = |at: DVec2| {
                tracer.trace(&scene.camera.ray(at, film), &mut tree, &mut counts);
                shader.shade(&Alone::of(&tree), &mut work, &mut ()).x
            };
            region.first.push(exact(middle));
            let mut sum = 0.0;
            for k in 0..rays * rays {
                let cell = DVec2::new((k % rays) as f64, (k / rays) as f64);
                let inside = DVec2::new(dice.fraction(), dice.fraction());
                sum += exact(corner + (cell + inside) / rays as f64);
            }
            region.means.push(sum / (rays * rays) as f64);
        }
        region
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Root mean square of the differences of pixels from the mean of many rays.
fn error(values: &[f64], truth: &[f64]) -> f64 {
    let squares: Vec<f64> = values.iter().zip(truth).map(|(a, b)| (a - b).powi(2)).collect();
    mean(&squares).sqrt()
}

/// A relief so fine that a pixel sees many of its cells, and the slope of its steps is about 0.1.
const FINE: [&str; 5] = [
    r#""noise": { "octaves": 2 }, "strength": 0.002, "place": { "scale": 0.02 }"#,
    r#""turbulence": { "octaves": 2 }, "strength": 0.002, "place": { "scale": 0.02 }"#,
    r#""wall": {}, "strength": 0.0007, "place": { "scale": 0.01 }"#,
    r#""dnoise": {}, "strength": 0.15, "place": { "scale": 0.02 }"#,
    r#""image": { "file": "bump.png", "repeat": [2500, 2500] }, "strength": 0.00025"#,
];

/// Keys of a floor with a bump, 20 by 20 units, that the eye sees from 28 units away at 45 degrees. A
/// pixel of a film of 100 pixels a side sees about 0.1 by 0.14 units.
fn floor(material: &str, relief: &str, keys: &str, more: &str) -> Scene {
    let keys = format!(
        r#"{keys} "ambient": 1, "camera": {{ "eye": [0, 20, 20], "target": [0, 0, 0], "fov_deg": 20 }},
        "materials": {{ "m": {{ "ambient": 0, "diffuse": 0, {material}, "bump": {{ {relief} }} }}, "lit": {{
        "ambient": 1, "diffuse": 0 }} }}, "objects": [ {} {more} ]"#,
        quad([-10.0, 0.0, 10.0], [20.0, 0.0, 0.0], [0.0, 0.0, -20.0], "m")
    );
    scene(&keys, &[("bump.png", heights()), ("checker.png", checker()), ("half.png", half())])
}

/// A checker of black and white with squares of one texel.
fn checker() -> Vec<u8> {
    let texel = |k: usize| if (k % 16 + k / 16).is_multiple_of(2) { [255; 3] } else { [0; 3] };
    png(16, &(0..256).map(texel).collect::<Vec<_>>())
}

/// A picture of which the right half is white.
fn half() -> Vec<u8> {
    let texel = |k: usize| if k < 128 { [0; 3] } else { [255; 3] };
    png(256, &(0..256).map(texel).collect::<Vec<_>>())
}

/// Returns the root mean square of the differences of pixels from their right neighbours.
fn sparkle(values: &[f64]) -> f64 {
    let beside = |k: &usize| k % REGION + 1 < REGION;
    let pairs = (0..values.len()).filter(beside);
    mean(&pairs.map(|k| (values[k + 1] - values[k]).powi(2)).collect::<Vec<_>>()).sqrt()
}

/// Far away, a bump is roughness: one averaged ray for a pixel finds the highlight that many exact
/// rays find, while single exact rays sparkle.
#[test]
fn far_highlights_of_bumps_are_those_of_many_rays() {
    for relief in FINE {
        let light = r#""lights": [{ "directional": { "direction": [0, -1, 1.15] } }],"#;
        let scene = floor(r#""specular": 1, "shininess": 60"#, relief, light, "");
        let Region { averaged, first, means } = Region::of(&scene, 100.0, 8);
        // The lobe is round and has the tails of a normal distribution. That of the relief is longer
        // in the plane of incidence. The vectors of `dnoise` have a limited length, which leaves the
        // middle of the highlight darker.
        let tolerance = if relief.contains("dnoise") { 0.2 } else { 0.06 };
        let (found, truth) = (mean(&averaged), mean(&means));
        assert!((found / truth - 1.0).abs() < tolerance, "{relief}: {found} {truth}");
        let (calm, noisy) = (sparkle(&averaged), sparkle(&first));
        assert!(calm < 0.05 * noisy, "{relief}: {calm} {noisy}");
        // The mean of 64 rays deviates from the true mean by an eighth of one ray's deviation.
        let (off, single) = (error(&averaged, &means), error(&first, &means));
        assert!(off < 0.3 * single, "{relief}: {off} {single}");
    }
}

/// A wall of squares, and a wall that is white to the right of an edge, seen in a bumped mirror. One
/// averaged ray finds the share of white that many exact rays find.
#[test]
fn far_mirrors_with_bumps_reflect_as_many_rays_do() {
    for relief in FINE {
        for (picture, edge) in [("checker.png", 0.0), ("half.png", 3.0), ("half.png", -6.0)] {
            let corner = edge - 100.0;
            let wall = format!(
                r#", {{ "plane": {{ "point": [{corner:?}, -100, -30], "edge_u": [200, 0, 0],
                "edge_v": [0, 200, 0], "material": "lit", "texture": "t" }} }}"#
            );
            let texture = format!(r#""textures": {{ "t": {{ "image": "{picture}" }} }}, "#);
            let scene = floor(r#""reflectivity": 1"#, relief, &texture, &wall);
            let Region { averaged, first, means } = Region::of(&scene, 100.0, 8);
            // A footprint is even up to its border, and the deviation of mirrored rays is not: one
            // deviation from the edge, shares of 0.79 and 0.84 are white. 16384 rays deviate by 0.004.
            let (found, truth) = (mean(&averaged), mean(&means));
            assert!((found - truth).abs() < 0.07, "{relief}: {found} {truth}");
            let (calm, noisy) = (sparkle(&averaged), sparkle(&first));
            assert!(calm < 0.1 * noisy, "{relief}: {calm} {noisy}");
        }
    }
}

/// From near to far, the highlight of one averaged ray changes gradually: no octave or level of a
/// pyramid enters with a jump.
#[test]
fn the_averaged_bump_is_continuous_in_the_size_of_the_pixel() {
    for relief in FINE {
        let light = r#""lights": [{ "directional": { "direction": [0, -1, 1.15] } }],"#;
        let scene = floor(r#""specular": 1, "shininess": 60"#, relief, light, "");
        let prepared = Prepared::new(&scene);
        let (shader, _) = prepared.shader(Structure::Bvh, Filter::Box);
        let tracer = Tracer::new(&scene, prepared.accel(Structure::Bvh), prepared.volumes());
        let (mut tree, mut counts) = (IntersectionTree::default(), RayCounts::default());
        let mut work = ShadeWork::default();
        let film = DVec2::splat(100.0);
        let at = DVec2::new(50.3, 49.6);
        let ray = scene.camera.ray(at, film);
        tracer.trace(&ray, &mut tree, &mut counts);
        let exact = shader.shade(&Alone::of(&tree), &mut work, &mut ()).x;
        let mut over = |step: f64| {
            let differential = scene.camera.differential(at, film, step);
            tracer.trace_spread(&ray, &differential, &mut tree, &mut counts);
            shader.shade(&Beam::of(&tree, DVec2::ZERO), &mut work, &mut ()).x
        };
        assert_eq!(over(0.0), exact, "{relief}");
        // Sizes from a thousandth of a pixel to a hundred pixels, a hundredth apart.
        let mut before = exact;
        for k in 0..1160 {
            let now = over(1e-3 * 1.01f64.powi(k));
            // The whole change of brightness takes place over at least a factor of two in size.
            assert!((now - before).abs() < 0.05, "{relief} {k}: {before} {now}");
            before = now;
        }
    }
}
