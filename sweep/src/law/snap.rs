//! Positions of a law that are meant to be one position with another and differ by rounding.

use super::{Form, Law};

/// Positions that differ by less than this fraction of the trajectory's length are meant to be one.
///
/// A person or a program that computes the position of a corner from lengths writes six digits or more. With a
/// larger number, keys between close corners would move. With a smaller number, such a key would lie beside its
/// corner, and the surface would have a sliver of cells between the two.
const MEANT: f64 = 1e-6;

/// A position this close to a kink, as a fraction of the law's range, is at the kink. Rounding of a height is a
/// thousand times smaller.
const AT_KINK: f64 = 1e-12;

impl Law {
    /// Returns the law with each key or joint that lies beside one of the rising `corners` moved onto the corner.
    /// Positions keep their order, and no two become one.
    pub(crate) fn snapped(mut self, corners: &[f64]) -> Self {
        let near = |at: f64| {
            let next = corners.partition_point(|&corner| corner < at);
            let around = corners[next.saturating_sub(1)..(next + 1).min(corners.len())].iter();
            let found = around.copied().min_by(|a, b| (a - at).abs().total_cmp(&(b - at).abs()));
            found.filter(|corner| *corner != at && (corner - at).abs() < MEANT)
        };
        match &mut self.0 {
            Form::Constant(_) => {}
            Form::Keys { keys, .. } => {
                for i in 0..keys.len() {
                    let after = i.checked_sub(1).map_or(f64::NEG_INFINITY, |i| keys[i][0]);
                    let before = keys.get(i + 1).map_or(f64::INFINITY, |key| key[0]);
                    if let Some(corner) = near(keys[i][0]).filter(|at| *at > after && *at < before)
                    {
                        keys[i][0] = corner;
                    }
                }
            }
            Form::Bezier(segments) => {
                for i in 0..segments.len() {
                    let end = segments[i].0[3].x;
                    let low = segments[i].0[2].x;
                    let high = segments.get(i + 1).map_or(f64::INFINITY, |next| next.0[1].x);
                    if let Some(corner) = near(end).filter(|at| *at >= low && *at <= high) {
                        segments[i].0[3].x = corner;
                        if let Some(next) = segments.get_mut(i + 1) {
                            next.0[0].x = corner;
                        }
                    }
                }
            }
        }
        self
    }

    /// Returns the positions of all keys or joints, rising.
    pub(crate) fn joints(&self) -> Vec<f64> {
        match &self.0 {
            Form::Constant(_) => Vec::new(),
            Form::Keys { keys, .. } => keys.iter().map(|key| key[0]).collect(),
            Form::Bezier(segments) => {
                segments.iter().flat_map(|segment| [segment.0[0].x, segment.0[3].x]).collect()
            }
        }
    }

    /// Returns the kink at a position that equals the kink up to rounding; otherwise the position itself.
    pub(crate) fn at_kink(&self, at: f64) -> f64 {
        let same = |end: f64| (end - at).abs() < AT_KINK;
        let ends = |next: usize, count: usize| next.saturating_sub(1)..(next + 1).min(count);
        match &self.0 {
            Form::Constant(_) => None,
            Form::Keys { keys, .. } => {
                let next = keys.partition_point(|key| key[0] < at);
                keys[ends(next, keys.len())].iter().map(|key| key[0]).find(|&end| same(end))
            }
            Form::Bezier(segments) => {
                let next = segments.partition_point(|segment| segment.0[3].x < at);
                let near = segments[ends(next, segments.len())].iter();
                near.flat_map(|segment| [segment.0[0].x, segment.0[3].x]).find(|&end| same(end))
            }
        }
        .unwrap_or(at)
    }
}

#[cfg(test)]
mod tests {
    use crate::law::{Ease, Law};

    #[test]
    fn keys_beside_a_corner_move_onto_it_and_others_stay() {
        let third = 1.0 / 3.0;
        let law = Law::keys(vec![[0.0, 1.0], [0.333_333_3, 2.0], [0.5, 3.0]], Ease::Linear);
        assert_eq!(law.snapped(&[third, 0.7]).kinks(), [third, 0.5]);
        let law = Law::keys(vec![[0.2, 1.0], [0.2 + 1e-9, 2.0]], Ease::Linear);
        assert_eq!(law.clone().snapped(&[0.2 + 5e-10]).kinks().len(), 2);
    }

    #[test]
    fn a_position_beside_a_kink_is_at_the_kink() {
        let law = Law::keys(vec![[0.0, 1.0], [0.25, 2.0], [1.0, 3.0]], Ease::Linear);
        assert_eq!(law.at_kink(0.25 + 1e-15), 0.25);
        assert_eq!(law.at_kink(1.0 - 1e-15), 1.0);
        assert_eq!(law.at_kink(0.3), 0.3);
    }
}
