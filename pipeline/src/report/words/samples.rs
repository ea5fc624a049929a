//! Sentences that compare filters with more rays, and filters with each other, over all pages.

use super::super::measured::{Method, PageMeasured};
use super::numbers::in_the_time;
use super::pool::{counts, evenly, time_ratio, whole};
use super::{AS_FAST, Claim, Topic, Verdict, as_near, nearer};
use crate::number::{bytes, error};
use render::Sampling;
use render::film::Supersample;
use render::filter::Filter;

/// Returns the sentences on all pages together.
pub fn claims(pages: &[PageMeasured]) -> Vec<Claim> {
    [mip(pages), many_rays(pages), orders(pages), supersampling(pages), memory(pages)]
        .into_iter()
        .flatten()
        .collect()
}

fn method(filter: Filter, samples: u32) -> Method {
    Method { filter, sampling: Sampling::regular(samples) }
}

/// Returns a sentence on the number of rays from which bilinear interpolation is as near as the tent.
fn many_rays(pages: &[PageMeasured]) -> Option<Claim> {
    let errors: Vec<(u32, f64, f64)> = counts(pages.first()?, Filter::Tent)
        .into_iter()
        .filter_map(|n| {
            let both = [Filter::Tent, Filter::Bilinear].map(|f| whole(pages, &method(f, n)));
            Some((n, both[0]?, both[1]?))
        })
        .collect();
    let &(most, tent, bilinear) = errors.last().filter(|last| last.0 > 1)?;
    let lasting = errors.iter().rev().take_while(|(_, tent, rays)| as_near(*rays, *tent)).count();
    let ends = if nearer(bilinear, tent) {
        let (tent, bilinear) = (error(tent), error(bilinear));
        format!("; with {most} x {most} the tent is farther off ({tent} against {bilinear})")
    } else {
        String::new()
    };
    let claim = |verdict, text| Some(Claim::general(Topic::ManyRays, verdict, text));
    if lasting == 0 {
        return claim(
            Verdict::Wins,
            format!(
                "Even with {most} x {most} rays in a pixel the tent is nearer to the truth than bilinear \
                 interpolation: {} against {} over all pages.",
                error(tent),
                error(bilinear)
            ),
        );
    }
    let (from, tent, bilinear) = errors[errors.len() - lasting];
    let cost = in_the_time(time_ratio(
        pages,
        &method(Filter::Bilinear, from),
        &method(Filter::Tent, from),
    )?);
    let verdict = if ends.is_empty() { Verdict::Even } else { Verdict::Loses };
    let (start, verdict) = if lasting == errors.len() {
        ("With any number of rays that was measured".to_string(), Verdict::Loses)
    } else {
        (format!("From {from} x {from} rays in a pixel on"), verdict)
    };
    let (tent, bilinear) = (error(tent), error(bilinear));
    claim(
        verdict,
        format!(
            "{start} bilinear interpolation is as near to the truth as the tent ({bilinear} and {tent} over \
             all pages), {cost}{ends}."
        ),
    )
}

/// Returns a sentence on mip-mapping with one ray, which is not a method of the thesis.
fn mip(pages: &[PageMeasured]) -> Option<Claim> {
    let (mip, tent) = (method(Filter::Mip, 1), method(Filter::Tent, 1));
    let (own, rival) = (whole(pages, &mip)?, whole(pages, &tent)?);
    let ratio = time_ratio(pages, &mip, &tent)?;
    let (verdict, words) = if nearer(rival, own) {
        (Verdict::Wins, "is farther from the truth than the tent")
    } else if nearer(own, rival) {
        (Verdict::Loses, "is nearer to the truth than the tent")
    } else if AS_FAST * ratio < 1.0 {
        (Verdict::Loses, "is as near to the truth as the tent")
    } else {
        (Verdict::Even, "is as near to the truth as the tent")
    };
    let text = format!(
        "With one ray, mip-mapping {words} ({} and {} over all pages), {}.",
        error(own),
        error(rival),
        in_the_time(ratio)
    );
    Some(Claim::general(Topic::Mip, verdict, text))
}

/// Returns a sentence on box, tent and quadratic with one ray.
fn orders(pages: &[PageMeasured]) -> Option<Claim> {
    let [box_, tent, quadratic] = [Filter::Box, Filter::Tent, Filter::Quadratic]
        .map(|filter| whole(pages, &method(filter, 1)));
    let (box_, tent) = (box_?, tent?);
    let (verdict, of_box) = if nearer(tent, box_) {
        (Verdict::Wins, "nearer than")
    } else if nearer(box_, tent) {
        (Verdict::Loses, "farther off than")
    } else {
        (Verdict::Even, "no nearer than")
    };
    let mut text = format!(
        "Of the orders of repeated integration, with one ray, the tent (n = 2, {}) is {of_box} the box \
         (n = 1, {})",
        error(tent),
        error(box_)
    );
    let by = (method(Filter::Quadratic, 1), method(Filter::Tent, 1));
    if let (Some(quadratic), Some(ratio)) = (quadratic, time_ratio(pages, &by.0, &by.1)) {
        let gains = if nearer(quadratic, tent) {
            format!("is nearer still ({})", error(quadratic))
        } else if nearer(tent, quadratic) {
            format!("is farther off ({})", error(quadratic))
        } else {
            format!("gains nothing over it ({})", error(quadratic))
        };
        text += &format!("; n = 3 {gains}, {}", in_the_time(ratio));
    }
    text.push('.');
    Some(Claim::general(Topic::Orders, verdict, text))
}

/// Returns a sentence on the thesis's supersampling and 2 x 2 rays, which trace as many rays.
fn supersampling(pages: &[PageMeasured]) -> Option<Claim> {
    let nine = Method { filter: Filter::Tent, sampling: Sampling::Supersample(Supersample::Image) };
    let even = method(Filter::Tent, 2);
    let (own, rival) = (whole(pages, &nine)?, whole(pages, &even)?);
    let ratio = time_ratio(pages, &nine, &even)?;
    let (verdict, words) = if nearer(own, rival) {
        (Verdict::Wins, "nearer to the truth than")
    } else if nearer(rival, own) {
        (Verdict::Loses, "farther from the truth than")
    } else if ratio > AS_FAST {
        (Verdict::Loses, "no nearer to the truth than")
    } else {
        (Verdict::Even, "as near to the truth as")
    };
    let text = format!(
        "The thesis's supersampling of the tent is {words} 2 x 2 rays of equal weight, which look at as many \
         places: {} against {} over all pages, {}.",
        error(own),
        error(rival),
        in_the_time(ratio)
    );
    Some(Claim::general(Topic::Supersampling, verdict, text))
}

/// Returns a sentence on the memory of tables beyond that of one bilinear ray.
fn memory(pages: &[PageMeasured]) -> Option<Claim> {
    let more = |filter: Filter| -> Option<u64> {
        let own = pages.iter().filter_map(|page| {
            let bytes = |filter| Some(evenly(page, filter, 1)?.cost.peak_bytes as u64);
            Some(bytes(filter)?.saturating_sub(bytes(Filter::Bilinear)?))
        });
        own.max().filter(|&most| most > 0)
    };
    let tent = more(Filter::Tent)?;
    let mut text =
        format!("For its tables the tent holds up to {} more than bilinear rays", bytes(tent));
    let verdict = match more(Filter::Mip) {
        Some(mip) if mip < tent => {
            text += &format!("; mip-mapping holds {} more", bytes(mip));
            Verdict::Loses
        }
        _ => Verdict::Even,
    };
    text.push('.');
    Some(Claim::general(Topic::Memory, verdict, text))
}
