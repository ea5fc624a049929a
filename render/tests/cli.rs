//! Runs of the program: its output, its files, and its exit codes.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::bench;

use bench::{Bench, MESH_WALL, TEXTURED_WALL, WALL, WALL_OBJ, checks, ending};
use serde_json::Value;
use std::fs;

/// The codes of the wall's colour, `[0.5, 0.125, 0]` linear. `255 (1.055 x^(1/2.4) - 0.055)` gives
/// 187.5 and 98.6; the value for 0.5 lies above the tie.
const SRGB_WALL: [u8; 3] = [188, 99, 0];

/// Returns the pixel of an 8-bit picture, all of whose pixels must be equal.
fn only_pixel(bytes: &[u8], size: (u32, u32)) -> [u8; 3] {
    let picture = image::load_from_memory(bytes).unwrap().to_rgb8();
    assert_eq!(picture.dimensions(), size);
    let first = picture.get_pixel(0, 0);
    assert!(picture.pixels().all(|pixel| pixel == first));
    first.0
}

fn stats(bench: &Bench, arguments: &[&str]) -> Value {
    let arguments =
        [&["scene.json", "--size", "8x8", "-o", "out.png", "--stats=json"], arguments].concat();
    let (code, said) = ending(&bench.run(&arguments, b""));
    assert_eq!(code, Some(0), "{said}");
    serde_json::from_str(&said).unwrap()
}

#[test]
fn a_png_holds_the_encoded_colour_and_an_exr_the_linear_one() {
    let bench = Bench::with_scene(WALL);
    bench.make(&["scene.json", "-o", "wall.png", "--size", "5x3"], b"");
    assert_eq!(only_pixel(&bench.read("wall.png"), (5, 3)), SRGB_WALL);
    bench.make(&["scene.json", "-o", "wall.EXR", "--size", "5x3"], b"");
    let picture = image::load_from_memory(&bench.read("wall.EXR")).unwrap().to_rgb32f();
    assert_eq!(picture.dimensions(), (5, 3));
    assert!(picture.pixels().all(|pixel| pixel.0 == [0.5, 0.125, 0.0]), "exact in f32");
    let names: Vec<String> = bench.names().into_iter().collect();
    assert_eq!(names, ["scene.json", "wall.EXR", "wall.png"], "nothing is left beside them");
}

#[test]
fn gamma_is_asked_for_by_number() {
    let bench = Bench::with_scene(WALL);
    let arguments = ["scene.json", "-o", "wall.png", "--size", "1x1", "--gamma"];
    bench.make(&[&arguments[..], &["1"]].concat(), b"");
    assert_eq!(only_pixel(&bench.read("wall.png"), (1, 1)), [128, 32, 0]);
    bench.make(&[&arguments[..], &["2"]].concat(), b"");
    assert_eq!(only_pixel(&bench.read("wall.png"), (1, 1)), [180, 90, 0], "255 sqrt(x)");
    bench.make(&[&arguments[..], &["SRGB"]].concat(), b"");
    assert_eq!(only_pixel(&bench.read("wall.png"), (1, 1)), SRGB_WALL);
}

#[test]
fn without_a_size_the_picture_is_512_by_512() {
    let bench = Bench::with_scene(WALL);
    bench.make(&["scene.json", "-o", "wall.png", "--filter", "point"], b"");
    assert_eq!(only_pixel(&bench.read("wall.png"), (512, 512)), SRGB_WALL);
}

#[test]
fn a_picture_goes_to_standard_output_and_a_scene_comes_from_standard_input() {
    let bench = Bench::with_scene(WALL);
    bench.make(&["scene.json", "-o", "wall.png", "--size", "4x4"], b"");
    let arguments = ["-", "-o", "-", "--format", "png", "--size", "4x4"];
    let run = bench.make(&arguments, WALL.as_bytes());
    // The files state different names of the scene.
    let pixels = |bytes: &[u8]| image::load_from_memory(bytes).unwrap();
    assert_eq!(pixels(&run.stdout), pixels(&bench.read("wall.png")));
    let run = bench.make(&["scene.json", "-o", "-", "--format", "exr", "--size", "4x4"], b"");
    assert_eq!(image::guess_format(&run.stdout).unwrap(), image::ImageFormat::OpenExr);
}

#[test]
fn a_format_that_is_asked_for_wins_over_the_name() {
    let bench = Bench::with_scene(WALL);
    bench.make(&["scene.json", "-o", "wall.png", "--format", "exr", "--size", "4x4"], b"");
    assert_eq!(image::guess_format(&bench.read("wall.png")).unwrap(), image::ImageFormat::OpenExr);
}

#[test]
fn a_mesh_comes_from_a_file_or_from_standard_input() {
    let bench = Bench::with_scene(MESH_WALL);
    bench.write("wall.obj", WALL_OBJ);
    bench.make(&["scene.json", "--mesh", "wall=wall.obj", "-o", "file.png", "--size", "6x5"], b"");
    assert_eq!(only_pixel(&bench.read("file.png"), (6, 5)), SRGB_WALL);
    let arguments = ["scene.json", "--mesh", "wall=-", "-o", "pipe.png", "--size", "6x5"];
    bench.make(&arguments, WALL_OBJ.as_bytes());
    assert_eq!(bench.read("pipe.png"), bench.read("file.png"));
}

#[test]
fn a_given_mesh_takes_the_place_of_the_scenes_own_file() {
    let text =
        MESH_WALL.replace(r#""name": "wall","#, r#""name": "wall", "file": "meshes/none.obj","#);
    let bench = Bench::with_scene(&text);
    let arguments = ["scene.json", "--mesh", "wall=-", "-o", "wall.png", "--size", "4x4"];
    bench.make(&arguments, WALL_OBJ.as_bytes());
    assert_eq!(only_pixel(&bench.read("wall.png"), (4, 4)), SRGB_WALL);
}

#[test]
fn paths_in_a_scene_count_from_its_folder() {
    let bench = Bench::new();
    fs::create_dir(bench.path("scenes")).unwrap();
    bench.write("scenes/checks.png", checks());
    bench.write("scenes/scene.json", TEXTURED_WALL);
    bench.make(&["scenes/scene.json", "-o", "wall.png", "--size", "4x4"], b"");
}

#[test]
fn any_number_of_threads_gives_the_same_file() {
    let bench = Bench::with_scene(TEXTURED_WALL);
    bench.write("checks.png", checks());
    for (threads, name) in [("1", "one.exr"), ("7", "seven.exr")] {
        let arguments = ["scene.json", "-o", name, "--size", "150x90", "--threads", threads];
        bench.make(&arguments, b"");
    }
    assert_eq!(bench.read("one.exr"), bench.read("seven.exr"));
}

#[test]
fn any_structure_gives_the_same_file() {
    let bench = Bench::with_scene(TEXTURED_WALL);
    bench.write("checks.png", checks());
    for structure in ["bvh", "grid", "none"] {
        let name = format!("{structure}.exr");
        let arguments = ["scene.json", "-o", &name, "--size", "60x50", "--accel", structure];
        bench.make(&arguments, b"");
    }
    assert_eq!(bench.read("grid.exr"), bench.read("bvh.exr"));
    assert_eq!(bench.read("none.exr"), bench.read("bvh.exr"));
}

#[test]
fn only_tables_that_a_surface_shows_are_built() {
    let without = Bench::with_scene(WALL);
    assert_eq!(stats(&without, &[])["tables"], 0);
    let bench = Bench::with_scene(TEXTURED_WALL);
    bench.write("checks.png", checks());
    let filters =
        [("point", 0), ("bilinear", 0), ("mip", 1), ("box", 1), ("tent", 1), ("quadratic", 1)];
    for (filter, tables) in filters {
        let stats = stats(&bench, &["--sampling", "thesis", "--filter", filter]);
        assert_eq!(stats["tables"], tables, "{filter}");
        assert_eq!(stats["table_bytes"].as_u64() > Some(0), tables > 0, "{filter}");
        // Only a filter that averages over areas needs the ring of rays around the picture.
        assert_eq!(stats["primary_rays"], if tables > 0 { 100 } else { 64 }, "{filter}");
    }
}

#[test]
fn a_texture_that_nothing_shows_gets_no_table() {
    // One texture is on no surface. The other is on a surface that reflects neither ambient nor
    // diffuse light.
    let text = TEXTURED_WALL
        .replace(
            r#"{ "image": "checks.png" }"#,
            r#"{ "image": "checks.png" }, "spare": { "image": "checks.png" }"#,
        )
        .replace(r#""diffuse": 0 }"#, r#""ambient": 0, "diffuse": 0, "reflectivity": 1 }"#);
    let bench = Bench::with_scene(&text);
    bench.write("checks.png", checks());
    let stats = stats(&bench, &["--sampling", "thesis", "--filter", "tent"]);
    assert_eq!((&stats["tables"], &stats["texels"]), (&0.into(), &0.into()));
    assert_eq!(stats["primary_rays"], 64, "no ring of rays for tables that are not there");
}

#[test]
fn stats_say_what_the_picture_cost() {
    let bench = Bench::with_scene(WALL);
    let stats = stats(&bench, &["--samples", "3", "--split", "none"]);
    assert_eq!(stats["primary_rays"], 8 * 8 * 9);
    assert_eq!(stats["hits"], 8 * 8 * 9);
    for none in ["reflected_rays", "refracted_rays", "shadow_rays", "not_finite"] {
        assert_eq!(stats[none], 0, "{none}");
    }
    // The wall is the only object, so that there is nothing to search.
    assert_eq!(stats["accel_bytes"], 0);
    for stage in ["read", "accel", "table", "picture", "write"] {
        assert!(stats[format!("{stage}_seconds")].is_f64(), "{stage}");
    }
    let run = bench.run(&["scene.json", "-o", "a.png", "--size", "2x2", "--stats"], b"");
    let (code, said) = ending(&run);
    assert_eq!(code, Some(0));
    assert!(said.contains("primary rays") && said.contains("trace and shade"), "{said}");
}

#[test]
fn bad_flags_end_with_2_and_name_the_flag() {
    let bench = Bench::with_scene(WALL);
    bench.write("out.png", "old");
    for flag in [
        ["--size", "0x4"],
        ["--size", "4"],
        ["--size", "4x"],
        ["--size", "4x-4"],
        ["--size", "4x65537"],
        ["--size", "99999999999999999999x4"],
        ["--samples", "0"],
        ["--samples", "257"],
        ["--samples", "1.5"],
        ["--threads", "0"],
        ["--threads", "many"],
        ["--gamma", "0"],
        ["--gamma", "NaN"],
        ["--gamma", "rec709"],
        ["--filter", "gauss"],
        ["--format", "jpg"],
        ["--accel", "octree"],
        ["--mesh", "wall"],
        ["--mesh", "=wall.obj"],
        ["--mesh", "wall="],
    ] {
        let run = bench.run(&[&["scene.json", "-o", "out.png"], &flag[..]].concat(), b"");
        let (code, said) = ending(&run);
        assert_eq!(code, Some(2), "{flag:?}: {said}");
        assert!(said.starts_with("error: ") && said.contains(flag[0]), "{flag:?}: {said}");
        assert!(!said.contains("panicked"), "{said}");
    }
    for arguments in [&["-o", "out.png"][..], &["scene.json"], &["scene.json", "--colour"]] {
        assert_eq!(bench.run(arguments, b"").status.code(), Some(2), "{arguments:?}");
    }
    assert_eq!(bench.read("out.png"), b"old");
    assert_eq!(bench.names().len(), 2);
}

#[test]
fn help_has_examples_and_names_the_exit_codes() {
    let help = String::from_utf8(Bench::new().make(&["--help"], b"").stdout).unwrap();
    assert!(help.contains("render scene.json -o scene.png"), "{help}");
    assert!(help.contains("141 closed pipe"), "{help}");
}

#[test]
fn an_output_that_cannot_be_ends_with_5_and_is_named() {
    let bench = Bench::with_scene(WALL);
    fs::create_dir(bench.path("folder.png")).unwrap();
    for output in ["no/such/out.png", "folder.png"] {
        let (code, said) = ending(&bench.run(&["scene.json", "-o", output], b""));
        assert_eq!(code, Some(5), "{said}");
        assert!(said.starts_with(&format!("render: cannot write {output}: ")), "{said}");
        assert_eq!(said.lines().count(), 1, "{said}");
    }
    assert_eq!(bench.names().len(), 2, "nothing was made");
}

#[test]
fn no_clobber_refuses_an_existing_picture_and_makes_a_new_one() {
    let bench = Bench::with_scene(WALL);
    bench.refuse(&["scene.json", "--no-clobber"], b"", 5, &["out.png exists", "--no-clobber"]);
    bench.make(&["scene.json", "--no-clobber", "-o", "new.png", "--size", "2x2"], b"");
    assert_eq!(only_pixel(&bench.read("new.png"), (2, 2)), SRGB_WALL);
}

#[test]
fn an_existing_picture_is_replaced() {
    let bench = Bench::with_scene(WALL);
    bench.write("out.png", "old");
    bench.make(&["scene.json", "-o", "out.png", "--size", "2x2"], b"");
    assert_eq!(only_pixel(&bench.read("out.png"), (2, 2)), SRGB_WALL);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_ends_with_5() {
    let bench = Bench::with_scene(WALL);
    let arguments = ["scene.json", "-o", "/dev/full", "--format", "png", "--size", "4x4"];
    let (code, said) = ending(&bench.run(&arguments, b""));
    assert_eq!(code, Some(5));
    assert!(said.starts_with("render: cannot write /dev/full: "), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
}

#[cfg(target_os = "linux")]
#[test]
fn stats_that_cannot_be_printed_do_not_spoil_the_picture() {
    let bench = Bench::with_scene(WALL);
    let full = fs::File::options().write(true).open("/dev/full").unwrap();
    let arguments = ["scene.json", "-o", "wall.png", "--size", "2x2", "--stats"];
    let status = bench.command(&arguments).stderr(full).status().unwrap();
    assert_eq!(status.code(), Some(0));
    assert_eq!(only_pixel(&bench.read("wall.png"), (2, 2)), SRGB_WALL);
}

#[cfg(unix)]
#[test]
fn a_closed_pipe_ends_quietly_with_141() {
    let bench = Bench::with_scene(WALL);
    let mut child = bench.command(&["scene.json", "-o", "-", "--format", "exr"]).spawn().unwrap();
    drop(child.stdout.take());
    assert_eq!(ending(&child.wait_with_output().unwrap()), (Some(141), String::new()));
}
