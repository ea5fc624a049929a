//! Tables of measured numbers, as the measuring programs write them.

/// A table with a name for each column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    /// The names.
    pub columns: Vec<String>,
    /// The rows, each with as many cells as there are names.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// The table in a text of comma separated values, whose cells may stand in quotation marks. Rows
    /// with another number of cells than the first are left out.
    #[must_use]
    pub fn read(text: &str) -> Self {
        let mut rows = text.lines().filter(|line| !line.is_empty()).map(cells);
        let columns = rows.next().unwrap_or_default();
        let rows = rows.filter(|row| row.len() == columns.len()).collect();
        Self { columns, rows }
    }

    /// The row whose first cell is this.
    #[must_use]
    pub fn row(&self, first: &str) -> Option<&[String]> {
        self.rows.iter().find(|row| row[0] == first).map(Vec::as_slice)
    }

    /// What stands in a column of a row.
    #[must_use]
    pub fn cell<'a>(&self, row: &'a [String], column: &str) -> Option<&'a str> {
        let at = self.columns.iter().position(|name| name == column)?;
        row.get(at).map(String::as_str)
    }

    /// The same as a number.
    #[must_use]
    pub fn number(&self, row: &[String], column: &str) -> Option<f64> {
        self.cell(row, column)?.parse().ok()
    }
}

fn cells(line: &str) -> Vec<String> {
    let (mut cells, mut cell, mut quoted) = (Vec::new(), String::new(), false);
    for c in line.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(std::mem::take(&mut cell)),
            c => cell.push(c),
        }
    }
    cells.push(cell);
    cells
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_found_by_row_and_column() {
        let table = Table::read("method,ns,rms\n\"box, 1 px\",128.2,0.05\nodd\ntent,3e2,0.1\n");
        assert_eq!(table.rows.len(), 2);
        let row = table.row("box, 1 px").unwrap();
        assert_eq!(table.number(row, "ns"), Some(128.2));
        assert_eq!(table.cell(table.row("tent").unwrap(), "ns"), Some("3e2"));
        assert_eq!(table.number(row, "none"), None);
        assert_eq!(table.row("mip"), None);
        assert_eq!(Table::read("").rows.len(), 0);
    }
}
