//! Poles: positions where a scale of 0 on both axes contracts the contour to a point.
//!
//! If both factors change sign at a pole, the contour behind the pole is turned by half a turn, as factors of
//! -1 on both axes do. Its outside stays outside. If one factor alone changed sign, it would mirror the
//! contour and turn the surface inside out. The parts before and after would then have no common outside.

use crate::curve::cut::{Side, Stop};
use crate::law::Law;
use glam::DVec2;

/// Zeros of two laws whose positions differ by at most this are one zero.
const SAME: f64 = 1e-9;

/// A position where both factors are 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pole {
    /// Position as a fraction of the trajectory's length.
    pub at: f64,
    /// Signs of both factors before the pole.
    before: DVec2,
    /// Signs of both factors after the pole.
    after: DVec2,
}

/// Signs of a scale's factors along the trajectory.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Signs {
    /// Positions at which the signs may change, from 0 to 1, rising.
    ends: Vec<f64>,
    /// Signs in each interval between two `ends`; 0 where a factor stays 0.
    between: Vec<DVec2>,
    /// Positions where both factors are 0.
    poles: Vec<f64>,
}

impl Signs {
    /// Finds the signs of the factors of x and y.
    pub(crate) fn of([x, y]: &[Law; 2]) -> Self {
        let (x_zeros, y_zeros) = (x.zeros(), y.zeros());
        let near = |zeros: &[f64], at: f64| zeros.iter().any(|zero| (zero - at).abs() <= SAME);
        let mut ends: Vec<f64> =
            x_zeros.iter().chain(&y_zeros).copied().chain([0.0, 1.0]).collect();
        ends.sort_by(f64::total_cmp);
        ends.dedup_by(|later, earlier| *later - *earlier <= SAME);
        if let Some(last) = ends.last_mut() {
            *last = 1.0;
        }
        let sign = |law: &Law, at: f64| {
            let value = law.at(at).0;
            if value == 0.0 { 0.0 } else { value.signum() }
        };
        let between = ends
            .windows(2)
            .map(|pair| 0.5 * (pair[0] + pair[1]))
            .map(|at| DVec2::new(sign(x, at), sign(y, at)))
            .collect();
        let both = |at: &f64| near(&x_zeros, *at) && near(&y_zeros, *at);
        let poles = ends.iter().copied().filter(both).collect();
        Self { ends, between, poles }
    }

    /// Returns the signs in the first interval where neither factor is 0.
    pub(crate) fn first(&self) -> DVec2 {
        let nonzero = |signs: &&DVec2| signs.x * signs.y != 0.0;
        self.between.iter().find(nonzero).copied().unwrap_or(DVec2::ONE)
    }

    /// Returns the position where a mirrored contour becomes one that is not mirrored, or the reverse, if
    /// any.
    pub(crate) fn inside_out(&self) -> Option<f64> {
        let first = self.first();
        let turned = |signs: &DVec2| signs.x * signs.y * (first.x * first.y) < 0.0;
        self.between.iter().position(turned).map(|piece| self.ends[piece])
    }

    /// Returns the poles with the signs on both sides. Before a pole at 0 of a closed trajectory come the
    /// signs at its end.
    pub(crate) fn poles(&self, closed: bool) -> Vec<Pole> {
        let last = self.between.len() - 1;
        let pole = |&at: &f64| {
            let after = self.ends.partition_point(|&end| end <= at).clamp(1, last + 1) - 1;
            let before = self.ends.partition_point(|&end| end < at);
            let before = match before {
                0 if closed => last,
                0 => after,
                _ => before - 1,
            };
            Pole { at, before: self.between[before], after: self.between[after] }
        };
        self.poles.iter().map(pole).collect()
    }
}

impl Pole {
    /// Returns the signs of both factors on the side that the stop names.
    pub(crate) fn signs(&self, stop: Stop) -> DVec2 {
        let before = stop.side == Side::Before || stop.at >= 1.0;
        if before { self.before } else { self.after }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::Ease;

    fn keys(keys: &[[f64; 2]]) -> Law {
        Law::keys(keys.to_vec(), Ease::Linear)
    }

    #[test]
    fn a_pole_knows_the_signs_on_both_its_sides() {
        let law = keys(&[[0.0, 0.0], [0.25, 1.0], [0.75, -1.0], [1.0, 0.0]]);
        let signs = Signs::of(&[law.clone(), law]);
        assert_eq!(signs.inside_out(), None);
        let poles = signs.poles(false);
        let (plus, minus) = (DVec2::ONE, DVec2::NEG_ONE);
        let expected = [(0.0, plus, plus), (0.5, plus, minus), (1.0, minus, minus)];
        assert_eq!(poles, expected.map(|(at, before, after)| Pole { at, before, after }));
        assert_eq!(signs.poles(true)[0].before, minus);
    }

    #[test]
    fn a_change_of_one_sign_turns_inside_out() {
        let (up, down) = (keys(&[[0.0, -1.0], [1.0, 1.0]]), keys(&[[0.0, 1.0], [1.0, -1.0]]));
        assert_eq!(Signs::of(&[up.clone(), Law::constant(1.0)]).inside_out(), Some(0.5));
        assert_eq!(Signs::of(&[up.clone(), down]).inside_out(), None);
        assert_eq!(Signs::of(&[up, Law::constant(0.0)]).inside_out(), None);
    }
}
