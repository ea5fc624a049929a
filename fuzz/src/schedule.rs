//! Selects the next cases.

use crate::reader::Reader;
use std::time::{Duration, Instant};

/// Intended time of a run of cases: long beside a message to a child, short beside the whole.
const RUN: Duration = Duration::from_millis(200);

/// Largest number of cases in one run.
const LONGEST_RUN: u64 = 5000;

/// The end of a fuzzing run.
#[derive(Debug, Clone, Copy)]
pub enum Until {
    /// After this number of cases, shared evenly among the readers.
    Cases(u64),
    /// At this instant; readers share the time evenly.
    Instant(Instant),
}

/// The cases that were not handed out yet.
#[derive(Debug)]
pub struct Schedule {
    until: Until,
    lines: Vec<Line>,
}

#[derive(Debug)]
struct Line {
    reader: Reader,
    /// The number of the next case.
    next: u64,
    /// Total time of the cases that are done.
    spent: Duration,
    /// Number of cases that are done.
    done: u64,
    /// Number of runs handed out and not yet done.
    open: u32,
}

/// Cases that are tried by one child, one after another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Run {
    /// The reader.
    pub reader: Reader,
    /// The first case.
    pub from: u64,
    /// The number of cases.
    pub count: u64,
}

impl Schedule {
    /// Makes a schedule of all cases of these readers.
    #[must_use]
    pub fn new(readers: &[Reader], until: Until) -> Self {
        let line = |&reader| Line { reader, next: 0, spent: Duration::ZERO, done: 0, open: 0 };
        Self { until, lines: readers.iter().map(line).collect() }
    }

    /// Returns the next run, or `None` at the end.
    pub fn next(&mut self) -> Option<Run> {
        let share = match self.until {
            Until::Cases(all) => all.div_ceil(self.lines.len().max(1) as u64),
            Until::Instant(end) if Instant::now() < end => u64::MAX,
            Until::Instant(_) => 0,
        };
        let open = self.lines.iter_mut().filter(|line| line.next < share);
        let line = open.min_by_key(|line| line.spent + RUN * line.open)?;
        let each = line.spent.checked_div(u32::try_from(line.done).unwrap_or(u32::MAX));
        let fitting = match each {
            Some(each) => RUN.as_nanos() / each.as_nanos().max(1),
            None => 16,
        };
        let fitting = u64::try_from(fitting).unwrap_or(LONGEST_RUN).clamp(1, LONGEST_RUN);
        let run =
            Run { reader: line.reader, from: line.next, count: fitting.min(share - line.next) };
        line.next += run.count;
        line.open += 1;
        Some(run)
    }

    /// Records the time that a run took.
    pub fn took(&mut self, run: Run, time: Duration) {
        if let Some(line) = self.lines.iter_mut().find(|line| line.reader == run.reader) {
            line.spent += time;
            line.done += run.count;
            line.open -= 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cases_are_shared_evenly_and_each_comes_once() {
        let mut schedule = Schedule::new(&[Reader::Obj, Reader::Scene], Until::Cases(1000));
        let (mut seen, mut count) = ([0; 2], 0);
        while let Some(run) = schedule.next() {
            let (place, each) = if run.reader == Reader::Obj { (0, 1) } else { (1, 40) };
            assert_eq!(run.from, seen[place], "no case is left out");
            seen[place] += run.count;
            count += 1;
            schedule.took(run, Duration::from_millis(each) * run.count as u32);
        }
        assert_eq!(seen, [500, 500]);
        assert!(count > 100, "slow cases come in short runs: {count}");
    }

    #[test]
    fn time_that_is_up_ends_it() {
        let mut schedule = Schedule::new(&[Reader::Obj], Until::Instant(Instant::now()));
        assert_eq!(schedule.next(), None);
    }
}
