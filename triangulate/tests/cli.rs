//! Runs of the program.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use files::json::Document;
use fixtures::program::{run, said};
use glam::{DVec3, Vec3};
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use sweep::grid::file::{Encoding, write};
use sweep::grid::{Seam, UvLayout};
use sweep::{GridMesh, Sweep};

/// Returns the bytes of a bent sheet's grid.
fn sheet(rows: usize, cols: usize) -> Vec<u8> {
    sheet_at(DVec3::ZERO, rows, cols)
}

fn sheet_at(corner: DVec3, rows: usize, cols: usize) -> Vec<u8> {
    let even =
        |count: usize| -> Vec<f64> { (0..count).map(|i| i as f64 / (count - 1) as f64).collect() };
    let (u, v) = (even(cols), even(rows));
    let point = |u: f64, v: f64| corner + DVec3::new(u, v, (u * v).sin());
    let grid = GridMesh {
        name: "sheet".into(),
        seam_u: Seam::Open,
        seam_v: Seam::Open,
        uv: UvLayout::default(),
        positions: v.iter().flat_map(|&v| u.iter().map(move |&u| point(u, v))).collect(),
        normals: vec![Vec3::Z; rows * cols],
        u,
        v,
        ..GridMesh::default()
    };
    let mut bytes = Vec::new();
    write(&grid, Encoding::Binary, &mut bytes).unwrap();
    bytes
}

fn triangulate(arguments: &[&str], input: &[u8], folder: &Path) -> Output {
    run(env!("CARGO_BIN_EXE_triangulate").as_ref(), arguments, folder, input)
}

#[test]
fn a_grid_becomes_an_obj_from_file_to_file_and_through_pipes() {
    let folder = tempfile::tempdir().unwrap();
    let grid = sheet(3, 4);
    fs::write(folder.path().join("sheet.grid"), &grid).unwrap();
    let arguments = ["sheet.grid", "-o", "sheet.obj", "--texture", "2", "--surface", "5"];
    let run = triangulate(&arguments, b"", folder.path());
    assert_eq!((run.status.code(), said(&run).as_str()), (Some(0), ""));
    let obj = fs::read_to_string(folder.path().join("sheet.obj")).unwrap();
    assert!(obj.starts_with("# topobook triangulate OBJ 1\no sheet\nusemtl tex2_surf5\n"));
    assert!(obj.ends_with("\n# end 12 12\n"), "{obj}");
    let piped = triangulate(&["--texture", "2", "--surface", "5"], &grid, folder.path());
    assert_eq!(piped.status.code(), Some(0));
    assert!(piped.stdout == obj.as_bytes());
}

#[test]
fn stats_go_to_standard_error() {
    let folder = tempfile::tempdir().unwrap();
    let run = triangulate(&["-q", "--stats", "-o", "a.obj"], &sheet(3, 4), folder.path());
    assert!(said(&run).starts_with("triangles 12\npositions 12\nnormals 1\n"), "{}", said(&run));
    assert!(run.stdout.is_empty());
}

#[test]
fn an_object_too_far_away_for_its_size_is_noted() {
    let folder = tempfile::tempdir().unwrap();
    for (away, expected) in [
        (1e2, &[][..]),
        (1e5, &["note: <stdin>: the seven digits of an OBJ moved points by up to "]),
        (1e9, &["the mesh has no triangles", "nearer to the origin"]),
    ] {
        let grid = sheet_at(DVec3::splat(away), 3, 4);
        let run = triangulate(&["-o", "a.obj"], &grid, folder.path());
        assert_eq!(run.status.code(), Some(0));
        assert_eq!(said(&run).lines().count(), expected.len(), "{}", said(&run));
        assert!(expected.iter().all(|words| said(&run).contains(words)), "{}", said(&run));
        let quiet = triangulate(&["-q", "-o", "a.obj"], &grid, folder.path());
        assert_eq!((quiet.status.code(), said(&quiet).as_str()), (Some(0), ""));
    }
}

#[test]
fn a_missing_file_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let run = triangulate(&["none.grid"], b"", folder.path());
    assert_eq!(run.status.code(), Some(5));
    assert!(said(&run).starts_with("triangulate: cannot read none.grid: "), "{}", said(&run));
}

#[test]
fn a_cut_grid_leaves_the_old_mesh() {
    let folder = tempfile::tempdir().unwrap();
    let (grid, path) = (sheet(3, 4), folder.path().join("sheet.obj"));
    fs::write(&path, "old").unwrap();
    let run = triangulate(&["-o", "sheet.obj"], &grid[..grid.len() - 20], folder.path());
    assert_eq!(run.status.code(), Some(3));
    assert_eq!(
        said(&run),
        "triangulate: <stdin>: row 3 of 3 is cut short: the program that wrote it stopped early\n"
    );
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "no part file is left");

    let piped = triangulate(&[], &grid[..grid.len() - 1], folder.path());
    assert_eq!(piped.status.code(), Some(3));
    assert!(!String::from_utf8(piped.stdout).unwrap().contains("# end"));
}

#[test]
fn what_is_no_grid_is_called_by_its_name() {
    let folder = tempfile::tempdir().unwrap();
    for (input, expected) in [
        (&b""[..], "<stdin> is empty, expected a grid: the program before the pipe wrote nothing"),
        (b"v 0 0 0\n", "<stdin> is not a grid: it looks like an OBJ mesh"),
        (b"{\"contour\": {}}\n", "if it is a curve spec, `sweep` makes its grid"),
    ] {
        let run = triangulate(&["-q"], input, folder.path());
        assert_eq!(run.status.code(), Some(3));
        assert!(said(&run).contains(expected), "{}", said(&run));
        assert!(run.stdout.is_empty());
    }
}

#[test]
fn bad_use_ends_with_2() {
    let folder = tempfile::tempdir().unwrap();
    for arguments in [&["--textures", "1"][..], &["--texture", "-1"], &["a", "b"]] {
        let run = triangulate(arguments, b"", folder.path());
        assert_eq!(run.status.code(), Some(2), "{}", said(&run));
    }
    let help = triangulate(&["--help"], b"", folder.path());
    assert_eq!(help.status.code(), Some(0));
    assert!(String::from_utf8(help.stdout).unwrap().contains("| triangulate |"));
}

#[test]
fn an_output_that_cannot_be_written_is_told_before_reading() {
    let folder = tempfile::tempdir().unwrap();
    let run = triangulate(&["none.grid", "-o", "no/such/folder/a.obj"], b"", folder.path());
    assert_eq!(run.status.code(), Some(5));
    assert!(said(&run).contains("cannot write no/such/folder/a.obj"), "{}", said(&run));
    fs::write(folder.path().join("a.obj"), "old").unwrap();
    let run = triangulate(&["-o", "a.obj", "--no-clobber"], &sheet(3, 4), folder.path());
    assert_eq!(run.status.code(), Some(5));
    assert!(said(&run).contains("--no-clobber"), "{}", said(&run));
    assert_eq!(fs::read_to_string(folder.path().join("a.obj")).unwrap(), "old");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told() {
    let folder = tempfile::tempdir().unwrap();
    // A mesh small enough to be written only at the end, and one large enough to fail before.
    for rows in [3, 200] {
        let run = triangulate(&["-o", "/dev/full"], &sheet(rows, 50), folder.path());
        assert_eq!(run.status.code(), Some(5));
        assert!(said(&run).starts_with("triangulate: cannot write /dev/full: "), "{}", said(&run));
        for format in ["stl", "ply"] {
            let arguments = ["--format", format, "-o", "/dev/full"];
            let run = triangulate(&arguments, &sheet(rows, 50), folder.path());
            assert_eq!(run.status.code(), Some(5));
            assert!(said(&run).contains("cannot write /dev/full: "), "{}", said(&run));
        }
    }
}

#[cfg(unix)]
#[test]
fn a_closed_pipe_ends_quietly() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.grid"), sheet(200, 100)).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_triangulate"))
        .arg("a.grid")
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let run = child.wait_with_output().unwrap();
    assert_eq!((run.status.code(), said(&run).as_str()), (Some(141), ""));
}

#[test]
fn stl_and_ply_are_chosen_by_flag_or_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let grid = sheet(3, 4);
    // 12 triangles, and 12 vertices: the sheet has no seam.
    for (format, start, end) in [
        ("stl", &b"topobook triangulate STL 1 sheet\0"[..], 80 + 4 + 12 * 50),
        ("ply", b"ply\nformat binary_little_endian 1.0\n", 12 * 32 + 12 * 13),
    ] {
        let file = format!("sheet.{format}");
        let named = triangulate(&["-o", &file], &grid, folder.path());
        assert_eq!((named.status.code(), said(&named).as_str()), (Some(0), ""));
        let named = fs::read(folder.path().join(&file)).unwrap();
        let piped = triangulate(&["--format", format], &grid, folder.path());
        assert_eq!(piped.status.code(), Some(0));
        assert!(piped.stdout == named && named.starts_with(start));
        let header = b"end_header\n";
        let header = named.windows(header.len()).position(|w| w == header).map_or(0, |at| at + 11);
        assert_eq!(named.len() - header, end);

        let cut = triangulate(&["-o", &file], &grid[..grid.len() - 1], folder.path());
        assert_eq!(cut.status.code(), Some(3));
        assert!(fs::read(folder.path().join(&file)).unwrap() == named, "the old file stays");
    }
    let run = triangulate(&["-o", "a.stl", "--format", "obj"], &grid, folder.path());
    assert_eq!(run.status.code(), Some(0));
    assert!(fs::read(folder.path().join("a.stl")).unwrap().starts_with(b"# topobook"));
    let run = triangulate(&["--format", "step"], &grid, folder.path());
    assert_eq!(run.status.code(), Some(2));
    assert!(said(&run).contains("possible values: obj, stl, ply"), "{}", said(&run));
}

#[test]
fn a_material_file_is_written_when_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let (grid, path) = (sheet(3, 4), |name: &str| folder.path().join(name));
    let plain = triangulate(&["--texture", "2"], &grid, folder.path()).stdout;
    let plain = String::from_utf8(plain).unwrap();
    assert!(!plain.contains("mtllib"));

    let arguments = ["--texture", "2", "--mtl", "--map", "marble.png", "-o", "my sheet.obj"];
    let run = triangulate(&arguments, &grid, folder.path());
    assert_eq!((run.status.code(), said(&run).as_str()), (Some(0), ""));
    let obj = fs::read_to_string(path("my sheet.obj")).unwrap();
    let (first, rest) = plain.split_once('\n').unwrap();
    assert_eq!(obj, format!("{first}\nmtllib my_sheet.mtl\n{rest}"));
    let (models, materials) =
        tobj::load_obj(path("my sheet.obj"), &tobj::LoadOptions::default()).unwrap();
    let material = &materials.unwrap()[models[0].mesh.material_id.unwrap()];
    assert_eq!(material.name, "tex2_surf0");
    assert_eq!(material.diffuse_texture.as_deref(), Some("marble.png"));

    // A run that cannot write leaves all files unchanged.
    fs::write(path("my_sheet.mtl"), "old").unwrap();
    fs::remove_file(path("my sheet.obj")).unwrap();
    let run = triangulate(&[&arguments[..], &["--no-clobber"]].concat(), &grid, folder.path());
    assert_eq!(run.status.code(), Some(5));
    assert!(said(&run).contains("my_sheet.mtl"), "{}", said(&run));
    let run = triangulate(&arguments, &grid[..grid.len() - 1], folder.path());
    assert_eq!(run.status.code(), Some(3));
    assert_eq!(fs::read_to_string(path("my_sheet.mtl")).unwrap(), "old");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn a_material_file_needs_an_obj_to_lie_beside() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, expected) in [
        (&["--mtl"][..], "found standard output as the output"),
        (&["--mtl", "-o", "."], "found . as the output"),
        (&["--mtl", "-o", "a.stl"], "--mtl is for OBJ, and the format is STL"),
        (&["--mtl", "-o", "a.mtl"], "the output a.mtl is also the output a.mtl"),
        (&["--map", "a.png", "-o", "a.obj"], "--mtl"),
        (&["--mtl", "--map", "a\nb", "-o", "a.obj"], "which an MTL cannot hold"),
    ] {
        let run = triangulate(arguments, &sheet(3, 4), folder.path());
        assert_eq!(run.status.code(), Some(2), "{}", said(&run));
        assert!(said(&run).contains(expected), "{}", said(&run));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}

#[test]
fn a_report_says_what_the_mesh_is_like_and_changes_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let (grid, read) = (sheet(3, 4), |name: &str| fs::read(folder.path().join(name)).unwrap());
    for format in ["obj", "stl", "ply"] {
        let plain = triangulate(&["--format", format], &grid, folder.path()).stdout;
        let arguments = ["--format", format, "-o", "mesh", "--report", "-"];
        let run = triangulate(&arguments, &grid, folder.path());
        assert_eq!((run.status.code(), said(&run).as_str()), (Some(0), ""));
        assert!(read("mesh") == plain, "{format}");
        let json: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
        for (key, expected) in
            [("vertices", 12), ("edges", 23), ("faces", 12), ("euler", 1), ("boundary_loops", 1)]
        {
            assert_eq!(json[key], expected, "{format}: {key}");
        }
        assert_eq!((&json["manifold"], &json["closed"]), (&true.into(), &false.into()));

        let arguments = ["--format", format, "--report", "report.json"];
        let piped = triangulate(&arguments, &grid, folder.path());
        assert!(piped.stdout == plain && read("report.json") == run.stdout, "{format}");
    }
}

#[test]
fn a_report_goes_where_nothing_else_goes() {
    let folder = tempfile::tempdir().unwrap();
    let grid = sheet(3, 4);
    for (arguments, expected) in [
        (&["--report", "-"][..], "--report - would write into the mesh on standard output"),
        (
            &["-o", "a.obj", "--report", "./a.obj"],
            "the output ./a.obj is also the output a.obj: name another file with --report",
        ),
        (
            &["-o", "a.obj", "--mtl", "--report", "a.mtl"],
            "the output a.mtl is also the output a.mtl: name another file with --report",
        ),
    ] {
        let run = triangulate(arguments, &grid, folder.path());
        assert_eq!((run.status.code(), run.stdout.len()), (Some(2), 0), "{}", said(&run));
        assert!(said(&run).contains(expected), "{}", said(&run));
    }
    let run = triangulate(&["-o", "a.obj", "--report", "no/a.json"], &grid, folder.path());
    assert_eq!(run.status.code(), Some(5));
    assert!(said(&run).contains("cannot write no/a.json"), "{}", said(&run));
    let cut = &grid[..grid.len() - 1];
    let run = triangulate(&["-o", "a.obj", "--report", "-"], cut, folder.path());
    assert_eq!((run.status.code(), run.stdout.len()), (Some(3), 0));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "nothing is left");
}

#[test]
fn rounding_beyond_the_tolerance_of_the_grid_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let spec = |x: f64| {
        format!(
            r#"{{"format": "tb-sweep", "version": 1, "name": "tube", "contour": {{"circle": 1}},
            "trajectory": {{"line": [[0, 0, 0], [0, 0, 4]]}}, "position": [{x}, 0, 0],
            "mesh": {{"tol": 1e-5}}}}"#
        )
    };
    // Doubles distinguish points there that seven digits do not; at 100 seven digits move a point
    // by 4e-6.
    for (x, told) in [(100.0, false), (1000.0, true)] {
        let text = spec(x);
        let sweep = Sweep::read(&Document::new("a", text.as_bytes()).unwrap()).unwrap();
        let mut bytes = Vec::new();
        write(&sweep.grid(), Encoding::Binary, &mut bytes).unwrap();
        let words = said(&triangulate(&["-o", "a.obj"], &bytes, folder.path()));
        assert_eq!(words.contains("times the tolerance"), told, "{words}");
    }
}
