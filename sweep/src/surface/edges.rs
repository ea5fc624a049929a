//! Edges that deformations make: where their derivative jumps, at the ends of their span and at keys of their laws.
//!
//! Such an edge is a level of height on the deformation's axis. If all points of a row have one height, the level
//! is a row of the surface; if all points of a column have one height, the level is a column. A stop there keeps
//! the edge out of the cells. Any other level runs across the cells, and no cells are fine enough for it.
//!
//! The heights are sampled along some columns and some rows, and a crossing is found by bisection.

use crate::curve::cut::Stop;
use crate::surface::Surface;
use crate::surface::profile::Column;
use crate::surface::shape::Shape;

/// Rows and columns along which heights are compared.
const LINES: usize = 24;

/// Samples along each of them. A finer surface may hide a crossing between two samples.
const SAMPLES: usize = 256;

/// Crossings of two lines that differ by less than this fraction of the length are one row or one column.
const ONE: f64 = 1e-9;

/// Heights that differ by less than this fraction of the span are equal.
const LEVEL: f64 = 1e-12;

/// Bisections of a crossing, one for each binary digit.
const STEPS: usize = 60;

/// The edges of all deformations of a surface.
#[derive(Debug, Clone, Default)]
pub struct Edges {
    /// `v` of the rows that are edges, rising.
    pub(crate) rows: Vec<f64>,
    /// `u` of the columns that are edges, rising.
    pub(crate) cols: Vec<f64>,
    /// Deformations with an edge across the cells: the index, and the height of the first such edge.
    pub(crate) across: Vec<(usize, f64)>,
}

impl Edges {
    /// Finds the edges of a surface.
    pub(crate) fn of(shape: &Shape) -> Self {
        let mut edges = Self::default();
        if shape.deforms.is_empty() {
            return edges;
        }
        let part = |i: usize, count: usize| (i as f64 + 0.5) / count as f64;
        let ends = |breaks: &[f64]| -> Vec<f64> {
            let evenly = (0..=SAMPLES).map(|i| i as f64 / SAMPLES as f64);
            let mut ends: Vec<f64> = evenly.chain(breaks.iter().copied()).collect();
            ends.sort_by(f64::total_cmp);
            ends
        };
        let (vs, us) = (ends(&shape.row_breaks()), ends(shape.contour.breaks()));
        let at_u = |u: f64| shape.columns(&[Stop::after(u)]).remove(0);
        let columns: Vec<Column> = (0..LINES).map(|i| at_u(part(i, LINES))).collect();
        for (index, deform) in shape.deforms.iter().enumerate() {
            for (height, wide) in deform.edges() {
                let off = |v: f64, column: &Column| {
                    let point = shape.before_deform(&shape.section(Stop::after(v)), column, index);
                    deform.height(point) - height
                };
                let found: Vec<Vec<f64>> =
                    columns.iter().map(|column| crossings(&vs, wide, |v| off(v, column))).collect();
                if alike(&found) && !found[0].is_empty() {
                    edges.rows.extend(&found[0]);
                    continue;
                }
                let along = |i: usize| {
                    let v = part(i, LINES);
                    crossings(&us, wide, |u| off(v, &at_u(u)))
                };
                let found: Vec<Vec<f64>> = (0..LINES).map(along).collect();
                if alike(&found) {
                    edges.cols.extend(&found[0]);
                } else if edges.across.last().is_none_or(|last| last.0 != index) {
                    edges.across.push((index, height));
                }
            }
        }
        for positions in [&mut edges.rows, &mut edges.cols] {
            positions.sort_by(f64::total_cmp);
            positions.dedup_by(|later, earlier| *later - *earlier < ONE);
        }
        edges
    }
}

/// Returns where a function changes its sign, by its values at rising positions. Where it only touches 0 it does not.
fn crossings(positions: &[f64], wide: f64, of: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut found = Vec::new();
    let mut last: Option<(f64, f64)> = None;
    for &at in positions {
        let value = of(at);
        if value.abs() <= LEVEL * wide {
            continue;
        }
        if let Some((before, sign)) = last
            && (sign > 0.0) != (value > 0.0)
        {
            let (mut low, mut high) = (before, at);
            for _ in 0..STEPS {
                let middle = 0.5 * (low + high);
                if (of(middle) > 0.0) == (sign > 0.0) { low = middle } else { high = middle }
            }
            found.push(high);
        }
        last = Some((at, value));
    }
    found
}

/// Returns whether all lines are crossed at the same positions.
fn alike(lines: &[Vec<f64>]) -> bool {
    lines.iter().all(|line| {
        line.len() == lines[0].len() && line.iter().zip(&lines[0]).all(|(a, b)| (a - b).abs() < ONE)
    })
}
