//! Reliefs that the cells are too coarse for, or that a scale changes.

use super::{Finding, Severity, short};
use crate::sampling::Sweep;

/// Smallest number of cells that shows a wave of a relief.
const CELLS_A_WAVE: f64 = 4.0;

/// Number of cells that shows a texel of a picture of heights: its splines bend once in a texel.
const CELLS_A_TEXEL: f64 = 1.0;

/// Smallest number of cells for each texel. With fewer, a light and a dark texel share a cell.
const LEAST: f64 = 0.5;

/// Scales that differ from 1 by less than this leave a relief as it is.
const SAME: f64 = 1e-6;

/// Returns findings about waves and texels that rows and columns sample too coarsely.
pub(super) fn coarse(sweep: &Sweep) -> Vec<Finding> {
    let mut found = waves(sweep);
    found.extend(texels(sweep));
    found
}

fn waves(sweep: &Sweep) -> Vec<Finding> {
    let terms =
        sweep.shape.modulation.depth.iter().flat_map(|depth| depth.terms.iter().enumerate());
    let mut found = Vec::new();
    for (i, term) in terms {
        for (key, count, made, what) in
            [("u", term.u, sweep.cols(), "cols"), ("v", term.v, sweep.rows(), "rows")]
        {
            let each = made as f64 / count.abs();
            if each < CELLS_A_WAVE {
                let message = format!(
                    "{} waves on {made} {what} have {} cells per wave: {} {what} would have \
                     {CELLS_A_WAVE}",
                    short(count.abs()),
                    short(each),
                    (CELLS_A_WAVE * count.abs()).ceil()
                );
                let path = format!("depth.terms[{i}].{key}");
                found.push(Finding::new(Severity::Hint, &path, message));
            }
        }
    }
    found
}

fn texels(sweep: &Sweep) -> Option<Finding> {
    let depth = sweep.shape.modulation.depth.as_ref()?;
    let [u, v] = depth.heights.as_ref()?.texels();
    // A relief that covers a part of the contour needs its columns there.
    let u = u / depth.cover.as_ref().map_or(1.0, |cover| cover.part());
    let (rows, cols) = (sweep.rows() as f64, sweep.cols() as f64);
    let enough = |texels: f64| (CELLS_A_TEXEL * texels).ceil();
    let message = format!(
        "the picture has {} x {} texels on {rows} x {cols} cells (rows x cols), so that the cells hide its details: \
         {} rows and {} cols would show every texel",
        short(v),
        short(u),
        rows.max(enough(v)),
        cols.max(enough(u))
    );
    (rows < LEAST * v || cols < LEAST * u)
        .then(|| Finding::new(Severity::Hint, "depth.image", message))
}

/// Returns a remark if a scale makes the relief higher or lower than its numbers.
pub(super) fn scaled(sweep: &Sweep) -> Option<Finding> {
    let modulation = &sweep.shape.modulation;
    let depth = modulation.depth.as_ref()?;
    let [x, y] = modulation.scale.as_ref()?;
    let size = |(low, high): (f64, f64)| (low.abs().min(high.abs()), low.abs().max(high.abs()));
    let (x, y) = (size(x.range()), size(y.range()));
    let (low, high) = (x.0.min(y.0), x.1.max(y.1));
    let most = depth.most();
    let message = format!(
        "the scale acts on the contour with its relief, so that heights of {} become {} to {} on the surface",
        short(most),
        short(low * most),
        short(high * most)
    );
    let same = (low - 1.0).abs() < SAME && (high - 1.0).abs() < SAME;
    (!same).then(|| Finding::new(Severity::Remark, "depth", message))
}
