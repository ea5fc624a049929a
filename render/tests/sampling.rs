//! Sums of the rays of a pixel, compared with pictures of other sizes and with known areas.

use crate::studio;

use clap::ValueEnum;
use fixtures::rounding::STEP;
use render::accel::Structure;
use render::film::{Pattern, PatternName, PixelFilter, Supersample};
use render::filter::Filter;
use render::{Picture, Prepared, Sampling, Scene, Settings};
use serde::de::DeserializeOwned;
use std::fmt::Debug;
use studio::{FILTERS, assert_near, at, pixels, png, scene};

const IMAGE: Sampling = Sampling::Supersample(Supersample::Image);
const RAYS: Sampling = Sampling::Supersample(Supersample::Rays);

fn exposed(scene: &Scene, side: u32, sampling: Sampling, filter: Filter) -> Picture {
    let settings = Settings { sampling, ..Settings::new(side, side, filter) };
    render::render(&Prepared::new(scene), &settings, &|_, _| {}).0
}

/// A wall of many colours, placed so that no ray meets the edge of a texel. In front of it are a
/// lit ball and a glass ball. The eye is at (0, 0, 1), and `tangent` is that of half the angle of
/// view.
fn room(tangent: f64, objects: &str) -> Scene {
    let texel = |k: u8| [k.wrapping_mul(37), 255 - k.wrapping_mul(11), k.wrapping_mul(91)];
    let texels: Vec<[u8; 3]> = (0..64).map(texel).collect();
    let fov = 2.0 * tangent.atan().to_degrees();
    let keys = format!(
        r#""camera": {{ "eye": [0, 0, 1], "target": [0, 0, 0], "fov_deg": {fov} }},
        "ambient": 1, "background": 0.25,
        "lights": [ {{ "point": {{ "position": [3, 4, 5], "color": 0.5 }} }} ],
        "textures": {{ "colours": {{ "image": "colours.png" }} }},
        "materials": {{ "wall": {{ "diffuse": 0 }}, "ball": {{ "diffuse": 0.8 }},
          "glass": {{ "transparency": 1, "reflectivity": 1, "fresnel": true, "ambient": 0,
            "diffuse": 0 }} }},
        "objects": [ {{ "plane": {{ "point": [-2.0131, -2.0077, 0], "edge_u": [1.5, 0.1, 0],
          "edge_v": [0.2, 1.4, 0], "material": "wall", "texture": "colours" }} }}{objects} ]"#
    );
    scene(&keys, &[("colours.png", png(8, &texels))])
}

/// Two balls. No ray of the tests is tangent to them, since then rounding alone would decide.
const BALLS: &str = r#", { "sphere": { "center": [-0.41, 0.3, 0.2], "radius": 0.2, "material": "ball",
  "texture": "colours" } }, { "sphere": { "center": [0.3, -0.2, 0.4], "radius": 0.15,
  "material": "glass" } }"#;

/// Averages a picture of `2 side + 1` pixels squared with the nine weights, as in the thesis: three
/// rows of the large picture make a row of the small one.
fn dwarfed(large: &Picture, side: u32) -> Picture {
    assert_eq!(large.width, 2 * side + 1);
    let mut small = Picture::black(side, side);
    for (k, pixel) in small.pixels.iter_mut().enumerate() {
        let (x, y) = (2 * (k as u32 % side) + 1, 2 * (k as u32 / side) + 1);
        for (dy, row) in [[1.0, 2.0, 1.0], [2.0, 4.0, 2.0], [1.0, 2.0, 1.0]].iter().enumerate() {
            for (dx, weight) in row.iter().enumerate() {
                let from = at(large, x + dx as u32 - 1, y + dy as u32 - 1);
                for (sum, light) in pixel.iter_mut().zip(from) {
                    *sum += weight / 16.0 * light;
                }
            }
        }
    }
    small
}

/// Renders the larger picture, in which every second pixel has its middle at the middle of one of
/// `side` by `side` pixels. It is half a small pixel wider, and so is its angle of view.
fn larger(side: u32, objects: &str, filter: Filter) -> Picture {
    let wider = f64::from(2 * side + 1) / f64::from(2 * side);
    exposed(&room(wider, objects), 2 * side + 1, Sampling::regular(1), filter)
}

#[test]
fn the_nine_weights_dwarf_a_larger_picture() {
    for filter in FILTERS {
        let small = exposed(&room(1.0, BALLS), 20, IMAGE, filter);
        // Nine values are summed in f32 here and in f64 by the renderer.
        assert_near(&small, &dwarfed(&larger(20, BALLS, filter), 20), 1e-6);
    }
}

#[test]
fn nine_rays_are_the_larger_picture_where_no_neighbours_are_looked_at() {
    let scene = room(1.0, BALLS);
    for filter in [Filter::Point, Filter::Bilinear] {
        let rays = exposed(&scene, 20, RAYS, filter);
        assert!(rays == exposed(&scene, 20, IMAGE, filter), "{filter:?}: to the last bit");
    }
}

#[test]
fn nine_rays_see_a_wall_through_one_box_which_is_their_pixel() {
    for filter in [Filter::Box, Filter::Tent] {
        let rays = exposed(&room(1.0, ""), 20, RAYS, filter);
        // In the larger picture too, the neighbours of the sample in the middle of a pixel are at
        // its border.
        let large = larger(20, "", filter);
        let mut middles = Picture::black(20, 20);
        for (k, pixel) in middles.pixels.iter_mut().enumerate() {
            *pixel = at(&large, 2 * (k as u32 % 20) + 1, 2 * (k as u32 / 20) + 1);
        }
        assert_near(&rays, &middles, STEP);
        // The method `image` is smoother by far more than the tolerance.
        let image = exposed(&room(1.0, ""), 20, IMAGE, filter);
        let apart = pixels(&image).zip(&rays.pixels).map(|((.., a), b)| (a[0] - b[0]).abs());
        assert!(apart.fold(0.0, f32::max) > 0.01);
    }
}

/// Returns every kind of sampling with `n * n` samples.
fn grids(n: u32) -> Vec<Sampling> {
    let mut grids = vec![IMAGE, RAYS];
    for pattern in [Pattern::Regular, Pattern::Jitter { seed: 1 }] {
        for pixel_filter in [PixelFilter::Box, PixelFilter::Tent] {
            grids.push(Sampling::Grid { samples: n, pattern, pixel_filter });
        }
    }
    grids
}

#[test]
fn a_constant_stays_constant_since_weights_sum_to_one() {
    let scene = scene(r#""background": [0.7, 0.1, 1.0], "objects": []"#, &[]);
    for n in [1, 2, 3, 5, 7] {
        for sampling in grids(n) {
            let picture = exposed(&scene, 5, sampling, Filter::Point);
            assert!(picture.pixels.iter().all(|&pixel| pixel == [0.7, 0.1, 1.0]), "{sampling:?}");
        }
    }
}

/// The right half of the view is white; the edge lies between two columns of pixels.
const HALF: &str = r#""ambient": 1, "materials": { "white": { "diffuse": 0 } },
"objects": [ { "rectangle": { "corner": [0, -3, 0], "edge_u": [3, 0, 0], "edge_v": [0, 6, 0],
"material": "white" } } ]"#;

#[test]
fn a_tent_over_an_edge_counts_the_area_beyond_it() {
    let scene = scene(HALF, &[]);
    for n in [2, 4, 8] {
        for sampling in grids(n) {
            let picture = exposed(&scene, 6, sampling, Filter::Point);
            // The edge is half a pixel from the middles beside it, and 1/2 (1/2)^2 of a tent lies
            // beyond it. No sample lies on the edge, jittered or not, so every sum is this area.
            // Some of the nine rays lie on the edge, and see white.
            let (left, right) = match sampling {
                Sampling::Grid { pixel_filter: PixelFilter::Box, .. } => (0.0, 1.0),
                Sampling::Grid { .. } => (0.125, 0.875),
                Sampling::Supersample(_) => (0.25, 1.0),
                Sampling::Area { .. } => unreachable!("no grid"),
            };
            for (x, _, pixel) in pixels(&picture) {
                let expected = [0.0, 0.0, left, right, 1.0, 1.0][x as usize];
                assert_eq!(pixel, [expected; 3], "{sampling:?}, column {x}");
            }
        }
    }
}

#[test]
fn jitter_is_right_on_the_average() {
    // The edge passes at a quarter of the third column from the left. With one ray each pixel is
    // black or white, and three quarters of the column are white.
    let scene = scene(&HALF.replace("[0, -3, 0]", "[-0.25, -3, 0]"), &[]);
    let sampling = |seed| Sampling::Grid {
        samples: 1,
        pattern: Pattern::Jitter { seed },
        pixel_filter: PixelFilter::Box,
    };
    let mut whites = 0.0;
    let seeds = 400;
    for seed in 0..seeds {
        let picture = exposed(&scene, 6, sampling(seed), Filter::Point);
        for (x, _, pixel) in pixels(&picture) {
            assert!(pixel == [0.0; 3] || pixel == [1.0; 3]);
            whites += if x == 2 { f64::from(pixel[0]) } else { 0.0 };
        }
    }
    let mean = whites / f64::from(6 * seeds as u32);
    // Five standard deviations of the mean of 2400 draws.
    assert!((mean - 0.75).abs() < 5.0 * (0.75 * 0.25 / 2400f64).sqrt(), "{mean}");
    let [one, other] = [1, 2].map(|seed| exposed(&scene, 6, sampling(seed), Filter::Point));
    assert!(one != other, "another seed is another picture");
}

/// Each name on the command line is also the name in JSON, since both come from the variant.
#[test]
fn names_on_the_command_line_are_those_in_json() {
    fn agree<T: ValueEnum + DeserializeOwned + PartialEq + Debug>() {
        for value in T::value_variants() {
            let name = value.to_possible_value().unwrap().get_name().to_string();
            assert_eq!(serde_json::from_value::<T>(name.into()).ok().as_ref(), Some(value));
        }
    }
    agree::<Filter>();
    agree::<Structure>();
    agree::<PatternName>();
    agree::<PixelFilter>();
    agree::<Supersample>();
    assert_eq!(Filter::value_variants(), Filter::ALL);
    assert_eq!(Structure::value_variants(), Structure::ALL);
}
