//! Describes one node of an intersection tree in words.

use super::{light, vector};
use crate::footprint::{Footprint, PointReason, Sight};
use crate::scene::{Scene, SurfaceTexture};
use crate::shade::observer::{Seen, Textured};
use crate::trace::tree::{Branch, Node};

/// Describes the result of a branch, line by line. The first line names it.
pub fn lines<S: Sight>(scene: &Scene, seen: &Seen<'_, S>) -> Vec<String> {
    let Some(node) = seen.sight.node() else {
        return vec![nothing(seen.sight.branch()).into(), format!("colour {}", light(seen.color))];
    };
    let object = &scene.objects[node.piece.object as usize];
    let surface = object.parts[node.part as usize];
    let mut lines = vec![
        piece(scene, node),
        format!(
            "part {}, material {}, {}",
            node.part,
            named(&scene.names.materials, surface.material),
            surface.texture.map_or("no texture".into(), |texture| match texture {
                SurfaceTexture::Picture(index) => {
                    format!("texture {}", named(&scene.names.textures, index))
                }
                SurfaceTexture::Solid(index) => {
                    format!("solid texture {}", named(&scene.names.solids, index))
                }
            })
        ),
        format!("position {}", vector(node.position)),
        format!("normal {}, of the facet {}", vector(node.normal), vector(node.geometric_normal)),
        format!("uv {} {}", node.uv.x as f32, node.uv.y as f32),
    ];
    if let Some(local) = seen.local {
        if let (Some(textured), Some(index)) = (local.textured, surface.picture()) {
            lines.push(footprint(scene, seen.sight, node, &textured, index));
            lines.push(format!("texture average {}", light(textured.average)));
        }
        if local.coverage < 1.0 {
            lines.push(format!("covered by the mask: {}", local.coverage as f32));
        }
        lines.push(format!("local colour {}", light(local.color)));
    }
    let [reflect, refract] = [node.reflect_weight, node.refract_weight].map(light);
    lines.push(format!("weights: reflected {reflect}; refracted {refract}"));
    lines.push(format!("colour returned {}", light(seen.color)));
    lines
}

/// Describes a branch without a node.
fn nothing(branch: Branch) -> &'static str {
    match branch {
        Branch::Background(_) => "the background",
        Branch::Cut | Branch::Node(_) => {
            "not followed: too deep, of too little weight, or the tree is full"
        }
    }
}

/// Describes the object that was hit, and the triangle of a mesh.
fn piece(scene: &Scene, node: &Node) -> String {
    let index = node.piece.object as usize;
    let kind = scene.objects[index].shape.kind();
    match scene.names.objects.get(index) {
        Some(Some(name)) => {
            let name = files::words::shown(name);
            let number = scene.placement(index).map(|number| format!(", placement {number}"));
            let placement = number.unwrap_or_default();
            format!(
                "object {index}, {kind} \"{name}\"{placement}, triangle {}",
                node.piece.triangle
            )
        }
        _ if kind == "mesh" => format!("object {index}, {kind}, triangle {}", node.piece.triangle),
        _ => format!("object {index}, {kind}"),
    }
}

fn named(names: &[String], index: usize) -> String {
    names
        .get(index)
        .map_or_else(|| index.to_string(), |name| format!("\"{}\"", files::words::shown(name)))
}

/// Describes the part of its texture that a node sees, or the reason for which the node sees a
/// point.
fn footprint<S: Sight>(
    scene: &Scene,
    sight: &S,
    node: &Node,
    textured: &Textured,
    texture: usize,
) -> String {
    let kind = match textured.footprint {
        Footprint::Point(_) => return point(scene, sight.point_reason(node)),
        Footprint::Rectangle { .. } => "a rectangle",
        Footprint::Quadrilateral(_) => "a quadrilateral within a rectangle",
        Footprint::Parallelogram { .. } => "a parallelogram within a rectangle",
    };
    let (center, half) = textured.footprint.bounds();
    let texture = &scene.textures[texture];
    let (width, height) = (2.0 * half.x, 2.0 * half.y);
    format!(
        "sees {kind} of {} x {} in uv, {} x {} in texels, around {} {}",
        width as f32,
        height as f32,
        (width * texture.width as f64) as f32,
        (height * texture.height as f64) as f32,
        center.x as f32,
        center.y as f32
    )
}

/// Describes the reason for which a node sees a point.
fn point(scene: &Scene, reason: PointReason<'_>) -> String {
    match reason {
        PointReason::NoDerivative => {
            "sees a point: the ray meets a surface edge on or at the critical angle".into()
        }
        PointReason::Alone => "sees a point, as the filter requires".into(),
        PointReason::OtherChart => {
            "sees a point, since a neighbour lies on another chart of the picture".into()
        }
        PointReason::Stranger { position, branch, node } => {
            let came_to = match (branch, node) {
                (_, Some(other)) => {
                    let piece = piece(scene, other);
                    format!("hit {piece}, part {}", other.part)
                }
                (Branch::Background(_), None) => "reached the background".into(),
                (Branch::Cut | Branch::Node(_), None) => "came by another path".into(),
            };
            format!("sees a point, since its {position} neighbour {came_to}")
        }
    }
}
