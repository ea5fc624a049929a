//! The pages after figures A.1 to A.4: the thesis's numbers of triangles, and its statements about
//! three rendering methods.

use crate::support;

use files::json::Document;
use image::RgbImage;
use serde::Deserialize;
use std::fs;
use std::ops::Range;
use std::path::Path;
use support::{root, run, said};

#[derive(Debug, Deserialize)]
struct Report {
    faces: usize,
    materials: Vec<Material>,
}

#[derive(Debug, Deserialize)]
struct Material {
    surface: u32,
    faces: usize,
}

/// Returns the report of `triangulate` on a spec in `examples/curves`, with the spec's resolution.
fn report(curve: &str, folder: &Path) -> Report {
    let spec = root().join("examples/curves").join(curve);
    let swept = run("sweep", &[spec.to_str().expect("the path is UTF-8"), "-o", "a.grid"], folder);
    assert!(swept.status.success(), "{}", said(&swept));
    let arguments = ["-q", "a.grid", "-o", "a.obj", "--report", "a.json"];
    let split = run("triangulate", &arguments, folder);
    assert!(split.status.success(), "{}", said(&split));
    let bytes = fs::read(folder.join("a.json")).expect("the report is there");
    let report = Document::new("a.json", &bytes).and_then(|document| document.parse());
    report.unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn cup_and_vase_have_as_many_triangles_as_in_the_thesis() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(report("bumpy-vase.json", folder.path()).faces, 7200);
    let cup = report("u-cup.json", folder.path());
    assert_eq!(cup.faces, 8400);
    // The cup has 60 x 50 quads and the handle 40 x 30.
    let of = |surface: u32| {
        let materials = cup.materials.iter().filter(|material| material.surface == surface);
        materials.map(|material| material.faces).sum::<usize>()
    };
    assert_eq!((of(0), of(1)), (2 * 60 * 50, 2 * 40 * 30));
}

#[test]
fn bud_and_column_have_about_six_thousand_triangles() {
    let folder = tempfile::tempdir().unwrap();
    let faces =
        ["glass-bud.json", "marble-column.json"].map(|name| report(name, folder.path()).faces);
    let all = faces.iter().sum::<usize>();
    assert!((5850..6150).contains(&all), "{faces:?}");
}

/// A rectangle of a picture: columns and rows as fractions of its width and height.
type Region = (Range<f64>, Range<f64>);

/// Returns the root mean square difference of two pictures within a region, in 8-bit codes.
fn difference(a: &RgbImage, b: &RgbImage, (across, down): &Region) -> f64 {
    let pixels = |range: &Range<f64>, size: u32| {
        (range.start * f64::from(size)) as u32..(range.end * f64::from(size)) as u32
    };
    let (mut sum, mut count) = (0.0, 0.0);
    for y in pixels(down, a.height()) {
        for x in pixels(across, a.width()) {
            for (p, q) in a.get_pixel(x, y).0.into_iter().zip(b.get_pixel(x, y).0) {
                sum += (f64::from(p) - f64::from(q)).powi(2);
                count += 1.0;
            }
        }
    }
    f64::sqrt(sum / count)
}

/// Checks "Note how the staircases disappear in Figure A.4" against 64 rays for each pixel.
#[test]
fn prefiltering_calms_the_tiles_and_supersampling_the_outlines() {
    let folder = tempfile::tempdir().unwrap();
    let examples = root().join("examples");
    let page = fs::read_to_string(examples.join("pages/cup-and-vase.json")).unwrap();
    let job = page.replace("\"../", &format!("\"{}/", examples.display())).replace(
        "\"modes\": [",
        "\"modes\": [{ \"name\": \"truth\", \"filter\": \"bilinear\", \"sampling\": \"thesis\", \"samples\": 8 },",
    );
    fs::write(folder.path().join("still.json"), job).unwrap();
    let ran = run("pipeline", &["run", "still.json", "-q", "--size", "144x144"], folder.path());
    assert!(ran.status.success(), "{}", said(&ran));
    let picture = |mode: &str| {
        let file = folder.path().join(format!("out/still-{mode}.png"));
        image::open(file).unwrap().into_rgb8()
    };
    let truth = picture("truth");
    let errors = ["point", "prefiltered", "supersampled"].map(|mode| {
        let made = picture(mode);
        let far_tiles: Region = (0.6..1.0, 0.34..0.5);
        // The wall behind the lip, a region with a single edge.
        let lip: Region = (0.18..0.5, 0.06..0.13);
        [far_tiles, lip].map(|region| difference(&made, &truth, &region))
    });
    let [[point, _], [prefiltered, stairs], [_, smooth]] = errors;
    assert!(prefiltered < 0.25 * point, "{errors:?}");
    assert!(smooth < 0.65 * stairs, "{errors:?}");
}
