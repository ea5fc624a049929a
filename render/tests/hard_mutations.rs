//! Scenes altered at random: keys, numbers and bytes of the examples are changed. Each scene gives
//! a picture of finite colours, or one sentence with the position of the fault, and no panic. The
//! fuzzer limits the time of a case.

use crate::examples;

use examples::{Meshless, examples};
use files::json::Document;
use fixtures::Dice;
use fixtures::alterations::{Alterations, cases, garble};
use render::filter::Filter;
use render::scene::read::{self, Draft};
use render::scene::{MeshSource, check};
use render::shape::Mesh;
use render::shape::mesh::{NONE, Triangle};
use render::trace::tree::MOST_NODES;
use render::{Prepared, Settings, scene::SceneError};
use serde_json::Value;
use std::path::Path;

const NUMBERS: [f64; 27] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    1e-3,
    1e-9,
    -1e-9,
    1e-16,
    1e-29,
    1e-31,
    -1e-29,
    1e-320,
    5e-324,
    1e9,
    -1e9,
    1e15,
    1e29,
    -1e29,
    1e31,
    1e38,
    1e155,
    1e308,
    -1e308,
    64.0,
    180.0,
    0.999_999_999,
];

/// Returns a tetrahedron, which replaces every mesh that jobs would give.
fn tetrahedron() -> Mesh {
    let corner =
        |position: [u32; 3]| Triangle { position, uv: position, normal: [NONE; 3], surface: 0 };
    Mesh {
        positions: vec![[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]],
        uvs: vec![[0., 0.], [1., 0.], [0., 1.], [1., 1.]],
        triangles: [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].map(corner).to_vec(),
        surfaces: vec!["tex2_surf0".into()],
        ..Mesh::default()
    }
}

/// Reads, checks and renders a text. Returns whether it gives a picture.
fn judged(text: &[u8]) -> bool {
    let shown = String::from_utf8_lossy(text);
    let made = Document::new("scene.json", text).map_err(SceneError::from).and_then(|document| {
        let file = read::parse(&document)?;
        let draft = Draft::gather(&document, &file, Path::new("examples/scenes"), &Meshless)?;
        let names = file.objects.iter().filter_map(|object| match object {
            render::scene::file::ObjectFile::Mesh(mesh) => Some(mesh.name.clone()),
            _ => None,
        });
        let given: MeshSource = names.map(|name| (name, tetrahedron().into())).collect();
        let scene = draft.resolve(&Meshless, given)?;
        let report = check::check(&draft, &scene, 1.0, &|_| 0)?;
        for line in report.to_string().lines() {
            assert!(!line.contains("NaN") || shown.contains("NaN"), "{line}\n{shown}");
        }
        Ok(scene)
    });
    match made {
        Ok(scene) => {
            let settings = Settings::new(5, 4, Filter::Tent);
            let (picture, stats) = render::render(&Prepared::new(&scene), &settings, &|_, _| {});
            let finite = |pixel: &[f32; 3]| pixel.iter().all(|x| x.is_finite() && *x >= 0.0);
            assert!(picture.pixels.iter().all(finite), "{:?}\n{shown}", picture.pixels);
            // Values this large occur only where colours that are huge themselves are multiplied.
            let huge = shown.contains("e29") || shown.contains("e+29");
            assert!(stats.not_finite == 0 || huge, "{shown}");
            // For any scene, a tree of rays has a bounded number of nodes.
            assert!(
                stats.hits <= stats.primary_rays * MOST_NODES as u64,
                "{}\n{shown}",
                stats.hits
            );
            true
        }
        Err(error) => {
            let message = error.to_string();
            // The position is the file, a line and a column, and mostly a path.
            let placed = message.strip_prefix("scene.json:").is_some_and(|rest| {
                rest.split(':').take(2).all(|number| number.parse::<u32>().is_ok())
            });
            assert!(placed, "{message}\n{shown}");
            let says = ["found", "expected", "key", "cannot read"];
            assert!(says.iter().any(|word| message.contains(word)), "{message}\n{shown}");
            false
        }
    }
}

#[test]
fn thousands_of_altered_scenes_give_a_picture_or_a_sentence() {
    let seeds: Vec<Value> = examples().into_iter().map(|(_, scene)| scene).collect();
    let alterations = Alterations { numbers: &NUMBERS, text: "../../../none", seeds: &seeds };
    let cases = cases(2000);
    let mut made: u64 = 0;
    for case in 0..cases {
        let mut dice = Dice::new(case);
        let mut scene = dice.one(&seeds).clone();
        for _ in 0..=dice.below(3) {
            alterations.alter(&mut scene, &mut dice);
        }
        let text = scene.to_string();
        let text = if dice.once_in(5) { garble(text, &mut dice) } else { text.into_bytes() };
        made += u64::from(judged(&text));
    }
    assert!(made > cases / 8, "alterations are mild enough to be rendered at times: {made}");
}
