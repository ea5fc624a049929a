//! Nodes that wait for a ray, the nearest last.

use super::node::{Child, Node, WIDTH};

/// Capacity, a power of two and at least [`WIDTH`]. Beyond it a walk recurses.
///
/// If larger, every ray clears memory that it does not use. If smaller, rays recurse in large
/// meshes. Tests use the smallest capacity, so that they recurse.
const CAPACITY: usize = if cfg!(test) { WIDTH } else { 32 };

/// A stack of nodes, each with the distance at which a ray enters its box.
///
/// Both stand in one word: the distance in the upper half, and the child in the lower one. Distances are at
/// least 0, so that their bits are ordered as they are.
#[derive(Debug)]
pub struct Waiting {
    words: [u64; CAPACITY],
    count: usize,
}

impl Waiting {
    /// An empty stack.
    #[must_use]
    #[inline(always)]
    pub fn none() -> Self {
        Self { words: [0; CAPACITY], count: 0 }
    }

    /// Returns whether the children of one more node may not fit.
    #[must_use]
    #[inline(always)]
    pub fn is_full(&self) -> bool {
        self.count + WIDTH > CAPACITY
    }

    #[inline(always)]
    fn push(&mut self, word: u64) {
        self.words[self.count % CAPACITY] = word;
        self.count += 1;
    }

    /// Takes the last child that begins within `limit`, and drops those behind it.
    #[inline(always)]
    pub fn next(&mut self, limit: f32) -> Option<Child> {
        while self.count > 0 {
            self.count -= 1;
            let word = self.words[self.count % CAPACITY];
            if f32::from_bits((word >> 32) as u32) <= limit {
                return Some(Child::of_word(word as u32));
            }
        }
        None
    }

    /// Returns the nearest of the children in a mask, which is not 0, and keeps the others. The stack is not
    /// full.
    ///
    /// Comparisons of a few words without branches are faster than insertions, since a processor cannot
    /// foresee their outcome.
    #[inline(always)]
    pub fn nearest(&mut self, node: &Node, enter: &[f32; WIDTH], mut met: u32) -> Child {
        let a = take(node, enter, &mut met);
        if met == 0 {
            return Child::of_word(a as u32);
        }
        let b = take(node, enter, &mut met);
        let (a, b) = (a.min(b), a.max(b));
        if met == 0 {
            self.push(b);
            return Child::of_word(a as u32);
        }
        let c = take(node, enter, &mut met);
        if met == 0 {
            let (b, c) = (b.min(c), b.max(c));
            let (a, b) = (a.min(b), a.max(b));
            self.push(c);
            self.push(b);
            return Child::of_word(a as u32);
        }
        let d = take(node, enter, &mut met);
        let (c, d) = (c.min(d), c.max(d));
        let (a, c) = (a.min(c), a.max(c));
        let (b, d) = (b.min(d), b.max(d));
        let (b, c) = (b.min(c), b.max(c));
        let first = self.count;
        self.push(d);
        self.push(c);
        self.push(b);
        if met == 0 {
            return Child::of_word(a as u32);
        }
        self.push(a);
        while met != 0 {
            let word = take(node, enter, &mut met);
            let mut at = self.count;
            while at > first && self.words[(at - 1) % CAPACITY] < word {
                self.words[at % CAPACITY] = self.words[(at - 1) % CAPACITY];
                at -= 1;
            }
            self.words[at % CAPACITY] = word;
            self.count += 1;
        }
        self.count -= 1;
        Child::of_word(self.words[self.count % CAPACITY] as u32)
    }
}

/// Takes the first child of a mask out of it, as a word.
#[inline(always)]
fn take(node: &Node, enter: &[f32; WIDTH], met: &mut u32) -> u64 {
    let child = met.trailing_zeros() as usize % WIDTH;
    *met &= *met - 1;
    u64::from(enter[child].to_bits()) << 32 | u64::from(node.children[child].word())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Children come from near to far, whichever of them a ray enters. Those that begin beyond the
        /// limit do not come.
        #[test]
        fn children_come_from_near_to_far(
            enter in prop::array::uniform8(0.0..4.0f32), met in 1u32..256, limit in 0.0..4.0f32,
        ) {
            let mut node = Node::EMPTY;
            node.children = std::array::from_fn(Child::node);
            let mut order: Vec<usize> = (0..WIDTH).filter(|k| met >> k & 1 == 1).collect();
            order.sort_by(|&a, &b| enter[a].total_cmp(&enter[b]));
            let mut waiting = Waiting::none();
            prop_assert_eq!(waiting.nearest(&node, &enter, met).number(), order[0]);
            for &child in order[1..].iter().filter(|&&child| enter[child] <= limit) {
                prop_assert_eq!(waiting.next(limit).map(Child::number), Some(child));
            }
            prop_assert_eq!(waiting.next(limit), None);
        }
    }
}
