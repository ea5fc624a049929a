//! A finished picture in linear light.

use super::alpha::coverage;
use super::{Crop, Layer, Settings};
use crate::color::Color;

/// A picture in linear RGB, with optional further channels.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Pixels row by row from the top, linear RGB in the `f32` of an EXR file.
    pub pixels: Vec<[f32; 3]>,
    /// Channels of the requested layers.
    pub channels: Vec<Channel>,
}

/// One number for each pixel.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// Name of the channel in a file, such as `normal.X`.
    pub name: &'static str,
    /// One number for each pixel, row by row from the top.
    pub values: Vec<f32>,
}

impl Picture {
    /// Creates a black picture without layers; the size is in pixels.
    #[must_use]
    pub fn black(width: u32, height: u32) -> Self {
        Self::with_layers(width, height, &[])
    }

    /// Creates a black picture with layers whose values are all 0; the size is in pixels.
    #[must_use]
    pub fn with_layers(width: u32, height: u32, layers: &[Layer]) -> Self {
        let count = width as usize * height as usize;
        let names = layers.iter().flat_map(|layer| layer.channels());
        let channels = names.map(|name| Channel { name, values: vec![0.0; count] }).collect();
        Self { width, height, pixels: vec![[0.0; 3]; count], channels }
    }

    /// Creates a black picture of the size and the layers that settings select.
    #[must_use]
    pub fn of(settings: &Settings) -> Self {
        let crop = Crop::of(settings);
        Self::with_layers(crop.width, crop.height, &settings.layers)
    }

    /// Copies a rectangle of pixels into the picture, with its upper left corner at column `x` and
    /// row `y`. `colors` holds the rectangle row by row, `columns` pixels a row.
    pub fn place(&mut self, x: u32, y: u32, columns: u32, colors: &[Color]) {
        for (row, colors) in colors.chunks_exact(columns as usize).enumerate() {
            let start = (y as usize + row) * self.width as usize + x as usize;
            for (pixel, color) in self.pixels[start..].iter_mut().zip(colors) {
                *pixel = color.to_array().map(|light| light as f32);
            }
        }
    }

    /// Copies the values of all channels for a rectangle of pixels, as [`Picture::place`] does for
    /// colours. `values` holds for each pixel its values in the order of the channels.
    pub fn place_layers(&mut self, x: u32, y: u32, columns: u32, values: &[f32]) {
        if self.channels.is_empty() {
            return;
        }
        let pixels = values.chunks_exact(self.channels.len());
        for (k, values) in pixels.enumerate() {
            let (row, column) = (k / columns as usize, k % columns as usize);
            let at = (y as usize + row) * self.width as usize + x as usize + column;
            for (channel, &value) in self.channels.iter_mut().zip(values) {
                channel.values[at] = value;
            }
        }
    }

    /// Replaces pixels that hold NaN or infinity by black and returns their number, which should be
    /// 0.
    pub fn remove_not_finite(&mut self) -> u64 {
        let broken = self.pixels.iter_mut().filter(|pixel| !pixel.iter().all(|x| x.is_finite()));
        broken.map(|pixel| *pixel = [0.0; 3]).count() as u64
    }

    /// Joins pictures from left to right, with `gap` white pixels between neighbours. The pictures
    /// should have the same height; below a lower picture the result is white. A picture with coverage is
    /// shown before white.
    #[must_use]
    pub fn side_by_side(pictures: &[Self], gap: u32) -> Self {
        let height = pictures.iter().map(|picture| picture.height).max().unwrap_or(0);
        let gaps = gap * (pictures.len() as u32).saturating_sub(1);
        let width = pictures.iter().map(|picture| picture.width).sum::<u32>() + gaps;
        let mut strip = Self::black(width, height);
        strip.pixels.fill([1.0; 3]);
        let mut x = 0;
        for picture in pictures {
            for (row, pixels) in picture.pixels.chunks_exact(picture.width as usize).enumerate() {
                let start = row * width as usize + x;
                strip.pixels[start..start + pixels.len()].copy_from_slice(pixels);
                if let Some(coverage) = coverage(picture) {
                    let covered = &coverage[row * picture.width as usize..];
                    for (pixel, covered) in
                        strip.pixels[start..].iter_mut().zip(&covered[..pixels.len()])
                    {
                        *pixel = pixel.map(|light| light + (1.0 - covered));
                    }
                }
            }
            x += (picture.width + gap) as usize;
        }
        strip
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::alpha;

    #[test]
    fn pictures_stand_side_by_side() {
        let mut left = Picture::black(1, 2);
        left.pixels[1] = [0.5; 3];
        let strip = Picture::side_by_side(&[left, Picture::black(2, 2)], 1);
        let shown: Vec<f32> = strip.pixels.iter().map(|pixel| pixel[0]).collect();
        assert_eq!((strip.width, strip.height), (4, 2));
        assert_eq!(shown, [0.0, 1.0, 0.0, 0.0, 0.5, 1.0, 0.0, 0.0]);
    }

    #[test]
    fn a_picture_with_coverage_stands_before_white() {
        let mut left = Picture::black(2, 1);
        left.pixels[1] = [0.25; 3];
        left.channels.push(Channel { name: alpha::NAME, values: vec![0.0, 0.5] });
        let strip = Picture::side_by_side(&[left, Picture::black(1, 1)], 0);
        assert_eq!(strip.pixels, [[1.0; 3], [0.75; 3], [0.0; 3]]);
    }

    #[test]
    fn broken_pixels_are_counted() {
        let mut picture = Picture::black(2, 1);
        picture.pixels[0][1] = f32::NAN;
        assert_eq!(picture.remove_not_finite(), 1);
        assert_eq!(picture, Picture::black(2, 1));
    }
}
