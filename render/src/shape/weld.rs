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

/// Moves vertices of a mesh that are nearer to each other than `distance` to a common place, that of the
/// first of them. Returns how many were moved. `distance` is positive.
pub fn join_near(positions: &mut [[f32; 3]], distance: f64) -> usize {
    // Two places nearer than the side of a cell lie in the same cell or in neighbours.
    let side = 2.0 * distance;
    let mut cells: HashMap<[i64; 3], Vec<[f32; 3]>> = HashMap::new();
    let mut moved = 0;
    for position in positions {
        let place = super::mesh::as_dvec3(*position);
        let cell = [place.x, place.y, place.z].map(|x| (x / side).floor() as i64);
        let near = |offset: usize| {
            let step = [offset % 3, offset / 3 % 3, offset / 9].map(|step| step as i64 - 1);
            let cell = [0, 1, 2].map(|k| cell[k].saturating_add(step[k]));
            let mut others = cells.get(&cell)?.iter().copied();
            others.find(|&other| super::mesh::as_dvec3(other).distance(place) < distance)
        };
        match (0..27).find_map(near) {
            Some(other) => {
                moved += usize::from(bits(other) != bits(*position));
                *position = other;
            }
            None => cells.entry(cell).or_default().push(*position),
        }
    }
    moved
}

/// Returns the bits of coordinates, with the bits of +0 for -0.
pub(super) fn bits<const N: usize>(coordinates: [f32; N]) -> [u32; N] {
    coordinates.map(|x| (x + 0.0).to_bits())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_places_become_one() {
        let mut positions =
            [[1.0, 0.0, 0.0], [1.0, -2e-16, 1e-9], [1.0, 1e-3, 0.0], [1.0, 0.0, 0.0]];
        let apart = positions[2];
        assert_eq!(join_near(&mut positions, 1e-6), 1);
        assert_eq!(positions, [[1.0, 0.0, 0.0], [1.0, 0.0, 0.0], apart, [1.0, 0.0, 0.0]]);
        // On both sides of a cell's border, and far from the origin.
        let mut far = [[1e6, 3.0, 0.0], [1e6, 3.0f32.next_up(), -0.0], [1e6, 3.0, 1.0]];
        assert_eq!(join_near(&mut far, 1e-5), 1);
        assert_eq!(far[0], far[1]);
    }

    #[test]
    fn equal_positions_have_equal_numbers_in_the_order_of_first_occurrence() {
        let weld = Weld::new(&[[1.0, 0.0, 2.0], [3.0; 3], [1.0, -0.0, 2.0], [4.0; 3], [3.0; 3]]);
        assert_eq!([0, 1, 2, 3, 4].map(|index| weld.number(index)), [0, 1, 0, 2, 1]);
        assert_eq!(weld.corners([4, 3, 2]), [1, 2, 0]);
    }
}
