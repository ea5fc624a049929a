//! Surfaces that coincide, of which only one is seen.
//!
//! Equal parallelograms are examined once, however many there are. Other pairs are compared if their
//! planes are near each other, which sorting finds, and if their boxes touch, which a tree finds. The
//! work therefore grows with the number of objects and of coincidences. `MOST_TRIED` bounds the number
//! of coincidences.

use super::boxes::{Boxes, touch};
use super::planes::{self, NEAR};
use super::subject::{Item, Subject};
use super::{Finding, Severity, count};
use crate::shape::{Mesh, Quad, Shape};
use glam::DVec3;
use std::collections::BTreeMap;
use std::ops::ControlFlow;

/// Largest number of pairs that the report names. All other pairs are counted.
const MOST_NAMED: usize = 20;

/// Largest number of other objects that are tried for each flat object, on the average.
///
/// A larger number would make a scene of thousands of intersecting surfaces slow. A smaller number would
/// lower the count of such a scene further below the truth; the report then says "at least".
const MOST_TRIED: u64 = 256;

/// The pairs of surfaces that coincide, and the cost of the search.
#[derive(Debug, Default)]
pub struct Coincidences {
    /// The first pairs in the scene's order, and a remark that counts the other pairs.
    pub findings: Vec<Finding>,
    /// Number of pairs of objects that coincide.
    pub pairs: u64,
    /// Number of boxes and pairs that were tested.
    pub looks: u64,
}

/// Two objects that coincide: the later flat object, and the other object.
struct Pair {
    quad: usize,
    with: With,
}

/// The object with which a flat object coincides, in the order of findings.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum With {
    Flat(usize),
    Triangles { item: usize, count: usize },
}

/// Compares each flat object with all other flat objects and with the triangles of all meshes.
#[must_use]
pub fn findings(subject: &Subject<'_>) -> Coincidences {
    let flat: Vec<(&Item<'_>, &Quad)> = subject
        .items
        .iter()
        .filter_map(|item| match &item.object.shape {
            Shape::Quad(quad) => Some((item, quad)),
            Shape::Sphere(_)
            | Shape::Mesh(_)
            | Shape::Cuboid(_)
            | Shape::Superquadric(_)
            | Shape::Placed(_)
            | Shape::Instance(_) => None,
        })
        .collect();
    let quads: Vec<&Quad> = flat.iter().map(|(_, quad)| *quad).collect();
    let mut search = Search::new(quads.len());
    search.among(&quads);
    for (number, item) in subject.items.iter().enumerate() {
        if let Shape::Mesh(mesh) = &item.object.shape {
            search.on_mesh(&quads, number, mesh);
        }
    }
    let Search { mut named, pairs, looks, .. } = search;
    named.sort_by_key(|pair| (pair.quad, pair.with));
    named.truncate(MOST_NAMED);
    let mut findings: Vec<Finding> = named
        .iter()
        .map(|found| {
            let (item, _) = flat[found.quad];
            match found.with {
                With::Flat(other) => {
                    let (other, _) = flat[other];
                    let what = format!(
                        "the surface lies in the same plane as {} ({}), which is seen",
                        other.path, other.kind
                    );
                    pair(subject, item, other, &what)
                }
                With::Triangles { item: other, count: triangles } => {
                    let what = format!(
                        "{} exactly on {} ({})",
                        count(triangles, "triangle lies", "triangles lie"),
                        item.path,
                        item.kind
                    );
                    on_mesh(subject, &subject.items[other], item, &what)
                }
            }
        })
        .collect();
    let others = pairs - findings.len() as u64;
    if others > 0 {
        let least = if search.exhausted { "at least " } else { "" };
        let message = format!(
            "surfaces coincide in {least}{others} more pairs: of each pair only the first in the \
             scene is seen"
        );
        findings.push(Finding::new(Severity::Remark, "objects", message));
    }
    Coincidences { findings, pairs, looks }
}

/// The pairs found so far.
struct Search {
    /// The first pairs of each flat object, which contain the first pairs of all.
    named: Vec<Pair>,
    pairs: u64,
    looks: u64,
    /// Number of pairs that may still be tried.
    left: u64,
    exhausted: bool,
}

impl Search {
    fn new(count: usize) -> Self {
        let left = MOST_TRIED * (count as u64 + (1 << 12));
        Self { named: Vec::new(), pairs: 0, looks: 0, left, exhausted: false }
    }

    fn found(&mut self, quad: usize, with: With) {
        self.pairs += 1;
        self.name(quad, with);
    }

    /// Keeps a pair as long as it may be among the first pairs.
    fn name(&mut self, quad: usize, with: With) {
        self.named.push(Pair { quad, with });
        if self.named.len() >= 4 * MOST_NAMED {
            self.named.sort_by_key(|pair| (pair.quad, pair.with));
            self.named.truncate(MOST_NAMED);
        }
    }

    /// Counts one tried pair. Returns `false` if no more pairs may be tried.
    fn may_try(&mut self) -> bool {
        self.looks += 1;
        self.exhausted |= self.left == 0;
        self.left = self.left.saturating_sub(1);
        !self.exhausted
    }

    /// Finds flat objects that coincide with flat objects.
    fn among(&mut self, quads: &[&Quad]) {
        // Equal objects form a class: their indices, ascending.
        let mut equal: BTreeMap<planes::Bits, Vec<usize>> = BTreeMap::new();
        for (k, quad) in quads.iter().enumerate() {
            equal.entry(planes::bits(quad)).or_default().push(k);
        }
        let classes: Vec<Vec<usize>> = equal.into_values().collect();
        for class in &classes {
            // An object coincides with itself, and so with its equals, unless its arithmetic fails.
            let quad = quads[class[0]];
            if class.len() > 1 && coplanar(quad, quad) && overlap(quad, quad) {
                self.within(class);
            }
        }
        let first: Vec<&Quad> = classes.iter().map(|class| quads[class[0]]).collect();
        self.looks += (quads.len() + first.len()) as u64;
        for group in planes::near_each_other(&first) {
            let bounds: Vec<_> = group.iter().map(|&k| planes::bounds(first[k])).collect();
            let tree = Boxes::new(bounds.clone());
            for (at, &one) in group.iter().enumerate() {
                let mut met = Vec::new();
                self.looks += tree.search(
                    |other| touch(other, &bounds[at]),
                    |other| {
                        if !self.may_try() {
                            return ControlFlow::Break(());
                        }
                        if other as usize > at {
                            met.push(group[other as usize]);
                        }
                        ControlFlow::Continue(())
                    },
                );
                for other in met {
                    self.between(quads, &classes[one], &classes[other]);
                }
            }
        }
    }

    /// Counts and names the pairs within a class of equal objects.
    fn within(&mut self, class: &[usize]) {
        let count = class.len() as u64;
        self.pairs += count * (count - 1) / 2;
        let firsts = class.iter().take(MOST_NAMED + 1).enumerate();
        for (count, &later) in firsts {
            class[..count].iter().for_each(|&earlier| self.name(later, With::Flat(earlier)));
        }
    }

    /// Counts and names the pairs between two classes, if the classes coincide.
    fn between(&mut self, quads: &[&Quad], one: &[usize], other: &[usize]) {
        // The order matters only for rounding: the later object is compared with the earlier one.
        let (late, early) = (one[0].max(other[0]), one[0].min(other[0]));
        if !(coplanar(quads[late], quads[early]) && overlap(quads[late], quads[early])) {
            return;
        }
        self.pairs += one.len() as u64 * other.len() as u64;
        for &a in one.iter().take(MOST_NAMED + 1) {
            for &b in other.iter().take(MOST_NAMED + 1) {
                self.name(a.max(b), With::Flat(a.min(b)));
            }
        }
    }

    /// Finds the triangles of a mesh that lie in flat objects.
    fn on_mesh(&mut self, quads: &[&Quad], item: usize, mesh: &Mesh) {
        if quads.is_empty() {
            return;
        }
        let numbers = 0..mesh.triangles.len() as u32;
        let corners = |n: u32| mesh.places(n);
        let bounds = |n| {
            let [a, b, c] = corners(n);
            [a.min(b).min(c), a.max(b).max(c)]
        };
        let tree = Boxes::new(numbers.map(bounds).collect());
        let mut left = MOST_TRIED * (quads.len() as u64 + (1 << 12)) + mesh.triangles.len() as u64;
        for (k, quad) in quads.iter().enumerate() {
            let plane = planes::Slab::of(quad);
            let mut count = 0;
            self.looks += tree.search(
                |bounds| plane.meets(bounds),
                |n| {
                    self.looks += 1;
                    if left == 0 {
                        self.exhausted = true;
                        return ControlFlow::Break(());
                    }
                    left -= 1;
                    count += usize::from(lies_in(quad, corners(n)));
                    ControlFlow::Continue(())
                },
            );
            if count > 0 {
                self.found(k, With::Triangles { item, count });
            }
        }
    }
}

/// Describes two surfaces that coincide. The finding is more severe if light should pass from one to
/// the other.
fn pair(subject: &Subject<'_>, item: &Item<'_>, other: &Item<'_>, what: &str) -> Finding {
    if subject.is_clear(item) || subject.is_clear(other) {
        let message = format!(
            "{what}; of the two the first in the scene is seen, and no light goes from one into \
             the other: leave a small gap"
        );
        return Finding::new(Severity::Hint, &item.path, message);
    }
    let message = format!("{what}; of the two only the first in the scene is seen");
    Finding::new(Severity::Remark, &item.path, message)
}

/// Describes triangles on a flat object. Their distances along a ray are rounded in different manners.
fn on_mesh(subject: &Subject<'_>, item: &Item<'_>, flat: &Item<'_>, what: &str) -> Finding {
    if subject.is_clear(item) || subject.is_clear(flat) {
        return pair(subject, item, flat, what);
    }
    let message = format!("{what}; rounding decides at each point which of the two is seen");
    Finding::new(Severity::Hint, &item.path, message)
}

fn coplanar(a: &Quad, b: &Quad) -> bool {
    let size = a.corner().abs().max_element() + b.corner().abs().max_element();
    let normal = planes::normal(a);
    let apart = (b.corner() - a.corner()).dot(normal).abs();
    normal.cross(planes::normal(b)).length() < NEAR && apart <= NEAR * size
}

/// Returns whether two parallelograms in one plane share an area: no side of one separates it from the
/// other.
fn overlap(a: &Quad, b: &Quad) -> bool {
    let (Some(a_corners), Some(b_corners)) = (a.corners(), b.corners()) else {
        return true;
    };
    let across = planes::normal(a);
    let apart = |from: &[DVec3; 4], other: &[DVec3; 4]| {
        (0..4).any(|k| {
            let axis = (from[(k + 1) % 4] - from[k]).cross(across);
            let range = |points: &[DVec3; 4]| {
                let along = points.map(|p| p.dot(axis));
                [
                    along.into_iter().fold(f64::INFINITY, f64::min),
                    along.into_iter().fold(f64::NEG_INFINITY, f64::max),
                ]
            };
            let ([low, high], [other_low, other_high]) = (range(from), range(other));
            let slack = 1e-9 * (high - low);
            high <= other_low + slack || other_high <= low + slack
        })
    };
    !apart(&a_corners, &b_corners) && !apart(&b_corners, &a_corners)
}

/// Returns whether a triangle lies in a flat object.
fn lies_in(quad: &Quad, [a, b, c]: [DVec3; 3]) -> bool {
    let (corner, up) = (quad.corner(), planes::normal(quad));
    let near = |p: DVec3| {
        let size = p.abs().max_element() + corner.abs().max_element();
        (p - corner).dot(up).abs() <= NEAR * size
    };
    let within = quad.bounds().is_none_or(|[low, high]| {
        let middle = (a + b + c) / 3.0;
        let foot = middle - (middle - corner).dot(up) * up;
        let slack = NEAR * (foot.abs().max_element() + 1.0);
        (foot + slack).cmpge(low).all() && (foot - slack).cmple(high).all()
    });
    within && [a, b, c].into_iter().all(near)
}
