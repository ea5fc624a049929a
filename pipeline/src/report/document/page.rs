//! The section of one page.

use super::super::advice::Sentence;
use super::super::measured::PageMeasured;
use super::super::plot::{Chart, Size, trials as plots};
use super::{about_plot, chart, pictures, trials};
use crate::PipelineError;
use crate::number::error;
use maud::{Markup, PreEscaped, html};

pub fn section(page: &PageMeasured, advice: &[Sentence]) -> Result<Markup, PipelineError> {
    let own: Vec<&Sentence> =
        advice.iter().filter(|sentence| sentence.page.as_ref() == Some(&page.name)).collect();
    let (width, height) = page.size;
    let truth = &page.truth;
    let rays = if truth.samples == truth.most_samples {
        format!("{0} \u{d7} {0}", truth.samples)
    } else {
        format!("{0} \u{d7} {0} to {1} \u{d7} {1}", truth.samples, truth.most_samples)
    };
    let pictures = pictures::pictures(page)?;
    // The heading already names the page, and on a telephone a second title does not fit.
    let untitled = Chart { title: None, ..plots::whole(page) };
    Ok(html! {
        section.page id=(page.name) {
            p.eyebrow { (page.name) }
            h2 { (page.title) }
            p.faint {
                (width) " \u{d7} " (height) " pixels; "
                @if truth.given {
                    "the truth is a picture that was given."
                } @else {
                    "the truth has two times " (rays) " rays in a pixel; its noise is "
                    (error(truth.noise)) "."
                }
            }
            @if !own.is_empty() { ul { @for sentence in own { li { (super::set(&sentence.text)) } } } }
            (pictures)
            div.plots { (chart(&untitled, &about_plot(page))) }
            @if !page.regions.is_empty() {
                h3 { "By region" }
                div.multiples {
                    @for (region, chart) in page.regions.iter().zip(plots::regions(page)) {
                        (PreEscaped(chart.inline(Size::Small, region.name)))
                    }
                }
            }
            (trials::tables(page))
        }
    })
}
