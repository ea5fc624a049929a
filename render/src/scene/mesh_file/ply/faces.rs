//! The faces of a PLY file: polygons and strips of triangles.

use super::body::{Body, Fault};
use super::header::{Element, Header};
use super::{Wrong, list};
use crate::scene::obj::divide;
use crate::shape::Mesh;
use crate::shape::mesh::{NONE, Triangle};
use glam::DVec3;
use std::collections::BTreeMap;

/// Names of the list of a face's vertices.
const INDICES: [&str; 2] = ["vertex_indices", "vertex_index"];

/// The first comment of a file of `triangulate`.
const OURS: &str = "topobook triangulate PLY 1";

/// The faces so far.
#[derive(Debug, Default)]
pub(super) struct Faces {
    /// Faces of more than three corners: the first triangle of their fan, and the one after the last.
    fans: Vec<[usize; 2]>,
    /// Texture coordinates of corners.
    uvs: Vec<[f32; 2]>,
    has_uvs: bool,
    /// Names of surfaces by texture and surface id, for a file of `triangulate`.
    surfaces: Option<BTreeMap<[u32; 2], u32>>,
    names: Vec<String>,
    /// Number of faces of fewer than three corners.
    small: usize,
    /// Number of lines with more words than a face has numbers.
    pub(super) longer: usize,
}

impl Faces {
    pub(super) fn new(header: &Header) -> Self {
        let is_ours = header.comments.first().is_some_and(|comment| comment == OURS);
        let mut faces = Self { surfaces: is_ours.then(BTreeMap::new), ..Self::default() };
        // A single material stands in a comment alone.
        let ids = header.comments.iter().find_map(|comment| ids(comment));
        faces.surface(ids.filter(|_| is_ours).unwrap_or_default());
        faces
    }

    /// Returns the surface of these ids. There is one surface if the file is not of `triangulate`.
    fn surface(&mut self, ids: [u32; 2]) -> u32 {
        let Some(surfaces) = &mut self.surfaces else {
            if self.names.is_empty() {
                self.names.push(String::new());
            }
            return 0;
        };
        let next = surfaces.len() as u32;
        let surface = *surfaces.entry(ids).or_insert(next);
        if surface == next {
            self.names.push(format!("tex{}_surf{}", ids[0], ids[1]));
        }
        surface
    }

    /// Reads all faces of an element. `vertices` is the number of vertices of the file.
    pub(super) fn read(
        &mut self,
        element: &Element,
        body: &mut Body<'_>,
        vertices: u64,
        triangles: &mut Vec<Triangle>,
    ) -> Result<(), Wrong> {
        let is_list = |name: &str| {
            element
                .properties
                .iter()
                .any(|property| property.name == name && property.list.is_some())
        };
        if !INDICES.iter().any(|name| is_list(name)) {
            let expected = "a list `vertex_indices` in the header".into();
            let fault = body.before(format!("`{}` without indices of vertices", element.name));
            return (element.count == 0).then_some(()).ok_or(Wrong { fault, expected });
        }
        let mut corners = Vec::new();
        for _ in 0..element.count {
            self.face(element, body, vertices, &mut corners, triangles)?;
            self.longer += usize::from(body.end_line());
        }
        Ok(())
    }

    fn face(
        &mut self,
        element: &Element,
        body: &mut Body<'_>,
        vertices: u64,
        corners: &mut Vec<u32>,
        triangles: &mut Vec<Triangle>,
    ) -> Result<(), Wrong> {
        let wrong = |fault| {
            let expected =
                format!("{} times `{}`, as the header says", element.count, element.name);
            Wrong { fault, expected }
        };
        corners.clear();
        let (mut uvs, mut ids) = (Vec::new(), [None; 2]);
        let is_strip = element.name == "tristrips";
        for property in &element.properties {
            let name = property.name.as_str();
            let Some(count) = property.list else {
                let number = body.number(property.kind).map_err(wrong)?;
                for (id, key) in ids.iter_mut().zip(["texture", "surface"]) {
                    if name == key {
                        *id = Some(number as u32);
                    }
                }
                continue;
            };
            if INDICES.contains(&name) {
                let mut stray = None;
                let index = |body: &mut Body<'_>| {
                    let index = body.number(property.kind)?;
                    let is_end = is_strip && index == -1.0;
                    if (index < 0.0 || index >= vertices as f64 || index.fract() != 0.0) && !is_end
                    {
                        stray.get_or_insert_with(|| body.before(format!("vertex {index}")));
                    }
                    corners.push(if is_end { NONE } else { index as u32 });
                    Ok(())
                };
                list(body, count, index).map_err(wrong)?;
                if let Some(fault) = stray {
                    let expected = format!("0 to {}", vertices.saturating_sub(1));
                    return Err(Wrong { fault, expected });
                }
            } else {
                let coordinate = |body: &mut Body<'_>| -> Result<(), Fault> {
                    let number = body.number(property.kind)?;
                    if name == "texcoord" {
                        uvs.push(number as f32);
                    }
                    Ok(())
                };
                list(body, count, coordinate).map_err(wrong)?;
            }
        }
        let ids = [ids[0], ids[1]];
        let surface = match (self.surfaces.is_some(), ids) {
            (true, [Some(texture), Some(surface)]) => self.surface([texture, surface]),
            _ => 0,
        };
        let first = triangles.len();
        if is_strip {
            for strip in corners.split(|&corner| corner == NONE) {
                for (k, three) in strip.windows(3).enumerate() {
                    let [a, b, c] = [three[k % 2], three[1 - k % 2], three[2]];
                    triangles.push(triangle([a, b, c], surface));
                }
            }
            return Ok(());
        }
        let Some((&start, others)) = corners.split_first().filter(|_| corners.len() >= 3) else {
            self.small += 1;
            return Ok(());
        };
        let pairs = (uvs.len() == 2 * corners.len()).then(|| uvs.as_chunks::<2>().0);
        for (k, two) in others.windows(2).enumerate() {
            let mut triangle = triangle([start, two[0], two[1]], surface);
            if let Some(pairs) = pairs {
                self.has_uvs = true;
                triangle.uv = [0, k + 1, k + 2].map(|corner| {
                    self.uvs.push(pairs[corner]);
                    self.uvs.len() as u32 - 1
                });
            }
            triangles.push(triangle);
        }
        if corners.len() > 3 {
            self.fans.push([first, triangles.len()]);
        }
        Ok(())
    }

    /// Returns the parts of an element that are not used, each with its count.
    pub(super) fn unused(&mut self, element: &Element) -> Vec<(String, usize)> {
        let used = |name: &str| {
            INDICES.contains(&name)
                || name == "texcoord"
                || self.surfaces.is_some() && ["texture", "surface"].contains(&name)
        };
        let names = element.properties.iter().map(|property| property.name.as_str());
        let mut unused: Vec<(String, usize)> = names
            .filter(|name| !used(name))
            .map(|name| (format!("property `{name}` of faces"), 1))
            .collect();
        unused.push(("faces of fewer than three corners".into(), std::mem::take(&mut self.small)));
        unused
    }

    /// Gives the triangles the normals and texture coordinates of their vertices, and divides polygons.
    pub(super) fn finish(self, mesh: &mut Mesh, positions: &[DVec3]) {
        let (by_uv, by_normal) = (!mesh.uvs.is_empty(), !mesh.normals.is_empty());
        let vertices = mesh.uvs.len() as u32;
        for triangle in &mut mesh.triangles {
            if self.has_uvs && triangle.uv[0] != NONE {
                triangle.uv = triangle.uv.map(|corner| corner + vertices);
            } else if by_uv {
                triangle.uv = triangle.position;
            }
            if by_normal {
                triangle.normal = triangle.position;
            }
        }
        mesh.uvs.extend(self.uvs);
        mesh.surfaces = self.names;
        let place = |index: u32| positions[index as usize];
        for [first, end] in self.fans {
            divide(&mut mesh.triangles[first..end], place);
        }
    }
}

fn triangle(position: [u32; 3], surface: u32) -> Triangle {
    Triangle { position, uv: [NONE; 3], normal: [NONE; 3], surface }
}

/// Returns the ids in a comment of `triangulate`: `texture 2 surface 0`.
fn ids(comment: &str) -> Option<[u32; 2]> {
    let mut words = comment.split(' ');
    let mut id = |key| (words.next() == Some(key)).then(|| words.next()?.parse().ok())?;
    Some([id("texture")?, id("surface")?])
}
