//! Which picture each cell of a band between two rows shows, and how.

use crate::picture;
use crate::{Material, Options};
use std::collections::HashMap;
use sweep::grid::file::Header;
use sweep::grid::{UvLayout, area};

/// The areas of a patch, and what they do to the cells of the band at hand.
///
/// Areas are numbered from 1 here; 0 is the rest of the patch.
#[derive(Debug)]
pub struct Areas {
    all: Vec<Fitted>,
    /// The cell along the contour that follows each column, those of no width counted with their
    /// neighbour.
    cells: Vec<usize>,
    /// The area of each cell, by the column before it.
    owners: Vec<u32>,
    /// The band's cell along the trajectory.
    row: usize,
}

/// An area with all that its picture needs.
#[derive(Debug)]
struct Fitted {
    rows: [usize; 2],
    cols: [usize; 2],
    /// `u` and `v` at its ends.
    u: [f64; 2],
    v: [f64; 2],
    layout: UvLayout,
    material: Material,
}

impl Areas {
    /// The areas of a header; `u` are the places of its columns, and 1 over the seam.
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

    /// Whether there is nothing but the patch itself.
    pub fn none(&self) -> bool {
        self.all.len() == 1
    }

    /// Goes on to the band between rows at `v`; one of no height has no number.
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

    /// The area of the cell behind a column.
    pub fn owner(&self, col: usize) -> u32 {
        self.owners[col]
    }

    /// What an area is bound to.
    pub fn material(&self, owner: u32) -> Material {
        self.all[owner as usize].material
    }

    /// Picture coordinates of surface parameters in an area.
    pub fn coordinates(&self, owner: u32, u: f64, v: f64) -> [f32; 2] {
        let area = &self.all[owner as usize];
        // The rest is not fitted, so that its numbers are those of a patch without areas.
        if owner == 0 {
            return picture::coordinates(&area.layout, u, v);
        }
        let within = |x: f64, [from, to]: [f64; 2]| (x - from) / (to - from);
        picture::coordinates(&area.layout, within(u, area.u), within(v, area.v))
    }

    /// The order in which a band tells its triangles: by material, so that it changes as seldom as
    /// can be; first the one that was told last, then as triangles have them.
    pub fn ranks(&self, told: Material, owners: &[u32]) -> HashMap<Material, usize> {
        let mut ranks = HashMap::new();
        let materials = owners.iter().map(|&owner| self.material(owner));
        for material in materials {
            let next = ranks.len() + 1;
            ranks.entry(material).or_insert(if material == told { 0 } else { next });
        }
        ranks
    }
}
