//! The HTML page of a report: conclusions first, then every page with pictures, plots and tables.

mod accompanying;
mod page;
mod pictures;
mod summary;
mod trials;

use super::advice::Sentence;
use super::measured::{Measured, PageMeasured};
use super::plot::{self, Chart, Size};
use crate::PipelineError;
use crate::html;
use maud::{Markup, PreEscaped, html};

const STYLE: &str = include_str!("style.css");

/// The section on methods and terms.
const TERMS: &str = include_str!("terms.html");

/// Returns the whole report as one self-contained HTML page.
///
/// # Errors
/// When a picture cannot be compared or encoded.
pub fn document(measured: &Measured, advice: &[Sentence]) -> Result<String, PipelineError> {
    let mut pages = Vec::with_capacity(measured.pages.len());
    for own in &measured.pages {
        pages.push(page::section(own, advice)?);
    }
    let body = html! {
        style { (PreEscaped(plot::STYLE)) (PreEscaped(STYLE)) }
        header {
            p.eyebrow { "Measured" }
            h1 { "Speed against error" }
            p.lead {
                "The cost of each method of rendering a page, and the error of its picture: "
                (count(measured.pages.len(), "page")) ", " (count(measured.threads, "thread")) "."
            }
            @if measured.quick {
                p.notice {
                    "A quick report: small pictures, few methods and few rounds. Its sentences are "
                    "approximate, and its times are rough."
                }
            }
        }
        (summary::section(measured, advice))
        @for page in &pages { (page) }
        (accompanying::section())
        (PreEscaped(TERMS))
    };
    Ok(html::page("Speed against error", &body))
}

/// Returns a description of a page's plot for readers who cannot see it.
pub fn about_plot(page: &PageMeasured) -> String {
    format!(
        "{}: RMS error against processor time, a curve for each filter over its numbers of rays or areas",
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
