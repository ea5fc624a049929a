//! Renders a page by every method, in turn, and compares the pictures with the truth.
//!
//! The load of the machine varies. So the methods take turns, round after round, and the median of a
//! method's rounds counts. Slow methods have only one round.

use super::measured::{Cost, Method, PageMeasured, Region, Trial, Truth};
use super::plan::Plan;
use super::refined::Refined;
use super::regions;
use compare::{CompareError, Difference};
use cpu_time::ProcessTime;
use render::{Picture, Prepared, Scene, Settings};
use std::time::Instant;

/// Largest number of rounds of a method.
const MOST_ROUNDS: usize = 9;

/// Largest number of refinements of the truth. Each refinement estimates the rays needed from the noise
/// measured, so one may not be enough.
const MOST_REFINEMENTS: usize = 3;

/// The truth counts as settled when its two pictures differ by at most this fraction of the smallest
/// error. Both are root mean squares.
const SETTLED: f64 = 0.2;

/// Counts the memory that the process holds, which a library cannot do.
pub trait Memory: Sync {
    /// Starts a new measurement of peak memory, and returns the memory held now, in bytes.
    fn mark(&self) -> usize;
    /// Returns the most memory held at once since the last call of [`Memory::mark`], in bytes.
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
    memory: &dyn Memory,
    tell: Tell<'_>,
) -> Result<PageMeasured, CompareError> {
    tell("regions", 0, 1);
    let prepared = Prepared::new(scene);
    let regions = regions::regions(&prepared, plan.size);
    let measured = take_turns(scene, plan, memory, tell);
    let truth = match &plan.reference {
        Some(picture) => Truth::given(picture.clone(), regions.len()),
        None => made(&prepared, plan, &regions, &measured, tell)?,
    };
    let (noise, noise_by_region) = (truth.noise, truth.noise_by_region.clone());
    let trials = measured.into_iter().map(|rounds| {
        let against = |mask, noise: f64| {
            let difference = Difference::between(&rounds.picture, &truth.picture, mask)?;
            Ok::<_, CompareError>(without_noise(difference, noise))
        };
        let by_region = regions.iter().zip(&noise_by_region);
        let by_region =
            by_region.map(|(region, &noise): (&Region, &f64)| against(Some(&region.mask), noise));
        Ok(Trial {
            whole: against(None, noise)?,
            by_region: by_region.collect::<Result<_, _>>()?,
            cost: rounds.cost(),
            method: rounds.method,
            picture: Some(rounds.picture),
        })
    });
    let trials: Vec<Trial> = trials.collect::<Result<_, CompareError>>()?;
    let (name, title) = (name.into(), title.into());
    Ok(PageMeasured { name, title, size: plan.size, truth, regions, trials })
}

/// Makes the truth of a page by many rays.
fn made(
    prepared: &Prepared<'_>,
    plan: &Plan,
    regions: &[Region],
    measured: &[Rounds],
    tell: Tell<'_>,
) -> Result<Truth, CompareError> {
    let (pair, settled) = settle(prepared, plan, measured, tell)?;
    let (samples, most_samples) = pair.samples();
    Ok(Truth {
        picture: pair.mean(),
        samples,
        most_samples,
        noise: pair.noise(None),
        noise_by_region: regions.iter().map(|region| pair.noise(Some(&region.mask))).collect(),
        settled,
        given: false,
    })
}

impl Truth {
    /// Returns the truth that is a given picture, for a page with this number of regions.
    fn given(picture: Picture, regions: usize) -> Self {
        let noise_by_region = vec![0.0; regions];
        let (samples, most_samples, noise) = (0, 0, 0.0);
        Self { picture, samples, most_samples, noise, noise_by_region, settled: true, given: true }
    }
}

/// Returns the difference from the truth with the truth's own noise subtracted from the mean square.
///
/// Take a picture m and truths A and B of two seeds, whose noise is independent. The mean of (m - A)(m
/// - B) is then free of this noise. (m - (A + B)/2)^2 - (A - B)^2/4 is the same number.
fn without_noise(difference: Difference, noise: f64) -> Difference {
    let square = difference.rmse.powi(2) - noise.powi(2);
    Difference { rmse: square.max(0.0).sqrt(), ..difference }
}

/// The picture of a method, and the costs of each of its rounds.
struct Rounds {
    method: Method,
    picture: Picture,
    costs: Vec<Cost>,
}

impl Rounds {
    /// Returns the medians of the costs.
    fn cost(&self) -> Cost {
        let median = |of: fn(&Cost) -> f64| median(self.costs.iter().map(of).collect());
        Cost {
            wall: median(|cost| cost.wall),
            cpu: median(|cost| cost.cpu),
            once_wall: median(|cost| cost.once_wall),
            once_cpu: median(|cost| cost.once_cpu),
            tables: median(|cost| cost.tables),
            peak_bytes: median(|cost| cost.peak_bytes as f64) as usize,
            // Counts are equal in all rounds.
            ..self.costs[0]
        }
    }
}

/// Returns the median of some numbers: the lower of the two middle ones of an even number, and 0 of
/// none.
pub(super) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len().saturating_sub(1) / 2).copied().unwrap_or(0.0)
}

/// Measures every method in turn, until each has been measured for the time `plan.patience` or for
/// [`MOST_ROUNDS`] rounds.
fn take_turns(scene: &Scene, plan: &Plan, memory: &dyn Memory, tell: Tell<'_>) -> Vec<Rounds> {
    let methods = plan.methods();
    let count = methods.len();
    let mut all: Vec<Rounds> = Vec::with_capacity(count);
    for (k, method) in methods.into_iter().enumerate() {
        tell("methods", k, count);
        let (picture, cost) = measure(scene, plan, &method, memory);
        all.push(Rounds { method, picture, costs: vec![cost] });
    }
    for round in 1..MOST_ROUNDS {
        for (k, rounds) in all.iter_mut().enumerate() {
            tell("rounds", round * count + k, MOST_ROUNDS * count);
            let spent: f64 = rounds.costs.iter().map(|cost| cost.wall).sum();
            if spent < plan.patience.as_secs_f64() {
                rounds.costs.push(measure(scene, plan, &rounds.method, memory).1);
            }
        }
    }
    all
}

/// Renders one picture by a method and measures its costs.
fn measure(scene: &Scene, plan: &Plan, method: &Method, memory: &dyn Memory) -> (Picture, Cost) {
    let (width, height) = plan.size;
    let settings =
        Settings { sampling: method.sampling, ..Settings::new(width, height, method.filter) };
    let held = memory.mark();
    let (cpu, started) = (ProcessTime::try_now(), Instant::now());
    // The scene is prepared anew each time, since tables and acceleration structure are part of a
    // method's cost.
    let spent = || {
        let cpu = cpu.as_ref().ok().and_then(|start| start.try_elapsed().ok());
        let cpu = cpu.unwrap_or_default();
        [started.elapsed(), cpu].map(|time| time.as_secs_f64())
    };
    let prepared = Prepared::new(scene);
    let (_, built) = prepared.shader(settings.accel, method.filter);
    let [once_wall, once_cpu] = spent();
    let (picture, stats) = render::render(&prepared, &settings, &|_, _| {});
    let [wall, cpu] = spent();
    let cost = Cost {
        wall,
        cpu,
        once_wall,
        once_cpu,
        tables: built.table_time.as_secs_f64(),
        primary_rays: stats.primary_rays,
        rays: stats.primary_rays + stats.reflected_rays + stats.refracted_rays + stats.shadow_rays,
        texels: stats.texels,
        peak_bytes: memory.peak().saturating_sub(held),
    };
    (picture, cost)
}

/// Returns the truth, refined until its two pictures differ little in comparison to the smallest error,
/// and whether that was reached.
fn settle(
    prepared: &Prepared<'_>,
    plan: &Plan,
    all: &[Rounds],
    tell: Tell<'_>,
) -> Result<(Refined, bool), CompareError> {
    let mut pair = Refined::render(prepared, plan.size, plan.truth_samples, &|done, total| {
        tell("truth", done, total);
    });
    for _ in 0..MOST_REFINEMENTS {
        let goal = SETTLED * smallest(&pair, all)?;
        if pair.difference(None) <= goal {
            break;
        }
        let more = |done: usize, total: usize| tell("more rays for the truth", done, total);
        if !pair.refine(prepared, goal, plan.most_truth_samples, &more) {
            break;
        }
    }
    let settled = pair.difference(None) <= SETTLED * smallest(&pair, all)?;
    Ok((pair, settled))
}

/// Returns the smallest error of all pictures, with the noise of the truth subtracted.
fn smallest(pair: &Refined, all: &[Rounds]) -> Result<f64, CompareError> {
    let (truth, noise) = (pair.mean(), pair.noise(None));
    all.iter().try_fold(f64::INFINITY, |smallest, rounds| {
        let difference = Difference::between(&rounds.picture, &truth, None)?;
        Ok(without_noise(difference, noise).rmse.min(smallest))
    })
}

#[cfg(test)]
mod tests {
    use super::super::board;
    use super::*;
    use render::Sampling;
    use render::filter::Filter;

    /// Memory of which 7 bytes are held before a picture, and 10 at most.
    struct Fixed;

    impl Memory for Fixed {
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
            lattices: [1, 2, 4, 16].map(Sampling::regular).into(),
            areas: [None, Some(render::film::THRESHOLD)]
                .map(|split| Method::area(Filter::Exact, 1, split))
                .into(),
            truth_samples: 32,
            most_truth_samples: 64,
            patience: std::time::Duration::ZERO,
            quick: true,
            reference: None,
        }
    }

    fn measured(threads: usize) -> PageMeasured {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let scene = board::scene();
        pool.install(|| page("board", "Checks", &scene, &plan(), &Fixed, &|_, _, _| {})).unwrap()
    }

    #[test]
    fn errors_are_those_from_what_is_exactly_there() {
        let page = measured(2);
        let exact = board::exact(20);
        for trial in &page.trials {
            let picture = trial.picture.as_ref().unwrap();
            let right = Difference::between(picture, &exact, None).unwrap().rmse;
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
    fn the_costs_of_a_scene_are_a_part_of_all_costs() {
        for trial in measured(1).trials {
            let Cost { wall, cpu, once_wall, once_cpu, tables, primary_rays, .. } = trial.cost;
            assert!(
                once_wall <= wall && once_cpu <= cpu && tables <= once_wall,
                "{:?}",
                trial.cost
            );
            assert_eq!(trial.cost.cpu_at(1.0), cpu.max(once_cpu));
            assert!(trial.cost.cpu_at(4.0) >= cpu && primary_rays >= 400);
        }
    }

    #[test]
    fn a_given_truth_is_compared_with_as_it_is() {
        let scene = board::scene();
        let exact = board::exact(20);
        let plan = Plan { reference: Some(exact.clone()), ..plan() };
        let page = page("board", "Checks", &scene, &plan, &Fixed, &|_, _, _| {}).unwrap();
        assert!(page.truth.given && page.truth.noise == 0.0);
        for trial in &page.trials {
            let picture = trial.picture.as_ref().unwrap();
            let right = Difference::between(picture, &exact, None).unwrap();
            assert_eq!(trial.whole, right, "{:?}", trial.method);
        }
    }

    #[test]
    fn the_median_is_the_lower_of_two_middles() {
        assert_eq!([median(vec![]), median(vec![3.0]), median(vec![4.0, 1.0])], [0.0, 3.0, 1.0]);
        assert_eq!(median(vec![9.0, 1.0, 2.0]), 2.0);
    }
}
