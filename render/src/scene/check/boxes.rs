//! A tree of boxes, which halves the boxes by count along the longest axis of their middles.
//!
//! The tree has `log2 n` levels for any boxes, so that building takes O(n log n). The cost of a search
//! depends on the number of boxes that it meets. A search counts the boxes that it tests, so that the
//! caller can limit the cost.

use glam::DVec3;
use std::ops::ControlFlow;

/// Lower and upper corner.
pub type Bounds = [DVec3; 2];

/// Boxes in a tree.
#[derive(Debug)]
pub struct Boxes {
    /// Indices of the boxes, in the order of the tree.
    order: Vec<u32>,
    boxes: Vec<Bounds>,
    /// The nodes of the tree, in preorder.
    parts: Vec<Part>,
}

/// A node of the tree.
#[derive(Debug)]
struct Part {
    /// The box around all boxes of the node.
    bounds: Bounds,
    /// Index of the second half; 0 for a leaf. The first half follows its node.
    second: usize,
}

/// Largest number of boxes in a leaf. A larger leaf costs more tests for each search, and a smaller leaf
/// more nodes.
const LEAF: usize = 4;

impl Boxes {
    /// Builds a tree over boxes.
    #[must_use]
    pub fn new(boxes: Vec<Bounds>) -> Self {
        let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
        let mut parts = Vec::new();
        divide(&boxes, &mut order, &mut parts);
        Self { order, boxes, parts }
    }

    /// Calls `see` with the index of each box for which `meets` holds, until `see` breaks. If `meets`
    /// holds for a box, it must hold for every box around this box. Returns the number of boxes that were
    /// tested.
    pub fn search(
        &self,
        meets: impl Fn(&Bounds) -> bool,
        mut see: impl FnMut(u32) -> ControlFlow<()>,
    ) -> u64 {
        let mut looks = 0;
        let mut open = vec![(0..self.order.len(), 0)];
        while let Some((range, part)) = open.pop() {
            looks += 1;
            if range.is_empty() || !meets(&self.parts[part].bounds) {
                continue;
            }
            if range.len() > LEAF {
                let half = range.start + range.len() / 2;
                open.push((half..range.end, self.parts[part].second));
                open.push((range.start..half, part + 1));
                continue;
            }
            for &number in &self.order[range] {
                looks += 1;
                if meets(&self.boxes[number as usize]) && see(number).is_break() {
                    return looks;
                }
            }
        }
        looks
    }
}

fn divide(boxes: &[Bounds], order: &mut [u32], parts: &mut Vec<Part>) {
    let around = |all: Bounds, other: Bounds| [all[0].min(other[0]), all[1].max(other[1])];
    let none = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let own = order.iter().map(|&k| boxes[k as usize]);
    let part = parts.len();
    parts.push(Part { bounds: own.clone().fold(none, around), second: 0 });
    if order.len() <= LEAF {
        return;
    }
    let middle = |[low, high]: Bounds| low.midpoint(high);
    let [low, high] = own.map(|b| [middle(b); 2]).fold(none, around);
    let size = (high - low).to_array();
    let axis = (0..3).max_by(|&a, &b| size[a].total_cmp(&size[b])).unwrap_or(0);
    let half = order.len() / 2;
    let key = |k: &u32| middle(boxes[*k as usize])[axis];
    order.select_nth_unstable_by(half, |a, b| key(a).total_cmp(&key(b)).then(a.cmp(b)));
    let (first, second) = order.split_at_mut(half);
    divide(boxes, first, parts);
    parts[part].second = parts.len();
    divide(boxes, second, parts);
}

/// Returns whether two boxes share a point.
#[must_use]
pub fn touch(a: &Bounds, b: &Bounds) -> bool {
    a[0].cmple(b[1]).all() && b[0].cmple(a[1]).all()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_search_equals_brute_force_and_tests_few_boxes() {
        let part = |i: usize, golden: f64| (i as f64 * golden).fract();
        for count in [0, 1, 4, 5, 1000, 1001] {
            let boxes: Vec<Bounds> = (0..count)
                .map(|i| {
                    let low = DVec3::new(part(i, 0.618_034), part(i, 0.754_877), part(i, 0.569_84));
                    [low, low + 0.05 * part(i, 0.819_17)]
                })
                .collect();
            let tree = Boxes::new(boxes.clone());
            for k in 0..20 {
                let wanted = [DVec3::splat(0.05 * k as f64), DVec3::splat(0.05 * k as f64 + 0.04)];
                let mut found = Vec::new();
                let looks = tree.search(
                    |other| touch(other, &wanted),
                    |number| {
                        found.push(number as usize);
                        ControlFlow::Continue(())
                    },
                );
                found.sort_unstable();
                let all: Vec<usize> = (0..count).filter(|&i| touch(&boxes[i], &wanted)).collect();
                assert_eq!(found, all);
                assert!(looks < 250, "{looks}");
            }
        }
    }
}
