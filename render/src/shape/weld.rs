//! Welds the vertices of a mesh that have equal positions.

use std::collections::HashMap;

/// The vertices of a mesh, numbered so that vertices at equal positions have equal numbers.
///
/// Positions are equal if all their bits are equal, apart from the sign of zero. Files repeat a
/// vertex where its normal or its texture coordinates change.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Weld {
    numbers: Vec<u32>,
}

impl Weld {
    /// Numbers the positions from 0, in the order in which they first occur.
    #[must_use]
    pub fn new(positions: &[[f32; 3]]) -> Self {
        let mut known: HashMap<[u32; 3], u32> = HashMap::with_capacity(positions.len());
        let number = |&position: &[f32; 3]| {
            let next = known.len() as u32;
            *known.entry(bits(position)).or_insert(next)
        };
        Self { numbers: positions.iter().map(number).collect() }
    }

    /// Returns the number of the vertex that has this index in the array of positions.
    #[must_use]
    pub fn number(&self, index: u32) -> u32 {
        self.numbers[index as usize]
    }

    /// Returns the numbers of a triangle's corners.
    #[must_use]
    pub fn corners(&self, indices: [u32; 3]) -> [u32; 3] {
        indices.map(|index| self.number(index))
    }
}

/// Returns the bits of coordinates, with the bits of +0 for -0.
pub(super) fn bits<const N: usize>(coordinates: [f32; N]) -> [u32; N] {
    coordinates.map(|x| (x + 0.0).to_bits())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_positions_have_equal_numbers_in_the_order_of_first_occurrence() {
        let weld = Weld::new(&[[1.0, 0.0, 2.0], [3.0; 3], [1.0, -0.0, 2.0], [4.0; 3], [3.0; 3]]);
        assert_eq!([0, 1, 2, 3, 4].map(|index| weld.number(index)), [0, 1, 0, 2, 1]);
        assert_eq!(weld.corners([4, 3, 2]), [1, 2, 0]);
    }
}
