//! Reads scenes and the parts that they include.

use super::spec::check_line;
use crate::seeds::SCENES;
use crate::seeds::memory_files::MemoryFiles;
use crate::verdict::{Tried, broken, hold, refused};
use files::json::Document;
use files::{Budget, Source};
use render::color::Encoding;
use render::film::{Layer, PixelFilter, THRESHOLD, memory};
use render::filter::Filter;
use render::scene::file::{MeshFile, ObjectFile};
use render::scene::read::{self, Draft};
use render::scene::{MeshSource, check};
use render::shape::Mesh;
use render::shape::mesh::{NONE, Triangle};
use render::{Prepared, Sampling, Scene, Settings, inspect};
use std::collections::BTreeMap;

/// The path of the tried part.
const PART: &str = "examples/scenes/tried.json";

/// A scene that includes the tried part.
const WHOLE: &str = r#"{"format": "tb-scene", "version": 1,
    "camera": {"eye": [0, 2, 7], "target": [0, 0, 0], "up": [0, 1, 0], "fov_deg": 40},
    "background": 0.5, "ambient": 0.3, "include": ["tried.json"], "objects": []}"#;

/// Memory for meshes, textures, tables and the picture, in bytes.
const MEMORY: u64 = 256 << 20;

/// Pixels of a picture across and down.
const SIZE: (u32, u32) = (6, 5);

/// Largest depth of a tree of rays. Glass without absorption doubles the rays at each level.
const DEEPEST: u32 = 5;

/// Largest number of objects of a scene that is rendered.
const MOST_OBJECTS: usize = 3000;

/// Reads a scene, checks and renders it.
///
/// # Errors
/// When the scene is refused, or its picture is wrong.
pub fn read(bytes: &[u8], source: &dyn Source) -> Tried {
    read_with(bytes, source, &[])
}

/// Reads a part through a scene that includes it.
///
/// # Errors
/// See [`read()`].
pub fn read_part(bytes: &[u8], stored: &MemoryFiles) -> Tried {
    read(WHOLE.as_bytes(), &stored.with(PART, bytes))
}

/// Reads a scene with the meshes in `given`. Every other mesh without a file is a tetrahedron.
///
/// # Errors
/// See [`read()`].
pub fn read_with(bytes: &[u8], source: &dyn Source, given: &[(&str, Mesh)]) -> Tried {
    let document = Document::new("scene.json", bytes).map_err(refused)?;
    let file = read::parse(&document).map_err(refused)?;
    let draft = Draft::gather(&document, &file, SCENES.as_ref(), source).map_err(refused)?;
    let mut meshes = MeshSource::new();
    for text in draft.texts().map_err(refused)? {
        for object in text.lists.objects {
            if let ObjectFile::Mesh(mesh) = object
                && (mesh.file.is_none() || given.iter().any(|(name, _)| *name == mesh.name))
            {
                let found = given.iter().find(|(name, _)| *name == mesh.name);
                let shape = found.map_or_else(|| tetrahedron(mesh), |(_, mesh)| mesh.clone());
                meshes.insert(mesh.name.clone(), shape.into());
            }
        }
    }
    let scene = draft.resolve_within(source, meshes, &Budget::new(MEMORY)).map_err(refused)?;
    // The choice depends on the input alone.
    let filter = Filter::ALL[crc32fast::hash(bytes) as usize % Filter::ALL.len()];
    let tables = |texture: &_| filter.bytes_for(texture);
    let report = check::check(&draft, &scene, 1.2, &tables)
        .map_err(|error| broken("--check refuses what was read")(&error))?;
    report.to_string().lines().try_for_each(|line| check_line(line.into()))?;
    picture(scene, filter)
}

/// Renders a scene, and checks what is true of every picture.
///
/// # Errors
/// When its textures take much memory, as a refusal; or when a pixel is not finite or is negative.
pub fn picture(mut scene: Scene, filter: Filter) -> Tried {
    if scene.objects.len() > MOST_OBJECTS {
        return Ok(());
    }
    scene.max_depth = scene.max_depth.min(DEEPEST);
    let layers = if filter == Filter::Box { Layer::ALL.to_vec() } else { Vec::new() };
    let sampling = match filter {
        Filter::Exact | Filter::Ewa8 | Filter::Ewa16 | Filter::Ewa64 | Filter::Probes => {
            let (samples, pixel_filter) = (1, PixelFilter::Box);
            Sampling::Area { samples, pixel_filter, threshold: Some(THRESHOLD) }
        }
        Filter::Point
        | Filter::Bilinear
        | Filter::Mip
        | Filter::Box
        | Filter::Tent
        | Filter::Quadratic => Sampling::regular(1),
    };
    let settings = Settings { layers, sampling, ..Settings::new(SIZE.0, SIZE.1, filter) };
    let budget = Budget::new(MEMORY);
    let _memory = memory::reserve(&scene, &settings, None, &budget).map_err(refused)?;
    let prepared = Prepared::new(&scene);
    let (picture, _) = render::render(&prepared, &settings, &|_, _| {});
    let light = |pixel: &[f32; 3]| pixel.iter().all(|x| x.is_finite() && *x >= 0.0);
    hold(picture.pixels.iter().all(light), "a pixel is not finite, or is negative")?;
    if matches!(filter, Filter::Tent | Filter::Exact) {
        let text = inspect::pixel(&prepared, &settings, (3, 2), Encoding::Srgb, true);
        text.lines()
            .filter(|line| !line.trim().is_empty())
            .try_for_each(|line| check_line(line.into()))?;
    }
    Ok(())
}

/// Makes a mesh for a name without a file. The scene binds its two surfaces.
fn tetrahedron(file: &MeshFile) -> Mesh {
    let id = |bound: &BTreeMap<String, String>, first: bool| {
        let mut ids = bound.keys().filter(|key| key.parse::<u32>().is_ok());
        let id = if first { ids.next() } else { ids.next_back() };
        id.cloned().unwrap_or_else(|| "0".into())
    };
    let surface =
        |first| format!("tex{}_surf{}", id(&file.textures, first), id(&file.materials, first));
    let corner = |position: [u32; 3]| {
        let surface = u32::from(position[0] == 1);
        Triangle { position, uv: position, normal: [NONE; 3], surface }
    };
    Mesh {
        positions: vec![[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]],
        uvs: vec![[0., 0.], [1., 0.], [0., 1.], [1., 1.]],
        triangles: [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].map(corner).to_vec(),
        surfaces: vec![surface(true), surface(false)],
        ..Mesh::default()
    }
}
