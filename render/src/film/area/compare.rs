//! Estimates of the error of two neighbouring samples from their differences.
//!
//! A sample's footprints assume that everything changes linearly within its cell. Neighbours show
//! where the assumption fails. There are three tests:
//!
//! - **Path**: a leaf of one sample has no partner with the same key in the other. An edge runs
//!   between the two, and a cell that is cut by an edge gets a wrong share of both sides.
//! - **Place**: the texture coordinates of partners differ by something else than the sides of
//!   their footprints predict. The footprint is bent, or it folds.
//! - **Light**: the light on partners changes by a step and not evenly: the edge of a shadow, or a
//!   highlight.
//!
//! The result is an estimate that steers the work. It is no bound: it knows nothing of what lies
//! between the samples.

use super::leaf::{Leaf, Place, size};
use crate::shape::Charts;
use glam::DVec2;

/// Part of the difference across an edge that is the expected error of a cell cut by it. The share
/// of either side is off by up to a half, and by a quarter on average.
const OF_EDGE: f32 = 0.25;

/// Least difference across an edge, relative to the light of the leaves without partner. The edge
/// of two equal averages still hides a change of pattern.
const LEAST_EDGE: f32 = 0.3;

/// Part of the contrast of a texture that is the error of a footprint that is wrong by its own size.
const OF_BEND: f32 = 0.2;

/// Largest relative error of a footprint that counts.
const MOST_BEND: f32 = 2.0;

/// A footprint that is wrong by more than this times its own size is a jump on the texture: the two
/// sides count as two surfaces.
const JUMP: f32 = 1.0;

/// Estimates for two samples, and the change of light between them.
#[derive(Debug, Clone, Copy, Default)]
pub struct Pair {
    /// Estimated errors of both samples' cells, root mean square of linear RGB.
    pub errors: [f32; 2],
    /// The part of both errors that an edge between the samples causes.
    pub edge: f32,
    /// Change of the light on all partners from the first sample to the second, linear RGB.
    pub light: [f32; 3],
}

/// Compares two samples. `across` is the distance from the first to the second sample in cells,
/// `charts` are those of each object.
#[must_use]
pub fn pair(a: &[Leaf], b: &[Leaf], across: DVec2, charts: &[Charts]) -> Pair {
    let mut found = Pair::default();
    if a.is_empty() && b.is_empty() {
        return found;
    }
    // Light without partner: first sample minus second, and the largest of a leaf.
    let (mut apart, mut largest, mut shown) = ([0.0; 3], 0.0_f32, false);
    let mut paired = 0_u64;
    let mut alone = |leaf: &Leaf, sign: f32, most: f32| {
        for (sum, value) in apart.iter_mut().zip(leaf.value) {
            *sum += sign * value;
        }
        largest = largest.max(most);
        shown |= leaf.value != [0.0; 3];
    };
    for (k, leaf) in a.iter().enumerate() {
        let Some(partner) = partner(leaf, k, b) else {
            alone(leaf, 1.0, size(leaf.plain));
            continue;
        };
        if partner < 64 {
            paired |= 1 << partner;
        }
        let other = &b[partner];
        for (sum, (to, from)) in found.light.iter_mut().zip(other.plain.iter().zip(leaf.plain)) {
            *sum += to - from;
        }
        let (Some(from), Some(to)) = (&leaf.place, &other.place) else { continue };
        let contrast = leaf.contrast.max(other.contrast);
        if contrast == 0.0 {
            continue;
        }
        let bends = bends(from, to, across, charts);
        for (error, bend) in found.errors.iter_mut().zip(bends) {
            *error = error.max(OF_BEND * contrast * bend.min(MOST_BEND));
        }
        if bends[0].max(bends[1]) > JUMP {
            alone(leaf, 1.0, contrast);
            alone(other, -1.0, contrast);
        }
    }
    for (k, leaf) in b.iter().enumerate() {
        // Beyond 64 leaves the search is repeated.
        let has_partner = if k < 64 { paired >> k & 1 == 1 } else { partner(leaf, k, a).is_some() };
        if !has_partner {
            alone(leaf, -1.0, size(leaf.plain));
        }
    }
    if shown {
        let edge = OF_EDGE * size(apart).max(LEAST_EDGE * largest);
        found.errors = found.errors.map(|error| error.max(edge));
        found.edge = edge;
    }
    found
}

/// Returns the estimated error of a sample from the changes of light toward it and away from it, on
/// a line of three samples.
#[must_use]
pub fn step(before: [f32; 3], after: [f32; 3]) -> f32 {
    OF_EDGE * size([0, 1, 2].map(|k| after[k] - before[k]))
}

/// Finds the leaf with the key of `leaf`, first at the index `k` where it mostly is.
fn partner(leaf: &Leaf, k: usize, others: &[Leaf]) -> Option<usize> {
    if others.get(k).is_some_and(|other| other.key == leaf.key) {
        return Some(k);
    }
    others.iter().position(|other| other.key == leaf.key)
}

/// Returns by how much the distance of two places on a picture differs from that which the
/// footprint of either predicts, relative to the predicted distance. One texel is added to the
/// predicted distance, since a smaller error shows nothing.
fn bends(from: &Place, to: &Place, across: DVec2, charts: &[Charts]) -> [f32; 2] {
    let charts = &charts[from.object as usize];
    let Some(step) = charts.difference((from.triangle, from.uv), (to.triangle, to.uv)) else {
        return [f32::INFINITY; 2];
    };
    [from, to].map(|place| {
        let predicted = across.x * place.sides[0] + across.y * place.sides[1];
        let wrong = ((step - predicted) * place.texels).length();
        let bend = (wrong / ((predicted * place.texels).length() + 1.0)) as f32;
        // An infinite footprint predicts nothing, and its filter returns the mean.
        if bend.is_nan() { 0.0 } else { bend }
    })
}
