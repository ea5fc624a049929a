//! Reads the picture of heights that a spec names.

use super::Reader;
use crate::error::SweepError;
use crate::grid::Across;
use crate::spec::DepthImage;
use crate::surface::height::{Axis, HeightMap};
use crate::surface::profile::Profile;
use crate::trajectory::Trajectory;
use files::memory;
use files::picture::{self, Format, PictureError};
use image::ColorType;

/// Largest number of texels of a picture, each of which takes 8 bytes.
const MOST_TEXELS: u64 = 1 << 24;

/// Largest number of repeats, so that a double still distinguishes neighbouring texels.
const MOST_REPEATS: f64 = 1e6;

/// Returns the bytes for each texel while heights are made: the decoded texel, three 16-bit codes, a number, and at most
/// a column and a row of coefficients.
fn each(kind: ColorType) -> u64 {
    u64::from(kind.bytes_per_pixel()) + 6 + 8 + 16
}

impl Reader<'_> {
    /// Reads the heights on a surface.
    pub(super) fn heights(
        &self,
        image: &DepthImage,
        across: Across,
        contour: &Profile,
        trajectory: &Trajectory,
    ) -> Result<HeightMap, SweepError> {
        self.number("depth.image.amp", image.amp)?;
        self.number("depth.image.zero", image.zero)?;
        let curves = [(contour.closed(), "contour"), (trajectory.closed(), "trajectory")];
        let curves = match across {
            Across::Contour => curves,
            Across::Trajectory => [curves[1], curves[0]],
        };
        for (i, (&repeat, (closed, curve))) in image.repeat.iter().zip(curves).enumerate() {
            let path = format!("depth.image.repeat[{i}]");
            self.positive(&path, repeat)?;
            if repeat > MOST_REPEATS {
                let message = format!("found {repeat:?}, expected at most {MOST_REPEATS:?}");
                return Err(self.fault(&path, message));
            }
            if closed && repeat.fract() != 0.0 {
                let message = format!(
                    "found {repeat:?} repeats, expected a whole number, since the {curve} is closed"
                );
                return Err(self.fault(&path, message));
            }
        }
        let (size, mut values) = self.greys(&image.file)?;
        for value in &mut values {
            *value -= image.zero;
        }
        let axis =
            |i: usize| Axis { texels: size[i], repeat: image.repeat[i], closed: curves[i].0 };
        Ok(HeightMap::new(values, [axis(0), axis(1)], across, image.amp))
    }

    /// Reads the texels of a grey picture, from 0 to 1, row by row from the top.
    fn greys(&self, file: &str) -> Result<([usize; 2], Vec<f64>), SweepError> {
        let key = "depth.image.file";
        let (name, bytes) = self.named_file(key, file)?;
        let broken = |error: PictureError| match error {
            PictureError::Memory(error) => {
                SweepError::TooLarge(self.document.fault(key, error.to_string()))
            }
            error => self
                .fault(key, format!("found no picture in {name} ({error}), expected a PNG file")),
        };
        let (width, height) = picture::size(&bytes, &[Format::Png]).map_err(broken)?;
        if u64::from(width) * u64::from(height) > MOST_TEXELS {
            let message = format!(
                "found {width} x {height} texels in {name}, expected at most {MOST_TEXELS}"
            );
            return Err(SweepError::TooLarge(self.document.fault(key, message)));
        }
        let budget = memory::of_process();
        let (picture, _reserved) =
            picture::decode(&bytes, &[Format::Png], each, budget, || name.clone())
                .map_err(broken)?;
        let picture = picture.into_rgb16();
        if let Some((x, y, _)) =
            picture.enumerate_pixels().find(|(.., p)| p.0[0] != p.0[1] || p.0[1] != p.0[2])
        {
            let message =
                format!("found a colour at texel ({x}, {y}) of {name}, expected a grey picture");
            return Err(self.fault(key, message));
        }
        let values = picture.pixels().map(|p| f64::from(p.0[0]) / f64::from(u16::MAX)).collect();
        Ok(([width as usize, height as usize], values))
    }
}
