//! The inventory of a scene: a line for the camera, each light, texture and object.

use super::subject::{Item, Subject};
use super::{count, point, short, solid};
use crate::scene::{Light, Surface, SurfaceTexture};
use crate::texture::Texture;
use glam::DVec3;

/// Returns the lines for camera, lights, textures and objects, and a line for the bounding box of all
/// bounded objects.
#[must_use]
pub fn lines(subject: &Subject<'_>, table_bytes: &dyn Fn(&Texture) -> u64) -> Vec<String> {
    let scene = subject.scene;
    let camera = subject.camera;
    let high = match camera.height {
        Some(height) => format!("orthographic, {} high", short(height)),
        None => format!("{} degrees high", short(camera.angle_deg())),
    };
    let [eye, target] = [camera.eye, camera.target].map(|at| point(at.into()));
    let mut lines = vec![format!("camera: at {eye}, looks at {target}, {high}")];
    for (light, path) in scene.lights.iter().zip(&subject.lights) {
        let color = point(light.color());
        lines.push(match light {
            Light::Point(light) => {
                format!("{path}: point at {}, colour {color}", point(light.position))
            }
            Light::Spot(light) => format!(
                "{path}: spot at {}, toward {}, {} degrees from its axis to its edge, colour {color}",
                point(light.point.position),
                point(light.axis),
                short(light.outer.acos().to_degrees())
            ),
            Light::Directional(light) => {
                format!("{path}: from the direction {}, colour {color}", point(light.toward))
            }
        });
    }
    for (index, texture) in scene.textures.iter().enumerate() {
        lines.push(format!(
            "texture {}: {}",
            subject.texture_name(SurfaceTexture::Picture(index)),
            sizes(texture, table_bytes)
        ));
    }
    let mut items = &*subject.items;
    while let Some((first, others)) = items.split_first() {
        let count = others.iter().take_while(|other| other.placement > 0).count();
        lines.push(object(subject, first));
        if count > 0 {
            let last = &others[count - 1];
            let said = format!("{} to {}: the same mesh", others[0].path, last.path);
            let boxes = others[..count].iter().filter_map(solid::bounds);
            let around = boxes.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
            let extent = around.map_or(String::new(), |[a, b]| format!(", {}", extent(a, b)));
            lines.push(said + &extent);
        }
        items = &others[count..];
    }
    let boxes = subject.items.iter().filter_map(solid::bounds);
    let around = boxes.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
    if let Some([low, high]) = around {
        lines.push(format!("all: {}", extent(low, high)));
    }
    lines
}

/// Describes the size of a texture and its memory.
fn sizes(texture: &Texture, table_bytes: &dyn Fn(&Texture) -> u64) -> String {
    let texels = texture.bytes();
    let tables = match table_bytes(texture) {
        0 => "no tables".into(),
        bytes => format!("tables of {}", memory(bytes)),
    };
    format!("{} x {} texels, {}, {tables}", texture.width, texture.height, memory(texels))
}

fn memory(bytes: u64) -> String {
    match bytes {
        0..10_000 => format!("{bytes} bytes"),
        10_000..10_000_000 => format!("{} kB", bytes / 1000),
        _ => format!("{} MB", bytes / 1_000_000),
    }
}

/// Describes the kind of an object, its materials, and its bounding box.
fn object(subject: &Subject<'_>, item: &Item<'_>) -> String {
    let mut said = vec![format!("{}: {}", item.path, item.kind)];
    if let Some(mesh) = item.mesh() {
        said.push(count(mesh.triangles.len(), "triangle", "triangles"));
        said.extend(item.skin.map(|skin| match (skin.rims, skin.flips) {
            (0, 0) => format!("closed, volume {}", short(skin.volume)),
            (0, _) => "closed, one-sided".into(),
            (rims, _) => format!("open along {}", count(rims, "edge", "edges")),
        }));
    }
    let several = item.object.parts.len() > 1;
    for (k, part) in item.object.parts.iter().enumerate() {
        let name = item.mesh().and_then(|mesh| mesh.surfaces.get(k)).filter(|_| several);
        let name = name.map_or(String::new(), |name| format!("{name}: "));
        said.push(format!("{name}{}", surface(subject, part)));
    }
    let extent = solid::bounds(item).map(|[low, high]| extent(low, high));
    said.push(extent.unwrap_or("without end".into()));
    said.join(", ")
}

fn surface(subject: &Subject<'_>, part: &Surface) -> String {
    let material = subject.material_name(part.material);
    match part.texture {
        Some(texture) => {
            format!("material {material} with texture {}", subject.texture_name(texture))
        }
        None => format!("material {material}"),
    }
}

fn extent(low: DVec3, high: DVec3) -> String {
    let size = high - low;
    format!(
        "from {} to {}, {} x {} x {}",
        point(low),
        point(high),
        short(size.x),
        short(size.y),
        short(size.z)
    )
}
