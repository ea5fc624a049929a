//! Search for the fewest cells that keep a tolerance.

use super::demand::{self, Density};
use super::measure::{Field, measure};
use super::stall::Stall;
use super::stops::Direction;
use super::{Distance, Reached, Tolerance};
use crate::curve::cut::Stop;
use crate::surface::Surface;

/// Largest number of cells of the first cut, which only has to resolve every wave.
const MOST_AT_FIRST: usize = 1 << 20;

/// Least and largest number of cells of a sketch, from which densities are found. Densities from coarser
/// cells are rough and vary from one sketch to the next. Densities from finer cells differ little and cost
/// more.
const SKETCH: (f64, f64) = (3e3, 2e4);

/// Largest number of sketches, each by the densities of the one before. Mostly the third is as good as the
/// second.
const SKETCHES: usize = 6;

/// A density that is better by less than this fraction counts as equally good.
const BETTER: f64 = 0.01;

/// Number of cuts of a long search, for its progress. Most searches take 10 to 30.
const MOST_ROUNDS: usize = 40;

/// Largest number of cuts tried for one that keeps the tolerance.
const TRIALS: usize = 20;

/// Factor by which a trial after a failed one is finer than expected to be necessary.
const SAFETY: f64 = 1.003;

/// If a trial fails with a load above this, new densities are found instead of refining all cells.
const UNEVEN: f64 = 1.1;

/// Number of trials that may find new densities.
const RESHAPED: usize = 3;

/// Least factor by which all cells are refined if some fail.
const LEAST_STEP: f64 = 1.01;

/// Cells that thinning may measure, in addition to `TRIMMED_TIMES` times the number of cells.
const TRIMMED: usize = 150_000;

/// Multiple of the number of cells that thinning may measure.
const TRIMMED_TIMES: usize = 2;

/// Largest angle of a tolerance, in radians.
const MOST_ANGLE: f64 = 3.1;

/// Receives the progress of a search: the number of cuts that were measured, and the largest number that may be.
pub type Tell<'a> = &'a (dyn Fn(usize, usize) + Sync);

/// A surface to be cut, with the bounds of the cut.
#[expect(missing_debug_implementations, reason = "a surface has none")]
pub struct Search<'a> {
    /// The surface to be cut.
    pub surface: &'a dyn Surface,
    /// The tolerance to be kept.
    pub tolerance: &'a Tolerance,
    /// The directions along the trajectory and along the contour.
    pub directions: [Direction; 2],
    /// Numbers of cells that resolve the curves, laws and waves, along the trajectory and the contour.
    pub detail: [usize; 2],
    /// Largest number of cells along the contour.
    pub most_cols: usize,
}

/// The cells of a cut surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Cells {
    /// Stops along the trajectory.
    pub rows: Vec<Stop>,
    /// Stops along the contour.
    pub cols: Vec<Stop>,
    /// The measured errors of the cut.
    pub reached: Reached,
}

/// Densities along the trajectory and the contour, with a factor for each.
#[derive(Debug, Clone)]
struct Plan {
    densities: [Density; 2],
    factors: [f64; 2],
}

/// The number of cuts that were measured, and the receiver of the progress.
struct Rounds<'a> {
    count: usize,
    tell: Tell<'a>,
}

/// A plan that has been cut and measured.
struct Tried {
    plan: Plan,
    stops: [Vec<Stop>; 2],
    field: Field,
    worst: f64,
    /// True if finer cells were not nearer to the tolerance.
    stalled: bool,
}

impl Search<'_> {
    /// Cuts the surface. If the tolerance cannot be kept, the result is the best cut found within the allowed
    /// number of cells.
    #[must_use]
    pub fn run(&self, tell: Tell<'_>) -> Cells {
        self.found(tell, true)
    }

    /// Cuts the surface, if `eased` with a larger angle where the requested one is out of reach.
    fn found(&self, tell: Tell<'_>, eased: bool) -> Cells {
        let mut rounds = Rounds { count: 1, tell };
        let sketch = self.sketch(&mut rounds);
        let mut best = self.kept(sketch, &mut rounds);
        if let Some(reached) = self.angle_out_of_reach(&best).filter(|_| eased) {
            // Finer cells do not come nearer to the angle, so the coarsest cells that reach the same are made.
            let tolerance = Tolerance { angle: Some(reached), ..self.tolerance.clone() };
            let coarser =
                Search { tolerance: &tolerance, directions: self.directions.clone(), ..*self };
            let cells = coarser.found(tell, false);
            let reached = self.reached(
                &self.measure([&cells.rows, &cells.cols]),
                rounds.count + cells.reached.rounds,
            );
            return Cells { reached, ..cells };
        }
        if best.worst <= 1.0 {
            // At full size the surface may need slightly less than in a sketch.
            let densities = self.fewest(&best.field);
            let factors = [1.0; 2];
            let again = self.kept(Plan { densities, factors }, &mut rounds);
            if again.worst <= 1.0 && again.field.quads() < best.field.quads() {
                best = again;
            }
            best = self.thinned(best, &mut rounds);
        }
        let Tried { stops: [rows, cols], field, .. } = best;
        let reached = self.reached(&field, rounds.count);
        Cells { rows, cols, reached }
    }

    /// Measures the errors of a cut at these `[rows, cols]`.
    #[must_use]
    pub fn measured(&self, [rows, cols]: [&[Stop]; 2]) -> Reached {
        self.reached(&self.measure([rows, cols]), 1)
    }

    fn reached(&self, field: &Field, rounds: usize) -> Reached {
        let pixels = match self.tolerance.distance {
            Some(Distance::Pixels(pixels, _)) => Some(pixels * field.part),
            Some(Distance::Everywhere(_)) | None => None,
        };
        Reached {
            tol: field.distance,
            pixels,
            angle_deg: field.angle.to_degrees(),
            quads: field.quads(),
            rounds,
            kept: field.worst() <= 1.0,
        }
    }

    /// Returns densities for the surface, found from cuts of moderate size.
    fn sketch(&self, rounds: &mut Rounds<'_>) -> Plan {
        let [mut rows, mut cols] = self.detail;
        while rows.saturating_mul(cols) > MOST_AT_FIRST {
            *(if rows > cols { &mut rows } else { &mut cols }) /= 2;
        }
        let [along, around] = &self.directions;
        let field = self.measure([&along.evenly(rows), &around.evenly(cols)]);
        let mut plan = Plan { densities: self.fewest(&field), factors: [1.0; 2] };
        let mut best: Option<(f64, Plan)> = None;
        for _ in 0..SKETCHES {
            let quads = self.quads(&plan) as f64;
            plan.factors = [(quads.clamp(SKETCH.0, SKETCH.1) / quads).sqrt(); 2];
            // One direction may already have its fewest cells.
            self.fit(&mut plan, SKETCH.1 as usize);
            let tried = self.tried(plan.clone(), rounds);
            // The number of cells for a load of 1, to which the number of cells is proportional.
            let figure = tried.field.quads() as f64 * tried.worst;
            // Factors of 1 make the next sketch at full size, before it is scaled.
            plan = Plan { densities: self.fewest(&tried.field), factors: [1.0; 2] };
            let known = best.as_ref().map_or(f64::INFINITY, |(figure, _)| *figure);
            if figure < known * (1.0 - demand::ALIKE) {
                let needed = tried.plan.factors.map(|factor| factor * tried.worst.sqrt());
                best = Some((figure, Plan { factors: needed, ..tried.plan }));
            }
            if figure > known * (1.0 - BETTER) {
                break;
            }
        }
        best.map_or(plan, |(_, plan)| plan)
    }

    /// Returns an angle that cells can reach, in radians, if a cut keeps the distance but not the angle: that of an edge
    /// inside a cell, and the requested one for the surface beside the edge.
    fn angle_out_of_reach(&self, best: &Tried) -> Option<f64> {
        let angle = self.tolerance.angle?;
        let missed = best.worst > 1.0 && best.field.part <= 1.0 && best.stalled;
        (missed && best.field.angle > angle).then(|| (best.field.angle + angle).min(MOST_ANGLE))
    }

    /// Returns the coarsest cut found by scaling the plan that keeps the tolerance; otherwise the best cut
    /// tried.
    fn kept(&self, mut plan: Plan, rounds: &mut Rounds<'_>) -> Tried {
        let mut best: Option<Tried> = None;
        let mut stall = Stall::default();
        for trial in 0..TRIALS {
            let fits = self.fit(&mut plan, self.tolerance.max_quads);
            let tried = self.tried(plan.clone(), rounds);
            let stalled = stall.found(tried.field.quads(), tried.worst);
            let (worst, kept) = (tried.worst, tried.worst <= 1.0);
            // Where only some cells fail, as at the vertical end of a cap, only these are refined.
            let uneven =
                (worst > UNEVEN && fits && trial < RESHAPED).then(|| self.fewest(&tried.field));
            let better = best.as_ref().is_none_or(|best| match (kept, best.worst <= 1.0) {
                (true, true) => tried.field.quads() < best.field.quads(),
                (false, false) => tried.worst < best.worst,
                (kept, _) => kept,
            });
            let before = best.as_ref().is_some_and(|best| best.worst <= 1.0);
            if better {
                best = Some(tried);
            }
            // Where no more cells are allowed, one finer trial decides.
            let stalled = stalled || !fits && stall.has_met_one();
            if stalled && let Some(best) = &mut best {
                best.stalled = true;
                break;
            }
            let enough = if kept { worst > 0.97 || !better } else { !fits || before };
            if enough {
                break;
            }
            if let Some(densities) = uneven {
                plan = Plan { densities, factors: [SAFETY; 2] };
                continue;
            }
            let mut by = worst.sqrt();
            if let Some(best) = best.as_ref().filter(|_| !kept && trial == RESHAPED) {
                // New densities did not suffice: take the best of them and refine all cells.
                plan = best.plan.clone();
                by = best.worst.sqrt();
            }
            let by = if kept { by } else { by.max(LEAST_STEP) * SAFETY };
            let next = plan.factors.map(|factor| factor * by.clamp(0.5, 4.0));
            let same = |next: [f64; 2]| {
                self.counts(&plan) == self.counts(&Plan { factors: next, ..plan.clone() })
            };
            if same(next) {
                if kept {
                    break;
                }
                plan.factors = next.map(|factor| factor * 1.05);
                continue;
            }
            plan.factors = next;
        }
        match best {
            Some(best) => best,
            None => self.tried(plan, rounds),
        }
    }

    /// Removes columns and rows from a cut as long as the tolerance is kept.
    fn thinned(&self, mut best: Tried, rounds: &mut Rounds<'_>) -> Tried {
        let mut left = TRIMMED + TRIMMED_TIMES * best.field.quads();
        let mut steps = [0.06; 2];
        let mut stuck = [false; 2];
        while !(stuck[0] && stuck[1]) {
            for at in 0..2 {
                if stuck[at] || best.field.quads() > left {
                    stuck[at] = true;
                    continue;
                }
                let (density, factor) = (&best.plan.densities[at], best.plan.factors[at]);
                let Some(fewer) = self.directions[at].fewer(density, factor) else {
                    stuck[at] = true;
                    continue;
                };
                let single = factor * (1.0 - steps[at]) >= fewer;
                let mut plan = best.plan.clone();
                plan.factors[at] = fewer.min(factor * (1.0 - steps[at]));
                let tried = self.tried(plan, rounds);
                left = left.saturating_sub(tried.field.quads());
                if tried.worst <= 1.0 {
                    best = tried;
                } else if single {
                    stuck[at] = true;
                } else {
                    steps[at] *= 0.4;
                }
            }
        }
        best
    }

    /// Makes a plan coarser until it has at most `most` cells, or one cell for each piece. Returns whether
    /// the plan was within the limits before.
    fn fit(&self, plan: &mut Plan, most: usize) -> bool {
        let over = |plan: &Plan, most: usize| {
            let [rows, cols] = self.counts(plan);
            rows.saturating_mul(cols) > most || cols > self.most_cols
        };
        if !over(plan, most) {
            return true;
        }
        let most = most.max(self.quads(&Plan { factors: [0.0; 2], ..plan.clone() }));
        let too_many = |plan: &Plan| over(plan, most);
        while too_many(plan) {
            let [rows, cols] = self.counts(plan);
            let over = (most as f64 / (rows as f64 * cols as f64)).min(1.0).sqrt();
            // Along the contour the largest number of columns also counts.
            let over_cols = over.min(self.most_cols as f64 / cols as f64);
            plan.factors[0] *= over.min(0.9995);
            plan.factors[1] *= over_cols.min(0.9995);
            if plan.factors.iter().all(|factor| *factor < f64::MIN_POSITIVE) {
                break;
            }
        }
        false
    }

    fn counts(&self, plan: &Plan) -> [usize; 2] {
        [0, 1].map(|at| self.directions[at].count(&plan.densities[at], plan.factors[at]))
    }

    fn quads(&self, plan: &Plan) -> usize {
        let [rows, cols] = self.counts(plan);
        rows.saturating_mul(cols)
    }

    fn fewest(&self, field: &Field) -> [Density; 2] {
        let count = |densities: &[Density; 2]| {
            let [rows, cols] = [0, 1].map(|at| self.directions[at].count(&densities[at], 1.0));
            rows.saturating_mul(cols)
        };
        demand::fewest(field, self.directions[1].even.is_some(), count)
    }

    fn tried(&self, plan: Plan, rounds: &mut Rounds<'_>) -> Tried {
        rounds.count += 1;
        (rounds.tell)(rounds.count.min(MOST_ROUNDS - 1), MOST_ROUNDS);
        let stops =
            [0, 1].map(|at| self.directions[at].stops(&plan.densities[at], plan.factors[at]));
        let field = self.measure([&stops[0], &stops[1]]);
        let worst = field.worst();
        Tried { plan, stops, field, worst, stalled: false }
    }

    fn measure(&self, stops: [&[Stop]; 2]) -> Field {
        let [along, around] = &self.directions;
        let closed = [along.closed, around.closed];
        measure(
            self.surface,
            self.tolerance,
            stops,
            closed,
            [&along.kinks, &around.kinks],
            along.meets,
        )
    }
}
