//! Measures flicker: the part of a picture's error that changes from frame to frame while the camera pans slowly.
//!
//! [`pans`] holds the scenes, and [`parts`] defines the parts of the error. [`pan`] renders all frames of a pan by each
//! method ([`methods`]) and compares them with truths of many unfiltered rays. `rows` writes the numbers, and `plot` draws
//! them.
//!
//! **Equal time.** The exact average over whole areas takes less time than 16 rays. At equal time it may split its areas. So
//! the exact method at equal time is the one with the smallest changing part among those whose processor time is at most
//! that of 16 bilinear rays ([`PanMeasured::at_equal_time`]). The time of a frame does not contain the tables and trees, which
//! all frames share.

pub mod pans;
pub mod parts;
mod plot;
mod rows;

pub use rows::{columns, csv};

use super::measure::{Tell, median};
use super::measured::Method;
use crate::PipelineError;
use crate::truth::Pair;
use cpu_time::ProcessTime;
use files::memory::of_process;
use pans::Pan;
use parts::{BYTES_PER_PIXEL, Parts, Sums};
use render::film::{Supersample, THRESHOLD};
use render::filter::Filter;
use render::{Prepared, Sampling, Settings};

/// The size of a measurement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plan {
    /// Width and height of all pictures, in pixels.
    pub size: (u32, u32),
    /// Number of frames of each pan, at least 2.
    pub frames: u32,
    /// Rays along each side of a pixel of each of the two pictures of a truth.
    pub truth_samples: u32,
    /// Multiple of the steps of a pan by which the camera moves; 1 for the pan itself.
    pub steps: f64,
}

impl Plan {
    /// Returns the plan of a full measurement.
    #[must_use]
    pub fn full() -> Self {
        Self { size: (96, 64), frames: 24, truth_samples: 32, steps: 1.0 }
    }

    /// Returns a plan for a quick look, with smaller and fewer pictures.
    #[must_use]
    pub fn quick() -> Self {
        Self { size: (48, 32), frames: 8, truth_samples: 16, ..Self::full() }
    }
}

/// The measurements of a pan.
#[derive(Debug)]
pub struct PanMeasured {
    /// The pan's name.
    pub name: &'static str,
    /// The pan's title.
    pub title: &'static str,
    /// How it was measured.
    pub plan: Plan,
    /// One trial for each of [`methods`], in their order.
    pub trials: Vec<Trial>,
}

/// The film of one method.
#[derive(Debug, Clone, Copy)]
pub struct Trial {
    /// The method.
    pub method: Method,
    /// The parts of its errors.
    pub parts: Parts,
    /// Processor time of a frame in seconds, without what all frames share: the median of all frames.
    pub cpu: f64,
    /// Processor time of what all frames share, in seconds.
    pub once_cpu: f64,
}

/// The method that others are held against: 4 x 4 bilinear rays in a pixel.
#[must_use]
pub fn sixteen_rays() -> Method {
    Method { filter: Filter::Bilinear, sampling: Sampling::regular(4) }
}

/// Returns the methods: point sampling, mip-mapping and the thesis's tent with one ray, the tent supersampled, 16 bilinear
/// rays, and exact averages over whole areas and over areas that split at smaller and smaller thresholds.
#[must_use]
pub fn methods() -> Vec<Method> {
    let one = |filter| Method { filter, sampling: Sampling::regular(1) };
    let supersampled =
        Method { filter: Filter::Tent, sampling: Sampling::Supersample(Supersample::Image) };
    let exact = |samples, threshold| Method::area(Filter::Exact, samples, threshold);
    let splits = [THRESHOLD, 0.03, 0.01].map(|threshold| exact(1, Some(threshold)));
    let others = [one(Filter::Point), one(Filter::Mip), one(Filter::Tent)];
    [&others[..], &[supersampled, sixteen_rays(), exact(1, None)], &splits, &[exact(2, None)]]
        .concat()
}

/// Measures a pan by all methods.
///
/// Runs on the threads of the current rayon pool. Apart from times, the result is the same for any number of threads.
///
/// # Errors
/// If the sums of all pixels take more memory than is allowed.
pub fn pan(pan: &Pan, plan: &Plan, tell: Tell<'_>) -> Result<PanMeasured, PipelineError> {
    let methods = methods();
    let (width, height) = plan.size;
    let pixels = u64::from(width) * u64::from(height) * methods.len() as u64;
    let what = || format!("sums of {} methods for {width}x{height} pixels", methods.len());
    let _reserved = of_process().reserve(pixels.saturating_mul(BYTES_PER_PIXEL), what)?;
    let prepared = Prepared::new(&pan.scene);
    let mut films: Vec<Film> = methods.into_iter().map(Film::new).collect();
    for film in &mut films {
        film.once_cpu = timed(|| {
            let settings = film.settings(plan);
            let _ = prepared.shader(settings.accel, settings.filter);
        });
    }
    for frame in 0..plan.frames {
        tell("frames", frame as usize, plan.frames as usize);
        let camera = pan.camera(frame, plan.steps);
        let base = Settings { camera, ..Settings::new(width, height, Filter::Bilinear) };
        let truth = Pair::of(&prepared, &base, plan.truth_samples, &|_, _| {});
        for film in &mut films {
            let settings = Settings { camera, ..film.settings(plan) };
            let mut picture = None;
            film.cpu.push(timed(|| {
                picture = Some(render::render(&prepared, &settings, &|_, _| {}).0);
            }));
            picture.iter().for_each(|picture| film.sums.add(picture, &truth));
        }
    }
    let trials = films.into_iter().map(Film::finish).collect();
    Ok(PanMeasured { name: pan.name, title: pan.title, plan: *plan, trials })
}

/// A film while it is measured.
struct Film {
    method: Method,
    sums: Sums,
    cpu: Vec<f64>,
    once_cpu: f64,
}

impl Film {
    fn new(method: Method) -> Self {
        Self { method, sums: Sums::default(), cpu: Vec::new(), once_cpu: 0.0 }
    }

    fn settings(&self, plan: &Plan) -> Settings {
        let Method { filter, sampling } = self.method;
        let (width, height) = plan.size;
        Settings { sampling, ..Settings::new(width, height, filter) }
    }

    fn finish(self) -> Trial {
        let Self { method, sums, cpu, once_cpu } = self;
        Trial { method, parts: sums.parts(), cpu: median(cpu), once_cpu }
    }
}

/// Returns the processor time of some work over all threads, in seconds.
fn timed(work: impl FnOnce()) -> f64 {
    let started = ProcessTime::try_now();
    work();
    let spent = started.ok().and_then(|started| started.try_elapsed().ok());
    spent.unwrap_or_default().as_secs_f64()
}

impl PanMeasured {
    /// Returns the trial of a method.
    fn of(&self, method: Method) -> Option<&Trial> {
        self.trials.iter().find(|trial| trial.method == method)
    }

    /// Returns the trial of 16 bilinear rays and the exact one at equal time. `None` if no exact method takes at most the
    /// time of 16 rays.
    #[must_use]
    pub fn at_equal_time(&self) -> Option<[&Trial; 2]> {
        let rays = self.of(sixteen_rays())?;
        let exact = self.trials.iter().filter(|trial| trial.method.filter == Filter::Exact);
        let changing = |trial: &&Trial| trial.parts.changing.rms;
        let exact = exact
            .filter(|trial| trial.cpu <= rays.cpu)
            .min_by(|a, b| changing(a).total_cmp(&changing(b)));
        Some([rays, exact?])
    }

    /// Returns the changing part of 16 bilinear rays as a multiple of that of the exact method at equal time.
    #[must_use]
    pub fn ratio(&self) -> Option<f64> {
        let [rays, exact] = self.at_equal_time()?;
        Some(rays.parts.changing.rms / exact.parts.changing.rms)
    }
}

#[cfg(test)]
mod tests {
    use super::parts::Part;
    use super::*;

    const SMALL: Plan = Plan { size: (18, 12), frames: 3, truth_samples: 6, steps: 1.0 };

    fn measured(name: &str, plan: &Plan, threads: usize) -> PanMeasured {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let own = pans::all().unwrap().into_iter().find(|pan| pan.name == name).unwrap();
        pool.install(|| pan(&own, plan, &|_, _, _| {})).unwrap()
    }

    /// The errors of a still camera stay, whatever shows the texture. So do those of a camera that moves by whole textures
    /// over a floor.
    #[test]
    fn nothing_changes_before_a_still_camera_or_from_period_to_period() {
        let step = pans::all().unwrap()[0].step();
        for (name, steps) in
            [("direct", 0.0), ("mirror", 0.0), ("glass", 0.0), ("direct", 1.0 / step)]
        {
            let pan = measured(name, &Plan { steps, ..SMALL }, 2);
            for Trial { method, parts, .. } in &pan.trials {
                // The rounding of positions, beside an error of a thousandth or more.
                let changes = parts.changing.rms.max(parts.step.rms);
                assert!(changes < 1e-6, "{name}, {steps} steps, {}: {parts:?}", method.name());
                assert!(parts.error.rms > 1e-4, "{name}, {}: {parts:?}", method.name());
                assert!((parts.error.rms - parts.steady.rms).abs() < 1e-6, "{parts:?}");
            }
        }
    }

    /// Exact averages change less than a tenth as much as 16 rays, in each pan. No pixel splits, so that they take less time.
    #[test]
    fn exact_averages_flicker_less_than_a_tenth_of_sixteen_rays() {
        for name in ["direct", "mirror", "glass"] {
            let pan = measured(name, &Plan { truth_samples: 16, ..SMALL }, 2);
            let exact = Method::area(Filter::Exact, 1, None);
            let [rays, exact] = [sixteen_rays(), exact].map(|method| pan.of(method).unwrap());
            let [rays, exact] = [rays, exact].map(|trial| trial.parts.changing);
            assert!(exact.rms < 0.1 * rays.rms, "{name}: {exact:?}, {rays:?}");
        }
    }

    #[test]
    fn all_but_the_times_is_the_same_for_any_number_of_threads() {
        let [one, three] = [1, 3].map(|threads| measured("glass", &SMALL, threads));
        for (one, three) in one.trials.iter().zip(&three.trials) {
            assert_eq!((one.method, one.parts), (three.method, three.parts));
        }
    }

    /// Of the exact methods that take no longer than 16 rays, the one that changes least counts.
    #[test]
    fn times_are_equal_up_to_that_of_sixteen_rays() {
        let trial = |method, cpu, changing| {
            let changing = Part { rms: changing, least: 0.0 };
            Trial { method, parts: Parts { changing, ..Parts::default() }, cpu, once_cpu: 0.0 }
        };
        let exact = |threshold| Method::area(Filter::Exact, 1, threshold);
        let mut trials = vec![
            trial(Method::area(Filter::Ewa8, 1, None), 1.0, 0.01),
            trial(sixteen_rays(), 4.0, 0.3),
            trial(exact(None), 2.0, 0.06),
            trial(exact(Some(0.1)), 4.0, 0.05),
            trial(exact(Some(0.01)), 4.1, 0.01),
        ];
        let of = |trials: &[Trial]| {
            let trials = trials.to_vec();
            PanMeasured { name: "a", title: "A", plan: SMALL, trials }
        };
        let pan = of(&trials);
        assert!((pan.ratio().unwrap() - 6.0).abs() < 1e-12);
        assert_eq!(pan.at_equal_time().unwrap()[1].method, exact(Some(0.1)));
        // All trials that are on the axes are drawn: here those of 16 rays and exact averages.
        let points: usize = pan.chart().series.iter().map(|series| series.points.len()).sum();
        assert_eq!(points, 4);
        trials.truncate(2);
        assert_eq!(of(&trials).ratio(), None);
    }
}
