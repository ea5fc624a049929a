//! Scenes that take over tables and trees of an earlier one, and pictures that are left early.

use crate::studio;

use render::accuracy::Request;
use render::film::PixelFilter;
use render::filter::Filter;
use render::{Prepared, Scene, Settings};
use std::sync::atomic::{AtomicUsize, Ordering};
use studio::{FILTERS, png};

/// A textured wall, and two bodies before it, of which the first has a corner at a height.
fn scene(height: f64) -> Scene {
    let body = |x: f64, height: f64| {
        format!(
            "v {x} -0.5 0.1\nv {} -0.5 0.3\nv {x} {height} 0.2\nv {x} 0 0.4\nf 1 2 3\nf 1 2 4\nf 2 3 4\nf 1 3 4\n",
            x + 0.6
        )
    };
    let texels: Vec<[u8; 3]> = (0..64u8).map(|k| [k * 3, 255 - k * 4, (k % 8) * 30]).collect();
    let keys = r#""ambient": 0.4, "lights": [{ "directional": { "direction": [-0.3, -0.4, -1], "color": 0.7 } }],
        "textures": { "wall": { "image": "wall.png" } }, "materials": { "plain": {} },
        "objects": [
            { "mesh": { "name": "first", "file": "first.obj", "material": "plain" } },
            { "mesh": { "name": "second", "file": "second.obj", "material": "plain" } },
            { "mesh": { "name": "third", "file": "second.obj", "material": "plain", "place": [{ "translate": [0, 0.5, 0] }] } },
            { "rectangle": { "corner": [-1, -1, 0], "edge_u": [2, 0, 0], "edge_v": [0, 2, 0], "repeat": [5, 5],
                             "material": "plain", "texture": "wall" } }] "#;
    let files = [
        ("wall.png", png(8, &texels)),
        ("first.obj", body(-0.8, height).into_bytes()),
        ("second.obj", body(0.1, 0.4).into_bytes()),
    ];
    studio::scene(keys, &files)
}

#[test]
fn a_scene_with_another_mesh_has_the_picture_of_a_new_one() {
    let (before, after) = (scene(0.2), scene(0.9));
    for filter in FILTERS {
        let settings = Settings::new(60, 60, filter);
        let first = Prepared::new(&before);
        let old = render::render(&first, &settings, &|_, _| {}).0;
        let (expected, built) = render::render(&Prepared::new(&after), &settings, &|_, _| {});
        let stock = first.into_stock().of_same(|_| true, |object| object != 0);
        let again = Prepared::stocked(&after, stock);
        let (picture, kept) = render::render(&again, &settings, &|_, _| {});
        assert!(picture == expected && picture != old, "{filter}");
        assert_eq!(kept.tables, 0, "{filter}: the tables are there");
        assert_eq!(kept.accel_bytes, built.accel_bytes, "{filter}");
        // What is left may be passed on without a picture in between.
        let third = Prepared::stocked(&after, again.into_stock()).into_stock();
        let third = Prepared::stocked(&after, third);
        assert!(render::render(&third, &settings, &|_, _| {}).0 == expected, "{filter}");
    }
}

/// Whenever the work is ended, the answer is none, and little work follows.
#[test]
fn a_request_that_is_left_has_no_picture() {
    let scene = scene(0.4);
    let prepared = Prepared::new(&scene);
    let settings = Settings::new(80, 80, Filter::Exact);
    let asked = AtomicUsize::new(0);
    let count = || {
        asked.fetch_add(1, Ordering::Relaxed);
        true
    };
    let request = Request::new(&prepared, &settings, PixelFilter::Box);
    let whole = Request { go_on: &count, ..request }.reach_or_leave(0.01).unwrap();
    assert!(whole.picture == request.reach(0.01).picture);
    let all = asked.load(Ordering::Relaxed);
    assert!(all > 200, "the question is asked for each row of a tile: {all}");
    for part in 0..8 {
        let left = AtomicUsize::new(all * part / 8);
        let go_on = || {
            left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(1))
                .is_ok()
        };
        assert!(Request { go_on: &go_on, ..request }.reach_or_leave(0.01).is_none(), "{part}");
    }
}
