//! Objects in the form of a scene file, and meshes in the form of an OBJ file.

use glam::DVec3;
use std::fmt::Write;

pub fn sphere(center: [f64; 3], radius: f64, material: &str) -> String {
    format!(
        r#"{{ "sphere": {{ "center": {center:?}, "radius": {radius:?}, "material": "{material}" }} }}"#
    )
}

/// Returns a rectangle.
pub fn quad(corner: [f64; 3], edge_u: [f64; 3], edge_v: [f64; 3], material: &str) -> String {
    format!(
        r#"{{ "rectangle": {{ "corner": {corner:?}, "edge_u": {edge_u:?}, "edge_v": {edge_v:?},
        "material": "{material}" }} }}"#
    )
}

pub fn plane(point: [f64; 3], edge_u: [f64; 3], edge_v: [f64; 3], material: &str) -> String {
    format!(
        r#"{{ "plane": {{ "point": {point:?}, "edge_u": {edge_u:?}, "edge_v": {edge_v:?},
        "material": "{material}" }} }}"#
    )
}

/// Returns the object with the picture `image` on it.
pub fn textured(object: &str) -> String {
    object.replace("\"material\"", "\"texture\": \"image\", \"material\"")
}

/// Returns the mesh of the file `m.obj`.
pub fn mesh(material: &str) -> String {
    format!(r#"{{ "mesh": {{ "name": "m", "file": "m.obj", "material": "{material}" }} }}"#)
}

pub fn light(position: [f64; 3]) -> String {
    format!(r#""lights": [ {{ "point": {{ "position": {position:?} }} }} ],"#)
}

/// Returns a closed ball of triangles around `center`, of `columns` by `rows` cells, with poles
/// along y. With `normals` it has the normals of the sphere, for interpolation.
pub fn ball(center: DVec3, radius: f64, columns: usize, rows: usize, normals: bool) -> Vec<u8> {
    let mut text = String::new();
    let vertex = |column: usize, row: usize| {
        let (across, down) = (
            std::f64::consts::TAU * column as f64 / columns as f64,
            std::f64::consts::PI * row as f64 / rows as f64,
        );
        DVec3::new(down.sin() * across.sin(), down.cos(), down.sin() * across.cos())
    };
    let poles = [DVec3::Y, DVec3::NEG_Y];
    let rings = (1..rows).flat_map(|row| (0..columns).map(move |column| vertex(column, row)));
    for v in poles.into_iter().chain(rings) {
        let DVec3 { x, y, z } = center + radius * v;
        let _ = writeln!(text, "v {x:?} {y:?} {z:?}\nvn {:?} {:?} {:?}", v.x, v.y, v.z);
    }
    let index = |column: usize, row: usize| match row {
        0 => 1,
        _ if row == rows => 2,
        _ => 3 + (row - 1) * columns + column % columns,
    };
    for row in 0..rows {
        for column in 0..columns {
            let [a, b] = [index(column, row), index(column + 1, row)];
            let [c, d] = [index(column, row + 1), index(column + 1, row + 1)];
            for [p, q, r] in [[a, c, d], [a, d, b]] {
                if p != q && q != r && r != p {
                    let _ = if normals {
                        writeln!(text, "f {p}//{p} {q}//{q} {r}//{r}")
                    } else {
                        writeln!(text, "f {p} {q} {r}")
                    };
                }
            }
        }
    }
    text.into_bytes()
}
