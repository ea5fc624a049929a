//! The search for the cheapest picture whose error is below a requested one.
//!
//! The pixels of the audit are drawn and judged first. Each sampling is then tried on these pixels
//! alone, and only the chosen one makes the whole picture. So the audit looks at the picture before
//! it exists: its pixels have the same bits.
//!
//! Many samplings are tried and one is chosen, which must not make the statement wrong. The search
//! takes a sampling only if its bound is below the request, and finer samplings are then below it
//! too. So consider the finest sampling whose true error is above the request. To choose it, or a
//! coarser one, its own bound must be wrong. The risk of one bound is therefore the risk of the
//! choice (fixed sequence testing from the finest sampling down; A. Angelopoulos et al., "Learn then
//! Test", 2021, section 4). That finer samplings pass on the same pixels is assumed and not computed,
//! since the finest ones cost far more than the picture.
//!
//! If too few pixels were drawn, more are drawn, and the pixels so far stay. Each such look at the
//! sample takes a part of the risk.
//!
//! A printed bound below the request is a further claim, about the sampling that was chosen. It has a
//! risk of its own in each look, divided among all samplings.

use super::bound::{mean, upper};
use super::chances::{Chances, Estimates};
use super::ladder::{rungs, start};
use super::plan::{Outlook, Prospect, jump};
use super::request::{Reached, Request};
use super::sample::Sample;
use super::sources::by_cause;
use super::{CONFIDENCE, audit, draws, stated};
use crate::film::{BasePicture, Picture, Pixel, Sampling, Settings};
use crate::stats::Stats;
use std::collections::BTreeMap;
use std::time::Instant;

/// Risks of the choice in each look. Together with [`PRINTED`] times as much for printed bounds they
/// sum to the risk of the statement.
const RISKS: [f64; 6] = [0.016, 0.006, 0.003, 0.002, 0.002, 0.001];

/// Risk of the printed bounds of a look, in risks of the choice.
const PRINTED: f64 = 2.0 / 3.0;

/// Draws at each look, in halves of those of the first.
const SIZES: [usize; RISKS.len()] = [2, 3, 5, 8, 16, 32];

/// Finer rungs that are tried before more pixels are drawn. A few pixels with large errors may spoil the
/// next rung, and not the one after it.
const AHEAD: usize = 3;

/// Most times as many draws at the next look, unless no rung suffices with so few. With more, the
/// audit may take more rays than the picture; on the tube at 0.01 it took up to 8 per pixel.
const GROWTH: f64 = 3.0;

/// Least printed bound, in requested errors. The number of draws and the noise of true colours suit
/// the request, and tell little of much smaller errors.
pub(super) const LEAST_BOUND: f64 = 0.2;

/// Part of the requested error that a ray must weigh in its cell to be followed. True colours follow
/// all rays, so the audit counts what is lost.
const FOLLOWED: f64 = 0.1;

/// The accuracy for which a search by time judges pixels.
const TIMED: f64 = 0.005;

/// See [`Request::reach`].
pub(super) fn by_error(request: &Request<'_, '_>, error: f64) -> Reached {
    match choose(request, error) {
        Ok(choice) => {
            let made = choice.search.made(choice.rung);
            choice.finish(made)
        }
        Err(search) => search.ended_early(),
    }
}

/// See [`Request::reach_or_leave`].
pub(super) fn by_error_or_leave(request: &Request<'_, '_>, error: f64) -> Option<Reached> {
    let choice = choose(request, error).ok()?;
    let made = (request.go_on)().then(|| choice.search.made(choice.rung))?;
    (made.1.unfinished == 0).then(|| choice.finish(made))
}

/// Chooses the cheapest sampling whose error is below `error`, or fails with the search if it is ended early while it
/// draws pixels.
fn choose<'q, 'r, 's>(
    request: &'q Request<'r, 's>,
    error: f64,
) -> Result<Choice<'q, 'r, 's>, Box<Search<'q, 'r, 's>>> {
    let mut search = Search::start(request, error);
    search.requested = Some(error);
    let limit = error * error;
    let (mut at, mut look) = (start(error), 0);
    let found = loop {
        if !search.draw(look, error) {
            return Err(Box::new(search));
        }
        let most = SIZES[SIZES.len() - 1] as f64 / SIZES[look] as f64;
        let few = search.cheapest(at, look, limit, most.min(GROWTH));
        let best = few.or_else(|| search.cheapest(at, look, limit, most));
        let Some((rung, outlook)) = best else { break None };
        at = rung;
        if outlook.growth <= 1.0 {
            break Some(rung);
        }
        // The first look whose draws should suffice.
        let wanted = SIZES[look] as f64 * outlook.growth;
        let next = (look + 1..SIZES.len()).find(|&next| SIZES[next] as f64 >= wanted);
        match next {
            Some(next) => look = next,
            None => break None,
        }
    };
    let found = found.or(search.passed);
    let rung = found.unwrap_or_else(|| search.finest());
    let values = search.values(rung);
    let bound = match found {
        // Either claim holds: that of the choice, and that of the printed bound.
        Some(_) => upper(&values, PRINTED * RISKS[look] * share(rung, start(error)))
            .max((LEAST_BOUND * error).powi(2))
            .min(limit),
        None => upper(&values, 1.0 - CONFIDENCE),
    };
    let missed = found.is_none().then_some(error);
    let bound = bound.max(mean(&values)).max(0.0).sqrt();
    Ok(Choice { search, rung, values, bound, missed })
}

/// See [`Request::within`].
pub(super) fn by_time(request: &Request<'_, '_>, seconds: f64) -> Reached {
    let started = Instant::now();
    let mut search = Search::start(request, TIMED);
    if !search.draw(0, TIMED) {
        return search.ended_early();
    }
    let mut chosen = 0;
    search.try_out(0);
    for rung in 1..search.rungs.len() {
        let before = (Instant::now(), search.stats.audit_rays);
        search.try_out(rung);
        let took = before.0.elapsed().as_secs_f64();
        // The pixels of the audit take longer than others; their rays tell by how much.
        let traced = (search.stats.audit_rays - before.1).max(1) as f64;
        let needed = search.rays(rung) * took / traced;
        if started.elapsed().as_secs_f64() + needed > seconds || !(request.go_on)() {
            break;
        }
        chosen = rung;
    }
    // The values were not used for the choice.
    let values = search.values(chosen);
    let bound = upper(&values, 1.0 - CONFIDENCE).max(0.0).sqrt();
    let made = search.made(chosen);
    Choice { search, rung: chosen, values, bound, missed: None }.finish(made)
}

/// Returns the part of the risk of printed bounds that belongs to a rung. The parts of all rungs sum
/// to less than 1, and those of rungs near the first are the largest.
fn share(rung: usize, first: usize) -> f64 {
    0.4 / (1.0 + rung.abs_diff(first) as f64).powi(2)
}

/// A sampling that was chosen.
struct Choice<'q, 'r, 's> {
    search: Search<'q, 'r, 's>,
    rung: usize,
    /// Weighted squared errors of the draws.
    values: Vec<f64>,
    /// The stated bound, root mean square in linear light.
    bound: f64,
    /// The requested error, if no sampling suffices.
    missed: Option<f64>,
}

impl Choice<'_, '_, '_> {
    /// States the error of the picture of the choice.
    fn finish(self, (picture, mut stats): (Picture, Stats)) -> Reached {
        let Self { search, rung, values, bound, missed } = self;
        if stats.unfinished > 0 {
            return search.with_audit(picture, stats);
        }
        stats.audit_rays = search.audit_rays();
        stats.audit_time = search.stats.audit_time;
        let statement = stated(&values, bound, missed, &stats, picture.pixels.len());
        let color = |k: usize| search.tried[&rung][k].color;
        let sources = by_cause(search.request, &search.base, &search.sample, color, &mut stats);
        let settings = search.base.with(search.rungs[rung]);
        Reached { picture, stats, settings, statement, sources: Some(sources) }
    }
}

struct Search<'q, 'r, 's> {
    request: &'q Request<'r, 's>,
    base: BasePicture<'r, 's>,
    rungs: Vec<Sampling>,
    chances: Chances,
    sample: Sample,
    /// The pixels of the sample in each sampling that was tried.
    tried: BTreeMap<usize, Vec<Pixel>>,
    /// The cheapest sampling whose bound was below the request in any look.
    passed: Option<usize>,
    stats: Stats,
    /// The requested error, if one was requested.
    requested: Option<f64>,
}

impl<'q, 'r, 's> Search<'q, 'r, 's> {
    fn start(request: &'q Request<'r, 's>, error: f64) -> Self {
        let &Request { prepared, settings, pixel_filter, progress, .. } = request;
        let tell = |done, total| progress("first rays", done, total);
        let settings = Settings { least_weight: Some(FOLLOWED * error), ..settings.clone() };
        let base = BasePicture::new(prepared, &settings, pixel_filter, &request.course(&tell));
        let estimates = Estimates { errors: &base.errors, requested: error };
        let chances = Chances::new(&base.picture, Some(estimates));
        Self {
            request,
            base,
            rungs: rungs(pixel_filter),
            chances,
            sample: Sample::default(),
            tried: BTreeMap::new(),
            passed: None,
            stats: Stats::default(),
            requested: None,
        }
    }

    /// Lets the sample grow to its size at a look. Returns false if the request was ended early.
    fn draw(&mut self, look: usize, error: f64) -> bool {
        let &Request { truth, go_on, .. } = self.request;
        let started = Instant::now();
        let more = (SIZES[look] * draws(error) / 2).saturating_sub(self.sample.len());
        if self.base.stats.unfinished == 0 {
            let (settings, round) = (self.base.settings(), look as u64);
            self.sample.grow(truth, settings, &self.chances, (more, round), error, go_on);
        }
        self.stats.audit_time += started.elapsed();
        go_on()
    }

    /// Returns the rung with the least predicted work, and its outlook; `None` if no rung suffices with
    /// at most `most` times as many draws.
    /// The search starts at a rung and goes to finer and coarser ones while these are better.
    fn cheapest(
        &mut self,
        at: usize,
        look: usize,
        limit: f64,
        most: f64,
    ) -> Option<(usize, Outlook)> {
        let last = self.rungs.len() - 1;
        let (mut rung, mut best) = (at, self.outlook(at, look, limit, most));
        let mut finer = at;
        while finer < last && finer < rung + AHEAD && best.is_none_or(|best| best.growth > 1.0) {
            // Without an outlook, the rungs in between are looked at on the way back.
            let step = if best.is_some() { 1 } else { jump(mean(&self.values(rung)), limit) };
            finer = (finer + step).min(last);
            let found = self.outlook(finer, look, limit, most);
            let cheaper = |found: &Outlook| best.is_none_or(|best| found.work < best.work);
            if best.is_none() || found.as_ref().is_some_and(cheaper) {
                (rung, best) = (finer, found);
            }
        }
        let mut best = best?;
        while rung > 0 {
            let found = self.outlook(rung - 1, look, limit, most);
            let Some(found) = found.filter(|found| found.work <= best.work) else { break };
            (rung, best) = (rung - 1, found);
        }
        Some((rung, best))
    }

    /// Tries a rung and predicts the work until its picture is known to suffice.
    fn outlook(&mut self, rung: usize, look: usize, limit: f64, most: f64) -> Option<Outlook> {
        self.try_out(rung);
        let values = self.values(rung);
        let passed = self.passed.is_some_and(|passed| passed <= rung);
        let bound = if passed { 0.0 } else { upper(&values, RISKS[look]) };
        if !passed && bound < limit {
            self.passed = Some(rung);
        }
        let next = RISKS[(look + 1).min(RISKS.len() - 1)];
        let wider = next.ln() / RISKS[look].ln();
        let rays = self.rays(rung);
        let prospect = Prospect { mean: mean(&values), bound, wider, rays };
        prospect.outlook(limit, self.audit_rays() as f64, most)
    }

    /// Finishes those drawn pixels with a sampling that were not finished yet.
    fn try_out(&mut self, rung: usize) {
        let started = Instant::now();
        let pixels = self.tried.entry(rung).or_default();
        let new = self.base.pixels(
            self.rungs[rung],
            &self.sample.pixels[pixels.len()..],
            self.request.go_on,
        );
        self.stats.audit_rays += new.iter().map(|pixel| pixel.traced).sum::<u64>();
        pixels.extend(new);
        self.stats.audit_time += started.elapsed();
    }

    /// Weighted squared errors of the draws with a rung that was tried.
    fn values(&self, rung: usize) -> Vec<f64> {
        let none = Vec::new();
        let pixels = self.tried.get(&rung).unwrap_or(&none);
        self.sample.values(|k| pixels.get(k).map_or([0.0; 3], |pixel| pixel.color))
    }

    /// Estimates the rays that a picture with a rung that was tried takes beside the first rays.
    fn rays(&self, rung: usize) -> f64 {
        let Some(pixels) = self.tried.get(&rung) else { return 0.0 };
        let of_pixel = self.sample.mean(|k| pixels.get(k).map_or(0.0, |pixel| pixel.rays as f64));
        let known = if self.base.shares_rays(self.rungs[rung]) { 1.0 } else { 0.0 };
        (of_pixel - known).max(0.0) * self.base.errors.len() as f64
    }

    /// Rays of true colours and of pixels that were tried.
    fn audit_rays(&self) -> u64 {
        self.sample.rays() + self.stats.audit_rays
    }

    /// Returns the finest rung that was tried.
    fn finest(&self) -> usize {
        self.tried.keys().next_back().copied().unwrap_or(0)
    }

    /// Makes the whole picture with the chosen rung.
    fn made(&self, rung: usize) -> (Picture, Stats) {
        let progress = self.request.progress;
        let tell = |done, total| progress("picture", done, total);
        self.base.finish(self.rungs[rung], &self.request.course(&tell))
    }

    /// Returns the first rays as the picture.
    fn ended_early(self) -> Reached {
        let (picture, stats) = (self.base.picture.clone(), self.base.stats.clone());
        self.with_audit(picture, stats)
    }

    /// Returns a picture that was ended early with an audit of its own.
    fn with_audit(self, picture: Picture, mut stats: Stats) -> Reached {
        let settings = self.base.settings().clone();
        let mut statement = audit(self.request.truth, &settings, &picture, &mut stats);
        statement.missed = self.requested.filter(|wanted| statement.bound > *wanted);
        Reached { picture, stats, settings, statement, sources: None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_risks_together_are_those_of_the_statement() {
        let choice: f64 = RISKS.iter().sum();
        assert!((1.0 + PRINTED) * choice <= 1.0 - CONFIDENCE + 1e-12);
        for first in 0..20 {
            assert!((0..20).map(|rung| share(rung, first)).sum::<f64>() < 1.0);
        }
    }
}
