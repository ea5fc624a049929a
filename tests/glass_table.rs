//! The page after figures A.8 and A.9: what the thesis says is to be seen in it is there.

use crate::support;

use image::RgbImage;
use render::color::Encoding;
use std::ops::Range;
use std::path::Path;
use support::{run, said};

/// The size at which pixels are looked at.
const SIZE: &str = "192x192";

/// A size for those who want the meshes.
const SMALL: &str = "16x16";

/// Makes the page, with its meshes.
fn make(page: &str, size: &str, folder: &Path) -> String {
    let ran = run("pipeline", &["run", page, "-o", "out", "--size", size, "--keep"], folder);
    assert!(ran.status.success(), "{}", said(&ran));
    said(&ran)
}

/// How many triangles each mesh of a page has, by what the program says.
fn triangles(said: &str) -> Vec<(String, usize)> {
    let counts = said.lines().filter_map(|line| {
        let (mesh, rest) = line.split_once(": ")?.1.split_once(", ")?;
        Some((mesh.to_string(), rest.split_once(" triangles")?.0.parse().ok()?))
    });
    counts.collect()
}

/// The steps of a pixel's tree that lead to what the sea's plane shows: for each sight of it the
/// lines on the way, from the eye, each with the lines that tell of it.
fn ways_to_the_sea(pixel: &str) -> Vec<Vec<String>> {
    let folder = tempfile::tempdir().expect("a folder is made");
    make("glass-table", SMALL, folder.path());
    let scene = support::root().join("examples/scenes/glass-table.json");
    let mesh = |name: &str| format!("{name}=out/glass-table-{name}.obj");
    let meshes = ["glass", "water", "prism"].map(mesh);
    let mut arguments =
        vec![scene.to_str().expect("its name is text"), "--size", SIZE, "--pixel", pixel];
    arguments.extend(meshes.iter().flat_map(|mesh| ["--mesh", mesh]));
    let ran = run("render", &arguments, folder.path());
    assert!(ran.status.success(), "{}", said(&ran));
    let mut way: Vec<String> = Vec::new();
    let mut ways = Vec::new();
    for line in String::from_utf8_lossy(&ran.stdout).lines() {
        let text = line.trim_start();
        let depth = text.split(' ').next().and_then(|word| word.parse::<usize>().ok());
        match depth {
            Some(depth) if text.contains(": ") => {
                way.truncate(depth);
                way.push(text.to_string());
            }
            _ => way.last_mut().into_iter().for_each(|step| *step += &format!("\n{text}")),
        }
        if text.starts_with("colour returned")
            && way.last().is_some_and(|step| step.contains("object 0, plane"))
        {
            ways.push(way.clone());
        }
    }
    ways
}

#[test]
fn the_meshes_are_about_the_14500_triangles_of_the_thesis() {
    let folder = tempfile::tempdir().unwrap();
    let counts = triangles(&make("glass-table", SMALL, folder.path()));
    // Cells twice, less one triangle for each cell at a pole.
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
    let ways = ways_to_the_sea("40,82");
    let whole =
        |step: &String| step.contains("\"prism\"") && step.contains("refracted 0.0 0.0 0.0");
    let internal = |way: &&Vec<String>| {
        way.iter().any(whole) && way[..way.len() - 1].iter().all(|step| step.contains("\"prism\""))
    };
    assert!(ways.iter().any(|way| internal(&way)), "{ways:#?}");
}

#[test]
fn through_the_walls_of_the_glass_and_the_water_the_sea_is_seen_as_an_area() {
    let ways = ways_to_the_sea("134,112");
    let through = |way: &&Vec<String>| {
        way.len() == 5
            && way[1..4].iter().all(|step| step.contains("refracted: object 7, mesh \"glass\""))
            && way[4].contains("sees a rectangle")
    };
    let way = ways.iter().find(through).unwrap_or_else(|| panic!("{ways:#?}"));
    // Fresnel's share: between glass and water ((1.5 - 1.33) / 2.83)^2 = 0.0036, and from air to
    // glass 0.04, both more at a slant.
    let mirrored = |step: &str| -> f64 {
        let weights = step.split_once("weights: reflected ").unwrap().1;
        weights.split(' ').next().unwrap().parse().unwrap()
    };
    let shares: Vec<f64> = way[..4].iter().map(|step| mirrored(step)).collect();
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
    // The mean difference of neighbours in green light, as a part of the mean light.
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
    // Far away an area holds a whole wave and more, behind the glass a part of one.
    assert!(far(&filtered) < far(&point) / 4.0, "{told}");
    assert!(far(&nine) < far(&point) / 4.0, "{told}");
    assert!(behind(&filtered) < behind(&point) / 1.5, "{told}");
    assert!(behind(&nine) < behind(&point) / 1.5, "{told}");

    // The largest step in blue light across the left outline of the orange, in the mean of rows that
    // it crosses at a slant. Of nine weights that sum to a step, no column has more than half.
    let outline = |picture: &RgbImage| -> f64 {
        let light = |x, y| Encoding::Srgb.decode(f64::from(picture.get_pixel(x, y)[2]) / 255.0);
        let step = |y| (70..92).map(|x| (light(x, y) - light(x + 1, y)).abs()).fold(0.0, f64::max);
        (140..165).map(step).sum::<f64>() / 25.0
    };
    let [stairs, smooth] = [outline(&filtered), outline(&nine)];
    assert!(smooth < 0.85 * stairs, "the largest steps are {stairs} and {smooth}");
}
