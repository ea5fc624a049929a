//! Limits of the thesis's method that area sampling does not have: specks at outlines and along
//! mirrored seams, and blurred outlines of surfaces that hide a part of themselves.

use crate::area_pictures::{shown, swept};

use glam::DVec3;
use render::film::{Pattern, PixelFilter, THRESHOLD};
use render::filter::Filter;
use render::{Picture, Prepared, Sampling, Scene, Settings};
use serde_json::json;

const SIDE: u32 = 96;

fn exposed(scene: &Scene, sampling: Sampling, filter: Filter) -> Picture {
    let settings = Settings { sampling, ..Settings::new(SIDE, SIDE, filter) };
    render::render(&Prepared::new(scene), &settings, &|_, _| {}).0
}

/// The pictures of a scene by many rays, by the thesis's method and by area sampling, with one ray
/// for each pixel before any splits.
struct Pictures {
    truth: Picture,
    thesis: Picture,
    area: Picture,
}

impl Pictures {
    fn of(scene: &Scene) -> Self {
        let pixel_filter = PixelFilter::Box;
        let many =
            Sampling::Grid { samples: 24, pattern: Pattern::Jitter { seed: 1 }, pixel_filter };
        let area = Sampling::Area { samples: 1, pixel_filter, threshold: Some(THRESHOLD) };
        Self {
            truth: exposed(scene, many, Filter::Bilinear),
            thesis: exposed(scene, Sampling::regular(1), Filter::Tent),
            area: exposed(scene, area, Filter::Exact),
        }
    }

    /// Root mean square errors of the thesis's method and of area sampling where `counts` is true.
    fn errors(&self, counts: impl Fn(usize) -> bool) -> [f64; 2] {
        let chosen: Vec<usize> = (0..self.truth.pixels.len()).filter(|&k| counts(k)).collect();
        assert!(chosen.len() > 20, "{}", chosen.len());
        [&self.thesis, &self.area].map(|picture| {
            let square = |k: &usize| {
                let pairs = picture.pixels[*k].iter().zip(self.truth.pixels[*k]);
                pairs.map(|(a, b)| f64::from(a - b).powi(2)).sum::<f64>() / 3.0
            };
            (chosen.iter().map(square).sum::<f64>() / chosen.len() as f64).sqrt()
        })
    }
}

/// Black and white checks of 8 by 8 texels.
fn checks() -> Vec<[u8; 3]> {
    (0..4096).map(|k| if (k / 8 + k / 512) % 2 == 0 { [255; 3] } else { [0; 3] }).collect()
}

/// A band with one side, its picture mirrored at the seam.
fn band(eye: impl Fn(DVec3) -> DVec3) -> Scene {
    let grid = swept(&json!({
        "contour": {"svg": "M-0.45 0H0.45"}, "trajectory": {"circle": {"radius": 1.2}},
        "twist": {"total": 180}, "seam": "mirror", "mesh": {"rows": 180, "cols": 16},
        "areas": [{"rows": [0, 180], "cols": [0, 16], "texture": 1, "repeat": [2, 12]}],
    }));
    shown(&grid, eye(grid.positions[8]), &[(1, 64, checks())])
}

#[test]
fn a_mirrored_seam_shows_no_specks() {
    // The seam is in the middle of the picture.
    let pictures = Pictures::of(&band(|first| first.normalize() * 4.0 + DVec3::Y));
    let (middle, reach) = (f64::from(SIDE) / 2.0, 8.0);
    let near = |k: usize| {
        let (x, y) = (k as u32 % SIDE, k as u32 / SIDE);
        (f64::from(x) - middle).abs() < reach && (f64::from(y) - middle).abs() < 2.0 * reach
    };
    let [thesis, area] = pictures.errors(|k| near(k) && pictures.truth.pixels[k][0] > 0.0);
    println!("seam: thesis {thesis:.4}, area {area:.4}");
    // A point sample of black and white checks is off by up to 1.
    assert!(area < 0.25 * thesis, "{area}, and {thesis} by the thesis's method");
}

#[test]
fn outlines_show_no_specks_and_no_blur_where_a_surface_hides_a_part_of_itself() {
    let pictures = Pictures::of(&band(|first| first.normalize() * 3.0 + 1.5 * DVec3::Y));
    // The background is black, and the far part of the band is behind the near one. Around all
    // outlines the one ray of a pixel and its neighbours differ most from the truth.
    let wrong = |k: usize| {
        let pairs = pictures.thesis.pixels[k].iter().zip(pictures.truth.pixels[k]);
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max) > 0.1
    };
    let [thesis, area] = pictures.errors(wrong);
    println!("outlines: thesis {thesis:.4}, area {area:.4}");
    assert!(area < 0.25 * thesis, "{area}, and {thesis} by the thesis's method");
}
