//! Boxes in another order: parts of the builder's boxes, sorted, halved or divided in two.

use super::build::{Bounds, Numbered};

/// Parts of at most this many boxes are sorted instead of binned. If larger, building takes longer.
/// If smaller, the lower levels, which hold most of the nodes, are cut less well.
pub const SORTED: usize = 12;

/// Returns the order of a small part along an axis. The place of a box is the number of boxes before it,
/// which takes no branches. Equal middles stay in their order.
#[must_use]
pub fn sorted(part: &[Numbered], axis: usize) -> [u8; SORTED] {
    let mut keys = [f32::INFINITY; SORTED];
    for (key, one) in keys.iter_mut().zip(part) {
        *key = one.middle()[axis];
    }
    let mut order = [0; SORTED];
    for (k, own) in keys.iter().enumerate().take(part.len()) {
        let mut before = 0u32;
        for (other, key) in keys.iter().enumerate() {
            before += u32::from((key < own) | ((key == own) & (other < k)));
        }
        order[before as usize % SORTED] = k as u8;
    }
    order
}

/// Returns a copy of a small part.
#[must_use]
pub fn copied(part: &[Numbered]) -> [Numbered; SORTED] {
    let mut copy = [Numbered::NONE; SORTED];
    copy[..part.len()].copy_from_slice(part);
    copy
}

/// Moves the lower half of a part to its front, along the axis on which its middles spread the most.
#[must_use]
pub fn halve(part: &mut [Numbered], middles: &Bounds) -> usize {
    let size = (middles.high - middles.low).to_array();
    let axis = (0..3).max_by(|&a, &b| size[a].total_cmp(&size[b])).unwrap_or(0);
    let key = |one: &Numbered| one.middle()[axis];
    let half = part.len() / 2;
    part.select_nth_unstable_by(half, |a, b| {
        key(a).total_cmp(&key(b)).then(a.number().cmp(&b.number()))
    });
    half
}

/// Moves the boxes for which `is_first` holds to the front. Returns their number, and the results of
/// [`Bounds::of`] for them and for the others.
#[must_use]
pub fn partition(
    part: &mut [Numbered],
    is_first: impl Fn(&Numbered) -> bool,
) -> (usize, [[Bounds; 2]; 2]) {
    let mut at = 0;
    let mut parts = [[Bounds::NONE; 2]; 2];
    for k in 0..part.len() {
        let one = part[k];
        let first = is_first(&one);
        let [all, middles] = &mut parts[usize::from(!first)];
        one.add_to(all);
        middles.add(one.middle(), one.middle());
        if first {
            part.swap(k, at);
            at += 1;
        }
    }
    (at, parts)
}
