//! Reads the lines of an OBJ file into a mesh.

use super::{ObjError, ObjFile, shortened};
use super::{colors, far, polygon};
use crate::scene::text::{keyword, words};
use crate::shape::Mesh;
use crate::shape::mesh::{NONE, Triangle};
use glam::DVec3;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::path::PathBuf;

/// Number of indices of a corner: vertex, texture coordinate and normal.
const NUMBERED: usize = 3;

/// The mesh so far, and the state between two lines.
#[derive(Debug)]
pub(super) struct Reader<'a> {
    file: &'a str,
    text: &'a str,
    /// True if `triangulate` wrote the file.
    is_ours: bool,
    mesh: Mesh,
    /// Number of lines that began with `f`.
    pub(super) faces: usize,
    /// The last name of `usemtl`, and its surface if a face already uses it.
    name: &'a str,
    surface: Option<u32>,
    surfaces: HashMap<&'a str, u32>,
    /// Faces with indices of later lines: the line, and the largest index of each part.
    ahead: Vec<(usize, [usize; NUMBERED])>,
    /// Faces of more than three corners: the first triangle of their fan, and the one after the last.
    fans: Vec<[usize; 2]>,
    /// The current smoothing group, and the groups of the triangles before it was set.
    group: u32,
    groups: Vec<u32>,
    /// Vertices with a number that is not finite: index and line.
    bad_vertices: Vec<(u32, usize)>,
    /// Texture coordinates with a number that is not finite.
    bad_uvs: HashSet<u32>,
    libraries: Vec<&'a str>,
    /// Keywords and values that are not used, each with its count.
    unused: BTreeMap<&'a str, usize>,
}

/// Indices of a corner: vertex, texture coordinate and normal. The last two are optional.
type Corner = [u32; NUMBERED];

/// The expected form of a statement.
type Expected = &'static str;

impl<'a> Reader<'a> {
    pub(super) fn new(file: &'a str, text: &'a str, is_ours: bool) -> Self {
        Self {
            file,
            text,
            is_ours,
            mesh: Mesh::default(),
            faces: 0,
            name: "",
            surface: None,
            surfaces: HashMap::new(),
            ahead: Vec::new(),
            fans: Vec::new(),
            group: 0,
            groups: Vec::new(),
            bad_vertices: Vec::new(),
            bad_uvs: HashSet::new(),
            libraries: Vec::new(),
            unused: BTreeMap::new(),
        }
    }

    /// Reads all lines.
    pub(super) fn read(&mut self) -> Result<(), ObjError> {
        let text = self.text;
        for (number, line) in text.lines().enumerate() {
            self.line(number, line).map_err(|expected| self.wrong(number, line, expected))?;
        }
        let counts = self.counts();
        if let Some(&(number, _)) = self.ahead.iter().find(|(_, most)| most[0] > counts[0]) {
            return Err(self.wrong_line(number, THERE));
        }
        let is_lost = |most: &[usize; NUMBERED]| (1..NUMBERED).any(|k| most[k] > counts[k]);
        let lost = self.ahead.iter().filter(|(_, most)| is_lost(most)).count();
        if lost > 0 {
            *self.unused.entry(LOST).or_default() += lost;
            for triangle in &mut self.mesh.triangles {
                for (part, count) in
                    [(&mut triangle.uv, counts[1]), (&mut triangle.normal, counts[2])]
                {
                    if part.iter().any(|&index| index as usize >= count) {
                        *part = [NONE; 3];
                    }
                }
            }
        }
        if !self.bad_vertices.is_empty() {
            let used: HashSet<u32> =
                self.mesh.triangles.iter().flat_map(|triangle| triangle.position).collect();
            if let Some(&(_, number)) = self.bad_vertices.iter().find(|(k, _)| used.contains(k)) {
                return Err(self
                    .wrong_line(number, "a vertex of three finite numbers, since a face uses it"));
            }
        }
        if !self.groups.is_empty() || self.group != 0 {
            self.groups.resize(self.mesh.triangles.len(), self.group);
        }
        Ok(())
    }

    /// Number of vertices so far.
    pub(super) fn vertices(&self) -> usize {
        self.mesh.positions.len()
    }

    /// Returns the file's contents. Polygons are divided into triangles, and vertices that no face uses
    /// are left out.
    pub(super) fn finish(mut self) -> ObjFile {
        let colored = self.mesh.colors.iter().filter(|color| !color[0].is_nan()).count();
        if colored > 0 {
            self.mesh.colors.resize(self.mesh.positions.len(), [f32::NAN; 3]);
            colors::decode(&mut self.mesh.colors);
        }
        let far = if self.is_ours { None } else { far::positions(self.text, &self.mesh) };
        let positions = std::mem::take(&mut self.mesh.positions);
        let place = |index: u32| match &far {
            Some(far) => far[index as usize],
            None => DVec3::from(positions[index as usize].map(f64::from)),
        };
        for &[first, end] in &self.fans {
            polygon::divide(&mut self.mesh.triangles[first..end], place);
        }
        self.mesh.positions = positions;
        if let Some(far) = far {
            far::set(&mut self.mesh, &far);
        }
        if !self.bad_uvs.is_empty() {
            for triangle in &mut self.mesh.triangles {
                if triangle.uv.iter().any(|uv| self.bad_uvs.contains(uv)) {
                    triangle.uv = [NONE; 3];
                }
            }
            // No triangle uses these numbers, which must be finite all the same.
            for &index in &self.bad_uvs {
                self.mesh.uvs[index as usize] = [0.0; 2];
            }
        }
        self.leave_out_unused();
        ObjFile {
            file: self.file.into(),
            folder: PathBuf::new(),
            mesh: self.mesh,
            groups: self.groups,
            colored,
            libraries: self.libraries.into_iter().map(Into::into).collect(),
            unused: self.unused.into_iter().map(|(what, count)| (what.into(), count)).collect(),
            ..ObjFile::default()
        }
    }

    /// Removes the vertices that no face uses.
    fn leave_out_unused(&mut self) {
        let mut used = vec![false; self.mesh.positions.len()];
        for index in self.mesh.triangles.iter().flat_map(|triangle| triangle.position) {
            used[index as usize] = true;
        }
        if !used.contains(&false) {
            return;
        }
        let mut next = 0;
        let renumbered: Vec<u32> = used
            .iter()
            .map(|&used| {
                next += u32::from(used);
                next.saturating_sub(1)
            })
            .collect();
        for values in [&mut self.mesh.positions, &mut self.mesh.colors] {
            let mut used = used.iter().copied();
            values.retain(|_| used.next().unwrap_or(true));
        }
        for triangle in &mut self.mesh.triangles {
            triangle.position = triangle.position.map(|index| renumbered[index as usize]);
        }
    }

    fn wrong(&self, number: usize, line: &str, expected: Expected) -> ObjError {
        let found = shortened(line.trim());
        ObjError::Line { file: self.file.into(), line: number + 1, found, expected }
    }

    fn wrong_line(&self, number: usize, expected: Expected) -> ObjError {
        self.wrong(number, self.text.lines().nth(number).unwrap_or_default(), expected)
    }

    fn counts(&self) -> [usize; NUMBERED] {
        [self.mesh.positions.len(), self.mesh.uvs.len(), self.mesh.normals.len()]
    }

    fn line(&mut self, number: usize, line: &'a str) -> Result<(), Expected> {
        let (keyword, rest) = keyword(line);
        match keyword {
            "v" => {
                let (position, count) = numbers::<3>(rest).ok_or("`v` and three numbers")?;
                if position.iter().any(|x| !x.is_finite()) {
                    self.bad_vertices.push((self.mesh.positions.len() as u32, number));
                }
                if count >= 6 {
                    self.color(rest);
                }
                self.mesh.positions.push(position);
            }
            "vn" => {
                let (normal, _) = numbers(rest).ok_or("`vn` and three numbers")?;
                // A normal that is no direction stands for none.
                let is_finite = normal.iter().all(|x: &f32| x.is_finite());
                self.mesh.normals.push(if is_finite { normal } else { [0.0; 3] });
            }
            "vt" => {
                // A texture of one dimension has one coordinate.
                let two = numbers(rest);
                let one = || numbers(rest).map(|([u], count)| ([u, 0.0], count));
                let (uv, _) = two.or_else(one).ok_or("`vt` and two numbers")?;
                if uv.iter().any(|x| !x.is_finite()) {
                    self.bad_uvs.insert(self.mesh.uvs.len() as u32);
                }
                self.mesh.uvs.push(uv);
            }
            "usemtl" => {
                self.name = rest;
                self.surface = self.surfaces.get(self.name).copied();
            }
            "f" => self.face(number, rest)?,
            "s" => {
                self.groups.resize(self.mesh.triangles.len(), self.group);
                self.group = match words(rest).next() {
                    None | Some("off") => 0,
                    Some(group) => group.parse().unwrap_or(1),
                };
            }
            "mtllib" if !rest.is_empty() => self.libraries.push(rest),
            "" | "o" | "g" | "mtllib" => {}
            _ if keyword.starts_with('#') => {}
            _ => self.pass_over(keyword),
        }
        Ok(())
    }

    /// Reads the colour of the vertex that comes next. Colours that are no numbers are passed over.
    fn color(&mut self, text: &str) {
        let Some(([_, _, _, red, green, blue], _)) = numbers(text) else {
            return self.pass_over("vertex colours that are no numbers");
        };
        let color = [red, green, blue];
        if color.iter().all(|x: &f32| x.is_finite()) {
            self.mesh.colors.resize(self.mesh.positions.len(), [f32::NAN; 3]);
            self.mesh.colors.push(color);
        } else {
            self.pass_over("vertex colours that are not finite");
        }
    }

    /// Counts something that is read and not used.
    fn pass_over(&mut self, what: &'a str) {
        *self.unused.entry(what).or_default() += 1;
    }

    fn face(&mut self, number: usize, text: &str) -> Result<(), Expected> {
        const FORM: Expected = "`f` and three or more corners, each v, v/vt, v//vn or v/vt/vn";
        self.faces += 1;
        let counts = self.counts();
        let first = self.mesh.triangles.len();
        let mut ends: [Corner; 2] = [[NONE; NUMBERED]; 2];
        let mut count = 0;
        let mut most = [0; NUMBERED];
        let mut is_mixed = false;
        let surface = self.surface();
        for word in words(text) {
            let mut corner = [NONE; NUMBERED];
            for (k, index) in parts(word).ok_or(FORM)?.into_iter().enumerate() {
                let position = match index {
                    0 => continue,
                    1.. => {
                        let index = usize::try_from(index).map_err(|_| THERE)?;
                        most[k] = most[k].max(index);
                        index - 1
                    }
                    _ => {
                        let back = usize::try_from(index.unsigned_abs()).map_err(|_| THERE)?;
                        match counts[k].checked_sub(back) {
                            None if k > 0 => {
                                self.pass_over(LOST);
                                continue;
                            }
                            position => position.ok_or(THERE)?,
                        }
                    }
                };
                corner[k] = u32::try_from(position).map_err(|_| THERE)?;
            }
            if count >= 2 {
                let part = |k: usize| [ends[0][k], ends[1][k], corner[k]];
                let (position, uv, normal) = (part(0), part(1), part(2));
                self.mesh.triangles.push(Triangle { position, uv, normal, surface });
            }
            is_mixed |= (corner[1] == NONE) != (ends[0][1] == NONE) && count > 0;
            is_mixed |= (corner[2] == NONE) != (ends[0][2] == NONE) && count > 0;
            // The first corner, and the last.
            ends[count.min(1)] = corner;
            count += 1;
        }
        if count < 3 {
            self.pass_over("faces of fewer than three corners");
            return Ok(());
        }
        if is_mixed {
            self.complete(first);
        }
        if count > 3 {
            self.fans.push([first, self.mesh.triangles.len()]);
        }
        if (0..NUMBERED).any(|k| most[k] > counts[k]) {
            self.ahead.push((number, most));
        }
        Ok(())
    }

    /// Takes texture coordinates and normals from the triangles of a face, from number `first` on, if
    /// some of its corners have none.
    fn complete(&mut self, first: usize) {
        let face = &mut self.mesh.triangles[first..];
        if face.iter().any(|triangle| triangle.uv.contains(&NONE)) {
            face.iter_mut().for_each(|triangle| triangle.uv = [NONE; 3]);
        }
        if face.iter().any(|triangle| triangle.normal.contains(&NONE)) {
            face.iter_mut().for_each(|triangle| triangle.normal = [NONE; 3]);
        }
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

/// Indices of texture coordinates and normals that the file does not have.
const LOST: &str = "indices of vt or vn that the file does not have";

const THERE: Expected = "corners that the file has, counted from 1, or back from -1";

/// Returns the first `N` numbers of a statement, and the number of its words.
fn numbers<const N: usize>(text: &str) -> Option<([f32; N], usize)> {
    let mut numbers = [0.0; N];
    let mut count = 0;
    for word in words(text) {
        if let Some(entry) = numbers.get_mut(count) {
            *entry = number(word)?;
        }
        count += 1;
    }
    (count >= N).then_some((numbers, count))
}

/// Returns a number. Some programs write what is no number as `1.#IND` or `nan(ind)`.
fn number(word: &str) -> Option<f32> {
    let is_none = || word.contains(".#") || word.trim_start_matches('-').starts_with("nan(");
    word.parse().ok().or_else(|| is_none().then_some(f32::NAN))
}

/// Returns the indices of a corner; 0 for a part that the corner does not have.
fn parts(word: &str) -> Option<[i64; NUMBERED]> {
    let mut parts = word.split('/');
    let position = parts.next()?.parse().ok().filter(|&index| index != 0)?;
    // Some programs write empty parts at the end, `1/` and `1//`, and some write 0.
    let mut optional = || match parts.next() {
        None | Some("") => Some(0),
        Some(part) => part.parse().ok(),
    };
    let (uv, normal) = (optional()?, optional()?);
    parts.next().is_none().then_some([position, uv, normal])
}
