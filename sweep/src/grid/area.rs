//! Areas of a grid with textures of their own (thesis 3.2).

use super::{GridMesh, Seam};
use crate::grid::MOST_CELLS;
use crate::limits;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A rectangle of cells with a texture of its own, which is fitted to the rectangle. Texture coordinates run
/// from 0 to `repeat` over the area, by the lengths along contour and trajectory inside it. Their orientation
/// is that of the grid's [`UvLayout`](super::UvLayout).
///
/// Cells are numbered from 0 along the trajectory and along the contour, as a spec counts them. A cell of no
/// width, between the two columns of a crease, has no number. `[2, 5]` are cells 2, 3 and 4. The cell that
/// leads back to the start is the last one. Where areas overlap, the last one is visible.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "an object with the keys rows and cols, and any of texture, surface, repeat"
)]
pub struct Area {
    /// First cell along the trajectory, and the cell after the last.
    #[schemars(transform = limits::range(0..=MOST_CELLS))]
    pub rows: [usize; 2],
    /// First cell along the contour, and the cell after the last.
    #[schemars(transform = limits::range(0..=MOST_CELLS))]
    pub cols: [usize; 2],
    /// Texture id; if left out, that of the patch.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::id)]
    pub texture: Option<u32>,
    /// Surface id; if left out, that of the patch.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = limits::id)]
    pub surface: Option<u32>,
    /// Repeats of the picture, across and up; positive.
    #[serde(default = "once")]
    #[schemars(transform = limits::above(0.0, MOST_REPEATS))]
    pub repeat: [f64; 2],
}

/// An area as a header stores it. A reader of single rows needs to know where the area ends.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlacedArea {
    /// The area.
    pub area: Area,
    /// `v` at the first and the last row of the area, in `[0, 1]`.
    #[schemars(transform = limits::range(0.0..=1.0))]
    pub v: [f64; 2],
}

/// Largest number of repeats of a picture; far below the largest f32 of a mesh.
const MOST_REPEATS: f64 = 1e30;

fn once() -> [f64; 2] {
    [1.0; 2]
}

impl Area {
    /// Returns the key and a message for the fault of the area on a grid of `cells`
    /// `[along the trajectory, along the contour]`; `None` if the area fits.
    #[must_use]
    pub fn fault(&self, cells: [usize; 2]) -> Option<(&'static str, String)> {
        for ((key, [from, to]), most) in
            [("rows", self.rows), ("cols", self.cols)].into_iter().zip(cells)
        {
            if from >= to || to > most {
                let message = format!(
                    "found [{from}, {to}], expected two rising numbers from 0 to {most}, the \
                     number of cells"
                );
                return Some((key, message));
            }
        }
        let right = |repeat: f64| repeat > 0.0 && repeat <= MOST_REPEATS;
        let [across, up] = self.repeat;
        (!right(across) || !right(up)).then(|| {
            let message = format!(
                "found [{across:?}, {up:?}], expected positive numbers up to {MOST_REPEATS:?}"
            );
            ("repeat", message)
        })
    }
}

impl GridMesh {
    /// Returns the number of cells along the trajectory and along the contour, without cells of no size.
    #[must_use]
    pub fn cells(&self) -> [usize; 2] {
        [edges(&self.v, self.seam_v), edges(&self.u, self.seam_u)]
            .map(|edges| edges.len().max(1) - 1)
    }

    /// Returns the first area that does not fit the grid: its index, the key and a message. `None` if all
    /// areas fit.
    #[must_use]
    pub fn area_fault(&self) -> Option<(usize, &'static str, String)> {
        let cells = self.cells();
        self.areas.iter().enumerate().find_map(|(number, area)| {
            area.fault(cells).map(|(key, message)| (number, key, message))
        })
    }

    /// Returns the areas with the `v` at their ends; a row that the grid does not have gets a `v` of 1.
    #[must_use]
    pub fn placed_areas(&self) -> Vec<PlacedArea> {
        if self.areas.is_empty() {
            return Vec::new();
        }
        let edges = edges(&self.v, self.seam_v);
        let v = |row: usize| edges.get(row).copied().unwrap_or(1.0);
        self.areas
            .iter()
            .map(|area| PlacedArea { v: area.rows.map(v), area: area.clone() })
            .collect()
    }
}

/// Returns where cells that have a size begin and end, along `u` or `v`. Cell `i` lies between edges `i` and
/// `i + 1`.
#[must_use]
pub fn edges(positions: &[f64], seam: Seam) -> Vec<f64> {
    let mut edges = positions.to_vec();
    if seam.joins() {
        edges.push(1.0);
    }
    edges.dedup();
    edges
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(rows: [usize; 2], cols: [usize; 2]) -> Area {
        Area { rows, cols, texture: None, surface: None, repeat: [1.0; 2] }
    }

    #[test]
    fn creases_have_no_number() {
        let grid = GridMesh {
            seam_u: Seam::Closed,
            u: vec![0.0, 0.0, 0.5, 0.75, 0.75],
            v: vec![0.0, 0.25, 1.0],
            areas: vec![area([1, 2], [0, 3])],
            ..GridMesh::default()
        };
        assert_eq!(grid.cells(), [2, 3]);
        assert_eq!(edges(&grid.u, grid.seam_u), [0.0, 0.5, 0.75, 1.0]);
        assert_eq!((grid.area_fault(), grid.placed_areas()[0].v), (None, [0.25, 1.0]));
    }

    #[test]
    fn an_area_that_is_not_there_is_refused() {
        for (area, key, expected) in [
            (area([0, 3], [0, 1]), "rows", "found [0, 3], expected two rising numbers from 0 to 2"),
            (area([1, 1], [0, 1]), "rows", "found [1, 1], expected two rising numbers from 0 to 2"),
            (area([0, 2], [3, 4]), "cols", "found [3, 4], expected two rising numbers from 0 to 3"),
            (Area { repeat: [1.0, -2.0], ..area([0, 1], [0, 1]) }, "repeat", "found [1.0, -2.0]"),
            (
                Area { repeat: [f64::NAN, 1.0], ..area([0, 1], [0, 1]) },
                "repeat",
                "found [NaN, 1.0]",
            ),
        ] {
            let (found, message) = area.fault([2, 3]).unwrap();
            assert_eq!(found, key);
            assert!(message.starts_with(expected), "{message}");
        }
        assert_eq!(area([1, 2], [2, 3]).fault([2, 3]), None);
    }
}
