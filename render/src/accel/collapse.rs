//! Collapses a binary tree of boxes into one whose nodes have up to eight children.
//!
//! A ray tests the eight boxes of a node at once. Dynamic programming finds the wide tree with the least
//! expected work among all that merge nodes of the binary tree: Ylitie, Karras, Laine, *Efficient
//! Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs*, High Performance Graphics 2017,
//! section 3.1. The leaves stay as they are.

use super::build::{Bounds, Grove, Numbered};
use super::node::{Child, Node, WIDTH};

/// Cost of a test of a leaf, in tests of a node. If larger, nodes have fewer leaves as children.
const LEAF_COST: f32 = 1.0;

/// The least expected work below a node if its parents leave one, two, ... seven children to it, as
/// areas times tests.
pub type Costs = [f32; WIDTH - 1];

/// A node of a binary tree.
#[derive(Debug, Clone, Copy)]
pub struct Binary {
    low: [f32; 3],
    high: [f32; 3],
    /// Distance to the second child in the list of nodes; the first child follows this node. 0 for
    /// a leaf.
    second: u32,
    /// First box of a leaf.
    first: u32,
    /// Number of boxes of a leaf.
    count: u32,
    /// The least expected work.
    pub costs: Costs,
}

impl Binary {
    /// A leaf.
    #[must_use]
    pub fn leaf(bounds: Bounds, first: u32, count: u32) -> Self {
        let (low, high) = (bounds.low.truncate().into(), bounds.high.truncate().into());
        let costs = [LEAF_COST * bounds.half_area(); WIDTH - 1];
        Self { low, high, second: 0, first, count, costs }
    }

    /// A node with two children, whose costs are given.
    #[must_use]
    pub fn pair(bounds: Bounds, second: u32, children: [&Costs; 2]) -> Self {
        let mut own = Self::leaf(bounds, 0, 0);
        own.second = second;
        own.costs[0] = bounds.half_area() + shared(children, WIDTH).1;
        for slots in 2..WIDTH {
            own.costs[slots - 1] = own.costs[slots - 2].min(shared(children, slots).1);
        }
        own
    }
}

/// Distributes slots over two children. Returns the number of slots of the first, and the cost.
fn shared([a, b]: [&Costs; 2], slots: usize) -> (usize, f32) {
    let mut best = (1, f32::INFINITY);
    for own in 1..slots {
        let cost = a[own - 1] + b[slots - own - 1];
        if cost < best.1 {
            best = (own, cost);
        }
    }
    best
}

/// A tree of wide nodes.
#[derive(Debug)]
pub struct Wide {
    /// The root.
    pub root: Child,
    /// Nodes, each before its children.
    pub nodes: Vec<Node>,
    /// Ranges of the boxes of each leaf.
    pub leaves: Vec<std::ops::Range<usize>>,
}

/// Collapses a tree over boxes.
#[must_use]
pub fn collapse(grove: &Grove, boxes: &[Numbered]) -> Wide {
    let binary = &*grove.nodes;
    let mut wide = Wide {
        root: Child::NONE,
        nodes: Vec::with_capacity(binary.len() / 10 + 1),
        leaves: vec![],
    };
    if binary[0].second == 0 {
        wide.root = wide.leaf(&binary[0], boxes);
        return wide;
    }
    // Binary nodes that have no wide node yet, each with the wide node and the child that lead to
    // it.
    let mut open: Vec<(usize, Option<(usize, usize)>)> = vec![(0, None)];
    while let Some((at, parent)) = open.pop() {
        let number = wide.nodes.len();
        match parent {
            Some((node, child)) => wide.nodes[node].children[child] = Child::node(number),
            None => wide.root = Child::node(number),
        }
        let mut members = [0; WIDTH];
        let mut count = 0;
        distribute(binary, at, WIDTH, &mut members, &mut count);
        let mut node = Node::EMPTY;
        for (k, &member) in members[..count].iter().enumerate() {
            let own = &binary[member];
            node.put(k, own.low, own.high);
            if own.second == 0 {
                node.children[k] = wide.leaf(own, boxes);
            }
        }
        // The first child comes next and therefore lies beside its parent.
        for (k, &member) in members[..count].iter().enumerate().rev() {
            if binary[member].second != 0 {
                open.push((member, Some((number, k))));
            }
        }
        wide.nodes.push(node);
    }
    wide
}

/// Collects the children that replace an inner node, at most `slots`.
fn distribute(
    binary: &[Binary],
    at: usize,
    slots: usize,
    members: &mut [usize; WIDTH],
    count: &mut usize,
) {
    let children = [at + 1, at + binary[at].second as usize];
    let (own, _) = shared(children.map(|child| &binary[child].costs), slots);
    for (child, mut slots) in children.into_iter().zip([own, slots - own]) {
        let node = &binary[child];
        while slots > 1 && node.costs[slots - 1] == node.costs[slots - 2] {
            slots -= 1;
        }
        if node.second == 0 || slots == 1 {
            members[*count] = child;
            *count += 1;
        } else {
            distribute(binary, child, slots, members, count);
        }
    }
}

impl Wide {
    /// Adds a leaf.
    fn leaf(&mut self, leaf: &Binary, boxes: &[Numbered]) -> Child {
        let range = leaf.first as usize..(leaf.first + leaf.count) as usize;
        let longest = boxes[range.clone()].iter().map(Numbered::longest).fold(0.0, f32::max);
        self.leaves.push(range);
        Child::leaf(self.leaves.len() - 1, longest)
    }
}
