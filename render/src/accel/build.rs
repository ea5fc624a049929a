//! Divides boxes from the top down into a binary tree.
//!
//! Each part is cut across one axis where the surface area heuristic expects the least work: after
//! Wald, *On fast Construction of SAH-based Bounding Volume Hierarchies*, IEEE Symposium on
//! Interactive Ray Tracing 2007. Large parts are sorted into bins by the middles of their boxes, small
//! ones are sorted and tried at every cut.
//!
//! **The work is bounded.** Where no plane separates the middles (coincident boxes), and below
//! `Builder::deepest` (boxes whose sizes shrink without end), a part is halved by count. So the tree
//! is at most `3 log2 n` + 8 levels deep, each level looks at each box a fixed number of times, and
//! building takes O(n log n) whatever the boxes are.

use glam::{DVec3, Vec3A};

/// Largest number of boxes in a leaf.
///
/// If larger, rays try pieces that a further cut would have kept from them. If smaller, the tree
/// takes more memory for no fewer tests.
const MOST_IN_LEAF: usize = 4;

/// Cost of a test of two sibling boxes, in tests of a piece.
///
/// If larger, leaves grow. If smaller, rays pass more nodes than there are pieces to try.
const STEP_COST: f64 = 1.0;

/// Bins along each axis. More bins take longer and hardly find better cuts.
const BINS: usize = 32;

/// Parts of at most this many boxes are sorted instead of binned. If larger, building takes longer.
/// If smaller, the lower levels, which hold most of the nodes, are cut less well.
const SORTED: usize = 64;

/// A box along the axes in `f32`.
#[derive(Debug, Clone, Copy)]
pub struct Bounds {
    /// Lower corner.
    pub low: Vec3A,
    /// Upper corner.
    pub high: Vec3A,
}

impl Bounds {
    /// The empty box. Its union with another box is that other box.
    const NONE: Self = Self { low: Vec3A::INFINITY, high: Vec3A::NEG_INFINITY };

    /// The smallest box of `f32` around a box of `f64`.
    #[must_use]
    pub fn around([low, high]: [DVec3; 2]) -> Self {
        let down =
            |x: f64| if f64::from(x as f32) <= x { x as f32 } else { (x as f32).next_down() };
        let up = |x: f64| if f64::from(x as f32) >= x { x as f32 } else { (x as f32).next_up() };
        Self {
            low: Vec3A::new(down(low.x), down(low.y), down(low.z)),
            high: Vec3A::new(up(high.x), up(high.y), up(high.z)),
        }
    }

    fn join(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Half the surface area, in `f64`, where no side of an `f32` box overflows; 0 for the empty
    /// box.
    #[must_use]
    pub fn half_area(&self) -> f64 {
        let [x, y, z] = (self.high - self.low).to_array().map(|side| f64::from(side.max(0.0)));
        x * y + y * z + z * x
    }

    /// Twice the middle of the box.
    fn middle(&self) -> Vec3A {
        self.low + self.high
    }
}

/// The decision about a part of the boxes.
#[derive(Debug, Clone, Copy)]
pub enum Part {
    /// The part becomes a leaf.
    Leaf,
    /// The part is cut in two: the boxes before this position and those from it on, with their
    /// bounds.
    Cut(usize, [Bounds; 2]),
}

/// Divides one set of boxes into parts.
#[derive(Debug)]
pub struct Builder<'a> {
    boxes: &'a [Bounds],
    /// Parts at this depth or deeper are halved by count.
    deepest: usize,
    /// Number of boxes examined so far; a box counts each time it is examined.
    pub looks: u64,
}

/// A cut across an axis.
#[derive(Debug, Clone, Copy)]
struct Cut {
    cost: f64,
    axis: usize,
    /// The first bin, or the first box in sorted order, of the second part.
    at: usize,
}

impl<'a> Builder<'a> {
    /// Creates a builder over `boxes`.
    #[must_use]
    pub fn new(boxes: &'a [Bounds]) -> Self {
        let levels = usize::BITS - boxes.len().leading_zeros();
        Self { boxes, deepest: 2 * levels as usize + 8, looks: 0 }
    }

    /// Divides the boxes whose numbers are in `part`, and reorders `part`. `bounds` surrounds these
    /// boxes, and `depth` is the number of cuts that led to them.
    pub fn divide(&mut self, part: &mut [u32], bounds: &Bounds, depth: usize) -> Part {
        let count = part.len();
        if count == 1 {
            return Part::Leaf;
        }
        self.looks += count as u64;
        let spread = part.iter().fold(Bounds::NONE, |spread, &k| {
            let middle = self.boxes[k as usize].middle();
            spread.join(Bounds { low: middle, high: middle })
        });
        let cut = if depth >= self.deepest {
            None
        } else if count <= SORTED {
            self.best_sorted(part)
        } else {
            self.best_binned(part, &spread)
        };
        let cut = cut.filter(|cut| cut.cost.is_finite());
        // The saving of a cut is measured against trying all boxes.
        let area = bounds.half_area();
        let worth_it = |cut: &Cut| STEP_COST * area + cut.cost < count as f64 * area;
        if count <= MOST_IN_LEAF && !cut.as_ref().is_some_and(worth_it) {
            return Part::Leaf;
        }
        let at = match cut {
            Some(cut) if count <= SORTED => {
                self.sort(part, cut.axis);
                cut.at
            }
            Some(cut) => {
                let bins = Bins::new(&spread, cut.axis);
                let in_first = |&k: &u32| bins.of(&self.boxes[k as usize]) < cut.at;
                partition(part, in_first)
            }
            None => 0,
        };
        let at = if (1..count).contains(&at) { at } else { self.halve(part, &spread) };
        self.looks += count as u64;
        let around = |part: &[u32]| {
            part.iter().fold(Bounds::NONE, |all, &k| all.join(self.boxes[k as usize]))
        };
        Part::Cut(at, [around(&part[..at]), around(&part[at..])])
    }

    /// Returns the best cut between bins, or `None` if all middles coincide.
    fn best_binned(&mut self, part: &[u32], spread: &Bounds) -> Option<Cut> {
        self.looks += part.len() as u64;
        let axes = [0, 1, 2].map(|axis| Bins::new(spread, axis));
        let mut filled = [[(Bounds::NONE, 0u32); BINS]; 3];
        for &k in part {
            let bounds = self.boxes[k as usize];
            for (bins, filled) in axes.iter().zip(&mut filled) {
                let (all, count) = &mut filled[bins.of(&bounds)];
                *all = all.join(bounds);
                *count += 1;
            }
        }
        let mut best: Option<Cut> = None;
        for (axis, filled) in filled.iter().enumerate() {
            if axes[axis].scale == 0.0 {
                continue;
            }
            let mut second = [(0.0, 0u32); BINS];
            let (mut all, mut count) = (Bounds::NONE, 0);
            for bin in (1..BINS).rev() {
                all = all.join(filled[bin].0);
                count += filled[bin].1;
                second[bin] = (all.half_area(), count);
            }
            let (mut all, mut count) = (Bounds::NONE, 0);
            for at in 1..BINS {
                all = all.join(filled[at - 1].0);
                count += filled[at - 1].1;
                let (area, others) = second[at];
                if count == 0 || others == 0 {
                    continue;
                }
                let cost = f64::from(count) * all.half_area() + f64::from(others) * area;
                if best.is_none_or(|best| cost < best.cost) {
                    best = Some(Cut { cost, axis, at });
                }
            }
        }
        best
    }

    /// Returns the best of all cuts of a small part.
    fn best_sorted(&mut self, part: &mut [u32]) -> Option<Cut> {
        let mut best: Option<Cut> = None;
        let mut areas = [0.0; SORTED];
        for axis in 0..3 {
            self.sort(part, axis);
            let mut all = Bounds::NONE;
            for at in (1..part.len()).rev() {
                all = all.join(self.boxes[part[at] as usize]);
                areas[at] = all.half_area();
            }
            let mut all = Bounds::NONE;
            for at in 1..part.len() {
                all = all.join(self.boxes[part[at - 1] as usize]);
                let cost = at as f64 * all.half_area() + (part.len() - at) as f64 * areas[at];
                if best.is_none_or(|best| cost < best.cost) {
                    best = Some(Cut { cost, axis, at });
                }
            }
        }
        best
    }

    /// Sorts a small part along an axis.
    fn sort(&mut self, part: &mut [u32], axis: usize) {
        self.looks += part.len() as u64;
        let key = |k: &u32| self.boxes[*k as usize].middle()[axis];
        part.sort_unstable_by(|a, b| key(a).total_cmp(&key(b)).then(a.cmp(b)));
    }

    /// Moves the lower half of a part to its front, along the axis on which its middles spread the
    /// most.
    fn halve(&mut self, part: &mut [u32], spread: &Bounds) -> usize {
        self.looks += part.len() as u64;
        let size = (spread.high - spread.low).to_array();
        let axis = (0..3).max_by(|&a, &b| size[a].total_cmp(&size[b])).unwrap_or(0);
        let key = |k: &u32| self.boxes[*k as usize].middle()[axis];
        let half = part.len() / 2;
        part.select_nth_unstable_by(half, |a, b| key(a).total_cmp(&key(b)).then(a.cmp(b)));
        half
    }
}

/// Equal bins along one axis.
#[derive(Debug, Clone, Copy)]
struct Bins {
    axis: usize,
    low: f32,
    /// Bins per unit of length; 0 if all middles coincide.
    scale: f32,
}

impl Bins {
    fn new(spread: &Bounds, axis: usize) -> Self {
        let size = spread.high[axis] - spread.low[axis];
        let scale = BINS as f32 / size;
        let scale = if size > 0.0 && scale.is_finite() { scale } else { 0.0 };
        Self { axis, low: spread.low[axis], scale }
    }

    /// Returns the bin of a box. The conversion turns negative values and NaN into 0.
    fn of(&self, bounds: &Bounds) -> usize {
        let place = (bounds.middle()[self.axis] - self.low) * self.scale;
        (place as usize).min(BINS - 1)
    }
}

/// Moves the elements for which `is_first` holds to the front, in any order, and returns their
/// number.
fn partition(part: &mut [u32], is_first: impl Fn(&u32) -> bool) -> usize {
    let mut at = 0;
    for k in 0..part.len() {
        if is_first(&part[k]) {
            part.swap(k, at);
            at += 1;
        }
    }
    at
}
