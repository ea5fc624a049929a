//! `pipeline report` with small sizes and few rounds.

use crate::support;

use std::fs;
use std::path::Path;
use support::{run, said};

#[test]
fn a_page_is_measured_by_every_method_of_a_hasty_report() {
    let folder = tempfile::tempdir().unwrap();
    let ask = ["report", "glass-sphere", "--quick", "--size", "16x12", "-o", "out", "-q"];
    let ran = run("pipeline", &ask, folder.path());
    assert!(ran.status.success(), "{}", said(&ran));
    assert!(ran.stdout.is_empty() && ran.stderr.is_empty(), "{}", said(&ran));
    let read = |name: &str| fs::read_to_string(folder.path().join("out").join(name)).unwrap();
    let report = read("report.csv");
    let rows: Vec<Vec<&str>> = report.lines().map(|line| line.split(',').collect()).collect();
    let column = |name: &str| rows[0].iter().position(|column| *column == name).unwrap();
    let whole: Vec<&Vec<&str>> =
        rows[1..].iter().filter(|row| row[column("region")] == "whole").collect();
    // Six filters, each with three samplings on the thesis's lattice, and four methods by areas.
    assert_eq!(whole.len(), 6 * 3 + 4);
    let by_areas = whole.iter().filter(|row| row[column("sampling")] == "area");
    let by_areas: Vec<_> =
        by_areas.map(|row| (row[column("filter")], row[column("split")])).collect();
    let expected = [("ewa16", ""), ("probes", ""), ("exact", ""), ("exact", "0.1")];
    assert_eq!(by_areas, expected);
    let number = |row: &[&str], name: &str| row[column(name)].parse::<f64>().unwrap();
    for row in &rows[1..] {
        assert_eq!(row.len(), rows[0].len());
        assert_eq!((row[column("page")], row[column("width")]), ("glass-sphere", "16"));
        assert!(number(row, "rmse") <= number(row, "max"), "{row:?}");
        // One clock measures a picture and, within it, its tables.
        assert!(number(row, "wall_s") >= number(row, "once_wall_s"), "{row:?}");
        assert!(number(row, "once_wall_s") >= number(row, "tables_s"), "{row:?}");
        assert!(number(row, "rays_per_pixel") >= 1.0, "{row:?}");
        assert!(number(row, "rays") >= 16.0 * 12.0, "{row:?}");
    }
    // The picture alone takes 12 bytes per pixel. A table is in memory while its picture is made.
    let peak = |filter: &str| {
        number(whole.iter().find(|row| row[column("filter")] == filter).unwrap(), "peak_bytes")
    };
    assert!(peak("point") >= 12.0 * 192.0 && peak("tent") > peak("point") + 1e5);
    assert!(read("report.html").contains("glass-sphere"));
    for file in
        ["glass-sphere.svg", "columns.csv", "filters.csv", "tessellation.csv", "mapping.csv"]
    {
        assert!(!read(file).is_empty(), "{file}");
    }
}

#[test]
fn a_report_of_chosen_methods_against_a_given_truth() {
    let folder = tempfile::tempdir().unwrap();
    let done = |program: &str, words: &[&str]| {
        let ran = run(program, words, folder.path());
        assert!(ran.status.success(), "{}", said(&ran));
    };
    done("pipeline", &["export", "glass-sphere", "-q"]);
    let truth = ["--size", "16x12", "--samples", "8", "--filter", "bilinear", "-o", "truth.exr"];
    let truth = [&truth[..], &["--sampling", "thesis", "-q"]].concat();
    done("render", &[&["glass-sphere/scenes/glass-sphere.json"], &truth[..]].concat());
    let ask = ["report", "glass-sphere", "--methods", "bilinear,exact", "--samples", "1,8"];
    let more = ["--reference", "truth.exr", "--quick", "-o", "out", "-q"];
    done("pipeline", &[&ask[..], &more].concat());
    let report = fs::read_to_string(folder.path().join("out/report.csv")).unwrap();
    let mut rows = csv::Reader::from_reader(report.as_bytes());
    let columns = rows.headers().unwrap().clone();
    let column = |name: &str| columns.iter().position(|column| column == name).unwrap();
    let rows: Vec<csv::StringRecord> = rows.records().map(Result::unwrap).collect();
    let whole = rows.iter().filter(|row| &row[column("region")] == "whole");
    let methods =
        whole.clone().map(|row| ["filter", "sampling", "samples"].map(|name| &row[column(name)]));
    let expected = [
        ["bilinear", "thesis", "1"],
        ["bilinear", "thesis", "8"],
        ["exact", "area", "1"],
        ["exact", "area", "1"],
        ["exact", "area", "8"],
        ["exact", "area", "8"],
    ];
    assert_eq!(methods.collect::<Vec<_>>(), expected);
    // The method that made the truth has no error.
    let errors: Vec<f64> = whole.map(|row| row[column("rmse")].parse().unwrap()).collect();
    assert!(errors[1] == 0.0 && errors[0] > 0.0, "{errors:?}");
    let two =
        run("pipeline", &["report", "vase", "cup", "--reference", "truth.exr"], folder.path());
    assert_eq!(two.status.code(), Some(2));
    assert!(said(&two).contains("found 2 pages, expected one"), "{}", said(&two));
}

#[test]
fn what_cannot_be_measured_is_said_before_anything_is_made() {
    let folder = tempfile::tempdir().unwrap();
    let ask = |arguments: &[&str]| {
        let ran = run("pipeline", &[&["report", "-o", "out"], arguments].concat(), folder.path());
        (ran.status.code().unwrap(), said(&ran))
    };
    for (arguments, code, expected) in [
        (["peer-glas"].as_slice(), 2, "did you mean peer-glass?"),
        (&["none.json"], 5, "none.json"),
        (&["vase", "--size", "0x1"], 2, "WIDTHxHEIGHT"),
        (&["vase", "--truth", "31"], 2, "31"),
        (&["vase", "--max-memory", "1k"], 6, "--max-memory"),
    ] {
        let (found, words) = ask(arguments);
        assert_eq!(found, code, "{words}");
        assert!(words.contains(expected), "{words}");
    }
    let same = support::root().join("examples/pages/peer-glass.json");
    let (code, words) = ask(&["peer-glass", same.to_str().unwrap()]);
    assert!(code == 2 && words.contains("would both write peer-glass.svg"), "{words}");
    fs::create_dir_all(folder.path().join("out")).unwrap();
    fs::write(folder.path().join("out/report.html"), "mine").unwrap();
    let (code, words) = ask(&["peer-glass", "--no-clobber"]);
    assert_eq!(code, 5, "{words}");
    assert_eq!(fs::read_to_string(folder.path().join("out/report.html")).unwrap(), "mine");
    assert!(!Path::new(&folder.path().join("out/report.csv")).exists());
}

/// Numbers and plots of all pans; the squares of the parts of each error add up.
#[test]
fn flicker_is_measured_in_each_pan() {
    let folder = tempfile::tempdir().unwrap();
    let ask = ["report", "--flicker", "--quick", "--size", "12x8", "-o", "out", "-q"];
    let ran = run("pipeline", &ask, folder.path());
    assert!(ran.status.success() && ran.stderr.is_empty(), "{}", said(&ran));
    let path = |name: &str| folder.path().join("out").join(name);
    let mut rows = csv::Reader::from_path(path("flicker.csv")).unwrap();
    let columns = rows.headers().unwrap().clone();
    let column = |name: &str| columns.iter().position(|column| column == name).unwrap();
    let mut pans: Vec<String> = Vec::new();
    for row in rows.records().map(Result::unwrap) {
        let number = |name: &str| row[column(name)].parse::<f64>().unwrap();
        let square = |name: &str| number(name).powi(2);
        // A part that noise hides counts as the smallest that can be measured.
        if number("changing") > 1.01 * number("changing_least") {
            let sum = square("steady") + square("changing");
            assert!((square("error") - sum).abs() < 0.01 * sum + 1e-6, "{row:?}");
        }
        pans.push(row[0].into());
    }
    pans.dedup();
    assert_eq!(pans, ["direct", "mirror", "glass"]);
    for pan in pans {
        assert!(path(&format!("flicker-{pan}.svg")).exists(), "{pan}");
    }
    assert!(path("flicker-columns.csv").exists());
    let ran = run("pipeline", &["report", "vase", "--flicker"], folder.path());
    assert_eq!(ran.status.code(), Some(2));
}
