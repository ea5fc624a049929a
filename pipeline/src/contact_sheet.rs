//! Puts many small pictures on one sheet.

use crate::PipelineError;
use render::Picture;
use render::color::Encoding;
use render::film::encode::{self, Format};

/// Width of the white gap between and around pictures, in pixels.
const GAP: u32 = 8;

/// Longest side of a picture on a sheet, in pixels.
const SIDE: u32 = 160;

/// Largest number of pictures in a row.
const ROW: usize = 6;

/// A contact sheet of small pictures.
#[derive(Debug, Clone, Default)]
pub struct ContactSheet {
    pictures: Vec<Picture>,
}

impl ContactSheet {
    /// The file name of the sheet.
    pub const FILE: &str = "sheet.png";

    /// Adds a picture, scaled down, after the others.
    pub fn add(&mut self, picture: &Picture) {
        self.pictures.push(thumbnail(picture, SIDE));
    }

    /// Returns the sheet as a PNG file.
    ///
    /// # Errors
    /// When the encoder refuses the sheet.
    pub fn png(&self) -> Result<Vec<u8>, PipelineError> {
        encode::encode(&self.picture(), Format::Png, Encoding::Srgb)
            .map_err(|source| PipelineError::Encode { name: Self::FILE.into(), source })
    }

    /// Returns width and height of the sheet in pixels.
    #[must_use]
    pub fn size(&self) -> (u32, u32) {
        let [column, row] = self.cell();
        let down = self.pictures.len().div_ceil(ROW) as u32;
        (self.across() * column + GAP, down * row + GAP)
    }

    /// Returns the number of pictures in a row.
    fn across(&self) -> u32 {
        self.pictures.len().clamp(1, ROW) as u32
    }

    /// Returns width and height of a picture with the gap before it.
    fn cell(&self) -> [u32; 2] {
        let widest = self.pictures.iter().map(|picture| picture.width).max().unwrap_or(0);
        let highest = self.pictures.iter().map(|picture| picture.height).max().unwrap_or(0);
        [widest + GAP, highest + GAP]
    }

    /// Returns the sheet: pictures row by row from the upper left, on white, in linear RGB.
    #[must_use]
    pub fn picture(&self) -> Picture {
        let across = self.across();
        let [column, row] = self.cell();
        let (width, height) = self.size();
        let mut sheet = Picture::black(width, height);
        sheet.pixels.fill([1.0; 3]);
        for (k, picture) in (0..).zip(&self.pictures) {
            let [x, y] = [GAP + k % across * column, GAP + k / across * row];
            for (down, pixels) in (y..).zip(picture.pixels.chunks_exact(picture.width as usize)) {
                let start = (down * sheet.width + x) as usize;
                sheet.pixels[start..start + pixels.len()].copy_from_slice(pixels);
            }
        }
        sheet
    }
}

/// Returns the picture scaled down to at most `side` pixels across and down; a smaller picture is
/// returned unchanged. Each pixel is the mean, in linear RGB clamped to [0, 1], of the pixels that it
/// covers.
#[must_use]
pub fn thumbnail(picture: &Picture, side: u32) -> Picture {
    let (width, height) = (picture.width, picture.height);
    let longest = width.max(height);
    if longest <= side {
        return picture.clone();
    }
    let scaled =
        |length: u32| (u64::from(length) * u64::from(side) / u64::from(longest)).max(1) as u32;
    let mut small = Picture::black(scaled(width), scaled(height));
    let span = |k: u32, parts: u32, all: u32| {
        let edge = |k: u32| (u64::from(k) * u64::from(all) / u64::from(parts)) as usize;
        edge(k)..edge(k + 1).max(edge(k) + 1)
    };
    for y in 0..small.height {
        for x in 0..small.width {
            let (rows, columns) = (span(y, small.height, height), span(x, small.width, width));
            let count = (rows.len() * columns.len()) as f64;
            let mut sum = [0.0_f64; 3];
            for row in rows {
                let start = row * width as usize;
                for pixel in &picture.pixels[start + columns.start..start + columns.end] {
                    for (sum, light) in sum.iter_mut().zip(pixel) {
                        *sum += f64::from(*light).clamp(0.0, 1.0);
                    }
                }
            }
            let place = (y * small.width + x) as usize;
            small.pixels[place] = sum.map(|sum| (sum / count) as f32);
        }
    }
    small
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thumbnail_keeps_the_light_and_the_shape() {
        let mut picture = Picture::black(300, 200);
        for (k, pixel) in picture.pixels.iter_mut().enumerate() {
            *pixel = [(k % 2) as f32; 3];
        }
        let small = thumbnail(&picture, 150);
        assert_eq!((small.width, small.height), (150, 100));
        assert!(small.pixels.iter().all(|pixel| *pixel == [0.5; 3]));
        assert_eq!(thumbnail(&picture, 300), picture);
        assert_eq!(thumbnail(&Picture::black(1000, 1), 10).height, 1);
    }

    #[test]
    fn pictures_lie_in_rows_of_six_on_white() {
        let mut sheet = ContactSheet::default();
        for k in 1..=7 {
            let mut picture = Picture::black(2, 1);
            picture.pixels.fill([f32::from(k as u8) / 8.0; 3]);
            sheet.add(&picture);
        }
        let whole = sheet.picture();
        assert_eq!((whole.width, whole.height), (6 * 10 + 8, 2 * 9 + 8));
        let at = |x: u32, y: u32| whole.pixels[(y * whole.width + x) as usize][0];
        for k in 0..7 {
            let [x, y] = [8 + k % 6 * 10, 8 + k / 6 * 9];
            assert_eq!(at(x, y), (k + 1) as f32 / 8.0);
            assert_eq!([at(x + 1, y), at(x + 2, y), at(x, y - 1)], [at(x, y), 1.0, 1.0]);
        }
        let shown = whole.pixels.iter().filter(|pixel| pixel[0] < 1.0).count();
        assert_eq!(shown, 7 * 2);
    }
}
