//! The front of the book: its title, a guide for readers, and the contents.

use super::image::address;
use super::leaf::figures_in_words;
use super::plate::{Plate, Shot};
use super::{Entry, Options};
use crate::PipelineError;
use crate::contact_sheet::thumbnail;
use crate::number;
use maud::{Markup, html};
use std::time::Duration;

/// Longer side of a picture in the contents, in pixels.
const THUMBNAIL: u32 = 192;

/// The front of the book.
#[derive(Debug)]
pub struct Front {
    truth: u32,
    frontispiece: Option<(String, String)>,
    contents: Vec<Line>,
}

/// A page in the contents.
#[derive(Debug)]
struct Line {
    id: String,
    figures: Vec<u8>,
    title: String,
    thumbnail: String,
    times: Vec<Time>,
}

/// A figure whose time the thesis reports.
#[derive(Debug)]
struct Time {
    figure: String,
    mode: String,
    minutes: u32,
    now: Duration,
    /// The time of the same page by exact averages over areas, if it has such a mode.
    exact: Option<Duration>,
}

impl Front {
    /// Makes a front without pages.
    #[must_use]
    pub fn new(options: &Options) -> Self {
        Self { truth: options.truth, frontispiece: None, contents: Vec::new() }
    }

    /// Adds a page to the contents. With `frontispiece` the picture is also shown large on the front.
    ///
    /// # Errors
    /// When a picture cannot be encoded as PNG.
    pub fn take(
        &mut self,
        entry: &Entry<'_>,
        plate: &Plate,
        id: &str,
        frontispiece: bool,
    ) -> Result<(), PipelineError> {
        let Some(Shot { picture, .. }) = plate.shots.iter().rfind(|shot| shot.own) else {
            return Ok(());
        };
        let time = |shot: &Shot| plate.shared.total() + shot.stages.total();
        let exact = plate.shots.iter().find(|shot| shot.own && shot.mode.is_exact()).map(time);
        if frontispiece {
            self.frontispiece = Some((address(id, picture)?, entry.job.title.clone()));
        }
        self.contents.push(Line {
            id: id.into(),
            figures: entry.job.figures(),
            title: entry.job.title.clone(),
            thumbnail: address(id, &thumbnail(picture, THUMBNAIL))?,
            times: plate
                .shots
                .iter()
                .filter_map(|shot| {
                    let (figure, mode) = (shot.mode.figure.clone()?, shot.mode.name.clone());
                    let minutes = shot.mode.thesis_minutes?;
                    Some(Time { figure, mode, minutes, now: time(shot), exact })
                })
                .collect(),
        });
        Ok(())
    }

    /// Returns the front as HTML.
    #[must_use]
    pub fn print(&self) -> Markup {
        let (thesis, ours): (Vec<&Line>, Vec<&Line>) =
            self.contents.iter().partition(|line| !line.figures.is_empty());
        let rays = 2 * self.truth * self.truth;
        html! {
            header.front {
                div.title {
                    p.eyebrow { "Topobook" }
                    h1 { "The picture book" }
                    p.lead {
                        "A contour is swept along a trajectory, the grid is split into triangles, and a ray tracer shows "
                        "them with textures that are averaged over the footprint of each pixel. \
                         The figures are those "
                        "of a thesis of 1993, " cite { "Texture Mapping with Ray Tracing" }
                        ", made again; ours follow."
                    }
                }
                @if let Some((picture, title)) = &self.frontispiece {
                    figure.frontispiece { img src=(picture) alt=(title); figcaption.faint { (title) } }
                }
            }
            nav aria-label="contents" {
                (contents("After the thesis", &thesis))
                (contents(if thesis.is_empty() { "Pages" } else { "Ours" }, &ours))
            }
            (times(&thesis))
            section.reading {
                h2 { "How to read it" }
                div.columns {
                p {
                    "The tabs over a picture change its mode; a click on the picture enlarges it. \
                     The frames in a picture "
                    "mark the details below the picture, which are shown pixel by pixel."
                }
                p {
                    "The modes point, prefiltered and supersampled are the thesis’s: rays on a lattice, and a "
                    "box around each ray’s neighbours as its area. The mode exact is ours: each ray carries the area "
                    "of its pixel with it, through glass and over mirrors, and textures are averaged exactly "
                    "over this area. Pixels at edges are split into smaller areas."
                }
                p {
                    "Times were measured when this page was made, on this machine. The times of \
                     1993 are the thesis’s own, from a Sun Sparc "
                    "workstation."
                }
                @if self.truth > 0 {
                    p {
                        "Numbers beside a detail are its error: root mean square in linear light, where white is 1, against a "
                        "truth of " (rays) " jittered rays in each pixel that average no "
                        "textures. The noise of the truth itself is not included; it hides errors below a bound, and "
                        "the bound is then given."
                    }
                }
                }
            }
        }
    }
}

/// Returns a table of the thesis's figures with their times in 1993 and now.
fn times(lines: &[&Line]) -> Markup {
    let rows = || lines.iter().flat_map(|line| line.times.iter().map(move |time| (line, time)));
    html! {
        @if rows().next().is_some() {
            section.times {
                h2 { "Then and now" }
                div.wide {
                    table {
                        thead { tr {
                            th scope="col" { "figure" }
                            th.mode scope="col" { "mode" }
                            th scope="col" { "in 1993" }
                            th scope="col" { "now" }
                            th scope="col" { "times as fast" }
                            th scope="col" { "in mode exact" }
                        } }
                        tbody {
                            @for (line, time) in rows() {
                                tr {
                                    td { a href=(format!("#{}", line.id)) { (time.figure) } }
                                    td.mode { (time.mode) }
                                    td { (number::minutes(time.minutes)) }
                                    td { (number::seconds(time.now.as_secs_f64())) }
                                    td.ratio { (number::times(60.0 * f64::from(time.minutes) / time.now.as_secs_f64())) }
                                    td { (time.exact.map_or("–".into(), |exact| number::seconds(exact.as_secs_f64()))) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn contents(heading: &str, lines: &[&Line]) -> Markup {
    html! {
        @if !lines.is_empty() {
            h2 { (heading) }
            ol.contents {
                @for line in lines {
                    li {
                        a href=(format!("#{}", line.id)) {
                            img src=(line.thumbnail) alt="";
                            span {
                                @if !line.figures.is_empty() { span.eyebrow { (figures_in_words(&line.figures)) } }
                                (line.title)
                            }
                        }
                    }
                }
            }
        }
    }
}
