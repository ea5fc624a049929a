//! Pages composed of several objects: their objects are those that the pages describe.

use pipeline::pages::{FILES, page};
use pipeline::run::{Event, Options, scene};
use render::Prepared;
use render::film::Layer;
use render::film::{Crop, Picture, Settings, render as expose};
use render::filter::Filter;
use render::scene::{Object, Scene};
use std::collections::BTreeMap;
use std::sync::Mutex;

/// Returns the scene of a page, and the number of triangles of each of its meshes.
fn made(name: &str) -> (Scene, BTreeMap<String, usize>) {
    let folder = tempfile::tempdir().expect("a folder is made");
    let options =
        Options { folder: folder.path().into(), size: (512, 512), keep: false, clobber: false };
    let counts = Mutex::new(BTreeMap::new());
    let scene = scene(&page(name).expect("the page is there"), &FILES, &options, &|event| {
        if let Event::Mesh { name, triangles, .. } = event {
            counts.lock().expect("no thread fails").insert(name.to_owned(), triangles);
        }
    });
    (scene.expect("the scene is made"), counts.into_inner().expect("no thread fails"))
}

/// Returns the objects that are meshes, with their indices in the scene and their names.
fn meshes(scene: &Scene) -> Vec<(usize, &str, &Object)> {
    let named = scene.names.objects.iter().zip(&scene.objects).enumerate();
    named.filter_map(|(k, (name, object))| Some((k, name.as_deref()?, object))).collect()
}

/// Thesis, appendix A: each of the objects in figures A.5 to A.7 consists of 9800 triangles and has
/// a reflectivity.
#[test]
fn eight_world_and_six_have_9800_triangles_each_and_mirror() {
    let (scene, counts) = made("eight-world-klein");
    let expected = ["eight", "six", "world"].map(|name| (name.to_owned(), 9800));
    assert_eq!(counts, BTreeMap::from(expected));
    for (_, name, object) in meshes(&scene) {
        let material = &scene.materials[object.parts[0].material];
        assert!(material.reflectivity > 0.0 && material.transparency == 0.0, "{name}");
    }
    let solid = |name: &str| {
        let (_, _, object) = *meshes(&scene).iter().find(|mesh| mesh.1 == name).unwrap();
        object.parts[0].solid().is_some()
    };
    assert!(solid("six"), "the Klein bottle has a procedural texture");
    assert!(!solid("world"), "the globe has a picture");
}

/// With a tolerance the same surfaces take fewer triangles.
#[test]
fn meshes_by_tolerance_have_fewer_triangles() {
    let (_, counts) = made("eight-world-klein-adaptive");
    assert_eq!(counts.len(), 3);
    assert!(counts.values().all(|&triangles| (1000..9800).contains(&triangles)), "{counts:?}");
}

/// Without lights there are no shadows. A change on one object after the removal of another one is
/// therefore a reflection. Without mirrors there is no change.
#[test]
fn each_of_eight_world_and_six_is_seen_in_another_one() {
    let (mut scene, _) = made("eight-world-klein");
    scene.lights.clear();
    let numbers: Vec<usize> = meshes(&scene).iter().map(|mesh| mesh.0).collect();
    let images = images(&scene, &numbers);
    // Of 25,600 pixels; a smaller image would hardly be visible.
    assert!(images.iter().all(|&pixels| pixels > 60), "{images:?}");
    for material in &mut scene.materials {
        material.reflectivity = 0.0;
    }
    assert_eq!(self::images(&scene, &numbers), [0; 3]);
}

/// Returns the number of pixels of the other objects that change when each object is removed.
fn images(scene: &Scene, numbers: &[usize]) -> Vec<usize> {
    const SIDE: u32 = 160;
    let settings =
        Settings { layers: vec![Layer::Object], ..Settings::new(SIDE, SIDE, Filter::Point) };
    let picture = |scene: &Scene| expose(&Prepared::new(scene), &settings, &|_, _| {}).0;
    let object = |picture: &Picture, k: usize| picture.channels[0].values[k] as usize;
    let all = picture(scene);
    let changed = |&taken: &usize| {
        let mut without = scene.clone();
        // The replacement is invisible and keeps the indices of the list.
        without.objects[taken].shape = scene.objects[WINDOW].shape.clone();
        let others = picture(&without);
        (0..all.pixels.len())
            .filter(|&k| object(&all, k) != taken && object(&others, k) == object(&all, k))
            .filter(|&k| numbers.contains(&object(&all, k)) && all.pixels[k] != others.pixels[k])
            .count()
    };
    numbers.iter().map(changed).collect()
}

/// A pane of the window, behind the camera.
const WINDOW: usize = 2;

#[test]
fn nothing_floats() {
    for name in ["eight-world-klein", "knots"] {
        let (scene, _) = made(name);
        let meshes = meshes(&scene);
        assert!(meshes.len() > 2);
        for (_, mesh, object) in meshes {
            let [low, high] = object.shape.bounds().unwrap();
            // A thousandth of the height is invisible at the sizes of the pages.
            assert!(low.y.abs() < 1e-3 * high.y, "{mesh} of {name} begins at {}", low.y);
        }
    }
}

/// In the book's details the area sampled picture is nearer to the truth than the point sampled
/// one. The truth has many unfiltered rays in each pixel.
#[test]
fn prefiltered_crops_are_nearer_to_the_truth() {
    /// Pixels along a side of the whole picture.
    const WHOLE: u32 = 512;
    const PART: u32 = 40;
    for name in ["eight-world-klein", "knots"] {
        let (scene, _) = made(name);
        for place in page(name).unwrap().crops {
            let [x, y] = place.at.map(|at| (at * f64::from(WHOLE)) as u32 - PART / 2);
            let crop = Some(Crop { x, y, width: PART, height: PART });
            let picture = |filter, samples| {
                let settings = Settings { crop, ..Settings::new(WHOLE, WHOLE, filter) };
                expose(&Prepared::new(&scene), &settings.with_samples(samples), &|_, _| {}).0
            };
            let truth = picture(Filter::Bilinear, 6);
            let error = |filter| {
                let off = picture(filter, 1);
                let pairs = off.pixels.iter().flatten().zip(truth.pixels.iter().flatten());
                pairs.map(|(a, b)| f64::from(a - b).powi(2)).sum::<f64>()
            };
            let [point, tent] = [Filter::Point, Filter::Tent].map(error);
            assert!(tent < 0.7 * point, "{name}, {}: {tent} against {point}", place.title);
        }
    }
}
