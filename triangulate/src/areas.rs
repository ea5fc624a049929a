//! Finds the area and the picture coordinates of each cell of a band between two rows.

use crate::picture;
use crate::{Material, Options};
use std::collections::HashMap;
use sweep::grid::file::Header;
use sweep::grid::{UvLayout, area};

/// The areas of a patch, and the area of each cell of the current band.
///
/// Areas are numbered from 1; number 0 is the part of the patch outside all areas.
#[derive(Debug)]
pub struct Areas {
    all: Vec<Fitted>,
    /// For each column, the number of the cell that follows it along the contour. A cell of no width
    /// has the number of the cell after it.
    cells: Vec<usize>,
    /// The area of each cell, indexed by the column before the cell.
    owners: Vec<u32>,
    /// The number of the band along the trajectory; bands of no height are not counted.
    row: usize,
}

/// An area with the ranges and the material of its picture.
#[derive(Debug)]
struct Fitted {
    rows: [usize; 2],
    cols: [usize; 2],
    /// `u` at the first and the last edge of the area, in [0, 1].
    u: [f64; 2],
    /// `v` at the first and the last edge of the area, in [0, 1].
    v: [f64; 2],
    layout: UvLayout,
    material: Material,
}

impl Areas {
    /// Collects the areas of a header. `u` holds the parameter of each column, and 1 after the last
    /// column of a closed contour.
    pub fn new(header: &Header, options: &Options, u: &[f64]) -> Self {
        let material = options.material(header);
        let edges = area::edges(&header.u, header.seam_u);
        let edge = |col: usize| edges.get(col).copied().unwrap_or(1.0);
        let rest = Fitted {
            rows: [0, usize::MAX],
            cols: [0, usize::MAX],
            u: [0.0, 1.0],
            v: [0.0, 1.0],
            layout: header.uv,
            material,
        };
        let fitted = header.areas.iter().map(|placed| Fitted {
            rows: placed.area.rows,
            cols: placed.area.cols,
            u: placed.area.cols.map(edge),
            v: placed.v,
            layout: UvLayout { repeat: placed.area.repeat, ..header.uv },
            material: Material {
                texture: placed.area.texture.unwrap_or(material.texture),
                surface: placed.area.surface.unwrap_or(material.surface),
            },
        });
        let mut cell = 0;
        let cells = u.windows(2).map(|ends| {
            let this = cell;
            cell += usize::from(ends[0] < ends[1]);
            this
        });
        let cells: Vec<usize> = cells.collect();
        Self {
            owners: vec![0; cells.len()],
            all: std::iter::once(rest).chain(fitted).collect(),
            cells,
            row: 0,
        }
    }

    /// Returns whether the patch has no areas.
    pub fn none(&self) -> bool {
        self.all.len() == 1
    }

    /// Moves on to the band between rows at the two parameters `v`. A band of no height has no number
    /// of its own.
    pub fn next_band(&mut self, v: [f64; 2]) {
        if self.none() {
            return;
        }
        let row = self.row;
        self.row += usize::from(v[0] < v[1]);
        if row > 0 && !self.all.iter().any(|area| area.rows.contains(&row)) {
            return;
        }
        self.owners.fill(0);
        for (number, area) in (0..).zip(&self.all).skip(1) {
            if (area.rows[0]..area.rows[1]).contains(&row) {
                for (owner, cell) in self.owners.iter_mut().zip(&self.cells) {
                    if (area.cols[0]..area.cols[1]).contains(cell) {
                        *owner = number;
                    }
                }
            }
        }
    }

    /// Returns the area of the cell after a column.
    pub fn owner(&self, col: usize) -> u32 {
        self.owners[col]
    }

    /// Returns the material of an area.
    pub fn material(&self, owner: u32) -> Material {
        self.all[owner as usize].material
    }

    /// Returns the picture coordinates of the surface parameters `u` and `v` in an area, one unit to a
    /// repeat.
    pub fn coordinates(&self, owner: u32, u: f64, v: f64) -> [f32; 2] {
        let area = &self.all[owner as usize];
        // Area 0 is not rescaled, so its coordinates equal those of a patch without areas.
        if owner == 0 {
            return picture::coordinates(&area.layout, u, v);
        }
        let within = |x: f64, [from, to]: [f64; 2]| (x - from) / (to - from);
        picture::coordinates(&area.layout, within(u, area.u), within(v, area.v))
    }

    /// Returns the order in which a band writes its triangles: grouped by material, so that the
    /// material changes as seldom as possible. `last`, the material written last, comes first; the
    /// others follow in the order of `owners`.
    pub fn ranks(&self, last: Material, owners: &[u32]) -> HashMap<Material, usize> {
        let mut ranks = HashMap::new();
        let materials = owners.iter().map(|&owner| self.material(owner));
        for material in materials {
            let next = ranks.len() + 1;
            ranks.entry(material).or_insert(if material == last { 0 } else { next });
        }
        ranks
    }
}
