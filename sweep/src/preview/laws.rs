//! The panel of the laws along the trajectory, as small graphs over `v`.

use super::page::{Anchor, Area, Page, Pen, ink};
use crate::check::short;
use crate::law::Law;
use crate::sampling::Sweep;
use glam::DVec2;

/// Number of intervals of a graph.
const PLACES: usize = 160;

/// Largest number of graphs drawn.
const MOST: usize = 3;

/// A graph: its name, and for each curve the values at all positions and the colour.
struct Graph {
    name: String,
    curves: Vec<(Vec<f64>, &'static str)>,
}

/// Returns whether there is any law to draw.
pub fn any(parts: &[Sweep]) -> bool {
    !graphs(parts).is_empty()
}

pub fn draw(page: &mut Page, area: Area, parts: &[Sweep]) {
    let graphs = graphs(parts);
    let shown = graphs.len().min(MOST);
    let more = graphs.len() - shown;
    let note = if more > 0 { format!("and {more} more") } else { "over v".into() };
    page.panel(area, "Laws", &note);
    let width = (area.width - 28.0) / shown as f64;
    for (i, graph) in graphs.iter().take(MOST).enumerate() {
        let panel = Area::new(area.x + 14.0 + width * i as f64, area.y, width, area.height);
        one(page, panel.inside(6.0, 58.0, 34.0), graph);
    }
}

fn graphs(parts: &[Sweep]) -> Vec<Graph> {
    let of = |law: &Law| positions().map(|v| law.at(v).0).collect::<Vec<f64>>();
    let mut graphs = Vec::new();
    for sweep in parts {
        let mut add = |what: &str, curves| {
            let several = parts.len() > 1;
            let name = if several { format!("{} {what}", sweep.name()) } else { what.into() };
            graphs.push(Graph { name, curves });
        };
        if let Some([x, y]) = &sweep.shape.modulation.scale {
            let [x, y] = [of(x), of(y)];
            if x == y {
                add("scale", vec![(x, ink::CURVE)]);
            } else {
                add("scale x, y", vec![(x, ink::W1), (y, ink::W2)]);
            }
        }
        if let Some(twist) = &sweep.shape.modulation.twist {
            add("twist, degrees", vec![(of(twist), ink::CURVE)]);
        }
        if let Some(depth) = &sweep.shape.modulation.depth {
            let height = |v: f64| -> f64 {
                depth.terms.iter().map(|term| (term.amp * term.along.at(v).0).abs()).sum()
            };
            add("depth", vec![(positions().map(height).collect(), ink::CURVE)]);
        }
    }
    graphs
}

fn positions() -> impl Iterator<Item = f64> {
    (0..=PLACES).map(|i| i as f64 / PLACES as f64)
}

fn one(page: &mut Page, area: Area, graph: &Graph) {
    let all = || graph.curves.iter().flat_map(|(values, _)| values).copied();
    // The zero line is always part of the graph.
    let (low, high) = (all().fold(0.0, f64::min), all().fold(0.0, f64::max));
    let (low, high) = if high > low { (low, high) } else { (low - 1.0, high + 1.0) };
    let Area { x, y, width, height } = area;
    let flat = |v: f64, value: f64| {
        DVec2::new(x + v * width, y + height * (1.0 - (value / (high - low) - low / (high - low))))
    };
    page.text(DVec2::new(x, y - 12.0), 11.0, ink::TEXT, Anchor::Start, &graph.name);
    let (top, bottom) =
        (all().fold(f64::NEG_INFINITY, f64::max), all().fold(f64::INFINITY, f64::min));
    for value in [top, bottom] {
        let ends = [flat(0.0, value), flat(1.0, value)];
        page.line(&ends, false, Pen::new(ink::FAINT, 0.8).dashed("2 3"));
    }
    page.line(&[flat(0.0, 0.0), flat(1.0, 0.0)], false, Pen::new(ink::MUTED, 0.9));
    for (values, color) in &graph.curves {
        let points: Vec<DVec2> =
            positions().zip(values).map(|(v, &value)| flat(v, value)).collect();
        page.line(&points, false, Pen::new(color, 1.8));
    }
    let range =
        if top == bottom { short(top) } else { format!("{} to {}", short(bottom), short(top)) };
    page.text(DVec2::new(x, y + height + 20.0), 10.5, ink::MUTED, Anchor::Start, &range);
}
