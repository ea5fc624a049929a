//! Variants of a file, from a table: `--jobs-from variants.csv`.
//!
//! ```csv
//! name,camera.fov_deg,objects[0].sphere.radius
//! wide,50,1
//! near,20,1.5
//! far,,2
//! ```
//!
//! A column is a path as in `-D PATH=VALUE`, and a row gives the values of one variant. An empty cell leaves the value of
//! the file. The column `name` names the variants; without it they are numbered from 1.

use crate::{Exit, Failure, Setting, words};
use std::collections::BTreeSet;
use thiserror::Error;

/// The column of names.
const NAME: &str = "name";

/// A variant, and the values that make it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Variant {
    /// The name: letters, digits, `-`, `_` and `.`. Each variant has another.
    pub name: String,
    /// The values, in the order of the columns.
    pub settings: Vec<Setting>,
}

/// A fault of a table of variants.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{file}:{line}: {message}")]
pub struct VariantsError {
    file: String,
    /// Line from 1.
    line: u64,
    message: String,
}

impl Failure for VariantsError {
    fn exit(&self) -> Exit {
        Exit::Malformed
    }
}

/// Reads the variants of a table. `file` is the name of the table in messages.
///
/// # Errors
/// When the table has no rows, a row has too many or too few values, a column is no path, or a name occurs twice.
pub fn read(file: &str, bytes: &[u8]) -> Result<Vec<Variant>, VariantsError> {
    let fault = |line, message: String| VariantsError { file: file.into(), line, message };
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(bytes);
    let broken = |error: csv::Error| {
        let line = error.position().map_or(1, csv::Position::line);
        let message = match error.kind() {
            csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
                format!("found {len} values, expected {expected_len}, one for each column")
            }
            csv::ErrorKind::Utf8 { .. } => "found bytes that are not UTF-8, expected text".into(),
            _ => error.to_string(),
        };
        fault(line, message)
    };
    let columns = reader.headers().map_err(broken)?.clone();
    if columns.iter().all(str::is_empty) {
        return Err(fault(1, "found no columns, expected paths such as camera.fov_deg".into()));
    }
    for (k, column) in columns.iter().enumerate() {
        if columns.iter().take(k).any(|other| other == column) {
            return Err(fault(1, format!("found the column {} twice", words::shown(column))));
        }
    }
    let (mut variants, mut names) = (Vec::new(), BTreeSet::new());
    for row in reader.records() {
        let row = row.map_err(broken)?;
        let line = row.position().map_or(1, csv::Position::line);
        let mut name = None;
        let mut settings = Vec::new();
        for (column, value) in columns.iter().zip(&row) {
            if column == NAME {
                name = Some(value.to_string());
            } else if !value.is_empty() {
                let setting = format!("{column}={value}").parse::<Setting>();
                let wrong =
                    |expected| fault(1, format!("column {}: {expected}", words::shown(column)));
                settings.push(setting.map_err(wrong)?);
            }
        }
        let name = name.unwrap_or_else(|| (variants.len() + 1).to_string());
        let is_plain = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | '.');
        if name.is_empty() || name.starts_with('.') || !name.chars().all(is_plain) {
            let message = format!("found name {name:?}, expected letters, digits, - and _");
            return Err(fault(line, message));
        }
        if !names.insert(name.clone()) {
            return Err(fault(line, format!("found the name {name:?} twice, expected each once")));
        }
        variants.push(Variant { name, settings });
    }
    if variants.is_empty() {
        return Err(fault(1, "found no rows, expected one for each variant".into()));
    }
    if columns.iter().all(|column| column != NAME) {
        // Numbers of one width sort as they count.
        let width = variants.len().to_string().len();
        for variant in &mut variants {
            variant.name = format!("{:0>width$}", variant.name);
        }
    }
    Ok(variants)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_on_this_page_has_three_variants() {
        let page = include_str!("variants.rs").lines().skip_while(|line| *line != "//! ```csv");
        let lines = page.skip(1).take_while(|line| *line != "//! ```");
        let table: String = lines.map(|line| format!("{}\n", &line[4..])).collect();
        let variants = read("a.csv", table.as_bytes()).unwrap();
        let names: Vec<&str> = variants.iter().map(|variant| variant.name.as_str()).collect();
        assert_eq!(names, ["wide", "near", "far"]);
        let texts = variants[2].settings.iter().map(Setting::text);
        assert_eq!(texts.collect::<Vec<_>>(), ["objects[0].sphere.radius=2"]);
        assert_eq!(variants[0].settings.len(), 2);
    }

    #[test]
    fn variants_without_names_are_numbered() {
        let table = format!("a.b\n{}", "1\n".repeat(10));
        let variants = read("a.csv", table.as_bytes()).unwrap();
        assert_eq!((variants[0].name.as_str(), variants[9].name.as_str()), ("01", "10"));
    }

    #[test]
    fn values_may_hold_commas_and_words() {
        let variants = read("a.csv", b"a.up,b\n\"[0, 1, 0]\",my glass\n").unwrap();
        let texts: Vec<String> = variants[0].settings.iter().map(Setting::text).collect();
        assert_eq!(texts, ["a.up=[0, 1, 0]", "b=\"my glass\""]);
    }

    #[test]
    fn faults_have_their_line() {
        for (table, expected) in [
            ("", "a.csv:1: found no columns"),
            ("a.b\n", "a.csv:1: found no rows"),
            ("a,b\n1,2\n1\n", "a.csv:3: found 1 values, expected 2"),
            ("a,a\n1,2\n", "a.csv:1: found the column a twice"),
            ("a[,b\n1,2\n", "a.csv:1: column a[: expected PATH=VALUE"),
            ("name,a\nx,1\nx,2\n", "a.csv:3: found the name \"x\" twice"),
            ("name,a\n../x,1\n", "a.csv:2: found name \"../x\""),
        ] {
            let error = read("a.csv", table.as_bytes()).unwrap_err().to_string();
            assert!(error.starts_with(expected), "{error}");
        }
    }
}
