//! Divides boxes from the top down into a binary tree.
//!
//! Each part is cut across one axis where the surface area heuristic expects the least work. Parts
//! are sorted into bins by the middles of their boxes: Wald, *On fast Construction of SAH-based
//! Bounding Volume Hierarchies*, IEEE Symposium on Interactive Ray Tracing 2007. Small parts are
//! sorted and tried at every cut. A ray tests all boxes of a leaf at once, so that the expected work
//! counts leaves and not boxes.
//!
//! Large parts are divided by two threads at once. The tree does not depend on the threads, because
//! each part is divided by one thread and the order of its boxes is fixed.
//!
//! **The work is bounded.** Where no plane separates the middles (coincident boxes), and below
//! `Builder::deepest` (boxes whose sizes shrink without end), a part is halved by count. So the tree
//! is at most `3 log2 n` + 8 levels deep, each level looks at each box a fixed number of times, and
//! building takes O(n log n) whatever the boxes are.

use super::bins::{Bins, MOST_BINS};
use super::collapse::{Binary, Costs};
use super::parts::{self, SORTED};
use glam::{DVec3, Vec4};

/// Parts of more boxes than this are divided in parallel. If smaller, threads are started for less
/// work than they cost. If larger, one thread waits for the other.
const PARALLEL: usize = 8192;

/// A box along the axes, with the number of what it surrounds.
///
/// The fourth component of `low` holds the number as bits, below 2^26, so that the bits are those of a
/// finite number. The fourth component of other boxes has no meaning.
#[derive(Debug, Clone, Copy)]
pub struct Numbered {
    low: Vec4,
    high: Vec4,
}

impl Numbered {
    /// A box around the origin, with the number 0.
    pub const NONE: Self = Self { low: Vec4::ZERO, high: Vec4::ZERO };

    /// A box with a number below [`super::node::Child::MOST`].
    #[must_use]
    pub fn new(number: u32, low: [f32; 3], high: [f32; 3]) -> Self {
        let [x, y, z] = low;
        let low = Vec4::new(x, y, z, f32::from_bits(number));
        let [x, y, z] = high;
        Self { low, high: Vec4::new(x, y, z, 0.0) }
    }

    /// The number.
    #[must_use]
    pub fn number(&self) -> u32 {
        self.low.w.to_bits()
    }

    /// Lower and upper corner of the box.
    #[must_use]
    pub fn sides(&self) -> [DVec3; 2] {
        [self.low.truncate().as_dvec3(), self.high.truncate().as_dvec3()]
    }

    /// Enlarges a box so that it contains this one.
    pub fn add_to(&self, bounds: &mut Bounds) {
        bounds.add(self.low, self.high);
    }

    /// The longest side of the box.
    #[must_use]
    pub fn longest(&self) -> f32 {
        (self.high - self.low).truncate().max_element()
    }

    /// Twice the middle of the box, whose corners lie in [-1, 1].
    #[must_use]
    pub fn middle(&self) -> Vec4 {
        self.low + self.high
    }
}

/// A box without a number.
#[derive(Debug, Clone, Copy)]
pub struct Bounds {
    /// Lower corner.
    pub low: Vec4,
    /// Upper corner.
    pub high: Vec4,
}

impl Bounds {
    /// The empty box. Its union with another box is that other box.
    pub const NONE: Self = Self { low: Vec4::INFINITY, high: Vec4::NEG_INFINITY };

    /// Enlarges the box so that it contains another.
    pub fn add(&mut self, low: Vec4, high: Vec4) {
        self.low = self.low.min(low);
        self.high = self.high.max(high);
    }

    /// Half the surface area. The box is not empty.
    #[must_use]
    pub fn half_area(&self) -> f32 {
        let side = self.high - self.low;
        side.x * side.y + side.y * side.z + side.z * side.x
    }

    /// Returns the box around boxes and the box around their middles.
    fn of(part: &[Numbered]) -> [Self; 2] {
        let [mut all, mut middles] = [Self::NONE; 2];
        for one in part {
            all.add(one.low, one.high);
            middles.add(one.middle(), one.middle());
        }
        [all, middles]
    }
}

/// A part of the boxes that is to be divided.
#[derive(Debug)]
struct Part<'a> {
    boxes: &'a mut [Numbered],
    /// Position of the first box among all boxes.
    first: usize,
    bounds: Bounds,
    /// The box around the middles of the boxes.
    middles: Bounds,
    /// Number of cuts that led to the part.
    depth: usize,
}

/// The nodes below a part.
enum Grown {
    /// All nodes, each before its children.
    Nodes(Vec<Binary>),
    /// A node whose children were grown by two threads.
    Pair(Bounds, Box<[Grown; 2]>),
}

/// A binary tree over boxes.
#[derive(Debug)]
pub struct Grove {
    /// Nodes, each before its children, the root first.
    pub nodes: Vec<Binary>,
    /// Number of boxes examined to build the tree; a box counts each time it is examined.
    pub looks: u64,
}

/// Builds a tree over boxes and reorders them, so that each leaf is a range. A leaf holds up to
/// `in_leaf` boxes. There is at least one box.
#[must_use]
pub fn grow(boxes: &mut [Numbered], in_leaf: usize) -> Grove {
    let levels = usize::BITS - boxes.len().leading_zeros();
    let builder = Builder { in_leaf, deepest: 2 * levels as usize + 8 };
    let [bounds, middles] = Bounds::of(boxes);
    let mut looks = boxes.len() as u64;
    let part = Part { boxes, first: 0, bounds, middles, depth: 0 };
    let grown = builder.grow(part, &mut looks);
    let nodes = match grown {
        Grown::Nodes(nodes) => nodes,
        pair @ Grown::Pair(..) => {
            let mut nodes = Vec::with_capacity(pair.count());
            pair.append_to(&mut nodes);
            nodes
        }
    };
    Grove { nodes, looks }
}

impl Grown {
    /// Number of nodes.
    fn count(&self) -> usize {
        match self {
            Self::Nodes(nodes) => nodes.len(),
            Self::Pair(_, children) => 1 + children.iter().map(Self::count).sum::<usize>(),
        }
    }

    /// Appends the nodes and returns the costs of the first.
    fn append_to(self, nodes: &mut Vec<Binary>) -> Costs {
        match self {
            Self::Nodes(own) => {
                let costs = own[0].costs;
                nodes.extend(own);
                costs
            }
            Self::Pair(bounds, children) => {
                let at = nodes.len();
                nodes.push(Binary::leaf(bounds, 0, 0));
                let [a, b] = *children;
                let a = a.append_to(nodes);
                let second = nodes.len() - at;
                let b = b.append_to(nodes);
                nodes[at] = Binary::pair(bounds, second as u32, [&a, &b]);
                nodes[at].costs
            }
        }
    }
}

/// Limits of a tree.
#[derive(Debug, Clone, Copy)]
struct Builder {
    in_leaf: usize,
    /// Parts at this depth or deeper are halved by count.
    deepest: usize,
}

/// A cut across an axis.
#[derive(Debug, Clone, Copy)]
struct Cut {
    cost: f32,
    axis: usize,
    /// The first bin, or the first box in sorted order, of the second part.
    at: usize,
}

impl Cut {
    /// The worst cut.
    const NONE: Self = Self { cost: f32::INFINITY, axis: 0, at: 0 };
}

impl Builder {
    fn grow(self, part: Part<'_>, looks: &mut u64) -> Grown {
        if part.boxes.len() <= PARALLEL {
            let mut nodes = Vec::with_capacity(part.boxes.len());
            self.grow_here(part, &mut nodes, looks);
            return Grown::Nodes(nodes);
        }
        let bounds = part.bounds;
        let [a, b] = self.cut(part, looks);
        let mut others = 0;
        let (a, b) = rayon::join(|| self.grow(a, looks), || self.grow(b, &mut others));
        *looks += others;
        Grown::Pair(bounds, Box::new([a, b]))
    }

    /// Appends the nodes below a part.
    fn grow_here(self, part: Part<'_>, nodes: &mut Vec<Binary>, looks: &mut u64) {
        let (at, bounds) = (nodes.len(), part.bounds);
        nodes.push(Binary::leaf(bounds, part.first as u32, part.boxes.len() as u32));
        if part.boxes.len() <= self.in_leaf {
            return;
        }
        let [a, b] = self.cut(part, looks);
        self.grow_here(a, nodes, looks);
        let second = nodes.len() - at;
        self.grow_here(b, nodes, looks);
        let costs = [&nodes[at + 1].costs, &nodes[at + second].costs];
        nodes[at] = Binary::pair(bounds, second as u32, costs);
    }

    /// Cuts a part of at least two boxes in two.
    fn cut<'a>(self, part: Part<'a>, looks: &mut u64) -> [Part<'a>; 2] {
        let count = part.boxes.len();
        let binned = count > SORTED;
        let cut = if part.depth >= self.deepest {
            Cut::NONE
        } else if binned {
            *looks += 2 * count as u64;
            self.best_binned(&part)
        } else {
            *looks += 4 * count as u64;
            self.best_sorted(part.boxes)
        };
        let Part { boxes, first, middles, depth, .. } = part;
        let mut parts = None;
        let at = if cut.cost.is_infinite() {
            0
        } else if binned {
            let bins = Bins::new([middles.low, middles.high], count);
            let is_first = |one: &Numbered| bins.of_axis(one.middle(), cut.axis) < cut.at;
            let (at, bounds) = parts::partition(boxes, is_first);
            parts = Some(bounds);
            at
        } else {
            let order = parts::sorted(boxes, cut.axis);
            let unsorted = parts::copied(boxes);
            for (one, from) in boxes.iter_mut().zip(order) {
                *one = unsorted[usize::from(from)];
            }
            cut.at
        };
        let at = if (1..count).contains(&at) {
            at
        } else {
            *looks += count as u64;
            parts = None;
            parts::halve(boxes, &middles)
        };
        let (a, b) = boxes.split_at_mut(at);
        let [of_a, of_b] = parts.unwrap_or_else(|| [Bounds::of(a), Bounds::of(b)]);
        let part = |boxes: &'a mut [Numbered], first, [bounds, middles]: [Bounds; 2]| Part {
            boxes,
            first,
            bounds,
            middles,
            depth: depth + 1,
        };
        [part(a, first, of_a), part(b, first + at, of_b)]
    }

    /// Number of leaves for `count` boxes.
    fn leaves(self, count: usize) -> f32 {
        count.div_ceil(self.in_leaf) as f32
    }

    /// Returns the best cut between bins.
    fn best_binned(self, part: &Part<'_>) -> Cut {
        let bins = Bins::new([part.middles.low, part.middles.high], part.boxes.len());
        let mut filled = [[(Bounds::NONE, 0usize); MOST_BINS]; 3];
        for one in part.boxes.iter() {
            let at = bins.of(one.middle());
            for (filled, at) in filled.iter_mut().zip(at) {
                let (all, count) = &mut filled[at];
                all.add(one.low, one.high);
                *count += 1;
            }
        }
        let mut best = Cut::NONE;
        for (axis, filled) in filled.iter().enumerate() {
            let mut second = [(0.0, 0usize); MOST_BINS];
            let (mut all, mut count) = (Bounds::NONE, 0);
            for bin in (1..bins.count).rev() {
                all.add(filled[bin].0.low, filled[bin].0.high);
                count += filled[bin].1;
                second[bin] = (all.half_area(), count);
            }
            let (mut all, mut count) = (Bounds::NONE, 0);
            for at in 1..bins.count {
                all.add(filled[at - 1].0.low, filled[at - 1].0.high);
                count += filled[at - 1].1;
                let (area, others) = second[at];
                if count > 0 && others > 0 {
                    let cost = self.leaves(count) * all.half_area() + self.leaves(others) * area;
                    if cost < best.cost {
                        best = Cut { cost, axis, at };
                    }
                }
            }
        }
        best
    }

    /// Returns the best of all cuts of a small part.
    fn best_sorted(self, part: &[Numbered]) -> Cut {
        let mut best = Cut::NONE;
        let mut areas = [0.0; SORTED];
        for axis in 0..3 {
            let order = parts::sorted(part, axis);
            let boxed = |at: usize| &part[usize::from(order[at])];
            let mut all = Bounds::NONE;
            for at in (1..part.len()).rev() {
                all.add(boxed(at).low, boxed(at).high);
                areas[at] = all.half_area();
            }
            let mut all = Bounds::NONE;
            for (at, area) in areas.iter().enumerate().take(part.len()).skip(1) {
                all.add(boxed(at - 1).low, boxed(at - 1).high);
                let others = self.leaves(part.len() - at) * area;
                let cost = self.leaves(at) * all.half_area() + others;
                if cost < best.cost {
                    best = Cut { cost, axis, at };
                }
            }
        }
        best
    }
}
