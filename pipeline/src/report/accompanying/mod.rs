//! Measures the modeler, the filters and the arithmetic separately, to accompany the pages of a report.
//!
//! Two tables are measured here. Three others need a machine for themselves, or exact arithmetic with
//! numbers of any length. Separate programs measured these three. Their tables are built in, with the
//! commands that make them again.

pub mod tables;
pub mod tessellation;

use super::csv;
use super::measured::Table;
use crate::PipelineError;

macro_rules! measured {
    ($file:literal) => {
        include_str!(concat!("../../../../docs/measured/", $file))
    };
}

/// Returns all accompanying tables. With `quick`, the measured ones cover fewer shapes and tolerances.
///
/// # Errors
/// When a built-in shape cannot be swept, which should not happen.
pub fn measure(quick: bool) -> Result<Vec<Table>, PipelineError> {
    Ok(vec![
        tables::measure(),
        tessellation::measure(quick)?,
        elsewhere(
            "filters",
            "What an average costs, and how far it is from the truth",
            "Averages of four textures over 9216 footprints of a floor in perspective: nanoseconds, their \
             ratio to bilinear interpolation, and root mean square errors for a texture from black (0) to white \
             (1), also by texture and by the angle between view and texture.",
            "cargo bench -p render --bench filters -- docs/measured",
            [measured!("filters.csv"), measured!("filters.svg")],
        ),
        elsewhere(
            "tessellation",
            "Quads and seconds against the distance to the surface",
            "Rows and columns placed where the surface bends, and even ones in the proportion that needs the \
             fewest quads, both measured by one rule.",
            "cargo run --release -p sweep --example tessellation -- docs/measured",
            [measured!("tessellation.csv"), measured!("tessellation.svg")],
        ),
        elsewhere(
            "mapping",
            "Texture coordinates on a triangle: the thesis's map against barycentric weights",
            "Errors against exact fractions, 1000 hits in each class of triangles, as parts of the texture: \
             median and largest, and how many hits gave no number. The weights are what is in use.",
            "cargo run --release -p render --example mapping -- docs/measured",
            [measured!("mapping.csv"), measured!("mapping.svg")],
        ),
    ])
}

/// Returns a table that another program measured.
fn elsewhere(
    name: &'static str,
    title: &str,
    about: &str,
    command: &'static str,
    [text, drawing]: [&'static str; 2],
) -> Table {
    let (columns, rows) = csv::read(text);
    let (title, about) = (title.into(), about.into());
    let (command, drawing) = (Some(command), Some(drawing));
    Table { name, title, about, command, columns, rows, drawing }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_table_is_full_and_has_a_name_of_its_own() {
        let tables = measure(true).unwrap();
        for (k, table) in tables.iter().enumerate() {
            let Table { name, columns, rows, .. } = table;
            assert!(tables[..k].iter().all(|other| other.name != *name), "{name} twice");
            assert!(rows.len() > 3 && columns.len() > 3, "{name}");
            assert!(rows.iter().all(|row| row.len() == columns.len()), "{name}");
        }
    }
}
