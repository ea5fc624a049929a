//! Tables and trees that pass from a scene to the next one: the same pictures with less work.

use crate::studio::objects::{ball, mesh, plane, textured};
use crate::studio::{FILTERS, png, scene};
use glam::DVec3;
use render::accel::{Accel, Structure};
use render::filter::Filter;
use render::ray::Ray;
use render::{Picture, Prepared, Scene, Settings};

/// A ball on a floor with a picture, with this ambient light, radius of the ball and second texel.
fn of(ambient: f64, radius: f64, texel: u8) -> Scene {
    let floor = textured(&plane([0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0], "grey"));
    let keys = format!(
        r#""ambient": {ambient}, "textures": {{ "image": {{ "image": "image.png" }} }},
        "materials": {{ "grey": {{}} }}, "objects": [ {}, {floor} ]"#,
        mesh("grey")
    );
    let image = png(2, &[[255; 3], [texel; 3], [texel; 3], [255; 3]]);
    let mesh = ball(DVec3::ZERO, radius, 12, 6, true);
    scene(&keys, &[("m.obj", mesh), ("image.png", image)])
}

/// Returns a picture with the number of tables that were built for it.
fn made(prepared: &Prepared<'_>, filter: Filter) -> (Picture, u64) {
    let settings = Settings::new(16, 12, filter);
    let (picture, stats) = render::render(prepared, &settings, &|_, _| {});
    (picture, stats.tables)
}

/// Tables of equal textures are taken over, and pictures are those without a stock. `tables` is the number of tables that
/// the second scene builds.
fn assert_same(before: &Scene, scene: &Scene, filter: Filter, tables: u64) {
    let prepared = Prepared::new(before);
    let _ = made(&prepared, filter);
    let stock = prepared.into_stock().between(before, scene);
    let (truth, _) = made(&Prepared::new(scene), filter);
    let (picture, built) = made(&Prepared::stocked(scene, stock), filter);
    assert!(picture == truth, "{filter}");
    assert_eq!(built, tables, "{filter}");
}

#[test]
fn pictures_are_the_same_with_the_stock_of_any_scene() {
    for filter in [Filter::Exact, Filter::Tent, Filter::Mip, Filter::Ewa16, Filter::Bilinear] {
        let one = u64::from(filter != Filter::Bilinear);
        // Another light; another mesh; another texture.
        assert_same(&of(0.2, 0.7, 0), &of(0.9, 0.7, 0), filter, 0);
        assert_same(&of(0.2, 0.7, 0), &of(0.2, 0.4, 0), filter, 0);
        assert_same(&of(0.2, 0.7, 0), &of(0.2, 0.7, 90), filter, one);
    }
}

/// Trees that a structure leaves make a structure that finds the same hits.
#[test]
fn trees_of_meshes_are_taken_over() {
    let scene = of(0.2, 0.7, 0);
    let shapes = || scene.objects.iter().map(|object| &object.shape).collect::<Vec<_>>();
    let built = || Accel::build(shapes(), Structure::Bvh);
    let taken = Accel::build_over(shapes(), Structure::Bvh, built().into_planted());
    assert_eq!((taken.bytes(), taken.looks()), (built().bytes(), built().looks()));
    for k in 0..100 {
        let direction = DVec3::new(0.02 * f64::from(k) - 1.0, 0.1, -1.0).normalize();
        let ray = Ray::from_eye(DVec3::new(0.0, 0.0, 3.0), direction);
        let hit = |accel: &Accel<'_>| accel.closest(&ray, 1e9).map(|hit| (hit.t, hit.piece));
        assert_eq!(hit(&taken), hit(&built()));
    }
}

/// A textured wall, and two bodies before it, of which the first has a corner at a height.
fn bodies(height: f64) -> Scene {
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
    scene(keys, &files)
}

#[test]
fn a_scene_with_another_mesh_has_the_picture_of_a_new_one() {
    let (before, after) = (bodies(0.2), bodies(0.9));
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
        // A scene passes on what it took over, also if no picture used it.
        let third = Prepared::stocked(&after, again.into_stock()).into_stock();
        let third = Prepared::stocked(&after, third);
        assert!(render::render(&third, &settings, &|_, _| {}).0 == expected, "{filter}");
    }
}
