//! Findings of `--check` about specs with a fault, and about specs that are just free of faults.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use files::json::Document;
use fixtures::program;
use serde_json::{Value, json};
use std::path::Path;
use std::process::Output;
use sweep::Object;
use sweep::check::{self, Finding, Severity};
use sweep::sampling::Survey;
use sweep::spec::Resolution;

fn read(document: &Document<'_>) -> Result<Object, sweep::SweepError> {
    Object::read(document, Path::new(""), &files::Disk, &Resolution::default())
}

/// Returns the text of a ring's spec with these keys.
fn ring(keys: &Value) -> String {
    let mut spec = json!({
        "format": "tb-sweep", "version": 1, "name": "ring", "contour": {"circle": 1},
        "trajectory": {"circle": {"radius": 3}}, "mesh": {"rows": 48, "cols": 24}
    });
    for (key, value) in keys.as_object().unwrap() {
        spec[key] = value.clone();
    }
    spec.to_string()
}

fn found(keys: &Value) -> Vec<Finding> {
    let text = ring(keys);
    let document = Document::new("ring.json", text.as_bytes()).unwrap();
    let object = read(&document).unwrap_or_else(|error| panic!("{error}"));
    check::check(&object, &object.grids().unwrap(), Some(&|_, _| {}))
}

/// Returns the only finding about a spec.
fn only(keys: &Value) -> Finding {
    let mut found = found(keys);
    assert_eq!(found.len(), 1, "{keys}: {found:?}");
    found.remove(0)
}

/// Asserts that there is one finding, with this severity, path and text.
fn says(keys: &Value, severity: Severity, path: &str, words: &str) {
    let finding = only(keys);
    assert_eq!((finding.severity, finding.path.as_str()), (severity, path), "{finding}");
    assert!(finding.message.contains(words), "{finding}");
}

fn nothing(keys: &Value) {
    assert_eq!(found(keys), [], "{keys}");
}

fn survey(keys: &Value) -> Survey {
    let text = ring(keys);
    let object = read(&Document::new("ring.json", text.as_bytes()).unwrap()).unwrap();
    object.parts()[0].survey().clone()
}

fn radius(radius: f64) -> Value {
    json!({"trajectory": {"circle": {"radius": radius}}})
}

#[test]
fn a_torus_folds_when_its_tube_is_wider_than_its_ring() {
    let folded = survey(&radius(0.999));
    assert_eq!(folded.folded_rows(), 48);
    // 1 - k.q is 1 - 1 / 0.999 on the inner circle; a tube of the ring's radius just fits.
    assert!((folded.worst().unwrap() - (1.0 - 1.0 / 0.999)).abs() < 1e-12);
    assert!((folded.fits().unwrap() - 0.999).abs() < 1e-12);
    let finding = only_fold(&radius(0.999));
    assert!(finding.message.contains("in 48 rows, where the trajectory bends"), "{finding}");
    assert!(finding.message.contains("up to 0.999 times"), "{finding}");
    assert!(finding.message.ends_with("(rows 0 to 47, v 0 to 0.9792)"), "{finding}");
    let open = survey(&radius(1.001));
    assert_eq!(open.folded_rows(), 0);
    assert!((open.fits().unwrap() - 1.001).abs() < 1e-12);
    nothing(&radius(1.001));
    let touching = found(&radius(1.0));
    assert!(touching[0].message.contains("touches itself"), "{touching:?}");
    assert_eq!(touching[0].severity, Severity::Hint);
}

/// Returns the fold among the findings about a folded surface.
fn only_fold(keys: &Value) -> Finding {
    let all = found(keys);
    let wrong: Vec<_> = all.iter().filter(|one| one.severity == Severity::Wrong).collect();
    assert_eq!(wrong.len(), 1, "{all:?}");
    wrong[0].clone()
}

#[test]
fn scale_twist_and_relief_count_in_what_passes() {
    // The tube is 2 wide where the scale is greatest, in a ring of radius 1.5: 1 / (2 / 1.5).
    let laws = json!({
        "trajectory": {"circle": {"radius": 1.5}},
        "scale": {"keys": [[0, 1], [0.5, 2], [1, 1]], "ease": "smooth"}
    });
    assert!((survey(&laws).fits().unwrap() - 0.75).abs() < 1e-9);
    // A segment that points outward at the start and toward the axis halfway, between two rows.
    let blade = json!({
        "contour": {"svg": "M0 0H1"}, "trajectory": {"circle": {"radius": 0.9}},
        "twist": {"total": 360}, "mesh": {"rows": 47, "cols": 4}
    });
    assert!((survey(&blade).fits().unwrap() - 0.9).abs() < 1e-9);
    let relief = json!({
        "trajectory": {"circle": {"radius": 1.5}},
        "depth": {"mode": "factor", "terms": [{"amp": 0.25, "u": 0, "v": 0, "phase_deg": 90}]}
    });
    assert!((survey(&relief).fits().unwrap() - 1.5 / 1.25).abs() < 1e-12);
}

#[test]
fn a_relief_deeper_than_the_contour_is_round_folds() {
    let grooves = |amp: f64| {
        json!({
            "contour": {"bezier": {"closed": true, "segments": [
                [[1, 0], [1, 2], [-1, 2], [-1, 0]], [[-1, 0], [-1, -2], [1, -2], [1, 0]]]}},
            "trajectory": {"line": [[0, 0, 0], [0, 3, 0]]}, "mesh": {"rows": 4, "cols": 96},
            "depth": {"mode": "offset", "terms": [{"amp": -amp, "u": 0, "v": 0, "phase_deg": 90}]}
        })
    };
    // Radius of curvature at the ends of the long axis: speed^2 / |acceleration across|.
    let all = found(&grooves(0.9));
    assert!(
        all.iter().any(|one| one.path == "depth" && one.severity == Severity::Wrong),
        "{all:?}"
    );
    nothing(&grooves(0.1));
}

#[test]
fn rows_on_both_sides_of_a_tight_bend_cross() {
    // A straight piece, a quarter of a small circle, and a straight piece; the rows are far from
    // the bend.
    let k = 0.552_284_749_8;
    let bend = |r: f64, rows: usize| {
        let c = r * (1.0 - k);
        json!({
            "contour": {"circle": 0.5}, "mesh": {"rows": rows, "cols": 24},
            "trajectory": {"bezier": {"segments": [
                [[-3, 0, 0], [-2, 0, 0], [-1, 0, 0], [-r, 0, 0]],
                [[-r, 0, 0], [-c, 0, 0], [0, c, 0], [0, r, 0]],
                [[0, r, 0], [0, 1, 0], [0, 2, 0], [0, 3, 0]]]}}
        })
    };
    let tight = found(&bend(0.05, 29));
    let wrong: Vec<_> = tight.iter().filter(|one| one.severity == Severity::Wrong).collect();
    assert!(
        wrong.iter().any(|one| one.message.contains("crosses the next one")
            || one.message.contains("rows cross")),
        "{tight:?}"
    );
    nothing(&bend(0.6, 60));
}

#[test]
fn strands_that_meet_are_a_remark() {
    let eight = |height: f64| {
        json!({
            "contour": {"circle": 0.2}, "mesh": {"rows": 90, "cols": 12},
            "trajectory": {"free": {"closed": true, "points": [
                [0, 0, -height], [2, 1, 0], [3, 0, 0], [2, -1, 0], [0, 0, height],
                [-2, 1, 0], [-3, 0, 0], [-2, -1, 0]]}}
        })
    };
    says(&eight(0.0), Severity::Remark, "trajectory", "the surface meets itself");
    // Strands 0.5 apart have tubes 0.1 apart.
    nothing(&eight(0.25));
}

#[test]
fn a_picture_over_a_mirrored_seam_is_a_remark() {
    let band =
        json!({"contour": {"svg": "M-0.5 0H0.5"}, "twist": {"total": 180}, "seam": "mirror"});
    says(&band, Severity::Remark, "seam", "symmetric about u = 0.5");
    nothing(&json!({"contour": {"svg": "M-0.5 0H0.5"}, "twist": {"total": 360}}));
}

#[test]
fn counts_that_were_made_even_are_told() {
    let klein = |cols: usize| {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/curves/klein-bottle.json");
        let mut spec: Value = serde_json::from_slice(&std::fs::read(folder).unwrap()).unwrap();
        spec["mesh"]["cols"] = cols.into();
        spec["areas"] = json!([]);
        let all = found(&spec);
        all.into_iter().filter(|one| one.path == "mesh.cols").collect::<Vec<_>>()
    };
    assert_eq!(klein(70), []);
    let odd = klein(69);
    assert_eq!(odd.len(), 1);
    assert!(odd[0].message.starts_with("found 69, made "), "{}", odd[0]);
    assert_eq!(odd[0].severity, Severity::Remark);
}

#[test]
fn cells_too_coarse_for_what_they_show_are_told_with_a_number_that_does() {
    let rows = |rows: usize| json!({"mesh": {"rows": rows, "cols": 24}});
    says(&rows(5), Severity::Hint, "mesh.rows", "by 72 degrees from one row to the next at v 0");
    says(&rows(5), Severity::Hint, "mesh.rows", "6 rows would");
    nothing(&rows(6));
    let cols = |cols: usize| json!({"mesh": {"rows": 48, "cols": cols}});
    says(&cols(4), Severity::Hint, "mesh.cols", "by 90 degrees from one column to the next at u 0");
    nothing(&cols(6));
    let twist = |rows: usize| {
        json!({"trajectory": {"line": [[0, 0, 0], [0, 9, 0]]}, "twist": {"total": 36000},
            "mesh": {"rows": rows, "cols": 24}})
    };
    says(&twist(100), Severity::Hint, "twist", "600 rows would");
    nothing(&twist(600));
    let waves = |cols: usize| {
        json!({"mesh": {"rows": 48, "cols": cols},
            "depth": {"mode": "factor", "terms": [{"amp": 0.01, "u": 16, "v": 0}]}})
    };
    says(&waves(63), Severity::Hint, "depth.terms[0].u", "64 cols would");
    nothing(&waves(64));
}

#[test]
fn curves_are_looked_at_as_they_were_drawn() {
    let line = json!({"line": [[0, 0, 0], [0, 3, 0]]});
    let polyline = |closed: bool, points: Value| json!({"contour": {"polyline": {"closed": closed, "points": points}}, "trajectory": line});
    let square = json!([[0, 0], [1, 0], [1, 1], [0, 1]]);
    nothing(&polyline(true, square.clone()));
    says(
        &polyline(true, json!([[0, 0], [0, 1], [1, 1], [1, 0]])),
        Severity::Remark,
        "contour",
        "clockwise",
    );
    says(
        &polyline(true, json!([[0, 0], [1, 0], [1, 0], [1, 1], [0, 1], [0, 0]])),
        Severity::Remark,
        "contour.polyline.points",
        "2 points given twice",
    );
    says(
        &polyline(true, json!([[0, 0], [1, 0], [1, 1e-7], [0, 1e-7]])),
        Severity::Hint,
        "contour",
        "encloses an area of only",
    );
    let bow = found(&polyline(true, json!([[0, 0], [2, 2], [2, 0], [0, 2]])));
    assert!(bow[0].message.contains("crosses itself once, first at (1, 1)"), "{bow:?}");
    says(
        &polyline(false, json!([[0, 0], [1, 0], [1, 1], [0.0009, 0]])),
        Severity::Hint,
        "contour",
        "should the curve be closed?",
    );
    nothing(&polyline(false, json!([[0, 0], [1, 0], [1, 1], [0.01, 0]])));
    let bezier = |gap: f64| {
        json!({"trajectory": line, "contour": {"bezier": {"segments": [
            [[0, 0], [1, 0], [2, 1], [3, 3]], [[3.0 + gap, 3], [4, 5], [5, 6], [6, 6]]]}}})
    };
    says(&bezier(1e-7), Severity::Remark, "contour.bezier.segments", "the widest of 1.00e-7");
    nothing(&bezier(0.0));
    let arc = |angle: f64| json!({"trajectory": {"circle": {"radius": 3, "angle_deg": angle}}});
    says(&arc(359.9), Severity::Hint, "trajectory", "should the curve be closed?");
    nothing(&arc(350.0));
}

#[test]
fn what_f32_loses_is_told_far_from_the_origin() {
    // Half a step of f32 between 2^15 and 2^16 is at most 2^-9, on a ring 11 across.
    let away = |x: f64| json!({"position": [x, 0, 0]});
    says(&away(60000.0), Severity::Hint, "position", "1e-4 of the size");
    nothing(&away(6000.0));
}

#[test]
fn a_part_of_an_object_is_named_by_its_path() {
    let part = |name: &str, radius: f64| {
        json!({"name": name, "contour": {"circle": 1}, "mesh": {"rows": 48, "cols": 24},
            "trajectory": {"circle": {"radius": radius}}})
    };
    let text = json!({"format": "tb-sweep", "version": 1, "name": "two",
        "parts": [part("a", 3.0), part("b", 0.5)]})
    .to_string();
    let run = run(&["--check"], &text);
    assert_eq!(run.status.code(), Some(4));
    let words = String::from_utf8(run.stdout).unwrap();
    let lines: Vec<&str> = words.lines().collect();
    assert!(lines[0].starts_with("two: watertight, 2 bodies with volumes of "), "{words}");
    assert!(lines[1].starts_with("a: 48 x 24 cells (rows x cols), closed in both directions, no"));
    assert!(lines[3].starts_with("wrong: parts[1].trajectory: "), "{words}");
}

/// Runs the program with a text on its standard input.
fn run(arguments: &[&str], text: &str) -> Output {
    let program = env!("CARGO_BIN_EXE_sweep");
    program::run(program.as_ref(), arguments, Path::new("."), text.as_bytes())
}

#[test]
fn the_program_ends_with_4_only_when_something_is_wrong() {
    let good = run(&["--check"], &ring(&json!({})));
    assert_eq!(good.status.code(), Some(0));
    let words = String::from_utf8(good.stdout).unwrap();
    let (first, rest) = words.split_once('\n').unwrap();
    assert!(first.starts_with("ring: watertight, volume "), "{first}");
    assert_eq!(
        rest,
        "ring: 48 x 24 cells (rows x cols), closed in both directions, no folds (least stretch \
         0.6667)\n"
    );
    assert!(good.stderr.is_empty());
    let hint = run(&["--check"], &ring(&json!({"mesh": {"rows": 5, "cols": 24}})));
    assert_eq!(hint.status.code(), Some(0));
    assert!(String::from_utf8(hint.stdout).unwrap().contains("\nhint: mesh.rows: "));
    let wrong = run(&["--check"], &ring(&radius(0.5)));
    assert_eq!(wrong.status.code(), Some(4));
    assert!(String::from_utf8(wrong.stdout).unwrap().contains("\nwrong: trajectory: "));
    assert_eq!(
        String::from_utf8(wrong.stderr).unwrap(),
        "sweep: <stdin>: number of findings marked `wrong`: 1\n"
    );
    let malformed = run(&["--check"], "{");
    assert_eq!(malformed.status.code(), Some(3));
    assert!(malformed.stdout.is_empty());
    let crowded = run(&["--check", "-o", "-", "--format", "json"], &ring(&json!({})));
    assert_eq!(crowded.status.code(), Some(2));
}

#[test]
fn with_an_output_the_grid_is_written_too() {
    let folder = tempfile::tempdir().unwrap();
    let grid = folder.path().join("ring.grid");
    let run_with = |more: &[&str]| {
        let arguments = [&["-o", grid.to_str().unwrap()], more].concat();
        run(&arguments, &ring(&json!({})))
    };
    assert_eq!(run_with(&["--check"]).status.code(), Some(0));
    let checked = std::fs::read(&grid).unwrap();
    assert_eq!(run_with(&[]).status.code(), Some(0));
    assert_eq!(std::fs::read(&grid).unwrap(), checked);
}
