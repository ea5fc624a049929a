//! Reads glTF 2.0: the triangles of all meshes in the default scene, where their nodes place them, with
//! base colours and their pictures.
//!
//! | in the file | becomes |
//! |---|---|
//! | `POSITION`, `NORMAL` | position and normal, moved by the node and its parents |
//! | `TEXCOORD_n` of the base colour | texture coordinates |
//! | `COLOR_0` | colours of vertices, linear |
//! | triangles, strips and fans | triangles; a node that mirrors turns them over |
//! | `baseColorFactor`, `baseColorTexture`, `alphaMode`, `normalTexture`, `emissiveFactor` | a material ([`material`]) |
//! | points and lines, skins, targets of morphing, other extensions | counted in [`ObjFile::unused`] |
//!
//! Buffers and pictures may be in the file, in data URIs, or in files beside it. Compressed meshes are
//! refused. Source: "glTF 2.0 Specification", Khronos Group, 2021.

mod accessor;
mod container;
mod material;
mod uri;

use super::error::MeshFileError;
use super::{Near, Placed};
use crate::scene::obj::ObjFile;
use crate::shape::mesh::{NONE, Triangle};
use accessor::Numbers;
use container::shown;
use glam::{DMat3, DMat4, DVec3};
use gltf::mesh::{Mode, Primitive, Semantic};
use gltf::scene::{Node, Transform};
use gltf::{Document, buffer};
use material::{Coordinates, Materials};
use std::collections::BTreeMap;

/// A fault of a file without the file's name.
#[derive(Debug)]
enum Fault {
    /// A value of the JSON, or a file beside.
    Part { found: String, expected: String },
    /// A byte of a GLB.
    Byte { offset: usize, found: String, expected: String },
    /// Another fault, with the file's name.
    Other(MeshFileError),
}

impl Fault {
    fn part(found: impl Into<String>, expected: impl Into<String>) -> Self {
        Self::Part { found: found.into(), expected: expected.into() }
    }

    fn byte(offset: usize, found: impl Into<String>, expected: impl Into<String>) -> Self {
        Self::Byte { offset, found: found.into(), expected: expected.into() }
    }
}

/// Returns whether a file is a GLB.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    bytes.starts_with(container::MAGIC)
}

/// Returns whether a file is JSON with the key `asset`, which every glTF has.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    start.first() == Some(&b'{') && start.windows(7).any(|part| part == b"\"asset\"")
}

/// Reads the bytes of a glTF file.
pub(super) fn read(file: &str, bytes: &[u8], near: &mut Near<'_>) -> Result<Placed, MeshFileError> {
    read_parts(file, bytes, near).map_err(|fault| match fault {
        Fault::Part { found, expected } => {
            MeshFileError::Part { file: file.into(), found, expected }
        }
        Fault::Byte { offset, found, expected } => {
            MeshFileError::Byte { file: file.into(), offset, found, expected }
        }
        Fault::Other(error) => error,
    })
}

/// Bytes for each vertex and triangle of a node, with the numbers of its accessors in `f64`.
const VERTEX: u64 = 2 * (12 + 24 + 12 + 8 + 12) + 8 * (3 + 3 + 2 + 3);
const TRIANGLE: u64 = 2 * size_of::<Triangle>() as u64 + 3 * 12;

fn read_parts(file: &str, bytes: &[u8], near: &mut Near<'_>) -> Result<Placed, Fault> {
    let (document, chunk) = container::read(bytes)?;
    let placed = placed(&document)?;
    let mut wanted = 0_u64;
    for primitive in
        placed.iter().flat_map(|(node, _)| node.mesh()).flat_map(|mesh| mesh.primitives())
    {
        let vertices = primitive.get(&Semantic::Positions).map_or(0, |accessor| accessor.count());
        let corners = primitive.indices().map_or(vertices, |accessor| accessor.count());
        let each = if primitive.mode() == Mode::Triangles { 3 } else { 1 };
        let triangles = TRIANGLE.saturating_mul(corners as u64 / each);
        wanted =
            wanted.saturating_add(VERTEX.saturating_mul(vertices as u64).saturating_add(triangles));
    }
    (near.reserve)(wanted).map_err(|error| Fault::Other(error.into()))?;
    let buffers = buffers(file, &document, near)?;
    let mut reader = Reader {
        document: &document,
        file,
        numbers: Numbers::new(&buffers, chunk),
        read: ObjFile { file: file.into(), ..ObjFile::default() },
        materials: Materials::default(),
        positions: Vec::new(),
        colored: 0,
        unused: BTreeMap::new(),
    };
    for (node, matrix) in &placed {
        reader.node(node, *matrix)?;
    }
    let positions = std::mem::take(&mut reader.positions);
    Ok((reader.finish()?, positions))
}

/// Returns the bytes of all buffers; those of the binary chunk are left out.
fn buffers(file: &str, document: &Document, near: &mut Near<'_>) -> Result<Vec<Vec<u8>>, Fault> {
    let read = |buffer: buffer::Buffer<'_>| match buffer.source() {
        buffer::Source::Bin => Ok(Vec::new()),
        buffer::Source::Uri(text) if uri::is_data(text) => {
            uri::data(text, &format!("buffers[{}].uri", buffer.index()))
        }
        buffer::Source::Uri(text) => {
            let path = near.folder.join(uri::path(text));
            let beside = |source| MeshFileError::Beside { file: file.into(), source };
            near.source.read(&path).map_err(|error| Fault::Other(beside(error)))
        }
    };
    document.buffers().map(read).collect()
}

/// Returns the nodes of the default scene that have a mesh, with their places. A file without a default
/// scene shows its first one, or all nodes if there is none.
fn placed(document: &Document) -> Result<Vec<(Node<'_>, DMat4)>, Fault> {
    let scene = document.default_scene().or_else(|| document.scenes().next());
    let roots: Vec<Node<'_>> = match scene {
        Some(scene) => scene.nodes().collect(),
        None => {
            let mut is_child = vec![false; document.nodes().len()];
            for child in document.nodes().flat_map(|node| node.children()) {
                is_child[child.index()] = true;
            }
            document.nodes().filter(|node| !is_child[node.index()]).collect()
        }
    };
    let mut open: Vec<(Node<'_>, DMat4)> =
        roots.into_iter().rev().map(|node| (node, DMat4::IDENTITY)).collect();
    let mut seen = vec![false; document.nodes().len()];
    let mut placed = Vec::new();
    while let Some((node, parent)) = open.pop() {
        if std::mem::replace(&mut seen[node.index()], true) {
            let found = format!("node {} as a child of two nodes", node.index());
            return Err(Fault::part(found, "a tree of nodes"));
        }
        let matrix = parent * matrix(&node.transform());
        let children: Vec<Node<'_>> = node.children().collect();
        open.extend(children.into_iter().rev().map(|child| (child, matrix)));
        if node.mesh().is_some() {
            placed.push((node, matrix));
        }
    }
    Ok(placed)
}

fn matrix(transform: &Transform) -> DMat4 {
    match transform {
        Transform::Matrix { matrix } => {
            DMat4::from_cols_array_2d(&matrix.map(|column| column.map(f64::from)))
        }
        Transform::Decomposed { translation, rotation, scale } => {
            let [x, y, z, w] = rotation.map(f64::from);
            let turn = glam::DQuat::from_xyzw(x, y, z, w);
            let turn =
                if turn.length_squared() > 0.0 { turn.normalize() } else { glam::DQuat::IDENTITY };
            let [scale, translation] =
                [scale, translation].map(|three| DVec3::from(three.map(f64::from)));
            DMat4::from_scale_rotation_translation(scale, turn, translation)
        }
    }
}

/// The mesh so far.
struct Reader<'a> {
    document: &'a Document,
    file: &'a str,
    numbers: Numbers<'a>,
    read: ObjFile,
    materials: Materials,
    /// Positions in the scene of the file.
    positions: Vec<DVec3>,
    /// Number of vertices with a colour.
    colored: usize,
    unused: BTreeMap<String, usize>,
}

impl Reader<'_> {
    fn pass_over(&mut self, what: &str, count: usize) {
        if count > 0 {
            *self.unused.entry(what.into()).or_default() += count;
        }
    }

    fn node(&mut self, node: &Node<'_>, matrix: DMat4) -> Result<(), Fault> {
        let Some(mesh) = node.mesh() else { return Ok(()) };
        self.pass_over("skins", usize::from(node.skin().is_some()));
        for primitive in mesh.primitives() {
            self.pass_over("targets of morphing", primitive.morph_targets().len());
            let at = format!("meshes[{}].primitives[{}]", mesh.index(), primitive.index());
            self.primitive(&primitive, matrix, &at)?;
        }
        Ok(())
    }

    fn primitive(
        &mut self,
        primitive: &Primitive<'_>,
        matrix: DMat4,
        at: &str,
    ) -> Result<(), Fault> {
        let mode = primitive.mode();
        if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            self.pass_over("points and lines", 1);
            return Ok(());
        }
        let Some(positions) = primitive.get(&Semantic::Positions) else {
            self.pass_over("parts without positions", 1);
            return Ok(());
        };
        let positions: Vec<[f64; 3]> = self.numbers.rows(&positions)?;
        let corners = match primitive.indices() {
            None => (0..positions.len() as u32).collect(),
            Some(indices) => {
                let mut corners = Vec::with_capacity(indices.count());
                for [index] in self.numbers.rows::<1>(&indices)? {
                    if index >= positions.len() as f64 {
                        let found = format!("index {index} at `{at}.indices`");
                        let expected = format!("at most {}", positions.len().saturating_sub(1));
                        return Err(Fault::part(found, expected));
                    }
                    corners.push(index as u32);
                }
                corners
            }
        };
        let material = primitive.material();
        let coordinates = Coordinates::of(&material);
        // Counts are compared before any rows are read, since rows without a view cost the file nothing.
        let attribute = |semantic: Semantic| {
            let name = semantic.to_string();
            let Some(accessor) = primitive.get(&semantic) else { return Ok(None) };
            if accessor.count() != positions.len() {
                let found = format!("{} rows of {name} at `{at}`", accessor.count());
                return Err(Fault::part(found, format!("{}, as of POSITION", positions.len())));
            }
            Ok(Some(accessor))
        };
        let numbers = &self.numbers;
        let normals = attribute(Semantic::Normals)?.map(|rows| numbers.rows::<3>(&rows));
        let uvs = attribute(Semantic::TexCoords(coordinates.set))?;
        let uvs = uvs.map(|rows| numbers.rows::<2>(&rows));
        let colors = attribute(Semantic::Colors(0))?.map(|rows| numbers.rows::<3>(&rows));
        let (normals, uvs, colors) = (normals.transpose()?, uvs.transpose()?, colors.transpose()?);
        let surface = self.materials.surface(
            &material,
            colors.is_some(),
            (self.document, &self.numbers, self.file),
        )?;
        let mesh = &mut self.read.mesh;
        let starts =
            [self.positions.len(), mesh.uvs.len(), mesh.normals.len()].map(|len| len as u32);
        let place = |p: [f64; 3]| matrix.transform_point3(p.into());
        let of_normals = DMat3::from_mat4(matrix).inverse().transpose();
        let turned =
            |n: [f64; 3]| (of_normals * DVec3::from(n)).normalize_or_zero().as_vec3().to_array();
        let count = positions.len();
        self.colored += if colors.is_some() { count } else { 0 };
        match colors {
            Some(colors) => {
                let color = |color: [f64; 3]| color.map(|x| x.clamp(0.0, 1.0) as f32);
                mesh.colors.extend(colors.into_iter().map(color));
            }
            None => mesh.colors.extend(std::iter::repeat_n([1.0; 3], positions.len())),
        }
        let given = [uvs.is_some(), normals.is_some()];
        self.positions.extend(positions.into_iter().map(place));
        mesh.uvs.extend(uvs.into_iter().flatten().map(|uv| coordinates.moved(uv)));
        mesh.normals.extend(normals.into_iter().flatten().map(turned));
        let mirrors = matrix.determinant() < 0.0;
        let count = corners.len();
        let three = |k: usize| match mode {
            Mode::TriangleStrip => [k + k % 2, k + 1 - k % 2, k + 2],
            Mode::TriangleFan => [0, k + 1, k + 2],
            _ => [3 * k, 3 * k + 1, 3 * k + 2],
        };
        let triangles = if mode == Mode::Triangles { count / 3 } else { count.saturating_sub(2) };
        for k in 0..triangles {
            let mut corner = three(k).map(|k| corners[k]);
            if mirrors {
                corner.swap(1, 2);
            }
            let part = |start: u32, is_given: bool| match is_given {
                true => corner.map(|index| start + index),
                false => [NONE; 3],
            };
            let (position, uv) = (part(starts[0], true), part(starts[1], given[0]));
            let normal = part(starts[2], given[1]);
            mesh.triangles.push(Triangle { position, uv, normal, surface });
        }
        Ok(())
    }

    fn finish(mut self) -> Result<ObjFile, Fault> {
        if self.read.mesh.triangles.is_empty() {
            let count = self.document.meshes().len();
            let found = format!("no triangles in a scene of {count} meshes");
            return Err(Fault::part(found, "a mesh of triangles"));
        }
        for what in std::mem::take(&mut self.materials.unused) {
            self.pass_over(what, 1);
        }
        let used = |name: &&str| container::USED.contains(name);
        let others: Vec<String> =
            self.document.extensions_used().filter(|name| !used(name)).map(shown).collect();
        for name in others {
            self.pass_over(&format!("extension {name}"), 1);
        }
        let mut read = self.read;
        read.colored = self.colored;
        if self.colored == 0 {
            read.mesh.colors = Vec::new();
        }
        let names = self.materials.entries.iter().map(|entry| entry.name.clone());
        read.mesh.surfaces = names.collect();
        read.materials = self.materials.entries;
        read.pictures = self.materials.pictures;
        read.unused = self.unused.into_iter().collect();
        Ok(read)
    }
}
