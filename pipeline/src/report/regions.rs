//! Regions: parts of a picture in which methods are judged separately.
//!
//! A pixel belongs to a region because of what the ray through its middle meets in the scene, not
//! because of any picture. So regions are the same for all methods.
//!
//! - `silhouettes`: among the first hits of the pixel and its eight neighbours in the picture there is
//!   more than one object, or both an object and a miss. These pixels are in no other region.
//! - `far floor`: the first hit is on a plane, a rectangle or a side of a box that shows a texture. The
//!   minor axis of the pixel's footprint there is longer than [`MINIFIED`] texels.
//! - `in mirrors`: more than half of the pixel's weight comes from textures by rays that were only
//!   mirrored.
//! - `through glass`: more than half of the pixel's weight comes from textures by rays that have passed
//!   through at least one surface.
//!
//! The footprint is the parallelogram that the pixel becomes on the texture. Its axes are the singular
//! values of the derivative of texture coordinates with respect to film position, in texels. The weight
//! of a path is the product of its surfaces' reflection or transmission factors, times the colour in
//! even light of the surface at its end. A path that leaves the scene counts as if it ended on white.

use super::measured::Region;
use super::sight::{self, PixelTracer, PixelView};
use rayon::prelude::*;
use render::Prepared;

/// Length of a footprint's minor axis above which the texture counts as minified, in texels.
pub const MINIFIED: f64 = 2.0;

/// Returns the regions of a picture of `size`, columns and rows. Regions without pixels are left out.
///
/// Runs on the threads of the current rayon pool. The result is the same for any number of threads.
#[must_use]
pub fn regions(scene: &Prepared<'_>, size: (u32, u32)) -> Vec<Region> {
    let views = views(scene, size);
    let silhouettes = silhouettes(&views, size.0 as usize);
    let elsewhere = |belongs: &dyn Fn(&PixelView) -> bool| -> Vec<bool> {
        views.iter().zip(&silhouettes).map(|(view, edge)| !edge && belongs(view)).collect()
    };
    let far = |view: &PixelView| view.flat.is_some_and(|minor| minor > MINIFIED);
    let regions = [
        Region { name: "far floor", mask: elsewhere(&far) },
        Region { name: "in mirrors", mask: elsewhere(&|view| view.mirrored > 0.5) },
        Region { name: "through glass", mask: elsewhere(&|view| view.through > 0.5) },
        Region { name: "silhouettes", mask: silhouettes },
    ];
    regions.into_iter().filter(|region| region.mask.contains(&true)).collect()
}

/// Returns a mask of the minified pixels of a picture of `size`, row by row. More than half of such a
/// pixel's weight comes from one hit on a surface with a texture, seen directly or by mirrors and
/// glass. There the minor axis of the footprint is longer than [`MINIFIED`] texels.
#[must_use]
pub fn minified(scene: &Prepared<'_>, size: (u32, u32)) -> Vec<bool> {
    let views = views(scene, size);
    views.iter().map(|view| view.minor.is_some_and(|minor| minor > MINIFIED)).collect()
}

/// Returns what every pixel sees, row by row.
fn views(scene: &Prepared<'_>, size: (u32, u32)) -> Vec<PixelView> {
    let tracer = PixelTracer::new(scene, size);
    let rows = (0..size.1).into_par_iter().map(|y| {
        let mut trees = sight::Trees::default();
        (0..size.0).map(|x| tracer.view(x, y, &mut trees)).collect::<Vec<_>>()
    });
    rows.flatten_iter().collect()
}

/// Returns a mask of the pixels whose neighbours do not all see the same object first.
fn silhouettes(views: &[PixelView], width: usize) -> Vec<bool> {
    let height = views.len().checked_div(width).unwrap_or(0);
    let edge = |k: usize| {
        let (x, y) = (k % width, k / width);
        let columns = x.saturating_sub(1)..(x + 2).min(width);
        let mut rows = y.saturating_sub(1)..(y + 2).min(height);
        rows.any(|y| columns.clone().any(|x| views[y * width + x].object != views[k].object))
    };
    (0..views.len()).map(edge).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pages;
    use files::json::Document;
    use render::Scene;
    use render::scene::MeshSource;
    use render::scene::read::{self, Draft};
    use std::path::Path;

    const SIZE: (u32, u32) = (96, 64);
    /// Half the picture's height at distance 1 over half its pixels: fields of view of 90 degrees.
    const PIXEL: f64 = 2.0 / 64.0;

    /// Makes a floor seen from a height of 1 with a level view along -z, and more objects. The
    /// texture of the floor repeats every `side` units.
    fn scene(side: f64, objects: &str) -> Scene {
        let text = format!(
            r#"{{ "format": "tb-scene", "version": 1,
            "camera": {{ "eye": [0, 1, 0], "target": [0, 1, -1], "up": [0, 1, 0], "fov_deg": 90 }},
            "background": 0.5, "ambient": 0.5, "lights": [],
            "textures": {{ "checks": {{ "image": "../textures/checkerboard.png" }} }},
            "materials": {{
                "floor": {{ "diffuse": 0.5 }}, "bare": {{ "diffuse": 0.5 }},
                "mirror": {{ "ambient": 0, "diffuse": 0, "reflectivity": 0.9 }},
                "glass": {{ "ambient": 0, "diffuse": 0, "transparency": 1, "reflectivity": 1,
                            "fresnel": true, "index_of_refraction": 1.5 }} }},
            "objects": [ {{ "plane": {{ "point": [0, 0, 0], "edge_u": [{side}, 0, 0],
                "edge_v": [0, 0, {side}], "material": "floor", "texture": "checks" }} }}{objects} ] }}"#
        );
        let document = Document::new("scene.json", text.as_bytes()).unwrap();
        let file = read::parse(&document).unwrap();
        let folder = Path::new("examples/scenes");
        let draft = Draft::gather(&document, &file, folder, &pages::FILES).unwrap();
        draft.resolve(&pages::FILES, MeshSource::new()).unwrap()
    }

    /// Returns the direction of the ray through the middle of a pixel: across and up, at one unit
    /// ahead.
    fn direction(x: u32, y: u32) -> (f64, f64) {
        let across = (f64::from(x) + 0.5 - f64::from(SIZE.0) / 2.0) * PIXEL;
        (across, -(f64::from(y) + 0.5 - f64::from(SIZE.1) / 2.0) * PIXEL)
    }

    fn mask(belongs: impl Fn(u32, u32) -> bool) -> Vec<bool> {
        (0..SIZE.1)
            .flat_map(|y| (0..SIZE.0).map(move |x| (x, y)))
            .map(|(x, y)| belongs(x, y))
            .collect()
    }

    /// Returns the minor axis of a pixel's footprint on an endless floor, in texels, derived by
    /// hand. The ray through (X, Y) meets the floor at (-X / Y, 1 / Y). The derivative has the
    /// columns (1, 0) / -Y and (X, -1) / Y^2. Trace and determinant give the larger eigenvalue of
    /// the derivative times its transpose.
    fn minor_on_floor((x, y): (f64, f64), texels: f64) -> f64 {
        let columns = [[-1.0 / y, 0.0], [x / (y * y), -1.0 / (y * y)]];
        let trace: f64 = columns.iter().flatten().map(|entry| entry * entry).sum();
        let determinant = 1.0 / (y * y * y).abs();
        let larger = 0.5 * (trace + (trace * trace - 4.0 * determinant * determinant).sqrt());
        PIXEL * texels * determinant / larger.sqrt()
    }

    fn texels_a_unit(scene: &Scene, side: f64) -> f64 {
        let texture = &scene.textures[0];
        assert_eq!(texture.width, texture.height, "the test takes texels as square");
        texture.width as f64 / side
    }

    fn region(regions: &[Region], name: &str) -> Vec<bool> {
        let found = regions.iter().find(|region| region.name == name);
        found.map_or(vec![false; (SIZE.0 * SIZE.1) as usize], |region| region.mask.clone())
    }

    #[test]
    fn the_far_floor_begins_where_the_minor_axis_has_two_texels() {
        let side = 17.0;
        let scene = scene(side, "");
        let texels = texels_a_unit(&scene, side);
        let found = regions(&Prepared::new(&scene), SIZE);
        // The horizon lies between two rows.
        let silhouettes = mask(|_, y| y == 31 || y == 32);
        assert_eq!(region(&found, "silhouettes"), silhouettes);
        let small = |x, y| {
            let (across, up) = direction(x, y);
            up < 0.0 && minor_on_floor((across, up), texels) > MINIFIED
        };
        assert_eq!(minified(&Prepared::new(&scene), SIZE), mask(small));
        assert_eq!(region(&found, "far floor"), mask(|x, y| y > 32 && small(x, y)));
        let count = mask(small).into_iter().filter(|set| *set).count();
        assert!((200..2800).contains(&count), "{count} pixels: the edge lies in the picture");
        assert_eq!(found.len(), 2, "nothing is seen in mirrors or through glass");
    }

    #[test]
    fn the_axes_are_exact_in_every_pixel() {
        let scene = scene(0.9, "");
        let texels = texels_a_unit(&scene, 0.9);
        for (view, (x, y)) in views(&Prepared::new(&scene), SIZE)
            .iter()
            .zip((0..SIZE.1).flat_map(|y| (0..SIZE.0).map(move |x| (x, y))))
        {
            let (across, up) = direction(x, y);
            let expected = (up < 0.0).then(|| minor_on_floor((across, up), texels));
            assert_eq!(view.minor, view.flat);
            match (view.minor, expected) {
                // Half a pixel below the horizon the difference quotient is off by (1/32)^2.
                (Some(found), Some(expected)) => {
                    assert!((found / expected - 1.0).abs() < 2e-3, "{x},{y}: {found} {expected}");
                }
                (found, expected) => assert_eq!(found, expected, "{x},{y}"),
            }
        }
    }

    /// An upright mirror across the view shows the floor as if it continued behind the mirror.
    #[test]
    fn a_mirror_shows_a_floor_as_far_as_its_mirror_image() {
        let mirror = r#", { "rectangle": { "corner": [-3, 0, -4], "edge_u": [6, 0, 0],
            "edge_v": [0, 3, 0], "material": "mirror" } }"#;
        let scene = scene(60.0, mirror);
        let texels = texels_a_unit(&scene, 60.0);
        let found = regions(&Prepared::new(&scene), SIZE);
        let silhouettes = region(&found, "silhouettes");
        let on_mirror = |x, y| {
            let (across, up) = direction(x, y);
            (4.0 * across).abs() < 3.0 && (0.0..3.0).contains(&(1.0 + 4.0 * up))
        };
        let inside = mask(|x, y| on_mirror(x, y) && direction(x, y).1 < 0.0);
        let expected: Vec<bool> = inside.iter().zip(&silhouettes).map(|(a, b)| *a && !b).collect();
        assert_eq!(region(&found, "in mirrors"), expected);
        assert!(expected.iter().filter(|set| **set).count() > 200);
        let small = |x, y| {
            let (across, up) = direction(x, y);
            up < 0.0 && minor_on_floor((across, up), texels) > MINIFIED
        };
        let edge_in_mirror =
            inside.iter().zip(mask(small)).filter(|(inside, small)| **inside && !small);
        assert!(edge_in_mirror.count() > 50, "some of the mirrored floor is not minified");
        // The floor behind the mirror is hidden, but its mirror image is seen at the same distance.
        assert_eq!(minified(&Prepared::new(&scene), SIZE), mask(small));
        let far = mask(|x, y| small(x, y) && !on_mirror(x, y));
        let far: Vec<bool> = far.iter().zip(&silhouettes).map(|(a, b)| *a && !b).collect();
        assert_eq!(region(&found, "far floor"), far);
        assert!(region(&found, "through glass").iter().all(|set| !set));
    }

    #[test]
    fn a_pane_shows_the_floor_behind_it() {
        let pane =
            r#", { "box": { "low": [-3, 0.01, -4.2], "high": [3, 3, -4], "material": "glass" } }"#;
        let found = regions(&Prepared::new(&scene(1.7, pane)), SIZE);
        let silhouettes = region(&found, "silhouettes");
        // Only pixels well inside the front count. Their rays have passed through front and back: the
        // floor is seen below the horizon, and no texture above it.
        let front = |x: u32, y: u32| {
            let (across, up) = direction(x, y);
            (4.0 * across).abs() < 2.8 && (0.25..3.0).contains(&(1.0 + 4.0 * up))
        };
        let through = region(&found, "through glass");
        for (k, (through, edge)) in through.iter().zip(&silhouettes).enumerate() {
            let (x, y) = (k as u32 % SIZE.0, k as u32 / SIZE.0);
            if front(x, y) && !edge {
                assert_eq!(*through, direction(x, y).1 < 0.0, "{x},{y}");
            }
        }
        assert!(
            region(&found, "in mirrors").iter().all(|set| !set),
            "Fresnel mirrors a tenth here"
        );
        let outline = region(&found, "silhouettes");
        assert!(outline.iter().filter(|set| **set).count() > 200);
    }

    #[test]
    fn regions_are_the_same_for_any_number_of_threads() {
        let ball = r#", { "sphere": { "center": [0, 1, -3], "radius": 1, "material": "glass" } }"#;
        let scene = scene(17.0, ball);
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| views(&Prepared::new(&scene), SIZE))
        };
        let alone = with(1);
        assert!(alone.iter().any(|view| view.through > 0.5), "the ball shows the floor");
        assert_eq!(alone, with(3));
    }

    #[test]
    fn bare_surfaces_are_in_no_region() {
        let board = r#", { "rectangle": { "corner": [-9, -9, -1.5], "edge_u": [18, 0, 0],
            "edge_v": [0, 18, 0], "material": "bare" } }"#;
        let scene = scene(17.0, board);
        assert!(region(&regions(&Prepared::new(&scene), SIZE), "far floor").iter().all(|set| !set));
        let views = views(&Prepared::new(&scene), SIZE);
        assert!(
            views.iter().filter(|view| view.object == Some(1)).all(|view| view.minor.is_none())
        );
    }
}
