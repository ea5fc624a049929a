//! Where a curve is cut into cells: the rows of a trajectory, the columns of a contour.
//!
//! A curve has smooth pieces that end at *breaks*: creases of a contour, corners of a trajectory. A
//! break is given twice, once for each side, so that the surface has the directions of both there.

/// A place on a curve, and from which side it is looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Arc length from the start, as a fraction of the whole.
    pub at: f64,
    /// Which side is meant where the curve has a break; elsewhere both are the same.
    pub side: Side,
}

/// A side of a place, in the direction of the curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// What leads up to it.
    Before,
    /// What goes on from it.
    After,
}

impl Stop {
    /// A place looked at from before.
    #[must_use]
    pub fn before(at: f64) -> Self {
        Self { at, side: Side::Before }
    }

    /// A place looked at from after.
    #[must_use]
    pub fn after(at: f64) -> Self {
        Self { at, side: Side::After }
    }
}

/// The number of pieces between `breaks`; one that runs over the start of a closed curve counts as
/// two.
#[must_use]
pub fn pieces(breaks: &[f64]) -> usize {
    1 + breaks.iter().filter(|&&at| at > 0.0).count()
}

/// Cuts a curve into `cells` parts; into one for each piece when those are more.
///
/// `breaks` rise, from 0 to below 1. Each piece gets cells in proportion to its length, at least
/// one, of equal length.
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

/// Cuts a curve into about `cells` parts, and at `anchors` in any case.
///
/// What lies between two neighbours among breaks and anchors is cut by its length alone, so that
/// pieces of equal length have equally many cells.
#[must_use]
pub fn between(breaks: &[f64], closed: bool, cells: usize, anchors: &[f64]) -> Vec<Stop> {
    let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
    let mut ends: Vec<f64> = breaks.iter().copied().filter(|&at| at > 0.0).chain([1.0]).collect();
    let known = ends.clone();
    ends.extend(
        anchors
            .iter()
            .filter(|&&at| at > 1e-9 && at < 1.0 && !known.iter().any(|&other| near(other, at))),
    );
    ends.sort_by(f64::total_cmp);
    let mut inner = vec![Vec::new()];
    let mut from = 0.0;
    for to in ends {
        // Rounding must not tell pieces of equal length apart.
        let count = ((cells as f64 * (to - from) + 1e-6).round() as usize).max(1);
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

/// Cuts a curve at given places: `inner` has for each piece the places between its ends, rising.
///
/// Breaks come twice. A closed curve has no stop at 1; its start comes twice if it is a break, first
/// as the end of the last piece.
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

/// The number of cells of some length in a cut.
#[must_use]
pub fn cells(stops: &[Stop], closed: bool) -> usize {
    let within = stops.windows(2).filter(|pair| pair[1].at > pair[0].at).count();
    within + usize::from(closed)
}

/// Divides `cells` among pieces that end at `ends`, of which the last is 1: how many cells there are
/// up to each end.
///
/// Each piece has at least one; `cells` is at least the number of pieces.
fn shares(ends: &[f64], cells: usize) -> Vec<usize> {
    let mut before = 0;
    ends.iter()
        .enumerate()
        .map(|(piece, &end)| {
            let fair = (cells as f64 * end).round() as usize;
            // One for this piece, and enough left for those after it.
            before = fair.clamp(before + 1, cells - (ends.len() - 1 - piece));
            before
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(stops: &[Stop]) -> Vec<f64> {
        stops.iter().map(|stop| stop.at).collect()
    }

    #[test]
    fn a_smooth_curve_is_cut_evenly() {
        assert_eq!(places(&evenly(&[], true, 4)), [0.0, 0.25, 0.5, 0.75]);
        assert_eq!(places(&evenly(&[], false, 4)), [0.0, 0.25, 0.5, 0.75, 1.0]);
        assert_eq!(places(&evenly(&[], false, 0)), [0.0, 1.0]);
    }

    #[test]
    fn breaks_come_twice_with_a_cell_for_each_piece_at_least() {
        let stops = evenly(&[0.0, 0.5], true, 1);
        let (before, after) = (Stop::before, Stop::after);
        assert_eq!(stops, [before(0.0), after(0.0), before(0.5), after(0.5)]);
        let stops = evenly(&[0.01], false, 3);
        assert_eq!(places(&stops), [0.0, 0.01, 0.01, 0.505, 1.0]);
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
        assert_eq!(places(&stops), [0.0, 0.4, 0.5, 0.5, 1.0]);
    }
}
