//! Shows the pictures of a page beside the truth, with maps of their errors.

use super::super::measured::{Method, PageMeasured, Trial};
use crate::PipelineError;
use crate::html::png_address;
use crate::number::{error, seconds};
use compare::{Scale, map, scale};
use maud::{Markup, html};
use render::color::Encoding;
use render::film::encode::{Format, encode};
use render::film::{Supersample, THRESHOLD};
use render::filter::Filter;
use render::{Picture, Sampling};

/// The range of errors in the maps: from invisible differences up to white instead of black.
const SCALE: Scale = Scale::Log { least: 1e-3, most: 1.0 };

/// Returns a row of pictures, each above its error map.
pub fn pictures(page: &PageMeasured) -> Result<Markup, PipelineError> {
    let mut shown = Vec::new();
    for (why, trial, picture) in chosen(page) {
        let own = address(&page.name, picture)?;
        let errors = map::map(picture, &page.truth.picture, SCALE)?;
        let errors = png_address(&map::png(&errors).map_err(|e| encoding(&page.name, e))?);
        shown.push((why, trial, own, errors));
    }
    let truth = address(&page.name, &page.truth.picture)?;
    Ok(html! {
        div.pictures {
            figure {
                img src=(truth) alt={ "The truth of " (page.name) };
                (legend())
                figcaption { b { "The truth" } }
            }
            @for (why, trial, own, errors) in &shown {
                figure {
                    img src=(own) alt={ (page.name) " by " (trial.method.name()) };
                    img src=(errors) alt={ "Errors of " (trial.method.name()) };
                    figcaption {
                        b { (super::set(&trial.method.name())) }
                        @if !why.is_empty() { br; span.faint { (why) } }
                        br;
                        "error " (error(trial.whole.rmse)) ", " (seconds(trial.cost.cpu))
                    }
                }
            }
        }
    })
}

/// Returns the pictures to show. The first three are one ray without and with the thesis's filter, and
/// the thesis's supersampling. Next come exact averages over whole and over split pixels. Then comes the
/// bilinear or mip-mapped method on the lattice that is nearest to the truth in no more time than the
/// supersampling, or than one filtered ray if there is no supersampling. The last is the nearest of all.
fn chosen(page: &PageMeasured) -> Vec<(&'static str, &Trial, &Picture)> {
    let find = |filter: Filter, sampling: Sampling| {
        let is =
            |trial: &&Trial| trial.method.filter == filter && trial.method.sampling == sampling;
        page.trials.iter().find(is)
    };
    let nine = find(Filter::Tent, Sampling::Supersample(Supersample::Image))
        .or_else(|| find(Filter::Tent, Sampling::Supersample(Supersample::Rays)));
    let one = find(Filter::Tent, Sampling::regular(1));
    let nearest = |of: &dyn Fn(&Trial) -> bool| {
        let own = page.trials.iter().filter(|trial| of(trial));
        own.min_by(|a, b| a.whole.rmse.total_cmp(&b.whole.rmse))
    };
    let time = nine.or(one).map_or(0.0, |trial| trial.cost.cpu);
    let rival = nearest(&|trial| {
        let without_tables = trial.method.filter.order().is_none();
        without_tables && trial.method.areas().is_none() && trial.cost.cpu <= time
    });
    let exact = |threshold| {
        let Method { filter, sampling } = Method::area(Filter::Exact, 1, threshold);
        find(filter, sampling)
    };
    let wished = [
        ("as in 1993 without filtering", find(Filter::Point, Sampling::regular(1))),
        ("prefiltered", one),
        ("prefiltered and supersampled", nine),
        ("averaged exactly over whole pixels", exact(None)),
        ("averaged exactly over pixels split at edges", exact(Some(THRESHOLD))),
        (
            "smallest error without tables in the time of the prefiltered and supersampled one",
            rival,
        ),
        ("smallest error of all", nearest(&|_| true)),
    ];
    let mut chosen: Vec<(&'static str, &Trial, &Picture)> = Vec::new();
    for (why, trial) in wished {
        let Some((trial, picture)) = trial.and_then(|t| Some((t, t.picture.as_ref()?))) else {
            continue;
        };
        if chosen.iter().all(|(_, known, _)| known.method != trial.method) {
            chosen.push((why, trial, picture));
        }
    }
    chosen
}

fn address(name: &str, picture: &Picture) -> Result<String, PipelineError> {
    let png = encode(picture, Format::Png, Encoding::Srgb).map_err(|e| encoding(name, e))?;
    Ok(png_address(&png))
}

fn encoding(name: &str, source: image::ImageError) -> PipelineError {
    PipelineError::Encode { name: name.into(), source }
}

/// Returns the colours of the maps, with the errors that they stand for.
fn legend() -> Markup {
    let stops: Vec<String> = (0..=16)
        .map(|k| {
            let [r, g, b] = scale::color_at(f64::from(k) / 16.0);
            format!("rgb({r} {g} {b})")
        })
        .collect();
    let ground = format!("background: linear-gradient(to right, {})", stops.join(", "));
    html! {
        div.legend {
            span { "Error maps, below each picture" }
            div.scale style=(ground) {}
            div.ticks { @for tick in SCALE.ticks() { span { (tick) } } }
        }
    }
}
