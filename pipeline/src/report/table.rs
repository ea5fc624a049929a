//! Looks up cells in tables of measured numbers.

use super::measured::Table;

impl Table {
    /// Returns the row with `first` in its first cell.
    #[must_use]
    pub fn row(&self, first: &str) -> Option<&[String]> {
        let is = |row: &&Vec<String>| row.first().is_some_and(|cell| cell == first);
        self.rows.iter().find(is).map(Vec::as_slice)
    }

    /// Returns the cell of a row in a column.
    #[must_use]
    pub fn cell<'a>(&self, row: &'a [String], column: &str) -> Option<&'a str> {
        let at = self.columns.iter().position(|name| name == column)?;
        row.get(at).map(String::as_str)
    }

    /// Returns the cell of a row in a column as a number.
    #[must_use]
    pub fn number(&self, row: &[String], column: &str) -> Option<f64> {
        self.cell(row, column)?.trim().parse().ok()
    }
}

#[cfg(test)]
mod tests {
    use crate::report::fixture;

    #[test]
    fn cells_are_found_by_row_and_column() {
        let table = fixture::table("filters", "method,ns,rms", &["mip,66.5,0.05", "tent,3e2,none"]);
        let row = table.row("mip").unwrap();
        assert_eq!(table.number(row, "ns"), Some(66.5));
        assert_eq!(table.number(row, "none"), None);
        let row = table.row("tent").unwrap();
        assert_eq!((table.cell(row, "ns"), table.number(row, "rms")), (Some("3e2"), None));
        assert_eq!(table.row("box"), None);
    }
}
