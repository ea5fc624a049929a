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
    let expected = [("ewa16", "none"), ("probes", "none"), ("exact", "none"), ("exact", "0.1")];
    assert_eq!(by_areas, expected);
    let number = |row: &[&str], name: &str| row[column(name)].parse::<f64>().unwrap();
    for row in &rows[1..] {
        assert_eq!(row.len(), rows[0].len());
        assert_eq!((row[column("page")], row[column("width")]), ("glass-sphere", "16"));
        assert!(number(row, "rmse") <= number(row, "max"), "{row:?}");
        // One clock measures a picture and, within it, its tables.
        assert!(number(row, "wall_s") >= number(row, "tables_s"), "{row:?}");
        assert!(number(row, "rays") >= 16.0 * 12.0, "{row:?}");
    }
    // The picture alone takes 12 bytes per pixel. A table is in memory while its picture is made.
    let peak = |filter: &str| {
        number(whole.iter().find(|row| row[column("filter")] == filter).unwrap(), "peak_bytes")
    };
    assert!(peak("point") >= 12.0 * 192.0 && peak("tent") > peak("point") + 1e5);
    assert!(read("report.html").contains("glass-sphere"));
    for file in ["glass-sphere.svg", "filters.csv", "tessellation.csv", "mapping.csv"] {
        assert!(!read(file).is_empty(), "{file}");
    }
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
