//! The section of conclusions, and a table of all pages.

use super::super::advice::{Question, Sentence};
use super::super::measured::{Measured, Method, PageMeasured, Trial};
use crate::number::{error, times};
use maud::{Markup, html};
use render::Sampling;
use render::film::{Supersample, THRESHOLD};
use render::filter::Filter;

const GROUPS: [(Question, &str); 5] = [
    (Question::Use, "Which method to use"),
    (Question::Areas, "What areas gain"),
    (Question::Cost, "What the tent costs"),
    (Question::Fails, "Where filters fail"),
    (Question::Doubt, "What is in doubt"),
];

pub fn section(measured: &Measured, advice: &[Sentence]) -> Markup {
    html! {
        section id="conclusions" {
            h2 { "What the numbers say" }
            p.faint {
                "The thesis\u{2019}s method is prefiltering by repeated integration: box, tent and quadratic (n = "
                "1, 2, 3), over boxes around rays on a lattice. The tent represents this method. By areas, each "
                "ray carries the area that it stands for; \u{201c}exact\u{201d} averages over this area without error, and "
                "pixels at edges are split."
            }
            @for (question, heading) in GROUPS {
                @let own: Vec<&Sentence> =
                    advice.iter().filter(|sentence| sentence.question == question).collect();
                @if !own.is_empty() {
                    div.verdict {
                        h3 { (heading) }
                        ul { @for sentence in own { li { (super::set(&sentence.text)) } } }
                    }
                }
            }
        }
        @if !measured.pages.is_empty() { (glance(&measured.pages)) }
    }
}

/// Returns a table with one row for each page.
fn glance(pages: &[PageMeasured]) -> Markup {
    html! {
        section id="pages" {
            h2 { "The pages at a glance" }
            p.faint {
                "Errors of one ray in each pixel with four filters, of the thesis\u{2019}s supersampling with the tent, and "
                "of exact averages over areas; in brackets the ratio of the processor time to that of one bilinear ray."
            }
            div.wide {
                table.glance {
                    thead { tr {
                        th { "Page" }
                        @for filter in SHOWN { th { (filter) } }
                        th { "tent, super-" br; "sampled" }
                        th { "exact," br; "1 area" }
                        th { "exact, split" br; "at " (THRESHOLD) }
                        th { "smallest error of all" }
                    } }
                    tbody { @for page in pages { (row(page)) } }
                }
            }
        }
    }
}

const SHOWN: [Filter; 4] = [Filter::Point, Filter::Bilinear, Filter::Mip, Filter::Tent];

fn row(page: &PageMeasured) -> Markup {
    let find = |filter: Filter, is: &dyn Fn(Sampling) -> bool| {
        page.trials.iter().find(|trial| trial.method.filter == filter && is(trial.method.sampling))
    };
    let one = |filter| find(filter, &|sampling| sampling == Sampling::regular(1));
    let nine = |form| find(Filter::Tent, &move |sampling| sampling == Sampling::Supersample(form));
    let exact = |threshold| {
        let method = Method::area(Filter::Exact, 1, threshold);
        page.trials.iter().find(|trial| trial.method == method)
    };
    let nearest = page.trials.iter().min_by(|a, b| a.whole.rmse.total_cmp(&b.whole.rmse));
    let unit = one(Filter::Bilinear).map(|trial| trial.cost.cpu);
    let cell = |trial: Option<&Trial>| {
        html! {
            @match trial {
                Some(trial) => {
                    (error(trial.whole.rmse))
                    @if let Some(unit) = unit {
                        " " span.faint { "(" (times(trial.cost.cpu / unit)) ")" }
                    }
                }
                None => "\u{2013}",
            }
        }
    };
    html! {
        tr {
            td { a href={ "#" (page.name) } { (page.name) } }
            @for filter in SHOWN { td { (cell(one(filter))) } }
            td { (cell(nine(Supersample::Image).or_else(|| nine(Supersample::Rays)))) }
            td { (cell(exact(None))) }
            td { (cell(exact(Some(THRESHOLD)))) }
            td {
                (cell(nearest))
                @if let Some(nearest) = nearest { br; span.faint { (super::set(&nearest.method.name())) } }
            }
        }
    }
}
