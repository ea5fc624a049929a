//! Positions of stops for a given density.

use super::demand::Density;
use crate::curve::cut::{self, SAME_POSITION, Stop};

/// A density that varies by at most this factor within a piece is even.
const EVEN: f64 = 1.02;

/// A number of cells may exceed a whole number by this fraction and still count as that number.
const WHOLE: f64 = 1e-6;

/// One direction of a surface, in which stops are placed.
#[derive(Debug, Clone)]
pub struct Direction {
    /// Breaks, rising, as in `cut`.
    pub breaks: Vec<f64>,
    /// Positions where the surface has an edge with one normal. A stop lies at each.
    pub kinks: Vec<f64>,
    /// True if the direction is closed.
    pub closed: bool,
    /// The fewest cells allowed.
    pub fewest: usize,
    /// True if the end of a closed direction meets its start point by point.
    pub meets: bool,
    /// If given, stops are even between breaks and these positions, as `cut::between` places them, and no
    /// stops are put at kinks.
    pub even: Option<Vec<f64>>,
}

impl Direction {
    /// Returns the ends of the pieces, rising; the last is 1.
    fn ends(&self) -> Vec<f64> {
        let kinks = if self.even.is_some() { &[] } else { &self.kinks[..] };
        let inside = |at: &f64| *at > 0.0 && *at < 1.0;
        let mut ends: Vec<f64> = self.breaks.iter().copied().filter(inside).collect();
        ends.push(1.0);
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        // A kink within rounding of a break, or of another kink, is no end of its own.
        let mut kinks: Vec<f64> = kinks.iter().copied().filter(|&at| at > SAME_POSITION).collect();
        kinks.sort_by(f64::total_cmp);
        kinks.dedup_by(|later, earlier| *later - *earlier < SAME_POSITION);
        kinks.retain(|at| {
            let next = ends.partition_point(|end| end < at);
            let around = &ends[next.saturating_sub(1)..(next + 1).min(ends.len())];
            around.iter().all(|end| (end - at).abs() >= SAME_POSITION)
        });
        ends.extend(kinks);
        ends.sort_by(f64::total_cmp);
        ends
    }

    fn is_break(&self, at: f64) -> bool {
        self.breaks.binary_search_by(|other| other.total_cmp(&at)).is_ok()
    }

    /// Returns the stops of an even cut with about `cells` cells.
    pub fn evenly(&self, cells: usize) -> Vec<Stop> {
        let flat = Density { positions: vec![0.0, 1.0], cells: vec![cells as f64] };
        self.stops(&flat, 1.0)
    }

    /// Returns the number of cells for a density times a factor.
    pub fn count(&self, density: &Density, factor: f64) -> usize {
        self.counts(density, factor).iter().sum()
    }

    /// Returns the largest factor below `factor` that gives fewer cells; `None` if there is none.
    pub fn fewer(&self, density: &Density, factor: f64) -> Option<f64> {
        let (shares, counts) = (self.shares(density), self.counts(density, factor));
        if counts.iter().sum::<usize>() <= self.fewest.max(counts.len()) {
            return None;
        }
        let smaller = shares.iter().zip(&counts).filter(|(_, count)| **count > 1);
        let smaller = smaller.map(|(share, count)| (count - 1) as f64 / share);
        // A factor raised to reach the fewest cells may be below all of these.
        smaller.filter(|&smaller| smaller < factor).reduce(f64::max)
    }

    /// Returns the stops for a density times a factor.
    pub fn stops(&self, density: &Density, factor: f64) -> Vec<Stop> {
        let counts = self.counts(density, factor);
        if let Some(anchors) = &self.even {
            return cut::between(&self.breaks, self.closed, counts.iter().sum(), anchors);
        }
        let mut inner: Vec<Vec<f64>> = vec![Vec::new()];
        let mut from = 0.0;
        for (to, count) in self.ends().into_iter().zip(counts) {
            if let Some(positions) = inner.last_mut() {
                positions.extend(between(density, [from, to], count));
                if to < 1.0 && !self.is_break(to) {
                    positions.push(to);
                }
            }
            if self.is_break(to) {
                inner.push(Vec::new());
            }
            from = to;
        }
        cut::at(&self.breaks, self.closed, &inner)
    }

    /// Returns the number of cells of each piece, not whole.
    fn shares(&self, density: &Density) -> Vec<f64> {
        let mut from = 0.0;
        let share = |to: f64| {
            let share = cells_to(density, to) - cells_to(density, from);
            from = to;
            share
        };
        let ends = if self.even.is_some() { vec![1.0] } else { self.ends() };
        ends.into_iter().map(share).collect()
    }

    fn counts(&self, density: &Density, factor: f64) -> Vec<usize> {
        let shares = self.shares(density);
        // With this factor there is half a cell in all.
        let least = 0.5 / shares.iter().sum::<f64>();
        let mut factor = factor;
        loop {
            let whole = |share: &f64| ((share * factor * (1.0 - WHOLE)).ceil() as usize).max(1);
            let counts: Vec<usize> = shares.iter().map(whole).collect();
            if counts.iter().sum::<usize>() >= self.fewest {
                return counts;
            }
            factor = factor.max(least) * 1.1;
            if !factor.is_finite() {
                // A density of 0 has no factor that gives the fewest cells: the pieces share them.
                return vec![self.fewest.div_ceil(shares.len()); shares.len()];
            }
        }
    }
}

/// Returns the number of cells, not whole, from the start to a position.
fn cells_to(density: &Density, at: f64) -> f64 {
    let mut before = 0.0;
    for (span, cells) in density.positions.windows(2).zip(&density.cells) {
        if at < span[1] {
            return before + cells * ((at - span[0]) / (span[1] - span[0])).max(0.0);
        }
        before += cells;
    }
    before
}

/// Returns the positions that divide a piece into `count` cells of equal shares of the density.
fn between(density: &Density, [from, to]: [f64; 2], count: usize) -> Vec<f64> {
    let part = |cell: usize| cell as f64 / count as f64;
    let spans = density.positions.windows(2).zip(&density.cells);
    // The part of each span within the piece, with the number of cells up to its start.
    let (mut before, mut pieces) = (0.0, Vec::new());
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for (span, cells) in spans {
        let (start, end) = (span[0].max(from), span[1].min(to));
        if end > start {
            let rate = cells / (span[1] - span[0]);
            (least, most) = (least.min(rate), most.max(rate));
            let within = rate * (end - start);
            pieces.push((start, end, before, within));
            before += within;
        }
    }
    if most <= EVEN * least {
        return (1..count).map(|cell| from + (to - from) * part(cell)).collect();
    }
    let mut piece = 0;
    let position = |cell: usize| {
        let wanted = before * part(cell);
        while piece + 1 < pieces.len() && pieces[piece].2 + pieces[piece].3 < wanted {
            piece += 1;
        }
        let (start, end, done, within) = pieces[piece];
        start + (end - start) * ((wanted - done) / within).clamp(0.0, 1.0)
    };
    let mut positions: Vec<f64> = (1..count).map(position).collect();
    // Rounding must not put two stops at one position.
    positions.retain(|&at| at > from && at < to);
    positions.dedup();
    positions
}

#[cfg(test)]
mod tests {
    use super::*;

    fn direction(breaks: &[f64], kinks: &[f64]) -> Direction {
        let (breaks, kinks) = (breaks.to_vec(), kinks.to_vec());
        Direction { breaks, kinks, closed: false, meets: true, fewest: 1, even: None }
    }

    fn positions(stops: &[Stop]) -> Vec<f64> {
        stops.iter().map(|stop| stop.at).collect()
    }

    #[test]
    fn a_density_that_does_not_vary_is_cut_evenly() {
        let flat = Density { positions: vec![0.0, 0.3, 1.0], cells: vec![1.2, 2.8] };
        for breaks in [vec![], vec![0.5]] {
            let placed = direction(&breaks, &[]).stops(&flat, 2.0);
            assert_eq!(placed, cut::evenly(&breaks, false, 8));
        }
    }

    #[test]
    fn even_stops_take_no_heed_of_the_density() {
        let steep = Density { positions: vec![0.0, 0.5, 1.0], cells: vec![3.0, 1.0] };
        let even = Direction { even: Some(vec![0.0]), ..direction(&[0.5], &[0.25]) };
        assert_eq!(even.stops(&steep, 2.0), cut::evenly(&[0.5], false, 8));
    }

    #[test]
    fn a_density_of_nothing_gives_the_fewest_cells() {
        for cells in [0.0, f64::NAN, f64::MIN_POSITIVE] {
            let nothing = Density { positions: vec![0.0, 1.0], cells: vec![cells] };
            let cut = Direction { fewest: 3, ..direction(&[0.5], &[]) };
            assert!(cut.count(&nothing, 1.0) >= 3, "{cells}");
        }
    }

    #[test]
    fn stops_follow_the_density_and_lie_on_kinks() {
        let steep = Density { positions: vec![0.0, 0.5, 1.0], cells: vec![3.0, 1.0] };
        let plain = direction(&[], &[]);
        let third = 0.5 / 3.0;
        assert_eq!(positions(&plain.stops(&steep, 1.0)), [0.0, third, 2.0 * third, 0.5, 1.0]);
        let kinked = direction(&[0.5], &[0.25]);
        assert_eq!(positions(&kinked.stops(&steep, 0.5)), [0.0, 0.25, 0.5, 0.5, 1.0]);
    }

    #[test]
    fn the_next_smaller_factor_drops_a_cell_of_a_piece() {
        let steep = Density { positions: vec![0.0, 0.5, 1.0], cells: vec![3.0, 1.0] };
        let cut = direction(&[0.5], &[]);
        let mut factor = 2.0;
        let mut counts = vec![cut.count(&steep, factor)];
        while let Some(smaller) = cut.fewer(&steep, factor) {
            factor = smaller;
            counts.push(cut.count(&steep, factor));
        }
        // At a factor of 1 both pieces lose a cell.
        assert_eq!(counts, [8, 7, 6, 4, 3, 2]);
        let around = Direction { fewest: 3, closed: true, ..direction(&[], &[]) };
        assert_eq!(around.count(&steep, 0.1), 3);
        assert_eq!(around.fewer(&steep, 0.1), None);
    }
}
