//! Parts of a page, shown pixel by pixel in each mode and beside the truth.

use crate::job::Place;
use crate::truth::Pair;
use compare::read;
use render::film::{Crop, Layer};
use render::filter::Filter;
use render::{Picture, Prepared, Settings};

/// Side of a detail in pixels. Five details enlarged three times fit side by side on a desktop screen,
/// and two enlarged twice on a telephone.
pub const SIDE: u32 = 66;

/// Number of texels that a pixel must span in both directions to count as wide.
const WIDE: f64 = 2.0;

/// A part of a page.
#[derive(Debug)]
pub struct Detail {
    /// Description of what the part shows.
    pub title: String,
    /// The pixels of the part.
    pub crop: Crop,
    /// The part of each mode's picture, in the order of modes.
    pub pictures: Vec<Picture>,
    /// Errors of the parts, if they were measured.
    pub judged: Option<Judged>,
}

/// Errors of the parts.
#[derive(Debug)]
pub struct Judged {
    /// The part as it should be: the mean of both pictures of the truth.
    pub truth: Picture,
    /// Root mean square error of each mode in linear light, where white is 1.
    pub errors: Vec<f64>,
    /// Fraction of pixels that span more than two texels in both directions, in [0, 1].
    pub wide: f64,
    /// Errors over these wide pixels alone; empty if there are none.
    pub wide_errors: Vec<f64>,
}

impl Detail {
    /// Cuts the part around `place` out of the modes' pictures. Measures the part against a truth of
    /// `samples * samples` rays in each pixel, for each of two seeds, unless `samples` is 0.
    #[must_use]
    pub fn new(scene: &Prepared<'_>, place: &Place, pictures: &[&Picture], samples: u32) -> Self {
        let size = pictures.first().map_or((1, 1), |picture| (picture.width, picture.height));
        let crop = around(place, size);
        let pictures: Vec<Picture> =
            pictures.iter().map(|picture| read::part(picture, &crop)).collect();
        let judged = (samples > 0).then(|| {
            let truth = Pair::render(scene, size, crop, samples, &|_, _| {});
            let wide = wide_pixels(scene, size, crop);
            let errors = |among: &dyn Fn(usize) -> bool| {
                pictures.iter().filter_map(|picture| truth.error_of(picture, among)).collect()
            };
            let part = wide.iter().filter(|wide| **wide).count() as f64 / wide.len() as f64;
            Judged {
                truth: truth.mean(),
                errors: errors(&|_| true),
                wide: part,
                wide_errors: errors(&|place| wide[place]),
            }
        });
        Self { title: place.title.clone(), crop, pictures, judged }
    }
}

/// Returns the position where two pictures of the same size differ most.
#[must_use]
pub fn most_different(title: &str, first: &Picture, second: &Picture) -> Place {
    let (width, height) = (first.width, first.height);
    let square = |x: u32, y: u32| {
        let place = y as usize * width as usize + x as usize;
        let pairs = first.pixels[place].iter().zip(&second.pixels[place]);
        pairs.map(|(a, b)| f64::from(a - b).powi(2)).sum::<f64>()
    };
    let (wide, high) = (SIDE.min(width), SIDE.min(height));
    // Candidates are half a detail apart, which is precise enough.
    let steps = |all: u32, side: u32| (0..=all - side).step_by((side as usize / 2).max(1));
    let mut most = (-1.0, 0, 0);
    for y in steps(height, high) {
        for x in steps(width, wide) {
            let rows = y..y + high;
            let sum: f64 = rows
                .flat_map(|y| (x..x + wide).map(move |x| (x, y)))
                .map(|(x, y)| square(x, y))
                .sum();
            if sum > most.0 {
                most = (sum, x, y);
            }
        }
    }
    let middle = |start: u32, side: u32, all: u32| {
        (f64::from(start) + 0.5 * f64::from(side)) / f64::from(all)
    };
    let at = [middle(most.1, wide, width), middle(most.2, high, height)];
    Place { title: title.into(), at }
}

/// Returns the pixels around a position, shifted so that all lie in the picture.
fn around(place: &Place, (width, height): (u32, u32)) -> Crop {
    let start = |at: f64, side: u32, all: u32| {
        let start = (at * f64::from(all) - 0.5 * f64::from(side)).round();
        start.clamp(0.0, f64::from(all - side)) as u32
    };
    let (wide, high) = (SIDE.min(width), SIDE.min(height));
    let [x, y] = place.at;
    Crop { x: start(x, wide, width), y: start(y, high, height), width: wide, height: high }
}

/// Returns for each pixel whether it is wide. The ray through the middle of a wide pixel first hits
/// an object with a texture. There the pixel spans more than two texels in both directions.
fn wide_pixels(prepared: &Prepared<'_>, (width, height): (u32, u32), crop: Crop) -> Vec<bool> {
    let layers = vec![Layer::Object, Layer::Footprint];
    // The layers hold the thesis's footprints, which are two pixels wide.
    let settings = Settings::new(width, height, Filter::Tent).with_samples(1);
    let settings = Settings { crop: Some(crop), layers, ..settings };
    let (picture, _) = render::render(prepared, &settings, &|_, _| {});
    let scene = prepared.scene();
    let channel = |name: &str| {
        let channel = picture.channels.iter().find(|channel| channel.name == name);
        channel.map_or(&[][..], |channel| channel.values.as_slice())
    };
    let spans = channel("footprint.W").iter().zip(channel("footprint.H"));
    let hits = channel("object.id").iter().zip(spans);
    hits.map(|(object, (across, up))| {
        let parts = scene.objects.get(*object as usize).map(|object| object.parts.as_slice());
        // Of an object with several textures the coarsest counts, since the layers do not identify
        // the texture that was hit.
        let sizes = parts.into_iter().flatten().filter_map(|part| {
            let texture = &scene.textures[part.picture()?];
            let across = f64::from(*across) * texture.width as f64;
            Some(across.min(f64::from(*up) * texture.height as f64))
        });
        *object >= 0.0 && sizes.reduce(f64::min).is_some_and(|texels| texels > WIDE)
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn details_lie_in_the_picture_and_are_parts_of_it() {
        let size = (200, 100);
        let mut picture = Picture::black(size.0, size.1);
        for (k, pixel) in picture.pixels.iter_mut().enumerate() {
            pixel[0] = k as f32;
        }
        for (at, corner) in [([0.0, 0.0], (0, 0)), ([1.0, 1.0], (134, 34)), ([0.5, 0.5], (67, 17))]
        {
            let crop = around(&Place { title: String::new(), at }, size);
            assert_eq!((crop.x, crop.y, crop.width, crop.height), (corner.0, corner.1, SIDE, SIDE));
            let part = read::part(&picture, &crop);
            let last = (corner.1 + SIDE - 1) * size.0 + corner.0 + SIDE - 1;
            assert_eq!(part.pixels[(SIDE * SIDE - 1) as usize][0], last as f32);
        }
        let small = around(&Place { title: String::new(), at: [0.3, 0.9] }, (40, 200));
        assert_eq!((small.x, small.width, small.y + small.height), (0, 40, 200));
    }

    #[test]
    fn what_differs_is_found() {
        let calm = Picture::black(300, 200);
        let mut lively = calm.clone();
        lively.pixels[150 * 300 + 210] = [1.0; 3];
        let place = most_different("", &calm, &lively);
        let crop = around(&place, (300, 200));
        assert!((crop.x..crop.x + SIDE).contains(&210) && (crop.y..crop.y + SIDE).contains(&150));
    }
}
