//! Checks the areas of a header against the rows, which follow the header.

use crate::grid::row::Fault;
use crate::grid::{PlacedArea, Seam};

/// Counter of the edges of the cells along the trajectory, row by row. Rows at one `v` are one edge, as in
/// [`area::edges`](crate::grid::area::edges).
#[derive(Debug, Default)]
pub(super) struct Edges {
    count: usize,
    last: f64,
}

impl Edges {
    /// Adds a row at `v`.
    ///
    /// # Errors
    /// When an area begins or ends at this row but states another `v`.
    pub(super) fn row(&mut self, v: f64, areas: &[PlacedArea]) -> Result<(), Fault> {
        if self.count > 0 && v == self.last {
            return Ok(());
        }
        let edge = self.count;
        (self.count, self.last) = (edge + 1, v);
        for (i, PlacedArea { area, v: ends }) in areas.iter().enumerate() {
            for (k, (&row, &found)) in area.rows.iter().zip(ends).enumerate() {
                if row == edge && found != v {
                    let message = format!("found {found:?}, expected {v:?}, the v of the row");
                    return Err(Fault { subject: format!("areas[{i}].v[{k}]"), message });
                }
            }
        }
        Ok(())
    }

    /// Marks the end of the rows.
    ///
    /// # Errors
    /// When an area ends at a row that does not exist, or an area that ends at the seam does not state a `v`
    /// of 1.
    pub(super) fn finish(&mut self, seam: Seam, areas: &[PlacedArea]) -> Result<(), Fault> {
        if seam.joins() {
            self.row(1.0, areas)?;
        }
        let cells = [self.count.saturating_sub(1), usize::MAX];
        for (i, placed) in areas.iter().enumerate() {
            if let Some((key, message)) = placed.area.fault(cells) {
                return Err(Fault { subject: format!("areas[{i}].area.{key}"), message });
            }
        }
        Ok(())
    }
}
