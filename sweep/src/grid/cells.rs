//! The cells of a grid, over its seams.

use super::GridMesh;

/// A cell of a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cell {
    /// Row of the cell, from 0.
    pub row: usize,
    /// Column of the cell, from 0.
    pub col: usize,
    /// Indices of the corners in `positions`, counter-clockwise as seen from outside, from the cell's own point. The
    /// second corner lies along the contour.
    pub corners: [usize; 4],
}

impl GridMesh {
    /// Returns the cells row by row. In a closed direction the cells from the last row or column lead back to the first.
    pub fn quads(&self) -> impl Iterator<Item = Cell> + '_ {
        (0..self.rows_of_cells()).flat_map(|row| self.quads_of(row))
    }

    /// Returns the number of rows of cells.
    #[must_use]
    pub fn rows_of_cells(&self) -> usize {
        let rows = self.rows();
        if self.seam_v.joins() { rows } else { rows.saturating_sub(1) }
    }

    /// Returns the cells of a row.
    ///
    /// # Panics
    /// If a corner is asked for of a row beyond the last row of cells.
    pub fn quads_of(&self, row: usize) -> impl Iterator<Item = Cell> + '_ {
        let (rows, cols) = (self.rows(), self.cols());
        let above = move |col: usize| match row + 1 == rows {
            true => self.seam_v.leads_to(col, self.shift, cols),
            false => (row + 1) * cols + col,
        };
        let last = if self.seam_u.joins() { cols } else { cols.saturating_sub(1) };
        (0..last).map(move |col| {
            let next = (col + 1) % cols;
            let corners = [row * cols + col, row * cols + next, above(next), above(col)];
            Cell { row, col, corners }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Seam;

    fn grid(seam_u: Seam, seam_v: Seam, shift: usize) -> GridMesh {
        let at = |count: usize| (0..count).map(|i| i as f64 / count as f64).collect();
        GridMesh { seam_u, seam_v, shift, u: at(4), v: at(3), ..GridMesh::default() }
    }

    #[test]
    fn cells_lead_back_over_closed_seams_only() {
        let corners = |grid: &GridMesh| grid.quads().map(|cell| cell.corners).collect::<Vec<_>>();
        let open = corners(&grid(Seam::Open, Seam::Open, 0));
        assert_eq!((open.len(), open[5]), (6, [6, 7, 11, 10]));
        let closed = corners(&grid(Seam::Closed, Seam::Closed, 1));
        assert_eq!((closed.len(), closed[3]), (12, [3, 0, 4, 7]));
        assert_eq!(closed[8], [8, 9, 2, 1]);
    }
}
