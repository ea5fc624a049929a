//! A picture as integer texels of linear light.

mod pixels;

use crate::color::Color;
use glam::{DVec2, DVec3};
use schemars::JsonSchema;
use serde::Deserialize;

/// A picture that is mapped onto surfaces.
///
/// ```text
///   t = 1  +---------------+   row 0 of the picture is at the top;
///          | row 0         |   texel (i, j) covers [i, i+1) x [j, j+1)
///          | row 1         |   in texels, x = s * width to the right
///   t = 0  +---------------+   and y = (1 - t) * height downward
///         s = 0           s = 1
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Texture {
    /// Name of the texture in the scene.
    pub name: String,
    /// Texels across.
    pub width: usize,
    /// Texels down.
    pub height: usize,
    /// Continuation of the texture beyond its edges.
    pub wrap: Wrap,
    /// Codes of red, green and blue, proportional to light, row by row from the top.
    pub texels: Vec<[u16; 3]>,
    /// The largest code that can occur, which stands for 1.
    pub white: u16,
    /// The lower digits of a picture of floating point values.
    pub floats: Option<Box<Floats>>,
    /// The coverage of the texels, three equal codes each, if some texels are transparent. The texels are
    /// then multiplied by it. A surface is cut out by the mask.
    pub mask: Option<Box<Texture>>,
}

/// The lower digits of a picture of floating point values.
///
/// A channel is `light (code + low / 65535)`, where `code` and `low` are whole numbers over 65535. Two
/// digits of 16 bits hold brightness from 1 to 1 / 4,294,836,225 of the brightest channel. All filters
/// average both digits as they average any texels.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Floats {
    /// The lower digits, of the same size as the picture.
    pub low: Texture,
    /// Light of the brightest channel, positive.
    pub light: f64,
}

/// The continuation of a texture beyond its edges.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Wrap {
    /// The texture repeats.
    #[default]
    Repeat,
    /// The edge texels continue without end.
    Clamp,
    /// The texture repeats, and every other copy is mirrored.
    Mirror,
}

/// The meaning of a picture file's codes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Values {
    /// Codes are sRGB. They become 16-bit linear values before anything is summed.
    #[default]
    Srgb,
    /// Codes are proportional to light and stay unchanged, with 8 or 16 bits.
    Linear,
}

/// The use of a picture's alpha channel.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Alpha {
    /// Transparent texels cut out the surface.
    #[default]
    Cut,
    /// Texels cut out the surface if their code of 16 bits is below this one, and are opaque otherwise. Only
    /// glTF files ask for this.
    #[serde(skip)]
    From(u16),
    /// All texels are opaque.
    Ignore,
}

impl Texture {
    /// Memory of the texels, of the lower digits and of the mask, in bytes.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        let floats = self.floats.as_ref().map_or(0, |floats| floats.low.bytes());
        let mask = self.mask.as_ref().map_or(0, |mask| mask.bytes());
        size_of_val(self.texels.as_slice()) as u64 + floats + mask
    }

    /// Returns the amount of light of one code, `1 / white`.
    #[must_use]
    pub fn unit(&self) -> f64 {
        1.0 / f64::from(self.white)
    }

    /// Converts texture coordinates to a position in texels, `x` to the right and `y` downward from
    /// the upper left corner.
    #[must_use]
    pub fn in_texels(&self, uv: DVec2) -> DVec2 {
        DVec2::new(uv.x * self.width as f64, (1.0 - uv.y) * self.height as f64)
    }

    /// Returns the texel that contains the point, unfiltered, in linear RGB. `uv` are texture
    /// coordinates.
    #[must_use]
    pub fn point(&self, uv: DVec2) -> Color {
        let at = self.in_texels(uv);
        let column = self.wrap.index(floor(at.x), self.width);
        let row = self.wrap.index(floor(at.y), self.height);
        DVec3::from(self.texels[row * self.width + column].map(f64::from)) * self.unit()
    }

    /// Interpolates linearly between the four texel centres around the point and returns linear
    /// RGB. `uv` are texture coordinates.
    #[must_use]
    pub fn bilinear(&self, uv: DVec2) -> Color {
        let at = self.in_texels(uv) - 0.5;
        let corner = DVec2::new(floor(at.x), floor(at.y));
        let part = at - corner;
        if !part.is_finite() {
            return self.point(uv);
        }
        let columns = [corner.x, corner.x + 1.0].map(|x| self.wrap.index(x, self.width));
        let row = |y: f64| {
            let row = self.wrap.index(y, self.height) * self.width;
            let [left, right] = columns.map(|x| DVec3::from(self.texels[row + x].map(f64::from)));
            left.lerp(right, part.x)
        };
        row(corner.y).lerp(row(corner.y + 1.0), part.y) * self.unit()
    }
}

/// Largest distance from the origin, in texels, at which positions are used as they are. Farther
/// positions are replaced by equivalent ones near the origin before they get weights.
///
/// A few times farther out, `f64` still resolves a thousandth of a texel. From 2^53 on it does not
/// distinguish neighbouring texels, and the weights of a filter no longer sum to one.
const FAR: f64 = (1u64 << 42) as f64;

/// Rounds down, without a function call for all but the farthest positions.
fn floor(at: f64) -> f64 {
    if at.abs() < FAR {
        let toward_zero = at as i64 as f64;
        return if toward_zero > at { toward_zero - 1.0 } else { toward_zero };
    }
    at.floor()
}

/// Returns the position in `[0, period]` that equals `at` up to whole periods and rounding.
#[must_use]
pub fn reduced(at: f64, period: f64) -> f64 {
    if at.abs() < FAR {
        (at - period * floor(at / period)).clamp(0.0, period)
    } else {
        at.rem_euclid(period)
    }
}

impl Wrap {
    /// Returns an equivalent position in texels that is not too far from the origin.
    #[must_use]
    pub fn nearer(self, at: f64, size: usize) -> f64 {
        match self.period(size) {
            _ if at.abs() <= FAR => at,
            Some(period) => at.rem_euclid(period),
            None => at.clamp(-FAR, FAR),
        }
    }

    /// Returns the number of texels after which an axis of `size` texels repeats, or `None` if it
    /// does not.
    #[must_use]
    pub fn period(self, size: usize) -> Option<f64> {
        match self {
            Self::Repeat => Some(size as f64),
            Self::Clamp => None,
            Self::Mirror => Some(2.0 * size as f64),
        }
    }

    /// Returns the texel in `0..size` at the whole number `at`, of either sign.
    #[must_use]
    pub fn index(self, at: f64, size: usize) -> usize {
        let size_f = size as f64;
        // The usual case, which avoids a slow remainder.
        if at >= 0.0 && at < size_f {
            return at as usize;
        }
        let inside = match self {
            Self::Repeat => at.rem_euclid(size_f),
            Self::Clamp => at.clamp(0.0, size_f - 1.0),
            Self::Mirror => {
                let turned = at.rem_euclid(2.0 * size_f);
                if turned < size_f { turned } else { 2.0 * size_f - 1.0 - turned }
            }
        };
        // rem_euclid rounds up to the size itself just below a period; NaN becomes 0.
        (inside as usize).min(size - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{GrayImage, Luma};

    /// Two by two texels of codes 0, 10 (top) and 20, 30 (bottom).
    fn four(wrap: Wrap) -> Texture {
        let picture = GrayImage::from_fn(2, 2, |x, y| Luma([(10 * x + 20 * y) as u8]));
        Texture::from_picture(&picture.into(), Values::Linear, wrap, Alpha::Cut)
    }

    fn code(color: Color) -> f64 {
        (color.x * 255.0 * 1e9).round() / 1e9
    }

    #[test]
    fn the_first_row_is_at_the_top() {
        let texture = four(Wrap::Repeat);
        assert_eq!(code(texture.point(DVec2::new(0.25, 0.75))), 0.0);
        assert_eq!(code(texture.point(DVec2::new(0.75, 0.25))), 30.0);
        assert_eq!(code(texture.point(DVec2::new(1.75, -0.75))), 30.0);
    }

    #[test]
    fn beyond_the_edge_is_the_texture_again_or_its_edge() {
        let beyond = DVec2::new(1.25, 0.75);
        assert_eq!(code(four(Wrap::Repeat).point(beyond)), 0.0);
        assert_eq!(code(four(Wrap::Clamp).point(beyond)), 10.0);
        assert_eq!(code(four(Wrap::Repeat).bilinear(DVec2::new(1.0, 0.75))), 5.0);
        assert_eq!(code(four(Wrap::Clamp).bilinear(DVec2::new(1.0, 0.75))), 10.0);
        assert_eq!(code(four(Wrap::Mirror).point(beyond)), 10.0);
        assert_eq!(code(four(Wrap::Mirror).point(beyond + DVec2::X)), 0.0);
        assert_eq!(code(four(Wrap::Mirror).bilinear(DVec2::new(1.0, 0.75))), 10.0);
        assert_eq!(code(four(Wrap::Clamp).bilinear(DVec2::new(0.5, 0.5))), 15.0);
    }

    #[test]
    fn whole_numbers_below_are_those_of_the_standard_library() {
        let places = [0.0, 0.5, 1.0, -0.5, -1.0, -1e-300, 7.999, -7.001, 1e18, -1e18, 1e300];
        assert_eq!(places.map(floor), places.map(f64::floor));
        assert!(floor(f64::NAN).is_nan());
    }

    #[test]
    fn a_coordinate_just_below_a_period_stays_inside() {
        assert_eq!(Wrap::Repeat.index(-1e-30, 3), 2);
        assert_eq!(Wrap::Repeat.index(f64::NAN, 3), 0);
        assert_eq!(Wrap::Mirror.index(-1e-30, 3), 0);
        assert_eq!(
            [-1.0, -3.0, 3.0, 5.0, 6.0].map(|at| Wrap::Mirror.index(at, 3)),
            [0, 2, 2, 0, 0]
        );
    }
}
