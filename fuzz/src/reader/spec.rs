//! Reads specs, and the paths and pictures in them.

use super::grid;
use crate::seeds::memory_files::MemoryFiles;
use crate::seeds::{CURVES, small};
use crate::verdict::{Stop, Tried, hold, refused, wording_fault};
use files::Source;
use files::json::Document;
use serde_json::json;
use sweep::spec::Resolution;
use sweep::{GridMesh, Object, Sweep, check, preview};

/// Largest number of cells of a spec that is swept.
const MOST_CELLS: usize = 20_000;

/// Largest number of cells among which touching strands are searched.
const MOST_STRANDS: usize = 1000;

/// The path of the tried SVG file.
const DRAWING: &str = "examples/curves/tried.svg";

/// The path of the tried table.
const TABLE: &str = "examples/curves/tried.csv";

/// The path of the tried tree of neurites.
const TREE: &str = "examples/curves/tried.swc";

/// The path of the tried picture of depths.
const PICTURE: &str = "examples/textures/tried.png";

/// Reads a spec, sweeps it and checks the grid.
///
/// # Errors
/// When the spec is refused, or its surface is wrong.
pub fn read(bytes: &[u8], source: &dyn Source) -> Tried {
    let document = Document::new("spec.json", bytes).map_err(refused)?;
    if small::asks_for_much(bytes) {
        return Ok(());
    }
    let object = Object::read(&document, CURVES.as_ref(), source, &Resolution::default())
        .map_err(refused)?;
    let of = |sweep: &Sweep| sweep.rows().saturating_mul(sweep.cols());
    let cells = object.parts().iter().map(of).fold(0, usize::saturating_add);
    if cells > MOST_CELLS {
        return Ok(());
    }
    let grids = object.grids().map_err(refused)?;
    grids.iter().try_for_each(sound)?;
    let findings = check::check(&object, &grids, (cells < MOST_STRANDS).then_some(&|_, _| {}));
    let parts = object.parts().iter().zip(&grids).map(|(part, grid)| check::summary(part, grid));
    parts.chain(findings.iter().map(ToString::to_string)).try_for_each(check_line)?;
    let page = preview::svg(&object, &grids, &findings);
    let bad = |c: char| c.is_control() && c != '\n';
    hold(!page.contains(bad), "the preview holds a control character")?;
    // A name or a finding may be "NaN" as well: only the tags hold coordinates.
    let tags = page.split('<').filter_map(|part| part.split_once('>')).map(|(tag, _)| tag);
    let infinite = |tag: &str| tag.contains("NaN") || tag.contains("inf\"");
    hold(!tags.into_iter().any(infinite), "the preview holds no number")?;
    grid::follow(&grids)
}

/// Reads an SVG path as a contour and as a flat trajectory.
///
/// # Errors
/// See [`read`].
pub fn read_path(path: &[u8], source: &dyn Source) -> Tried {
    let path = String::from_utf8_lossy(path);
    let head = |contour: serde_json::Value, trajectory: serde_json::Value| {
        json!({"format": "tb-sweep", "version": 1, "name": "path", "contour": contour,
            "trajectory": trajectory, "mesh": {"rows": 12, "cols": 24}})
    };
    let line = json!({"line": [[0, 0, 0], [0, 3, 0]]});
    let flat = json!({"flat": {"curve": {"svg": path}}});
    let contour = read(head(json!({"svg": path}), line).to_string().as_bytes(), source);
    let trajectory = read(head(json!({"circle": 0.01}), flat).to_string().as_bytes(), source);
    match (contour, trajectory) {
        (Err(Stop::Broken(what)), _) | (_, Err(Stop::Broken(what))) => Err(Stop::Broken(what)),
        (Ok(()), _) | (_, Ok(())) => Ok(()),
        (refusal, _) => refusal,
    }
}

/// Reads an SVG file that a spec names, as a contour with and without a unit.
///
/// # Errors
/// See [`read`].
pub fn read_drawing(drawing: &[u8], stored: &MemoryFiles) -> Tried {
    let files = stored.with(DRAWING, drawing);
    let mut spec = json!({"format": "tb-sweep", "version": 1, "name": "bar",
        "contour": {"svg": {"file": "tried.svg"}, "center": true},
        "trajectory": {"line": [[0, 0, 0], [0, 3, 0]]}, "mesh": {"rows": 3, "cols": 24}});
    read(spec.to_string().as_bytes(), &files)?;
    spec["unit"] = json!("mm");
    spec["contour"]["svg"]["id"] = json!("a");
    read(spec.to_string().as_bytes(), &files)
}

/// Reads a table of points that a spec names, as a polyline and as a fitted curve.
///
/// # Errors
/// See [`read`].
pub fn read_table(table: &[u8], stored: &MemoryFiles) -> Tried {
    let files = stored.with(TABLE, table);
    let csv = json!({"file": "tried.csv", "columns": [1, 2, 3], "radius": 4});
    let spec = |trajectory: serde_json::Value| {
        json!({"format": "tb-sweep", "version": 1, "name": "track", "contour": {"circle": 0.1},
            "trajectory": trajectory, "mesh": {"rows": 24, "cols": 6}})
    };
    let polyline = json!({"polyline": {"csv": csv, "corners": {"round": 0.2}}});
    read(spec(polyline).to_string().as_bytes(), &files)?;
    let fitted = json!({"free": {"csv": csv, "fit": 0.1}});
    read(spec(fitted).to_string().as_bytes(), &files)
}

/// Reads a tree of neurites that a spec names.
///
/// # Errors
/// See [`read`].
pub fn read_neurites(tree: &[u8], stored: &MemoryFiles) -> Tried {
    let spec = json!({"format": "tb-sweep", "version": 1, "name": "cell", "contour": {"circle": 1},
        "trajectory": {"swc": {"file": "tried.swc"}}, "mesh": {"rows": 16, "cols": 6}});
    read(spec.to_string().as_bytes(), &stored.with(TREE, tree))
}

/// Reads a picture of depths that a spec names.
///
/// # Errors
/// See [`read`].
pub fn read_depths(picture: &[u8], stored: &MemoryFiles) -> Tried {
    let spec = json!({"format": "tb-sweep", "version": 1, "name": "relief",
        "contour": {"circle": 0.6}, "trajectory": {"line": [[0, 0, 0], [0, 2, 0]]},
        "depth": {"mode": "factor", "image": {"file": "../textures/tried.png", "amp": 0.06,
            "repeat": [3, 2], "zero": 0}},
        "mesh": {"rows": 12, "cols": 12}});
    read(spec.to_string().as_bytes(), &stored.with(PICTURE, picture))
}

/// Checks what is true of every grid.
fn sound(grid: &GridMesh) -> Tried {
    hold(grid.positions.iter().all(|point| point.is_finite()), "a point is not finite")?;
    let unit = |normal: &glam::Vec3| (normal.length() - 1.0).abs() < 1e-5;
    hold(grid.normals.iter().all(unit), "a normal is not of unit length")?;
    let rises = |values: &[f64]| values.windows(2).all(|pair| pair[0] <= pair[1]);
    hold(rises(&grid.u) && rises(&grid.v), "u or v falls")
}

/// Checks that a line of `--check`, as the programs print it, is a valid message.
pub fn check_line(line: String) -> Tried {
    let line = files::words::line(&line).to_string();
    match wording_fault(&line) {
        Some(_) => Err(Stop::Refused(line)),
        None => Ok(()),
    }
}
