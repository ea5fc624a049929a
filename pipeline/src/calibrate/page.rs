//! The HTML page of a calibration.

use super::measure::{Case, REQUESTS, SceneCases};
use super::summary::{Summary, by_request, exponent, halvings, interval};
use crate::html;
use maud::{Markup, html};

/// Width and height of the plot.
const PLOT: [f64; 2] = [640.0, 420.0];

/// Smallest and largest error on the plot's axes.
const SPAN: [f64; 2] = [0.0003, 0.1];

/// Returns the page as one file of HTML.
#[must_use]
pub fn page(scenes: &[SceneCases], side: u32) -> String {
    let body = html! {
        header {
            p.eyebrow { "Measured" }
            h1 { "Requested and reached errors" }
            p.lead {
                (scenes.len()) " scenes of " (side) " x " (side) " pixels. The true error is that of all "
                "pixels by brute force. Errors are root mean squares in linear light; white is 1."
            }
        }
        h2 { "All scenes" }
        (overview(scenes))
        @if let Some(exponent) = exponent(scenes) {
            p {
                "Processor time grows as one over the error to the power " (format!("{exponent:.2}"))
                ": half the error takes " (format!("{:.2}", 2.0_f64.powf(exponent))) " times the time."
            }
        }
        @if let Some(costs) = halvings(scenes) {
            p {
                "Half the error takes, scene by scene, " (format!("{:.2}", costs[0])) " times the time in the "
                "middle, and " (format!("{:.2}", costs[1])) " times at most."
            }
        }
        h2 { "Bounds and true errors" }
        p { "Each dot is a picture. Dots above the diagonal have a true error above the stated bound." }
        (plot(scenes))
        h2 { "Every scene" }
        @for scene in scenes { (section(scene)) }
    };
    html::page("Requested and reached errors", &body)
}

fn overview(scenes: &[SceneCases]) -> Markup {
    html! {
        table {
            thead { tr {
                th { "requested" } th { "pictures" } th { "below the bound" } th { "95 % interval" }
                th { "surely above" } th { "at most 1.1 times" } th { "at most twice" }
                th { "reported as missed" } th { "true error in bounds: median, largest" }
                th { "rays per pixel" } th { "audit" } th { "processor time, s" }
            } }
            tbody {
                @for (request, cases) in by_request(scenes) {
                    @if let Some(summary) = Summary::of(&cases) { (row(request, &summary)) }
                }
            }
        }
    }
}

fn row(request: Option<f64>, summary: &Summary) -> Markup {
    let name = request.map_or("audits alone".into(), |error| error.to_string());
    let [low, high] = interval(summary.covered, summary.cases);
    let percent = |part: f64| format!("{:.1}", 100.0 * part);
    let part = |count: usize| percent(count as f64 / summary.cases as f64) + " %";
    html! {
        tr {
            th { (name) }
            td { (summary.cases) }
            td { (part(summary.covered)) }
            td { (percent(low)) " to " (percent(high)) " %" }
            td { (summary.certainly_above) }
            td { (part(summary.within[0])) }
            td { (part(summary.within[1])) }
            td { (summary.missed) }
            td { (format!("{:.2}, {:.2}", summary.of_bound[0], summary.of_bound[1])) }
            td { (format!("{:.2}", summary.rays[0])) }
            td { (format!("{:.2}", summary.rays[1])) }
            td { (format!("{:.1}", summary.seconds)) }
        }
    }
}

/// Returns a plot of true errors over stated bounds, both on logarithmic axes.
fn plot(scenes: &[SceneCases]) -> Markup {
    let [width, height] = PLOT;
    let along =
        |error: f64| (error.clamp(SPAN[0], SPAN[1]) / SPAN[0]).ln() / (SPAN[1] / SPAN[0]).ln();
    let x = |error: f64| 40.0 + (width - 50.0) * along(error);
    let y = |error: f64| height - 30.0 - (height - 40.0) * along(error);
    let at = |number: f64| format!("{number:.1}");
    let cases = || scenes.iter().flat_map(|scene| &scene.cases);
    html! {
        svg viewBox={ "0 0 " (width) " " (height) } role="img"
            aria-label="True errors over stated bounds" style="max-width: 100%" {
            line x1=(at(x(SPAN[0]))) y1=(at(y(SPAN[0]))) x2=(at(x(SPAN[1]))) y2=(at(y(SPAN[1])))
                stroke="currentColor" stroke-opacity="0.5" {}
            text x=(at(width - 10.0)) y=(at(height - 36.0)) text-anchor="end" font-size="12"
                fill="currentColor" { "stated bound" }
            text x="46" y="20" font-size="12" fill="currentColor" { "true error" }
            @for mark in REQUESTS.into_iter().chain([0.001]) {
                text x=(at(x(mark))) y=(at(height - 10.0)) text-anchor="middle" font-size="12"
                    fill="currentColor" { (mark) }
                text x="36" y=(at(y(mark) + 4.0)) text-anchor="end" font-size="12"
                    fill="currentColor" { (mark) }
            }
            @for case in cases() {
                circle cx=(at(x(case.bound))) cy=(at(y(case.truth))) r="3" fill-opacity="0.45"
                    fill=(if case.requested.is_some() { "#2266cc" } else { "#cc7722" }) {}
            }
        }
        p { "Blue: requested errors. Brown: audits alone. Smaller true errors than 0.0003 are at the lower edge." }
    }
}

fn section(scene: &SceneCases) -> Markup {
    html! {
        details {
            summary { (scene.name) }
            table {
                thead { tr {
                    th { "requested" } th { "rays" } th { "stated" } th { "bound" } th { "true" }
                    th { "rays per pixel" } th { "audit" } th { "processor time, s" }
                } }
                tbody { @for case in &scene.cases { (case_row(case)) } }
            }
        }
    }
}

fn case_row(case: &Case) -> Markup {
    let requested = case.requested.map_or(String::new(), |error| error.to_string());
    html! {
        tr {
            th { (requested) @if case.missed { " (missed)" } }
            td { (case.method) }
            td { (format!("{:.4}", case.stated)) }
            td { (format!("{:.4}", case.bound)) }
            td { (format!("{:.4}", case.truth)) @if case.above { " (above)" } }
            td { (format!("{:.2}", case.rays[0])) }
            td { (format!("{:.2}", case.rays[1])) }
            td { (format!("{:.2}", case.seconds)) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A shape that is not closed would contain all that follow, and none of them would be drawn.
    #[test]
    fn shapes_of_the_plot_are_closed() {
        let case = Case {
            requested: Some(0.01),
            method: "1 x 1, whole".into(),
            stated: 0.006,
            bound: 0.009,
            missed: false,
            truth: 0.007,
            above: false,
            certainly_above: false,
            rays: [1.0, 0.2],
            seconds: 0.5,
        };
        let scene = SceneCases { name: "vase".into(), cases: vec![case] };
        let drawn = page(&[scene], 64);
        for shape in ["line", "circle", "text"] {
            let count = |part: &str| drawn.matches(part).count();
            let (opened, closed) = (count(&format!("<{shape} ")), count(&format!("</{shape}>")));
            assert!(opened > 0 && opened == closed, "{shape}");
        }
    }
}
