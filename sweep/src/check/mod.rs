//! The check: findings about a spec and its surface, as sentences.
//!
//! | module         | checks                                                             |
//! |----------------|--------------------------------------------------------------------|
//! | [`fold`]       | where the surface folds back on itself                             |
//! | [`measures`]   | volume, area and size of an object; whether it is watertight       |
//! | [`merging`]    | closed meshes that other programs break by merging vertices         |
//! | [`neighbors`]  | rows that cross the next row                                       |
//! | [`patches`]    | a tree over the triangles of a surface, for [`strands`]            |
//! | [`placing`]    | contours far from their origin, profiles drawn downward, frames that spin |
//! | `relief`       | reliefs finer than the cells, and reliefs that a scale changes     |
//! | [`resolution`] | numbers of cells that were raised, and cells that are too coarse   |
//! | [`chain`]      | crossings of a chain of straight pieces, for [`drawing`]           |
//! | [`drawing`]    | curves as they were drawn: doubled points, crossings, near misses  |
//! | [`rounding`]   | rounding of coordinates to f32                                     |
//! | [`strands`]    | parts of the surface that meet far from each other                 |
//! | [`vessel`]     | walls of vessels that cross themselves                             |
//! | [`wall`]       | walls that are thicker than the radius of curvature                |
//!
//! A finding states a number to act on, and its JSON path in the spec.

pub mod chain;
pub mod drawing;
pub mod fold;
pub mod measures;
pub mod merging;
pub mod neighbors;
pub mod patches;
pub mod placing;
mod relief;
pub mod resolution;
pub mod rounding;
pub mod strands;
pub mod vessel;
pub mod wall;

use crate::curve::cut::Stop;
use crate::grid::{GridMesh, Seam};
use crate::sampling::Object;
use crate::sampling::Sweep;
use crate::sampling::resolution::{Resolution, Tolerance};
use glam::DVec3;

pub(crate) use files::check::short;
pub use files::check::{Finding, Severity};

/// Returns all findings about an object, part by part and the worst first.
///
/// `grids` are the grids of the object. With `strands` the check also looks for parts of a surface that meet far
/// from each other, which takes longest, and reports its progress.
#[must_use]
pub fn check(
    object: &Object,
    grids: &[GridMesh],
    strands: Option<strands::Tell<'_>>,
) -> Vec<Finding> {
    let mut all: Vec<Finding> = Vec::new();
    let mut before = None;
    for (i, (sweep, grid)) in object.parts().iter().zip(grids).enumerate() {
        let (spec, owner) = object.spec_of(i);
        // An outline and its holes are drawn in one spec.
        let index = object.owners[i];
        let mut found = Vec::new();
        let first = before != Some(index);
        if first {
            let rest = object.owners[i..].iter().take_while(|owner| **owner == index).count();
            found.extend(drawing::findings(spec, sweep));
            found.extend(vessel::findings(spec, &object.parts()[i..i + rest]));
        }
        before = Some(index);
        found.extend(placing::findings(spec, sweep, first));
        found.extend(of_sweep(sweep, grid));
        if let Some(tell) = strands {
            found.extend(strands::findings(grid, tell));
        }
        found.sort_by_key(|finding| std::cmp::Reverse(finding.severity));
        if let Some(owner) = owner {
            found
                .iter_mut()
                .for_each(|finding| finding.path = format!("parts[{owner}].{}", finding.path));
        }
        // An outline and its holes have the same findings; one of each is kept.
        found.retain(|finding| !all.contains(finding));
        all.extend(found);
    }
    all.extend(measures::Measures::of(object, grids).findings(object.unit()));
    all
}

/// Returns the findings about a sweep and its grid that need no spec.
#[must_use]
pub fn of_sweep(sweep: &Sweep, grid: &GridMesh) -> Vec<Finding> {
    let survey = sweep.survey();
    let mut found = survey.findings();
    found.extend(neighbors::findings(sweep, survey));
    found.extend(wall::findings(sweep, grid));
    found.extend(resolution::findings(sweep));
    found.extend(rounding::findings(grid));
    found.extend(merging::findings(grid));
    found.extend(relief::scaled(sweep));
    found.extend(edges(sweep));
    found.extend(over_the_seam(sweep));
    found
}

/// Returns one line about a sweep: its cells, how it closes, and its least stretch or its folds.
#[must_use]
pub fn summary(sweep: &Sweep, grid: &GridMesh) -> String {
    let around = match (grid.seam_u.joins(), grid.seam_v) {
        (false, Seam::Open) if sweep.lids == [true; 2] => "closed at both ends",
        (false, Seam::Open) => "open",
        (true, Seam::Open) => {
            match poles(grid) + sweep.lids.iter().chain(&grid.pressed).filter(|&&lid| lid).count() {
                0 => "a tube with two ends",
                1 => "a tube with one end",
                _ => "closed at both ends",
            }
        }
        (false, Seam::Closed) => "closed along the trajectory",
        (true, Seam::Closed) => "closed in both directions",
        (_, Seam::Mirror) => "closed with inside and outside exchanged",
    };
    let [made_rows, made_cols] = grid.cells();
    let survey = sweep.survey();
    let folds = match (survey.folded_rows(), survey.worst()) {
        (0, Some(worst)) if worst < 1.0 => format!("no folds (least stretch {})", short(worst)),
        (0, _) => "no folds".into(),
        (1, _) => "folds in 1 row".into(),
        (rows, _) => format!("folds in {rows} rows"),
    };
    format!("{}: {made_rows} x {made_cols} cells (rows x cols), {around}, {folds}", sweep.name())
}

/// Returns a hint for each deformation whose edge runs across the cells, where no cells are fine enough.
fn edges(sweep: &Sweep) -> Vec<Finding> {
    let angle =
        matches!(sweep.resolution(), Resolution::Tolerance(Tolerance { angle: Some(_), .. }));
    let hint = |&(index, height): &(usize, f64)| {
        let message = format!(
            "the surface has an edge at the height {} of the axis, which runs across the cells, and no cells there \
             keep an angle; a law with `\"ease\": \"smooth\"` has no edge",
            short(height)
        );
        Finding::new(Severity::Hint, format!("deform[{index}]"), message)
    };
    sweep.shape.edges.across.iter().filter(|_| angle).map(hint).collect()
}

/// Returns how many of the first and the last row are contracted to a point.
fn poles(grid: &GridMesh) -> usize {
    let cols = grid.cols();
    let ends = [grid.positions.chunks(cols).next(), grid.positions.chunks(cols).next_back()];
    let point = |row: &&[DVec3]| row.iter().all(|p| *p == row[0]);
    ends.iter().flatten().filter(|row| point(row)).count()
}

/// Returns a remark about a mirrored seam, which continues a picture as its mirror image.
fn over_the_seam(sweep: &Sweep) -> Option<Finding> {
    // The picture of a wall runs around twice and joins.
    let sheet = sweep.shape.closing.filter(|_| sweep.wall.is_none());
    let closing = sheet.filter(|closing| closing.mirrored)?;
    let middle = 0.5 * closing.offset.0 as f64 / closing.offset.1 as f64;
    Some(Finding::new(
        Severity::Remark,
        "seam",
        format!(
            "a picture joins over the mirrored seam only if it is symmetric about u = {}",
            short(middle)
        ),
    ))
}

/// Describes the rows for which `is` is true, as ranges with their `v`.
fn ranges(rows: &[Stop], is: &[bool]) -> String {
    const MOST: usize = 4;
    let mut ranges: Vec<[usize; 2]> = Vec::new();
    for row in (0..rows.len()).filter(|&row| is[row]) {
        match ranges.last_mut() {
            Some(last) if last[1] + 1 == row => last[1] = row,
            _ => ranges.push([row, row]),
        }
    }
    let words = ranges.iter().take(MOST).map(|&[from, to]| {
        let v = |row: usize| short(rows[row].at);
        if from == to {
            format!("row {from} at v {}", v(from))
        } else {
            format!("rows {from} to {to}, v {} to {}", v(from), v(to))
        }
    });
    let more = ranges.len().saturating_sub(MOST);
    let more = (more > 0).then(|| format!("{more} more ranges"));
    words.chain(more).collect::<Vec<_>>().join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_told_in_ranges() {
        let rows: Vec<Stop> = (0..5).map(|i| Stop::after(f64::from(i) / 4.0)).collect();
        let is = [true, false, true, true, false];
        assert_eq!(ranges(&rows, &is), "row 0 at v 0; rows 2 to 3, v 0.5 to 0.75");
    }
}
