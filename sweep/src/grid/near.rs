//! Points that lie so near to each other that they count as one.

use glam::DVec3;
use std::collections::HashMap;

/// Returns for each point the index of the first point that stands for it: of an earlier point at most `near` away,
/// or its own. `near` is 0 or more, in units of the points.
#[must_use]
pub fn merged(points: &[DVec3], near: f64) -> Vec<usize> {
    // Points at most the side of a cell apart lie in the same cell or in neighbours.
    let mut known: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
    let mut first = Vec::with_capacity(points.len());
    for (index, &point) in points.iter().enumerate() {
        let cell = (point / near).floor().to_array().map(|x| x as i64);
        let around = (0..27).map(|k| [k % 3, k / 3 % 3, k / 9].map(|step| step - 1));
        let found = around
            .filter_map(|step| known.get(&std::array::from_fn(|i| cell[i].wrapping_add(step[i]))))
            .flatten()
            .find(|&&other| points[other].distance(point) <= near);
        if let Some(&other) = found {
            first.push(other);
        } else {
            known.entry(cell).or_default().push(index);
            first.push(index);
        }
    }
    first
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_points_have_the_first_of_them() {
        let along = [0.0, 0.9, 5.0, -0.5, 5.99, 6.5, 0.0];
        let points = along.map(|x| DVec3::new(x, -1e-9, 3.0));
        assert_eq!(merged(&points, 1.0), [0, 0, 2, 0, 2, 5, 0]);
        assert_eq!(merged(&points, 1e-12), [0, 1, 2, 3, 4, 5, 0]);
    }
}
