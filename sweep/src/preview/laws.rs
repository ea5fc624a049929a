//! What changes along the trajectory, as small graphs over `v`.

use super::page::{Anchor, Area, Page, Pen, ink};
use crate::Sweep;
use crate::check::short;
use crate::law::Law;
use glam::DVec2;

/// Places on a graph.
const PLACES: usize = 160;

/// Graphs that are drawn.
const MOST: usize = 3;

/// A graph: its name, and the curves on it with their colours.
struct Graph<'a> {
    name: String,
    curves: Vec<(Box<dyn Fn(f64) -> f64 + 'a>, &'static str)>,
}

/// Whether there is anything to draw.
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
        let place = Area::new(area.x + 14.0 + width * i as f64, area.y, width, area.height);
        one(page, place.inside(6.0, 58.0, 34.0), graph);
    }
}

fn graphs(parts: &[Sweep]) -> Vec<Graph<'_>> {
    let mut graphs = Vec::new();
    for sweep in parts {
        let name = |what: &str| {
            if parts.len() > 1 { format!("{} {what}", sweep.name()) } else { what.into() }
        };
        let of = |law: &'_ Law| {
            let law = law.clone();
            move |v: f64| law.at(v).0
        };
        if let Some([x, y]) = &sweep.modulation.scale {
            let alike = (0..=PLACES).map(at).all(|v| x.at(v).0 == y.at(v).0);
            let mut graph = Graph { name: name("scale"), curves: Vec::new() };
            graph.curves.push((Box::new(of(x)), if alike { ink::CURVE } else { ink::W1 }));
            if !alike {
                graph.name = name("scale x, y");
                graph.curves.push((Box::new(of(y)), ink::W2));
            }
            graphs.push(graph);
        }
        if let Some(twist) = &sweep.modulation.twist {
            let curves: Vec<(Box<dyn Fn(f64) -> f64>, _)> = vec![(Box::new(of(twist)), ink::CURVE)];
            graphs.push(Graph { name: name("twist, degrees"), curves });
        }
        if let Some(depth) = &sweep.modulation.depth {
            let height = |v: f64| -> f64 {
                depth.terms.iter().map(|term| (term.amp * term.along.at(v).0).abs()).sum()
            };
            let curves: Vec<(Box<dyn Fn(f64) -> f64>, _)> = vec![(Box::new(height), ink::CURVE)];
            graphs.push(Graph { name: name("depth"), curves });
        }
    }
    graphs
}

fn at(i: usize) -> f64 {
    i as f64 / PLACES as f64
}

fn one(page: &mut Page, area: Area, graph: &Graph<'_>) {
    let values: Vec<Vec<f64>> = graph
        .curves
        .iter()
        .map(|(curve, _)| (0..=PLACES).map(|i| curve(at(i))).collect())
        .collect();
    let all = || values.iter().flatten().copied();
    // The line of 0 is the floor of what is near it.
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
    for (values, (_, color)) in values.iter().zip(&graph.curves) {
        let points: Vec<DVec2> =
            values.iter().enumerate().map(|(i, &value)| flat(at(i), value)).collect();
        page.line(&points, false, Pen::new(color, 1.8));
    }
    let range =
        if top == bottom { short(top) } else { format!("{} to {}", short(bottom), short(top)) };
    page.text(DVec2::new(x, y + height + 20.0), 10.5, ink::MUTED, Anchor::Start, &range);
}
