//! Division of a curve into cells: the rows of a trajectory, the columns of a contour.
//!
//! A curve has smooth pieces that end at *breaks*: creases of a contour, corners of a trajectory. A break has
//! two stops, one for each side, so that the surface has the directions of both sides there.

/// A position on a curve, and the side from which it is approached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Arc length from the start, as a fraction of the whole, in `[0, 1]`.
    pub at: f64,
    /// The side that counts where the curve has a break; elsewhere both sides are equal.
    pub side: Side,
}

/// A side of a position, in the direction of the curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The side that leads up to the position.
    Before,
    /// The side that continues from the position.
    After,
}

impl Stop {
    /// Returns a stop on the side before a position.
    #[must_use]
    pub fn before(at: f64) -> Self {
        Self { at, side: Side::Before }
    }

    /// Returns a stop on the side after a position.
    #[must_use]
    pub fn after(at: f64) -> Self {
        Self { at, side: Side::After }
    }
}

/// Positions on a curve whose distance is below this fraction of its length are one position.
///
/// Positions are sums of a few fractions and agree to some 1e-15. With a smaller number, the
/// rounding of positions would make a cell. With a larger number, short pieces of a curve would
/// vanish.
pub(crate) const SAME_POSITION: f64 = 1e-9;

/// Fraction of a cell that is added to a number of cells before it is rounded. Pieces of equal length get equal numbers
/// of cells, although their lengths differ by rounding.
const ROUNDED_UP: f64 = 1e-6;

/// Returns the number of pieces between `breaks`. A piece that runs over the start of a closed curve counts
/// as two.
#[must_use]
pub fn pieces(breaks: &[f64]) -> usize {
    1 + breaks.iter().filter(|&&at| at > 0.0).count()
}

/// Cuts a curve into `cells` cells, or into one for each piece if there are more pieces.
///
/// `breaks` rise, from 0 to below 1. Each piece gets cells of equal length, at least one, in proportion to
/// its length.
#[must_use]
pub fn evenly(breaks: &[f64], closed: bool, cells: usize) -> Vec<Stop> {
    let ends: Vec<f64> = breaks.iter().copied().filter(|&at| at > 0.0).chain([1.0]).collect();
    let cells = cells.max(ends.len());
    let (mut from, mut done) = (0.0, 0);
    let inner: Vec<Vec<f64>> = ends
        .iter()
        .zip(shares(&ends, cells))
        .map(|(&to, end)| {
            let count = end - done;
            let part = |cell: usize| from + (to - from) * (cell as f64 / count as f64);
            let inner = (1..count).map(part).collect();
            (from, done) = (to, end);
            inner
        })
        .collect();
    at(breaks, closed, &inner)
}

/// Cuts a curve into about `cells` cells, with stops at all `anchors`.
///
/// Each interval between neighbouring breaks and anchors is cut by its own length alone. So intervals of
/// equal length have equal numbers of cells.
#[must_use]
pub fn between(breaks: &[f64], closed: bool, cells: usize, anchors: &[f64]) -> Vec<Stop> {
    let near = |a: f64, b: f64| (a - b).abs() < SAME_POSITION;
    let mut ends: Vec<f64> = breaks.iter().copied().filter(|&at| at > 0.0).chain([1.0]).collect();
    let known = ends.clone();
    ends.extend(anchors.iter().filter(|&&at| {
        at > SAME_POSITION && at < 1.0 && !known.iter().any(|&other| near(other, at))
    }));
    ends.sort_by(f64::total_cmp);
    let mut inner = vec![Vec::new()];
    let mut from = 0.0;
    for to in ends {
        // Rounding must not distinguish pieces of equal length.
        let count = ((cells as f64 * (to - from) + ROUNDED_UP).round() as usize).max(1);
        let part = |cell: usize| from + (to - from) * (cell as f64 / count as f64);
        if let Some(piece) = inner.last_mut() {
            piece.extend((1..count).map(part));
            if !known.contains(&to) {
                piece.push(to);
            } else if to < 1.0 {
                inner.push(Vec::new());
            }
        }
        from = to;
    }
    at(breaks, closed, &inner)
}

/// Cuts a curve at given positions: `inner` holds, for each piece, the rising positions between its ends.
///
/// Breaks get two stops. A closed curve has no stop at 1. If its start is a break it has two stops, of which
/// the first is the end of the last piece.
#[must_use]
pub fn at(breaks: &[f64], closed: bool, inner: &[Vec<f64>]) -> Vec<Stop> {
    let mut stops =
        Vec::with_capacity(breaks.len() + inner.iter().map(Vec::len).sum::<usize>() + 2);
    let mut breaks = breaks.iter().copied().peekable();
    if breaks.next_if_eq(&0.0).is_some() && closed {
        stops.push(Stop::before(0.0));
    }
    stops.push(Stop::after(0.0));
    for piece in inner {
        stops.extend(piece.iter().map(|&at| Stop::after(at)));
        if let Some(at) = breaks.next() {
            stops.extend([Stop::before(at), Stop::after(at)]);
        }
    }
    if !closed {
        stops.push(Stop::before(1.0));
    }
    stops
}

/// Returns the number of cells in a cut that have some length.
#[must_use]
pub fn cells(stops: &[Stop], closed: bool) -> usize {
    let within = stops.windows(2).filter(|pair| pair[1].at > pair[0].at).count();
    within + usize::from(closed)
}

/// Distributes `cells` among pieces that end at `ends`, of which the last is 1. Returns the number of cells
/// up to each end.
///
/// Each piece has at least one cell; `cells` is at least the number of pieces.
fn shares(ends: &[f64], cells: usize) -> Vec<usize> {
    let mut before = 0;
    ends.iter()
        .enumerate()
        .map(|(piece, &end)| {
            let fair = (cells as f64 * end).round() as usize;
            // At least one cell for this piece, and enough left for the pieces after it.
            before = fair.clamp(before + 1, cells - (ends.len() - 1 - piece));
            before
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn positions(stops: &[Stop]) -> Vec<f64> {
        stops.iter().map(|stop| stop.at).collect()
    }

    #[test]
    fn a_smooth_curve_is_cut_evenly() {
        assert_eq!(positions(&evenly(&[], true, 4)), [0.0, 0.25, 0.5, 0.75]);
        assert_eq!(positions(&evenly(&[], false, 4)), [0.0, 0.25, 0.5, 0.75, 1.0]);
        assert_eq!(positions(&evenly(&[], false, 0)), [0.0, 1.0]);
    }

    #[test]
    fn breaks_come_twice_with_a_cell_for_each_piece_at_least() {
        let stops = evenly(&[0.0, 0.5], true, 1);
        let (before, after) = (Stop::before, Stop::after);
        assert_eq!(stops, [before(0.0), after(0.0), before(0.5), after(0.5)]);
        let stops = evenly(&[0.01], false, 3);
        assert_eq!(positions(&stops), [0.0, 0.01, 0.01, 0.505, 1.0]);
        assert_eq!(stops[0], after(0.0));
        assert_eq!(stops[4], before(1.0));
        assert_eq!(pieces(&[0.0, 0.5]), 2);
        assert_eq!(pieces(&[0.5]), 2);
    }

    #[test]
    fn cells_are_shared_by_length_and_every_piece_has_one() {
        assert_eq!(shares(&[0.25, 0.5, 1.0], 8), [2, 4, 8]);
        assert_eq!(shares(&[0.001, 0.002, 1.0], 4), [1, 2, 4]);
        assert_eq!(shares(&[0.98, 0.99, 1.0], 3), [1, 2, 3]);
    }

    #[test]
    fn places_may_be_given() {
        let stops = at(&[0.5], false, &[vec![0.4], vec![]]);
        assert_eq!(positions(&stops), [0.0, 0.4, 0.5, 0.5, 1.0]);
    }
}
