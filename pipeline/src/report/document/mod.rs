//! The HTML page of a report: conclusions first, then every page with pictures, plots and tables.

mod page;
mod pictures;
mod summary;
mod tables;
mod trials;

use super::measured::{Measured, PageMeasured};
use super::plot::{self, Chart, Size};
use super::words::{AS_FAST, AS_NEAR, Claim, Verdict};
use crate::PipelineError;
use crate::html;
use maud::{Markup, PreEscaped, html};

const STYLE: &str = include_str!("style.css");

/// Returns the whole report as one self-contained HTML page.
///
/// # Errors
/// When a picture cannot be compared or encoded.
pub fn document(measured: &Measured, claims: &[Claim]) -> Result<String, PipelineError> {
    let mut pages = Vec::with_capacity(measured.pages.len());
    for own in &measured.pages {
        pages.push(page::section(own, claims)?);
    }
    let body = html! {
        style { (PreEscaped(plot::STYLE)) (PreEscaped(STYLE)) }
        header {
            p.eyebrow { "Measured" }
            h1 { "Speed against error" }
            p.lead {
                "What each way of rendering a page costs, and how far its picture is from the truth: "
                (count(measured.pages.len(), "page")) ", " (count(measured.threads, "thread")) "."
            }
            @if measured.quick {
                p.notice {
                    "Made in haste: small pictures, few methods and few rounds. Take its sentences as a "
                    "sketch; times in particular are rough."
                }
            }
        }
        (summary::section(measured, claims))
        @for page in &pages { (page) }
        (tables::section(&measured.tables))
        (how(measured))
    };
    Ok(html::page("Speed against error", &body))
}

/// Returns a description of a page's plot for readers who cannot see it.
pub fn about_plot(page: &PageMeasured) -> String {
    format!(
        "{}: RMS error against processor time, a curve for each filter over its numbers of rays",
        page.title
    )
}

/// Returns a chart in two sizes, for a desktop screen and for a telephone. Only one of them is visible.
fn chart(chart: &Chart, about: &str) -> Markup {
    html! {
        div.for-desk { (PreEscaped(chart.inline(Size::Wide, about))) }
        div.for-telephone { (PreEscaped(chart.inline(Size::Narrow, about))) }
    }
}

fn count(n: usize, thing: &str) -> String {
    if n == 1 { format!("one {thing}") } else { format!("{n} {thing}s") }
}

/// Replaces typewriter signs with typographic ones.
pub fn set(text: &str) -> String {
    text.replace('\'', "\u{2019}").replace(" x ", " \u{d7} ")
}

/// Returns a sentence. If the sentence advises a method, the method is in bold.
fn sentence(claim: &Claim) -> Markup {
    let text = set(&claim.text);
    let parts = text.strip_prefix("Use ").and_then(|rest| rest.split_once(" where "));
    html! {
        @match parts.filter(|_| claim.verdict == Verdict::Use) {
            Some((method, when)) => { "Use " b { (method) } " where " (when) }
            None => (text),
        }
    }
}

fn percent(part: f64) -> String {
    format!("{:.0} %", 100.0 * part)
}

/// Returns the section on methods and terms.
fn how(measured: &Measured) -> Markup {
    let by = |factor: f64| percent(factor - 1.0);
    let samples = measured.pages.iter().map(|page| page.truth.samples).min();
    html! {
        section id="how" {
            p.eyebrow { "Method" }
            h2 { "How it was measured" }
            dl.terms {
                dt { "Truth" }
                dd {
                    "The program's own picture of jittered bilinear rays without a filter: two of them, from two "
                    "seeds"
                    @if let Some(samples) = samples {
                        ", of at least " (samples) " \u{d7} " (samples) " rays in a pixel each"
                    }
                    ", and their mean. It is a truth about textures, edges and sampling; what the renderer "
                    "itself leaves out of light, it leaves out of the truth too."
                }
                dt { "Noise" }
                dd {
                    "Half the root mean square difference of the two: about the error of their mean. It is "
                    "taken out of the errors reported, as squares. Where the two differ by more than a fifth of "
                    "the smallest error, the report says so."
                }
                dt { "Error" }
                dd {
                    "Root mean square over pixels and channels, in linear light, where white is 1. "
                    "\u{201c}99.9 %\u{201d} is what the largest difference among the channels of a pixel does not "
                    "exceed in 99.9 % of the pixels."
                }
                dt { "Time" }
                dd {
                    "Of tables, structure and picture, without reading and writing. Processor time is summed "
                    "over " (count(measured.threads, "thread")) "; methods take turns, and of their rounds the "
                    "median counts. Memory is the most that is held at once beyond the scene."
                }
                dt { "Pareto front" }
                dd {
                    "The methods than which no other is both cheaper and nearer: the broad line in the plots, "
                    "which shows what can be had for each time. Small numbers there are rays along each side of "
                    "a pixel."
                }
                dt { "Words" }
                dd {
                    "Sentences come from the numbers, by rules. Errors within " (by(AS_NEAR)) " of each other are "
                    "\u{201c}as near\u{201d}, times within " (by(AS_FAST)) " \u{201c}the same\u{201d}. Errors of "
                    "several pages together are root mean squares over all their pixels; times are compared page "
                    "by page, in the geometric mean."
                }
                dt { "Regions" }
                dd {
                    "Pixels by what the ray through their middle meets: at silhouettes the neighbouring pixels "
                    "see another object; the far floor is flat and seen at more than two texels to a pixel; in "
                    "mirrors and through glass, more than half of the light comes from textures by such rays."
                }
            }
        }
    }
}
