//! A rectangular part of a picture.

use super::{Settings, size};
use std::ops::Range;

/// A rectangle of a picture's pixels. Coordinates count from the corner of the whole picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Crop {
    /// The leftmost column.
    pub x: u32,
    /// The uppermost row.
    pub y: u32,
    /// Pixels across, at least 1.
    pub width: u32,
    /// Pixels down, at least 1.
    pub height: u32,
}

impl Crop {
    /// Reads a rectangle such as `100,50,64x48`: column and row of its upper left pixel, then its
    /// size.
    ///
    /// # Errors
    /// If the text has another form, or if the rectangle cannot lie in any picture.
    pub fn parse(text: &str) -> Result<Self, String> {
        let form = "expected X,Y,WxH in pixels, such as 100,50,64x48";
        let (corner, extent) = text.rsplit_once(',').ok_or(form)?;
        let (x, y) = pixel(corner).map_err(|_| form)?;
        let (width, height) = size(extent).map_err(|_| form)?;
        Ok(Self { x, y, width, height })
    }

    /// Returns the rectangle of a whole picture of this size, in pixels.
    #[must_use]
    pub fn whole(width: u32, height: u32) -> Self {
        Self { x: 0, y: 0, width, height }
    }

    /// Returns whether the rectangle lies in a picture of this size, in pixels, and is not empty.
    #[must_use]
    pub fn fits(&self, width: u32, height: u32) -> bool {
        let ends = |start: u32, extent: u32, whole: u32| {
            extent > 0 && u64::from(start) + u64::from(extent) <= u64::from(whole)
        };
        ends(self.x, self.width, width) && ends(self.y, self.height, height)
    }

    /// Returns the rectangle that `settings` select.
    #[must_use]
    pub fn of(settings: &Settings) -> Self {
        settings.crop.unwrap_or(Self::whole(settings.width, settings.height))
    }

    /// Columns of the rectangle.
    #[must_use]
    pub fn columns(&self) -> Range<u32> {
        self.x..self.x + self.width
    }

    /// Rows of the rectangle.
    #[must_use]
    pub fn rows(&self) -> Range<u32> {
        self.y..self.y + self.height
    }

    /// Cuts the rectangle into tiles of at most `side` by `side` pixels, listed row by row. `side`
    /// is at least 1.
    #[must_use]
    pub fn tiles(&self, side: u32) -> Vec<Self> {
        let columns = self.columns().step_by(side as usize);
        self.rows()
            .step_by(side as usize)
            .flat_map(|y| columns.clone().map(move |x| (x, y)))
            .map(|(x, y)| Self {
                x,
                y,
                width: side.min(self.columns().end - x),
                height: side.min(self.rows().end - y),
            })
            .collect()
    }
}

/// One of several bands of rows into which a picture is cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tile {
    /// Number of the band, from 1 at the top.
    pub number: u32,
    /// Number of all bands, at least 1.
    pub count: u32,
}

impl Tile {
    /// Reads a band such as `2/4`.
    ///
    /// # Errors
    /// If the text is not two numbers of which the first is 1 to the second.
    pub fn parse(text: &str) -> Result<Self, String> {
        let both = text.split_once('/').and_then(|(number, count)| {
            Some(Self { number: number.parse().ok()?, count: count.parse().ok()? })
        });
        let fits = |tile: &Self| (1..=tile.count).contains(&tile.number) && tile.count <= 65536;
        both.filter(fits).ok_or("expected K/N with K from 1 to N, such as 2/4".into())
    }

    /// Returns the band of a picture of this size, in pixels. There is at least one row for each band if the
    /// picture is as high as there are bands.
    #[must_use]
    pub fn crop(&self, width: u32, height: u32) -> Crop {
        let start =
            |number: u32| (u64::from(number) * u64::from(height) / u64::from(self.count)) as u32;
        let y = start(self.number - 1);
        Crop { x: 0, y, width, height: start(self.number) - y }
    }
}

/// Reads the coordinates of a pixel, such as `320,240`: column and row, counted from 0 at the upper
/// left.
///
/// # Errors
/// If the text is not two numbers below 65536 with a comma between them.
pub fn pixel(text: &str) -> Result<(u32, u32), String> {
    let place = |text: &str| text.parse().ok().filter(|&place: &u32| place < 65536);
    text.split_once(',')
        .and_then(|(x, y)| Some((place(x)?, place(y)?)))
        .ok_or_else(|| "expected X,Y: a column and a row from 0 to 65535".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rectangle_is_a_place_and_a_size() {
        let crop = Crop { x: 100, y: 50, width: 64, height: 48 };
        assert_eq!(Crop::parse("100,50,64x48"), Ok(crop));
        for bad in ["", "1,2", "1,2,3", "1,2,3x0", "-1,2,3x4", "1,2,3x4,5", "1x2,3x4"] {
            assert!(Crop::parse(bad).unwrap_err().contains("X,Y,WxH"), "{bad}");
        }
        assert!(crop.fits(164, 98));
        assert!(!crop.fits(163, 98) && !crop.fits(164, 97));
        let far = Crop { x: 65535, y: 0, width: 65536, height: 1 };
        assert!(!far.fits(65536, 1));
    }

    #[test]
    fn tiles_cover_every_pixel_once() {
        let crop = Crop { x: 3, y: 5, width: 7, height: 4 };
        for side in [1, 2, 3, 7, 100] {
            let mut covered: Vec<(u32, u32)> = Vec::new();
            for tile in crop.tiles(side) {
                covered.extend(tile.rows().flat_map(|y| tile.columns().map(move |x| (y, x))));
            }
            covered.sort_unstable();
            let all: Vec<_> = (5..9).flat_map(|y| (3..10).map(move |x| (y, x))).collect();
            assert_eq!(covered, all);
        }
    }

    /// Bands follow one another, cover all rows, and differ by at most one row.
    #[test]
    fn tiles_are_bands_of_all_rows() {
        for (count, height) in [(1, 1), (3, 10), (7, 7), (5, 512)] {
            let mut next = 0;
            for number in 1..=count {
                let tile = Tile::parse(&format!("{number}/{count}")).unwrap();
                let crop = tile.crop(8, height);
                assert_eq!((crop.x, crop.y, crop.width), (0, next, 8));
                assert!(crop.height.abs_diff(height / count) <= 1 && crop.height > 0);
                next = crop.rows().end;
            }
            assert_eq!(next, height);
        }
        for text in ["", "1", "0/2", "3/2", "1/0", "a/2", "1/2/3", "1/99999"] {
            assert!(Tile::parse(text).is_err(), "{text}");
        }
    }
}
