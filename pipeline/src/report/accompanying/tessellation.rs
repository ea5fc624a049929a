//! Measures the quads and the time that the modeler needs for a given distance to the surface.

use crate::PipelineError;
use crate::pages;
use crate::report::measured::Table;
use files::Source;
use files::json::Document;
use std::path::Path;
use std::time::Instant;
use sweep::Sweep;
use sweep::resolution::{Distance, Reached, Tolerance};

/// Names of built-in shapes of about unit size.
const SHAPES: [&str; 3] = ["trefoil", "fluted-vase", "horn"];

/// Tolerances, as distances to the surface; a quick report takes only the first.
const ASKED: [f64; 3] = [1e-2, 3e-3, 1e-3];

/// Measures cells placed where the surface bends, and even cells. The even cells have the same
/// proportion of rows to columns, and are the fewest that keep the same tolerance.
///
/// # Errors
/// When a shape cannot be swept. This should not happen, since the shapes are built in.
pub fn measure(quick: bool) -> Result<Table, PipelineError> {
    let asked = if quick { &ASKED[..1] } else { &ASKED[..] };
    let mut rows = Vec::new();
    for shape in SHAPES {
        let path = format!("examples/curves/{shape}.json");
        let text = pages::FILES.read(Path::new(&path))?;
        let sweep = Sweep::read(&Document::new(&path, &text)?)?;
        for &asked in asked {
            let distance = Some(Distance::Everywhere(asked));
            let tolerance = Tolerance { distance, angle: None, max_quads: 2_000_000 };
            let started = Instant::now();
            let placed = sweep.clone().with_tolerance(tolerance.clone())?;
            let search = started.elapsed().as_secs_f64();
            rows.push(row(shape, "where it bends", asked, &placed, &tolerance, Some(search)));
            let even = even(&sweep, &tolerance, [placed.rows(), placed.cols()])?;
            rows.push(row(shape, "even", asked, &even, &tolerance, None));
        }
    }
    let columns = [
        "shape",
        "cells",
        "tolerance",
        "reached",
        "rows",
        "columns",
        "quads",
        "grid s",
        "search s",
    ];
    Ok(Table {
        name: "cells",
        title: "Cells where the surface bends, against even cells".into(),
        about: "The largest distance to the surface that was asked and reached, and the quads and seconds it \
                took, measured here. Even cells stand in the proportion of the placed ones; the table of the \
                best proportion is below."
            .into(),
        command: None,
        columns: columns.map(String::from).into(),
        rows,
        drawing: None,
    })
}

fn row(
    shape: &str,
    cells: &str,
    asked: f64,
    sweep: &Sweep,
    tolerance: &Tolerance,
    search: Option<f64>,
) -> Vec<String> {
    let started = Instant::now();
    let grid = sweep.grid();
    let seconds = started.elapsed().as_secs_f64();
    drop(grid);
    let reached: Reached = sweep.reached().unwrap_or_else(|| sweep.measure(tolerance));
    vec![
        shape.into(),
        cells.into(),
        format!("{asked:.0e}"),
        format!("{:.2e}", reached.tol),
        sweep.rows().to_string(),
        sweep.cols().to_string(),
        reached.quads.to_string(),
        format!("{seconds:.5}"),
        search.map_or(String::new(), |search| format!("{search:.4}")),
    ]
}

/// Returns a sweep with even cells that keeps a tolerance, with nearly the fewest rows and columns in
/// the proportion `near`.
fn even(sweep: &Sweep, tolerance: &Tolerance, near: [usize; 2]) -> Result<Sweep, PipelineError> {
    let fewest = [sweep.trajectory().fewest_cells(), sweep.contour().fewest_cells()];
    let cut = |scale: f64| -> Result<Sweep, PipelineError> {
        let [rows, cols] =
            [0, 1].map(|k| ((near[k] as f64 * scale).ceil() as usize).max(fewest[k]));
        Ok(sweep.clone().with_resolution(Some(rows), Some(cols))?)
    };
    let (mut low, mut high) = (0.5, 1.0);
    while high < 64.0 && !cut(high)?.measure(tolerance).kept {
        low = high;
        high *= 2.0;
    }
    while high / low > 1.01 {
        let middle = 0.5 * (low + high);
        *(if cut(middle)?.measure(tolerance).kept { &mut high } else { &mut low }) = middle;
    }
    cut(high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_keep_the_tolerance_and_placed_cells_are_fewer() {
        let table = measure(true).unwrap();
        for pair in table.rows.chunks(2) {
            let [placed, even] = [&pair[0], &pair[1]].map(|row| {
                let number = |k: usize| row[k].parse::<f64>().unwrap();
                // Numbers in the table are rounded to three digits.
                assert!(number(3) <= 1.005 * number(2), "{row:?}");
                number(6)
            });
            assert!(placed <= even, "{pair:?}");
        }
    }
}
