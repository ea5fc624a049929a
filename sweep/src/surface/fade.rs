//! The part of a contour that a relief covers, and where it fades.
//!
//! A relief fades to nothing at corners, where it would tear the surface, at the axis of a rotation, where all rows share
//! a point, and at rims. With the distance `x` from such a stop over the length of the fade, the relief is multiplied by
//! `3 x^2 - 2 x^3` for `x` below 1. At the stop both the factor and its derivative are 0, so points and normals there are
//! those of the contour alone. A piece shorter than two fades is covered from its middle outward.

/// The covered part of a contour.
#[derive(Debug, Clone, PartialEq)]
pub struct Cover {
    /// The covered part, as fractions of the length; a picture spans it.
    range: [f64; 2],
    pieces: Vec<Piece>,
}

/// A piece between two stops. That of a closed contour may reach over 1.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Piece {
    from: f64,
    to: f64,
    /// Length of the fade at the start and at the end; 0 for none.
    fades: [f64; 2],
}

/// A position on a covered contour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Covered {
    /// Position on the covered part, as a fraction of its length.
    pub u: f64,
    /// Derivative of that position by the position on the contour.
    pub rate: f64,
    /// Factor of the relief.
    pub factor: f64,
    /// Derivative of the factor by the position on the contour.
    pub factor_u: f64,
}

impl Cover {
    /// Returns a cover of a range, with fades of this length at `stops`, which rise from the start of the range to its
    /// end. All lengths are fractions of the contour's. `ends` says whether the relief fades at the ends of the range. A
    /// `closed` contour that is covered all around has stops only inside.
    #[must_use]
    pub fn new(range: [f64; 2], stops: &[f64], ends: [bool; 2], closed: bool, fade: f64) -> Self {
        let inner = stops.iter().copied().filter(|&at| at > range[0] && at < range[1]);
        let mut marks: Vec<(f64, bool)> = inner.map(|at| (at, true)).collect();
        if closed && range == [0.0, 1.0] {
            if stops.first() == Some(&0.0) {
                marks.insert(0, (0.0, true));
            }
            if let Some(first) = marks.first().copied() {
                marks.push((first.0 + 1.0, true));
            }
        } else {
            marks.insert(0, (range[0], ends[0]));
            marks.push((range[1], ends[1]));
        }
        let piece = |pair: &[(f64, bool)]| {
            let [(from, starts), (to, stops)] = [pair[0], pair[1]];
            let most = 0.5 * (to - from);
            let length = |is: bool| if is { fade.min(most) } else { 0.0 };
            Piece { from, to, fades: [length(starts), length(stops)] }
        };
        Self { range, pieces: marks.windows(2).map(piece).collect() }
    }

    /// Returns whether the relief fades anywhere.
    #[must_use]
    pub fn fades(&self) -> bool {
        self.pieces.iter().any(|piece| piece.fades != [0.0; 2])
    }

    /// Returns the covered part of the contour's length.
    #[must_use]
    pub fn part(&self) -> f64 {
        self.range[1] - self.range[0]
    }

    /// Returns the position on the cover; `None` beside it.
    pub(crate) fn at(&self, u: f64) -> Option<Covered> {
        let [from, to] = self.range;
        if u < from || u > to {
            return None;
        }
        let rate = 1.0 / (to - from);
        let mut covered = Covered { u: (u - from) * rate, rate, factor: 1.0, factor_u: 0.0 };
        let Some(first) = self.pieces.first() else { return Some(covered) };
        let around = if u < first.from { u + 1.0 } else { u };
        let next = self.pieces.partition_point(|piece| piece.to < around);
        let Some(piece) = self.pieces.get(next) else { return Some(covered) };
        for (distance, fade, sign) in
            [(around - piece.from, piece.fades[0], 1.0), (piece.to - around, piece.fades[1], -1.0)]
        {
            if fade > 0.0 && distance < fade {
                let x = (distance / fade).max(0.0);
                covered.factor = x * x * (3.0 - 2.0 * x);
                covered.factor_u = sign * 6.0 * x * (1.0 - x) / fade;
            }
        }
        Some(covered)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_relief_fades_at_its_stops_and_nowhere_else() {
        let cover = Cover::new([0.0, 1.0], &[0.4], [false, true], false, 0.1);
        let factor = |u: f64| cover.at(u).unwrap().factor;
        assert_eq!(
            [0.0, 0.2, 0.3, 0.4, 0.5, 0.9, 1.0].map(factor),
            [1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 0.0]
        );
        assert!((factor(0.35) - 0.5).abs() < 1e-12 && (factor(0.95) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn a_closed_contour_is_covered_over_its_start() {
        let cover = Cover::new([0.0, 1.0], &[0.2, 0.7], [false; 2], true, 0.1);
        let factor = |u: f64| cover.at(u).unwrap().factor;
        assert_eq!([0.0, 0.2, 0.45, 0.7, 0.95, 1.0].map(factor), [1.0, 0.0, 1.0, 0.0, 1.0, 1.0]);
        assert!((factor(0.75) - 0.5).abs() < 1e-12 && (factor(0.15) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn slopes_agree_with_differences_and_a_part_has_its_own_positions() {
        let cover = Cover::new([0.2, 0.7], &[0.3], [true; 2], true, 0.1);
        assert_eq!((cover.at(0.1), cover.at(0.8)), (None, None));
        let h = 1e-6;
        for i in 1..200 {
            let u = 0.2 + 0.5 * (f64::from(i) + 0.3) / 200.5;
            let [low, here, high] = [u - h, u, u + h].map(|u| cover.at(u).unwrap());
            let slope = (high.factor - low.factor) / (2.0 * h);
            // The third derivative of the factor, 12 over the cubed fade of 0.05, is below 1e5.
            assert!((here.factor_u - slope).abs() < 1e-6, "{u}: {} {slope}", here.factor_u);
            assert!((here.u - (u - 0.2) * 2.0).abs() < 1e-12 && (here.rate - 2.0).abs() < 1e-12);
        }
    }
}
