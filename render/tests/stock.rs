//! Tables and trees that pass from a scene to the next one: the same pictures with less work.

use crate::studio::objects::{ball, mesh, plane, textured};
use crate::studio::{png, scene};
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
