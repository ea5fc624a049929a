//! The areas of a header held against the rows, which come behind it.

use crate::grid::row::Fault;
use crate::grid::{PlacedArea, Seam};

/// The edges of the cells along the trajectory, of which a cell without height has one: counted row by
/// row, as [`area::edges`](crate::grid::area::edges) counts them.
#[derive(Debug, Default)]
pub(super) struct Edges {
    count: usize,
    last: f64,
}

impl Edges {
    /// Takes in a row at `v`.
    ///
    /// # Errors
    /// When an area begins or ends at this row, and has another `v` there.
    pub(super) fn row(&mut self, v: f64, areas: &[PlacedArea]) -> Result<(), Fault> {
        if self.count > 0 && v == self.last {
            return Ok(());
        }
        let edge = self.count;
        (self.count, self.last) = (edge + 1, v);
        for (i, PlacedArea { area, v: ends }) in areas.iter().enumerate() {
            for (k, (&row, &found)) in area.rows.iter().zip(ends).enumerate() {
                if row == edge && found != v {
                    let message = format!("found {found:?}, expected {v:?}, where that row lies");
                    return Err(Fault { place: format!("areas[{i}].v[{k}]"), message });
                }
            }
        }
        Ok(())
    }

    /// Takes in the end of the rows.
    ///
    /// # Errors
    /// When an area ends where there is no row, or an area that ends over the seam has another `v`
    /// there than 1.
    pub(super) fn finish(&mut self, seam: Seam, areas: &[PlacedArea]) -> Result<(), Fault> {
        if seam.joins() {
            self.row(1.0, areas)?;
        }
        let cells = [self.count.saturating_sub(1), usize::MAX];
        for (i, placed) in areas.iter().enumerate() {
            if let Some((key, message)) = placed.area.fault(cells) {
                return Err(Fault { place: format!("areas[{i}].area.{key}"), message });
            }
        }
        Ok(())
    }
}
