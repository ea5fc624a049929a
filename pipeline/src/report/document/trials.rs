//! Tables of the methods measured on a page.

use super::super::measured::{PageMeasured, Trial};
use super::super::pareto;
use crate::number::{bytes, error, seconds};
use maud::{Markup, html};

/// Returns a table of the Pareto front, and a folded table of all methods.
pub fn tables(page: &PageMeasured) -> Markup {
    let points: Vec<(f64, f64)> =
        page.trials.iter().map(|trial| (trial.cost.cpu, trial.whole.rmse)).collect();
    let front = pareto::front(&points);
    let all: Vec<usize> = (0..page.trials.len()).collect();
    html! {
        h3 { "On the Pareto front" }
        (table(page, &front, &front))
        details {
            summary { "All " (page.trials.len()) " methods" }
            (table(page, &all, &front))
        }
    }
}

fn table(page: &PageMeasured, rows: &[usize], front: &[usize]) -> Markup {
    html! {
        div.wide {
            table.trials {
                thead {
                    tr {
                        th rowspan="2" { "Method" }
                        th colspan="2" { "Time" }
                        th rowspan="2" { "Rays" }
                        th rowspan="2" { "Texels" }
                        th rowspan="2" { "Memory" }
                        th colspan="3" { "Error" }
                        @if !page.regions.is_empty() {
                            th colspan=(page.regions.len()) { "RMS by region" }
                        }
                    }
                    tr {
                        th { "wall" } th { "processor" }
                        th { "RMS" } th { "99.9 %" } th { "largest" }
                        @for region in &page.regions { th { (region.name) } }
                    }
                }
                tbody {
                    @for &k in rows { (row(&page.trials[k], front.contains(&k))) }
                }
            }
        }
    }
}

fn row(trial: &Trial, on_front: bool) -> Markup {
    let (cost, whole) = (&trial.cost, &trial.whole);
    html! {
        tr.front[on_front] {
            td { (super::set(&trial.method.name())) }
            td { (seconds(cost.wall)) }
            td { (seconds(cost.cpu)) }
            td { (thousands(cost.rays)) }
            td { (thousands(cost.texels)) }
            td { (bytes(cost.peak_bytes as u64)) }
            td { (error(whole.rmse)) }
            td { (error(whole.p999)) }
            td { (error(whole.max)) }
            @for own in &trial.by_region { td { (error(own.rmse)) } }
        }
    }
}

/// Formats a count as M, k or in full, whichever suits its size.
fn thousands(count: u64) -> String {
    let value = count as f64;
    match value {
        v if v >= 9.95e6 => format!("{:.0} M", v / 1e6),
        v if v >= 0.9995e6 => format!("{:.1} M", v / 1e6),
        v if v >= 1e3 => format!("{:.0} k", v / 1e3),
        v => format!("{v:.0}"),
    }
}
