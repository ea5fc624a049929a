//! Counts the results, and prints them as a table and as a list.

use crate::protocol::Answer;
use crate::reader::Reader;
use crate::verdict::{Fault, Verdict};
use std::collections::BTreeMap;
use std::fmt::{self, Display};
use std::time::Duration;

/// The counts of all readers.
#[derive(Debug, Default)]
pub struct Tally {
    rows: BTreeMap<Reader, Row>,
    groups: BTreeMap<(Reader, String), Group>,
}

/// The counts of one reader.
#[derive(Debug, Default, Clone)]
struct Row {
    cases: u64,
    accepted: u64,
    refused: u64,
    faults: u64,
    /// Processor time of all cases.
    time: Duration,
    /// The longest processor time of a case without a fault, and the number of that case.
    slowest: (Duration, u64),
    /// The most memory of a case without a fault, in bytes, and the number of that case.
    largest: (u64, u64),
}

/// Cases with the same fault.
#[derive(Debug, Clone)]
pub struct Group {
    /// The reader.
    pub reader: Reader,
    /// Number of cases.
    pub count: u64,
    /// The lowest number of these cases.
    pub case: u64,
    /// The fault of the case with the lowest number.
    pub fault: Fault,
}

impl Tally {
    /// Counts a case.
    pub fn add(&mut self, reader: Reader, case: u64, answer: &Answer) {
        let row = self.rows.entry(reader).or_default();
        row.cases += 1;
        row.time += answer.time;
        match &answer.verdict {
            Verdict::Accepted => row.accepted += 1,
            Verdict::Refused(_) => row.refused += 1,
            Verdict::Fault(fault) => {
                row.faults += 1;
                let group = self.groups.entry((reader, fault.signature()));
                let group =
                    group.or_insert_with(|| Group { reader, count: 0, case, fault: fault.clone() });
                group.count += 1;
                if case < group.case {
                    (group.case, group.fault) = (case, fault.clone());
                }
                return;
            }
        }
        row.slowest = row.slowest.max((answer.time, case));
        row.largest = row.largest.max((answer.memory, case));
    }

    /// Returns the different faults, by reader.
    #[must_use]
    pub fn groups(&self) -> Vec<Group> {
        self.groups.values().cloned().collect()
    }
}

impl Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{:<10} {:>9} {:>9} {:>9} {:>5} {:>8} {:>8} {:>16} {:>18}",
            "reader",
            "cases",
            "accepted",
            "refused",
            "%",
            "faults",
            "us/case",
            "slowest s (case)",
            "largest MB (case)"
        )?;
        let mut all = Row::default();
        for (reader, row) in &self.rows {
            write_row(f, reader.name(), row)?;
            all.cases += row.cases;
            all.accepted += row.accepted;
            all.refused += row.refused;
            all.faults += row.faults;
            all.time += row.time;
            all.slowest = all.slowest.max(row.slowest);
            all.largest = all.largest.max(row.largest);
        }
        write_row(f, "all", &all)
    }
}

fn write_row(f: &mut fmt::Formatter<'_>, name: &str, row: &Row) -> fmt::Result {
    let Row { cases, accepted, refused, faults, time, slowest, largest } = row;
    let share = 100 * accepted / (*cases).max(1);
    let each = time.as_micros() / u128::from((*cases).max(1));
    let slowest = format!("{:.2} ({})", slowest.0.as_secs_f64(), slowest.1);
    let largest = format!("{} ({})", largest.0 >> 20, largest.1);
    writeln!(
        f,
        "{name:<10} {cases:>9} {accepted:>9} {refused:>9} {share:>5} {faults:>8} {each:>8} {slowest:>16} {largest:>18}"
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Kind;

    #[test]
    fn the_same_fault_is_one_group_with_its_first_case() {
        let mut tally = Tally::default();
        let mut add = |case, verdict| {
            let answer = Answer { verdict, time: Duration::from_millis(case), memory: 1 << 20 };
            tally.add(Reader::Obj, case, &answer);
        };
        let fault = |text| Verdict::Fault(Fault::new(Kind::Panic, text));
        add(9, fault("a.rs:7: index 3"));
        add(4, fault("a.rs:7: index 5"));
        add(5, fault("b.rs:1: no"));
        add(6, Verdict::Accepted);
        add(7, Verdict::Refused("found no v".into()));
        let groups = tally.groups();
        let found: Vec<(u64, u64)> = groups.iter().map(|group| (group.case, group.count)).collect();
        assert_eq!(found, [(4, 2), (5, 1)]);
        let table = tally.to_string();
        let all = table.lines().last().unwrap().split_whitespace().take(6).collect::<Vec<_>>();
        assert_eq!(all, ["all", "5", "1", "1", "20", "3"]);
    }
}
