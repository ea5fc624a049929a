//! Measurements of the modeler, the filters and the texture coordinates that accompany the pages of a
//! report.
//!
//! These measurements need an idle machine, or exact arithmetic with numbers of any length. Programs of
//! other crates made them. Each is built in as a table and a drawing, with the command that makes both
//! again.

/// A measurement that another program made.
#[derive(Debug, Clone, Copy)]
pub struct Accompanying {
    /// The name of the measurement, such as `filters`.
    pub name: &'static str,
    /// The title, one line.
    pub title: &'static str,
    /// A description, in a few sentences.
    pub about: &'static str,
    /// The command that repeats the measurement.
    pub command: &'static str,
    /// The table as comma separated values, with the names of the columns in the first line.
    pub table: &'static str,
    /// The drawing of the table, an SVG document.
    pub drawing: &'static str,
}

macro_rules! measured {
    ($file:literal) => {
        include_str!(concat!("../../measured/", $file))
    };
}

/// The measurements, in the order in which a report shows them.
pub const ALL: [Accompanying; 3] = [
    Accompanying {
        name: "filters",
        title: "Cost and error of an average",
        about: "Averages of four textures over 9216 footprints of a floor in perspective: nanoseconds, their \
                ratio to bilinear interpolation, and root mean square errors for a texture from black (0) to white \
                (1), also by texture and by the angle between view and texture.",
        command: "cargo bench -p topobook-render --bench filters -- docs/measured",
        table: measured!("filters.csv"),
        drawing: measured!("filters.svg"),
    },
    Accompanying {
        name: "tessellation",
        title: "Quads and seconds against the distance to the surface",
        about: "Rows and columns placed where the surface bends, against evenly spaced rows and \
                columns in the proportion that needs the fewest quads, both measured by one rule.",
        command: "cargo run --release -p topobook-sweep --example tessellation -- docs/measured",
        table: measured!("tessellation.csv"),
        drawing: measured!("tessellation.svg"),
    },
    Accompanying {
        name: "mapping",
        title: "Texture coordinates on a triangle: the thesis's map against barycentric weights",
        about: "Errors against exact fractions, 1000 hits in each class of triangles, as \
                fractions of the texture: median and largest, and the number of hits without a \
                result. The renderer uses the weights.",
        command: "cargo run --release -p topobook-render --example mapping -- docs/measured",
        table: measured!("mapping.csv"),
        drawing: measured!("mapping.svg"),
    },
];

impl Accompanying {
    /// Returns the file name of the table in a report.
    #[must_use]
    pub fn file(&self) -> String {
        format!("{}.csv", self.name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_table_is_full_and_has_a_name_of_its_own() {
        for (k, own) in ALL.iter().enumerate() {
            assert!(ALL[..k].iter().all(|other| other.name != own.name), "{} twice", own.name);
            assert!(own.drawing.contains("<svg"), "{}", own.name);
            // Rows of another length than the first are an error of the reader.
            let mut reader = csv::Reader::from_reader(own.table.as_bytes());
            let columns = reader.headers().unwrap().len();
            let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
            assert!(rows.len() > 3 && columns > 3, "{}", own.name);
        }
    }
}
