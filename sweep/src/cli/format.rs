//! The format of the grid file.

use clap::ValueEnum;
use sweep::grid::file::Encoding;

#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum Format {
    /// Binary little-endian numbers: small and fast
    Bin,
    /// One JSON array per row, for reading and comparing
    Json,
}

impl Format {
    /// Returns how the rows of the grid are written.
    pub fn encoding(self) -> Encoding {
        match self {
            Self::Bin => Encoding::Binary,
            Self::Json => Encoding::Json,
        }
    }

    /// Returns the extensions that the name of a grid file may have.
    pub fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::Bin => &["grid"],
            Self::Json => &["grid", "json"],
        }
    }
}
