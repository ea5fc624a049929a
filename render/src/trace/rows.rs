//! Three rows of intersection trees, of which the middle one can be shaded (thesis 4.5.1).

use super::tree::IntersectionTree;

/// The last three rows that were traced.
///
/// Trees keep their arrays when the window moves on, so that after its first rows a tile allocates
/// nothing. One array for the nodes of a whole row was tried: it halves the allocations of a small
/// picture (1467 to 751 in all), needs the same memory at its peak (22 MB of heap where trees have
/// 186 nodes on the average) and takes 2.6 % more instructions, since nodes are copied into it.
#[derive(Debug)]
pub struct RowWindow {
    /// The oldest row first.
    rows: [Vec<IntersectionTree>; 3],
}

impl RowWindow {
    /// A window over rows of `width` trees.
    #[must_use]
    pub fn new(width: usize) -> Self {
        Self { rows: std::array::from_fn(|_| vec![IntersectionTree::default(); width]) }
    }

    /// Shifts the rows by one and gives the freed one to be filled.
    pub fn advance(&mut self) -> &mut [IntersectionTree] {
        self.rows.rotate_left(1);
        &mut self.rows[2]
    }

    /// Clears the first two rows, puts the third in the place of the first and gives the two freed
    /// ones to be filled: what the thesis asks for when nine rays are sent for each pixel.
    pub fn advance_by_two(&mut self) -> &mut [Vec<IntersectionTree>] {
        self.rows.rotate_left(2);
        &mut self.rows[1..]
    }

    /// The tree in column `x` of the middle row with its eight neighbours around it, row by row;
    /// `x` is neither the first nor the last column.
    #[must_use]
    pub fn around(&self, x: usize) -> [&IntersectionTree; 9] {
        std::array::from_fn(|k| &self.rows[k / 3][x - 1 + k % 3])
    }
}
