//! Reads the points of a trajectory from a table of comma-separated values.

use super::Reader;
use crate::error::SweepError;
use crate::spec::{Csv, Measured, TableColumn};
use csv::{ReaderBuilder, StringRecord, Trim};

/// Bytes of memory that a table takes for each byte of its file: a number of one digit and its comma become 8 bytes.
const BYTES_OF_A_BYTE: u64 = 16;

impl Reader<'_> {
    /// Takes the points of a measured curve from its table, if it has one.
    pub(super) fn load_points(
        &self,
        path: &str,
        measured: &mut Measured,
    ) -> Result<(), SweepError> {
        let Some(table) = measured.csv.take() else { return Ok(()) };
        for (key, given) in [
            ("points", !measured.points.is_empty()),
            ("radii", measured.radii.is_some() && table.radius.is_some()),
        ] {
            if given {
                let message = format!("found `{key}` beside `csv`, expected one of the two");
                return Err(self.fault(&format!("{path}.{key}"), message));
            }
        }
        let key = format!("{path}.csv");
        let file_key = format!("{key}.file");
        let (name, text) = self.text_file(&file_key, &table.file, BYTES_OF_A_BYTE)?;
        let rows =
            rows(&text).map_err(|message| self.fault(&file_key, format!("{name}: {message}")))?;
        let places = self.columns_of(&key, &name, &table, rows.first())?;
        let named = rows
            .first()
            .is_some_and(|(_, row)| row.get(places[0]).is_none_or(|cell| number(cell).is_none()));
        let mut points = Vec::with_capacity(rows.len());
        let mut radii = Vec::new();
        for (line, row) in rows.iter().skip(usize::from(named)) {
            let cell = |place: usize| {
                let found = row.get(place).unwrap_or_default();
                number(found).ok_or_else(|| {
                    let message = format!(
                        "{name}: found {found:?} in line {line}, column {}, expected a number",
                        place + 1
                    );
                    self.fault(&file_key, message)
                })
            };
            points.push([cell(places[0])?, cell(places[1])?, cell(places[2])?]);
            if let Some(&place) = places.get(3) {
                radii.push(cell(place)?);
            }
        }
        measured.points = points;
        if places.len() > 3 {
            measured.radii = Some(radii);
        }
        Ok(())
    }

    /// Returns the places of the columns of x, y, z and of the radii if there are any.
    fn columns_of(
        &self,
        key: &str,
        name: &str,
        table: &Csv,
        first: Option<&(u64, StringRecord)>,
    ) -> Result<Vec<usize>, SweepError> {
        let heads: Vec<&str> = first.map(|(_, row)| row.iter().collect()).unwrap_or_default();
        let find = |wanted: &str| heads.iter().position(|head| head.eq_ignore_ascii_case(wanted));
        let place = |key: &str, column: &TableColumn| match column {
            TableColumn::Number(number) if (1..=heads.len()).contains(number) => Ok(number - 1),
            TableColumn::Number(number) => {
                let message = format!(
                    "found column {number}, expected one from 1 to {}, the columns of {name}",
                    heads.len()
                );
                Err(self.fault(key, message))
            }
            TableColumn::Name(wanted) => find(wanted).ok_or_else(|| {
                let known: Vec<&str> = heads.iter().take(12).copied().collect();
                let message = format!(
                    "found no column {wanted:?} in {name}, expected one of {}",
                    known.join(", ")
                );
                self.fault(key, message)
            }),
        };
        let mut places = match &table.columns {
            Some(columns) => (0..3)
                .map(|i| place(&format!("{key}.columns[{i}]"), &columns[i]))
                .collect::<Result<Vec<usize>, _>>()?,
            None => match ["x", "y", "z"].map(find) {
                [Some(x), Some(y), Some(z)] => vec![x, y, z],
                _ if heads.len() >= 3 && number(heads[0]).is_some() => vec![0, 1, 2],
                _ => {
                    let message = format!(
                        "found no columns named x, y and z in {name}, expected `columns` with their names or numbers"
                    );
                    return Err(self.fault(key, message));
                }
            },
        };
        if let Some(radius) = &table.radius {
            places.push(place(&format!("{key}.radius"), radius)?);
        }
        Ok(places)
    }
}

fn number(cell: &str) -> Option<f64> {
    cell.parse().ok().filter(|number: &f64| number.is_finite())
}

/// Returns the rows of a table with the numbers of their lines. The first line tells the separator.
fn rows(text: &str) -> Result<Vec<(u64, StringRecord)>, String> {
    let first = text.lines().find(|line| !line.trim().is_empty() && !line.starts_with('#'));
    let first = first.unwrap_or_default();
    let separator = ['\t', ';', ','].into_iter().find(|&mark| first.contains(mark)).unwrap_or(',');
    let mut reader = ReaderBuilder::new()
        .delimiter(separator as u8)
        .comment(Some(b'#'))
        .has_headers(false)
        .flexible(true)
        .trim(Trim::All)
        .from_reader(text.as_bytes());
    let mut rows = Vec::new();
    for row in reader.records() {
        let row = row
            .map_err(|error| format!("found a broken table ({error}), expected rows of values"))?;
        if row.iter().any(|cell| !cell.is_empty()) {
            rows.push((row.position().map_or(0, csv::Position::line), row));
        }
    }
    Ok(rows)
}
