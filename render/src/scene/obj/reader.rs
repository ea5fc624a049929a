//! Reads the lines of an OBJ file into a mesh.

use super::{ObjError, shortened};
use crate::shape::Mesh;
use crate::shape::mesh::{NONE, Triangle};
use std::collections::HashMap;

/// Number of indices of a corner: vertex, texture coordinate and normal.
const NUMBERED: usize = 3;

/// The mesh so far, and the state between two lines.
#[derive(Debug)]
pub(super) struct Reader<'a> {
    file: &'a str,
    text: &'a str,
    mesh: Mesh,
    /// Number of lines that began with `f`.
    pub(super) faces: usize,
    /// The last name of `usemtl`, and its surface if a face already uses it.
    name: &'a str,
    surface: Option<u32>,
    surfaces: HashMap<&'a str, u32>,
    /// Faces with indices of later lines: the line, and the largest index of each part.
    ahead: Vec<(usize, [usize; NUMBERED])>,
}

/// Indices of a corner: vertex, texture coordinate and normal. The last two are optional.
type Corner = [u32; NUMBERED];

/// The expected form of a statement.
type Expected = &'static str;

impl<'a> Reader<'a> {
    pub(super) fn new(file: &'a str, text: &'a str) -> Self {
        Self {
            file,
            text,
            mesh: Mesh::default(),
            faces: 0,
            name: "",
            surface: None,
            surfaces: HashMap::new(),
            ahead: Vec::new(),
        }
    }

    /// Reads all lines.
    pub(super) fn read(&mut self) -> Result<(), ObjError> {
        let text = self.text;
        for (number, line) in text.lines().enumerate() {
            let line = line.trim();
            self.line(number, line).map_err(|expected| self.wrong(number, line, expected))?;
        }
        let counts = self.counts();
        let lost =
            |(_, most): &&(usize, [usize; NUMBERED])| (0..NUMBERED).any(|k| most[k] > counts[k]);
        if let Some(&(number, _)) = self.ahead.iter().find(lost) {
            let line = text.lines().nth(number).unwrap_or_default();
            return Err(self.wrong(number, line, THERE));
        }
        Ok(())
    }

    /// Number of vertices so far.
    pub(super) fn vertices(&self) -> usize {
        self.mesh.positions.len()
    }

    /// Returns the mesh without the vertices that no face uses.
    pub(super) fn mesh(mut self) -> Mesh {
        let mut used = vec![false; self.mesh.positions.len()];
        for index in self.mesh.triangles.iter().flat_map(|triangle| triangle.position) {
            used[index as usize] = true;
        }
        if used.contains(&false) {
            let mut next = 0;
            let renumbered: Vec<u32> = used
                .iter()
                .map(|&used| {
                    next += u32::from(used);
                    next.saturating_sub(1)
                })
                .collect();
            let mut used = used.into_iter();
            self.mesh.positions.retain(|_| used.next().unwrap_or(true));
            for triangle in &mut self.mesh.triangles {
                triangle.position = triangle.position.map(|index| renumbered[index as usize]);
            }
        }
        self.mesh
    }

    fn wrong(&self, number: usize, line: &str, expected: Expected) -> ObjError {
        let found = shortened(line.trim());
        ObjError::Line { file: self.file.into(), line: number + 1, found, expected }
    }

    fn counts(&self) -> [usize; NUMBERED] {
        [self.mesh.positions.len(), self.mesh.uvs.len(), self.mesh.normals.len()]
    }

    fn line(&mut self, number: usize, line: &'a str) -> Result<(), Expected> {
        if line.ends_with('\\') {
            return Err("one line per statement, without a backslash at its end");
        }
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        match keyword {
            "v" => {
                let position = numbers(rest, 7).ok_or("`v` and three finite numbers")?;
                self.mesh.positions.push(position);
            }
            "vn" => {
                let normal = numbers(rest, 3).ok_or("`vn` and three finite numbers")?;
                self.mesh.normals.push(normal);
            }
            "vt" => {
                let uv = numbers(rest, 3).ok_or("`vt` and two finite numbers")?;
                self.mesh.uvs.push(uv);
            }
            "usemtl" => {
                self.name = rest.trim();
                self.surface = self.surfaces.get(self.name).copied();
            }
            "f" => self.face(number, rest)?,
            _ => {}
        }
        Ok(())
    }

    fn face(&mut self, number: usize, text: &str) -> Result<(), Expected> {
        const FORM: Expected = "`f` and three or four corners, each v, v/vt, v//vn or v/vt/vn";
        self.faces += 1;
        let counts = self.counts();
        let mut corners = [[NONE; NUMBERED]; 4];
        let mut count = 0;
        let mut most = [0; NUMBERED];
        for word in text.split_whitespace() {
            let corner = corners.get_mut(count).ok_or(FORM)?;
            let indices = parts(word).ok_or(FORM)?;
            for (k, index) in indices.into_iter().enumerate() {
                let position = match index {
                    0 => continue,
                    1.. => {
                        let index = usize::try_from(index).map_err(|_| THERE)?;
                        most[k] = most[k].max(index);
                        index - 1
                    }
                    _ => {
                        let back = usize::try_from(index.unsigned_abs()).map_err(|_| THERE)?;
                        counts[k].checked_sub(back).ok_or(THERE)?
                    }
                };
                corner[k] = u32::try_from(position).map_err(|_| THERE)?;
            }
            count += 1;
        }
        let parts = |corner: &Corner| corner.map(|index| index == NONE);
        if count < 3 || corners[..count].iter().any(|corner| parts(corner) != parts(&corners[0])) {
            return Err(FORM);
        }
        if (0..NUMBERED).any(|k| most[k] > counts[k]) {
            self.ahead.push((number, most));
        }
        let surface = self.surface();
        for k in 2..count {
            let [a, b, c] = [corners[0], corners[k - 1], corners[k]];
            let part = |k: usize| [a[k], b[k], c[k]];
            self.mesh.triangles.push(Triangle {
                position: part(0),
                uv: part(1),
                normal: part(2),
                surface,
            });
        }
        Ok(())
    }

    /// Returns the surface of the last name of `usemtl`.
    fn surface(&mut self) -> u32 {
        if let Some(surface) = self.surface {
            return surface;
        }
        let surface = self.mesh.surfaces.len() as u32;
        self.mesh.surfaces.push(self.name.into());
        self.surfaces.insert(self.name, surface);
        self.surface = Some(surface);
        surface
    }
}

const THERE: Expected = "corners that the file has, counted from 1, or back from -1";

/// Returns the first `N` of at most `most` numbers, all of which must be finite.
fn numbers<const N: usize>(text: &str, most: usize) -> Option<[f32; N]> {
    let mut numbers = [0.0; N];
    let mut count = 0;
    for word in text.split_whitespace() {
        let number: f32 = word.parse().ok().filter(|number: &f32| number.is_finite())?;
        if let Some(entry) = numbers.get_mut(count) {
            *entry = number;
        }
        count += 1;
    }
    (N..=most).contains(&count).then_some(numbers)
}

/// Returns the indices of a corner; 0 for a part that the corner does not have.
fn parts(word: &str) -> Option<[i64; NUMBERED]> {
    let index = |part: &str| part.parse().ok().filter(|&index| index != 0);
    let mut parts = word.split('/');
    let position = index(parts.next()?)?;
    let (uv, normal) = match (parts.next(), parts.next()) {
        (None, _) => (0, 0),
        (Some(uv), None) => (index(uv)?, 0),
        (Some(""), Some(normal)) => (0, index(normal)?),
        (Some(uv), Some(normal)) => (index(uv)?, index(normal)?),
    };
    parts.next().is_none().then_some([position, uv, normal])
}
