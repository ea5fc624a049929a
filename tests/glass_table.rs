//! The page after figures A.8 and A.9 shows what the thesis states about them.

use crate::support;

use image::RgbImage;
use render::color::Encoding;
use std::ops::Range;
use std::path::Path;
use support::{run, said};

/// Size of the pictures whose pixels are examined.
const SIZE: &str = "192x192";

/// Size of pictures of which only the meshes matter.
const SMALL: &str = "16x16";

/// Makes the page, with its meshes, and returns the program's messages.
fn make(page: &str, size: &str, folder: &Path) -> String {
    let ran = run("pipeline", &["run", page, "-o", "out", "--size", size, "--keep"], folder);
    assert!(ran.status.success(), "{}", said(&ran));
    said(&ran)
}

/// Returns the number of triangles of each mesh of a page, from the program's messages.
fn triangles(said: &str) -> Vec<(String, usize)> {
    let counts = said.lines().filter_map(|line| {
        let (mesh, rest) = line.split_once(": ")?.1.split_once(", ")?;
        Some((mesh.to_string(), rest.split_once(" triangles")?.0.parse().ok()?))
    });
    counts.collect()
}

/// Returns the paths in a pixel's tree that lead to the sea's plane. A path is a list of nodes from
/// the eye on, each with the lines that describe it.
fn paths_to_the_sea(pixel: &str) -> Vec<Vec<String>> {
    let folder = tempfile::tempdir().expect("a folder is made");
    make("glass-table", SMALL, folder.path());
    let scene = support::root().join("examples/scenes/glass-table.json");
    let mesh = |name: &str| format!("{name}=out/glass-table-{name}.obj");
    let meshes = ["glass", "water", "prism"].map(mesh);
    let mut arguments =
        vec![scene.to_str().expect("its name is text"), "--size", SIZE, "--pixel", pixel];
    arguments.extend(["--sampling", "thesis", "--filter", "tent"]);
    arguments.extend(meshes.iter().flat_map(|mesh| ["--mesh", mesh]));
    let ran = run("render", &arguments, folder.path());
    assert!(ran.status.success(), "{}", said(&ran));
    let mut path: Vec<String> = Vec::new();
    let mut paths = Vec::new();
    for line in String::from_utf8_lossy(&ran.stdout).lines() {
        let text = line.trim_start();
        let depth = text.split(' ').next().and_then(|word| word.parse::<usize>().ok());
        match depth {
            Some(depth) if text.contains(": ") => {
                path.truncate(depth);
                path.push(text.to_string());
            }
            _ => path.last_mut().into_iter().for_each(|step| *step += &format!("\n{text}")),
        }
        if text.starts_with("colour returned")
            && path.last().is_some_and(|step| step.contains("object 0, plane"))
        {
            paths.push(path.clone());
        }
    }
    paths
}

#[test]
fn the_meshes_are_about_the_14500_triangles_of_the_thesis() {
    let folder = tempfile::tempdir().unwrap();
    let counts = triangles(&make("glass-table", SMALL, folder.path()));
    // Two triangles for each cell, and one for each cell at a pole.
    let cells = |name: &str, rows: usize, cols: usize, at_poles: usize| {
        (name.to_string(), 2 * rows * cols - at_poles)
    };
    let expected = [
        cells("glass", 60, 60, 2 * 60),
        cells("prism", 50, 60, 2 * 60),
        cells("water", 60, 14, 2 * 60),
    ];
    assert_eq!(counts, expected);
    assert_eq!(counts.iter().map(|(_, count)| count).sum::<usize>(), 14_520);
}

#[test]
fn the_prism_throws_the_sea_back_whole_from_its_inside() {
    let paths = paths_to_the_sea("40,82");
    let whole =
        |step: &String| step.contains("\"prism\"") && step.contains("refracted 0.0 0.0 0.0");
    let internal = |path: &&Vec<String>| {
        path.iter().any(whole)
            && path[..path.len() - 1].iter().all(|step| step.contains("\"prism\""))
    };
    assert!(paths.iter().any(|path| internal(&path)), "{paths:#?}");
}

#[test]
fn through_the_walls_of_the_glass_and_the_water_the_sea_is_seen_as_an_area() {
    let paths = paths_to_the_sea("134,112");
    let through = |path: &&Vec<String>| {
        path.len() == 5
            && path[1..4].iter().all(|step| step.contains("refracted: object 7, mesh \"glass\""))
            && path[4].contains("sees a rectangle")
    };
    let path = paths.iter().find(through).unwrap_or_else(|| panic!("{paths:#?}"));
    // Fresnel's share is ((1.5 - 1.33) / 2.83)^2 = 0.0036 between glass and water, and 0.04 from
    // air to glass. Both are larger at a slant.
    let mirrored = |step: &str| -> f64 {
        let weights = step.split_once("weights: reflected ").unwrap().1;
        weights.split(' ').next().unwrap().parse().unwrap()
    };
    let shares: Vec<f64> = path[..4].iter().map(|step| mirrored(step)).collect();
    assert!(shares[1..3].iter().all(|share| (0.0036..0.005).contains(share)), "{shares:?}");
    assert!([shares[0], shares[3]].iter().all(|share| (0.035..0.06).contains(share)), "{shares:?}");
}

#[test]
fn the_same_scene_has_fewer_triangles_when_they_are_placed_by_tolerance() {
    let folder = tempfile::tempdir().unwrap();
    let counts = triangles(&make("glass-table-adaptive", SMALL, folder.path()));
    let sum: usize = counts.iter().map(|(_, count)| count).sum();
    assert!(counts.len() == 3 && sum < 14_520, "{counts:?}");
}

#[test]
fn the_sea_is_calm_when_prefiltered_beside_the_glass_and_behind_it() {
    let folder = tempfile::tempdir().unwrap();
    make("glass-table", SIZE, folder.path());
    let picture = |mode: &str| -> RgbImage {
        let path = folder.path().join(format!("out/glass-table-{mode}.png"));
        image::open(path).unwrap().to_rgb8()
    };
    // Mean difference of neighbours in green light, relative to the mean light.
    let rough = |picture: &RgbImage, columns: Range<u32>, rows: Range<u32>| {
        let light = |x, y| Encoding::Srgb.decode(f64::from(picture.get_pixel(x, y)[1]) / 255.0);
        let places = rows.flat_map(|y| columns.clone().map(move |x| (x, y)));
        let (mut steps, mut sum) = (0.0, 0.0);
        for (x, y) in places {
            steps += (light(x, y) - light(x + 1, y)).abs() + (light(x, y) - light(x, y + 1)).abs();
            sum += 2.0 * light(x, y);
        }
        steps / sum
    };
    let [point, filtered, nine] = ["point", "prefiltered", "supersampled"].map(picture);
    let far = |picture| rough(picture, 76..188, 26..48);
    let behind = |picture| rough(picture, 112..146, 106..124);
    let told = format!(
        "far {} {} {}, behind the glass {} {} {}",
        far(&point),
        far(&filtered),
        far(&nine),
        behind(&point),
        behind(&filtered),
        behind(&nine)
    );
    // Far away a footprint covers a whole wave or more, and behind the glass only part of one.
    assert!(far(&filtered) < far(&point) / 4.0, "{told}");
    assert!(far(&nine) < far(&point) / 4.0, "{told}");
    assert!(behind(&filtered) < behind(&point) / 1.5, "{told}");
    assert!(behind(&nine) < behind(&point) / 1.5, "{told}");

    // Largest step in blue light across the left outline of the orange, averaged over rows that
    // cross it at a slant. Of nine weights that sum to a step, no column has more than half.
    let outline = |picture: &RgbImage| -> f64 {
        let light = |x, y| Encoding::Srgb.decode(f64::from(picture.get_pixel(x, y)[2]) / 255.0);
        let step = |y| (70..92).map(|x| (light(x, y) - light(x + 1, y)).abs()).fold(0.0, f64::max);
        (140..165).map(step).sum::<f64>() / 25.0
    };
    let [stairs, smooth] = [outline(&filtered), outline(&nine)];
    assert!(smooth < 0.85 * stairs, "the largest steps are {stairs} and {smooth}");
}
