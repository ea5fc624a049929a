//! The triangles of one cell of the grid.

use crate::areas::Areas;
use crate::diagonal::{self, Diagonal, is_flat};
use crate::station::{NumberedUv, Station, UNNUMBERED};
use crate::triangulator::{Counts, Sink};
use crate::{Material, Options, Triangle};
use glam::DVec3;
use sweep::grid::Seam;
use sweep::grid::file::Header;

/// Writes the vertices and triangles of cells to a sink, and counts them.
#[derive(Debug)]
pub struct CellWriter<S> {
    pub sink: S,
    pub counts: Counts,
    pub picture: Picture,
    /// The material passed to the sink last.
    pub material: Material,
    /// The material of the patch.
    own: Material,
    /// Triangles of the current band, each with the number of its area.
    triangles: Vec<(u32, Triangle)>,
}

/// The picture coordinates of the columns.
#[derive(Debug)]
pub struct Picture {
    pub areas: Areas,
    /// `u` of each column, and 1 after the last column of a closed contour; in [0, 1].
    u: Vec<f64>,
    /// For each entry of `u`, the first index with the same `u`. The two columns of a crease share one
    /// index.
    same: Vec<usize>,
}

/// A cell between two rows.
///
/// Its corners are numbered as in [`diagonal::Corners`], `A` to `D`.
pub struct Cell<'a> {
    pub lower: &'a mut Station,
    pub upper: &'a mut Station,
    /// The column on the cell's left side.
    pub left: usize,
    /// The column on the cell's right side: the next column, or column 0 across a seam.
    pub right: usize,
}

/// The corners of each side, the lower or left one first: bottom, right, top, left.
const SIDES: [[usize; 2]; 4] = [[0, 1], [1, 2], [3, 2], [0, 3]];

impl Picture {
    pub fn new(header: &Header, options: &Options) -> Self {
        let mut u = header.u.clone();
        if header.seam_u == Seam::Closed {
            u.push(1.0);
        }
        let mut same: Vec<usize> = Vec::with_capacity(u.len());
        for col in 0..u.len() {
            same.push(if col > 0 && u[col] == u[col - 1] { same[col - 1] } else { col });
        }
        Self { areas: Areas::new(header, options, &u), u, same }
    }

    /// Returns the number of columns of the picture: those of the grid, and one more for a closed
    /// contour.
    pub fn cols(&self) -> usize {
        self.u.len()
    }
}

impl<S: Sink> CellWriter<S> {
    /// Makes a writer for a patch. `material` is the material passed to the sink for this patch.
    pub fn new(sink: S, counts: Counts, picture: Picture, material: Material) -> Self {
        Self { sink, counts, picture, material, own: material, triangles: Vec::new() }
    }

    pub fn position(&mut self, position: [f32; 3]) -> u32 {
        self.sink.position(position);
        counted(&mut self.counts.positions)
    }

    /// Sets the material of the patch for the triangles that follow.
    pub fn patch_material(&mut self) {
        if self.material != self.own {
            self.material = self.own;
            self.sink.material(self.own);
        }
    }

    /// Passes the triangles of the band to the sink, grouped by material.
    pub fn band_done(&mut self) {
        let areas = &self.picture.areas;
        if !areas.none() {
            let owners: Vec<u32> = self.triangles.iter().map(|(owner, _)| *owner).collect();
            let ranks = areas.ranks(self.material, &owners);
            self.triangles.sort_by_key(|(owner, _)| ranks.get(&areas.material(*owner)));
        }
        for (owner, triangle) in &self.triangles {
            let material = areas.material(*owner);
            if material != self.material {
                self.material = material;
                self.sink.material(material);
            }
            self.sink.triangle(triangle);
        }
        self.triangles.clear();
    }

    /// Collects the triangles of a cell, and passes their new vertices to the sink.
    pub fn cell(&mut self, cell: &mut Cell<'_>) {
        let owner = self.picture.areas.owner(cell.left);
        let corners = cell.each(|station, col| station.points[col]);
        let normals = cell.each(|station, col| station.normals[col]);
        let cut = least_flat(&corners, diagonal::choose(&corners, &normals));
        let pole = SIDES.iter().position(|&[from, to]| corners[from] == corners[to]);
        let mut half_way = None;
        let before = self.triangles.len();
        for triangle in cut.triangles() {
            let [a, b, c] = triangle.map(|corner| corners[corner]);
            if a == b || b == c || c == a {
                self.counts.collapsed += 1;
                continue;
            }
            if is_flat(a, b, c) {
                self.counts.slivers += 1;
                continue;
            }
            let numbers = triangle.map(|corner| {
                let position = cell.of(corner, |station, col| station.position[col]);
                match pole {
                    Some(side) if SIDES[side].contains(&corner) => {
                        let (uv, normal) =
                            *half_way.get_or_insert_with(|| self.half_way(cell, owner, side));
                        [position, uv, normal]
                    }
                    _ => [position, self.uv(cell, owner, corner), self.normal(cell, corner)],
                }
            });
            let triangle = Triangle {
                position: numbers.map(|[position, _, _]| position),
                uv: numbers.map(|[_, uv, _]| uv),
                normal: numbers.map(|[_, _, normal]| normal),
            };
            self.triangles.push((owner, triangle));
            self.counts.triangles += 1;
        }
        self.counts.quads += u64::from(self.triangles.len() - before == 2);
    }

    /// Returns the number of the picture coordinates of a corner, in area `owner`.
    fn uv(&mut self, cell: &mut Cell<'_>, owner: u32, corner: usize) -> u32 {
        let col = self.picture.same[cell.picture_col(corner)];
        let station = cell.station(corner);
        let known = |uv: &&NumberedUv| uv.owner == owner && uv.number != UNNUMBERED;
        if let Some(uv) = station.uv[col].iter().find(known) {
            return uv.number;
        }
        let uv = self.picture.areas.coordinates(owner, self.picture.u[col], station.v);
        let number = self.write_uv(uv);
        let slots = &mut cell.station(corner).uv[col];
        *slots = [NumberedUv { owner, number }, slots[0]];
        number
    }

    /// Returns the number of the normal of a corner. An equal normal in the column to the left, or in
    /// the row below, shares its number.
    fn normal(&mut self, cell: &mut Cell<'_>, corner: usize) -> u32 {
        let col = cell.col(corner);
        let station = cell.station(corner);
        if station.normal[col] != UNNUMBERED {
            return station.normal[col];
        }
        let normal = station.normals[col];
        let left = (col > 0 && station.normals[col - 1] == normal)
            .then(|| station.normal[col - 1])
            .filter(|&number| number != UNNUMBERED);
        let below = (on_top(corner) && cell.lower.normals[col] == normal)
            .then(|| cell.lower.normal[col])
            .filter(|&number| number != UNNUMBERED);
        let number = left.or(below).unwrap_or_else(|| self.write_normal(normal));
        cell.station(corner).normal[col] = number;
        number
    }

    /// Returns the numbers of the picture coordinates and the normal in the middle of a side whose two
    /// ends are one point in space.
    fn half_way(&mut self, cell: &mut Cell<'_>, owner: u32, side: usize) -> (u32, u32) {
        let ends = SIDES[side];
        let [u, v] = {
            let u = ends.map(|corner| self.picture.u[cell.picture_col(corner)]);
            let v = ends.map(|corner| cell.station(corner).v);
            [0.5 * (u[0] + u[1]), 0.5 * (v[0] + v[1])]
        };
        let uv = self.write_uv(self.picture.areas.coordinates(owner, u, v));

        let [m, n] = ends.map(|corner| cell.of(corner, |station, col| station.normals[col]));
        let middle = (m != n)
            .then(|| DVec3::from(m.map(f64::from)) + DVec3::from(n.map(f64::from)))
            .and_then(DVec3::try_normalize);
        let normal = match middle {
            Some(middle) => self.write_normal(middle.to_array().map(|x| x as f32 + 0.0)),
            None => {
                let normal = self.normal(cell, ends[0]);
                // The normal of the second end has a number from here on, so the next row can share it.
                self.normal(cell, ends[1]);
                normal
            }
        };
        (uv, normal)
    }

    pub fn write_uv(&mut self, uv: [f32; 2]) -> u32 {
        self.sink.uv(uv);
        counted(&mut self.counts.uvs)
    }

    pub fn write_normal(&mut self, normal: [f32; 3]) -> u32 {
        self.sink.normal(normal);
        counted(&mut self.counts.normals)
    }
}

impl Cell<'_> {
    /// Applies `of` to the station and the column of each corner.
    fn each<T>(&self, of: impl Fn(&Station, usize) -> T) -> [T; 4] {
        [0, 1, 2, 3].map(|corner| self.of(corner, &of))
    }

    fn of<T>(&self, corner: usize, of: impl Fn(&Station, usize) -> T) -> T {
        of(if on_top(corner) { self.upper } else { self.lower }, self.col(corner))
    }

    fn station(&mut self, corner: usize) -> &mut Station {
        if on_top(corner) { self.upper } else { self.lower }
    }

    fn col(&self, corner: usize) -> usize {
        if on_right(corner) { self.right } else { self.left }
    }

    /// Returns the column of a corner on the picture. Across a seam this is one past the last column,
    /// not column 0.
    fn picture_col(&self, corner: usize) -> usize {
        self.left + usize::from(on_right(corner))
    }
}

fn on_top(corner: usize) -> bool {
    matches!(corner, 2 | 3)
}

fn on_right(corner: usize) -> bool {
    matches!(corner, 1 | 2)
}

/// Returns the wanted diagonal, or the other one if the other leaves fewer triangles without area.
/// Each triangle without area is a slit in the mesh.
fn least_flat(corners: &diagonal::Corners, wanted: Diagonal) -> Diagonal {
    let lost = |cut: Diagonal| {
        let flat = |[a, b, c]: &[usize; 3]| is_flat(corners[*a], corners[*b], corners[*c]);
        cut.triangles().iter().filter(|triangle| flat(triangle)).count()
    };
    let of_wanted = lost(wanted);
    if of_wanted > 0 && lost(wanted.other()) < of_wanted { wanted.other() } else { wanted }
}

/// Returns the number of the next vertex of a kind, and counts it.
fn counted(count: &mut u32) -> u32 {
    // The count stays below 2^32 for every grid that the triangulator accepts.
    let number = *count;
    *count = count.wrapping_add(1);
    number
}
