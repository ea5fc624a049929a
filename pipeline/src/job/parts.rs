//! The parts of pictures that a job makes one by one, for several machines.

use render::film::crop::Tile;

/// The parts in which a picture is made, bands of rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Parts {
    /// Their number, at least 1.
    pub count: u32,
    /// The part that is made, from 1 at the top; `None` for all of them, joined.
    pub number: Option<u32>,
}

impl Parts {
    /// Returns the band of rows that is made, if it is one.
    #[must_use]
    pub fn tile(self) -> Option<Tile> {
        self.number.map(|number| Tile { number, count: self.count })
    }

    /// Returns the parts one by one.
    pub fn each(self) -> impl Iterator<Item = Self> {
        (1..=self.count).map(move |number| Self { number: Some(number), ..self })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bands of all parts have each row once.
    #[test]
    fn parts_have_all_rows_once() {
        for count in [1, 2, 3, 7] {
            let parts = Parts { count, number: None };
            assert_eq!(parts.tile(), None);
            let bands = parts.each().map(|part| part.tile().unwrap().crop(5, 7));
            let rows: Vec<u32> = bands.flat_map(|band| band.rows()).collect();
            assert_eq!(rows, (0..7).collect::<Vec<_>>(), "{count}");
        }
    }
}
