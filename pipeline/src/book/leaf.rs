//! A page of the book as HTML.

use super::detail::Detail;
use super::image::address;
use super::plate::{Plate, Shot, in_details};
use super::{Entry, Options};
use crate::PipelineError;
use crate::job::figure;
use crate::number::{self, count, error, seconds};
use crate::stages::Stages;
use maud::{Markup, html};
use render::Picture;

/// Letters that number the details.
const LETTERS: [&str; 8] = ["a", "b", "c", "d", "e", "f", "g", "h"];

/// Returns the page of a job.
///
/// # Errors
/// When a picture cannot be encoded as PNG.
pub fn leaf(
    entry: &Entry<'_>,
    plate: &Plate,
    id: &str,
    options: &Options,
) -> Result<Markup, PipelineError> {
    let job = entry.job;
    let figures = job.figures();
    let (stage, part) = plate.total().slowest();
    Ok(html! {
        article.plate id=(id) {
            header {
                p.eyebrow {
                    @if figures.is_empty() { (job.name) } @else { (figures_in_words(&figures)) " · " (job.name) }
                }
                h2 { (job.title) }
                @if !job.caption.is_empty() { p.caption { (job.caption) } }
            }
            div.spread {
                (views(plate, id)?)
                div.facts {
                    (costs(plate))
                    p.faint { "The slowest stage is “" (stage) "”, " (percent(part)) "." }
                    @if !plate.meshes.is_empty() { p.faint { (meshes(plate)) } }
                }
            }
            @for (k, detail) in plate.details.iter().enumerate() {
                (strip(plate, detail, letter(k))?)
            }
            (command(entry, plate, options))
            (sources(plate))
        }
    })
}

/// Returns the heading of a list of figures, whose numbers must ascend.
#[must_use]
pub fn figures_in_words(figures: &[u8]) -> String {
    let word = if figures.len() == 1 { "Figure" } else { "Figures" };
    format!("{word} {}", figure::listed(figures).replace('-', "–"))
}

fn letter(k: usize) -> &'static str {
    LETTERS.get(k).copied().unwrap_or("…")
}

/// Returns the whole pictures stacked in one view with tabs. The last picture is visible first.
fn views(plate: &Plate, id: &str) -> Result<Markup, PipelineError> {
    let own: Vec<&Shot> = plate.shots.iter().filter(|shot| shot.own).collect();
    let mut pictures = Vec::new();
    for shot in &own {
        pictures.push(address(id, &shot.picture)?);
    }
    let last = own.len().saturating_sub(1);
    Ok(html! {
        div.stage {
            @if own.len() > 1 {
                div.tabs role="radiogroup" aria-label="mode" {
                    @for (k, shot) in own.iter().enumerate() {
                        label.tab {
                            input type="radio" name=(id) checked[k == last];
                            span { @if let Some(figure) = &shot.mode.figure { b { (figure) } " " } (shot.mode.name) }
                        }
                    }
                }
            }
            div.views {
                @for (shot, picture) in own.iter().zip(&pictures) {
                    figure.view {
                        label.enlarge title="enlarge" {
                            input type="checkbox" aria-label=(format!("enlarge {}", shot.mode.name));
                            span.sheet {
                                img src=(picture) alt=(format!("the whole picture, {}", shot.mode.name))
                                    width=(shot.picture.width) height=(shot.picture.height);
                                @for (k, detail) in plate.details.iter().enumerate() {
                                    (frame(detail, &shot.picture, letter(k)))
                                }
                            }
                        }
                    }
                }
            }
        }
    })
}

/// Returns the frame that shows the position of a detail in the whole picture.
fn frame(detail: &Detail, whole: &Picture, letter: &str) -> Markup {
    let percent = |part: u32, all: u32| format!("{:.3}%", 100.0 * f64::from(part) / f64::from(all));
    let style = format!(
        "left:{};top:{};width:{};height:{}",
        percent(detail.crop.x, whole.width),
        percent(detail.crop.y, whole.height),
        percent(detail.crop.width, whole.width),
        percent(detail.crop.height, whole.height),
    );
    html! { span.frame style=(style) { span { (letter) } } }
}

/// Returns the table of each mode's costs and error.
fn costs(plate: &Plate) -> Markup {
    let own: Vec<&Shot> = plate.shots.iter().filter(|shot| shot.own).collect();
    let all = |shot: &Shot| (plate.shared.total() + shot.stages.total()).as_secs_f64();
    let rays = |shot: &Shot| {
        let stats = &shot.stats;
        stats.primary_rays + stats.reflected_rays + stats.refracted_rays + stats.shadow_rays
    };
    let of_thesis = own.iter().any(|shot| shot.mode.thesis_minutes.is_some());
    html! {
        div.wide {
            table {
                thead { tr {
                    th {}
                    @for shot in &own { th scope="col" { (shot.mode.name) } }
                } }
                tbody {
                    tr { th scope="row" { "rays" } @for shot in &own { td { (number::millions(rays(shot))) } } }
                    @for (k, name) in Stages::NAMES.iter().enumerate() {
                        @let times: Vec<_> = own.iter().map(|shot| shot.stages.times()[k]).collect();
                        @let shared = plate.shared.times()[k];
                        @if !shared.is_zero() {
                            tr {
                                th scope="row" { (name) }
                                td.shared colspan=(own.len()) { (seconds(shared.as_secs_f64())) @if own.len() > 1 { ", for all" } }
                            }
                        } @else if times.iter().any(|time| !time.is_zero()) {
                            tr { th scope="row" { (name) } @for time in &times { td { (seconds(time.as_secs_f64())) } } }
                        }
                    }
                    tr.sum {
                        th scope="row" { "together" }
                        @for shot in &own { td { (seconds((plate.shared.total() + shot.stages.total()).as_secs_f64())) } }
                    }
                    @if of_thesis {
                        tr {
                            th scope="row" { "in 1993" }
                            @for shot in &own {
                                td { (shot.mode.thesis_minutes.map_or("–".into(), number::minutes)) }
                            }
                        }
                        tr.ratio {
                            th scope="row" { "times as fast" }
                            @for shot in &own {
                                td {
                                    @if let Some(minutes) = shot.mode.thesis_minutes {
                                        (number::times(60.0 * f64::from(minutes) / all(shot)))
                                    } @else { "–" }
                                }
                            }
                        }
                    }
                    @if own.iter().any(|shot| shot.error.is_some()) {
                        tr {
                            th scope="row" { "error" }
                            @for shot in &own { td { (shot.error.map_or("–".into(), error)) } }
                        }
                    }
                }
            }
        }
    }
}

fn meshes(plate: &Plate) -> String {
    let each: Vec<String> = plate
        .meshes
        .iter()
        .map(|(name, triangles)| format!("{name}, {} triangles", count(*triangles as u64)))
        .collect();
    let all: usize = plate.meshes.iter().map(|(_, triangles)| triangles).sum();
    match each.len() {
        1 => format!("Mesh: {}.", each[0]),
        _ => format!("Meshes: {}; {} in all.", each.join("; "), count(all as u64)),
    }
}

/// Returns a detail in each mode, side by side.
fn strip(plate: &Plate, detail: &Detail, letter: &str) -> Result<Markup, PipelineError> {
    let shots: Vec<&Shot> = in_details(&plate.shots).collect();
    let mut pictures = Vec::new();
    for picture in &detail.pictures {
        pictures.push(address(letter, picture)?);
    }
    let truth = match &detail.judged {
        Some(judged) => Some(address(letter, &judged.truth)?),
        None => None,
    };
    let errors = detail.judged.as_ref().map(|judged| judged.errors.as_slice()).unwrap_or_default();
    let size = |picture: &Picture| format!("--w:{};--h:{}", picture.width, picture.height);
    Ok(html! {
        section.detail {
            h3 { span.letter { (letter) } (detail.title) }
            div.strip {
                @for (k, (shot, picture)) in shots.iter().zip(&pictures).enumerate() {
                    figure {
                        img src=(picture) style=(size(&detail.pictures[k]))
                            alt=(format!("{}, {}", detail.title, shot.mode.name));
                        figcaption {
                            (shot.mode.name)
                            @if let Some(value) = errors.get(k) { " " span.error { (error(*value)) } }
                        }
                    }
                }
                @if let (Some(truth), Some(judged)) = (&truth, &detail.judged) {
                    figure.truth {
                        img src=(truth) style=(size(&judged.truth)) alt={ (detail.title) ", truth" };
                        figcaption { "truth" }
                    }
                }
            }
            @if let Some(judged) = &detail.judged {
                @if !judged.wide_errors.is_empty() {
                    p.faint.note {
                        "RMS error in pixels that span more than two texels in both directions ("
                        (percent(judged.wide)) " of the detail): "
                        @for (k, (shot, value)) in shots.iter().zip(&judged.wide_errors).enumerate() {
                            @if k > 0 { ", " } (shot.mode.name) " " span.error { (error(*value)) }
                        }
                        "."
                    }
                }
            }
        }
    })
}

/// Formats a fraction in [0, 1] as a percentage.
fn percent(part: f64) -> String {
    if part < 0.01 { "less than 1 %".into() } else { format!("{:.0} %", 100.0 * part) }
}

/// Returns the commands that make the pictures.
fn command(entry: &Entry<'_>, plate: &Plate, options: &Options) -> Markup {
    let size = match options.size {
        (512, 512) => String::new(),
        (width, height) => format!(" --size {width}x{height}"),
    };
    let figures = plate.shots.iter().filter_map(|shot| shot.mode.figure.as_deref());
    html! {
        pre.command {
            code {
                "pipeline run " (entry.argument) (size) "\n"
                @for figure in figures { "pipeline run " (figure) (size) "\n" }
            }
        }
    }
}

fn sources(plate: &Plate) -> Markup {
    html! {
        details.sources {
            summary { "The job, its scene and its curves" }
            @for text in &plate.texts {
                details {
                    summary { (text.path) span.faint { " " (text.kind) } }
                    pre { code { (text.text) } }
                }
            }
        }
    }
}
