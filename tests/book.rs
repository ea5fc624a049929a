//! The picture book, and figures selected by their numbers.

use crate::support;

use pipeline::book::{Entry, Plate};
use pipeline::{pages, run as jobs};
use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;
use support::run;

/// Makes a book with these arguments in a temporary folder and returns its text.
fn book(arguments: &[&str]) -> String {
    let folder = tempfile::tempdir().expect("there is room for a folder");
    let ran = run("pipeline", &[&["book", "-o", "out"], arguments].concat(), folder.path());
    assert!(ran.status.success(), "{}", support::said(&ran));
    assert!(ran.stdout.is_empty(), "words go to standard error");
    let files = fs::read_dir(folder.path().join("out")).expect("the folder is there");
    assert_eq!(files.count(), 1, "the book is one file");
    fs::read_to_string(folder.path().join("out/book.html")).expect("the book is there")
}

/// Returns the values of an attribute.
fn values<'a>(text: &'a str, attribute: &str) -> Vec<&'a str> {
    let start = format!(" {attribute}=\"");
    let parts = text.split(start.as_str()).skip(1);
    parts.map(|part| part.split_once('"').map_or(part, |(value, _)| value)).collect()
}

#[test]
fn the_book_refers_to_nothing_outside() {
    let text = book(&["glass-sphere", "vase", "--size", "96x80", "--truth", "2"]);
    assert!(text.starts_with("<!DOCTYPE html>"));
    for outside in ["http:", "https:", "<script", "<link", "@import", "url(", "srcset"] {
        assert!(!text.contains(outside), "{outside}");
    }
    let pictures = values(&text, "src");
    assert!(pictures.iter().all(|source| source.starts_with("data:image/png;base64,")));
    // Each page has one picture in the contents, four modes, and details of four modes and a
    // truth.
    assert_eq!(pictures.len(), (1 + 4 + 3 * 5) + (1 + 4 + 2 * 5));
    let ids = values(&text, "id");
    assert_eq!(ids.len(), ids.iter().collect::<BTreeSet<_>>().len());
    for link in values(&text, "href") {
        assert!(ids.contains(&link.strip_prefix('#').unwrap()), "{link}");
    }
    for said in [
        "pipeline run A.11 --size 96x80",
        "examples/scenes/glass-sphere.json",
        "examples/curves/vase.json",
        "38,160 triangles",
        "50 min",
    ] {
        assert!(text.contains(said), "{said}");
    }
}

#[test]
fn pictures_and_errors_of_the_book_are_the_same_on_one_thread_and_on_three() {
    let made = |threads: &str| {
        let text = book(&["A.10", "horn", "--size", "90x90", "--truth", "2", "--threads", threads]);
        let pictures: Vec<String> = values(&text, "src").into_iter().map(String::from).collect();
        let errors: Vec<String> = text
            .split("<span class=\"error\">")
            .skip(1)
            .map(|part| part.split_once('<').unwrap().0.into())
            .collect();
        assert!(errors.len() >= 3 * 4 + 3);
        (pictures, errors)
    };
    assert!(made("1") == made("3"));
}

#[test]
fn every_figure_that_has_a_page_is_in_the_book_once_and_in_order() {
    let jobs: Vec<_> =
        pages::in_order().unwrap().into_iter().filter(|job| !job.figures().is_empty()).collect();
    // Figures requested in reverse order come in the thesis's order.
    let names: Vec<&str> = jobs.iter().rev().map(|job| job.name.as_str()).collect();
    let text = book(&[&names[..], &["--size", "24x24", "--truth", "0"]].concat());
    let mut at = 0;
    for figure in jobs.iter().flat_map(pipeline::Job::figures) {
        let command = format!("pipeline run A.{figure} --size 24x24\n");
        assert_eq!(text.matches(&command).count(), 1, "A.{figure}");
        let here = text.find(&command).unwrap();
        assert!(here > at, "A.{figure} comes too early");
        at = here;
    }
    assert!(at > 0);
    assert!(!text.contains("class=\"truth\""), "none was asked for");
}

#[test]
fn a_figure_by_its_number_is_the_mode_of_its_page() {
    let folder = tempfile::tempdir().unwrap();
    let make = |names: &[&str], out: &str| {
        let ran = run(
            "pipeline",
            &[&["run", "-o", out, "--size", "64x48"], names].concat(),
            folder.path(),
        );
        assert!(ran.status.success(), "{}", support::said(&ran));
        let folder = fs::read_dir(folder.path().join(out)).unwrap();
        let mut files: Vec<(PathBuf, Vec<u8>)> = folder
            .map(|file| file.unwrap().path())
            .map(|path| (path.file_name().unwrap().into(), fs::read(&path).unwrap()))
            .collect();
        files.sort();
        files
    };
    for job in pages::in_order().unwrap().iter().filter(|job| !job.figures().is_empty()) {
        // A page that is named once and alone has a picture of a requested error too.
        let whole = make(&[&job.name, &job.name], &format!("whole-{}", job.name));
        let mut figures: Vec<String> = Vec::new();
        for mode in job.modes.iter().filter(|mode| mode.figure.is_some()) {
            let figure = mode.figure.clone().unwrap();
            let alone = make(&[&figure], &figure);
            let name = PathBuf::from(format!("{}-{}.png", job.name, mode.name));
            assert_eq!(alone.len(), 1, "{figure}");
            assert_eq!(alone[0].0, name);
            assert!(whole.contains(&alone[0]), "{figure} differs from its page");
            figures.push(figure);
        }
        // A figure beside its own page adds nothing.
        let both = make(&[&figures[0], &job.name], &format!("both-{}", job.name));
        assert!(both == whole, "{}", job.name);
        // Some figures of a page give no strip; all of them do.
        let figures: Vec<&str> = figures.iter().map(String::as_str).collect();
        let parts = make(&figures, &format!("parts-{}", job.name)).len();
        let strip = usize::from(figures.len() == job.modes.len() && figures.len() > 1);
        assert_eq!(parts, figures.len() + strip, "{}", job.name);
    }
}

/// Where a pixel spans more than two texels along both axes, the mean over its texels is nearer to
/// the truth than a single texel.
#[test]
fn prefiltered_details_are_nearer_to_the_truth_than_point_sampled_ones() {
    let options =
        jobs::Options { folder: PathBuf::new(), size: (256, 256), keep: false, clobber: false };
    let mut judged = 0;
    for name in ["glass-sphere", "vase"] {
        let (job, path) = (pages::page(name).unwrap(), pages::path(name));
        let entry = Entry { job: &job, path: &path, source: &pages::FILES, argument: name };
        let plate = Plate::make(&entry, &options, 4).unwrap();
        let whole: Vec<f64> = plate.shots.iter().map(|shot| shot.error.unwrap()).collect();
        assert!(whole[1] < 0.8 * whole[0] && whole[2] < whole[1], "{name}: {whole:?}");
        // One ray for most pixels: exact averages, and edges that are split.
        assert!(whole[3] < 0.5 * whole[1], "{name}: {whole:?}");
        for detail in &plate.details {
            let seen = detail.judged.as_ref().unwrap();
            if let [point, prefiltered, ..] = seen.wide_errors[..] {
                let title = &detail.title;
                assert!(prefiltered < point, "{name}, {title}: {prefiltered} and {point}");
                judged += usize::from(seen.wide > 0.1);
            }
        }
    }
    assert!(judged >= 3, "too few details have wide footprints: {judged}");
}

#[test]
fn what_is_wrong_is_said_in_one_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let inside = |name: &str| folder.path().join(name);
    fs::write(inside("file"), "").unwrap();
    fs::create_dir(inside("there")).unwrap();
    fs::write(inside("there/book.html"), "old").unwrap();
    fs::write(inside("bad.json"), "{\"format\": \"tb-job\",\n \"version\": 2}").unwrap();
    let scene = "{\"format\": \"tb-job\", \"version\": 1, \"scene\": \"none.json\"}";
    fs::write(inside("lost.json"), scene).unwrap();
    let cases: [(&[&str], i32, &str); 9] = [
        (&["run", "A.99"], 2, "there is no figure A.99; there are A.1"),
        (&["book", "A.12"], 2, "there is no figure A.12; there are "),
        (&["book", "vaze"], 2, "did you mean vase?"),
        (&["book", "vase", "--truth", "257"], 2, "257 is not in 0..=256"),
        (&["book", "vase", "--size", "0x1"], 2, "expected WIDTHxHEIGHT"),
        (&["book", "bad.json"], 3, "bad.json:2:"),
        (&["book", "lost.json"], 5, "cannot read none.json"),
        (&["book", "vase", "-o", "file"], 5, "cannot write file"),
        (&["book", "vase", "-o", "there", "--no-clobber"], 5, "book.html exists"),
    ];
    for (arguments, code, said) in cases {
        let ran = run("pipeline", arguments, folder.path());
        let words = support::said(&ran);
        assert_eq!(ran.status.code(), Some(code), "{arguments:?}: {words}");
        assert!(words.contains(said), "{arguments:?}: {words}");
        if code != 2 {
            assert_eq!(words.trim_end().lines().count(), 1, "{words}");
        }
    }
    assert_eq!(fs::read_to_string(inside("there/book.html")).unwrap(), "old");
}

#[test]
fn a_job_of_ones_own_is_in_the_book() {
    let examples = support::root().join("examples/pages/horn.json");
    let text = book(&[examples.to_str().unwrap(), "--size", "40x30", "--truth", "0"]);
    assert!(text.contains(&format!("pipeline run {} --size 40x30", examples.display())));
    assert!(text.contains("A horn"));
}

#[test]
fn the_list_has_figures_first_and_each_page_once() {
    let ran = run("pipeline", &["list"], &support::root());
    let text = String::from_utf8(ran.stdout).unwrap();
    let names: Vec<&str> =
        text.lines().map(|line| line.split_whitespace().next().unwrap()).collect();
    let mut sorted = names.clone();
    sorted.sort_unstable();
    assert_eq!(sorted, pages::names());
    let figures = text.lines().take_while(|line| line.contains("A.")).count();
    let expected = pages::in_order().unwrap();
    assert_eq!(figures, expected.iter().filter(|job| !job.figures().is_empty()).count());
    assert!(text.contains("A.10, A.11  A glass sphere"), "{text}");
}
