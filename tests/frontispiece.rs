//! The frontispiece: lettering seen through glass and inside it.

use crate::support;

use render::color::Encoding;
use std::fs;
use std::path::Path;
use support::{root, run, said};

/// Crop in which lettering is seen through the foot of the bottle: 48 x 24 pixels of 512 x 512.
const THROUGH_THE_GLASS: &str = "216,378,48x24";

fn example(path: &str) -> String {
    root().join("examples").join(path).to_string_lossy().into_owned()
}

/// Makes the bottle, with a coarser mesh than that of the page.
fn make_bottle(folder: &Path) {
    let spec = example("curves/klein-glass.json");
    let swept = run("sweep", &["-q", &spec, "--tol", "1e-3", "-o", "a.grid"], folder);
    assert!(swept.status.success(), "{}", said(&swept));
    let split = run("triangulate", &["-q", "a.grid", "-o", "a.obj"], folder);
    assert!(split.status.success(), "{}", said(&split));
}

fn render(more: &[&str], folder: &Path) -> Vec<u8> {
    let scene = example("scenes/frontispiece.json");
    let arguments = [&[scene.as_str(), "--mesh", "klein-glass=a.obj"], more].concat();
    let rendered = run("render", &arguments, folder);
    assert!(rendered.status.success(), "{}", said(&rendered));
    rendered.stdout
}

/// Returns the linear light of all channels of all pixels.
fn light(more: &[&str], folder: &Path) -> Vec<f64> {
    let part = ["--size", "512x512", "--crop", THROUGH_THE_GLASS, "-o", "a.png", "-q"];
    render(&[&part, more].concat(), folder);
    let bytes = fs::read(folder.join("a.png")).expect("the picture is there");
    let picture = image::load_from_memory(&bytes).expect("it is a PNG").to_rgb8();
    picture.into_raw().iter().map(|&c| Encoding::Srgb.decode(f64::from(c) / 255.0)).collect()
}

/// Compares with many unfiltered rays for each pixel.
#[test]
fn lettering_through_glass_is_nearer_to_the_truth_when_prefiltered() {
    let folder = tempfile::tempdir().unwrap();
    make_bottle(folder.path());
    let light = |more: &[&str]| light(more, folder.path());
    let thesis = ["--sampling", "thesis", "--filter"];
    let jittered = ["point", "--samples", "8", "--pattern", "jitter", "--seed", "1"];
    let truth = light(&[&thesis[..], &jittered].concat());
    let error = |more: &[&str]| {
        let squares = light(more).into_iter().zip(&truth).map(|(a, b)| (a - b).powi(2));
        (squares.sum::<f64>() / truth.len() as f64).sqrt()
    };
    let [point, prefiltered] =
        ["point", "tent"].map(|name| error(&[&thesis[..], &[name]].concat()));
    let exact = error(&["--sampling", "area", "--filter", "exact"]);
    assert!(point > 0.04, "there are letters: {point}");
    assert!(prefiltered < 0.6 * point, "{prefiltered}, and {point} without a filter");
    assert!(exact < prefiltered, "{exact}, and {prefiltered} by the thesis's method");
}

/// The page has four modes: one without a filter, two with the tent, and one exact.
#[test]
fn the_modes_of_a_page_share_one_structure_and_the_tables_of_each_filter() {
    let folder = tempfile::tempdir().unwrap();
    let run = run(
        "pipeline",
        &[
            "run",
            "frontispiece",
            "--size",
            "16x16",
            "--stats",
            "--mode",
            "point",
            "--mode",
            "prefiltered",
            "--mode",
            "supersampled",
            "--mode",
            "exact",
        ],
        folder.path(),
    );
    assert!(run.status.success(), "{}", said(&run));
    let said = said(&run);
    let built = |what: &str| -> Vec<u64> {
        let counts = said.lines().filter_map(|line| line.strip_prefix(what));
        counts.map(|count| count.trim().parse().expect("a count")).collect()
    };
    assert_eq!(built("structures built"), [1, 0, 0, 0]);
    let [none, some, again, exact] = built("tables built")[..] else {
        panic!("four modes: {said}")
    };
    assert_eq!((none, again), (0, 0));
    // Each filter has a table for each texture.
    assert!(some > 0 && exact == some);
    let bytes = built("table bytes");
    assert_eq!(bytes[1], bytes[2], "the third picture uses the tables of the second");
}

#[test]
fn the_bottle_is_a_closed_volume_of_glass() {
    let folder = tempfile::tempdir().unwrap();
    make_bottle(folder.path());
    let said = String::from_utf8(render(&["--check"], folder.path())).unwrap();
    let bottle = said.lines().find(|line| line.contains("mesh klein-glass")).unwrap();
    assert!(bottle.contains(" closed, volume 1.18"), "{bottle}");
    // The window and the door serve only as reflections, which is no reason for a hint.
    let hints: Vec<&str> = said.lines().filter(|line| line.starts_with("hint")).collect();
    assert_eq!(hints, Vec::<&str>::new());
}
