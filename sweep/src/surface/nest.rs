//! Loops inside each other: which of them bound an area, and on which side.
//!
//! A point is inside if the loops around it wind about it a number of times that is not 0 (the nonzero rule of SVG), or
//! an odd number of times (the even-odd rule). A loop bounds the area if one of its sides is inside and the other is
//! not. Loops do not cross, so one point of a loop tells which loops are around it.
//!
//! Loops may come in groups, each with its own rule, as the elements of a drawing do. A point inside an odd number of
//! groups is inside. So a circle drawn on a plate is a hole, whatever their rules are.

use glam::DVec2;
use std::collections::BTreeMap;

/// The rule that says which points are inside several loops.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rule {
    /// Points about which the loops wind a number of times that is not 0.
    Nonzero,
    /// Points about which the loops wind an odd number of times.
    EvenOdd,
}

/// The role of a loop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// The inside of the loop is filled, and its outside is not.
    Outline,
    /// The outside of the loop is filled, and its inside is not.
    Hole,
    /// Both sides are filled, or neither is.
    None,
}

/// The loops that one rule decides about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Group {
    /// Number of the group.
    pub number: usize,
    /// The rule of the group; all loops of a group have the same.
    pub rule: Rule,
}

impl Group {
    fn filled(self, times: i32) -> bool {
        match self.rule {
            Rule::Nonzero => times != 0,
            Rule::EvenOdd => times % 2 != 0,
        }
    }
}

/// Returns the role of each loop, given as a polygon with its group.
///
/// # Panics
/// If there are fewer groups than loops.
#[must_use]
pub fn roles(loops: &[Vec<DVec2>], groups: &[Group]) -> Vec<Role> {
    let own: Vec<i32> =
        loops.iter().map(|points| if area(points) < 0.0 { -1 } else { 1 }).collect();
    (0..loops.len())
        .map(|i| {
            let mut times: BTreeMap<usize, (Group, i32)> = BTreeMap::new();
            let around = (0..loops.len()).filter(|&j| j != i && contains(&loops[j], loops[i][0]));
            for j in around {
                times.entry(groups[j].number).or_insert((groups[j], 0)).1 += own[j];
            }
            let here = groups[i];
            let outside = times.remove(&here.number).map_or(0, |(_, times)| times);
            let others = times.values().filter(|(group, times)| group.filled(*times)).count();
            let inside = |times: i32| here.filled(times) != (others % 2 != 0);
            match (inside(outside), inside(outside + own[i])) {
                (false, true) => Role::Outline,
                (true, false) => Role::Hole,
                _ => Role::None,
            }
        })
        .collect()
}

/// Returns the area of a polygon, below 0 if it runs clockwise.
#[must_use]
pub fn area(points: &[DVec2]) -> f64 {
    let next = points.iter().cycle().skip(1);
    0.5 * points
        .iter()
        .zip(next)
        .map(|(a, b)| (*a - points[0]).perp_dot(*b - points[0]))
        .sum::<f64>()
}

/// Returns whether a polygon contains a point, by the crossings of a ray to the right.
#[must_use]
pub fn contains(points: &[DVec2], p: DVec2) -> bool {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).fold(false, |inside, (a, b)| {
        let crosses =
            (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
        inside != crosses
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(half: f64) -> Vec<DVec2> {
        [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]]
            .map(|p| DVec2::from_array(p) * half)
            .to_vec()
    }

    fn roles_by(loops: &[Vec<DVec2>], rule: Rule) -> Vec<Role> {
        roles(loops, &vec![Group { number: 0, rule }; loops.len()])
    }

    #[test]
    fn rules_differ_where_loops_wind_the_same_direction() {
        let backward: Vec<DVec2> = square(1.0).into_iter().rev().collect();
        let same = [square(3.0), square(2.0), square(1.0)];
        assert_eq!(roles_by(&same, Rule::EvenOdd), [Role::Outline, Role::Hole, Role::Outline]);
        assert_eq!(roles_by(&same, Rule::Nonzero), [Role::Outline, Role::None, Role::None]);
        let turned = [square(3.0), backward];
        assert_eq!(roles_by(&turned, Rule::Nonzero), [Role::Outline, Role::Hole]);
        assert_eq!(roles_by(&turned, Rule::EvenOdd), [Role::Outline, Role::Hole]);
    }

    #[test]
    fn a_group_on_another_is_a_hole_of_it() {
        let group = |number: usize, rule: Rule| Group { number, rule };
        let (a, b) = (group(0, Rule::Nonzero), group(1, Rule::Nonzero));
        let loops = [square(4.0), square(3.0), square(2.0), square(1.0)];
        let (outline, hole, none) = (Role::Outline, Role::Hole, Role::None);
        assert_eq!(roles(&loops, &[a, a, b, b]), [outline, none, hole, none]);
        let b = group(1, Rule::EvenOdd);
        assert_eq!(roles(&loops, &[a, a, b, b]), [outline, none, hole, outline]);
        assert_eq!(roles(&loops, &[b, b, a, a]), [outline, hole, outline, none]);
    }
}
