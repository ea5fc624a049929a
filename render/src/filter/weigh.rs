//! Applies both axes of a filter to a table.
//!
//! The rows of the table are reduced first: the entries of each row become small integers. These
//! are reduced down the column to small integers again. Only the last integers are multiplied by
//! real weights.

use super::axis::Axis;
use super::entry::{Entry, MOST_ENDS};
use super::reduce::{self, Reduce, plus, times};
use super::word::Word;
use glam::DVec3;

/// Returns the weighted sum of codes over `column` (positions across) and `row` (positions down),
/// one value per channel. The table has order `N` and `stride` entries a row; a filter has `E`
/// entries and `R` reduced integers along each axis.
#[must_use]
pub fn weigh<W: Word, const N: usize, const E: usize, const R: usize>(
    table: &[[W; 3]],
    stride: usize,
    column: &Axis,
    row: &Axis,
) -> DVec3 {
    let columns = Columns::<E>::new(column);
    let stored = |j: usize| &table[j * stride..][..stride];
    let mut lines = [[[W::default(); 3]; R]; E];
    if row.plain {
        for (k, lines) in lines.chunks_exact_mut(N + 1).enumerate() {
            for (slot, line) in lines.iter_mut().enumerate() {
                *line = columns.along::<W, N, R>(stored(row.points[k] as usize + slot));
            }
        }
    } else {
        let (ends, count) = row.line.ends();
        let mut at_ends: [Option<[[W; 3]; R]>; MOST_ENDS] = [None; MOST_ENDS];
        for (slot, line) in lines.iter_mut().enumerate().take(row.reduce.entries(N)) {
            let entry = row.entry(slot);
            if entry.sign != 0 {
                *line = columns.along::<W, N, R>(stored(entry.index));
                if entry.sign < 0 {
                    *line = line.map(|value| times(value, -1));
                }
            }
            for k in 0..if entry.goes_on { count } else { 0 } {
                let end =
                    at_ends[k].get_or_insert_with(|| columns.along::<W, N, R>(stored(ends[k])));
                for (value, &end) in line.iter_mut().zip(end.iter()) {
                    *value = plus(*value, times(end, entry.factors[k]));
                }
            }
        }
    }
    let mut sum = DVec3::ZERO;
    for (i, &column_weight) in column.weights.iter().enumerate().take(column.reduce.reduced(R)) {
        let entries: [[W; 3]; E] = std::array::from_fn(|slot| lines[slot][i]);
        let down = reduced::<W, N, E, R>(row.reduce, &entries);
        let mut average = DVec3::ZERO;
        for (value, &weight) in down.iter().zip(&row.weights).take(row.reduce.reduced(R)) {
            average += weight * DVec3::from(value.map(W::to_f64));
        }
        sum += column_weight * average;
    }
    sum
}

#[inline(always)]
fn reduced<W: Word, const N: usize, const E: usize, const R: usize>(
    reduce: Reduce,
    entries: &[[W; 3]; E],
) -> [[W; 3]; R] {
    match reduce {
        Reduce::Mean => [entries[0]; R],
        Reduce::Difference { moments, distances } => {
            reduce::difference::<W, N, E, R>(entries, &moments, &distances)
        }
    }
}

/// Entries of the columns, computed once for all rows.
enum Columns<'a, const E: usize> {
    Plain(&'a Axis),
    Wrapped { axis: &'a Axis, entries: [Entry; E], ends: [usize; MOST_ENDS], count: usize },
}

impl<'a, const E: usize> Columns<'a, E> {
    #[inline(always)]
    fn new(axis: &'a Axis) -> Self {
        if axis.plain {
            return Self::Plain(axis);
        }
        let mut entries = [Entry::default(); E];
        for (slot, entry) in entries.iter_mut().enumerate().take(axis.reduce.entries(axis.line.n)) {
            *entry = axis.entry(slot);
        }
        let (ends, count) = axis.line.ends();
        Self::Wrapped { axis, entries, ends, count }
    }

    /// Returns the reduced integers of one row of the table.
    #[inline(always)]
    fn along<W: Word, const N: usize, const R: usize>(&self, stored: &[[W; 3]]) -> [[W; 3]; R] {
        let mut values = [[W::default(); 3]; E];
        match self {
            Self::Plain(axis) => {
                for (values, &i) in values.chunks_exact_mut(N + 1).zip(&axis.points) {
                    values.copy_from_slice(&stored[i as usize..][..=N]);
                }
                reduced::<W, N, E, R>(axis.reduce, &values)
            }
            Self::Wrapped { axis, entries, ends, count } => {
                for (value, entry) in values.iter_mut().zip(entries) {
                    match entry.sign {
                        0 => {}
                        1 => *value = stored[entry.index],
                        _ => *value = times(stored[entry.index], -1),
                    }
                    if entry.goes_on {
                        for (&end, &factor) in ends.iter().zip(&entry.factors).take(*count) {
                            *value = plus(*value, times(stored[end], factor));
                        }
                    }
                }
                reduced::<W, N, E, R>(axis.reduce, &values)
            }
        }
    }
}
