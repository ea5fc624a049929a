//! Random scenes: objects of all shapes on a floor, with all kinds of textures and materials.
//!
//! A number makes a scene, and the same number always makes the same one. Textures and curves are
//! those of the built-in pages.

use crate::{PipelineError, mesh, pages};
use files::Source;
use files::json::Document;
use render::Scene;
use render::film::pattern::{fraction, mixed};
use render::scene::MeshSource;
use render::scene::read::{self, Draft};
use serde_json::{Value, json};
use std::path::Path;
use sweep::Object;
use sweep::spec::Resolution;

/// Pictures of the pages, by their files.
const PICTURES: [&str; 9] = [
    "checkerboard",
    "floor-tiles",
    "granite",
    "lettering",
    "hatching",
    "world-chart",
    "scales",
    "sea",
    "graticule",
];

/// Curves of the pages whose surfaces are meshes here.
const CURVES: [&str; 7] =
    ["vase", "torus-knot", "trefoil", "horn", "pawn", "twisted-column", "spring"];

/// Cells along trajectory and contour of a mesh.
const CELLS: [usize; 2] = [120, 24];

/// A source of numbers that looks random.
struct Random(u64);

impl Random {
    /// Returns a number from `low` to `high`.
    fn within(&mut self, low: f64, high: f64) -> f64 {
        self.0 = mixed(self.0);
        low + (high - low) * fraction(self.0)
    }

    /// Returns true with this chance.
    fn chance(&mut self, chance: f64) -> bool {
        self.within(0.0, 1.0) < chance
    }

    fn one_of<'a, T>(&mut self, all: &'a [T]) -> &'a T {
        let index = self.within(0.0, all.len() as f64) as usize;
        &all[index.min(all.len() - 1)]
    }

    fn color(&mut self, low: f64, high: f64) -> Value {
        json!([self.within(low, high), self.within(low, high), self.within(low, high)])
    }
}

/// Returns the random scene of a number.
///
/// # Errors
/// None, as long as all that is made here can be read, which a test checks.
pub fn scene(number: u64) -> Result<Scene, PipelineError> {
    let mut random = Random(mixed(number ^ 0x005c_e7e5));
    let mut meshes = MeshSource::new();
    let mut objects = vec![floor(&mut random)];
    let count = random.within(2.0, 6.0) as usize;
    for k in 0..count {
        objects.push(object(&mut random, k, &mut meshes)?);
    }
    let file = json!({
        "format": "tb-scene", "version": 1,
        "camera": camera(&mut random),
        "background": background(&mut random),
        "ambient": random.within(0.2, 0.6),
        "lights": lights(&mut random),
        "max_depth": 8,
        "textures": textures(&mut random),
        "materials": materials(&mut random),
        "objects": objects,
    });
    let name = format!("random-{number}");
    let text = file.to_string();
    let document = Document::new(&name, text.as_bytes())?;
    let file = read::parse(&document)?;
    let draft = Draft::gather(&document, &file, Path::new("examples/scenes"), &pages::FILES)?;
    Ok(draft.resolve(&pages::FILES, meshes)?)
}

fn camera(random: &mut Random) -> Value {
    let angle = random.within(0.0, std::f64::consts::TAU);
    let distance = random.within(4.0, 9.0);
    json!({
        "eye": [distance * angle.sin(), random.within(0.7, 4.0), distance * angle.cos()],
        "target": [random.within(-0.5, 0.5), random.within(0.3, 1.0), random.within(-0.5, 0.5)],
        "fov_deg": random.within(25.0, 55.0),
    })
}

fn background(random: &mut Random) -> Value {
    if random.chance(0.5) {
        return random.color(0.0, 0.8);
    }
    let (horizon, top) = (random.color(0.4, 0.9), random.color(0.1, 0.6));
    json!({ "by_elevation": [[-1, 0.3], [0, horizon], [90, top]] })
}

fn lights(random: &mut Random) -> Value {
    let point = |random: &mut Random| {
        let position =
            [random.within(-6.0, 6.0), random.within(4.0, 9.0), random.within(-6.0, 6.0)];
        json!({ "point": { "position": position, "color": random.within(0.3, 0.7) } })
    };
    let mut lights = Vec::new();
    if random.chance(0.9) {
        lights.push(point(random));
    }
    if random.chance(0.4) {
        let direction = [random.within(-1.0, 1.0), -1.0, random.within(-1.0, 1.0)];
        let color = random.within(0.1, 0.4);
        lights.push(json!({ "directional": { "direction": direction, "color": color } }));
    }
    Value::Array(lights)
}

fn textures(random: &mut Random) -> Value {
    let mut textures = serde_json::Map::new();
    for name in ["a", "b"] {
        let file = format!("../textures/{}.png", random.one_of(&PICTURES));
        textures.insert(name.into(), json!({ "image": file }));
    }
    let kinds = ["marble", "granite", "wood", "brick", "checker", "stripes", "clouds", "wall"];
    for name in ["c", "d"] {
        let kind = *random.one_of(&kinds);
        let scale = random.within(0.1, 0.7);
        textures.insert(name.into(), json!({ kind: {}, "place": { "scale": scale } }));
    }
    Value::Object(textures)
}

fn materials(random: &mut Random) -> Value {
    let bump = if random.chance(0.5) {
        json!({ "noise": { "octaves": 3 }, "strength": random.within(0.02, 0.1),
                "place": { "scale": random.within(0.05, 0.3) } })
    } else {
        json!({ "wall": {}, "strength": random.within(0.02, 0.1), "place": { "scale": 0.3 } })
    };
    json!({
        "dull": { "diffuse": random.within(0.5, 0.9), "color": random.color(0.4, 1.0) },
        "shiny": { "diffuse": 0.7, "specular": random.within(0.1, 0.6),
                   "shininess": random.within(10.0, 200.0), "reflectivity": 0.1 },
        "mirror": { "ambient": 0.1, "diffuse": 0.1, "reflectivity": random.within(0.6, 0.95) },
        "glass": { "ambient": 0, "diffuse": 0, "reflectivity": 1, "transparency": 1,
                   "fresnel": true, "index_of_refraction": random.within(1.2, 1.9) },
        "rough": { "diffuse": 0.8, "bump": bump },
    })
}

/// Returns the name of a texture, or none.
fn texture(random: &mut Random) -> Value {
    if random.chance(0.25) { Value::Null } else { json!(random.one_of(&["a", "b", "c", "d"])) }
}

fn floor(random: &mut Random) -> Value {
    let side = random.within(0.8, 4.0);
    let turn = random.within(0.0, 1.0);
    let mut floor = json!({
        "point": [0, 0, 0],
        "edge_u": [side * turn.cos(), 0, side * turn.sin()],
        "edge_v": [side * turn.sin(), 0, -side * turn.cos()],
        "material": random.one_of(&["dull", "dull", "shiny", "rough"]),
    });
    dress(&mut floor, texture(random));
    json!({ "plane": floor })
}

/// Adds a texture to an object, if there is one.
fn dress(object: &mut Value, texture: Value) {
    if !texture.is_null() {
        object["texture"] = texture;
    }
}

fn object(
    random: &mut Random,
    number: usize,
    meshes: &mut MeshSource,
) -> Result<Value, PipelineError> {
    let (x, z) = (random.within(-2.2, 2.2), random.within(-2.2, 2.2));
    let size = random.within(0.3, 0.9);
    let material = *random.one_of(&["dull", "shiny", "mirror", "glass", "rough"]);
    let mut body = json!({ "material": material });
    if material != "glass" {
        dress(&mut body, texture(random));
    }
    // Nothing touches the floor, where glass would have no side.
    let height = size + random.within(0.01, 0.4);
    let turn = json!({ "rotate_deg": { "axis": [0, 1, 0], "angle": random.within(0.0, 90.0) } });
    let moved = json!({ "translate": [x, height, z] });
    let kind = match random.within(0.0, 5.0) as u32 {
        0 => {
            body["center"] = json!([x, height, z]);
            body["radius"] = json!(size);
            "sphere"
        }
        1 => {
            body["low"] = json!([-size, -size, -size]);
            body["high"] = json!([size, size, size]);
            body["place"] = json!([turn, moved]);
            "box"
        }
        2 => {
            body["center"] = json!([x, height, z]);
            body["radii"] = json!([size, size, size]);
            body["exponents"] = json!([random.within(0.3, 2.5), random.within(0.3, 2.5)]);
            "superquadric"
        }
        _ => {
            let curve = *random.one_of(&CURVES);
            let mesh = swept(curve)?;
            let lows =
                mesh.positions.iter().flatten().fold(0.0_f32, |most: f32, x| most.max(x.abs()));
            let scale = 1.3 * size / f64::from(lows.max(1e-6));
            let name = format!("mesh-{number}");
            meshes.insert(name.clone(), mesh.into());
            body["name"] = json!(name);
            body["place"] = json!([{ "scale": [scale, scale, scale] }, turn, moved]);
            // An open mesh of glass has no inside.
            if material == "glass" {
                body["material"] = json!("mirror");
            }
            "mesh"
        }
    };
    Ok(json!({ kind: body }))
}

/// Returns the mesh of a built-in curve, with few cells.
fn swept(curve: &str) -> Result<render::shape::Mesh, PipelineError> {
    let path = format!("examples/curves/{curve}.json");
    let bytes = pages::FILES.read_json(Path::new(&path))?;
    let document = Document::new(&path, &bytes)?;
    let [rows, cols] = CELLS.map(Some);
    let resolution = Resolution { rows, cols, ..Resolution::default() };
    let object = Object::read(&document, Path::new("examples/curves"), &pages::FILES, &resolution)?;
    let grids = object.grids()?;
    Ok(mesh::for_render(triangulate::mesh(grids.as_slice(), &triangulate::Options::default())?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_random_scene_can_be_read_and_is_the_same_again() {
        for number in 0..40 {
            let made = scene(number).unwrap_or_else(|error| panic!("{number}: {error}"));
            assert!(made.objects.len() >= 3);
            let again = scene(number).unwrap();
            assert_eq!(made.objects.len(), again.objects.len());
            assert_eq!(made.triangles(), again.triangles());
        }
    }
}
