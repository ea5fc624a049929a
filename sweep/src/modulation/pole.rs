//! Poles: where a scale of 0 on both axes gathers the contour in a point.
//!
//! Behind a pole that a scale passes with a change of sign the contour is turned by half, which is
//! what factors of -1 on both axes do: its outside stays outside. A change of sign on one axis alone
//! would mirror the contour and turn the surface inside out on its way; there is no outside that
//! both parts share.

use crate::cut::{Side, Stop};
use crate::law::Law;
use glam::DVec2;

/// Zeros of two laws that are this close lie at one place.
const SAME: f64 = 1e-9;

/// A place where both factors are 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pole {
    /// Fraction of the trajectory's length.
    pub at: f64,
    /// The signs of both factors before it.
    before: DVec2,
    /// The signs of both factors after it.
    after: DVec2,
}

/// The signs of a scale along the trajectory.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Signs {
    /// Places at which the signs may change, from 0 to 1.
    ends: Vec<f64>,
    /// The signs between them; 0 where a factor stays 0.
    between: Vec<DVec2>,
    /// The places where both factors are 0.
    poles: Vec<f64>,
}

impl Signs {
    /// The signs of a scale's factors.
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

    /// The first signs of both factors.
    pub(crate) fn first(&self) -> DVec2 {
        let nonzero = |signs: &&DVec2| signs.x * signs.y != 0.0;
        self.between.iter().find(nonzero).copied().unwrap_or(DVec2::ONE)
    }

    /// Where the contour, a mirrored one or one that is not, becomes the other.
    pub(crate) fn inside_out(&self) -> Option<f64> {
        let first = self.first();
        let turned = |signs: &DVec2| signs.x * signs.y * (first.x * first.y) < 0.0;
        self.between.iter().position(turned).map(|piece| self.ends[piece])
    }

    /// The poles, with the signs on both sides; a closed trajectory goes on from 1 at 0.
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
    /// The signs of both factors on the side of a stop at the pole.
    pub(crate) fn signs(&self, stop: Stop) -> DVec2 {
        let before = stop.side == Side::Before || stop.at >= 1.0;
        if before { self.before } else { self.after }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(keys: &[[f64; 2]]) -> Law {
        Law::keys(keys.to_vec(), false)
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
