//! Renders a page by every method, in turn, and compares the pictures with the truth.
//!
//! The load of the machine varies. So the methods take turns, round after round, and the median of a
//! method's rounds counts. Slow methods have only one round.

use super::measured::{Cost, Method, PageMeasured, Region, Trial, Truth};
use super::plan::Plan;
use super::refined::Refined;
use super::regions;
use crate::compare::{CompareError, Difference};
use render::stats::Stats;
use render::{Picture, Prepared, Scene, Settings};
use std::time::{Duration, Instant};

/// Largest number of rounds of a method.
const MOST_ROUNDS: usize = 9;

/// Largest number of refinements of the truth. Each refinement estimates the rays needed from the noise
/// measured, so one may not be enough.
const MOST_REFINEMENTS: usize = 3;

/// The truth counts as settled when its two pictures differ by at most this fraction of the smallest
/// error. Both are root mean squares.
const SETTLED: f64 = 0.2;

/// Measures processor time and memory of the program, which a library cannot do.
pub trait Meter: Sync {
    /// Returns the processor time that the program has used so far, over all threads.
    fn cpu(&self) -> Duration;
    /// Starts a new measurement of peak memory, and returns the memory held now, in bytes.
    fn mark(&self) -> usize;
    /// Returns the most memory held at once since the last call of [`Meter::mark`], in bytes.
    fn peak(&self) -> usize;
}

/// Reports progress: the activity in a word or two, the work done, and the total work.
pub type Tell<'a> = &'a (dyn Fn(&str, usize, usize) + Sync);

/// Measures a page.
///
/// Runs on the threads of the current rayon pool. Apart from times and memory, the result is the same
/// for any number of threads.
///
/// # Errors
/// When a picture has a pixel that is not finite and so cannot be compared. This should not happen.
pub fn page(
    name: &str,
    title: &str,
    scene: &Scene,
    plan: &Plan,
    meter: &dyn Meter,
    tell: Tell<'_>,
) -> Result<PageMeasured, CompareError> {
    tell("regions", 0, 1);
    let regions = regions::regions(scene, plan.size);
    let taken = take_turns(scene, plan, meter, tell);
    let (pair, settled) = settle(scene, plan, &taken, tell)?;
    let truth = pair.mean();
    let (samples, most_samples) = pair.samples();
    let noise = pair.noise(None);
    let noise_by_region: Vec<f64> =
        regions.iter().map(|region| pair.noise(Some(&region.mask))).collect();
    let trials = taken.into_iter().map(|turn| {
        let against = |mask, noise: f64| {
            let difference = Difference::between(&turn.picture, &truth, mask)?;
            Ok::<_, CompareError>(without_noise(difference, noise))
        };
        let by_region = regions.iter().zip(&noise_by_region);
        let by_region =
            by_region.map(|(region, &noise): (&Region, &f64)| against(Some(&region.mask), noise));
        Ok(Trial {
            whole: against(None, noise)?,
            by_region: by_region.collect::<Result<_, _>>()?,
            cost: turn.cost(),
            method: turn.method,
            picture: Some(turn.picture),
        })
    });
    let trials: Vec<Trial> = trials.collect::<Result<_, CompareError>>()?;
    let (name, title) = (name.into(), title.into());
    let truth = Truth { picture: truth, samples, most_samples, noise, noise_by_region, settled };
    Ok(PageMeasured { name, title, size: plan.size, truth, regions, trials })
}

/// Returns the difference from the truth with the truth's own noise subtracted from the mean square.
///
/// Take a picture m and truths A and B of two seeds, whose noise is independent. The mean of (m - A)(m
/// - B) is then free of this noise. (m - (A + B)/2)^2 - (A - B)^2/4 is the same number.
fn without_noise(difference: Difference, noise: f64) -> Difference {
    let square = difference.rmse.powi(2) - noise.powi(2);
    Difference { rmse: square.max(0.0).sqrt(), ..difference }
}

/// A method's picture and the costs of each of its rounds. Times are in seconds, memory in bytes.
struct Turn {
    method: Method,
    picture: Picture,
    stats: Stats,
    walls: Vec<f64>,
    cpus: Vec<f64>,
    tables: Vec<f64>,
    peaks: Vec<f64>,
}

impl Turn {
    fn cost(&self) -> Cost {
        let stats = &self.stats;
        Cost {
            wall: median(&self.walls),
            cpu: median(&self.cpus),
            tables: median(&self.tables),
            rays: stats.primary_rays
                + stats.reflected_rays
                + stats.refracted_rays
                + stats.shadow_rays,
            texels: stats.texels,
            peak_bytes: median(&self.peaks) as usize,
        }
    }
}

/// Returns the median of some numbers: the lower of the two middle ones of an even number, and 0 of
/// none.
fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len().saturating_sub(1) / 2).copied().unwrap_or(0.0)
}

/// Measures every method in turn, until each has been measured for the time `plan.patience` or for
/// [`MOST_ROUNDS`] rounds.
fn take_turns(scene: &Scene, plan: &Plan, meter: &dyn Meter, tell: Tell<'_>) -> Vec<Turn> {
    let methods = plan.methods();
    let count = methods.len();
    let mut turns: Vec<Turn> = Vec::with_capacity(count);
    for (k, method) in methods.into_iter().enumerate() {
        tell("methods", k, count);
        turns.push(measure(scene, plan, method, meter));
    }
    for round in 1..MOST_ROUNDS {
        for (k, turn) in turns.iter_mut().enumerate() {
            tell("rounds", round * count + k, MOST_ROUNDS * count);
            if turn.walls.iter().sum::<f64>() >= plan.patience.as_secs_f64() {
                continue;
            }
            let again = measure(scene, plan, turn.method.clone(), meter);
            turn.walls.extend(again.walls);
            turn.cpus.extend(again.cpus);
            turn.tables.extend(again.tables);
            turn.peaks.extend(again.peaks);
        }
    }
    turns
}

/// Renders one picture by a method and measures its costs.
fn measure(scene: &Scene, plan: &Plan, method: Method, meter: &dyn Meter) -> Turn {
    let (width, height) = plan.size;
    let settings =
        Settings { sampling: method.sampling, ..Settings::new(width, height, method.filter) };
    let held = meter.mark();
    let (cpu, started) = (meter.cpu(), Instant::now());
    // The scene is prepared anew each time, since tables and acceleration structure are part of a
    // method's cost.
    let (picture, stats) = render::render(&Prepared::new(scene), &settings, &|_, _| {});
    let wall = started.elapsed().as_secs_f64();
    let cpu = meter.cpu().saturating_sub(cpu).as_secs_f64();
    let peak = meter.peak().saturating_sub(held) as f64;
    let tables = vec![stats.table_time.as_secs_f64()];
    let (walls, cpus, peaks) = (vec![wall], vec![cpu], vec![peak]);
    Turn { method, picture, stats, walls, cpus, tables, peaks }
}

/// Returns the truth, refined until its two pictures differ little in comparison to the smallest error,
/// and whether that was reached.
fn settle(
    scene: &Scene,
    plan: &Plan,
    turns: &[Turn],
    tell: Tell<'_>,
) -> Result<(Refined, bool), CompareError> {
    let prepared = Prepared::new(scene);
    let mut pair = Refined::render(&prepared, plan.size, plan.truth_samples, &|done, total| {
        tell("truth", done, total);
    });
    for _ in 0..MOST_REFINEMENTS {
        let goal = SETTLED * smallest(&pair, turns)?;
        if pair.difference(None) <= goal {
            break;
        }
        let more = |done: usize, total: usize| tell("more rays for the truth", done, total);
        if !pair.refine(&prepared, goal, plan.most_truth_samples, &more) {
            break;
        }
    }
    let settled = pair.difference(None) <= SETTLED * smallest(&pair, turns)?;
    Ok((pair, settled))
}

/// Returns the smallest error of all pictures, with the noise of the truth subtracted.
fn smallest(pair: &Refined, turns: &[Turn]) -> Result<f64, CompareError> {
    let (truth, noise) = (pair.mean(), pair.noise(None));
    turns.iter().try_fold(f64::INFINITY, |smallest, turn| {
        let difference = Difference::between(&turn.picture, &truth, None)?;
        Ok(without_noise(difference, noise).rmse.min(smallest))
    })
}

#[cfg(test)]
mod tests {
    use super::super::board;
    use super::*;
    use render::Sampling;
    use render::filter::Filter;

    /// A meter that measures nothing.
    struct None;

    impl Meter for None {
        fn cpu(&self) -> Duration {
            Duration::ZERO
        }

        fn mark(&self) -> usize {
            7
        }

        fn peak(&self) -> usize {
            10
        }
    }

    fn plan() -> Plan {
        Plan {
            size: (20, 20),
            filters: vec![Filter::Point, Filter::Tent],
            samplings: [1, 2, 4, 16].map(Sampling::regular).into(),
            truth_samples: 32,
            most_truth_samples: 64,
            patience: Duration::ZERO,
            quick: true,
        }
    }

    fn measured(threads: usize) -> PageMeasured {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let scene = board::scene();
        pool.install(|| page("board", "Checks", &scene, &plan(), &None, &|_, _, _| {})).unwrap()
    }

    #[test]
    fn errors_are_those_from_what_is_exactly_there() {
        let page = measured(2);
        let exact = board::exact(20);
        for trial in &page.trials {
            let picture = trial.picture.as_ref().unwrap();
            let right = Difference::between(picture, &exact, Option::None).unwrap().rmse;
            // A remainder of the truth's noise is left when the squares are subtracted.
            let wrong = (trial.whole.rmse - right).abs();
            assert!(wrong < 0.3 * page.truth.noise + 0.01 * right, "{:?}: {wrong}", trial.method);
        }
        let [first, .., last] = &page.trials[..4] else { panic!("four points") };
        assert!(last.whole.rmse < 0.2 * first.whole.rmse, "more points are nearer");
        assert_eq!(
            page.truth.settled,
            page.trials
                .iter()
                .all(|trial| { 2.0 * page.truth.noise <= SETTLED * trial.whole.rmse })
        );
    }

    #[test]
    fn all_but_the_times_is_the_same_for_any_number_of_threads() {
        let (one, three) = (measured(1), measured(3));
        assert_eq!(one.truth.picture, three.truth.picture);
        assert_eq!(one.truth.noise_by_region, three.truth.noise_by_region);
        for (one, three) in one.trials.iter().zip(&three.trials) {
            assert_eq!(one.method, three.method);
            assert_eq!(one.picture, three.picture);
            assert_eq!((one.whole, &one.by_region), (three.whole, &three.by_region));
            let counts = |cost: &Cost| (cost.rays, cost.texels, cost.peak_bytes);
            assert_eq!(counts(&one.cost), counts(&three.cost));
            assert_eq!(one.cost.peak_bytes, 3, "beyond what was held before");
        }
    }

    #[test]
    fn the_median_is_the_lower_of_two_middles() {
        assert_eq!([median(&[]), median(&[3.0]), median(&[4.0, 1.0])], [0.0, 3.0, 1.0]);
        assert_eq!(median(&[9.0, 1.0, 2.0]), 2.0);
    }
}
