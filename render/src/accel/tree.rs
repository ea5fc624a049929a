//! A bounding volume hierarchy of nodes with up to eight children, and the walk of a ray.
//!
//! [`super::build`] divides the boxes, [`super::collapse`] merges the binary nodes. Wald, Benthin,
//! Boulos, *Getting Rid of Packets*, IEEE Symposium on Interactive Ray Tracing 2008: one ray tests all
//! children of a node at once, and visits those that it meets from near to far.

use super::build::{self, Numbered};
use super::collapse::{self, Wide};
use super::frame::{Frame, TreeRay};
use super::kernel::Kernel;
use super::node::{Child, Node};
use super::pages;
use super::waiting::Waiting;
use crate::ray::Ray;
use glam::DVec3;
use std::ops::Range;

/// A tree over boxes.
#[derive(Debug)]
pub struct Tree {
    /// The box around all boxes.
    pub bounds: [DVec3; 2],
    /// The coordinates of the tree.
    pub frame: Frame,
    root: Child,
    nodes: Vec<Node>,
    looks: u64,
}

/// The leaves of a tree, visited by a ray.
pub trait Leaves {
    /// Visits a leaf. Takes the distance up to which hits count, and returns the next one. `limit` is
    /// the same distance in the tree.
    fn visit<K: Kernel>(
        &mut self,
        kernel: K,
        leaf: Child,
        ray: &TreeRay,
        limit: f32,
        t_max: f64,
    ) -> f64;
}

impl Tree {
    /// Builds a tree over boxes in its frame, all of which lie in `bounds`. Leaves hold up to
    /// `in_leaf` boxes. Reorders the boxes, and returns the tree and the range of each leaf's boxes.
    /// There is at least one box.
    #[must_use]
    pub fn build(
        bounds: [DVec3; 2],
        frame: Frame,
        boxes: &mut [Numbered],
        in_leaf: usize,
    ) -> (Self, Vec<Range<usize>>) {
        let grove = build::grow(boxes, in_leaf);
        let Wide { root, nodes: grown, leaves } = collapse::collapse(&grove, boxes);
        let mut nodes = pages::vector(grown.len());
        nodes.extend_from_slice(&grown);
        (Self { bounds, frame, root, nodes, looks: grove.looks }, leaves)
    }

    /// The root.
    #[must_use]
    #[inline(always)]
    pub fn root(&self) -> Child {
        self.root
    }

    /// The node of a child that is no leaf.
    #[must_use]
    #[inline(always)]
    pub fn node(&self, child: Child) -> &Node {
        &self.nodes[child.number()]
    }

    /// Number of boxes examined to build the tree; a box counts each time it is examined.
    #[must_use]
    pub fn looks(&self) -> u64 {
        self.looks
    }

    /// Memory of the nodes, in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes)
    }

    /// Visits every leaf with a box that the ray may meet within `t_max`, nearer ones first as far as
    /// the tree can tell. Returns the last `t_max` of the leaves. `extent` is that of
    /// [`super::slabs::SlabRay::new`].
    #[inline(always)]
    pub fn walk<K: Kernel>(
        &self,
        kernel: K,
        (ray, extent): (&Ray, f64),
        t_max: f64,
        leaves: &mut impl Leaves,
    ) -> f64 {
        match TreeRay::new(&self.frame, self.bounds, ray, extent) {
            Some(ray) => self.walk_from(kernel, self.root, &ray, t_max, leaves),
            None => t_max,
        }
    }

    /// Walks a deep part of the tree with a new stack.
    #[cold]
    #[inline(never)]
    fn walk_deeper<K: Kernel>(
        &self,
        kernel: K,
        start: Child,
        ray: &TreeRay,
        t_max: f64,
        leaves: &mut impl Leaves,
    ) -> f64 {
        self.walk_from(kernel, start, ray, t_max, leaves)
    }

    /// Visits the leaves below `start` as [`Tree::walk`] does.
    #[inline(always)]
    pub fn walk_from<K: Kernel>(
        &self,
        kernel: K,
        start: Child,
        ray: &TreeRay,
        mut t_max: f64,
        leaves: &mut impl Leaves,
    ) -> f64 {
        let mut limit = ray.distance(t_max);
        let mut waiting = Waiting::none();
        let mut current = start;
        loop {
            if current.is_leaf() {
                let next = leaves.visit(kernel, current, ray, limit, t_max);
                if next != t_max {
                    t_max = next;
                    limit = ray.distance(t_max);
                }
            } else if waiting.is_full() {
                // The tree is deeper than the stack.
                // A copy keeps the ray itself in registers.
                let copy = *ray;
                t_max = self.walk_deeper(kernel, current, &copy, t_max, leaves);
                limit = ray.distance(t_max);
            } else {
                let node = &self.nodes[current.number()];
                let (enter, met) = kernel.boxes(node, ray, limit);
                if met != 0 {
                    current = waiting.nearest(node, &enter, met);
                    continue;
                }
            }
            match waiting.next(limit) {
                Some(next) => current = next,
                None => return t_max,
            }
        }
    }
}
