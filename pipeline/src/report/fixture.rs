//! Made-up measurements for tests of plots and sentences.

use super::measured::{Cost, Measured, Method, PageMeasured, Region, Trial, Truth};
use super::plan::Plan;
use compare::Difference;
use render::film::Supersample;
use render::filter::Filter;
use render::{Picture, Sampling};

/// Width and height of the pictures, in pixels.
pub const SIZE: (u32, u32) = (96, 64);

/// Rays along each side of a pixel.
pub const COUNTS: [u32; 5] = [1, 2, 3, 4, 8];

/// Returns the error of a filter and its processor time in seconds, for a number of rays along each
/// side of a pixel.
pub type Law<'a> = dyn Fn(Filter, f64) -> (f64, f64) + 'a;

/// Returns the error and the time of a filter on a floor, where filters leave different errors.
pub fn floor(filter: Filter, n: f64) -> (f64, f64) {
    let (left, slope, price) = match filter {
        Filter::Point => (1.2, 1.0, 0.9),
        Filter::Bilinear => (1.0, 1.0, 1.0),
        Filter::Mip => (0.30, 0.8, 1.7),
        Filter::Box => (0.28, 0.8, 1.8),
        Filter::Tent => (0.20, 0.8, 2.0),
        Filter::Quadratic => (0.198, 0.8, 6.0),
        Filter::Ewa8 => (0.06, 0.8, 3.0),
        Filter::Ewa16 => (0.05, 0.8, 4.0),
        Filter::Ewa64 => (0.045, 0.8, 7.0),
        Filter::Probes => (0.06, 0.8, 1.6),
        Filter::Exact => (0.03, 0.8, 1.5),
    };
    (0.2 * left / n.powf(slope), 0.02 * price * n * n)
}

/// Returns the error and the time of a filter on edges, where all filters leave equal errors.
pub fn edges(filter: Filter, n: f64) -> (f64, f64) {
    (0.212 / n, floor(filter, n).1)
}

/// Makes a page with the methods of a report on the thesis's lattice. The whole page has the law
/// `whole`, and each region its own.
pub fn page(name: &str, whole: &Law<'_>, regions: &[(&'static str, &Law<'_>)]) -> PageMeasured {
    let mut methods: Vec<(Method, f64)> = Vec::new();
    for filter in Filter::THESIS {
        for n in COUNTS {
            methods.push((Method { filter, sampling: Sampling::regular(n) }, f64::from(n)));
        }
        methods.push((Method { filter, sampling: Sampling::Supersample(Supersample::Image) }, 2.0));
    }
    measured_by(methods, name, whole, regions)
}

/// Makes a page as [`page`] does, with the methods by areas. Splitting has the effect of more rays.
pub fn with_areas(
    name: &str,
    whole: &Law<'_>,
    regions: &[(&'static str, &Law<'_>)],
) -> PageMeasured {
    let methods = Plan::full().areas.into_iter().map(|method| {
        let (samples, threshold) = method.areas().unwrap();
        let split = threshold.map_or(1.0, |threshold| 1.0 + 0.02 / threshold);
        (method, f64::from(samples) * split)
    });
    let areas = measured_by(methods.collect(), name, whole, regions);
    let mut page = page(name, whole, regions);
    page.trials.extend(areas.trials);
    page
}

/// Makes a page with these methods, each with its number of rays along each side of a pixel.
fn measured_by(
    methods: Vec<(Method, f64)>,
    name: &str,
    whole: &Law<'_>,
    regions: &[(&'static str, &Law<'_>)],
) -> PageMeasured {
    let pixels = (SIZE.0 * SIZE.1) as usize;
    let trials = methods.into_iter().enumerate().map(|(k, (method, n))| {
        let (error, cpu) = whole(method.filter, n);
        let by_region = regions
            .iter()
            .map(|(_, law)| difference(pixels / 4, law(method.filter, n).0))
            .collect();
        let bytes = method.filter.order().unwrap_or(0) << 23;
        Trial {
            cost: Cost {
                wall: 0.5 * cpu,
                cpu,
                once_wall: 0.0,
                once_cpu: 0.0,
                tables: 0.01,
                primary_rays: (n * n * pixels as f64) as u64,
                rays: (n * n * pixels as f64) as u64,
                texels: (4.0 * n * n * pixels as f64) as u64,
                peak_bytes: (1 << 20) + bytes,
            },
            whole: difference(pixels, error),
            by_region,
            picture: (n <= 2.0).then(|| picture(error as f32, k)),
            method,
        }
    });
    let trials: Vec<Trial> = trials.collect();
    let mask = |k: usize| (0..pixels).map(|at| at % (k + 2) == 0).collect();
    PageMeasured {
        name: name.into(),
        title: format!("The page {name}"),
        size: SIZE,
        truth: Truth {
            picture: picture(0.0, 0),
            samples: 32,
            most_samples: 64,
            noise: 0.0005,
            noise_by_region: vec![0.0005; regions.len()],
            settled: true,
            given: false,
        },
        regions: regions
            .iter()
            .enumerate()
            .map(|(k, (name, _))| Region { name, mask: mask(k) })
            .collect(),
        trials,
    }
}

/// Makes a report of pages.
pub fn measured(pages: Vec<PageMeasured>) -> Measured {
    Measured { pages, threads: 2, quick: false }
}

fn difference(pixels: usize, rmse: f64) -> Difference {
    Difference { pixels, rmse, max: (4.0 * rmse).min(1.0), p999: 3.0 * rmse, bias: 0.0 }
}

/// Returns checks with an error that grows toward the bottom.
fn picture(error: f32, salt: usize) -> Picture {
    let mut picture = Picture::black(SIZE.0, SIZE.1);
    for (k, pixel) in picture.pixels.iter_mut().enumerate() {
        let (x, y) = (k % SIZE.0 as usize, k / SIZE.0 as usize);
        let light = if (x / 8 + y / 8) % 2 == 0 { 0.7 } else { 0.2 };
        let wave = ((k * 7 + salt * 13) % 17) as f32 / 8.0 - 1.0;
        let here = light + error * wave * 2.0 * y as f32 / SIZE.1 as f32;
        *pixel = [here, here * 0.9, here * 0.8];
    }
    picture
}
